"""liu2020 runs: compiled laws against plain Python and scipy; what the paper says where it holds, and where not."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from refusals import changed_copy, refusal
from scipy.integrate import solve_ivp

from proofs.liu2020 import plant as of_train
from proofs.liu2020.laws import LAWS
from proofs.liu2020.simulation.trip import (
    centers,
    davis_at,
    davis_newton,
    desired_curve,
    disturbance_rows,
    law_values,
    line_table,
    rates,
    scales,
    section_force,
    setting_of,
)
from proofs.liu2020.steady_run import eigenvalues, implied, largest_step_s
from proofs.liu2020.study import KIND
from proofs.liu2020.study.comparison import drawn_runs, variants
from proofs.liu2020.study.figures import all_plots
from proofs.liu2020.study.findings import all_findings
from proofs.liu2020.study.outcomes import Results
from proofs.liu2020.study.record import LiuStudy, Section
from proofs.liu2020.study.runs import DRAWN_LAWS, RunCase, RunResult, run_case, run_cases, title_of
from proofs.liu2020.study.tables import all_tables
from workbench.cli.loading import load
from workbench.compile.kernel import law_source
from workbench.files.toml import read_toml, validate_record
from workbench.model.law import speed
from workbench.paper.cells import numbers_in
from workbench.paper.comparison import ComparedRun, Task
from workbench.paper.mpc_comparison import known, run_mpc
from workbench.report.build import study_document
from workbench.report.sources import sourced_values
from workbench.report.study_page import StudyContent, build_study_page
from workbench.simulate.closed_loop import run_law
from workbench.trains.track import ResistanceTable

FILE = Path(__file__).parents[3] / "proofs" / "liu2020" / "study.toml"
G = 9.80665


@pytest.fixture(scope="module")
def study():
    return load(FILE.parent).study


def read(path):
    """A file as the study's record, without a folder of code beside it."""
    return validate_record(read_toml(path), LiuStudy, path)


@pytest.fixture(scope="module")
def short(study):
    """12 km with a slope, networks that matter, steps of 5 ms: a run takes a fraction of a second."""
    source = dict.fromkeys(("from_m", "to_m", "slope"), "assumed: a test")
    section = Section(from_m=5000.0, to_m=7000.0, slope=1.0, source=source)
    faster = {"gamma_f_per_s2": 6e-3, "alpha_1_per_s2": 0.09, "gamma_v_n_per_m": 135.0, "alpha_2_n_per_m": 2000.0}
    return study.model_copy(update={
        "line": study.line.model_copy(update={"length_m": 12e3, "sections": (section,)}),
        "sampling": study.sampling.model_copy(update={"period_s": 0.005}),
        "adaptation": study.adaptation.model_copy(update=faster),
        "pairs": study.pairs.model_copy(update={"draws": 2, "set": {}})})


def outcome_of(study, column, law, disturbance="fast", leak=None):
    outcome = run_case(study, RunCase(column, f"liu2020.{law}", disturbance, leak_rate_per_s=leak))
    assert outcome.failed is None, outcome.failed
    return outcome.numbers


# --- the compiled runs ------------------------------------------------------------------------------------------------


