"""The tables of jiao2025: every reading, the paper's statements, mended laws, growth, sensitivity, seeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from workbench.files.numbers import NOTHING, number
from workbench.paper.results import ResultTable

from ..laws import TRIAL_LAWS
from ..simulation.trials import TrialRun
from .cases import PRINTED_LAWS, Case, concerns, desired_trip
from .outcomes import Found, at, ended, mse, outcome, peak, rises

MSE = "MSE is the mean of e² over the samples of a trial, in m²/s²."
MENDED = ("jiao2025.icfdl_remembering", "jiao2025.pd_difference", "jiao2025.cfdl")


def all_tables(found: Found) -> tuple[ResultTable, ...]:
    """All tables, in the order of the page."""
    return (statements(found), readings(found), growth(found), mended(found), sensitivity(found), seeds(found))


def _trials(found: Found) -> tuple[int, ...]:
    """The trials whose errors are shown: the first, the paper's, the last."""
    return (0, *found.study.trials.compared, found.study.trials.count)


def _shown_errors(run: TrialRun, trials: Sequence[int]) -> tuple[str, ...]:
    return tuple(at(run, trial) for trial in trials)


def readings(found: Found) -> ResultTable:
    """Both laws of the paper in every reading of u and k."""
    trials = _trials(found)
    rows = []
    for name, reading in found.study.readings.items():
        for law in PRINTED_LAWS:
            run = found.run(name, law)
            trial, ratio = peak(run)
            rows.append((
                reading.title, TRIAL_LAWS[law].title, *_shown_errors(run, trials), f"{number(ratio)} (trial {trial})",
                str(rises(run)), number(float(run.column("largest_error")[-1])), outcome(run)))
    return ResultTable(
        "Every reading of u and k", "the paper states neither; section 4",
        ("Reading", "Law", *(f"MSE, trial {trial}" for trial in trials), "Peak MSE over first", "Trials that got worse",
         "Largest |e|, last trial that ended (m/s)", "Outcome"), tuple(rows),
        f"{MSE} Trial 0 runs under u(k,0). “Learns”: less than 1 % of the first MSE is left; “hardly”: more than half.")


def statements(found: Found) -> ResultTable:
    """What the paper says beside what the runs gave, with k in samples of T_s."""
    names = found.short_readings()
    early, late = found.study.trials.compared[0], found.study.trials.compared[-1]
    last = found.study.trials.count

    def better(law: str, reading: str) -> str:
        run = found.run(reading, law)
        if ended(run) <= late:
            return f"no: {outcome(run)}"
        yes = mse(run)[late] < mse(run)[early]
        return f"{'yes' if yes else 'no'}: {at(run, early)} → {at(run, late)}"

    def always(law: str, reading: str) -> str:
        run = found.run(reading, law)
        if run.failed is not None:
            return f"no: {outcome(run)}"
        return f"no: worse in {rises(run)} of {last} trials" if rises(run) else "yes"

    def below(reading: str) -> str:
        ours, theirs = (found.run(reading, law) for law in PRINTED_LAWS)
        if ended(theirs) <= 1:
            return "both diverge at once" if ended(ours) <= 1 else f"nothing to compare: PD {outcome(theirs)}"
        both = min(ended(ours), ended(theirs))
        count = int(np.sum(mse(ours)[1:both] < mse(theirs)[1:both]))
        return (f"{'yes' if count == both - 1 else 'no'}: below in {count} of {both - 1} trials, at the end "
                f"{at(ours, both - 1)} against {at(theirs, both - 1)}")

    def monotone(reading: str) -> str:
        run = found.run(reading, "jiao2025.fixed_estimate")
        if run.failed is not None:
            return f"no: {outcome(run)}"
        return f"no: the norm rises in {rises(run)} trials" if rises(run) else "yes"

    def left(reading: str) -> str:
        run = found.run(reading, PRINTED_LAWS[0])
        if run.failed is not None:
            return f"no: {outcome(run)}"
        return f"{number(100 * float(np.sqrt(mse(run)[-1] / mse(run)[0])))} % of the error norm left"

    icfdl, pd = PRINTED_LAWS
    better_words = f"trial {late} tracks better than trial {early}"
    rows = [
        (f"iCFDL-MFAILC: {better_words}", "yes (Figure 5)", *(better(icfdl, n) for n in names)),
        (f"PD: {better_words}", "yes (Figure 6)", *(better(pd, n) for n in names)),
        ("iCFDL-MFAILC tracks better every time", "yes (section 4)", *(always(icfdl, n) for n in names)),
        ("PD tracks better every time", "yes (section 4)", *(always(pd, n) for n in names)),
        ("the MSE of iCFDL-MFAILC is below that of PD", "yes (Figure 7)", *map(below, names)),
        (f"the expected error of iCFDL-MFAILC goes to zero; after {last} trials:", "yes (Theorem 1)",
         *map(left, names)),
        ("convergence is monotone in the 2-norm (estimate kept at dv(k+1)/du(k), whole trials)",
         "yes (introduction)", *map(monotone, names)),
    ]
    return ResultTable(
        "What the paper says, and what came out", "paper, introduction, section 4 and Figures 5-7",
        ("Statement", "Printed", *(found.study.readings[name].title for name in names)), tuple(rows),
        f"The paper prints no number of an error; its figures are not in the text. {MSE}")


