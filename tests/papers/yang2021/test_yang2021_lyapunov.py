"""What is simulated is what is proved: along compiled runs, V changes at the rate that the proof derives.

V is (38) of yang2021 and its derivative is derived from (38), the plant and the laws, as for claim 41. The
sampled loop holds its command for one step, so the two agree up to the step, and twice as well at half of it.
"""

import numpy as np
import sympy as sp
from scenarios import short_scenario

from proofs.yang2021 import error_dynamics, laws, lyapunov
from proofs.yang2021.claims.section_5_2 import v_rate_closed
from workbench.model.law import neuron, neuron_count
from workbench.proof.claim import D
from workbench.proof.derive import lie_derivative
from workbench.simulate import kernel_loop
from workbench.simulate.closed_loop import _arrays, law_values, setting_of
from workbench.simulate.law_loop import law_loop
from workbench.trains.track import resistance_table

START_S, DURATION_S = 1.0, 2.0


def trajectory(step_s: float):
    """Rows of (t, x_1, x_2, x_d, xdot_d, estimates) and weights at every step of a compiled RBFNN-POCRAC run."""
    scenario = short_scenario(simulation__plant_step_s=step_s, simulation__log_every_s=step_s)
    law, spec = laws.rbfnn_pocrac, scenario.controllers["rbfnn_pocrac"]
    parameters, scalars, neurons, data = law_values(law, spec, "rbfnn_pocrac")
    arrays = _arrays(setting_of(scenario), step_s, law)
    kernel = law_loop(law, spec.estimates).closed_loop
    rows, weights = [], []
    for n in range(round((START_S + DURATION_S) / step_s)):
        before = (n * step_s, *arrays.state[:2], *scalars)
        rows.append(before)
        weights.append(neurons[0].copy())
        status, _ = kernel(n, 1, 1, step_s, *arrays.before_law(), scenario.simulation.position_band_m,
                           scenario.train.mass_kg, parameters, scalars, neurons, data, *arrays.after_law(), 1)
        assert status == kernel_loop.RUNNING
    keep = slice(round(START_S / step_s), None)
    return scenario, np.array(rows)[keep], np.array(weights)[keep], data, parameters, law


def lyapunov_mismatch(step_s: float) -> float:
    """Largest |dV/dt numerical - V' derived| over the window, relative to the largest |V'|."""
    scenario, rows, weights, data, parameters, law = trajectory(step_s)
    t, x_1, x_2 = rows[:, 0], rows[:, 1], rows[:, 2]
    x_d, xdot_d, _ = scenario.desired_curve().at(t)
    gains = dict(zip((str(s) for s in law.parameters), parameters, strict=True))
    hidden = np.exp(-((x_1[:, None] - data[0]) ** 2 + (x_2[:, None] - data[1]) ** 2) / (2 * data[2] ** 2))
    rng = np.random.default_rng(3)
    ideal = rng.normal(0.0, 0.05, weights.shape[1])  # any W*: eps is then defined by (7)
    f_true = -resistance_table(scenario.track).at(x_1)
    stars = (scenario.train.davis_a_mps2, scenario.train.davis_b_per_s, scenario.train.davis_c_per_m)
    e_1 = x_1 - x_d
    values = {
        "e_1": e_1, "e_2": x_2 - (-gains["alpha"] * e_1 + xdot_d), "xdot_d": xdot_d,
        "epsilon": f_true - hidden @ ideal,
        **{f"{n}_tilde": rows[:, 3 + i] - star for i, (n, star) in enumerate(zip("abc", stars, strict=True))},
        **{f"{n}_star": np.full(len(t), star) for n, star in zip("abc", stars, strict=True)},
        **{name: np.full(len(t), value) for name, value in gains.items()},
    }
    per_neuron = {"W_tilde": weights - ideal, "W_star": np.broadcast_to(ideal, weights.shape), "h": hidden}
    v = evaluate(lyapunov.V, values, per_neuron)
    v_rate = evaluate(lie_derivative(lyapunov.V, error_dynamics.flow), values, per_neuron)
    numerical = (v[2:] - v[:-2]) / (2 * step_s)
    return float(np.max(np.abs(numerical - v_rate[1:-1])) / np.max(np.abs(v_rate)))


def evaluate(expr, values, per_neuron):
    """An expression with sums over neurons, along a trajectory."""
    sums = sorted(expr.atoms(sp.Sum), key=sp.default_sort_key)
    marks = {s: sp.Symbol(f"sum_{i}") for i, s in enumerate(sums)}
    found = dict(values)
    for total, mark in marks.items():
        names = {i: sp.Symbol(str(i.base.label)) for i in total.atoms(sp.Indexed)}
        term = total.function.xreplace(names)
        symbols = sorted(term.free_symbols - {neuron, neuron_count}, key=str)
        columns = [per_neuron[str(s)] if str(s) in per_neuron else found[str(s)][:, None] for s in symbols]
        found[str(mark)] = sp.lambdify(symbols, term, "numpy")(*columns).sum(axis=1)
    rest = expr.xreplace(marks)
    symbols = sorted(rest.free_symbols, key=str)
    return sp.lambdify(symbols, rest, "numpy")(*(found[str(s)] for s in symbols))


def test_claim_41_decides_the_rate_of_this_v_along_this_loop():
    goal = v_rate_closed()
    assert goal.show[0].left == D(lyapunov.V)
    assert goal.flow == error_dynamics.flow


def test_v_changes_at_the_derived_rate():
    coarse, fine = lyapunov_mismatch(2e-4), lyapunov_mismatch(1e-4)
    assert fine < 5e-3
    assert 1.8 < coarse / fine < 2.2  # first order: nothing but the held command stands between them


def test_a_wrong_rate_is_noticed():
    """The comparison above can fail: with one sign of the adaptation turned, it does."""
    honest = dict(error_dynamics.flow)
    try:
        error_dynamics.flow[error_dynamics.tildes[0]] = -honest[error_dynamics.tildes[0]]
        assert lyapunov_mismatch(2e-4) > 0.05
    finally:
        error_dynamics.flow.update(honest)