class Plain:
    """(9), (12), (17)-(23), (30)-(35) typed a second time, neuron by neuron, with Euler steps of the laws."""

    def __init__(self, study, column, leak=-1, learn=1, by_rate=False, learning=True, differenced=False):
        self.k = [getattr(study.gains, f"k_{i}")[column - 1] for i in range(1, 6)]
        self.a, self.by_rate, self.leak, self.learn = study.adaptation, by_rate, leak, learn
        self.learning, self.differenced, self.T = learning, differenced, study.sampling.period_s
        self.tau, self.width, self.scale = study.sampling.speed_filter_s, study.networks.width, scales(study)
        self.c = centers(study)
        n = self.c.shape[1]
        self.Wf, self.Wv = [0.0] * n, [0.0] * n
        self.s_hat = self.v_hat = self.xi = self.delta = self.theta = self.u = self.s_before = self.v_before = 0.0

    def hidden(self, inputs, rows):
        return [math.exp(-sum((z - self.c[row][j]) ** 2 for z, row in zip(inputs, rows, strict=True)) / self.width**2)
                for j in range(self.c.shape[1])]

    def step(self, s, v, s_d, v_d, a_d):
        """The input in N at this sample; then the states move on."""
        k1, k2, k3, k4, k5 = self.k
        a, T, L, V, A, U = self.a, self.T, *(self.scale[f"{x}_scale"] for x in "svau")
        known = v
        if self.differenced:
            raw = (s - self.s_before) / T
            known = self.v_before + T / (self.tau + T) * (raw - self.v_before)
        if self.by_rate:  # of the integrated xi = v_hat + k3 s_tilde
            self.v_hat = self.xi - k3 * (self.s_hat - s)
        s_err, v_err = self.s_hat - s, self.v_hat - known
        e_v = k4 * (s_d - self.s_hat) + v_d - self.v_hat
        hf = self.hidden((self.s_hat / L, self.v_hat / V, self.u / U), (0, 1, 2))
        hv = self.hidden((s / L, known / V, self.v_hat / V, s_d / L, v_d / V, a_d / A), range(3, 9))
        f_hat, D1, u = 0.0, 0.0, k5 * e_v
        if self.learning:
            f_hat = sum(w * h for w, h in zip(self.Wf, hf, strict=True))
            D1 = -math.tanh(v_err / a.kappa_1_mps) * self.delta
            u += sum(w * h for w, h in zip(self.Wv, hv, strict=True)) + math.tanh(e_v / a.kappa_2_mps) * self.theta
        self.recorded = (s_err, self.v_hat - v)
        rate = self.leak * a.leak_rate_per_s
        self.Wf = [w + T * (-a.gamma_f_per_s2 * h * v_err + rate * w) for w, h in zip(self.Wf, hf, strict=True)]
        self.Wv = [w + T * (a.gamma_v_n_per_m * self.learn * h * e_v + rate * w)
                   for w, h in zip(self.Wv, hv, strict=True)]
        self.delta += T * (a.alpha_1_per_s2 * math.tanh(v_err / a.kappa_1_mps) * v_err + rate * self.delta)
        self.theta += T * (a.alpha_2_n_per_m * math.tanh(e_v / a.kappa_2_mps) * e_v + rate * self.theta)
        self.s_hat += T * (self.v_hat - k1 * s_err)
        self.xi += T * (f_hat - k2 * s_err + D1)
        self.v_hat += T * (f_hat - k2 * s_err - k3 * v_err + D1)
        self.u, self.s_before, self.v_before = u, s, known
        return u


def plain_acceleration(u, s, v, t):
    """(9) with (61) in N/kN and km/h, a slope of 1 % from 5 to 7 km, and (70)."""
    M, chi, kmh = 890000.0, 0.9, 3.6 * v
    resistance = M * G / 1000 * (0.53 + 0.00388 * kmh + 0.000114 * kmh**2)
    if 5000 <= s < 7000:
        resistance += M * G * math.sin(math.atan(0.01))
    return chi / M * u - chi / M * resistance + 1e5 / M * (math.sin(0.08 * t) + math.cos(0.08 * t))


def runge_kutta(f, s, v, t, h):
    a1 = f(s, v, t)
    a2 = f(s + h / 2 * v, v + h / 2 * a1, t + h / 2)
    a3 = f(s + h / 2 * (v + h / 2 * a1), v + h / 2 * a2, t + h / 2)
    a4 = f(s + h * (v + h / 2 * a2), v + h * a3, t + h)
    return (s + h / 6 * (v + 2 * (v + h / 2 * a1) + 2 * (v + h / 2 * a2) + v + h * a3),
            v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4))


