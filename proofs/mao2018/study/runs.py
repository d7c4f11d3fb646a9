"""The runs of mao2018's study: which there are, and what each of them leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from workbench.paper.cells import Cell, Phrase, Scaled, cell_text
from workbench.paper.reproduced import STATED, Results, in_words
from workbench.paper.results import Curve, thinned
from workbench.paper.trip_run import ERROR, TripRun, error_curve, thinned_log, trip_numbers
from workbench.simulate.closed_loop import Run
from workbench.simulate.metrics import rms
from workbench.simulate.stretches import Stretch, stretches

from .. import laws
from ..simulation.trip import KILONEWTON, TONNE, Signs, law_of, run_under, setting_of, wrong_signs
from .record import CaseData, MaoStudy, Tuning

# What is drawn in full, s; from when on the error at the start is over.
START_S, SETTLED_S = 5.0, 20.0


@dataclass(frozen=True)
class RunCase:
    """A run: case (from 1), tuning, wrong signs that are mended, and the number of the change it is made under.

    period_s, r_2_per_s and end_s replace the tuning's and the horizon's where they are given.
    """

    number: int
    tuning: str
    mended: Signs = ()
    change: int = STATED
    period_s: float | None = None
    r_2_per_s: float | None = None
    end_s: float | None = None


@dataclass(frozen=True)
class RunResult(TripRun[RunCase]):
    """stretches: those between events that a run finished; late: see `late_errors`."""

    stretches: tuple[Stretch, ...]
    late: tuple[float, float] | None

    @property
    def largest_m(self) -> float:
        """The largest |position error| after the first event, else of the whole run: the start's error is given."""
        later = [stretch.largest_m for stretch in self.stretches[1:]]
        return max(later or [max(abs(self.row["position_error_min"]), abs(self.row["position_error_max"]))])

    @property
    def settled_m(self) -> float:
        """The largest of the errors that a run settles to before each event."""
        return max(stretch.settled_m for stretch in self.stretches)

    @property
    def summary(self) -> Cell:
        """The largest error after the first event and what it settles to, or when it diverged."""
        return self.ended or Phrase("{}, settles to {}", (Scaled(self.largest_m), Scaled(self.settled_m)))

    @property
    def outcome(self) -> str:
        """The same in a sentence's words."""
        return (cell_text(self.ended) if self.failed else
                f"up to {Scaled(self.largest_m)}, settling to {Scaled(self.settled_m)}")


def variants(case: CaseData) -> tuple[Signs, ...]:
    """The signs that a case's runs have mended: none, each but one, all."""
    wrong = wrong_signs(case)
    return tuple(dict.fromkeys(((), *(tuple(sign for sign in wrong if sign != left) for left in wrong), wrong)))


def run_cases(study: MaoStudy) -> list[RunCase]:
    """All runs: every case in every tuning, the sampling periods, the changes of assumed values."""
    runs = [RunCase(number, tuning, mended) for tuning in study.tunings
            for number, case in enumerate(study.cases, start=1) for mended in variants(case)]
    of = study.sampling
    runs += [RunCase(of.case, of.tuning, wrong_signs(study.cases[of.case - 1]), STATED, period, r_2, of.end_s)
             for r_2 in of.r_2_per_s for period in of.periods_s]
    for number, change in enumerate(study.changes):
        for case in change.cases:
            wrong = wrong_signs(study.cases[case - 1])
            chosen = {"corrected": (wrong,), "printed": ((),), "both": ((), wrong)}[change.laws]
            runs += [RunCase(case, change.tuning, mended, number) for mended in dict.fromkeys(chosen)]
    return runs


def left_out(study: MaoStudy, case: RunCase) -> bool:
    """Whether a short report leaves out a sampling period or a single sign."""
    if case.end_s is not None:
        return study.leaves_out(study.sampling)
    alone = 0 < len(case.mended) < len(wrong_signs(study.cases[case.number - 1]))
    return alone and study.leaves_out(study.single_signs) and case.tuning in study.single_signs.tunings


def steps_of(study: MaoStudy, case: RunCase) -> float:
    """How many samples a run has."""
    return (case.end_s or study.horizon.end_s) / (case.period_s or study.tunings[case.tuning].period_s)


def event_times(study: MaoStudy) -> tuple[float, ...]:
    """When a mode, a part of the failure or the run begins, and when it ends; s."""
    times = {mode.start_s for mode in study.modes} | {part.from_s for part in study.failure} | {study.horizon.end_s}
    return tuple(sorted(time for time in times if time <= study.horizon.end_s))


def _tuning(study: MaoStudy, of: RunCase) -> Tuning:
    own = {"period_s": of.period_s, "r_2_per_s": of.r_2_per_s}
    return study.tunings[of.tuning].model_copy(update={key: value for key, value in own.items() if value})


def simulate(study: MaoStudy, of: RunCase) -> Run:
    """The run itself, with its whole log."""
    changed = study.changed(of.change)
    case, tuning = changed.cases[of.number - 1], _tuning(changed, of)
    return run_under(law_of(case, of.mended), changed, case, tuning, setting_of(changed, case, tuning, of.end_s))


