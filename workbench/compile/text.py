"""The text of a module that numba compiles: functions and a loop joined, each marked for what calls it.

What is marked in a text is found by Python's own parser, so that it is a function and no likeness of one; everything
else, comments too, stays as it was written.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Sequence
from types import ModuleType

from workbench.errors import CompileError

MARKER, SHARED = "# --- kernel ---", "# --- shared ---"
# By numpy's error model a division by zero gives inf or nan, which the loop reports as a diverged law.
# Uses of arrays are counted, whoever calls: numba would else do as the caller does that comes first.
CALLED = "@njit(cache=True, error_model='numpy', _nrt=True)"
# Called by compiled functions alone: what Python would need to call it is a third of what a small function costs.
WITHIN = "@njit(cache=True, error_model='numpy', no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=True)"
# Arrays as plain memory, whose uses are not counted: counting costs more than a Runge-Kutta stage.
CALLED_UNCOUNTED = "@njit(cache=True, error_model='numpy', no_cfunc_wrapper=True, _nrt=False)"
WITHIN_UNCOUNTED = "@njit(cache=True, error_model='numpy', no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False)"
PUT_IN = WITHIN_UNCOUNTED.replace(")", ", forceinline=True)")


def loop_text(loop: ModuleType) -> str:
    """What stands below the marker in the source of `loop`; CompileError without one."""
    _, marker, below = inspect.getsource(loop).partition(MARKER)
    if not marker:
        raise CompileError(f"{loop.__file__}: has no line '{MARKER}': write it above the functions to be compiled")
    return below


def shared_functions(loop: ModuleType) -> str:
    """Functions that need none of the generated ones: what stands between the markers in the source of `loop`, and
    below the first one in the modules that it `SHARES`."""
    files = (loop, *getattr(loop, "SHARES", ()))
    return "\n\n\n".join(inspect.getsource(file).partition(MARKER)[0].partition(SHARED)[2].strip("\n")
                         for file in files).strip("\n")


def shared_text(loop: ModuleType) -> str:
    """Python source of a module with the functions that loops of all plants and laws share; empty without any."""
    functions = shared_functions(loop)
    if not functions:
        return ""
    name = loop.__name__.rpartition(".")[2]
    text = "\n".join([f'"""What all modules of {name} share."""', "", "import math", "", "from numba import njit", "",
                      functions, ""])
    return _marked(text, loop)


def module_text(source: str, functions: Sequence[str], loop: ModuleType, shared: str = "") -> str:
    """Python source of generated functions and what stands below the marker in `loop`, every function a numba kernel.

    A loop may say which `ENTRIES` Python calls, all its functions unless it does; which are `LINKED`, with their types;
    that it `MAKES_NO_ARRAY`; and that it is `ONE_BODY`, which makes none either, so that all others are put into those.
    source: what the functions were generated from, in words;
    functions: their Python source; shared: the name of the module of `shared_text`, from which its functions come.
    Raises CompileError where no function has the name of an entry.
    """
    # A law says in its own words where it stands: they are text here, whatever quotes and backslashes they hold.
    stated = source.encode("unicode_escape").decode().replace('"', '\\"')
    common = [node.name for node in _functions(shared_functions(loop))]
    linking = ["from workbench.compile.linked import linked", ""] if getattr(loop, "LINKED", {}) else []
    text = "\n".join([
        f'"""Generated from the sympy expressions of {stated}."""', "", "import math", "",
        "from numba import carray, njit", "", *linking,
        *([f"from {shared} import {', '.join(common)}", ""] if common else []),
        *functions, loop_text(loop),
    ])
    names = [*common, *(function.name for function in _functions(text))]
    for name in getattr(loop, "ENTRIES", ()):
        if name not in names:
            raise CompileError(f"{loop.__name__}: no function '{name}' to be called: choose among {', '.join(names)}")
    return _marked(text, loop)


def _functions(text: str) -> list[ast.FunctionDef]:
    return [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)]


def _marked(text: str, loop: ModuleType) -> str:
    """The text with a mark above every function, made from the last to the first, so that none moves another."""
    entries, types, called, within = getattr(loop, "ENTRIES", None), getattr(loop, "LINKED", {}), CALLED, WITHIN
    if getattr(loop, "ONE_BODY", False):
        called, within = CALLED_UNCOUNTED, PUT_IN
    elif getattr(loop, "MAKES_NO_ARRAY", False):
        called, within = CALLED_UNCOUNTED, WITHIN_UNCOUNTED
    lines = text.splitlines()
    for function in reversed(_functions(text)):
        lines.insert(function.lineno - 1, called if entries is None or function.name in entries else within)
        if function.name in types:
            lines.insert(function.lineno - 1, f"@linked({types[function.name]!r})")
    return "\n".join([*lines, ""])