PLAIN = {
    "feedback": {"learning": False},
    "feedback_rate": {"learning": False, "by_rate": True},
    "corrected": {},
    "printed": {"leak": 1, "learn": -1},
    "wrong_leakage": {"leak": 1},
    "wrong_learning": {"learn": -1},
    "corrected_rate": {"by_rate": True},
    "printed_rate": {"leak": 1, "learn": -1, "by_rate": True},
    "position_only": {"by_rate": True, "differenced": True},
    "position_only_speed": {"differenced": True},
}


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("column", [5, 10])
def test_every_law_runs_compiled_as_it_does_in_plain_python(short, law, column):
    steps, of = 1500, PLAIN[law.id.partition(".")[2]]
    setting = replace(setting_of(short, "fast"), end_s=steps * 0.005, log_every_s=0.005)
    compiled = run_law(law, law_values(short, law, column), setting, 0.005, "explicit", plant=of_train.model())
    plain, wanted = Plain(short, column, **of), desired_curve(short).at(np.arange(steps) * 0.005)
    columns = {name: [] for name in ("s_m", "v_mps", "u_mps2", "s_tilde", "v_tilde", "delta_hat", "theta_hat")}
    s = v = 0.0
    for n in range(steps):
        u = plain.step(s, v, *(float(x[n]) for x in wanted))
        for values, value in zip(columns.values(), (s, v, u / 890000.0, *plain.recorded, plain.delta, plain.theta),
                                 strict=True):
            values.append(value)
        s, v = runge_kutta(lambda p, w, t, u=u: plain_acceleration(u, p, w, t), s, v, n * 0.005, 0.005)
    for name, values in columns.items():
        if name in compiled.columns:
            scale = np.ptp(values) or 1.0
            assert compiled.column(name) == pytest.approx(np.array(values), rel=1e-6, abs=1e-7 * scale), name
    assert set(columns) - set(compiled.columns) <= ({"delta_hat", "theta_hat"} if not law.neuron_states else set())
    assert np.ptp(columns["u_mps2"]) > 0.1


@pytest.mark.parametrize(("name", "by_rate"), [("feedback", False), ("feedback_rate", True)])
def test_small_steps_come_to_the_differential_equations(short, name, by_rate):
    """(9), (12), (31) without networks, both readings of (12), by an adaptive integrator of scipy."""
    column, end = 6, 40.0
    fine = short.model_copy(update={"sampling": short.sampling.model_copy(update={"period_s": 0.0005})})
    curve = desired_curve(fine)
    k1, k2, k3, k4, k5 = (getattr(fine.gains, f"k_{i}")[column - 1] for i in range(1, 6))

    def flow(t, x):
        s, v, s_hat, v_hat = x
        s_d, v_d, _ = (float(y[0]) for y in curve.at(np.array([t])))
        u = k5 * (k4 * (s_d - s_hat) + v_d - v_hat)
        s_err, s_hat_rate = s_hat - s, v_hat - k1 * (s_hat - s)
        damping = s_hat_rate - v if by_rate else v_hat - v
        return [v, plain_acceleration(u, s, v, t), s_hat_rate, -k2 * s_err - k3 * damping]

    exact = solve_ivp(flow, (0.0, end), [0.0] * 4, rtol=1e-9, atol=1e-9, max_step=0.5, t_eval=np.arange(0.0, end, 0.1))
    law = LAWS[f"liu2020.{name}"]
    setting = replace(setting_of(fine, "fast"), end_s=end)
    got = run_law(law, law_values(fine, law, column), setting, 0.0005, "explicit", plant=of_train.model())
    rows = len(exact.t)
    assert got.column("s_m")[:rows] == pytest.approx(exact.y[0], abs=0.05)
    assert got.column("v_mps")[:rows] == pytest.approx(exact.y[1], abs=0.02)
    assert got.column("s_tilde")[:rows] == pytest.approx(exact.y[2] - exact.y[0], abs=5e-3)
    assert got.column("v_tilde")[:rows] == pytest.approx(exact.y[3] - exact.y[1], abs=5e-3)


def test_with_explicit_estimates_every_neuron_is_evaluated_once():
    source = law_source(LAWS["liu2020.corrected"], "explicit")
    assert source.count("for _j in range") == 1
    assert source.count("math.exp(") == 2  # one for each network
    assert law_source(LAWS["liu2020.corrected"], "corrected").count("for _j in range") == 2


