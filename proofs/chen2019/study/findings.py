"""What a reader of chen2019's study should know, every number from its runs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import fixed, number

from ..simulation.cars_trials import CarsRun
from .outcomes import (
    Found,
    allowed_change,
    alternating_growth,
    cef_change,
    difference,
    exponent,
    largest_speed_error_at,
    needed_force,
    outcome,
    position_error,
    rises,
    speed_error,
    trailer_force,
)


def all_findings(found: Found) -> Iterator[str]:
    """A sentence or a few each; one whose runs the study does not have is left out."""
    yield from _learning(found)
    yield from _further(found)
    yield from _sampling(found)
    yield from _acceleration(found)
    yield from _gains(found)
    yield from _masses(found)
    yield from _trailers(found)
    yield from _energy(found)
    yield from _place(found)
    yield from _assumed(found)
    yield _speed(found)


def _ends(run: CarsRun) -> str:
    """Largest errors in the first and the last finished trial."""
    p, v = position_error(run), speed_error(run)
    return (f"{number(float(p[0]))} m → {number(float(p[-1]))} m and {number(float(v[0]))} m/s → "
            f"{number(float(v[-1]))} m/s")


def _kilonewtons(run: CarsRun, trial: int) -> str:
    return f"{number(float(difference(run)[trial - 1]) / 1e3)} kN"


def _became(run: CarsRun) -> str:
    """Its errors and its outcome; the outcome alone where no trial was finished."""
    return f"{_ends(run)} ({outcome(run)})" if len(run.totals) else outcome(run)


def _learning(found: Found) -> Iterator[str]:
    run, last = found.stated, found.study.trials.count
    if run.failed is not None:
        yield f"The stated run ends early: {run.failed}."
    if len(run.totals) < 2:
        return
    up = rises(position_error(run)) + rises(speed_error(run))
    steps = "in every step" if up == 0 else f"rising in {up} of {2 * len(run.totals) - 2} steps"
    yield (f"Over {len(run.totals)} of {last} iterations the largest errors of all cars go {_ends(run)}, {steps}; "
           f"|Δu| goes {_kilonewtons(run, 1)} → {_kilonewtons(run, len(run.totals))}. The paper says of its Figures "
           "1-9 that they fall; it prints no numbers.")


def _further(found: Found) -> Iterator[str]:
    """Runs with more iterations than the paper's."""
    for change, run in found.group("assumed"):
        if set(change.set) == {"trials.count"} and len(run.totals):
            yield (f"With {change.set['trials.count']} iterations: {_became(run)}, |Δu| at the end "
                   f"{_kilonewtons(run, len(run.totals))}. The paper expects further iterations to reduce the errors.")


def _sampling(found: Found) -> Iterator[str]:
    half = found.study.sampling.period_s / 2
    same = found.find(sampling__memory="same_sample")
    finer = found.find(sampling__memory="same_sample", sampling__period_s=half)
    if same is None or finer is None or found.stated.failed or finer.failed or not len(same.totals):
        return
    cruise = found.study.reference.cruise_mps
    fast, answered = alternating_growth(found.study, cruise)
    reached = len(same.totals)
    apart = float(abs(position_error(found.stated)[-1] / position_error(finer)[-1] - 1))
    yield (f"The learning rules are for continuous time. With the error of the same sample, every {2e3 * half:g} ms, "
           f"the run {_did(same)}: |Δu| is {_kilonewtons(same, reached)} in trial {reached} (as stated "
           f"{_kilonewtons(found.stated, reached)}). While the first car is at its limit, an error that alternates "
           f"from sample to sample can become up to {number(fast)} times as large in the next trial at {cruise:g} m/s, "
           f"where γ_a v⁴ of (18) dominates; with the error of the next sample {number(answered)} times, and less than "
           f"once below {number(_safe_speed(found))} m/s. Every {1e3 * half:g} ms the error of the same sample learns "
           f"like the stated run: their last position errors differ by {number(100 * apart, 2)} %.")


def _safe_speed(found: Found) -> float:
    """The speed, m/s, up to which the stated memory rule lets no alternating error grow."""
    speeds = np.linspace(0.0, found.study.reference.cruise_mps, 200)
    place = 0 if found.study.sampling.memory == "same_sample" else 1
    growing = [speed for speed in speeds if alternating_growth(found.study, float(speed))[place] >= 1]
    return float(min(growing, default=found.study.reference.cruise_mps))


def _did(run: CarsRun) -> str:
    if run.failed is not None:
        return f"ends in trial {len(run.totals) + 1} ({outcome(run).partition(': ')[2]})"
    return outcome(run)


def _acceleration(found: Found) -> Iterator[str]:
    words = []
    for values, name in (
            ({"sampling__acceleration": "sampled"}, "that of the sample before"),
            ({"sampling__acceleration": "filtered", "sampling__filter_s": 0.01}, "filtered with 0.01 s"),
            ({"sampling__acceleration": "filtered"}, f"filtered with {found.study.sampling.filter_s:g} s")):
        run = found.find(**values)
        if run is not None:
            words.append(f"{name}: {_became(run)}")
    if words:
        yield f"Other rules for the acceleration that (16) uses: {'; '.join(words)}."


