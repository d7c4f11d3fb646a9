"""The compiled closed loop with the plant's functions put into it: the same numbers to the last bit, in half the time.

A call between two kernels hands over every array by its parts, which costs more than the Runge-Kutta step it is for.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

from workbench.cache_folder import write_whole
from workbench.compile import Estimates, kernel_module
from workbench.controllers.base import ControlLaw
from workbench.errors import CompileError
from workbench.simulate import kernel_loop
from workbench.train import single_particle

# What the plant's four stages of a step call.
PUT_IN = ("plant_rates", "additional", "term", "pushed", "applied", "at_time", "rates_at")
CALLED, INLINE = "@njit(cache=True, error_model='numpy')", "@njit(error_model='numpy', inline='always')"


_made: dict[tuple[str, Estimates], ModuleType] = {}


def law_loop(law: ControlLaw, estimates: Estimates = "corrected") -> ModuleType:
    """The closed loop of a law of the registry, or a paper's, with the single particle; made once a process."""
    if (law.id, estimates) not in _made:
        _made[law.id, estimates] = inlined(kernel_module(single_particle(), law, kernel_loop, estimates))
    return _made[law.id, estimates]


def inlined(module: ModuleType, *others: str) -> ModuleType:
    """A module of `compile.loop_module`, with PUT_IN and `others` put into who calls them; beside it on disk.

    Raises CompileError where the module does not say what is looked for.
    """
    path = Path(str(module.__file__))
    text = path.read_text(encoding="utf-8")
    for name in (*PUT_IN, *others):
        called = f"{CALLED}\ndef {name}("
        if text.count(called) != 1:
            raise CompileError(f"{path}: no function '{name}' to be put into its callers: run again without the cache")
        text = text.replace(called, f"{INLINE}\ndef {name}(")
    name = f"{module.__name__}_inlined"
    if name in sys.modules:
        return sys.modules[name]
    beside = path.with_name(f"{name}.py")
    if not beside.exists() or beside.read_text(encoding="utf-8") != text:
        write_whole(beside, text)
    spec = importlib.util.spec_from_file_location(name, beside)
    if spec is None or spec.loader is None:
        raise CompileError(f"cannot import the generated kernel {beside}: remove it and run again")
    made = importlib.util.module_from_spec(spec)
    sys.modules[name] = made
    try:
        spec.loader.exec_module(made)
    except BaseException:
        del sys.modules[name]
        raise
    return made