def test_laws_say_what_they_measure():
    for law in LAWS.values():
        used = [law.command, *(state.rate if state.rate is not None else state.update for state in law.states
                               if str(state.symbol) != "v_tilde")]
        knows = any(expr.has(speed) for expr in used)
        assert (law.information == "full state, model unknown") == knows
    alone = {name for name, law in LAWS.items() if law.information == "position only, model unknown"}
    assert alone == {"liu2020.position_only", "liu2020.position_only_speed", "liu2020.feedback_rate"}


# --- train, line, reference, networks ---------------------------------------------------------------------------------


def test_the_simulated_train_is_9_with_its_resistances_and_disturbance():
    plant = of_train.model()
    (_, acceleration) = plant.rates.values()
    whole = of_train.acceleration.xreplace({of_train.f_d: of_train.davis(of_train.v) + of_train.additional})
    assert sp.simplify(acceleration.xreplace({of_train.opposing: of_train.opposing_force}) - whole) == 0


def test_the_disturbances_are_70_and_71(study):
    for name, d in (("fast", lambda t: 1e5 / 890e3 * (math.sin(0.08 * t) + math.cos(0.08 * t))),
                    ("slow", lambda t: 1e6 / 890e3 * math.sin(0.008 * t) if t >= 1000 else 0.0)):
        ((start, end, offset, amplitude, omega, phase, power),) = disturbance_rows(study, name)
        assert (end, offset, power) == (math.inf, 0.0, 0.0)
        for t in (0.0, 7.3, 999.0, 1000.0, 1234.5):
            opposing_per_kg = amplitude * math.sin(omega * t + phase) if t >= start else 0.0
            assert -0.9 * opposing_per_kg == pytest.approx(d(t), abs=1e-12)  # chi/M (-f) = d
    assert disturbance_rows(study, "none").shape == (0, 7)


@pytest.mark.parametrize(("unit", "at_350_kmh"), [
    ("N/kN, km/h", 890 * G * (0.53 + 0.00388 * 350 + 0.000114 * 350**2)),
    ("N/kN, m/s", 890 * G * (0.53 + 0.00388 * 350 / 3.6 + 0.000114 * (350 / 3.6) ** 2)),
    ("N/kg, m/s", 890e3 * (0.53 + 0.00388 * 350 / 3.6 + 0.000114 * (350 / 3.6) ** 2)),
])
def test_61_in_each_unit(study, unit, at_350_kmh):
    train = study.train.model_copy(update={"davis_unit": unit})
    assert davis_at(train, 350 / 3.6) == pytest.approx(at_350_kmh, rel=1e-12)
    assert davis_at(train, 0.0) == davis_newton(train)[0]


def test_table_1_in_newtons(study):
    slope, curve = study.line.sections
    assert section_force(slope, study.line, study.train) == pytest.approx(890e3 * G * math.sin(math.atan(0.1)))
    permille = study.line.model_copy(update={"slope_unit": "permille"})
    assert section_force(slope, permille, study.train) == pytest.approx(890e3 * G * math.sin(math.atan(0.01)))
    # (3) with the centre angle in degrees, and (4) without a restricted ramp.
    by_hand = 0.1029 * math.degrees(1.0) / 200 * 890e3 + 1.3e-6 * 1000 * 890e3
    assert section_force(curve, study.line, study.train) == pytest.approx(by_hand)
    table = line_table(study)
    assert table.at(np.array([0.0, 7e4, 1.05e5, 1.1e5, 1.29e5])) == pytest.approx(
        [0, G * math.sin(math.atan(0.1)), 0, by_hand / 890e3, 0])


