"""The tables of chen2019: the paper's statements, the runs by group, the bounds of its proof, forces, cost."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from operator import attrgetter

import numpy as np

from workbench.files.numbers import fixed, number
from workbench.paper.cells import Cell, Column, Phrase, Quantity
from workbench.paper.learning_comparison import rises, trial_columns
from workbench.paper.results import ResultTable
from workbench.paper.study_tables import ColumnOf, run_table, statement_table, verdict

from .. import laws as law
from ..simulation.cars_trials import CarsRun
from ..simulation.formulas import allowed_change, cef_change, first_cef, needed_force, trailer_force
from ..simulation.plans import law_values
from .runs import ChenResults, grows_from, outcome

LARGEST = "Largest values of all cars over the whole trip."
# How near to the reference a car is said to be on it.
NEAR_M, NEAR_MPS = 1.0, 0.1
# The tables of one change each: group, title, source, note.
GROUPS = (
    ("rules", "How the law is sampled", "the paper states neither step nor rule; claims 16.loop to 16.learning",
     "As stated: every millisecond, the acceleration that solves the loop (claim 16.exists), an estimate corrected by "
     "the error to which its sample led."),
    ("gains", "Stated and repaired gains", "claims 49.stated, 16.stated",
     "c_lambda > 0, the paper's own condition below (49), needs c_1 > 1/2."),
    ("masses", "Bounds of the mass and the loop through the acceleration", "Assumption 1; claims 16.unique, 16.stated",
     "An unsaturated car answers its law as if it weighed m + 1/c_3 less the estimate."),
    ("assumed", "How much the assumed data matter", "assumed values", ""))


def _trials(results: ChenResults) -> tuple[int, ...]:
    """The trials that the tables show: the paper's, and some between."""
    first, last = min(results.study.trials.shown), max(results.study.trials.shown)
    return tuple(sorted({first, last, *(trial for trial in (10, 20) if first < trial < last)}))


def _fall(name: str, unit: str, si: float, run: CarsRun) -> Cell:
    """First and last value of a run, and whether it fell."""
    values = getattr(run, name)
    return None if len(values) < 2 else verdict(bool(values[-1] < values[0]), "{} → {}", (
        Quantity(float(values[0]), "", si), Quantity(float(values[-1]), unit, si)))


