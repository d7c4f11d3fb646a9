"""What a reader should know of jiao2025's runs, a sentence or two each, every number from the runs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from workbench.files.numbers import number

from ..simulation.trials import TrialRun
from .cases import PRINTED_LAWS, Case, desired_trip
from .outcomes import Found, at, ended, mse, outcome, peak, rises

ICFDL, PD = PRINTED_LAWS


def all_findings(found: Found) -> Iterator[str]:
    """All findings, the most important first."""
    yield by_outcome(found)
    yield order(found)
    yield from mixed_units(found)
    yield from one_unit(found)
    yield from transient(found)
    yield from end_of_trip(found)
    yield from backwards(found)
    yield theorem(found)
    yield from mending(found)
    yield from first_estimates(found)
    yield drawn(found)


def by_outcome(found: Found) -> str:
    """How many readings come to what."""
    parts = []
    for law, name in ((ICFDL, "iCFDL-MFAILC"), (PD, "the PD law (18)")):
        kinds: dict[str, list[str]] = {}
        for reading, stated in found.study.readings.items():
            run = found.run(reading, law)
            kinds.setdefault("diverges" if run.failed is not None else outcome(run), []).append(stated.label)
        diverging = len(kinds.pop("diverges", []))
        ends = [f"{kind} with u in {'; '.join(of)}" for kind, of in sorted(kinds.items())]
        parts.append(f"{name} " + ", ".join([*ends, f"diverges in {diverging}"]))
    return (f"The paper states neither the unit of u nor what k counts, and they decide the outcome. Of "
            f"{len(found.study.readings)} readings with the stated parameters {'. Of the same, '.join(parts)}.")


def order(found: Found) -> str:
    """Whether Figure 7's order comes out where both laws finish."""
    both = []
    for reading, stated in found.study.readings.items():
        ours, theirs = found.run(reading, ICFDL), found.run(reading, PD)
        if ours.failed is None and theirs.failed is None:
            both.append((stated.label, float(mse(ours)[-1]), float(mse(theirs)[-1])))
    listed = "; ".join(f"{name}: {number(ours)} against {number(theirs)}" for name, ours, theirs in both)
    lower = [name for name, ours, theirs in both if ours < theirs]
    verdict = f"holds with u in {'; '.join(lower)}" if lower else "holds in none of them"
    return (f"Figure 7 puts iCFDL-MFAILC below PD. Both laws finish in {len(both)} readings, and after the last trial "
            f"that {verdict} (MSE in m²/s², {listed}).")


def mixed_units(found: Found) -> Iterator[str]:
    """Each law in the unit in which it learns."""
    study, last = found.study, found.study.trials.count
    ours = [e for e in study.shown if e.law == ICFDL and outcome(found.run(e.reading, e.law)) == "learns"]
    theirs = [e for e in study.shown if e.law == PD and found.run(e.reading, e.law).failed is None]
    if ours and theirs and ours[0].reading != theirs[0].reading:
        first, second = found.run(ours[0].reading, ICFDL), found.run(theirs[0].reading, PD)
        count = int(np.sum(mse(first)[1:] < mse(second)[1:]))
        units = (study.readings[entry.reading].label for entry in (ours[0], theirs[0]))
        yield ("The printed order does come out when iCFDL-MFAILC has u in {} and PD in {}: below in {} of {} trials, "
               "{} against {} m²/s² after the last.").format(*units, count, last, at(first, last), at(second, last))


def one_unit(found: Found) -> Iterator[str]:
    """Where along the units of u the printed order comes out."""
    study = found.study
    units = [float(unit) for unit in study.unit_sweep.units_mps2]
    for reading in study.unit_sweep.readings:
        def run(law: str, unit: float, of: str = reading) -> TrialRun:
            return found.runs[Case(of, law, study.trials.seed, unit_mps2=unit)]

        whole = [unit for unit in units if run(ICFDL, unit).failed is None and run(PD, unit).failed is None]
        lower = [unit for unit in whole if mse(run(ICFDL, unit))[-1] < mse(run(PD, unit))[-1]]
        words = f"at {len(lower)} of them ({', '.join(map(number, lower))} m/s²)" if lower else "at none of them"
        yield (f"Over {len(units)} units of u from {number(units[0])} to {number(units[-1])} m/s², steps of "
               f"{study.readings[reading].step_s:g} s, both laws finish at {len(whole)}, and iCFDL-MFAILC ends below "
               f"PD {words}.")


def transient(found: Found) -> Iterator[str]:
    """Growth before the fall, and how steady the fall is."""
    study, last = found.study, found.study.trials.count
    whole = [place for place, variant in enumerate(study.variants) if set(variant.set) == {"trials.shortest_length_k"}]
    for entry in study.shown:
        run = found.run(entry.reading, entry.law)
        if run.failed is not None:
            continue
        trial, ratio = peak(run)
        grown = (f"the MSE first grows to {number(ratio)} times that of trial 0 (trial {trial})" if trial > 0
                 else "the MSE is largest in trial 0")
        worse = f"worse than in the trial before in {rises(run)} of {last} trials"
        for place in whole:
            full = found.runs[Case(entry.reading, entry.law, study.trials.seed, place)]
            worse += f" (in {rises(full)} when every trial has the desired length)"
        yield (f"{found.title(entry.reading, entry.law)}: {grown}, is {at(run, last)} m²/s² after the last and "
               f"{worse}; the text reads “better every time” off its figures.")