def test_perfect_tracking_of_the_reference_needs_the_inputs_of_figure_18(study):
    curve = desired_curve(study)
    assert curve.length_m == pytest.approx(study.line.length_m)
    time = np.linspace(0.0, curve.trip_time_s, 200_001)
    _, v, a = curve.at(time)
    assert v.max() == pytest.approx(350 / 3.6)
    u = a * 890e3 / 0.9 + np.array([davis_at(study.train, x) for x in v[::200]]).repeat(200)[: len(a)]
    assert u.max() <= 5e6 * 1.001 and u.max() > 4.5e6
    assert u.min() >= -2e6 * 1.001 and u.min() < -1.8e6
    assert rates(study) == pytest.approx((a.max(), -a.min()), rel=1e-6)


def test_the_networks_stand_on_the_desired_curve_with_inputs_of_order_one(study):
    c = centers(study)
    assert c.shape == (9, study.networks.neurons)
    assert np.abs(c).max() <= 1.0 + 1e-9
    assert np.array_equal(c[0], c[6]) and np.array_equal(c[1], c[7])  # s, v of z_1 are s_d, s_d' of z_2 there
    assert c[0] == pytest.approx(np.linspace(0, 1, study.networks.neurons))
    assert c[1][0] == pytest.approx(0, abs=1e-3) and c[1][7] == pytest.approx(1.0)


# --- what the paper says, and where it does not hold ------------------------------------------------------------------


def test_more_observer_gain_estimates_better_with_the_term_that_12_prints(short):
    numbers = [outcome_of(short, column, "corrected") for column in (1, 2, 3, 4, 5)]
    for name, factor in (("s_tilde_m", 5), ("v_tilde_mps", 1.2)):
        errors = [n[name] for n in numbers]
        assert errors == sorted(errors, reverse=True) and errors[-1] < errors[0] / factor, name


def test_with_the_term_that_18_has_it_does_not_estimate_the_speed_better(short):
    low, high = (outcome_of(short, column, "feedback_rate") for column in (4, 10))
    assert high["s_tilde_m"] < low["s_tilde_m"] / 20
    assert high["v_tilde_mps"] > 0.5 * low["v_tilde_mps"]
    # The slow eigenvalue is the same for all gains of Table 2 from Value 4 on.
    slow = [max(eigenvalues(short, column, "s_tilde'").real) for column in (5, 7, 9, 10)]
    assert np.ptp(slow) < 0.01 and np.mean(slow) == pytest.approx(-1 / 9, rel=0.05)


@pytest.mark.parametrize(("low", "high"), [(5, 6), (7, 8)])
def test_more_control_gain_tracks_better(short, low, high):
    before, after = (outcome_of(short, column, "corrected") for column in (low, high))
    for name in ("position_m", "speed_mps"):
        assert after[name] < before[name] / 3


def test_learning_tracks_better_than_feedback_alone(short):
    for column in (5, 9):
        assert outcome_of(short, column, "corrected")["position_m"] < outcome_of(
            short, column, "feedback")["position_m"]


def test_the_printed_leakage_diverges_and_the_corrected_one_does_not(short):
    for law in ("printed", "wrong_leakage"):
        outcome = run_case(short, RunCase(5, f"liu2020.{law}", "fast", leak_rate_per_s=1.0))
        assert outcome.numbers == {}
        assert f"liu2020.{law} diverged at t = " in outcome.failed and " m, v = " in outcome.failed
        assert 5 < outcome.end_s < 60
    for law in ("corrected", "wrong_learning"):
        outcome_of(short, 5, law, leak=1.0)


def test_the_printed_sign_of_32_costs_tracking(short):
    wrong, right = (outcome_of(short, 5, law, leak=0.1) for law in ("wrong_learning", "corrected"))
    assert wrong["position_m"] > 1.02 * right["position_m"]


def test_without_the_speed_the_estimate_is_worse(short):
    known, had = (outcome_of(short, 10, law)["v_tilde_mps"] for law in ("corrected", "position_only_speed"))
    assert had > 3 * known
    finer = short.model_copy(update={"sampling": short.sampling.model_copy(update={"speed_filter_s": 0.01})})
    assert outcome_of(finer, 10, "position_only_speed")["v_tilde_mps"] < had / 3


