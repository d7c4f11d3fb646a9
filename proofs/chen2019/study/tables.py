"""The tables of chen2019: the paper's statements, the runs by group, the bounds of its proof, forces, cost."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from workbench.files.numbers import NOTHING, fixed, number
from workbench.paper.results import ResultTable

from .. import laws as law
from ..simulation.cars_trials import Array, CarsRun
from .outcomes import (
    NEAR_M,
    NEAR_MPS,
    Found,
    allowed_change,
    cef_change,
    difference,
    exponent,
    first_cef,
    grows_from,
    needed_force,
    outcome,
    position_error,
    rises,
    speed_error,
    trailer_force,
)
from .runs import STATED, law_values, title

LARGEST = "Largest values of all cars over the whole trip."


def all_tables(found: Found) -> tuple[ResultTable, ...]:
    """All tables, in the order of the page."""
    return (statements(found), rules(found), gains(found), masses(found), assumed(found), bounds(found), forces(found),
            cost(found))


def at(values: Array, trial: int, digits: int = 3, scale: float = 1.0) -> str:
    """A value of a trial, counted from 1; a dash where the run had ended."""
    return number(scale * float(values[trial - 1]), digits) if trial <= len(values) else NOTHING


def _trials(found: Found) -> tuple[int, ...]:
    """The trials that the tables show: the paper's, and some between."""
    first, last = min(found.study.trials.shown), max(found.study.trials.shown)
    return tuple(sorted({first, last, *(trial for trial in (10, 20) if first < trial < last)}))


def _fall(values: Array, unit: str, scale: float = 1.0) -> str:
    """First and last value of a run, and whether it fell."""
    if len(values) < 2:
        return NOTHING
    word = "yes" if values[-1] < values[0] else "no"
    return f"{word}: {number(scale * float(values[0]))} → {number(scale * float(values[-1]))} {unit}"


def statements(found: Found) -> ResultTable:
    """What section IV says of its figures beside what the runs gave."""
    chosen = [STATED, *(i for i, change in enumerate(found.study.changes)
                        if change.group == "rules" and change.set.get("sampling.memory") == "same_sample"
                        and "sampling.period_s" not in change.set)]
    runs = [found.runs[i] for i in chosen]
    motors, trailers = found.motors_and_trailers

    def every(run: CarsRun) -> str:
        count, steps = rises(position_error(run)) + rises(speed_error(run)), 2 * (len(run.totals) - 1)
        early = f"; {outcome(run)}" if run.failed else ""
        return ("yes" if count == 0 else f"no: rises in {count} of {steps} steps") + early

    def zero(run: CarsRun) -> str:
        return f"yes: {number(float(speed_error(run)[-1]))} m/s" if len(run.totals) else NOTHING

    def near(run: CarsRun) -> str:
        shown = [trial for trial in found.study.trials.shown if trial in run.logs]
        if not shown or max(shown) != found.study.trials.count:
            return NOTHING
        speed, position = run.log(max(shown), "speed_error_mps"), run.log(max(shown), "position_error_m")
        return (f"within {NEAR_MPS:g} m/s for {_share(np.abs(speed) < NEAR_MPS)}, within {NEAR_M:g} m for "
                f"{_share(np.abs(position) < NEAR_M)} of the trip")

    def traction(run: CarsRun) -> str:
        most = float(run.of_cars("force_max")[:, trailers].max()) if trailers and len(run.totals) else 0.0
        return f"{'yes' if most <= 0 else 'no'}: trailers at most {number(most)} N"

    def braking(run: CarsRun) -> str:
        if not len(run.totals):
            return NOTHING
        weakest = [-float(run.of_cars("force_min")[trial].max()) / 1e3 for trial in (0, -1)]
        return (f"{'yes' if min(weakest) > 0 else 'no'}: each up to {number(weakest[0])} kN or more in the first, "
                f"{number(weakest[1])} kN or more in the last trial")

    def more(run: CarsRun) -> str:
        if run.failed is not None or grows_from(difference(run)) is not None:
            return f"no: {outcome(run)}"
        longer = next((other for change, other in found.group("assumed") if set(change.set) == {"trials.count"}), None)
        if run is not found.stated or longer is None or longer.failed is not None:
            return "yes, as far as they ran" if rises(position_error(run)) == 0 else f"no: {outcome(run)}"
        return (f"{number(float(position_error(longer)[-1]))} m and {number(float(speed_error(longer)[-1]))} m/s after "
                f"{len(longer.totals)} ({outcome(longer)})")

    rows = [
        ("the position errors shrink from the first to the last iteration", "yes (Figures 1-5)",
         *(_fall(position_error(run), "m") for run in runs)),
        ("so do the speed errors", "yes (Figures 1-5)", *(_fall(speed_error(run), "m/s") for run in runs)),
        ("the largest errors fall from iteration to iteration", "yes (Figure 5)", *map(every, runs)),
        ("the largest speed error is not eliminated", "yes (Figure 5)", *map(zero, runs)),
        ("the errors stay around zero in most of the last trip", "yes (Figure 4)", *map(near, runs)),
        (f"traction comes from the motor cars alone ({', '.join(str(car + 1) for car in motors)})",
         "yes (Figures 6, 7)", *map(traction, runs)),
        ("all cars brake", "yes (Figures 6, 7)", *map(braking, runs)),
        ("the difference between actual and unsaturated input shrinks", "yes (Figures 8, 9)",
         *(_fall(difference(run), "kN", 1e-3) for run in runs)),
        ("more iterations would reduce the errors further", "yes (section IV)", *map(more, runs)),
    ]
    return ResultTable(
        "What the paper says of its figures, and what came out", "paper, section IV, Figures 1-9",
        ("Statement", "Printed", *(title(found.study, i) for i in chosen)), tuple(rows),
        f"The paper prints no number of an error; its figures are not in the text. {LARGEST}")


