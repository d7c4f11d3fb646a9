"""What a reader of mao2018's study should know, every number from its runs."""

from __future__ import annotations

from .outcomes import Found, ended, kilonewtons, largest, left, length, settled
from .runs import Obtained


def findings(found: Found) -> tuple[str, ...]:
    """A sentence or two each."""
    scaled, si = found.study.tunings
    return (_healthy(found), *(_signs(found, tuning) for tuning in (scaled, si)), _estimates(found, si),
            _single_signs(found, scaled), _gains(found), _sampling(found), _units(found), _chattering(found, scaled),
            _forces(found, scaled))


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def _outcome(run: Obtained) -> str:
    return ended(run) if run.failed else f"up to {length(largest(run))}, settling to {length(settled(run))}"


def _healthy(found: Found) -> str:
    words = [f"{_outcome(found.printed(1, tuning))} ({tuning})" for tuning in found.study.tunings]
    return ("Healthy motors: the law (35)-(37) follows the curve as Theorem 1 says; position errors after the start: "
            f"{_listed(words)}.")


def _signs(found: Found, tuning: str) -> str:
    """The laws as printed beside the corrected ones."""
    cases = range(2, len(found.study.cases) + 1)
    printed = [found.printed(number, tuning) for number in cases]
    corrected = [found.corrected(number, tuning) for number in cases]
    lost = [f"case {run.asked.case} {ended(run)}" for run in printed if run.failed]
    alike = [f"case {run.asked.case} ({_outcome(run)}; corrected {_outcome(other)})"
             for run, other in zip(printed, corrected, strict=True) if not run.failed]
    first = min((part.from_s for part in found.study.failure), default=0.0)
    early = sum(bool(run.failed) and run.row["end_s"] < first for run in printed)
    title = found.study.tunings[tuning].title
    text = f"{title[0].upper()}{title[1:]}, laws as printed: "
    if lost:
        text += _listed(lost) + {0: "", len(lost): f", before a motor fails at {first:.0f} s"}.get(
            early, f"; {early} of them before a motor fails at {first:.0f} s") + ". "
    if alike:
        text += ("No divergence in " if lost else "no divergence: ") + _listed(alike) + ". "
    kept = [run for run in corrected if not run.failed]
    if lost and kept:
        text += (f"With the signs corrected {len(kept)} of {len(corrected)} cases run to the end: position errors up "
                 f"to {length(max(map(largest, kept)))} after the events, settling to at most "
                 f"{length(max(map(settled, kept)))}.")
    return text.strip()


def _estimates(found: Found, tuning: str) -> str:
    """How much of the failure its own estimates take, where the other estimates are fast."""
    learned = [abs(run.row["failure_learned_n"]) for number in range(2, len(found.study.cases) + 1)
               for run in (found.printed(number, tuning), found.corrected(number, tuning))
               if run.row["failure_learned_n"] is not None]
    part = found.study.failure[0]
    return (f"Why the sign of (44) can go unnoticed: with {found.study.tunings[tuning].title} the estimates of the "
            f"resistance, that of c above all, take up the failure at once. From {part.from_s:.0f} s to "
            f"{part.to_s:.0f} s the failed motor gives {kilonewtons(part.offset)}, and its own estimate changes by at "
            f"most {max(learned, default=0.0):.2g} N; so what (44) makes of it hardly enters.")


def _single_signs(found: Found, tuning: str) -> str:
    """What each wrong sign does alone, where a law has two."""
    words = []
    for run in found.stated(tuning):
        wrong = found.wrong(run.asked.case)
        if len(wrong) > 1 and 0 < len(run.asked.mended) < len(wrong):
            words.append(f"case {run.asked.case} with {left(run, wrong)} {_outcome(run)} (all corrected: "
                         f"{_outcome(found.corrected(run.asked.case, tuning))})")
    return f"One wrong sign alone, {found.study.tunings[tuning].title}: {'; '.join(words)}."


