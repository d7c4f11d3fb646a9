"""jiao2025's train driven by MPC: one trial of the desired length, in which MPC knows the train."""

from __future__ import annotations

import time
from itertools import accumulate
from typing import TYPE_CHECKING, Any

import numpy as np

from workbench.model.curve_table import Row, curve_through
from workbench.model.desired_curve import DesiredCurve
from workbench.paper.learning_comparison import jerk_rms
from workbench.paper.mpc_comparison import controller, known
from workbench.simulate.closed_loop import NOMINAL, Factors

from .. import plant
from .plans import Case, plan, plan_on
from .trial_loop import SEEN_BY
from .trials import Array, trial_kernel

if TYPE_CHECKING:
    from ..study.record import JiaoStudy

# Of the compiled loop of a law MPC uses the train alone, which is the same for all.
LAW = "jiao2025.icfdl"


def _curve(speed: Array, step_s: float) -> DesiredCurve:
    """Through the speeds of (16) at the samples; the acceleration begins and ends at zero within one of them."""
    rate = np.gradient(speed, step_s)
    rate[0] = rate[-1] = 0.0
    ways = step_s * (speed[1:] + speed[:-1]) / 2 + step_s**2 * (rate[:-1] - rate[1:]) / 12
    places = accumulate((float(way) for way in ways), initial=0.0)
    return curve_through(tuple(Row(k * step_s, s, float(v), float(a))
                               for k, (s, v, a) in enumerate(zip(places, speed, rate, strict=True))))


def run_mpc(study: JiaoStudy, reading: str, kind: str, factors: Factors = NOMINAL) -> dict[str, Any]:
    """A trip as a row, SI units; MPC knows mass and mean resistance, and neither grades nor their changes.

    factors: by which mass and resistance (`davis_a`) of the train differ from what MPC knows.
    """
    case, data = Case(reading, LAW, study.trials.seed), study.mpc
    stated, of = plan(study, case), plan_on(study, case, factors)
    assert data is not None
    data = data.model_copy(update={"period_s": of.step_s})
    mean = [float(pair[0]) / stated.divisor for pair in plant.davis_newton.values()]
    curve = _curve(of.desired, of.step_s)
    mpc = controller(known(data, curve, stated.mass_kg, (mean[0], mean[1], mean[2]), curve.trip_time_s), kind)
    kernel, train = trial_kernel(LAW, False), np.array([of.step_s, of.mass_kg, of.unit_n, of.divisor])
    length, seen_by = len(of.desired) - 1, SEEN_BY.index(of.seen_by)
    speed, taken, place, met = np.zeros(length + 1), np.zeros(length), 0.0, 0.0
    for j in range(length):
        before = time.perf_counter()
        command = mpc.command(j * of.step_s, place, speed[j])
        taken[j] = time.perf_counter() - before
        force = kernel.additional_force(j, length, met, seen_by, of.desired_positions, of.edges, of.additional_n)
        speed[j + 1] = kernel.step_speed(speed[j], command * stated.mass_kg / of.unit_n, force, j * of.k_per_sample,
                                         train)
        met = kernel.step_position(met, speed[j], train)
        place += of.step_s * (speed[j] + speed[j + 1]) / 2  # what an odometer shows; (1) needs no position
    error, jerk = of.desired[1:] - speed[1:], jerk_rms(speed, of.step_s)
    return {"failed": None, "speed_rms": float(np.sqrt(np.mean(error**2))), "jerk_rms": jerk, "logged_jerk_rms": jerk,
            "largest_mps": float(np.abs(error).max()), "step_s": float(np.median(taken)),
            "counters": dict(mpc.counters)}