def _gains(found: Found) -> Iterator[str]:
    exact = found.find(gains__c_1=1.0)
    if exact is not None and len(found.stated.totals):
        yield (f"The stated c_1 = {found.study.gains.c_1:g} breaks the paper's own condition c_λ > 0 (claim "
               f"49.stated). With c_1 = 1, which meets it: {_became(exact)}.")
    smaller = found.find(gains__c_3=0.01)
    scaled = next((run for change, run in found.group("gains") if change.set.get("gains.c_3") == 0.01
                   and len(change.set) > 1), None)
    if smaller is not None:
        text = f"With c_3 = 1/100, for which the loop is unique up to 100 kg above the mass: {_became(smaller)}"
        if scaled is not None:
            text += f"; with the learning factors γ c_3 kept as stated: {_became(scaled)}"
        yield f"{text}."


def _masses(found: Found) -> Iterator[str]:
    ended = [(change.title, run) for change, run in found.group("masses") if run.failed is not None]
    if ended:
        words = "; ".join(f"{name}: {outcome(run)}" for name, run in ended)
        yield ("The paper states no bounds of the mass. Where they let an estimate exceed the mass by 1/c_3 = "
               f"{number(1 / found.study.gains.c_3)} kg, the loop through the acceleration may lose its unique "
               f"solution (claims 16.unique, 16.stated): {words}.")


def _trailers(found: Found) -> Iterator[str]:
    study, run = found.study, found.stated
    ref = study.reference
    motors, trailers = found.motors_and_trailers
    need, given = needed_force(study, ref.cruise_mps, ref.acceleration_mps2), len(motors) * study.train.traction_n
    text = (f"The assumed reference asks for {number(need / 1e3)} of {number(given / 1e3)} kN at {ref.cruise_mps:g} "
            f"m/s: the train as a whole {'can' if need <= given else 'cannot'} follow it")
    if trailers:
        text += (f"; a trailer cannot by itself, it needs {number(trailer_force(study, ref.cruise_mps, 0.0))} N "
                 "forwards even at cruise (claim A2)")
    if trailers and len(run.totals):
        stretch = number(1e3 * float(run.total("coupler_stretch_m")[-1]))
        text += f". In the last trial the couplers are stretched by up to {stretch} mm to pull the trailers"
    last = max(study.trials.shown)
    if last in run.logs:
        time_s, rate = largest_speed_error_at(found, last)
        text += (f". The largest speed error of trial {last} stands at {number(time_s, 4)} s, where the reference has "
                 f"{number(rate)} m/s²")
    yield f"{text}."


def _energy(found: Found) -> Iterator[str]:
    run = found.stated
    if not len(run.totals):
        return
    change, allowed = cef_change(run), allowed_change(found.study, run)
    text = (f"The energy function (25) of the stated run falls by at least what (35) promises in "
            f"{int(np.sum(change <= allowed))} of {len(change)} trials")
    broken = []
    for one, other in found.group("rules"):
        lost = np.flatnonzero(cef_change(other) > allowed_change(found.study, other))
        if len(lost):
            broken.append(f"{one.title}, first in trial {lost[0] + 1}")
    if broken:
        text += f"; not with these rules: {'; '.join(broken)}"
    yield f"{text}."


def _place(found: Found) -> Iterator[str]:
    time, place = (found.find(line__seen_by=by) for by in ("reference", "train"))
    if time is not None and place is not None:
        yield ("Slopes act where the train is, while (31) takes them for a function of time alone (claim 31.place). "
               f"With {found.study.line.slope_permille:g} ‰ as a function of time: {_became(time)}; where the car is: "
               f"{_became(place)}.")


def _assumed(found: Found) -> Iterator[str]:
    count = found.study.trials.count
    runs = [run for change, run in found.group("assumed") if run.failed is None and "trials.count" not in change.set]
    early = [(change.title, run) for change, run in found.group("assumed") if run.failed is not None]
    if not runs:
        return
    first, last = (sorted(float(position_error(run)[i]) for run in runs) for i in (0, -1))
    speeds = sorted(float(speed_error(run)[-1]) for run in runs)
    text = (f"{len(runs)} other assumed references, slopes, coefficients and initial auxiliary states leave largest "
            f"position errors of {number(first[0])} to {number(first[-1])} m in trial 1 and {number(last[0])} to "
            f"{number(last[-1])} m in trial {count}, speed errors of {number(speeds[0])} to {number(speeds[-1])} m/s "
            "then")
    if early:
        text += "; " + "; ".join(f"{name}: {outcome(run)}" for name, run in early)
    yield f"{text}."


def _speed(found: Found) -> str:
    run, study = found.stated, found.study
    step = float(run.step_us.min())
    lengths = [point.cars for point in found.cost]
    return (f"A million samples of {study.train.cars} cars take {number(step)} s in the fastest trial of the stated "
            f"run, train and law together; its learned estimates, one set per sample, take "
            f"{number(run.memory_bytes / 1e6)} MB. From {min(lengths)} to {max(lengths)} cars the time of a sample "
            f"grows as the number of cars to the power {fixed(exponent(found.cost), 2)}.")
