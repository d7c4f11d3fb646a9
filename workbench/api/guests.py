"""Controllers made elsewhere as entrants, called once a sample: functions, casadi's too, and systems of control."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from types import FunctionType, MethodType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.systems.setting import Setting
from workbench.systems.signals import signals_at

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Guest:
    """A controller of another library, made anew for each run; name: as it is called there."""

    name: str
    controller: Any
    kind: type[_Plain] | type[_Function] | type[_System]

    def build(self, setting: Setting, period_s: float) -> _Plain | _Function | _System:
        """The controller in a setting; ValueError where their names or sizes do not fit."""
        return self.kind(self.controller, setting, period_s)


def guest_controller(controller: Any) -> Guest | None:
    """The controller as a guest; None where it is of no library that is known.

    A library that is not imported has made nothing, so that none is imported here.
    """
    casadi, control = sys.modules.get("casadi"), sys.modules.get("control")
    if casadi is not None and isinstance(controller, casadi.Function):
        return Guest(controller.name(), controller, _Function)
    if control is not None and isinstance(controller, control.InputOutputSystem):
        return Guest(controller.name or "control", controller, _System)
    if isinstance(controller, FunctionType | MethodType):
        return Guest(controller.__name__.strip("<>"), controller, _Plain)
    if callable(controller) and not isinstance(controller, type) and not hasattr(controller, "build"):
        return Guest(type(controller).__name__, controller, _Plain)  # an object that is called, a functools.partial
    return None


class _Plain:
    """A function (t, y, r) -> u of Python: outputs, values of the references and inputs in their orders."""

    def __init__(self, function: Any, setting: Setting, period_s: float) -> None:
        self._function, self._references = function, setting.references

    def command(self, t: float, measured: Array) -> Any:
        """What the function gives."""
        return self._function(t, measured.copy(), np.array([*_values(self._references, t).values()]))


class _Function:
    """A casadi Function (t, y, r) -> u: outputs, values of the references and inputs in their orders."""

    def __init__(self, function: Any, setting: Setting, period_s: float) -> None:
        sizes = (1, len(setting.plant.outputs), len(setting.references))
        found = tuple(function.numel_in(i) for i in range(function.n_in()))
        if found != sizes or function.n_out() != 1 or function.numel_out(0) != len(setting.plant.inputs):
            raise ValueError(f"casadi function '{function.name()}' takes {found}: it must take time, {sizes[1]} "
                             f"outputs and {sizes[2]} references, and give {len(setting.plant.inputs)} inputs")
        self._function, self._references = function, setting.references

    def command(self, t: float, measured: Array) -> Array:
        """What the function gives."""
        return np.asarray(self._function(t, measured, list(_values(self._references, t).values()))).ravel()


class _System:
    """A python-control system: its state moves at samples where it is in discrete time, else by one Euler step."""

    def __init__(self, system: Any, setting: Setting, period_s: float) -> None:
        self._outputs = [*map(str, setting.plant.outputs)]
        known, inputs = {*self._outputs, *setting.references}, [*map(str, setting.plant.inputs)]
        for name in system.input_labels:
            if name not in known:
                raise ValueError(f"control system '{system.name}': input '{name}' is no output of the plant and no "
                                 f"reference: name one of {', '.join(sorted(known))}")
        if sorted(system.output_labels) != sorted(inputs):
            raise ValueError(f"control system '{system.name}': its outputs are {', '.join(system.output_labels)}, and "
                             f"must be the plant's inputs {', '.join(inputs)}")
        discrete = system.isdtime(strict=True)
        if discrete and system.dt is not True and abs(system.dt - period_s) > 1e-9 * period_s:
            raise ValueError(f"control system '{system.name}': its step of {system.dt:g} s is not the period of "
                             f"{period_s:g} s: sample it anew")
        self._system, self._discrete, self._period = system, discrete, period_s
        self._references = setting.references
        self._order = [system.output_labels.index(name) for name in inputs]
        self._state = np.zeros(system.nstates)

    def command(self, t: float, measured: Array) -> Array:
        """The system's output; then its state moves."""
        given = dict(zip(self._outputs, measured, strict=True)) | _values(self._references, t)
        u = np.array([given[name] for name in self._system.input_labels])
        found = np.asarray(self._system.output(t, self._state, u), dtype=float)
        moved = np.asarray(self._system.dynamics(t, self._state, u), dtype=float)
        self._state = moved if self._discrete else self._state + self._period * moved
        return found[self._order]


def _values(references: Mapping[str, Any], t: float) -> dict[str, float]:
    """The references' values at a time."""
    return {name: float(four[0][0]) for name, four in signals_at(references, t).items()}
