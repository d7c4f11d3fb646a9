"""What a law's co-simulation unit holds, made from the law's own expressions and from its stated values."""

from __future__ import annotations

import keyword
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import law_source
from workbench.errors import InputError
from workbench.files.known_names import one_of
from workbench.model.law import ControlLaw
from workbench.paper.loading import Loaded
from workbench.paper.plants.problem import LocatedPlantStudy
from workbench.simulate.controllers import compiled_law
from workbench.simulate.law_values import controller_spec, law_values
from workbench.simulate.plants.arrays import law_functions
from workbench.systems.law import ORDERS, StateLaw
from workbench.systems.plant import Plant
from workbench.trains.scenario import Scenario

Array = NDArray[np.float64]

# What a train's law is told at a sample, in the order of its control step: name and what it is.
TOLD = {"position_m": "measured position (m)", "speed_mps": "measured speed (m/s)",
        "desired_position_m": "desired position (m)", "desired_speed_mps": "desired speed (m/s)",
        "desired_acceleration_mps2": "desired acceleration (m/s2)"}
COMMAND = {"command_mps2": "force per mass that the law commands (m/s2)"}
_OF_TRAINS = """\
def answer(t, given, values, memory):
    return [control_step(t, *given, PERIOD_S, values, *memory)]


def margin(t, given, values, memory):
    return domain_margin(t, *given, PERIOD_S, values)
"""
_OF_PLANTS = """\
def answer(t, given, values, memory):
    commands = [0.0] * {inputs}
    law_step(t, PERIOD_S, given[:{outputs}], given[{outputs}:], memory[0], values, commands)
    return commands


def margin(t, given, values, memory):
    return law_margin(t, PERIOD_S, given[:{outputs}], given[{outputs}:], memory[0], values)
"""


@dataclass(frozen=True)
class LawUnit:
    """A law with its values as a unit that is called every `period_s`.

    inputs and commands: name -> what it is, with its unit; parameters and states: name -> value at the start; code:
    Python source of `answer(t, given, values, memory)`, which moves the memory and returns the commands, and of
    `margin`, positive where the law is defined; memory: the arrays that `answer` moves, the states first.
    """

    name: str
    about: str
    period_s: float
    inputs: Mapping[str, str]
    commands: Mapping[str, str]
    parameters: Mapping[str, float]
    states: Mapping[str, float]
    code: str
    memory: Sequence[Array]


def unit_of(loaded: Loaded, name: str) -> LawUnit:
    """The unit of a controller of a scenario or of a plant's study; InputError for another study, for an unknown
    controller, and for one that is no law of expressions, as MPC."""
    try:
        match loaded.record:
            case Scenario():
                return _of_train(loaded.record, name)
            case LocatedPlantStudy():
                return _of_plant(loaded.record, name)
    except InputError as trouble:
        raise trouble if trouble.where else trouble.within(loaded.path) from None
    raise InputError(loaded.path, "", "states no controllers of one train or plant: name a scenario's TOML file")


def _of_train(scenario: Scenario, name: str) -> LawUnit:
    spec = controller_spec(scenario, name)
    law = compiled_law(scenario, spec)
    if law is None:
        raise _no_law(name)
    values, scalars, neurons, data = law_values(law, spec, name)
    return LawUnit(
        _identifier(law.id), _about(law), spec.period_s, TOLD, COMMAND,
        dict(zip(map(str, law.parameters), values.tolist(), strict=True)),
        dict(zip((str(state.symbol) for state in law.scalar_states), scalars.tolist(), strict=True)),
        f"{law_source(law, spec.estimates)}\n\n{_OF_TRAINS}", (scalars, neurons, data))


def _of_plant(study: LocatedPlantStudy, name: str) -> LawUnit:
    if name not in study.controllers:
        raise InputError("", "controllers", f"there is no '{name}': {one_of(name, study.controllers)}")
    made, plant = study.entrant(name), study.setting.plant
    if made.law is None:
        raise _no_law(name)
    law = made.law
    stated = {str(symbol): float(value) for symbol, value in law.initial.items()} | dict(made.initial)
    states = {str(symbol): stated.get(str(symbol), 0.0) for symbol in law.state_symbols}
    return LawUnit(
        _identifier(law.id), _about(law), made.period_s, _signals(law, plant),
        {str(symbol): _with_unit("command", plant, symbol) for symbol in plant.inputs},
        law.values(plant, study.setting.parameters, made.parameters), states, _plant_code(law, plant),
        (np.array([*states.values()], dtype=float),))


def _signals(law: StateLaw, plant: Plant) -> dict[str, str]:
    measured = {str(symbol): _with_unit("measured", plant, symbol) for symbol in plant.outputs}
    what = ("reference", "its rate", "its second rate", "its third rate")
    return measured | {f"{reference.name}{order}": text for reference in law.references
                       for order, text in zip(ORDERS, what, strict=True)}


def _with_unit(what: str, plant: Plant, symbol: object) -> str:
    unit = {str(of): text for of, text in plant.units.items()}.get(str(symbol), "")
    return f"{what} ({unit})" if unit else what


def _plant_code(law: StateLaw, plant: Plant) -> str:
    return "\n\n".join([*law_functions(law, plant, law.reference_symbols),
                        _OF_PLANTS.format(inputs=len(plant.inputs), outputs=len(plant.outputs))])


def _identifier(law: str) -> str:
    name = re.sub(r"\W", "_", law, flags=re.ASCII)
    return name if name.isidentifier() and not keyword.iskeyword(name) else f"law_{name}"


def _about(law: ControlLaw | StateLaw) -> str:
    return ", ".join(filter(None, (law.title or law.id, law.source)))


def _no_law(name: str) -> InputError:
    return InputError("", f"controllers.{name}", "is no law of expressions, as MPC is none: name a law")
