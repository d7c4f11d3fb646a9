"""What a reader should know of jiao2025's runs, a sentence or two each, every number from the runs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import number
from workbench.paper.learning_comparison import rises

from ..simulation.plans import Case, desired_trip
from ..simulation.trials import TrialRun
from .runs import ICFDL, PD, Results, mse_at, outcome, peak


def all_findings(results: Results) -> Iterator[str]:
    """All findings, the most important first."""
    for finding in (_by_outcome, _order, _mixed_units, _one_unit, _transient, _end_of_trip, _backwards, _theorem,
                    _mending, _first_estimates, _seeds):
        yield from finding(results)


def _at(run: TrialRun, trial: int) -> str:
    return number(mse_at(run, trial))


def _by_outcome(results: Results) -> Iterator[str]:
    """How many readings come to what."""
    parts = []
    for law, name in ((ICFDL, "iCFDL-MFAILC"), (PD, "the PD law (18)")):
        kinds: dict[str, list[str]] = {}
        for reading, stated in results.study.readings.items():
            run = results.run(reading, law)
            kinds.setdefault("diverges" if run.failed is not None else outcome(run), []).append(stated.label)
        diverging = len(kinds.pop("diverges", []))
        ends = [f"{kind} with u in {'; '.join(of)}" for kind, of in sorted(kinds.items())]
        parts.append(f"{name} " + ", ".join([*ends, f"diverges in {diverging}"]))
    yield (f"The paper states neither the unit of u nor what k counts, and they decide the outcome. Of "
           f"{len(results.study.readings)} readings with the stated parameters {'. Of the same, '.join(parts)}.")


def _order(results: Results) -> Iterator[str]:
    """Whether Figure 7's order comes out where both laws finish."""
    both = {stated.label: tuple(float(results.run(reading, law).mse[-1]) for law in (ICFDL, PD))
            for reading, stated in results.study.readings.items()
            if results.run(reading, ICFDL).failed is None and results.run(reading, PD).failed is None}
    listed = "; ".join(f"{name}: {number(ours)} against {number(theirs)}" for name, (ours, theirs) in both.items())
    lower = [name for name, (ours, theirs) in both.items() if ours < theirs]
    verdict = f"holds with u in {'; '.join(lower)}" if lower else "holds in none of them"
    yield (f"Figure 7 puts iCFDL-MFAILC below PD. Both laws finish in {len(both)} readings, and after the last trial "
           f"that {verdict} (MSE in m²/s², {listed}).")


def _mixed_units(results: Results) -> Iterator[str]:
    """Each law in the unit in which it learns."""
    study, last = results.study, results.study.trials.count
    ours = [e for e in study.shown if e.law == ICFDL and outcome(results.run(e.reading, e.law)) == "learns"]
    theirs = [e for e in study.shown if e.law == PD and results.run(e.reading, e.law).failed is None]
    if ours and theirs and ours[0].reading != theirs[0].reading:
        first, second = results.run(ours[0].reading, ICFDL), results.run(theirs[0].reading, PD)
        count = int(np.sum(first.mse[1:] < second.mse[1:]))
        units = (study.readings[entry.reading].label for entry in (ours[0], theirs[0]))
        yield ("The printed order does come out when iCFDL-MFAILC has u in {} and PD in {}: below in {} of {} trials, "
               "{} against {} m²/s² after the last.").format(*units, count, last, _at(first, last), _at(second, last))


def _one_unit(results: Results) -> Iterator[str]:
    """Where along the units of u the printed order comes out."""
    study = results.study
    units = [float(unit) for unit in study.unit_sweep.units_mps2]
    for reading in study.unit_sweep.readings:
        both = {unit: [results.run(reading, law, unit_mps2=unit) for law in (ICFDL, PD)] for unit in units}
        whole = [unit for unit, runs in both.items() if all(run.failed is None for run in runs)]
        lower = [unit for unit in whole if both[unit][0].mse[-1] < both[unit][1].mse[-1]]
        words = f"at {len(lower)} of them ({', '.join(map(number, lower))} m/s²)" if lower else "at none of them"
        yield (f"Over {len(units)} units of u from {number(units[0])} to {number(units[-1])} m/s², steps of "
               f"{study.readings[reading].step_s:g} s, both laws finish at {len(whole)}, and iCFDL-MFAILC ends below "
               f"PD {words}.")


def _transient(results: Results) -> Iterator[str]:
    """Growth before the fall, and how steady the fall is."""
    study, last = results.study, results.study.trials.count
    whole = [place for place, variant in enumerate(study.variants) if set(variant.set) == {"trials.shortest_length_k"}]
    for entry in study.shown:
        run = results.run(entry.reading, entry.law)
        if run.failed is not None:
            continue
        trial, ratio = peak(run)
        grown = (f"the MSE first grows to {number(ratio)} times that of trial 0 (trial {trial})" if trial > 0
                 else "the MSE is largest in trial 0")
        worse = f"worse than in the trial before in {rises(run.mse)} of {last} trials" + "".join(
            f" (in {rises(results.run(entry.reading, entry.law, variant=place).mse)} when every trial has the desired "
            "length)" for place in whole)
        yield (f"{results.title(entry.reading, entry.law)}: {grown}, is {_at(run, last)} m²/s² after the last and "
               f"{worse}; the text reads “better every time” off its figures.")


