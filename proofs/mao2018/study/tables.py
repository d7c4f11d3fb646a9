"""The tables of mao2018's study."""

from __future__ import annotations

from workbench.paper.results import ResultTable

from .outcomes import Found, ended, kilonewtons, largest, left, length, settled
from .runs import Obtained, event_times

NOTHING = "—"
FIGURES = {1: "Figure 1", 2: "Figure 2 (a)", 3: "Figure 2 (b)", 4: "Figure 2 (c)", 5: "Figure 2 (d)"}


def all_tables(found: Found) -> tuple[ResultTable, ...]:
    """Printed and obtained; the cases in every tuning; sampling; commands; assumed values."""
    return (_printed(found), *(_cases(found, tuning) for tuning in found.study.tunings), _sampling(found),
            _commands(found), _sensitivity(found))


def summary(run: Obtained) -> str:
    """A run in one cell: the largest error after the first event and what it settles to, or when it diverged."""
    return ended(run) if run.failed else f"{length(largest(run))}, settles to {length(settled(run))}"


def _printed(found: Found) -> ResultTable:
    first, rows = event_times(found.study)[1], []
    for number, case in enumerate(found.study.cases, start=1):
        cells = [summary(run) for tuning in found.study.tunings
                 for run in (found.printed(number, tuning), found.corrected(number, tuning))]
        said = "follows the desired curve" if number == 1 else "transients at changes and failures, then settles"
        rows.append((FIGURES.get(number, f"case {number}"), case.title, said, *cells))
    header = ("figure", "case", "the paper says", *(f"{law}, {tuning}" for tuning in found.study.tunings
                                                   for law in ("law as printed", "corrected")))
    return ResultTable(
        "Tracking errors, printed and obtained", "paper, section VIII, Figures 1 and 2", header, tuple(rows),
        f"The paper prints curves and no numbers. Obtained: the largest position error after {first:.0f} s, when the "
        f"error of the start is over, and the largest to which it settles before an event. {_tunings(found)}")


def _tunings(found: Found) -> str:
    return " ".join(f"{name}: {tuning.title}, r_1 = {tuning.r_1_per_s:g}/s, r_2 = {tuning.r_2_per_s:g}/s, "
                    f"{1e3 * tuning.period_s:g} ms." for name, tuning in found.study.tunings.items())


def _cases(found: Found, tuning: str) -> ResultTable:
    """Every law of every case, from event to event."""
    times, rows = event_times(found.study)[:-1], []
    for run in found.stated(tuning):
        number = run.asked.case
        missing = [NOTHING] * (len(times) - len(run.stretches))
        start = (str(number), left(run, found.wrong(number)), ended(run))
        rows.append((*start, "largest", *(length(one.largest_m) for one in run.stretches), *missing))
        if run.stretches:
            rows.append((*start, "settled", *(length(one.settled_m) for one in run.stretches), *missing))
    return ResultTable(
        f"The cases, {found.study.tunings[tuning].title}", "paper, section VIII, cases 1 to 5",
        ("case", "wrong signs left", "end", "position error", *(f"from {time:.0f} s" for time in times)), tuple(rows),
        "From each event to the next: the largest position error, and what it has settled to, the largest of the last "
        f"{found.study.horizon.settled_window_s:g} s. 400 s: tunnel; 600 s: a motor gives 200 kN; 800 s: curve and "
        "slope; 1000 s: its force varies; 1200 s: it stops; 1400 s: open, level track.")


def _sampling(found: Found) -> ResultTable:
    study = found.study
    fastest = max(study.reference.speeds_mps)
    rows = [(f"{1e3 * run.row['period_s']:g} ms", f"{run.asked.r_2_per_s:g}/s",
             f"{run.row['period_s'] * (study.law.gain * fastest**4) ** 0.5:.2f}",
             ended(run) if run.failed else "none",
             *((NOTHING,) * 3 if run.failed else (
                 f"{run.row['loop_gain']:.2f}",
                 f"{run.row['period_s'] * (run.row['loop_gain'] * study.law.gain * fastest**4) ** 0.5:.2f}",
                 length(largest(run))))) for run in found.sampled()]
    return ResultTable(
        "Which sampling the stated gains bear", "sampling, not in the paper",
        ("period", "r_2", "period × √2 v²", "diverged", "m k_ν ρ̂ at the end", "period × √(2 m k_ν ρ̂) v²",
         "largest error"), tuple(rows),
        f"Case {study.sampling.case}, corrected, until {study.sampling.end_s:g} s, regressors in SI units. With a gain "
        f"of {study.law.gain:g} the loop of z_2 and the estimate of c oscillates at √{study.law.gain:g} v² rad/s, "
        f"{(study.law.gain * fastest**4) ** 0.5:.0f} rad/s at {fastest:g} m/s, times √(m k_ν ρ̂), where m k_ν ρ̂ = 1 "
        "for a right estimate; an Euler step bears at most 2 rad a period. Beyond it the growing oscillation pushes "
        "the estimate ρ̂ down until 2 rad are met, or the run is lost, as where a new mode brings its own ρ̂.")


def _commands(found: Found) -> ResultTable:
    """Chattering and the forces that are asked for, of the runs that ended."""
    runs = [run for tuning in found.study.tunings for run in found.stated(tuning)]
    runs += [run for number, change in enumerate(found.study.sensitivity, start=1) if "law.layer_mps" in change.set
             for run in found.changed(number)]
    mass, rows = 1e3 * found.study.train.mass_t, []
    for run in runs:
        if run.failed:
            continue
        layer = found.study.law.layer_mps
        if run.asked.change:
            layer = found.study.sensitivity[run.asked.change - 1].set["law.layer_mps"]
        row = run.row
        rows.append((str(run.asked.case), left(run, found.wrong(run.asked.case)), run.asked.tuning,
                     f"{1e3 * layer:g} mm/s" if layer else "sgn", f"{row['command_reversals_per_s']:.0f}",
                     f"{row['command_change_mps2']:.1e}", kilonewtons(mass * row["command_min"]),
                     kilonewtons(mass * row["command_max"]), length(settled(run))))
    return ResultTable(
        "What the command does", "chattering and forces, not in the paper",
        ("case", "wrong signs left", "gains", "sign", "reversals a second", "mean change a sample (m/s²)",
         "least force", "largest force", "settles to"), tuple(rows),
        f"A reversal: the command rises after it fell, or falls after it rose. The force is what all "
        f"{found.study.train.motors} motors would give; nothing limits it.")


def _sensitivity(found: Found) -> ResultTable:
    rows = []
    for number, change in enumerate(found.study.sensitivity, start=1):
        for run in found.changed(number):
            as_stated = found.runs.get(type(run.asked)(run.asked.case, run.asked.tuning, run.asked.mended))
            rows.append((change.title, str(run.asked.case), left(run, found.wrong(run.asked.case)), summary(run),
                         summary(as_stated) if as_stated else NOTHING))
    return ResultTable(
        "How much the assumed values matter", "sensitivity, not in the paper",
        ("change", "case", "wrong signs left", "obtained", "without the change"), tuple(rows),
        "The largest error after the first event and what it settles to, as above.")
