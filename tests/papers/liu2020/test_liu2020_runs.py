"""liu2020's compiled laws against plain Python and scipy."""

from dataclasses import replace

import numpy as np
import pytest
from plain_liu2020 import PLAIN, Plain, plain_acceleration, runge_kutta
from scipy.integrate import solve_ivp

from proofs.liu2020 import plant as of_train
from proofs.liu2020.laws import LAWS
from proofs.liu2020.simulation.trip import desired_curve, law_values, setting_of
from workbench.compile.kernel import law_source
from workbench.model.law import speed
from workbench.simulate.closed_loop import run_law


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
