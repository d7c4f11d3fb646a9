"""What a reader should know of jiao2025's runs, a sentence or two each, every number from the runs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import number
from workbench.paper.findings import required, some
from workbench.paper.learning_comparison import rises

from ..simulation.plans import desired_trip
from ..simulation.trials import TrialRun
from .runs import ICFDL, PD, PRINTED_LAWS, JiaoResults, mse_at, outcome, peak


def _ends(*runs: TrialRun) -> list[float]:
    """The MSE after the last trial of the runs that end."""
    return [float(run.mse[-1]) for run in runs if run.failed is None]


def _by_outcome(results: JiaoResults) -> str:
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
    return (f"The paper states neither the unit of u nor what k counts, and they decide the outcome. Of "
            f"{len(results.study.readings)} readings with the stated parameters {'. Of the same, '.join(parts)}.")


def _order(results: JiaoResults) -> str:
    """Whether Figure 7's order comes out where both laws finish."""
    of_both = {stated.label: _ends(*(results.run(reading, law) for law in PRINTED_LAWS))
               for reading, stated in results.study.readings.items()}
    both = {name: ends for name, ends in of_both.items() if len(ends) == len(PRINTED_LAWS)}
    listed = "; ".join(f"{name}: {number(ours)} against {number(theirs)}" for name, (ours, theirs) in both.items())
    lower = [name for name, (ours, theirs) in both.items() if ours < theirs]
    verdict = f"holds with u in {'; '.join(lower)}" if lower else "holds in none of them"
    return (f"Figure 7 puts iCFDL-MFAILC below PD. Both laws finish in {len(both)} readings, and after the last trial "
            f"that {verdict} (MSE in m²/s², {listed}).")


def _mixed_units(results: JiaoResults) -> str:
    """Each law in the unit in which it learns."""
    ours = [(entry, run) for entry, run in results.shown() if entry.law == ICFDL and outcome(run) == "learns"]
    theirs = [(entry, run) for entry, run in results.shown() if entry.law == PD and run.failed is None]
    (one, first), (other, second) = some(ours)[0], some(theirs)[0]
    required(one.reading != other.reading)
    units = [results.study.readings[entry.reading].label for entry in (one, other)]
    return (f"The printed order does come out when iCFDL-MFAILC has u in {units[0]} and PD in {units[1]}: below in "
            f"{int(np.sum(first.mse[1:] < second.mse[1:]))} of {results.study.trials.count} trials, "
            f"{number(float(first.mse[-1]))} against {number(float(second.mse[-1]))} m²/s² after the last.")


def _one_unit(results: JiaoResults) -> Iterator[str]:
    """Where along the units of u the printed order comes out."""
    study = results.study
    units = [float(unit) for unit in study.unit_sweep.units_mps2]
    for reading in study.unit_sweep.readings:
        both = {unit: _ends(*(results.run(reading, law, unit_mps2=unit) for law in PRINTED_LAWS)) for unit in units}
        whole = {unit: ends for unit, ends in both.items() if len(ends) == len(PRINTED_LAWS)}
        lower = [unit for unit, (ours, theirs) in whole.items() if ours < theirs]
        words = f"at {len(lower)} of them ({', '.join(map(number, lower))} m/s²)" if lower else "at none of them"
        yield (f"Over {len(units)} units of u from {number(units[0])} to {number(units[-1])} m/s², steps of "
               f"{study.readings[reading].step_s:g} s, both laws finish at {len(whole)}, and iCFDL-MFAILC ends below "
               f"PD {words}.")


def _transient(results: JiaoResults) -> Iterator[str]:
    """Growth before the fall, and how steady the fall is."""
    last = results.study.trials.count
    for entry, run in results.shown():
        if run.failed is not None:
            continue
        trial, ratio = peak(run)
        grown = (f"the MSE first grows to {number(ratio)} times that of trial 0 (trial {trial})" if trial > 0
                 else "the MSE is largest in trial 0")
        whole = results.changing("trials.shortest_length_k", reading=entry.reading, law=entry.law)
        worse = f"worse than in the trial before in {rises(run.mse)} of {last} trials" + "".join(
            f" (in {rises(other.mse)} when every trial has the desired length)" for other in whole.values())
        yield (f"{results.title(entry)}: {grown}, is {number(float(run.mse[-1]))} m²/s² after the last and {worse}; "
               "the text reads “better every time” off its figures.")