def _gains(found: Found) -> str:
    """For which gains of the failure's estimates the printed sign of (44) shows."""
    words = []
    for number, change in enumerate(found.study.sensitivity, start=1):
        if change.laws == "both" and len(change.cases) == 1 and {"law.gain_xi", "law.gain_rho_k"} == set(change.set):
            printed, corrected = found.changed(number)
            words.append(f"{change.set['law.gain_xi']:g}: {_outcome(printed)} (corrected {_outcome(corrected)})")
    return ("How strong the failure's estimates must be for the sign of (44) to show, case 2 by the gains of (41) and "
            f"(44): {'; '.join(words)}.") if words else "The gains of (41) and (44) were not varied."


def _sampling(found: Found) -> str:
    words, again = [], []
    for damping in found.study.sampling.r_2_per_s:
        borne = [run.row["period_s"] for run in found.sampled() if run.asked.r_2_per_s == damping and not run.failed]
        words.append(f"r_2 = {damping:g}/s: " + (f"{1e3 * max(borne):g} ms" if borne else "none of those tried"))
    for number, change in enumerate(found.study.sensitivity, start=1):
        if change.laws == "printed" and len(change.set) == 1 and next(iter(change.set)).endswith("period_s"):
            again.append(f"{change.title}: " + _listed([f"case {run.asked.case} {_outcome(run)}"
                                                       for run in found.changed(number)]))
    return (f"Sampling: the stated gain of {found.study.law.gain:g} multiplies v⁴ in the loop of c (29). The longest "
            f"period that case {found.study.sampling.case}, corrected, bears beyond the failure with SI units is, for "
            f"{_listed(words)}; the paper states no step. What the printed laws do with scaled regressors is not the "
            f"sampling's doing; {'; '.join(again) or 'no other period was run'}.")


def _changes(found: Found, key: str, case: int) -> list[Obtained]:
    return [run for number, change in enumerate(found.study.sensitivity, start=1) if set(change.set) == {key}
            for run in found.changed(number) if run.asked.case == case]


def _units(found: Found) -> str:
    """What the ambiguous units change."""
    tuning = next(iter(found.study.tunings))
    words = [f"case {case}, {text}: {_outcome(run)}" for case, key, text in (
        (2, "readings.resistance", "resistance of the whole train in kN"), (5, "readings.resistance", "the same"),
        (2, "readings.angle", "slope in radians"), (2, "readings.disturbance_unit_n", "disturbance in kN"))
        for run in _changes(found, key, case)]
    return (f"Units: how the table is read changes the errors little, because the estimates adapt to either. As read "
            f"here, case 2: {_outcome(found.corrected(2, tuning))}; case 5: {_outcome(found.corrected(5, tuning))}. "
            f"Otherwise read, {'; '.join(words)}.") if words else "Units: no other reading was run."


def _chattering(found: Found, tuning: str) -> str:
    runs = [found.corrected(number, tuning) for number in range(1, len(found.study.cases) + 1)]
    if all(run.failed for run in runs):
        return "Chattering: no corrected run reached its end."
    run = max((run for run in runs if not run.failed), key=lambda run: run.row["command_change_mps2"])
    layers = _changes(found, "law.layer_mps", run.asked.case)
    softer = "".join(f"; with a boundary layer by {other.row['command_change_mps2']:.1e} m/s², settling to "
                     f"{length(settled(other))}" for other in layers)
    return (f"Chattering: with sgn(z_2) as printed the command of case {run.asked.case} changes by "
            f"{run.row['command_change_mps2']:.1e} m/s² from sample to sample in the mean and turns "
            f"{run.row['command_reversals_per_s']:.0f} times a second, settling to {length(settled(run))}{softer}.")


def _forces(found: Found, tuning: str) -> str:
    mass = 1e3 * found.study.train.mass_t
    runs = [run for number in range(1, len(found.study.cases) + 1)
            for run in (found.corrected(number, tuning),) if not run.failed]
    if not runs:
        return "Forces: no corrected run reached its end."
    run = max(runs, key=lambda run: max(abs(run.row["command_min"]), abs(run.row["command_max"])))
    most = mass * max(abs(run.row["command_min"]), abs(run.row["command_max"]))
    return (f"Forces: nothing limits them. The corrected laws ask for up to {kilonewtons(most)} (case "
            f"{run.asked.case}), {most / mass:.1f} m/s²; adhesion gives a train about 1 m/s². One failed motor's "
            f"200 kN in (67) are 0.5 m/s² of {found.study.train.mass_t:g} t.")