def end_of_trip(found: Found) -> Iterator[str]:
    """How much of the error lies where not every trial has data."""
    for entry in found.study.shown:
        run, reading = found.run(entry.reading, entry.law), found.study.readings[entry.reading]
        wanted, _ = desired_trip(found.study, reading)
        border = found.study.trials.shortest_length_k * reading.per_k
        shares = []
        for trial in found.study.trials.compared:
            if trial in run.samples and outcome(run) == "learns":
                speed = run.sample(trial, "speed")
                squares = (wanted[: len(speed)] - speed) ** 2
                late = float(squares[border + 1:].sum() / squares.sum())
                ends = (len(speed) - 1) // reading.per_k
                shares.append(f"{number(100 * late, 2)} % in trial {trial} (to k = {ends})")
        if shares:
            yield (f"{found.title(entry.reading, entry.law)}: of the squared error {' and '.join(shares)} lies beyond "
                   f"k = {found.study.trials.shortest_length_k}, which not every trial reaches (claims remark5.end, "
                   "15.reset).")


def backwards(found: Found) -> Iterator[str]:
    """What a train does that (3) drives backwards, and what is left of it when resistance opposes the motion."""
    for reading in found.short_readings():
        stated = found.study.readings[reading]
        printed, opposed = found.run(reading, ICFDL), found.run(reading, ICFDL, opposed=True)
        lowest = float(printed.column("lowest_speed")[0])
        if lowest < 0:
            yield (f"With u in {stated.label} the first input does not overcome the resistance (claim u0.N): in trial "
                   f"0 the train rolls backwards at up to {number(-lowest)} m/s, since (3) keeps its sign.")
        if printed.failed is not None and ended(opposed) > ended(printed):
            trial, ratio = peak(opposed)
            yield (f"With u in {stated.label} iCFDL-MFAILC diverges in trial {ended(printed)}, because (3) as printed "
                   f"drives a train that rolls backwards. With a resistance that opposes the motion the error norm "
                   f"still grows {number(float(np.sqrt(ratio)))} times (trial {trial}) and the run {outcome(opposed)}: "
                   "what claim intro.growth proves, a factor of ten in one trial, as simulated.")


def theorem(found: Found) -> str:
    """Whether Theorem 1's condition tells where the laws diverge."""
    rho, lamda = found.study.learning.rho, found.study.learning.lamda
    met = {name: lamda > (rho * reading.step_s * reading.unit_n / found.study.train.mass_kg) ** 2 / 4
           for name, reading in found.study.readings.items()}
    diverging = [name for name in met if found.run(name, ICFDL).failed is not None]
    kept = sum(met[name] for name in diverging)
    return (f"Theorem 1 asks λ > λ_min; with the least bound that (1) allows, p = T_s/M, that is met in "
            f"{sum(met.values())} of {len(met)} readings. iCFDL-MFAILC diverges in {len(diverging)}, and in {kept} of "
            "these it is met, which is not enough for a train that breaks Assumptions 2 and 4 (claims A2.every, A4, "
            "theorem1.train.lambda).")


def mending(found: Found) -> Iterator[str]:
    """What the mended laws do."""
    last = found.study.trials.count
    for reading in found.short_readings():
        label = found.study.readings[reading].label
        printed, mended = found.run(reading, PD), found.run(reading, "jiao2025.pd_difference")
        learns, kept = found.run(reading, ICFDL), found.run(reading, "jiao2025.icfdl_remembering")
        if outcome(mended) == "learns":
            yield (f"With K_d on the difference of the errors, as its name says (claim 18), the PD law learns with u "
                   f"in {label}: MSE {at(mended, last)} m²/s² after the last trial, where (18) as printed "
                   f"{outcome(printed)} and iCFDL-MFAILC has {at(learns, last)}.")
        if learns.failed is None and kept.failed is None:
            yield (f"Estimates that outlive a trial cut short (claim 15.reset mended) leave an MSE of {at(kept, last)} "
                   f"instead of {at(learns, last)} m²/s² with u in {label}.")


def first_estimates(found: Found) -> Iterator[str]:
    """How much the unstated first estimate matters."""
    study = found.study
    for entry in study.shown:
        tried = [Case(entry.reading, entry.law, study.trials.seed, place)
                 for place, variant in enumerate(study.variants) if set(variant.set) == {"learning.first_estimate"}]
        runs = [found.runs[case] for case in tried if case in found.runs]
        ends = [float(mse(run)[-1]) for run in [found.run(entry.reading, entry.law), *runs] if run.failed is None]
        if runs and ends:
            yield (f"{found.title(entry.reading, entry.law)}: the first estimate, which the paper does not state, "
                   f"takes the MSE after the last trial from {number(min(ends))} to {number(max(ends))} m²/s².")


def drawn(found: Found) -> str:
    """How much the seeds matter."""
    parts = []
    for entry in found.study.shown:
        ends = [float(mse(run)[-1]) for run in found.of_seeds(entry) if run.failed is None]
        if ends:
            parts.append(f"{found.title(entry.reading, entry.law)}: {number(min(ends))} to {number(max(ends))}")
    return (f"The MSE after the last trial over {found.study.trials.seeds} draws of the lengths (m²/s²): "
            f"{'; '.join(parts)}.")
