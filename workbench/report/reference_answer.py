"""What `workbench reference` answers: solves what was asked, writes it, and says it in a few lines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from workbench.errors import InputError
from workbench.files.json_output import write_json
from workbench.files.numbers import counted
from workbench.files.units import KWH_J
from workbench.optimal.bound_document import write_certificate
from workbench.optimal.certified_export import COLUMNS as CERTIFIED_COLUMNS
from workbench.optimal.certified_export import certified_document, certified_rows
from workbench.optimal.course import Course
from workbench.optimal.envelope import InfeasibleRunError
from workbench.optimal.export import EXACT_DIGITS, reference_document, samples, smooth_gap, write_csv
from workbench.optimal.inputs.etcs import Supervision, supervised
from workbench.optimal.inputs.files import notes_together
from workbench.optimal.inputs.journey import load_timetable
from workbench.optimal.inputs.line import Line, course
from workbench.optimal.reference import Reference, find_reference, find_timed_reference, least_time
from workbench.optimal.regimes import time_shares
from workbench.optimal.smooth import WINDOW_S, SmoothReference, smooth_reference
from workbench.optimal.timetable import Timetable, as_timetable
from workbench.optimal.vehicle import Vehicle
from workbench.optimal.verify_smooth import SmoothCheck, check_smooth
from workbench.report.bound_check import checked_bound
from workbench.report.reference_request import Request, certified_file, couplers_file, of_cars_file, table_file
from workbench.report.timing_lines import timing_lines

if TYPE_CHECKING:
    from workbench.optimal.cars.car_train import CarTrain
    from workbench.optimal.cars.multi_car import CarsRun

# Share of a limit by which sums of rounding may seem to pass it.
ROUNDING = 1e-9
# A run that arrives within this of its time is in time: what is told has tenths.
EARLY_S = 0.5
# A smooth run is later by its window, and keeps back what its average would pass: near the least time that is too much.
WINDOWS_S = (WINDOW_S, 0.5, 0.2)


def answered(asked: Request, line: Line, vehicle: Vehicle, train: CarTrain | None,
             notes: tuple[str, ...], etcs: Supervision | None = None) -> Iterator[str]:
    """Lines for the reader as they come; raises InputError and InfeasibleRunError before anything is written."""
    if asked.timetable:
        yield from _timed_run(asked, line, vehicle, train, notes, etcs)
        return
    to_m = line.length_m if asked.to_m is None else asked.to_m
    stops = line.stops_between(asked.from_m, to_m) if asked.serve_stops else ()
    run = course(line, vehicle, asked.from_m, to_m, stops)
    if etcs:
        run = supervised(run, vehicle, etcs, asked.end_mps)
    dwell = asked.dwell_s * len(stops)
    if asked.trip_time_s is None:
        least = least_time(vehicle, run, asked.start_mps, asked.end_mps).trip_time_s + dwell
        raise InputError("", "--time", f"is missing: give a trip time of {least:.1f} s or more, the least feasible "
                         f"one{_with_stops(stops, asked.dwell_s)}")
    if asked.check:
        yield checked_bound(asked, vehicle, run, as_timetable(run, asked.trip_time_s - dwell))
        return
    found, smooth = _solve(asked, vehicle, run, dwell)
    cars = _cars(train, line, run, smooth)
    answer = _Answer(found, smooth, check_smooth(vehicle, run, smooth.run), cars)
    yield from _told(asked, line, vehicle, run, notes, answer, stops)


@dataclass(frozen=True)
class _Answer:
    """What was found: the optimal run, the smooth one and its simulation, and the cars where the train states them."""

    found: Reference
    smooth: SmoothReference
    driven: SmoothCheck
    cars: CarsRun | None


def _cars(train: CarTrain | None, line: Line, run: Course, smooth: SmoothReference) -> CarsRun | None:
    if train is None:
        return None
    from workbench.optimal.cars.multi_car import car_course, run_cars  # noqa: PLC0415 - expressions, which others lack

    return run_cars(train, run, car_course(line, train), smooth.run)


def _timed_run(asked: Request, line: Line, vehicle: Vehicle, train: CarTrain | None,
               notes: tuple[str, ...], etcs: Supervision | None) -> Iterator[str]:
    """The lines of a run by timetable, which says where it begins and ends and where it stops."""
    assert asked.timetable is not None
    for name, is_given in (("--time", asked.trip_time_s is not None), ("--stops", asked.serve_stops),
                        ("--from-m", asked.from_m != 0), ("--to-m", asked.to_m is not None)):
        if is_given:
            raise InputError("", name, "does not go with --timetable, which says it: leave it out")
    journey = load_timetable(asked.timetable, line.name, line.length_m, asked.dwell_s)
    speeds: list[float] = []
    for name, given, stated in (("--from-speed", asked.start_mps, journey.start_mps),
                                ("--to-speed", asked.end_mps, journey.end_mps)):
        if stated is not None and given not in (0, stated):
            raise InputError("", name, f"{given:g} m/s contradicts the timetable, which says {stated:g} m/s: leave it "
                             "out")
        speeds.append(given if stated is None else stated)
    asked = replace(asked, start_mps=speeds[0], end_mps=speeds[1])
    timetable = journey.timetable
    run = timetable.on(course(line, vehicle, timetable.points[0].position_m, timetable.points[-1].position_m))
    if etcs:
        run = supervised(run, vehicle, etcs, speeds[1])
    if asked.check:
        yield checked_bound(asked, vehicle, run, timetable)
        return
    found = find_timed_reference(vehicle, run, timetable, speeds[0], speeds[1], asked.intervals, asked.solver)
    smooth = _smooth(asked, vehicle, run, timetable, found)
    cars = _cars(train, line, run, smooth)
    answer = _Answer(found, smooth, check_smooth(vehicle, run, smooth.run), cars)
    yield from _told(asked, line, vehicle, run, notes, answer, run.stops_m)


def _told(asked: Request, line: Line, vehicle: Vehicle, run: Course, notes: tuple[str, ...], answer: _Answer,
          stops: tuple[float, ...]) -> Iterator[str]:
    """Notes, summary, timing points, and what was written."""
    found, smooth, cars = answer.found, answer.smooth, answer.cars
    for note in (*notes, *notes_together(line, vehicle)):
        yield f"note: {note}"
    if asked.window_s is None and smooth.window_s < WINDOW_S:
        yield f"note: smoothing over {WINDOW_S:g} s takes more time than there is: over {smooth.window_s:g} s here"
    yield from _summary(asked, line, vehicle, found, stops)
    yield from _of_smooth(answer)
    if asked.timetable:
        yield from timing_lines(found, smooth)
    if cars:
        yield from _of_cars(cars)
    yield from _written(asked, vehicle, run, answer)


def _solve(asked: Request, vehicle: Vehicle, run: Course, dwell_s: float) -> tuple[Reference, SmoothReference]:
    assert asked.trip_time_s is not None
    ends = asked.start_mps, asked.end_mps
    found = find_reference(vehicle, run, asked.trip_time_s, *ends, asked.intervals, asked.solver, dwell_s)
    return found, _smooth(asked, vehicle, run, asked.trip_time_s, found)


def _smooth(asked: Request, vehicle: Vehicle, run: Course, within: Timetable | float,
            found: Reference) -> SmoothReference:
    """Over the window asked for, else over the longest of WINDOWS_S that leaves time enough."""
    for window_s in WINDOWS_S if asked.window_s is None else (asked.window_s,):
        try:
            return smooth_reference(vehicle, run, within, window_s, asked.max_jerk_mps3, asked.dwell_s, asked.start_mps,
                                    asked.end_mps, asked.intervals, asked.solver, found)
        except InfeasibleRunError as trouble:
            last = trouble
    raise InfeasibleRunError(f"the run itself is feasible, its smooth reference is not: {last}; or choose a shorter "
                             "--window", last.least_time_s)


def _with_stops(stops: tuple[float, ...], dwell_s: float) -> str:
    return f" with {counted(len(stops), 'stop')} of {dwell_s:g} s" if stops else ""


def _summary(asked: Request, line: Line, vehicle: Vehicle, found: Reference,
             stops: tuple[float, ...]) -> Iterator[str]:
    length = found.profile.course.length_m
    if asked.timetable:
        took = found.clock_s[-1] - found.clock_s[0]
        yield (f"{vehicle.name} on {line.name}: {length / 1e3:.3f} km in {took:.1f} s by {asked.timetable.name}; "
               f"running alone takes {found.least_time_s:.1f} s at least")
    else:
        yield (f"{vehicle.name} on {line.name}: {length / 1e3:.3f} km in {asked.trip_time_s:g} s"
               f"{_with_stops(stops, asked.dwell_s)}; the least feasible is "
               f"{found.least_time_s + asked.dwell_s * len(stops):.1f} s")
        yield from _early(asked, found, asked.dwell_s * len(stops))
    yield from _line_as_read(line, found)
    yield (f"energy        {found.energy_j / KWH_J:.3f} kWh, any run takes at least "
           f"{found.lower_bound_j / KWH_J:.3f} kWh: gap {100 * found.gap:.3f} %, {found.status}")
    if found.waits_j:
        yield f"waiting       auxiliaries draw {found.waits_j / KWH_J:.3f} kWh of it at stops"
    yield (f"solved        by {found.solver} in {1e3 * found.solve_s:.0f} ms, "
           f"{len(found.profile.half_square) - 1} cells in the driven run")
    shares = ", ".join(f"{what} {100 * share:.0f} %" for what, share in time_shares(vehicle, found.profile).items())
    yield f"regimes       {shares} of the time"
    check = found.check
    yield (f"simulated     {check.energy_j / KWH_J:.3f} kWh; drift {check.position_drift_m:.2g} m, "
           f"{check.speed_drift_mps:.2g} m/s under corrections up to {check.correction_n:.2g} N; forces "
           f"{_kept(check.force_excess)}, speed {check.speed_excess_mps:.2g} m/s beyond its limit")


def _line_as_read(line: Line, found: Reference) -> Iterator[str]:
    """What was read of the line and how fast the run is, in the units that timetables have: a wrong one is seen."""
    grades, limits = ([value for _, value in rows] for rows in (line.grades, line.limits))
    said = [f"grades {_from_to(f'{min(grades):g}', f'{max(grades):g}')} per mille"]
    stated = [limit for limit in limits if limit < math.inf]
    if stated:
        said.append(f"limits {_from_to(_kmh(min(stated)), _kmh(max(stated)))} km/h")
    top, mean = float(found.profile.speed_mps.max()), found.profile.course.length_m / found.profile.trip_time_s
    yield f"line          {', '.join(said)}; the run at most {_kmh(top)} km/h, {_kmh(mean)} km/h on average"


def _from_to(least: str, most: str) -> str:
    return least if least == most else f"{least} to {most}"


def _kmh(speed_mps: float) -> str:
    return f"{3.6 * speed_mps:.3g}"


def _early(asked: Request, found: Reference, waited_s: float) -> Iterator[str]:
    """That the run of least energy arrives before the time, where it does: what a later one saves it draws besides."""
    arrives = found.profile.trip_time_s + waited_s
    if asked.trip_time_s is not None and arrives < asked.trip_time_s - EARLY_S:
        why = ", for auxiliaries draw all the while" if found.vehicle.auxiliary_w else ""
        yield (f"arrives       after {arrives:.1f} s, {asked.trip_time_s - arrives:.1f} s early: a later arrival takes "
               f"no less energy{why}")


def _kept(excess: float) -> str:
    return "within their limits" if excess <= ROUNDING else f"{100 * excess:.2g} % BEYOND their limits"


def _of_smooth(answer: _Answer) -> Iterator[str]:
    smooth, driven = answer.smooth, answer.driven
    yield (f"smooth        {smooth.energy_j / KWH_J:.3f} kWh with acceleration averaged over {smooth.window_s:.3g} s: "
           f"gap {100 * smooth_gap(answer.found, smooth):.3f} %, jerk up to {smooth.max_jerk_mps3:.3g} m/s^3, forces "
           f"{_kept(smooth.force_excess)}, speed {smooth.speed_excess_mps:.2g} m/s beyond its limit")
    pull, brake = smooth.usable
    if min(pull, brake) < 1:
        yield (f"reserve       smoothing keeps back up to {100 * (1 - pull):.2g} % of traction and "
               f"{100 * (1 - brake):.2g} % of the brakes at places, which takes "
               f"{(smooth.energy_j - smooth.unreserved_energy_j) / KWH_J:+.3f} kWh")
    yield (f"simulated     {driven.energy_j / KWH_J:.3f} kWh smooth; drift {driven.position_drift_m:.2g} m, "
           f"{driven.speed_drift_mps:.2g} m/s under corrections up to {driven.correction_n:.2g} N")


def _of_cars(cars: CarsRun) -> Iterator[str]:
    planned, works = float(np.abs(cars.planned_coupler_n).max()), cars.works
    yield (f"cars          {cars.train.cars} by {cars.rule}: {cars.energy_j / KWH_J:.3f} kWh simulated, dampers take "
           f"{works['damper_j'] / KWH_J:.2g} kWh; the bound is that of the train as one body: resistance and line take "
           f"{100 * (works['resistance_j'] / cars.one_body_j - 1):+.2g} % beside it; balance open by "
           f"{cars.residual_j:.2g} J")
    yield (f"couplers      carry up to {cars.peak_coupler_n.max() / 1e3:.4g} kN ({planned / 1e3:.4g} kN between cars "
           f"that keep together) and stretch up to {cars.stretch_m:.2g} m; drift {cars.position_drift_m:.2g} m, "
           f"{cars.speed_drift_mps:.2g} m/s under corrections up to {cars.correction_n:.2g} N; forces at most "
           f"{100 * cars.force_excess:.2g} % beyond a car's limits")


def _written(asked: Request, vehicle: Vehicle, run: Course, answer: _Answer) -> Iterator[str]:
    table, found, smooth, cars = table_file(asked), answer.found, answer.smooth, answer.cars
    rows, of_bound = certified_rows(vehicle, found.profile), certified_file(table)
    if table:
        write_csv(table, samples(vehicle, run, smooth.run, asked.every_s))
        yield f"reference: {table}"
    if of_bound:
        write_csv(of_bound, rows, CERTIFIED_COLUMNS, EXACT_DIGITS)
        yield f"certified run: {of_bound}"
    more = {}
    if table and cars:
        from workbench.optimal.cars.cars_document import cars_document, write_cars_csv  # noqa: PLC0415 - as in `_cars`

        of_cars = of_cars_file(table)
        write_cars_csv(of_cars, cars, asked.every_s)
        more = {"cars": cars_document(cars) | {"csv": str(of_cars)}}
        yield f"cars: {of_cars}"
    if asked.json:
        certified = certified_document(found, rows, str(of_bound) if of_bound else None)
        write_json(asked.json, reference_document(found, smooth, answer.driven)
                   | {"csv": str(table), "certified": certified} | more)
        yield f"result: {asked.json}"
    if asked.certificate:
        proven = write_certificate(asked.certificate, vehicle, run, found, asked.start_mps, asked.end_mps)
        yield (f"certificate: {asked.certificate} proves {proven / KWH_J:.6g} kWh in exact arithmetic"
               f"{' of the time without stops' if found.waits_j else ''}")
    if asked.figure:
        # Matplotlib takes as long to import as a run takes to be solved.
        from workbench.report.cars_figure import couplers_figure  # noqa: PLC0415
        from workbench.report.reference_figure import save_figure, saved  # noqa: PLC0415

        save_figure(asked.figure, vehicle, found.profile, f"{vehicle.name}, {run.length_m / 1e3:.3f} km in "
                    f"{found.profile.trip_time_s:.0f} s, {found.energy_j / KWH_J:.2f} kWh", found.timetable)
        yield f"figure: {asked.figure}"
        if not cars:
            return
        couplers = couplers_file(asked.figure)
        saved(couplers, lambda faint: couplers_figure(cars, faint))
        yield f"figure: {couplers}"