def _share(which: NDArray[np.bool_]) -> str:
    return f"{number(100 * float(np.mean(which)))} %"


def _runs_table(found: Found, name: str, source: str, group: str, note: str) -> ResultTable:
    trials = _trials(found)
    first, last = trials[0], trials[-1]
    rows = []
    for label, run in (("as stated", found.stated), *((c.title, run) for c, run in found.group(group))):
        rows.append((
            label, *(at(position_error(run), trial) for trial in trials), at(speed_error(run), first),
            at(speed_error(run), last), at(difference(run), first, scale=1e-3), at(difference(run), last, scale=1e-3),
            outcome(run)))
    header = ("Run", *(f"|e_s| (m), trial {trial}" for trial in trials), f"|e_v| (m/s), trial {first}",
              f"|e_v| (m/s), trial {last}", f"|Δu| (kN), trial {first}", f"|Δu| (kN), trial {last}", "Outcome")
    return ResultTable(name, source, header, tuple(rows), f"{LARGEST} {note}".strip())


def rules(found: Found) -> ResultTable:
    """How the continuous law is sampled."""
    return _runs_table(
        found, "How the law is sampled", "the paper states neither step nor rule; claims 16.loop to 16.learning",
        "rules", "As stated: every millisecond, the acceleration that solves the loop (claim 16.exists), an estimate "
        "corrected by the error to which its sample led.")


def gains(found: Found) -> ResultTable:
    """The stated gains beside the repaired ones."""
    return _runs_table(found, "Stated and repaired gains", "claims 49.stated, 16.stated", "gains",
                       "c_λ > 0, the paper's own condition below (49), needs c_1 > 1/2.")


def masses(found: Found) -> ResultTable:
    """The bounds of Assumption 1, on which the loop through the acceleration depends."""
    return _runs_table(
        found, "Bounds of the mass and the loop through the acceleration", "Assumption 1; claims 16.unique, 16.stated",
        "masses", "An unsaturated car answers its law as if it weighed m + 1/c_3 less the estimate.")


def assumed(found: Found) -> ResultTable:
    """One assumed value changed at a time."""
    return _runs_table(found, "How much the assumed data matter", "assumed values", "assumed", "")


