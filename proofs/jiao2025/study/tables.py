"""The tables of jiao2025: every reading, the paper's statements, mended laws, growth, changes, seeds."""

from __future__ import annotations

from functools import partial
from operator import attrgetter

import numpy as np

from workbench.paper.cells import Cell, Column, Phrase
from workbench.paper.learning_comparison import at_trials, rises, trial_columns
from workbench.paper.reproduced import STATED
from workbench.paper.results import ResultTable
from workbench.paper.study_tables import ColumnOf, run_table, statement_table, verdict

from ..laws import TRIAL_LAWS
from ..simulation.plans import desired_trip
from ..simulation.trials import TrialRun
from .record import Shown
from .runs import ICFDL, PD, PRINTED_LAWS, JiaoResults, concerns, mse_at, outcome, peak

MSE = "MSE is the mean of e² over the samples of a trial, in m²/s²."
MSES = Column("MSE")
MENDED = ("jiao2025.icfdl_remembering", "jiao2025.pd_difference", "jiao2025.cfdl")


def _trials(results: JiaoResults) -> tuple[int, ...]:
    """The trials whose errors are shown: the first, the paper's, the last."""
    return (0, *results.study.trials.compared, results.study.trials.count)


def readings(results: JiaoResults) -> ResultTable:
    """Both laws of the paper in every reading of u and k."""
    runs = [((reading.title, TRIAL_LAWS[law].title), results.run(name, law))
            for name, reading in results.study.readings.items() for law in PRINTED_LAWS]
    columns: tuple[ColumnOf[TrialRun], ...] = (
        *trial_columns(MSES, attrgetter("mse"), _trials(results), 0),
        ("Peak MSE over first", lambda run: Phrase("{} (trial {})", peak(run)[::-1])),
        ("Trials that got worse", lambda run: rises(run.mse)),
        (Column("Largest |e|, last trial that ended", "m/s"), lambda run: run.column("largest_error")[-1]),
        ("Outcome", outcome))
    return run_table(
        "Every reading of u and k", "the paper states neither; section 4", ("Reading", "Law"), runs, columns,
        f"{MSE} Trial 0 runs under u(k,0). “Learns”: less than 1 % of the first MSE is left; “hardly”: more than half.")


def statements(results: JiaoResults) -> ResultTable:
    """What the paper says beside what the runs gave, with k in samples of T_s."""
    trials, last = results.study.trials, results.study.trials.count
    early, late = trials.compared[0], trials.compared[-1]

    def better(law: str, reading: str) -> Cell:
        run = results.run(reading, law)
        if len(run.rows) <= late:
            return f"no: {outcome(run)}"
        return verdict(bool(run.mse[late] < run.mse[early]), "{} → {}", (mse_at(run, early), mse_at(run, late)))

    def never_worse(law: str, words: str, reading: str) -> Cell:
        run = results.run(reading, law)
        if run.failed is not None:
            return f"no: {outcome(run)}"
        return Phrase(words, (rises(run.mse), last)) if rises(run.mse) else "yes"

    def below(reading: str) -> Cell:
        ours, theirs = (results.run(reading, law) for law in PRINTED_LAWS)
        if len(theirs.rows) <= 1:
            return "both diverge at once" if len(ours.rows) <= 1 else f"nothing to compare: PD {outcome(theirs)}"
        both = min(len(ours.rows), len(theirs.rows))
        count = int(np.sum(ours.mse[1:both] < theirs.mse[1:both]))
        return verdict(count == both - 1, "below in {} of {} trials, at the end {} against {}",
                       (count, both - 1, mse_at(ours, both - 1), mse_at(theirs, both - 1)))

    def left(reading: str) -> Cell:
        run = results.run(reading, ICFDL)
        if run.failed is not None:
            return f"no: {outcome(run)}"
        return Phrase("{} % of the error norm left", (100 * float(np.sqrt(run.mse[-1] / run.mse[0])),))

    better_words, worse = f"trial {late} tracks better than trial {early}", "no: worse in {} of {} trials"
    return statement_table(
        "What the paper says, and what came out", "paper, introduction, section 4 and Figures 5-7",
        {results.study.readings[name].title: name for name in results.short_readings()}, [
            (f"iCFDL-MFAILC: {better_words}", "yes (Figure 5)", partial(better, ICFDL)),
            (f"PD: {better_words}", "yes (Figure 6)", partial(better, PD)),
            ("iCFDL-MFAILC tracks better every time", "yes (section 4)", partial(never_worse, ICFDL, worse)),
            ("PD tracks better every time", "yes (section 4)", partial(never_worse, PD, worse)),
            ("the MSE of iCFDL-MFAILC is below that of PD", "yes (Figure 7)", below),
            (f"the expected error of iCFDL-MFAILC goes to zero; after {last} trials:", "yes (Theorem 1)", left),
            ("convergence is monotone in the 2-norm (estimate kept at dv(k+1)/du(k), whole trials)",
             "yes (introduction)",
             partial(never_worse, "jiao2025.fixed_estimate", "no: the norm rises in {} trials"))],
        f"The paper prints no number of an error; its figures are not in the text. {MSE}")