def statements(results: ChenResults) -> ResultTable:
    """What section IV says of its figures beside what the runs gave."""
    study = results.study
    runs = {"as stated": results.stated} | {
        change.title: run for change, run in results.group("rules")
        if change.set.get("sampling.memory") == "same_sample" and "sampling.period_s" not in change.set}
    motors, trailers = results.motors_and_trailers

    def every(run: CarsRun) -> Cell:
        count, steps = rises(run.position_error) + rises(run.speed_error), 2 * (len(run.totals) - 1)
        early = f"; {outcome(run)}" if run.failed else ""
        return f"yes{early}" if count == 0 else Phrase(f"no: rises in {{}} of {{}} steps{early}", (count, steps))

    def zero(run: CarsRun) -> Cell:
        return Phrase("yes: {} m/s", (float(run.speed_error[-1]),)) if len(run.totals) else None

    def near(run: CarsRun) -> Cell:
        last = max((trial for trial in study.trials.shown if trial in run.logs), default=None)
        if last != study.trials.count:
            return None
        shares = tuple(100 * float(np.mean(np.abs(run.log(last, name)) < border))
                       for name, border in (("speed_error_mps", NEAR_MPS), ("position_error_m", NEAR_M)))
        return Phrase(f"within {NEAR_MPS:g} m/s for {{}} %, within {NEAR_M:g} m for {{}} % of the trip", shares)

    def traction(run: CarsRun) -> Cell:
        most = float(run.of_cars("force_max")[:, trailers].max()) if trailers and len(run.totals) else 0.0
        return verdict(most <= 0, "trailers at most {} N", (most,))

    def braking(run: CarsRun) -> Cell:
        if not len(run.totals):
            return None
        weakest = [-float(run.of_cars("force_min")[trial].max()) for trial in (0, -1)]
        return verdict(min(weakest) > 0, "each up to {} or more in the first, {} or more in the last trial",
                       [Quantity(force, "kN", 1e3) for force in weakest])

    def more(run: CarsRun) -> Cell:
        if run.failed is not None or grows_from(run.difference) is not None:
            return f"no: {outcome(run)}"
        longer = next((other for _, other in results.with_more_trials()), None)
        if run is results.stated and longer is None and results.lacks_more_trials:
            return "run further with --full"
        if run is not results.stated or longer is None or longer.failed is not None:
            return "yes, as far as they ran" if rises(run.position_error) == 0 else f"no: {outcome(run)}"
        return Phrase(f"{{}} m and {{}} m/s after {{}} ({outcome(longer)})",
                      (float(longer.position_error[-1]), float(longer.speed_error[-1]), len(longer.totals)))

    return statement_table(
        "What the paper says of its figures, and what came out", "paper, section IV, Figures 1-9",
        runs, [
            ("the position errors shrink from the first to the last iteration", "yes (Figures 1-5)",
             partial(_fall, "position_error", "m", 1.0)),
            ("so do the speed errors", "yes (Figures 1-5)", partial(_fall, "speed_error", "m/s", 1.0)),
            ("the largest errors fall from iteration to iteration", "yes (Figure 5)", every),
            ("the largest speed error is not eliminated", "yes (Figure 5)", zero),
            ("the errors stay around zero in most of the last trip", "yes (Figure 4)", near),
            (f"traction comes from the motor cars alone ({', '.join(str(car + 1) for car in motors)})",
             "yes (Figures 6, 7)", traction),
            ("all cars brake", "yes (Figures 6, 7)", braking),
            ("the difference between actual and unsaturated input shrinks", "yes (Figures 8, 9)",
             partial(_fall, "difference", "kN", 1e3)),
            ("more iterations would reduce the errors further", "yes (section IV)", more)],
        f"The paper prints no number of an error; its figures are not in the text. {LARGEST}")


def groups(results: ChenResults) -> Iterator[ResultTable]:
    """The stated run and those of a group of changes, a table a group."""
    trials = _trials(results)
    ends = trials[0], trials[-1]
    columns: list[ColumnOf[CarsRun]] = [
        *trial_columns(Column("|e_s| (m)", "m"), attrgetter("position_error"), trials, 1),
        *trial_columns(Column("|e_v| (m/s)", "m/s"), attrgetter("speed_error"), ends, 1),
        *trial_columns(Column("|Δu| (kN)", "kN", 1e3), attrgetter("difference"), ends, 1), ("Outcome", outcome)]
    for group, name, source, note in GROUPS:
        runs = [("as stated", results.stated), *((change.title, run) for change, run in results.group(group))]
        if len(runs) > 1:
            yield run_table(name, source, ("Run",), (((title,), run) for title, run in runs), columns,
                            f"{LARGEST} {note}".strip())


