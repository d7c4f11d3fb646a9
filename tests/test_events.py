"""What happens at stated times: the compiled plant against an adaptive integrator, and what a file may state."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scenarios import LAWS, short_scenario, with_law
from scipy.integrate import solve_ivp

from workbench.errors import InputError
from workbench.model.desired_curve import DesiredCurve
from workbench.model.events import Failure, Mode, PushTerm, failure_rows, mode_rows, push_rows
from workbench.simulate.closed_loop import Setting, run_law, simulate
from workbench.simulate.controllers import held_command

MASS, END_S = 4e5, 60.0
# Each entry: from, to, offset, amplitude, omega, phase, and the power of the speed or the share of the motors.
PUSHES = [
    (0.0, 25.0, 0.0, 0.03, 0.9, 0.4, 0), (15.0, 40.0, 0.02, 0.0, 0.0, 0.0, 0), (5.0, None, 1e-3, 2e-3, 0.3, 0.0, 1),
    (12.0, 50.0, 0.0, 1e-4, 0.7, -1.0, 2),
]
FAILURES = [
    (20.0, 35.0, 6e4, 0.0, 0.0, 0.0, 0.25), (35.0, 45.0, 3e4, 2e4, 1.1, -3.0, 0.25),
    (45.0, None, 0.0, 0.0, 0.0, 0.0, 0.5),
]
# From, a, b, c, grade, curve, seconds in which the grade grows.
MODES = [
    (0.0, 8e-3, 7e-5, 1e-5, 0.0, 0.0, 0.0), (10.0, 9e-3, 7e-5, 9e-5, 0.05, 0.01, 4.0),
    (30.0, 5e-3, 2e-5, 1e-5, -0.03, 0.0, 0.0),
]


def _record(kind, **values):
    return kind(**values, source=dict.fromkeys(values, "assumed: a test"))


def _window(row):
    window = {"from_s": row[0], "omega_rad_s": row[4], "phase_rad": row[5]}
    return window if row[1] is None else window | {"to_s": row[1]}


def _rows():
    pushes = [_record(PushTerm, offset_mps2=row[2], amplitude_mps2=row[3], speed_power=row[6], **_window(row))
              for row in PUSHES]
    failures = [_record(Failure, offset_n=row[2], amplitude_n=row[3], failed_share=row[6], **_window(row))
                for row in FAILURES]
    modes = [_record(Mode, **dict(zip(("from_s", "davis_a_mps2", "davis_b_per_s", "davis_c_per_m", "grade_mps2",
                                       "curve_mps2", "grade_ramp_s"), row, strict=True))) for row in MODES]
    return {"terms": push_rows(pushes), "failures": failure_rows(failures),
            "changes": mode_rows(modes, MASS, (1.0, 1.0, 1.0))}


def _acts(row, t):
    return row[0] <= t and (row[1] is None or t < row[1])


def _acceleration(t, v, command):
    """Newton's law typed out, each event by its own condition."""
    force = sum((row[2] + row[3] * math.sin(row[4] * t + row[5]) for row in FAILURES if _acts(row, t)), 0.0)
    force += command * MASS * (1 - sum(row[6] for row in FAILURES if _acts(row, t)))
    start, a, b, c, grade, curve, ramp = next(mode for mode in reversed(MODES) if mode[0] <= t)
    opposing = a + b * v + c * v**2 + curve + grade * (min(1.0, (t - start) / ramp) if ramp else 1.0)
    opposing += sum((row[2] + row[3] * math.sin(row[4] * t + row[5])) * v ** row[6] for row in PUSHES if _acts(row, t))
    return force / MASS - opposing


def _adaptive(command):
    """Position and speed at the end, integrated from one event to the next."""
    times = {0.0, END_S} | {row[k] for row in (*PUSHES, *FAILURES) for k in (0, 1) if row[k] is not None}
    times |= {time for mode in MODES for time in (mode[0], mode[0] + mode[6])}
    state = np.zeros(2)
    for begin, end in pairwise(sorted(times)):
        # Just before the end what acts until then still acts.
        state = solve_ivp(lambda t, y, last=end: [y[1], _acceleration(min(t, last - 1e-9), y[1], command)],
                          (begin, end), state, method="DOP853", rtol=1e-12, atol=1e-10).y[:, -1]
    return state


def _setting(dt, **rows):
    rest = DesiredCurve(np.array([0.0, 1.0]), np.zeros((1, 6)))
    return Setting(curve=rest, mass_kg=MASS, nominal_mass_kg=MASS, davis_n=(0.0, 0.0, 0.0), plant_step_s=dt,
                   end_s=END_S, log_every_s=dt, position_band_m=1.0, **rows)


def _held(command, dt, **rows):
    values = (np.array([command]), np.zeros(0), np.zeros((0, 0)), np.zeros((0, 0)))
    return run_law(held_command, values, _setting(dt, **rows), dt)


def test_all_events_together_are_those_of_an_adaptive_integrator():
    position, speed = _adaptive(0.4)
    for dt in (0.01, 0.001):
        run = _held(0.4, dt, **_rows())
        assert run.failed is None
        assert run.final_position_m == pytest.approx(position, rel=1e-9)
        assert run.column("v_mps")[-1] == pytest.approx(speed - dt * _acceleration(END_S - dt, speed, 0.4), rel=1e-6)