def test_value_10_needs_the_step_that_its_eigenvalues_say(short):
    assert largest_step_s(eigenvalues(short, 10, "v_tilde")) == pytest.approx(2 / 173.97, rel=1e-3)
    assert largest_step_s(eigenvalues(short, 10, "s_tilde'")) == pytest.approx(2 / 314.89, rel=1e-3)
    coarse = short.model_copy(update={"sampling": short.sampling.model_copy(update={"period_s": 0.01})})
    outcome_of(coarse, 10, "feedback")
    assert run_case(coarse, RunCase(10, "liu2020.feedback_rate", "fast")).failed is not None


def test_the_printed_tables_imply_one_acceleration_and_one_step(study):
    """No run: Values 4 to 9 of Table 3 and Value 10 of Table 4 agree, Value 10 of Table 3 does not."""
    third = [implied(study, c, study.table_3.s_tilde_m[c - 1], study.table_3.v_tilde_mps[c - 1],
                     study.table_3.position_m[c - 1]) for c in range(1, 11)]
    fourth = implied(study, 10, study.table_4.s_tilde_m[1], study.table_4.v_tilde_mps[1], study.table_4.position_m[1])
    for one in (*third[3:9], fourth):
        assert 0.66 < one.by_estimates < 0.72
    assert third[9].by_estimates == pytest.approx(10 * fourth.by_estimates, rel=0.01)
    assert third[9].by_position == pytest.approx(fourth.by_estimates, rel=0.01)
    assert all(0.09 < one.step_s < 0.12 for one in third[3:9]) and fourth.step_s == pytest.approx(0.011, rel=0.05)
    assert max(map(abs, study.figure_ranges.v_tilde_mps)) < study.table_3.v_tilde_mps[9]


@pytest.mark.parametrize("column", [4, 5, 7, 8, 9])
def test_table_3_comes_out_by_feedback_alone_with_ten_times_its_gain(study, column):
    number = [change.title for change in study.changes].index(study.runs.inferred_changes[0])
    numbers = run_case(study, RunCase(column, "liu2020.feedback", "fast", number)).numbers
    for name, within in (("s_tilde_m", 0.1), ("v_tilde_mps", 0.1), ("position_m", 0.3)):
        assert numbers[name] == pytest.approx(getattr(study.table_3, name)[column - 1], rel=within), name
    assert numbers["speed_mps"] > 1.5 * study.table_3.speed_mps[column - 1]  # where it does not


# --- the study --------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def small(short):
    """The short line with the changes that tables need, two leak rates."""
    wanted = (*short.runs.inferred_changes, short.runs.divergence_change, "steps of 0.01 s, k₃s̃′")
    runs = short.runs.model_copy(update={"divergence_leak_rates_per_s": (0.0, 1.0)})
    return short.model_copy(update={"runs": runs, "changes": tuple(c for c in short.changes if c.title in wanted)})


@pytest.fixture(scope="module")
def result(small):
    steps = []
    found = KIND.run(small, 1, lambda done, total, what: steps.append((done, total, what)))
    assert [done for done, _, _ in steps] == list(range(1, len(steps) + 1)) and steps[-1][0] == steps[-1][1]
    return found


def test_the_study_runs_and_reports_those_that_fail(small, result):
    asked = run_cases(small)
    assert len(result.rows) == len(asked) == len(set(asked))
    failed = [row for row in result.rows if row["failed"]]
    assert 0 < len(failed) == len(result.failures) < len(asked)
    assert all(row["position_rms"] is None and row["end_s"] > 0 for row in failed)
    assert any("liu2020.feedback_rate, Value 10, steps of 0.01 s" in run for run, _ in result.failures)
    assert any("liu2020.printed" in run and "leak rate 1 1/s" in run for run, _ in result.failures)
    json.dumps(study_document(small, result), allow_nan=False)


