"""What a reader of chen2019's study should know, every number from its runs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import fixed, number
from workbench.paper.findings import needed, required, some
from workbench.paper.learning_comparison import rises

from ..simulation.cars_trials import CarsRun
from ..simulation.formulas import allowed_change, alternating_growth, cef_change, needed_force, trailer_force
from .runs import ChenResults, outcome


def _ends(run: CarsRun) -> str:
    """Largest errors in the first and the last finished trial."""
    return " and ".join(f"{number(float(errors[0]))} {unit} → {number(float(errors[-1]))} {unit}"
                        for errors, unit in ((run.position_error, "m"), (run.speed_error, "m/s")))


def _kilonewtons(run: CarsRun, trial: int) -> str:
    return f"{number(float(run.difference[trial - 1]) / 1e3)} kN"


def _became(run: CarsRun) -> str:
    """Its errors and its outcome; the outcome alone where no trial was finished."""
    return f"{_ends(run)} ({outcome(run)})" if len(run.totals) else outcome(run)


def _learning(results: ChenResults) -> Iterator[str]:
    run, count = results.stated, len(results.stated.totals)
    if run.failed is not None:
        yield f"The stated run ends early: {run.failed}."
    if count < 2:
        return
    up = rises(run.position_error) + rises(run.speed_error)
    steps = "in every step" if up == 0 else f"rising in {up} of {2 * count - 2} steps"
    yield (f"Over {count} of {results.study.trials.count} iterations the largest errors of all cars go {_ends(run)}, "
           f"{steps}; |Δu| goes {_kilonewtons(run, 1)} → {_kilonewtons(run, count)}. The paper says of its Figures "
           "1-9 that they fall; it prints no numbers.")


def _further(results: ChenResults) -> Iterator[str]:
    """Runs with more iterations than the paper's."""
    for count, run in results.with_more_trials():
        if len(run.totals):
            yield (f"With {count} iterations: {_became(run)}, |Δu| at the end {_kilonewtons(run, len(run.totals))}. "
                   "The paper expects further iterations to reduce the errors.")


def _sampling(results: ChenResults) -> str:
    study, stated = results.study, results.stated
    half, cruise = study.sampling.period_s / 2, study.reference.cruise_mps
    same = needed(results.with_values(sampling__memory="same_sample"))
    finer = needed(results.with_values(sampling__memory="same_sample", sampling__period_s=half))
    required(not stated.failed and not finer.failed and len(same.totals) > 0)
    fast, answered = alternating_growth(study, cruise)
    # Up to which speed the stated memory rule lets no alternating error grow.
    place = 0 if study.sampling.memory == "same_sample" else 1
    speeds = map(float, np.linspace(0.0, cruise, 200))
    safe = min((speed for speed in speeds if alternating_growth(study, speed)[place] >= 1), default=cruise)
    reached = len(same.totals)
    did = outcome(same)
    if same.failed is not None:
        did = f"ends in trial {reached + 1} ({did.partition(': ')[2]})"
    apart = float(abs(stated.position_error[-1] / finer.position_error[-1] - 1))
    return (f"The learning rules are for continuous time. With the error of the same sample, every {2e3 * half:g} ms, "
            f"the run {did}: |Δu| is {_kilonewtons(same, reached)} in trial {reached} (as stated "
            f"{_kilonewtons(stated, reached)}). While the first car is at its limit, an error that alternates from "
            f"sample to sample can become up to {number(fast)} times as large in the next trial at {cruise:g} m/s, "
            f"where γ_a v⁴ of (18) dominates; with the error of the next sample {number(answered)} times, and less than "
            f"once below {number(safe)} m/s. Every {1e3 * half:g} ms the error of the same sample learns "
            f"like the stated run: their last position errors differ by {number(100 * apart, 2)} %.")


def _acceleration(results: ChenResults) -> str:
    rules = {"that of the sample before": results.with_values(sampling__acceleration="sampled"),
             "filtered with 0.01 s": results.with_values(sampling__acceleration="filtered", sampling__filter_s=0.01),
             f"filtered with {results.study.sampling.filter_s:g} s": results.with_values(sampling__acceleration="filtered")}
    words = some(f"{name}: {_became(run)}" for name, run in rules.items() if run is not None)
    return f"Other rules for the acceleration that (16) uses: {'; '.join(words)}."


def _gains(results: ChenResults) -> Iterator[str]:
    exact, smaller = results.with_values(gains__c_1=1.0), results.with_values(gains__c_3=0.01)
    if exact is not None and len(results.stated.totals):
        yield (f"The stated c_1 = {results.study.gains.c_1:g} breaks the paper's own condition c_lambda > 0 (claim "
               f"49.stated). With c_1 = 1, which meets it: {_became(exact)}.")
    scaled = "".join(f"; with the learning factors γ c_3 kept as stated: {_became(run)}"
                     for change, run in results.group("gains")
                     if change.set.get("gains.c_3") == 0.01 and len(change.set) > 1)
    if smaller is not None:
        yield (f"With c_3 = 1/100, for which the loop is unique up to 100 kg above the mass: {_became(smaller)}"
               f"{scaled}.")


