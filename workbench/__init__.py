"""A control paper as one executable object: proof, simulation and comparison from the same expressions.

`import workbench as wb` imports nothing else: each name below brings its module when it is first used.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from workbench.api.functions import check_paper, compare, entrant, gains, load, prove, reference, simulate
    from workbench.api.margins import Loops, margins
    from workbench.api.results import Comparison, Proved, Run
    from workbench.api.schemas import schema
    from workbench.model.law import LawState, period, time
    from workbench.mpc.plant_tracking import PlantMpc
    from workbench.proof.paper import Paper
    from workbench.systems.event import Event
    from workbench.systems.law import Reference
    from workbench.systems.law import StateLaw as Law
    from workbench.systems.lyapunov import Lyapunov, closed_loop, next_values
    from workbench.systems.metric import Metric
    from workbench.systems.plant import Parameter, Plant
    from workbench.systems.setting import Setting
    from workbench.systems.signals import Constant, Ramp, Sine, Spline, Step

_WHERE = {
    "api.functions": ("check_paper", "compare", "entrant", "gains", "load", "prove", "reference", "simulate"),
    "api.margins": ("Loops", "margins"), "api.results": ("Comparison", "Proved", "Run"), "api.schemas": ("schema",),
    "model.law": ("LawState", "period", "time"),
    "mpc.plant_tracking": ("PlantMpc",), "proof.paper": ("Paper",), "systems.setting": ("Setting",),
    "systems.law": ("Reference", "StateLaw"), "systems.lyapunov": ("Lyapunov", "closed_loop", "next_values"),
    "systems.event": ("Event",), "systems.metric": ("Metric",), "systems.plant": ("Parameter", "Plant"),
    "systems.signals": ("Constant", "Ramp", "Sine", "Spline", "Step"),
}
_MODULES = {name: module for module, names in _WHERE.items() for name in names}
_RENAMED = {"Law": "StateLaw"}

__all__ = ["Comparison", "Constant", "Event", "Law", "LawState", "Loops", "Lyapunov", "Metric", "Paper", "Parameter",
           "Plant", "PlantMpc", "Proved", "Ramp", "Reference", "Run", "Setting", "Sine", "Spline", "Step",
           "check_paper", "closed_loop", "compare", "entrant", "gains", "load", "margins", "next_values", "period",
           "prove", "reference", "schema", "simulate", "time"]


def __getattr__(name: str) -> Any:
    own = _RENAMED.get(name, name)
    if name == "StateLaw" or own not in _MODULES:
        raise AttributeError(f"module 'workbench' has no attribute '{name}'")
    try:
        found = getattr(import_module(f"workbench.{_MODULES[own]}"), own)
    except ImportError as trouble:
        from workbench.errors import of_an_extra  # noqa: PLC0415 - as all else, only when it is used

        raise of_an_extra(trouble) or trouble from None
    room = sys.modules.get(f"workbench.{name}")
    if room is not None:  # `import workbench.gains.lmi as lmi` looks for `lmi` in what is found here
        found.__dict__ = room.__dict__
    return found


def __dir__() -> list[str]:
    return [*__all__, "__version__"]


class _Package(ModuleType):
    """The package, in which `simulate` and `gains` stay the functions of the API.

    There are rooms of the same names, and the import system would put a room in the function's place as soon as it is
    imported: the first call would work and the second meet a module. What is in the room is found in the function too.
    """

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in _MODULES and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
