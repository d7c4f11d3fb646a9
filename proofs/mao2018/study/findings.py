"""What a reader of mao2018's study should know, every number from its runs."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from workbench.files.numbers import number
from workbench.paper.cells import FORCES, Scaled, cell_text
from workbench.paper.findings import listed, some

from .runs import MaoResults, RunResult


def _case(run: RunResult) -> str:
    return f"case {run.case.number} {run.outcome}"


def _ended(tuning: str, results: MaoResults) -> list[RunResult]:
    """The runs with all signs corrected that reach their end."""
    return some(run for run in results.all_corrected(tuning) if not run.failed)


def _in(tuning: int, finding: Callable[[str, MaoResults], str | Iterable[str]]
        ) -> Callable[[MaoResults], str | Iterable[str]]:
    """A finding of a tuning, by its number: the first has scaled regressors, the second those in SI units."""
    return lambda results: finding(list(results.study.tunings)[tuning], results)


def _healthy(results: MaoResults) -> str:
    words = [f"{results.printed(1, tuning).outcome} ({tuning})" for tuning in results.study.tunings]
    return ("Healthy motors: the law (35)-(37) follows the curve as Theorem 1 says; position errors after the start: "
            f"{listed(words)}.")


def _signs(tuning: str, results: MaoResults) -> str:
    """The laws as printed beside the corrected ones."""
    corrected = results.all_corrected(tuning)[1:]
    printed = [results.printed(run.case.number, tuning) for run in corrected]
    lost = [f"case {run.case.number} {cell_text(run.ended)}" for run in printed if run.failed]
    alike = [f"case {run.case.number} ({run.outcome}; corrected {other.outcome})"
             for run, other in zip(printed, corrected, strict=True) if not run.failed]
    first = min((part.from_s for part in results.study.failure), default=0.0)
    early = sum(bool(run.failed) and run.row["end_s"] < first for run in printed)
    title = results.study.tunings[tuning].title
    text = f"{title[0].upper()}{title[1:]}, laws as printed: "
    if lost:
        text += listed(lost) + {0: "", len(lost): f", before a motor fails at {first:.0f} s"}.get(
            early, f"; {early} of them before a motor fails at {first:.0f} s") + ". "
    if alike:
        text += ("No divergence in " if lost else "no divergence: ") + listed(alike) + ". "
    ending = [run for run in corrected if not run.failed]
    if lost and ending:
        text += (f"With the signs corrected {len(ending)} of {len(corrected)} cases run to the end: position errors up "
                 f"to {Scaled(max(run.largest_m for run in ending))} after the events, settling to at most "
                 f"{Scaled(max(run.settled_m for run in ending))}.")
    return text.strip()


def _estimates(tuning: str, results: MaoResults) -> str:
    """How much of the failure its own estimates take, where the other estimates are fast."""
    learned = [abs(run.row["failure_learned_n"]) for number in results.numbers[1:]
               for run in (results.printed(number, tuning), results.corrected(number, tuning))
               if run.row["failure_learned_n"] is not None]
    part = results.study.failure[0]
    return (f"Why the sign of (44) can go unnoticed: with {results.study.tunings[tuning].title} the estimates of the "
            f"resistance, that of c above all, take up the failure at once. From {part.from_s:.0f} s to "
            f"{part.to_s:.0f} s the failed motor gives {Scaled(part.offset, FORCES)}, and its own estimate changes by at "
            f"most {max(learned, default=0.0):.2g} N; so what (44) makes of it hardly enters.")


def _single_signs(tuning: str, results: MaoResults) -> str:
    """What each wrong sign does alone, where a law has two."""
    words = []
    for run in results.stated(tuning):
        number, wrong = run.case.number, results.wrong(run.case.number)
        if len(wrong) > 1 and 0 < len(run.case.mended) < len(wrong):
            words.append(f"case {number} with {results.left(run)} {run.outcome} (all corrected: "
                         f"{results.corrected(number, tuning).outcome})")
    return f"One wrong sign alone, {results.study.tunings[tuning].title}: {'; '.join(words)}."


def _gains(results: MaoResults) -> str:
    """For which gains of the failure's estimates the printed sign of (44) shows."""
    words = []
    for change in results.study.changes:
        if change.laws == "both" and len(change.cases) == 1 and (pair := [
                run for of, run in results.changed_runs("law.gain_xi", "law.gain_rho_k") if of is change]):
            words.append(f"{change.set['law.gain_xi']:g}: {pair[0].outcome} (corrected {pair[1].outcome})")
    return ("How strong the failure's estimates must be for the sign of (44) to show, case 2 by the gains of (41) and "
            f"(44): {'; '.join(some(words))}.")