@pytest.mark.parametrize("kind", ["terms", "failures", "changes"])
def test_each_kind_of_event_matters_in_that_comparison(kind):
    position, _ = _adaptive(0.4)
    rows = {name: value for name, value in _rows().items() if name != kind}
    assert abs(_held(0.4, 0.01, **rows).final_position_m - position) > 1.0


def test_the_integrator_keeps_its_order_across_events_that_fall_on_steps():
    position, _ = _adaptive(0.4)
    errors = [abs(_held(0.4, dt, **_rows()).final_position_m - position) for dt in (0.5, 0.25)]
    assert errors[0] / errors[1] > 10  # 16 for order four


def test_the_log_holds_the_force_of_all_motors():
    run = _held(0.4, 0.01, **_rows())
    t = run.column("t_s")
    assert np.all(run.column("u_mps2") == 0.4)
    for time, expected in ((10.0, 0.4), (25.0, 0.3 + 6e4 / MASS), (50.0, 0.2),
                           (40.0, 0.3 + (3e4 + 2e4 * math.sin(1.1 * 40 - 3)) / MASS)):
        assert run.column("u_applied_mps2")[np.searchsorted(t, time - 1e-9)] == pytest.approx(expected, rel=1e-9)


def test_before_the_first_mode_and_after_the_last_their_values_hold():
    late = [_record(Mode, from_s=30.0, davis_a_mps2=0.02, davis_b_per_s=0.0, davis_c_per_m=0.0)]
    run = _held(0.1, 0.01, changes=mode_rows(late, MASS, (1.0, 1.0, 1.0)))
    assert run.final_position_m == pytest.approx(0.08 * END_S**2 / 2, rel=1e-9)


def test_a_scenario_states_events_and_the_true_train_scales_its_modes():
    rows = mode_rows([_record(Mode, from_s=0.0, davis_a_mps2=1e-2, davis_b_per_s=2e-3, davis_c_per_m=3e-4)], 1e5,
                     (1.0, 2.0, 0.5))
    assert rows[0] == pytest.approx([0.0, 1e3, 4e2, 15.0, 0.0])
    source = dict.fromkeys(("from_s", "failed_share", "offset_n"), "assumed: a test")
    failed = {"from_s": 20.0, "failed_share": 0.5, "offset_n": 1e3, "source": source}
    source = dict.fromkeys(("from_s", "to_s", "offset_mps2"), "assumed: a test")
    push = {"from_s": 5.0, "to_s": 10.0, "offset_mps2": 0.3, "source": source}
    plain, changed = (simulate(with_law(short_scenario(**changes), LAWS["pid"], 0.01), "only") for changes in (
        {}, {"failures": [failed], "disturbance__terms": [push]}))
    t = plain.column("t_s")
    early = t < 5.0
    assert np.array_equal(plain.column("s_m")[early], changed.column("s_m")[early])
    assert np.abs(plain.column("s_m") - changed.column("s_m"))[t < 10].max() > 0.05
    late, train = t >= 20.0, short_scenario().train
    followed = np.clip(changed.column("u_mps2")[late], -train.max_braking_n / train.mass_kg,
                       train.max_traction_n / train.mass_kg)
    assert changed.column("u_applied_mps2")[late] == pytest.approx(0.5 * followed + 1e3 / train.mass_kg, rel=1e-12)


def test_reversals_and_changes_of_the_command_are_counted():
    run = simulate(with_law(short_scenario(), LAWS["pid"], 0.05), "only")
    u = run.column("u_mps2")[::5]
    change = np.diff(u)
    assert run.totals["commands"] == len(u)
    assert run.totals["command_variation_mps2"] == pytest.approx(np.abs(change).sum(), rel=1e-12)
    assert run.totals["command_reversals"] == np.sum(change[1:] * change[:-1] < 0)


MODE = {"davis_a_mps2": 0.1, "davis_b_per_s": 0.0, "davis_c_per_m": 0.0}


def _sourced(values):
    return values | {"source": dict.fromkeys(values, "assumed: a test")}


@pytest.mark.parametrize(("changes", "message"), [
    ({"modes": [_sourced(MODE | {"from_s": 5.0})] * 2}, "modes: from_s does not increase"),
    ({"modes": [_sourced(MODE | {"from_s": 0.0, "grade_mps2": 0.1, "grade_ramp_s": 9.0}),
                _sourced(MODE | {"from_s": 5.0})]}, "shorten grade_ramp_s"),
    ({"failures": [_sourced({"from_s": 5.0, "to_s": 4.0, "failed_share": 0.1})]}, "to_s = 4 is not after from_s = 5"),
    ({"failures": [_sourced({"from_s": 5.0, "failed_share": 6.0})]}, r"failures\[0\].failed_share"),
    ({"disturbance__terms": [_sourced({"offset_mps2": 200.0})]}, r"disturbance.terms\[0\].offset_mps2"),
    ({"disturbance__terms": [_sourced({"offset_mps2": 0.1, "speed_power": 3})]}, r"terms\[0\].speed_power"),
    ({"disturbance__terms": [_sourced({"offset_n": 0.1})]}, r"terms\[0\].offset_n: unknown key"),
])
def test_an_event_that_cannot_be_used_is_named(changes, message):
    with pytest.raises(InputError, match=message):
        short_scenario(**changes)