def _masses(results: ChenResults) -> str:
    ended = some(f"{change.title}: {outcome(run)}" for change, run in results.group("masses") if run.failed)
    return ("The paper states no bounds of the mass. Where they let an estimate exceed the mass by 1/c_3 = "
            f"{number(1 / results.study.gains.c_3)} kg, the loop through the acceleration may lose its unique "
            f"solution (claims 16.unique, 16.stated): {'; '.join(ended)}.")


def _trailers(results: ChenResults) -> str:
    study, run, ref = results.study, results.stated, results.study.reference
    motors, trailers = results.motors_and_trailers
    need, limit = needed_force(study, ref.cruise_mps, ref.acceleration_mps2), len(motors) * study.train.traction_n
    text = (f"The assumed reference asks for {number(need / 1e3)} of {number(limit / 1e3)} kN at {ref.cruise_mps:g} "
            f"m/s: the train as a whole {'can' if need <= limit else 'cannot'} follow it")
    if trailers:
        text += (f"; a trailer cannot by itself, it needs {number(trailer_force(study, ref.cruise_mps, 0.0))} N "
                 "forwards even at cruise (claim A2)")
    if trailers and len(run.totals):
        stretch = number(1e3 * float(run.total("coupler_stretch_m")[-1]))
        text += f". In the last trial the couplers are stretched by up to {stretch} mm to pull the trailers"
    last = max(study.trials.shown)
    if last in run.logs:
        time_s = float(np.argmax(np.abs(run.log(last, "speed_error_mps")).max(axis=1))) * study.sampling.log_every_s
        text += (f". The largest speed error of trial {last} stands at {number(time_s, 4)} s, where the reference has "
                 f"{number(float(ref.curve().at(np.array([time_s]))[2][0]))} m/s²")
    return f"{text}."


def _energy(results: ChenResults) -> Iterator[str]:
    run = results.stated
    required(len(run.totals) > 0)
    change, allowed = cef_change(run), allowed_change(results.study, run)
    yield (f"The energy function (25) of the stated run falls by at least what (35) promises in "
           f"{int(np.sum(change <= allowed))} of {len(change)} trials.")
    broken = []
    for one, other in results.group("rules"):
        lost = np.flatnonzero(cef_change(other) > allowed_change(results.study, other))
        if len(lost):
            broken.append(f"{one.title}, first in trial {lost[0] + 1}")
    if broken:
        yield f"With these rules it does not in every trial: {'; '.join(broken)}."


def _place(results: ChenResults) -> str:
    time, place = (needed(results.with_values(line__seen_by=by)) for by in ("reference", "train"))
    return ("Slopes act where the train is, while (31) takes them for a function of time alone (claim 31.place). With "
            f"{results.study.line.slope_permille:g} ‰ as a function of time: {_became(time)}; where the car is: "
            f"{_became(place)}.")


def _assumed(results: ChenResults) -> str:
    group = results.group("assumed")
    runs = some(run for change, run in group if run.failed is None and "trials.count" not in change.set)
    first, last = (sorted(float(run.position_error[i]) for run in runs) for i in (0, -1))
    speeds = sorted(float(run.speed_error[-1]) for run in runs)
    early = "".join(f"; {change.title}: {outcome(run)}" for change, run in group if run.failed is not None)
    return (f"{len(runs)} other assumed references, slopes, coefficients and initial auxiliary states leave largest "
            f"position errors of {number(first[0])} to {number(first[-1])} m in trial 1 and {number(last[0])} to "
            f"{number(last[-1])} m in trial {results.study.trials.count}, speed errors of {number(speeds[0])} to "
            f"{number(speeds[-1])} m/s then{early}.")


def _speed(results: ChenResults) -> str:
    run, measured = results.stated, results.measured
    fewest = min(measured.by_length)
    return (f"A million samples of {fewest} cars take {number(1e6 * measured.sample_s[fewest])} s, train and law "
            f"together; the stated run's learned estimates, one set per sample, take {number(run.memory_bytes / 1e6)} "
            f"MB. From {fewest} to {max(measured.sample_s)} cars the time of a sample grows as the number of cars to "
            f"the power {fixed(measured.exponent, 2)}.")


FINDINGS = (_learning, _further, _sampling, _acceleration, _gains, _masses, _trailers, _energy, _place, _assumed,
            _speed)
