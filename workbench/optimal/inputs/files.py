"""The line and the vehicle of an optimal run, from whatever file holds them.

What makes them is imported once a file has been read, so that what is wrong with a path is said at once.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from workbench.errors import InputError
from workbench.files.toml import load_record, read_toml

if TYPE_CHECKING:
    from workbench.optimal.cars.car_train import CarTrain
    from workbench.optimal.inputs.line import Line
    from workbench.optimal.inputs.train_file import TrainFile
    from workbench.optimal.vehicle import Vehicle
    from workbench.trains.track import Track

Notes = tuple[str, ...]
LEAST_STEEPEST = 0.2  # per mille: a line none of whose grades is steeper has them in another unit, or none


def load_line(path: Path) -> tuple[Line, Notes]:
    """A line from a TOML file of this project or a JSON track of TTOBench, and notes on what was assumed.

    Raises InputError naming file, key and remedy.
    """
    if _is_json(path):
        from workbench.optimal.inputs import ttobench  # noqa: PLC0415 - as said above

        return ttobench.load_track(path)
    _require_kind(path, "grade", "mass_kg", "a line")
    from workbench.trains import track as tracks  # noqa: PLC0415 - as said above

    try:
        return from_track(tracks.load_track(path))
    except InputError as trouble:
        raise trouble if trouble.where else trouble.within(path) from None


def load_vehicle(path: Path) -> tuple[Vehicle, Notes]:
    """A vehicle from a TOML file of this project or a JSON train of TTOBench, and notes on what was assumed.

    Raises InputError naming file, key and remedy.
    """
    if _is_json(path):
        from workbench.optimal.inputs import ttobench  # noqa: PLC0415 - as said above

        return ttobench.load_train(path)
    _require_kind(path, "mass_kg", "grade", "a train")
    from workbench.optimal.inputs.train_file import TrainFile, vehicle  # noqa: PLC0415 - as said above

    train = load_record(path, TrainFile)
    try:
        return vehicle(train, path.stem), _assumed(train)
    except InputError as trouble:
        raise trouble.within(path) from None


def load_cars(path: Path) -> CarTrain | None:
    """The cars of a train's file, None where it states none; raises InputError naming file, key and remedy."""
    if _is_json(path):
        return None
    from workbench.optimal.inputs.cars_file import car_train  # noqa: PLC0415 - as said above
    from workbench.optimal.inputs.train_file import TrainFile, vehicle  # noqa: PLC0415 - as said above

    train = load_record(path, TrainFile)
    if train.cars is None:
        return None
    try:
        return car_train(train.cars, vehicle(train, path.stem))
    except InputError as trouble:
        raise trouble.within(path) from None


def notes_together(line: Line, train: Vehicle) -> Notes:
    """Notes on what a line says and the train does not know how to meet."""
    if any(tunnel.cross_section_m2 for tunnel in line.tunnels) and not train.tunnel_drag:
        return (f"line '{line.name}' has tunnels but train '{train.name}' does not say what they add to its "
                "resistance: nothing is added",)
    return ()


def from_track(track: Track) -> tuple[Line, Notes]:
    """A line of this project's own format, with the curve resistance 600/R, and notes."""
    from workbench.optimal.inputs.line import Line, Tunnel  # noqa: PLC0415 - as said above

    notes = [] if track.speed_limit else [f"line '{track.name}' states no speed limit: the train's own holds"]
    steepest = max(abs(section.grade_permille) for section in track.grade)
    if 0 < steepest < LEAST_STEEPEST:
        notes.append(f"no grade of line '{track.name}' is above {steepest:g} per mille: are they ratios, and not per "
                     "mille?")
    return Line(
        name=track.name, length_m=track.length_m, stops_m=track.stops_m or (0.0, track.length_m),
        limits=tuple((s.start_m, s.speed_mps) for s in track.speed_limit) or ((0.0, float("inf")),),
        grades=tuple((s.start_m, s.grade_permille) for s in track.grade),
        curves=tuple((s.start_m, 1 / s.radius_m, 1 / s.radius_m) for s in track.curve),
        tunnels=tuple(Tunnel(s.start_m, s.end_m - s.start_m, None, s.resistance_n_per_kn) for s in track.tunnel),
        curve_rule="inverse_radius",
    ), tuple(notes)


def _assumed(train: TrainFile) -> Notes:
    stated = train.model_fields_set
    return tuple(note for key, note in (
        ("traction_efficiency", "no traction_efficiency: 100 % assumed"),
        ("regenerative_force_n", "no regenerative_force_n: nothing is returned when braking"),
        ("length_m", "no length_m: the train is taken as a point"),
    ) if key not in stated)


def _is_json(path: Path) -> bool:
    if path.suffix.lower() not in (".json", ".toml"):
        raise InputError(path, "", "is neither .toml (this project's format) nor .json (TTOBench): name such a file")
    return path.suffix.lower() == ".json"


def _require_kind(path: Path, own: str, other: str, what: str) -> None:
    data = read_toml(path)
    if own in data:
        return
    if "controllers" in data or data.get("kind") == "study":
        raise InputError(path, own, f"is missing: this is a scenario or a study, name {what}'s own file")
    if other in data:
        raise InputError(path, own, f"is missing: this is not {what}'s file, name one that is")