def _end_of_trip(results: Results) -> Iterator[str]:
    """How much of the error lies where not every trial has data."""
    trials = results.study.trials
    for entry in results.study.shown:
        run, reading = results.run(entry.reading, entry.law), results.study.readings[entry.reading]
        wanted, shares = desired_trip(results.study, reading)[0], []
        for trial in trials.compared:
            if trial in run.samples and outcome(run) == "learns":
                speed = run.sample(trial, "speed")
                squares = (wanted[: len(speed)] - speed) ** 2
                late = float(squares[trials.shortest_length_k * reading.per_k + 1:].sum() / squares.sum())
                ends = (len(speed) - 1) // reading.per_k
                shares.append(f"{number(100 * late, 2)} % in trial {trial} (to k = {ends})")
        if shares:
            yield (f"{results.title(entry.reading, entry.law)}: of the squared error {' and '.join(shares)} lies "
                   f"beyond k = {trials.shortest_length_k}, which not every trial reaches (claims remark5.end, "
                   "15.reset).")


def _backwards(results: Results) -> Iterator[str]:
    """What a train does that (3) drives backwards, and what is left of it when resistance opposes the motion."""
    for reading in results.short_readings():
        label = results.study.readings[reading].label
        printed, opposed = results.run(reading, ICFDL), results.run(reading, ICFDL, opposed=True)
        lowest = float(printed.column("lowest_speed")[0])
        if lowest < 0:
            yield (f"With u in {label} the first input does not overcome the resistance (claim u0.N): in trial "
                   f"0 the train rolls backwards at up to {number(-lowest)} m/s, since (3) keeps its sign.")
        if printed.failed is not None and len(opposed.rows) > len(printed.rows):
            trial, ratio = peak(opposed)
            yield (f"With u in {label} iCFDL-MFAILC diverges in trial {len(printed.rows)}, because (3) as printed "
                   f"drives a train that rolls backwards. With a resistance that opposes the motion the error norm "
                   f"still grows {number(ratio**0.5)} times (trial {trial}) and the run {outcome(opposed)}: "
                   "what claim intro.growth proves, a factor of ten in one trial, as simulated.")


def _theorem(results: Results) -> Iterator[str]:
    """Whether Theorem 1's condition tells where the laws diverge."""
    study, learning = results.study, results.study.learning
    met = {name: learning.lamda > (learning.rho * reading.step_s * reading.unit_n / study.train.mass_kg) ** 2 / 4
           for name, reading in study.readings.items()}
    diverging = [name for name in met if results.run(name, ICFDL).failed is not None]
    yield (f"Theorem 1 asks λ > λ_min; with the least bound that (1) allows, p = T_s/M, that is met in "
           f"{sum(met.values())} of {len(met)} readings. iCFDL-MFAILC diverges in {len(diverging)}, and in "
           f"{sum(met[name] for name in diverging)} of these it is met, which is not enough for a train that breaks "
           "Assumptions 2 and 4 (claims A2.every, A4, theorem1.train.lambda).")


def _mending(results: Results) -> Iterator[str]:
    """What the mended laws do."""
    last = results.study.trials.count
    for reading in results.short_readings():
        label = results.study.readings[reading].label
        printed, mended, learns, remembering = (results.run(reading, law) for law in (
            PD, "jiao2025.pd_difference", ICFDL, "jiao2025.icfdl_remembering"))
        if outcome(mended) == "learns":
            yield (f"With K_d on the difference of the errors, as its name says (claim 18.name), the PD law learns with u "
                   f"in {label}: MSE {_at(mended, last)} m²/s² after the last trial, where (18) as printed "
                   f"{outcome(printed)} and iCFDL-MFAILC has {_at(learns, last)}.")
        if learns.failed is None and remembering.failed is None:
            yield (f"Estimates that outlive a trial cut short (claim 15.reset mended) leave an MSE of "
                   f"{_at(remembering, last)} instead of {_at(learns, last)} m²/s² with u in {label}.")


def _first_estimates(results: Results) -> Iterator[str]:
    """How much the unstated first estimate matters."""
    study = results.study
    places = [place for place, variant in enumerate(study.variants) if set(variant.set) == {"learning.first_estimate"}]
    for entry in study.shown:
        tried = [Case(entry.reading, entry.law, study.trials.seed, place) for place in places]
        runs = [results.runs[case] for case in tried if case in results.runs]
        ends = [float(run.mse[-1]) for run in (results.run(entry.reading, entry.law), *runs) if run.failed is None]
        if runs and ends:
            yield (f"{results.title(entry.reading, entry.law)}: the first estimate, which the paper does not state, "
                   f"takes the MSE after the last trial from {number(min(ends))} to {number(max(ends))} m²/s².")


def _seeds(results: Results) -> Iterator[str]:
    """How much the drawn lengths matter."""
    parts = []
    for entry in results.study.shown:
        ends = [float(run.mse[-1]) for run in results.of_seeds(entry) if run.failed is None]
        if ends:
            parts.append(f"{results.title(entry.reading, entry.law)}: {number(min(ends))} to {number(max(ends))}")
    yield (f"The MSE after the last trial over {results.study.trials.seeds} draws of the lengths (m²/s²): "
           f"{'; '.join(parts)}.")