def growth(found: Found) -> ResultTable:
    """The transient along the trials beside what the claims say of it."""
    learning, mass = found.study.learning, found.study.train.mass_kg
    rows = []
    for name, reading in found.study.readings.items():
        b = reading.step_s * reading.unit_n / mass
        gain = learning.rho * b**2 / (learning.lamda + b**2)
        samples = len(desired_trip(found.study, reading)[0]) - 1
        limit = learning.rho**2 * b**2 / 4
        kept = found.run(name, "jiao2025.fixed_estimate")
        rows.append((
            reading.title, number(b), f"{number(limit)} ({'met' if learning.lamda > limit else 'not met'})",
            number(gain), number(gain * samples * (samples + 1) / 2), _ratio(kept),
            _ratio(found.run(name, "jiao2025.icfdl")),
            _first_sample(kept, gain)))
    return ResultTable(
        "Growth before convergence", "claims theorem1.lambda, intro.small, intro.growth, theorem1.train",
        ("Reading", "b = dv(k+1)/du(k)", "λ_min = ρ²b²/4 (stated λ)", "g at φ̂ = b", "gN(N+1)/2 (monotone if ≤ 1)",
         "Largest error norm over the first: φ̂ kept at b", "the same: iCFDL-MFAILC",
         "Error left at the first sample, % (by (1−g)^i)"), tuple(rows),
        "The law that keeps φ̂ = b runs over whole trials, all met by the same resistance, the case of the claims. "
        "Theorem 1 asks λ > λ_min with b as the least bound p; the train meets no such bound (claim A2.every).")


def _first_sample(run: TrialRun, gain: float) -> str:
    """What is left of the error at the first sample after the last trial, and what a fixed gain leaves of it."""
    if run.failed is not None:
        return NOTHING
    left = run.column("first_error")
    return f"{number(100 * float(left[-1] / left[0]), 5)} ({number(100 * (1 - gain) ** (len(left) - 1), 5)})"


def _ratio(run: TrialRun) -> str:
    """The largest error norm over that of trial 0; what followed where the run ended early."""
    trial, ratio = peak(run)
    text = f"{number(float(np.sqrt(ratio)))} (trial {trial})"
    if run.failed is not None:
        text = outcome(run) if trial == 0 else f"{text}, {outcome(run)}"
    return text


def mended(found: Found) -> ResultTable:
    """Laws and train with what the claims refute put right, beside the printed ones."""
    trials = _trials(found)
    rows = []
    for name in found.short_readings():
        title = found.study.readings[name].title
        for law in (*PRINTED_LAWS, *MENDED):
            run = found.run(name, law)
            rows.append((title, TRIAL_LAWS[law].title, "as printed", *_shown_errors(run, trials), outcome(run)))
        for law in PRINTED_LAWS:
            run = found.run(name, law, opposed=True)
            rows.append((title, TRIAL_LAWS[law].title, "opposes motion", *_shown_errors(run, trials), outcome(run)))
    return ResultTable(
        "Printed and mended", "claims 15.reset and 18; (3) for a train that rolls backwards; (11)-(13)",
        ("Reading", "Law", "Resistance (3)", *(f"MSE, trial {trial}" for trial in trials), "Outcome"), tuple(rows),
        f"{MSE} CFDL-MFAILC (11)-(13) needs trials of the full length and gets them.")


def sensitivity(found: Found) -> ResultTable:
    """One assumed value changed at a time."""
    study, last = found.study, found.study.trials.count
    shown = [(entry.reading, entry.law) for entry in study.shown]
    stated = {pair: found.run(*pair) for pair in shown}

    def cell(run: TrialRun, pair: tuple[str, str]) -> str:
        base = stated[pair]
        changed = outcome(run) != outcome(base)
        if run.failed is None and base.failed is None:
            ratio = float(mse(run)[-1] / mse(base)[-1])
            changed = changed or not 0.5 <= ratio <= 2
        return f"{'▲ ' if changed else ''}{' → '.join(at(run, t) for t in _trials(found)[1:])}; {outcome(run)}"

    rows = [("as stated", *(cell(stated[pair], pair) for pair in shown))]
    for place, variant in enumerate(study.variants):
        rows.append((variant.title, *(
            cell(found.runs[Case(*pair, study.trials.seed, place)], pair) if concerns(variant, pair[1]) else NOTHING
            for pair in shown)))
    return ResultTable(
        "How much the assumed data matter", "assumed values",
        ("Change", *(found.title(*pair) for pair in shown)), tuple(rows),
        f"MSE of trials {', '.join(map(str, study.trials.compared))} and {last}, one value changed at a time. "
        "▲: another outcome, or the last MSE more than doubled or halved.")


def seeds(found: Found) -> ResultTable:
    """How much the drawn lengths matter."""
    trials = _trials(found)[1:]
    rows = []
    for entry in found.study.shown:
        runs = found.of_seeds(entry)
        whole = [run for run in runs if run.failed is None]
        spread = []
        for trial in trials:
            values = [float(mse(run)[trial]) for run in whole]
            spread.append(f"{number(min(values))} / {number(float(np.median(values)))} / {number(max(values))}"
                          if values else NOTHING)
        early, late = found.study.trials.compared[0], found.study.trials.compared[-1]
        fell = sum(bool(mse(run)[late] < mse(run)[early]) for run in whole)
        rows.append((found.title(entry.reading, entry.law), *spread, f"{fell} of {len(runs)}",
                     f"{len(runs) - len(whole)} of {len(runs)}"))
    return ResultTable(
        "How much the drawn lengths matter", f"{found.study.trials.seeds} seeds of T_0, T_1, ...",
        ("Run", *(f"MSE, trial {trial}: least / median / largest" for trial in trials),
         "Trial 100 better than 50" if trials[:2] == (50, 100) else "The later trial better", "Diverge"), tuple(rows))
