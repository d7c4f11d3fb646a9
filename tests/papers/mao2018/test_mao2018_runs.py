"""mao2018's compiled cases against plain Python and scipy."""

import math
import tomllib

import numpy as np
import plain_mao2018 as plain
import pytest
from mao2018_cases import FILE, all_wrong
from scipy.integrate import solve_ivp

from proofs.mao2018 import laws
from proofs.mao2018.simulation.trip import initial, parameters
from proofs.mao2018.study.record import MaoStudy
from proofs.mao2018.study.runs import RunCase, simulate
from workbench.files.toml import validate_record
from workbench.paper.study import varied

FASTER = 200


def two_hundred_times_faster(**law):
    """The study with all events at 1/200 of their time, so that 10 s hold every mode and every failure."""
    data = tomllib.loads(FILE.read_text(encoding="utf-8"))
    terms = [term for kind in data["disturbances"].values() for term in kind["terms"]]
    for entry in (*data["modes"], *data["failure"], *data["rest"], *terms):
        for key in ("start_s", "from_s", "to_s"):
            if key in entry:
                entry[key] /= FASTER
    data["modes"][2]["slope_ramp_per_s"] = 1.0
    data["reference"] |= {"starts_s": [0.0, 2.5, 5.0, 7.0, 8.7], "speeds_mps": [5.0, 6.0, 5.0, 2.5, 0.0],
                          "rate_mps2": 5.0, "ramp_s": 0.2, "end_s": 10.0}
    data["horizon"] |= {"end_s": 10.0, "log_every_s": 0.01, "settled_window_s": 0.1}
    data["sampling"]["end_s"] = 3.5
    data["law"] |= law
    data["changes"] = []
    return validate_record(data, MaoStudy, "fast")


def _plain(study, case, mended, period):
    """The same case typed out: the paper's numbers, the law in plain Python."""
    stated, number, inf = study.cases[case - 1], study.tunings["scaled"], math.inf
    scale = FASTER if study.horizon.end_s < 100 else 1
    events = [time / scale for time in (0, 400, 800, 1400)]
    modes = [[start, 8.63e-3, 7.295e-6, c, angle, curve] for start, c, angle, curve in zip(
        events, (1.12e-6, 9.12e-6, 1.12e-6, 1.12e-6), (0, 0, math.sin(math.radians(0.018)), 0), (0, 0, 0.34, 0),
        strict=True)]
    end = 1200 if case == 4 else 1400
    disturbance = [(0, 400 / scale, 0, 100, 0.03, 0), (400 / scale, 800 / scale, 200, 0, 0, 0),
                   (800 / scale, end / scale, 100, 0, 0, 0)]
    if case == 4:
        disturbance.append((0, 1200 / scale, 0, 500, 0.09, 0))
    failure = [(600 / scale, 1000 / scale, 2e5, 0, 0, 0), (1000 / scale, 1200 / scale, 2e5, 2e5, 0.05, -30),
               (1200 / scale, inf, 0, 0, 0, 0)]
    train = plain.Train(4e5, modes, ramp_s=4.0 if scale == 1 else 1.0, disturbance=disturbance,
                        failure=failure if case > 1 else [],
                        rest=[(600 / scale, inf, 0, 3e4, 0.07, 0)] if case == 3 else [],
                        drag=(1e-3, 1e-3, 0.02) if case == 5 else (0, 0, 0))
    start = initial(study, stated)
    law = plain.Law(stated.law, mended, parameters(study, stated, number), {
        str(state.symbol): start[str(state.symbol)]
        for state in (laws.healthy if case == 1 else laws.failure_law(stated.law)).states})
    desired = study.reference.curve()

    def curve(t):
        k = int(np.searchsorted(desired.breaks_s, t, side="right")) - 1
        h, row = t - float(desired.breaks_s[k]), desired.coefficients[k]
        return tuple(sum(float(row[i]) * math.perm(i, order) * h ** (i - order) for i in range(order, 6))
                     for order in range(3))

    return train, law, curve, stated.initial_position_m


@pytest.mark.parametrize(("case", "corrected", "layer"), [
    (1, False, 0.0), (2, True, 0.0), (2, False, 0.0), (3, True, 0.002), (3, False, 0.002), (4, True, 0.002),
    (4, False, 0.002), (5, True, 0.0), (5, False, 0.0)])
def test_compiled_cases_are_those_of_plain_python(case, corrected, layer):
    fast = two_hundred_times_faster(layer_mps=layer)
    mended = all_wrong(fast, case) if corrected else ()
    done = simulate(fast, RunCase(case, "scaled", mended))
    # As printed the laws leave the curve soon, and double every rounding error many times.
    steps = 9_900 if done.failed is None else min(9_900, int(0.85 * done.end_s / 0.001))
    expected = plain.run(*_plain(fast, case, mended, 0.001), 0.001, steps, 10)
    for name, values in expected.items():
        found = done.column(name)[:len(values)]
        # An estimate that has followed sgn(z_2) differs where rounding turned a sign.
        assert found == pytest.approx(np.array(values), rel=1e-5, abs=1e-6), name
    assert np.ptp(expected["u_mps2"]) > 0.05


@pytest.mark.parametrize(("corrected", "end_s"), [(False, 0.28), (True, 6.0)])
def test_short_periods_come_near_the_continuous_closed_loop(study, corrected, end_s):
    """Also as printed: that the train runs away within a second is the law's doing, not the sampling's."""
    smooth = varied(study, {"law.layer_mps": 1e-4}, "test")
    mended = all_wrong(study, 2) if corrected else ()
    train, law, curve, x = _plain(smooth, 2, mended, 0.0)
    period = 2e-5 if end_s < 1 else 2e-4
    start = [x, 0.0, *law.state.values()]
    flow = plain.rates(train, law, curve)
    true = solve_ivp(flow, (0.0, end_s), start, method="LSODA", rtol=1e-9, atol=1e-11, max_step=0.01).y[:, -1]
    quick = varied(smooth, {"tunings.scaled.period_s": period, "horizon.log_every_s": 0.01}, "test")
    done = simulate(quick, RunCase(2, "scaled", mended, end_s=end_s + 0.02))
    row = round(end_s / 0.01)
    assert done.column("s_m")[row] == pytest.approx(true[0], rel=1e-3, abs=1e-4)
    assert done.column("v_mps")[row] == pytest.approx(true[1], rel=1e-3, abs=1e-4)
    if not corrected:
        assert true[0] < -1.5 and true[1] < -30  # from -0.55 m, at rest