def bounds(found: Found) -> ResultTable:
    """The inequalities of the proof along the stated run."""
    study, run = found.study, found.stated
    values = {symbol: law_values(study)[str(symbol)] for symbol in law.gains}
    c_lambda = min(float(x.subs(values)) for x in law.c_lambda_candidates)
    c_z = min(study.gains.c_1, study.gains.c_2)
    any_gains = float(law.any_gains.subs(values))
    change, allowed = cef_change(run), allowed_change(study, run)
    energy = first_cef(study) + np.concatenate([[0.0], np.cumsum(change)])
    lamda, differences = run.total("lambda_square_s"), run.total("difference_square_s")
    plain = study.line.seen_by == "nowhere" and study.variation.swing == 0
    rows = []
    for trial in (trial for trial in _trials(found) if trial <= len(run.totals)):
        i = trial - 1
        bound = 2 / c_z * energy[i] + 2 * any_gains * differences[i]
        rows.append((
            str(trial), number(float(change[i])), number(float(allowed[i])),
            number(float(lamda[i] / differences[i])), number(any_gains), number(study.gains.c_3 / (2 * c_lambda)),
            number(float(run.total("position_error_square_s")[i])), number(float(bound)) if plain else NOTHING))
    return ResultTable(
        "The inequalities of the proof along the stated run", "claims 35, 51, 51.any_gains, theorem1.3.stated",
        ("Trial", "E_i − E_{i−1}", "at most, by (35)", "∫|λ|² / ∫|Δu|²", "at most, for all gains", "as (51) prints it",
         "∫|e_s|² (m² s)", "at most, by the corrected (54)"), tuple(rows),
        "At t = T, SI units. (51) and (54) as printed are for c_λ > 0; the stated gains give c_λ = "
        f"{number(c_lambda)}. E holds the squared error of the coupler's stiffness, of which hardly anything is "
        "learned since the couplers hardly stretch; so (54) bounds little.")


def forces(found: Found) -> ResultTable:
    """What the reference asks of the train on level track."""
    study = found.study
    ref, train = study.reference, study.train
    motors, _ = found.motors_and_trailers
    rows = []
    for what, speed, rate in (
            ("start", 0.0, ref.acceleration_mps2), ("end of the acceleration", ref.cruise_mps, ref.acceleration_mps2),
            ("cruise", ref.cruise_mps, 0.0), ("begin of the braking", ref.cruise_mps, -ref.braking_mps2),
            ("end of the braking", 0.0, -ref.braking_mps2)):
        need = needed_force(study, speed, rate)
        given = len(motors) * train.traction_n if need > 0 else train.cars * train.braking_n
        trailer = trailer_force(study, speed, rate)
        stretch = f"{number(1e3 * trailer / train.coupler_n_per_m)} mm" if trailer > 0 else "brakes itself"
        rows.append((what, fixed(speed, 1), fixed(rate, 2), fixed(need / 1e3, 1), fixed(given / 1e3, 0),
                     f"{number(100 * abs(need) / given)} %", fixed(trailer / 1e3, 2), stretch))
    return ResultTable(
        "What the reference asks of the train", "claim A2; Table 1, limits of section IV, level track",
        ("Phase", "Speed (m/s)", "Acceleration (m/s²)", "All cars (kN)", "Available (kN)", "Used", "Each trailer (kN)",
         "Coupler pulling one trailer"), tuple(rows),
        "The train as a whole can follow its reference; a trailer cannot: whatever it needs forwards must come through "
        "a coupler, which pulls only when the cars are not at the same place.")


def cost(found: Found) -> ResultTable:
    """Time of a sample against the number of cars."""
    run, study = found.stated, found.study
    rows = [(str(p.cars), number(p.step_us), number(p.car_us), number(p.step_us * study.samples * study.trials.count
                                                                      / 1e6),
             number(8e-6 * study.samples * (3 * p.cars + 3))) for p in found.cost]
    return ResultTable(
        "What a sample costs", f"trains of {' '.join(study.train.motor_pattern)} …, {study.cost.end_s:g} s, fastest of "
        f"{study.cost.trials} trials",
        ("Cars", "µs a sample", "µs a sample and car", f"{study.trials.count} trials of "
         f"{study.reference.trip_time_s:g} s (s)", "Memory of the estimates (MB)"), tuple(rows),
        f"Train and law together, one core, compiling left out. The time grows as the number of cars to the power "
        f"{fixed(exponent(found.cost), 2)}. The stated run itself: {number(float(run.step_us.min()))} µs a sample in "
        "its fastest trial.")