def _sampling(results: MaoResults) -> str:
    study, words, again = results.study, [], []
    for damping in study.sampling.r_2_per_s:
        borne = [run.row["period_s"] for run in results.sampled() if run.case.r_2_per_s == damping and not run.failed]
        words.append(f"r_2 = {damping:g}/s: " + (f"{1e3 * max(borne):g} ms" if borne else "none of those tried"))
    for change, (title, runs) in zip(study.changes, results.by_change(), strict=True):
        if change.laws == "printed" and len(change.set) == 1 and next(iter(change.set)).endswith("period_s"):
            again.append(f"{title}: {listed(map(_case, runs.values()))}")
    return (f"Sampling: the stated gain of {study.law.gain:g} multiplies v⁴ in the loop of c (29). The longest "
            f"period that case {study.sampling.case}, corrected, bears beyond the failure with SI units is, for "
            f"{listed(words)}; the paper states no step. What the printed laws do with scaled regressors is not the "
            f"sampling's doing; {'; '.join(again) or 'no other period was run'}.")


def _units(results: MaoResults) -> str:
    """What the ambiguous units change."""
    words = [f"case {case}, {text}: {run.outcome}" for case, key, text in (
        (2, "readings.resistance", "resistance of the whole train in kN"), (5, "readings.resistance", "the same"),
        (2, "readings.angle", "slope in radians"), (2, "readings.disturbance_unit_n", "disturbance in kN"))
        for run in results.changing(key, number=case).values()]
    stated = "; ".join(f"case {case}: {results.corrected(case, results.first_tuning).outcome}" for case in (2, 5))
    return (f"Units: how the table is read changes the errors little, because the estimates adapt to either. As read "
            f"here, {stated}. Otherwise read, {'; '.join(some(words))}.")


def _chattering(tuning: str, results: MaoResults) -> Iterator[str]:
    run = max(_ended(tuning, results), key=lambda run: run.row["command_change_mps2"])
    yield (f"Chattering: with sgn(z_2) as printed the command of case {run.case.number} changes by "
           f"{number(run.row['command_change_mps2'], 2)} m/s² from sample to sample in the mean and turns "
           f"{run.row['command_reversals_per_s']:.0f} times a second, settling to {Scaled(run.settled_m)}.")
    for other in results.changing("law.layer_mps", number=run.case.number).values():
        yield (f"With a boundary layer it changes by {number(other.row['command_change_mps2'], 2)} m/s², settling to "
               f"{Scaled(other.settled_m)}.")


def _forces(tuning: str, results: MaoResults) -> str:
    def most(run: RunResult) -> float:
        return max(abs(run.row["command_min"]), abs(run.row["command_max"]))

    run, mass_t = max(_ended(tuning, results), key=most), results.study.train.mass_t
    return (f"Forces: nothing limits them. The corrected laws ask for up to {Scaled(1e3 * mass_t * most(run), FORCES)} (case "
            f"{run.case.number}), {most(run):.1f} m/s²; adhesion gives a train about 1 m/s². One failed motor's "
            f"200 kN in (67) are 0.5 m/s² of {mass_t:g} t.")


FINDINGS = (_healthy, _in(0, _signs), _in(1, _signs), _in(1, _estimates), _in(0, _single_signs), _gains, _sampling,
            _units, _in(0, _chattering), _in(0, _forces))