def _end_of_trip(results: JiaoResults) -> Iterator[str]:
    """How much of the error lies where not every trial has data."""
    trials = results.study.trials
    for entry, run in results.shown():
        reading, shares = results.study.readings[entry.reading], []
        wanted = desired_trip(results.study, reading)[0]
        for trial in trials.compared:
            if trial in run.samples and outcome(run) == "learns":
                speed = run.sample(trial, "speed")
                squares = (wanted[: len(speed)] - speed) ** 2
                late = float(squares[trials.shortest_length_k * reading.per_k + 1:].sum() / squares.sum())
                ends = (len(speed) - 1) // reading.per_k
                shares.append(f"{number(100 * late, 2)} % in trial {trial} (to k = {ends})")
        if shares:
            yield (f"{results.title(entry)}: of the squared error {' and '.join(shares)} lies beyond k = "
                   f"{trials.shortest_length_k}, which not every trial reaches (claims remark5.end, 15.reset).")


def _backwards(results: JiaoResults) -> Iterator[str]:
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


def _theorem(results: JiaoResults) -> str:
    """Whether Theorem 1's condition tells where the laws diverge."""
    study, learning = results.study, results.study.learning
    met = {name: learning.lamda > (learning.rho * reading.step_s * reading.unit_n / study.train.mass_kg) ** 2 / 16
           for name, reading in study.readings.items()}
    diverging = [name for name in met if results.run(name, ICFDL).failed is not None]
    return (f"Theorem 1 asks λ > λ_min; with the least bound that (1) allows, p = T_s/M, that is met in "
            f"{sum(met.values())} of {len(met)} readings. iCFDL-MFAILC diverges in {len(diverging)}, and in "
            f"{sum(met[name] for name in diverging)} of these it is met, which is not enough for a train that breaks "
            "Assumptions 2 and 4 (claims A2.every, A4.train, theorem1.train.lambda).")


def _mending(results: JiaoResults) -> Iterator[str]:
    """What the mended laws do."""
    last = results.study.trials.count
    for reading in results.short_readings():
        label = results.study.readings[reading].label
        printed, mended, learns, remembering = (results.run(reading, law) for law in (
            PD, "jiao2025.pd_difference", ICFDL, "jiao2025.icfdl_remembering"))
        of_mended, of_learns, of_remembering = (
            number(mse_at(run, last)) for run in (mended, learns, remembering))
        if outcome(mended) == "learns":
            yield (f"With K_d on the difference of the errors, as its name says (claim 18.name), the PD law learns "
                   f"with u in {label}: MSE {of_mended} m²/s² after the last trial, where (18) as printed "
                   f"{outcome(printed)} and iCFDL-MFAILC has {of_learns}.")
        if learns.failed is None and remembering.failed is None:
            yield (f"Estimates that outlive a trial cut short (claim 15.reset mended) leave an MSE of "
                   f"{of_remembering} instead of {of_learns} m²/s² with u in {label}.")


def _first_estimates(results: JiaoResults) -> Iterator[str]:
    """How much the unstated first estimate matters."""
    for entry, stated in results.shown():
        others = results.changing("learning.first_estimate", reading=entry.reading, law=entry.law).values()
        ends = _ends(stated, *others)
        if others and ends:
            yield (f"{results.title(entry)}: the first estimate, which the paper does not state, takes the MSE after "
                   f"the last trial from {number(min(ends))} to {number(max(ends))} m²/s².")


def _seeds(results: JiaoResults) -> str:
    """How much the drawn lengths matter."""
    ended = [(entry, ends) for entry in results.study.shown if (ends := _ends(*results.of_seeds(entry)))]
    parts = (f"{results.title(entry)}: {number(min(ends))} to {number(max(ends))}" for entry, ends in ended)
    return (f"The MSE after the last trial over {results.study.trials.seeds} draws of the lengths (m²/s²): "
            f"{'; '.join(parts)}.")


# The most important first.
FINDINGS = (_by_outcome, _order, _mixed_units, _one_unit, _transient, _end_of_trip, _backwards, _theorem, _mending,
            _first_estimates, _seeds)
