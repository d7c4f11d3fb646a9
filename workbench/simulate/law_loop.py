"""The compiled closed loop under a law: a loop for a plant, compiled once for all laws, and a law that it calls.

A call by address costs a few nanoseconds a sample, a loop some seconds to compile.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from types import ModuleType
from typing import Any

from workbench.compile.code_cache import c_function
from workbench.compile.kernel import Estimates, law_source, loop_module, plant_source
from workbench.errors import CompileError
from workbench.model.law import ControlLaw
from workbench.mpc.model import Actuator
from workbench.mpc.whole_run import source
from workbench.simulate import kernel_loop, law_call
from workbench.trains.train import Plant, single_particle

EVERYWHERE = """
def domain_margin(_t, _p, _v, _x_d, _v_d, _a_d, _period, parameters):
    return math.inf
"""


@dataclass(frozen=True)
class LawLoop:
    """A plant's closed loop under a law.

    answer: the law, as the loop calls it; closed_loop: as in `kernel_loop`, without its first argument.
    """

    answer: Any
    closed_loop: Callable[..., Any]
    plant: ModuleType
    law: ModuleType


# By plant and law themselves, not by their names: a copied folder has laws of the same names.
_made: dict[tuple[int, int, Estimates], tuple[Plant | None, ControlLaw, LawLoop]] = {}


def law_loop(law: ControlLaw, estimates: Estimates = "corrected", plant: Plant | None = None) -> LawLoop:
    """The closed loop of a plant, of the single particle unless given, under a law; compiled once a process.

    Raises CompileError for expressions that have no code.
    """
    key = id(law), id(plant), estimates
    if key not in _made:
        try:
            functions = [law_source(law, estimates)]
        except CompileError as trouble:
            named = str(trouble).startswith(law.id)
            raise trouble if named else CompileError(f"law '{law.id}': {trouble}") from None
        _made[key] = plant, law, written_loop(law.source, functions, plant)
    return _made[key][2]


def written_loop(source: str, functions: Sequence[str], plant: Plant | None = None) -> LawLoop:
    """The same under a law that is more than its expressions: Python source of `control_step` and `domain_margin`.

    source: what the functions were made from, in words; functions: these two and what they call, or without the second
    of a law that is defined everywhere.
    """
    plant = plant or single_particle()
    if not any("def domain_margin(" in text for text in functions):
        functions = [*functions, EVERYWHERE]
    driven = loop_module(plant.source, [plant_source(plant)], kernel_loop)
    law = loop_module(source, functions, law_call)
    answer = c_function(law, "answer", law_call.ANSWER)
    return LawLoop(answer, partial(driven.closed_loop, answer), driven, law)


# By plant itself, as above, and by what MPC takes for its actuator.
_of_mpc: dict[tuple[int, Actuator], tuple[Plant | None, LawLoop]] = {}


def mpc_loop(actuator: Actuator, plant: Plant | None = None) -> LawLoop:
    """A plant's closed loop, the single particle's unless given, under MPC of the train with an actuator; compiled once
    a process. See `mpc/whole_run.py`."""
    key = id(plant), actuator
    if key not in _of_mpc:
        written = written_loop(f"MPC of train.py with its actuator ({actuator})", source(actuator), plant)
        _of_mpc[key] = plant, written
    return _of_mpc[key][1]