def test_every_figure_and_both_tables_of_the_paper_are_there(small, result):
    sources = " ".join(plot.source for plot in result.plots)
    assert all(f"Figure {number}" in sources for number in range(3, 19))
    titles = [table.title for table in result.tables]
    assert any(title.startswith("Table 3") for title in titles) and any(title.startswith("Table 4") for title in titles)
    third = next(table for table in result.tables if table.title.startswith("Table 3, signs corrected"))
    assert [row[3] for row in third.text[:9]] == [
        "51.9592", "38.3612", "26.3685", "2.4269", "0.6257", "0.6022", "0.0299", "0.0288", "0.0108"]
    assert third.rows[9][3] == 5e-5 and third.text[9][3].endswith("10⁻⁵")
    assert third.headings[1:5] == ("energy printed (10¹¹)", "obtained (10¹¹)", "s̃ printed (m)", "obtained (m)")
    assert third.rows[0][1] == 1.8799e11 and third.values[0][1] == pytest.approx(1.8799)
    fourth = next(table for table in result.tables if table.title.startswith("Table 4"))
    assert fourth.text[0][:3] == ("no disturbance", "energy (10¹¹ J)", "1.6383") and fourth.values[0][2] == 1.6383e11
    assert all(any(True for row in table.rows for cell in row for _ in numbers_in(cell)) for table in result.tables)
    assert len(result.findings) >= 10
    page = build_study_page(StudyContent(small, result))
    assert "Value 10 under the same disturbance" in page and "nan" not in page.lower().split()


def test_laws_stand_beside_mpc_with_two_columns_of_gains_and_tuned(small, result):
    table = next(table for table in result.tables if table.title == "Beside MPC")
    law = LAWS["liu2020.corrected"]
    of_none = [row for row in table.rows if row[0] == "no disturbance"]
    assert [row[1] for row in of_none[:3]] == [f"{law.title}, Value 9", f"{law.title}, Value 10", f"{law.title}, tuned"]
    assert {row[2] for row in of_none[:3]} == {law.information} and len(of_none) == 10
    assert {of.table_4_column for of in variants(small, "corrected").values()} == {9, 10}
    runs = [ComparedRun(Task(place, name, variant), name, {}) for place in small.disturbances
            for name in ("corrected", "mpc_linear") for variant in variants(small, name)]
    assert [run.task for run in drawn_runs(small, runs)[0]] == [Task("fast", "corrected", ", Value 10"),
                                                             Task("fast", "mpc_linear")]


def test_the_plant_is_a_single_particle_of_the_mass_that_mpc_knows(study):
    setting = replace(setting_of(study, "fast"), end_s=200.0)
    chi, mass = study.train.chi, study.train.mass_kg / study.train.chi
    of = known(study.mpc, setting.curve, mass, davis_newton(study.train), setting.end_s)
    terms = setting.terms.copy()
    terms[:, 2:4] *= chi  # N per kg of M become N per kg of M/chi
    line = ResistanceTable(setting.line.position_m, setting.line.specific_force * chi)
    plain = replace(setting, mass_kg=mass, line=line, terms=terms, plant_values=())
    one = run_mpc(of, "mpc.offset_free", setting, of_train.model())
    other = run_mpc(of, "mpc.offset_free", plain)
    assert one.log[:, 1:3] == pytest.approx(other.log[:, 1:3], rel=1e-9, abs=1e-9)


def test_a_study_whose_runs_all_fail_still_reports(small):
    why = "liu2020 diverged at t = 1.000 s, s = 0.000 m, v = 0.000 m/s"
    few = dict.fromkeys(("t_s", "s_m", "v_mps", "s_desired_m", "v_desired_mps"), np.arange(3.0))
    broken = np.array([0.0, np.nan, np.inf])
    curves = few | dict.fromkeys(("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps", "input_n"), broken)
    outcomes = {case: RunResult(case, {}, 1.0, 5.0, why, 1.0, curves if case.law in DRAWN_LAWS else {})
                for case in run_cases(small)}
    results = Results(small, outcomes)
    assert all_tables(results) and all_plots(results)
    assert not any("None" in text for text in all_findings(results))
    assert all(title_of(small, case) for case in outcomes)