def run_case(study: MaoStudy, of: RunCase) -> RunResult:
    """Run, and take what tables and figures need; a run that failed has its numbers up to its end."""
    run, case = simulate(study, of), study.cases[of.number - 1]
    found = stretches(run, event_times(study), study.horizon.settled_window_s)
    more = _more_curves(study, case, run) if of.change == STATED and of.end_s is None else {}
    row = trip_numbers(
        run, float(study.reference.curve().length_m), law=law_words(study, of),
        command_reversals_per_s=run.totals["command_reversals"] / max(run.end_s, run.period_s),
        command_change_mps2=run.totals["command_variation_mps2"] / max(1.0, run.totals["commands"]),
        loop_gain=_loop_gain(study, case, run), failure_learned_n=_failure_learned(study, case, run))
    return RunResult(of, row, {ERROR: error_curve(run)} | more, found, late_errors(run))


def late_errors(run: Run) -> tuple[float, float] | None:
    """RMS and largest size of a run's position errors from SETTLED_S on; None of one that failed or ended before."""
    error = run.position_error[run.column("t_s") >= SETTLED_S]
    return None if run.failed or not len(error) else (rms(error), float(np.abs(error).max()))


def name_of(study: MaoStudy, of: RunCase) -> str:
    """A run in words."""
    tuning = _tuning(study, of)
    return in_words(f"case {of.number}", law_words(study, of), tuning.title, study.change_title(of.change), None
                    if of.end_s is None else f"period {1e3 * tuning.period_s:g} ms, r_2 = {tuning.r_2_per_s:g}/s, "
                    f"until {of.end_s:g} s")


def law_words(study: MaoStudy, of: RunCase) -> str:
    """`as printed`, `corrected`, or which signs are."""
    law = study.cases[of.number - 1].law
    return "as printed" if law == "healthy" else laws.corrections(law, of.mended)


def _loop_gain(study: MaoStudy, case: CaseData, run: Run) -> float:
    """m_i k_nu rho_hat_i of the mode at the end: 1 if the estimate is right; it multiplies what they all do."""
    mode = sum(mode.start_s < run.end_s for mode in study.modes)
    failed = "failure" in case.events and run.end_s > min(part.from_s for part in study.failure)
    motors = 1 if case.law == "healthy" else study.train.motors - failed
    m = study.law.force_unit_n / (TONNE * study.train.mass_t)
    return float(m * motors * run.column(f"rho_hat_{mode}")[-1])


def _failure_learned(study: MaoStudy, case: CaseData, run: Run) -> float | None:
    """By how much the estimate of a constant failure grows while the first part of the failure lasts, N."""
    part = study.failure[0]
    if case.law == "healthy" or part.to_s is None or run.end_s < part.to_s:
        return None
    before, after = (int(np.searchsorted(run.column("t_s"), time)) - 1 for time in (part.from_s, part.to_s))
    grown = run.column("xi_hat_0")[after] - run.column("xi_hat_0")[before]
    return float(study.train.motors * study.law.force_unit_n * grown)


def _more_curves(study: MaoStudy, case: CaseData, run: Run) -> dict[str, Curve]:
    """Start, distance, command and, of laws that estimate failures, the force they take the failed motor to give."""
    time, columns = run.column("t_s"), {"distance": "s_m", "desired": "s_desired_m", "command": "u_mps2"}
    logged, first = {name: run.column(column) for name, column in columns.items()}, time <= START_S
    if case.law != "healthy":
        varpi = np.sin(study.law.omega_rad_s * time + study.law.phase_rad)
        estimate = study.train.motors * (run.column("xi_hat_0") + run.column("xi_hat_1") * varpi)
        logged["failure"] = study.law.force_unit_n / KILONEWTON * estimate
    return thinned_log(run, logged) | {"start": thinned("start", time[first], run.position_error[first])}


@dataclass(frozen=True)
class MaoResults(Results[MaoStudy, RunCase, RunResult]):
    """The runs by what tables, figures and findings ask for."""

    @property
    def numbers(self) -> range:
        """The cases, from 1."""
        return range(1, len(self.study.cases) + 1)

    @property
    def first_tuning(self) -> str:
        """The tuning that figures and the comparison show, by name."""
        return next(iter(self.study.tunings))

    def wrong(self, number: int) -> Signs:
        """The equations of a case's law whose printed sign is wrong."""
        return wrong_signs(self.study.cases[number - 1])

    def printed(self, number: int, tuning: str) -> RunResult:
        """The run of a case with the law as printed."""
        return self.runs[RunCase(number, tuning)]

    def corrected(self, number: int, tuning: str) -> RunResult:
        """The run of a case with all signs corrected; for the healthy law, which has none wrong, the only one."""
        return self.runs[RunCase(number, tuning, self.wrong(number))]

    def all_corrected(self, tuning: str) -> list[RunResult]:
        """Of every case the run with all signs corrected."""
        return [self.corrected(number, tuning) for number in self.numbers]

    def stated(self, tuning: str) -> list[RunResult]:
        """The runs of a tuning without any change, case by case."""
        return list(self.select(tuning=tuning, change=STATED, end_s=None).values())

    def sampled(self) -> list[RunResult]:
        """The runs that vary the sampling period and the damping."""
        return list(self.select(end_s=self.study.sampling.end_s).values())

    def left(self, run: RunResult) -> str:
        """Which wrong signs a run still has."""
        return ", ".join(f"({sign})" for sign in self.wrong(run.case.number) if sign not in run.case.mended) or "none"
