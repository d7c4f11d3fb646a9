"""The functions of the API. All run in this process unless more workers are asked for.

The processes of these do not import the script that calls the function: it needs no guard.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import sympy as sp

from workbench.api.guests import guest_controller
from workbench.api.results import Comparison, Proved, Run
from workbench.errors import InputError
from workbench.gains.result import GainReport
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import Reference, find_reference
from workbench.paper.gain_effects import gains_of
from workbench.paper.loading import Loaded
from workbench.paper.loading import load as read
from workbench.paper.plants.check import Checked
from workbench.paper.plants.check import check_paper as check
from workbench.paper.plants.problem import LocatedPlantStudy
from workbench.proof.document import claims_document, places
from workbench.proof.prove import prove as decide
from workbench.proof.selection import targets
from workbench.simulate.plants.run import Entrant
from workbench.simulate.plants.run import run as run_plant
from workbench.systems.law import StateLaw
from workbench.systems.plant import Plant
from workbench.systems.setting import Setting
from workbench.systems.symbols import named_values, several

Names = Mapping[sp.Symbol, Any] | Mapping[str, Any]


def load(path: str | Path) -> Loaded:
    """A paper's folder or the TOML file of its study, read once; InputError naming file, key and remedy."""
    return read(Path(path))


def prove(path: str | Path, *, workers: int = 1, cache: bool = True) -> Proved:
    """Decide the claims of a paper's folder, a proof file, or `FOLDER::claim`; nothing is written.

    Raises InputError naming file, claim and remedy, ClaimError for a claim that states nothing.
    """
    proof = decide(targets([str(path)]), workers, cache)
    for trouble in proof.misstated.values():
        raise InputError("", "", trouble)
    return Proved(claims_document(proof.decisions, places(proof, None)))


def simulate(plant: Plant, law: StateLaw | Any | None, *, period_s: float, duration_s: float,
             law_parameters: Names | None = None, law_initial: Names | None = None, **setting: Any) -> Run:
    """Run one law, or what else `entrant` takes, on a plant; None leaves the inputs at zero.

    setting: the other fields of `Setting`, by name. `simulate(pendulum, pd, period_s=0.01, duration_s=5,
    initial={"theta": 0.3}, references={"theta_d": Sine(...)}, tracks={"theta": "theta_d"})`. Raises ValueError, one
    line, for what does not fit.
    """
    if not isinstance(plant, Plant):
        raise ValueError(f"the first argument is a {type(plant).__name__}: give the Plant, then the law")
    known = [field.name for field in fields(Setting)]
    for name in setting:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            raise ValueError(f"'{name}' is nothing that a run is made with: " + (
                f"did you mean '{near[0]}'?" if near else f"it is one of {', '.join(known[2:])}"))
    made = Setting(plant, duration_s, **setting)
    if law is None:
        law = StateLaw("none", dict.fromkeys(plant.inputs, 0))
    return Run(made, run_plant(made, entrant(law, period_s, law_parameters, law_initial), plant.values()))


def entrant(law: StateLaw | Any, period_s: float, parameters: Names | None = None, initial: Names | None = None,
            name: str = "") -> Entrant:
    """A controller with its values for `compare`: a law, what has `build(setting, period_s)`, as `PlantMpc`, or a
    controller made elsewhere: a function (t, y, r) -> u of Python or casadi, or an object that is called so, over the
    plant's outputs and the references' values in their orders, or a `control` system whose inputs are these and whose
    outputs are the plant's inputs, by their names.

    parameters and initial are a law's. Raises ValueError, one line, for what is none of these.
    """
    if isinstance(law, StateLaw):
        return Entrant(name or law.id, period_s, law, _named(parameters), _named(initial))
    for what, given in (("parameters", parameters), ("initial", initial)):
        if given:
            raise ValueError(f"{what} of a {type(law).__name__}: are a law's alone: leave them out, and put these "
                             "values into the controller")
    guest = guest_controller(law)
    if guest is not None:
        return Entrant(name or guest.name, period_s, build=guest.build)
    if not callable(getattr(law, "build", None)):
        raise ValueError(f"a {type(law).__name__} is no law and builds no controller: give a Law, a PlantMpc, a "
                         "function (t, y, r) -> u or a control system")
    return Entrant(name or "mpc", period_s, build=law.build)


def _named(values: Names | None) -> dict[str, float]:
    return {str(name): value for name, value in named_values(values or {}, "a controller's values").items()}


def compare(what: str | Path | Loaded | Setting, entrants: Sequence[Entrant] = ()) -> Comparison:
    """All controllers of a folder's study, or these entrants in a setting, on the same plant.

    Raises InputError or ValueError, one line, for what does not fit; a run that fails is told in its result.
    """
    nominal: Mapping[str, float]
    if isinstance(what, Setting):
        entrants = several(entrants, "entrants", Entrant, "wb.entrant(law, period_s, parameters)")
        names = [one.name for one in entrants]
        if not names:
            raise ValueError("entrants is empty: give wb.entrant(law, period_s, parameters) for each controller")
        if len(set(names)) < len(names):
            raise ValueError(f"two entrants are called '{max(names, key=names.count)}': name them apart")
        setting, nominal = what, what.plant.values()
    else:
        if not isinstance(what, str | Path | Loaded):
            raise ValueError(f"the first argument is a {type(what).__name__}: give a folder, or a Setting(plant, "
                             "duration_s, ...) and its entrants")
        if entrants:
            raise ValueError(f"entrants are for a Setting, and '{what}' names its own: leave them out, or give "
                             "wb.load(FOLDER).record.setting in its place")
        study = _plant_study(what if isinstance(what, Loaded) else load(what))
        setting, entrants, nominal = study.setting, list(study.entrants().values()), study.setting.parameters
    return Comparison(setting, tuple(Run(setting, run_plant(setting, one, nominal)) for one in entrants))


def _plant_study(loaded: Loaded) -> LocatedPlantStudy:
    if not isinstance(loaded.record, LocatedPlantStudy):
        raise InputError(loaded.path, "kind", "is not 'plant': trains are compared by `workbench compare`")
    return loaded.record


def gains(path: str | Path | Loaded) -> GainReport:
    """What a paper's stated gains meet, what is proved of them, and gains that are proved to do better.

    Raises InputError for a folder that has no gains.py.
    """
    return gains_of(path if isinstance(path, Loaded) else load(path))


def reference(track: str | Path, train: str | Path, *, time_s: float, intervals: int | None = None) -> Reference:
    """The energy-optimal run of a train over a whole line in a time, with its proven bound.

    track, train: TOML files, or JSON of TTOBench. Raises InputError, and InfeasibleRunError with the least time.
    """
    line, vehicle = load_line(Path(track))[0], load_vehicle(Path(train))[0]
    return find_reference(vehicle, course(line, vehicle, 0.0, line.length_m, ()), time_s, intervals=intervals)


def check_paper(folder: str | Path) -> Checked:
    """Everything that can be checked of a folder without knowing its subject; see `Checked`."""
    return check(Path(folder))