def test_assumed_values_follow_their_rules(study):
    gains, adapt, neurons = study.gains, study.adaptation, study.networks.neurons
    assert adapt.alpha_1_per_s2 == pytest.approx(gains.k_3[0] ** 2 / 4, rel=0.01)
    assert adapt.gamma_f_per_s2 == pytest.approx(gains.k_3[0] ** 2 / 4 / neurons, rel=0.01)
    critical = gains.k_5[0] ** 2 * study.train.chi / (4 * study.train.mass_kg)
    assert adapt.alpha_2_n_per_m == pytest.approx(critical, rel=0.01)
    assert adapt.gamma_v_n_per_m == pytest.approx(critical / neurons, rel=0.01)
    position, speed_mps, _ = desired_curve(study).at(np.linspace(0, desired_curve(study).trip_time_s, 100_001))
    braking_from = position[np.nonzero(speed_mps >= study.reference.cruise_mps * (1 - 1e-9))[0][-1]]
    assert 2500 < study.line.length_m - braking_from < 2650 and braking_from > study.line.sections[-1].to_m
    cruise = study.reference.cruise_mps
    assert davis_at(study.train, cruise) == pytest.approx(139e3, rel=0.01)
    assert davis_at(study.train, cruise) * cruise == pytest.approx(13.5e6, rel=0.01)


def test_every_value_has_its_source(study):
    values = sourced_values(study)
    assert {value.kind for value in values} == {"paper", "assumed", "convention"}
    assert len(values) > 60
    assert KIND.record is type(study)


@pytest.mark.parametrize(("old", "new", "key", "words"), [
    ("mass_kg = 890000.0", "mass_kg = 890.0", "train.mass_kg", "greater than or equal to 1000"),
    ("mass_kg = 890000.0", "mass_t = 890.0", "train.mass_t", "did you mean 'mass_kg'"),
    ('davis_unit = "N/kN, km/h"', 'davis_unit = "kN"', "train.davis_unit", "N/kN, km/h"),
    ("cruise_mps = 97.2222222222", "cruise_mps = 350.0", "reference.cruise_mps", "less than or equal to 150"),
    ("lowest_input_n = -2e6", "lowest_input_n = 2e6", "reference.lowest_input_n", "less than 0"),
    ("length_m = 131000.0", "length_m = 120000.0", "line", "positions must increase"),
    ("curve_radius_m = 200.0", "curve_radius_m = 0.2", "line.sections[1].curve_radius_m", "or equal to 50"),
    ("period_s = 0.001\n", "period_s = 1.0\n", "sampling.period_s", "less than or equal to 0.1"),
    ("k_1 = [0.048, ", "k_1 = [", "gains", "k_1 has 9 values"),
    ("k_3 = [0.06, ", "k_3 = [-0.06, ", "gains.k_3[0]", "greater than 0"),
    ("energy = [1.6383e11, ", "energy = [", "table_4", "values"),
    ('table_3_disturbance = "fast"', 'table_3_disturbance = "wind"', "", "'wind' is no disturbance"),
    ('sensitivity_law = "liu2020.corrected"', 'sensitivity_law = "liu2020.best"', "", "there is no law 'liu2020.best'"),
    ('divergence_change = "all', 'divergence_change = "al', "", "runs.divergence_change: there is no change"),
    ('"line.length_m" = 300000.0', '"line.length_km" = 300.0', "", "line.length_km: no such key"),
    ('"train.chi" = 1.0', '"train.chi" = 90.0', "", "changes: 'χ = 1, as (1) has it': train.chi"),
    ("divergence_columns = [5, 10]", "divergence_columns = [5, 11]", "runs.divergence_columns[1]", "or equal to 10"),
    ('neurons = "assumed', 'neurons = "guessed', "networks", "must start with 'paper'"),
])
def test_mistakes_are_named(tmp_path, old, new, key, words):
    path = changed_copy(FILE, tmp_path, old, new)
    said = refusal(read, path)
    assert said.startswith(f"{path}: ") and key in said and words in said
