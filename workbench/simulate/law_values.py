"""A scenario's numbers for a law: parameters, initial values and hidden neurons, checked by name and sign."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.compile.literals import require_short
from workbench.errors import CompileError, InputError
from workbench.files.known_names import one_of
from workbench.model.law import ControlLaw
from workbench.simulate.controllers import SAMPLED, compiled_law, known_laws, nearest_law
from workbench.trains.scenario import ControllerSpec, NeuronGrid, Scenario

Array = NDArray[np.float64]


def law_values(law: ControlLaw, spec: ControllerSpec, name: str) -> tuple[Array, Array, Array, Array]:
    """Parameters, initial scalar states, initial neuron states and neuron data of a law, as arrays.

    Raises InputError naming the parameter, initial value or neuron grid that is missing, unknown or unfit.
    """
    parameters = [s.name for s in law.parameters]
    scalars = [s.symbol.name for s in law.scalar_states]
    neurons = [str(s.symbol.base.label) for s in law.neuron_states]
    data = [str(s.base.label) for s in law.neuron_data]
    _require_grid(law, [*neurons, *data], spec.neurons, f"controllers.{name}.neurons")
    placed = _place_neurons(spec.neurons) if spec.neurons else {}
    started = [base for base in neurons if _source_of(base) not in placed]
    _require_names(f"controllers.{name}.parameters", parameters, spec.parameters)
    _require_names(f"controllers.{name}.initial", [*scalars, *started], spec.initial)
    _require_signs(f"controllers.{name}.parameters", law.parameters, spec.parameters)
    _require_signs(f"controllers.{name}.initial", [s.symbol for s in law.scalar_states], spec.initial)
    count = spec.neurons.count if spec.neurons else 0

    def row(base: str) -> Array:
        source = _source_of(base)
        return placed[source] if source in placed else np.full(count, spec.initial[base])

    return (
        np.array([spec.parameters[n] for n in parameters], dtype=float),
        np.array([spec.initial[n] for n in scalars], dtype=float),
        np.array([row(n) for n in neurons], dtype=float).reshape(len(neurons), count),
        np.array([row(n) for n in data], dtype=float).reshape(len(data), count),
    )


def check_controllers(scenario: Scenario, where: str | Path = "") -> None:
    """Raise InputError when a controller's law, parameters or initial values cannot be used.

    `where`: the scenario's file, which the error then names.
    """
    for name in scenario.controllers:
        try:
            _check_controller(scenario, name)
        except InputError as trouble:
            if trouble.where:  # a law's own file
                raise
            raise trouble.within(where or f"scenario {scenario.name}") from None


def controller_spec(scenario: Scenario, name: str) -> ControllerSpec:
    """The scenario's controller `name`; raises InputError when there is none or its law is unknown."""
    if name not in scenario.controllers:
        raise InputError("", "controllers", f"there is no '{name}': {one_of(name, scenario.controllers)}")
    spec = scenario.controllers[name]
    key = f"controllers.{name}.law"
    try:
        known = spec.law in SAMPLED or compiled_law(scenario, spec) is not None
    except InputError as trouble:
        raise trouble if trouble.where else trouble.within("", key) from None
    if not known:
        near = nearest_law(scenario, spec.law)
        raise InputError("", key, f"unknown '{spec.law}': choose one of {known_laws(scenario)}, "
                         f"or name a law of your own as FILE.py::name{f'; did you mean {near!r}?' if near else ''}")
    return spec


def _check_controller(scenario: Scenario, name: str) -> None:
    spec = controller_spec(scenario, name)
    law = compiled_law(scenario, spec)
    if law is not None:
        law_values(law, spec, name)
        try:
            require_short([law.command, *map(law.next_value, law.states), *law.domain])
        except CompileError as trouble:
            raise InputError("", f"controllers.{name}.law", f"'{spec.law}': {trouble}") from None
        return
    for key, given in (("initial", spec.initial), ("neurons", spec.neurons)):
        if given:
            raise InputError("", f"controllers.{name}.{key}", f"'{spec.law}' has none: remove it")
    SAMPLED[spec.law](scenario, spec, name)


def _source_of(base: str) -> str:
    """A remembered value starts as the value itself: c_before_1 as c_1, b_before as b_h."""
    return {"b_before": "b_h"}.get(base, base.replace("_before", ""))


def _place_neurons(grid: NeuronGrid) -> dict[str, Array]:
    first = np.linspace(grid.first_center, grid.last_center, grid.count)
    placed = {"c_1": first, "b_h": np.full(grid.count, grid.width)}
    for i, value in enumerate(grid.other_centers, start=2):
        placed[f"c_{i}"] = np.full(grid.count, value)
    return placed


def _require_grid(law: ControlLaw, bases: list[str], grid: NeuronGrid | None, where: str) -> None:
    if grid is None:
        if bases:
            raise InputError("", where, f"is missing: '{law.id}' has hidden neurons: add [{where}]")
        return
    if not bases:
        raise InputError("", where, f"'{law.id}' has no hidden neurons: remove it")
    inputs = sum(re.fullmatch(r"c_\d+", base) is not None for base in bases)
    if len(grid.other_centers) != inputs - 1:
        raise InputError("", f"{where}.other_centers", f"has {len(grid.other_centers)} values, but the "
                         f"network of '{law.id}' has {inputs - 1} inputs beside the first: give one for each")


def _require_names(where: str, wanted: list[str], given: dict[str, float]) -> None:
    for name in wanted:
        if name not in given:
            raise InputError("", where, f"'{name}' is missing: add it")
    for name in given:
        if name not in wanted:
            choice = f"choose among {', '.join(wanted)}" if wanted else "remove it"
            raise InputError("", where, f"unknown '{name}': {choice}")


def _require_signs(where: str, symbols: list[sp.Symbol] | tuple[sp.Symbol, ...],
                   given: dict[str, float]) -> None:
    """A law is simplified with the signs its symbols were declared with, so the values must have them."""
    for symbol in symbols:
        value = given[str(symbol)]
        if (symbol.is_positive and value <= 0) or (symbol.is_nonnegative and value < 0):
            wanted = "positive" if symbol.is_positive else "zero or positive"
            raise InputError("", where, f"{symbol} = {value:g} must be {wanted}: correct it")
