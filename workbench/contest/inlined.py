"""The compiled closed loop made for a setting: the same numbers to the last bit, in a third of the time.

A call between two kernels hands over every array by its parts, which costs more than the Runge-Kutta step it is for;
and what never happens in a setting is asked about four times a step. So the plant's functions are put into the loop,
and how many disturbances, failures and changes there are is written into it as a number.
"""

from __future__ import annotations

import sys
from pathlib import Path
from types import ModuleType

from workbench.compile import Estimates, kernel_module, loop_module
from workbench.controllers.base import ControlLaw
from workbench.errors import CompileError
from workbench.simulate import kernel_loop
from workbench.simulate.closed_loop import Setting
from workbench.train import single_particle

# What the plant's four stages of a step call.
PUT_IN = ("plant_rates", "additional", "term", "pushed", "applied", "at_time", "rates_at")
CALLED, INLINE = "@njit(cache=True, error_model='numpy')", "@njit(error_model='numpy', inline='always')"
COUNTED = ("terms", "failures", "changes")
# So many rows of one kind are written into a loop; more are counted by it.
MOST_ROWS = 2

_kernels: dict[tuple[str, Estimates], ModuleType] = {}
_made: dict[tuple[str, tuple[str, ...], tuple[int, ...]], ModuleType] = {}


def law_loop(law: ControlLaw, setting: Setting, estimates: Estimates = "corrected") -> ModuleType:
    """The closed loop of a law of the registry, or a paper's, with the single particle in a setting."""
    key = law.id, estimates
    if key not in _kernels:
        _kernels[key] = kernel_module(single_particle(), law, kernel_loop, estimates)
    return inlined(_kernels[key], setting)


def inlined(module: ModuleType, setting: Setting, *others: str) -> ModuleType:
    """A module of `compile.loop_module` for settings with as many rows as this one has.

    others: functions that are put into the loop beside PUT_IN. Raises CompileError where the module has no such ones.
    """
    rows = tuple(len(getattr(setting, name)) for name in COUNTED)
    rows = tuple(count if count <= MOST_ROWS else -1 for count in rows)
    key = module.__name__, others, rows
    if key not in _made:
        _made[key] = _load(Path(str(module.__file__)), f"{module.__name__}_{'_'.join(map(str, rows))}", others, rows)
    return _made[key]


def _load(path: Path, name: str, others: tuple[str, ...], rows: tuple[int, ...]) -> ModuleType:
    """All functions of a generated module, those that are put in marked as such, as a module of their own."""
    text = path.read_text(encoding="utf-8").partition("from numba import njit")[2].replace(f"{CALLED}\n", "")
    for function in (*PUT_IN, *others):
        called = f"\ndef {function}("
        if text.count(called) != 1:
            raise CompileError(f"{path}: no function '{function}' to be put into its callers: name those of the loop")
        # The tab keeps `loop_module`, which decorates what it finds, from decorating these once more.
        text = text.replace(called, f"\n{INLINE}\ndef\t{function}(")
    for array, count in zip(COUNTED, rows, strict=True):
        if count >= 0:
            text = text.replace(f"{array}.shape[0]", str(count))
    return loop_module(f"{name}, which it has the functions of", [text], sys.modules[__name__])


# The loop is among the functions, so that nothing is joined to them.
# --- kernel ---