def bounds(results: ChenResults) -> ResultTable:
    """The inequalities of the proof along the stated run."""
    study, run = results.study, results.stated
    values = {symbol: law_values(study)[str(symbol)] for symbol in law.gains}
    c_lambda = min(float(x.subs(values)) for x in law.c_lambda_candidates)
    c_z, any_gains = min(study.gains.c_1, study.gains.c_2), float(law.any_gains.subs(values))
    change, allowed = cef_change(run), allowed_change(study, run)
    energy = first_cef(study) + np.concatenate([[0.0], np.cumsum(change)])
    lamda, differences = run.total("lambda_square_s"), run.total("difference_square_s")
    plain = study.line.seen_by == "nowhere" and study.variation.swing == 0
    shown = [trial - 1 for trial in _trials(results) if trial <= len(run.totals)]
    return ResultTable(
        "The inequalities of the proof along the stated run", "claims 35, 51, 51.any_gains, theorem1.3.stated",
        ("Trial", "E_i − E_{i−1}", "at most, by (35)", "∫|λ|² / ∫|Δu|²", "at most, for all gains", "as (51) prints it",
         Column("∫|e_s|²", "m² s"), "at most, by the corrected (54)"),
        tuple((i + 1, float(change[i]), float(allowed[i]), float(lamda[i] / differences[i]), any_gains,
               study.gains.c_3 / (2 * c_lambda), float(run.total("position_error_square_s")[i]),
               float(2 / c_z * energy[i] + 2 * any_gains * differences[i]) if plain else None) for i in shown),
        "At t = T, SI units. (51) and (54) as printed are for c_lambda > 0; the stated gains give c_lambda = "
        f"{number(c_lambda)}. E holds the squared error of the coupler's stiffness, of which hardly anything is "
        "learned since the couplers hardly stretch; so (54) bounds little.")


def forces(results: ChenResults) -> ResultTable:
    """What the reference asks of the train on level track."""
    study, ref, train = results.study, results.study.reference, results.study.train
    rows: list[tuple[Cell, ...]] = []
    for what, speed, rate in (
            ("start", 0.0, ref.acceleration_mps2), ("end of the acceleration", ref.cruise_mps, ref.acceleration_mps2),
            ("cruise", ref.cruise_mps, 0.0), ("begin of the braking", ref.cruise_mps, -ref.braking_mps2),
            ("end of the braking", 0.0, -ref.braking_mps2)):
        need, trailer = needed_force(study, speed, rate), trailer_force(study, speed, rate)
        limit = len(results.motors_and_trailers[0]) * train.traction_n if need > 0 else train.cars * train.braking_n
        stretch = Quantity(trailer / train.coupler_n_per_m, "mm", 1e-3) if trailer > 0 else "brakes itself"
        rows.append((what, speed, rate, need, limit, Quantity(abs(need) / limit, "%", 0.01), trailer, stretch))
    return ResultTable(
        "What the reference asks of the train", "claim A2; Table 1, limits of section IV, level track",
        ("Phase", Column("Speed", "m/s", decimals=1), Column("Acceleration", "m/s²", decimals=2),
         Column("All cars", "kN", 1e3, decimals=1), Column("Available", "kN", 1e3, decimals=0), "Used",
         Column("Each trailer", "kN", 1e3, decimals=2), "Coupler pulling one trailer"), tuple(rows),
        "The train as a whole can follow its reference; a trailer cannot: whatever it needs forwards must come through "
        "a coupler, which pulls only when the cars are not at the same place.")


def cost(results: ChenResults) -> ResultTable:
    """Time of a sample, and of a step of MPC, against the number of cars."""
    study, measured = results.study, results.measured
    cars = ", ".join("motor car" if car == "1" else "trailer" for car in study.train.motor_pattern)
    of_mpc = {trip.cars: (trip.step_s, trip.step_s_p99) for trip in measured.longer}
    return ResultTable(
        "What a sample costs", f"trains of {cars} and so on, {study.cost.end_s:g} s, fastest of {study.cost.trials} trials",
        ("Cars", Column("a sample", "µs", 1e-6), Column("a sample and car", "µs", 1e-6),
         Column(f"{study.trials.count} trials of {study.reference.trip_time_s:g} s", "s"),
         Column("Memory of the estimates", "MB", 1e6), Column("a step of MPC", "µs", 1e-6), Column("p99", "µs", 1e-6)),
        tuple((count, step_s, step_s / count, step_s * study.samples * study.trials.count,
               8.0 * study.samples * (3 * count + 3), *of_mpc.get(count, (None, None)))
              for count, step_s in measured.by_length.items()),
        f"Train and law together, one core, compiling left out. The time grows as the number of cars to the power "
        f"{fixed(measured.exponent, 2)}. MPC of all cars, as beside it.")


TABLES = (statements, groups, bounds, forces, cost)
