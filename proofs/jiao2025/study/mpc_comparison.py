"""jiao2025's trip driven by MPC: one trial that knows the train, beside the trials that learn it."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate

import numpy as np

from workbench.files.numbers import number
from workbench.model.curve_table import Row, curve_through
from workbench.model.desired_curve import DesiredCurve
from workbench.mpc.controller import KINDS
from workbench.paper.mpc_comparison import KINDS_BESIDE, controller, counters_words, known
from workbench.paper.results import ResultTable
from workbench.simulate.closed_loop import NOMINAL, Factors

from .. import plant
from ..laws import TRIAL_LAWS
from ..simulation.trial_loop import SEEN_BY
from ..simulation.trials import Array, TrialPlan, TrialRun, trial_kernel
from .cases import PRINTED_LAWS, Case, JiaoStudy, plan
from .outcomes import Found, mse, outcome


@dataclass(frozen=True)
class Beside:
    """MPC of a kind on the trip of a reading: mean and largest error, time of a step, what it counted.

    mse: mean of e^2 over the samples, as of a trial, m^2/s^2; jerk: RMS of the second difference of the speed, m/s^3.
    """

    reading: str
    kind: str
    mse: float
    largest_mps: float
    jerk: float
    step_us: float
    counters: dict[str, int]


Task = tuple[str, str]


def _of_trip(study: JiaoStudy, reading: str) -> tuple[float, float]:
    """What of a reading MPC's trip depends on; the unit of u is none of it."""
    return study.readings[reading].step_s, study.readings[reading].k_per_sample


def beside_tasks(study: JiaoStudy) -> list[Task]:
    """Every kind on every trip that differs; none where the file states no MPC."""
    trips = {_of_trip(study, name): name for name in reversed(study.readings)}
    return [(name, kind) for name in study.readings if name in trips.values() for kind in KINDS_BESIDE
            ] if study.mpc else []


def _curve(speed: Array, step_s: float) -> DesiredCurve:
    """Through the speeds of (16) at the samples; the acceleration begins and ends at zero within one of them."""
    rate = np.gradient(speed, step_s)
    rate[0] = rate[-1] = 0.0
    ways = step_s * (speed[1:] + speed[:-1]) / 2 + step_s**2 * (rate[:-1] - rate[1:]) / 12
    places = accumulate((float(way) for way in ways), initial=0.0)
    return curve_through(tuple(Row(k * step_s, s, float(v), float(a))
                               for k, (s, v, a) in enumerate(zip(places, speed, rate, strict=True))))


def run_one(study: JiaoStudy, task: Task, factors: Factors = NOMINAL) -> Beside:
    """One trip of the desired length; MPC knows mass and mean resistance, and neither grades nor their changes.

    factors: by which mass and resistance (`davis_a`) of the train differ from what MPC knows.
    """
    name, kind = task
    stated, data = plan(study, Case(name, PRINTED_LAWS[0], study.trials.seed)), study.mpc
    of = true_plan(study, Case(name, PRINTED_LAWS[0], study.trials.seed), factors)
    assert data is not None
    data = data.model_copy(update={"period_s": of.step_s})
    mean = [float(pair[0]) / stated.divisor for pair in plant.davis_newton.values()]
    curve = _curve(of.desired, of.step_s)
    mpc = controller(known(data, curve, stated.mass_kg, (mean[0], mean[1], mean[2]), curve.trip_time_s), kind)
    kernel, train = trial_kernel(PRINTED_LAWS[0], False), np.array([of.step_s, of.mass_kg, of.unit_n, of.divisor])
    length, seen_by = len(of.desired) - 1, SEEN_BY.index(of.seen_by)
    speed, taken, place, met = np.zeros(length + 1), np.zeros(length), 0.0, 0.0
    for j in range(length):
        before = time.perf_counter()
        command = mpc.command(j * of.step_s, place, speed[j])
        taken[j] = 1e6 * (time.perf_counter() - before)
        force = kernel.additional_force(j, length, met, seen_by, of.desired_positions, of.edges, of.additional_n)
        speed[j + 1] = kernel.step_speed(speed[j], command * stated.mass_kg / of.unit_n, force, j * of.k_per_sample,
                                         train)
        met = kernel.step_position(met, speed[j], train)
        place += of.step_s * (speed[j] + speed[j + 1]) / 2  # what an odometer shows; (1) needs no position
    error = of.desired[1:] - speed[1:]
    return Beside(name, kind, float(np.mean(error**2)), float(np.abs(error).max()), jerk_rms(speed, of.step_s),
                  float(np.median(taken)), dict(mpc.counters))