def growth(results: JiaoResults) -> ResultTable:
    """The transient along the trials beside what the claims say of it."""
    learning, mass, rows = results.study.learning, results.study.train.mass_kg, []
    for name, reading in results.study.readings.items():
        b = reading.step_s * reading.unit_n / mass
        gain = learning.rho * b**2 / (learning.lamda + b**2)
        samples = len(desired_trip(results.study, reading)[0]) - 1
        limit = learning.rho**2 * b**2 / 16
        fixed, adapted = (results.run(name, law) for law in ("jiao2025.fixed_estimate", ICFDL))
        rows.append((
            reading.title, b, Phrase("{} (met)" if learning.lamda > limit else "{} (not met)", (limit,)), gain,
            gain * samples * (samples + 1) / 2, _ratio(fixed), _ratio(adapted), _first_sample(fixed, gain)))
    return ResultTable(
        "Growth before convergence", "claims theorem1.lambda, intro.small, intro.growth, theorem1.train",
        ("Reading", "b = dv(k+1)/du(k)", "λ_min = ρ²b²/16 (stated λ)", "g at φ̂ = b", "gN(N+1)/2 (monotone if ≤ 1)",
         "Largest error norm over the first: φ̂ kept at b", "the same: iCFDL-MFAILC",
         Column("Error left at the first sample, % (by (1−g)^i)", digits=5)), tuple(rows),
        "The law that keeps φ̂ = b runs over whole trials, all met by the same resistance, the case of the claims. "
        "Theorem 1 asks λ > λ_min with b as the least bound p; the train meets no such bound (claim A2.every).")


def _first_sample(run: TrialRun, gain: float) -> Cell:
    """What is left of the error at the first sample after the last trial, and what a fixed gain leaves of it."""
    if run.failed is not None:
        return None
    left = run.column("first_error")
    return Phrase("{} ({})", (100 * float(left[-1] / left[0]), 100 * (1 - gain) ** (len(left) - 1)))


def _ratio(run: TrialRun) -> Cell:
    """The largest error norm over that of trial 0; what followed where the run ended early."""
    trial, ratio = peak(run)
    if run.failed is not None and trial == 0:
        return outcome(run)
    return Phrase("{} (trial {})" + (f", {outcome(run)}" if run.failed is not None else ""), (ratio**0.5, trial))


def mended(results: JiaoResults) -> ResultTable:
    """Laws and train with what the claims refute put right, beside the printed ones."""
    ways = [*((law, False) for law in (*PRINTED_LAWS, *MENDED)), *((law, True) for law in PRINTED_LAWS)]
    runs = [((results.study.readings[name].title, TRIAL_LAWS[law].title, "opposes motion" if opposed else "as printed"),
             results.run(name, law, opposed=opposed)) for name in results.short_readings() for law, opposed in ways]
    return run_table(
        "Printed and mended", "claims 15.reset and 18.name; (3) for a train that rolls backwards; (11)-(13)",
        ("Reading", "Law", "Resistance (3)"), runs,
        (*trial_columns(MSES, attrgetter("mse"), _trials(results), 0), ("Outcome", outcome)),
        f"{MSE} CFDL-MFAILC (11)-(13) needs trials of the full length and gets them.")


def changes(results: JiaoResults) -> ResultTable:
    """One assumed value changed at a time."""
    study, trials = results.study, _trials(results)[1:]

    def cell(entry: Shown, number: int) -> Cell:
        if number != STATED and not concerns(study.changes[number], entry.law):
            return None
        run, base = (results.run(entry.reading, entry.law, change=of) for of in (number, STATED))
        differs = outcome(run) != outcome(base)
        if run.failed is None and base.failed is None:
            differs = differs or not 0.5 <= float(run.mse[-1] / base.mse[-1]) <= 2
        words = f"{'▲ ' if differs else ''}{' → '.join('{}' for _ in trials)}; {outcome(run)}"
        return Phrase(words, at_trials(run.mse, trials, 0))

    return ResultTable(
        "How much the assumed data matter", "assumed values", ("Change", *map(results.title, study.shown)),
        tuple((study.change_title(number) or "as stated", *(cell(entry, number) for entry in study.shown))
              for number in range(STATED, len(study.changes))),
        f"MSE of trials {', '.join(map(str, study.trials.compared))} and {study.trials.count}, one value changed at a "
        "time. ▲: another outcome, or the last MSE more than doubled or halved.")


def seeds(results: JiaoResults) -> ResultTable:
    """How much the drawn lengths matter."""
    trials, compared, drawn = _trials(results)[1:], results.study.trials.compared, results.study.trials.seeds
    rows: list[tuple[Cell, ...]] = []
    for entry in results.study.shown:
        whole = [run for run in results.of_seeds(entry) if run.failed is None]
        spread = [Phrase("{} / {} / {}", tuple(float(of([run.mse[trial] for run in whole]))
                                               for of in (np.min, np.median, np.max))) if whole else None
                  for trial in trials]
        fell = sum(bool(run.mse[compared[-1]] < run.mse[compared[0]]) for run in whole)
        rows.append((results.title(entry), *spread, Phrase("{} of {}", (fell, drawn)),
                     Phrase("{} of {}", (drawn - len(whole), drawn))))
    return ResultTable(
        "How much the drawn lengths matter", f"{drawn} seeds of T_0, T_1, ...",
        ("Run", *(f"MSE, trial {trial}: least / median / largest" for trial in trials),
         "Trial 100 better than 50" if trials[:2] == (50, 100) else "The later trial better", "Diverge"), tuple(rows), letters=True)


TABLES = (statements, readings, growth, mended, changes, seeds)