def true_plan(study: JiaoStudy, case: Case, factors: Factors) -> TrialPlan:
    """The plan of a run on a train whose mass and resistance (`davis_a`) differ by factors from what is stated."""
    train = study.train.model_copy(update={"mass_kg": study.train.mass_kg * factors.mass})
    of = plan(study.model_copy(update={"train": train}), case)
    return replace(of, divisor=of.divisor / factors.davis_a)


def jerk_rms(speed: Array, step_s: float) -> float:
    """RMS of the second difference of speeds at the samples, m/s^3."""
    return float(np.sqrt(np.mean((np.diff(speed, 2) / step_s**2) ** 2)))


def overtaken(run: TrialRun, rival: float) -> int | None:
    """The trial from which on all mean squared errors are below a rival's, None where there is none."""
    above = np.nonzero(mse(run) >= rival)[0]
    first = int(above[-1]) + 1 if len(above) else 0
    return first if run.failed is None and first < len(run.rows) else None


def _rivals(found: Found, runs: Sequence[Beside], reading: str) -> list[Beside]:
    trip = _of_trip(found.study, reading)
    return [one for one in runs if _of_trip(found.study, one.reading) == trip]


def beside_table(found: Found, runs: Sequence[Beside]) -> Iterator[ResultTable]:
    """A row per reading and law: what is learned, MPC's error, and the trial that is ahead of it."""
    if not runs or found.study.mpc is None:
        return
    rows = []
    for name, reading in found.study.readings.items():
        rivals = _rivals(found, runs, name)
        for law in PRINTED_LAWS:
            run = found.run(name, law)
            cells = [f"{number(rival.mse)}: " + (
                "—" if run.failed is not None else f"trial {trial}" if (
                    trial := overtaken(run, rival.mse)) is not None else "no") for rival in rivals]
            last = number(float(mse(run)[-1])) if run.failed is None else outcome(run)
            rows.append((reading.title, TRIAL_LAWS[law].title, last, *cells,
                         ", ".join(number(rival.jerk) for rival in rivals),
                         ", ".join(number(rival.step_us) for rival in rivals), number(run.step_us)))
    titles = [KINDS[kind].title for kind in KINDS_BESIDE]
    yield ResultTable(
        "Beside MPC: at which trial learning overtakes it", "comparison",
        ("reading", "law", "MSE, last trial", *(f"{title}, MSE: overtaken" for title in titles),
         "jerk RMS of MPC (m/s³)", "µs a step of MPC", "µs a sample of the law"), tuple(rows),
        f"In m²/s². No: not within {found.study.trials.count} trials. MPC drives the same train once, at T_s, "
        f"{found.study.mpc.horizon} samples ahead: {KINDS[KINDS_BESIDE[0]].information}; the laws: speeds of earlier "
        f"trials, model unknown. Neither has limits. MPC counted {counters_words([one.counters for one in runs])}.")


def beside_findings(found: Found, runs: Sequence[Beside]) -> Iterator[str]:
    """How often and when each law overtakes each kind of MPC."""
    for law in PRINTED_LAWS if runs else ():
        finish = [name for name in found.study.readings if found.run(name, law).failed is None]
        words = []
        for kind in KINDS_BESIDE:
            when = [overtaken(found.run(name, law), rival.mse) for name in finish
                    for rival in _rivals(found, runs, name) if rival.kind == kind]
            ahead = sorted(trial for trial in when if trial is not None)
            words.append(f"{KINDS[kind].title} in {len(ahead)}" + (
                f" (at trials {', '.join(map(str, ahead))})" if ahead else ""))
        yield (f"Beside MPC, which knows the train and drives it once: {TRIAL_LAWS[law].title} finishes in "
               f"{len(finish)} of {len(found.study.readings)} readings and overtakes {' and '.join(words)} of them "
               f"within {found.study.trials.count} trials.")
