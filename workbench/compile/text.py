"""The text of a module that numba compiles: functions and a loop joined, each marked, in the form that a use asks for.

What is changed in a text is found by Python's own parser, so that it is a function or an expression and no likeness
of one; everything else, comments too, stays as it was written.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from types import ModuleType

from workbench.errors import CompileError

MARKER, SHARED = "# --- kernel ---", "# --- shared ---"
# By numpy's error model a division by zero gives inf or nan, which the loop reports as a diverged law.
CALLED, PUT_IN = "@njit(cache=True, error_model='numpy')", "@njit(error_model='numpy', inline='always')"

# Line, first and last byte in it, and what stands there instead.
_Change = tuple[int, int, int, str]


@dataclass(frozen=True)
class Form:
    """How the functions of a module are made; as they are written, unless it says more.

    put_in: functions that numba puts into their callers, which then call nothing. rows: (argument, count): every
    function that takes an array of this name has its number of rows as a constant, and is for such arrays alone.
    """

    put_in: tuple[str, ...] = ()
    rows: tuple[tuple[str, int], ...] = ()


AS_WRITTEN = Form()


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
    return _changed(text, [(function.lineno, 0, 0, f"{CALLED}\n") for function in _functions(text)])


def module_text(source: str, functions: Sequence[str], loop: ModuleType, form: Form = AS_WRITTEN,
                shared: str = "") -> str:
    """Python source of generated functions and what stands below the marker in `loop`, every function a numba kernel.

    source: what the functions were generated from, in words; functions: their Python source; shared: the name of the
    module of `shared_text`, from which what the form leaves as written is imported. Raises CompileError where the form
    names a function, or rows of an argument, that are not there.
    """
    common = shared_functions(loop)
    own = [node for node in _functions(common) if _touched(node, form)]
    as_written = [node.name for node in _functions(common) if not _touched(node, form)]
    text = "\n".join([
        f'"""Generated from the sympy expressions of {source}."""', "", "import math", "", "from numba import njit", "",
        *([f"from {shared} import {', '.join(as_written)}", ""] if as_written else []),
        *functions, *(str(ast.get_source_segment(common, node)) for node in own), loop_text(loop),
    ])
    defined = _functions(text)
    names = [function.name for function in defined]
    for name in form.put_in:
        if name not in names:
            raise CompileError(f"no function '{name}' to be put into its callers: choose among {', '.join(names)}")
    changes = [(function.lineno, 0, 0, f"{PUT_IN if function.name in form.put_in else CALLED}\n")
               for function in defined]
    for argument, count in form.rows:
        counted = [(node.lineno, node.col_offset, node.end_col_offset or 0, str(count))
                   for function in defined for node in _row_counts(function, argument)]
        if not counted:
            raise CompileError(f"no function counts the rows of an argument '{argument}': leave it out of the form")
        changes += counted
    return _changed(text, changes)


def _functions(text: str) -> list[ast.FunctionDef]:
    return [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)]


def _touched(function: ast.FunctionDef, form: Form) -> bool:
    """Whether a form changes a function; comments between functions are no part of either."""
    arguments = {given.arg for given in function.args.args}
    return function.name in form.put_in or any(argument in arguments for argument, _ in form.rows)


def _row_counts(function: ast.FunctionDef, argument: str) -> Iterator[ast.Subscript]:
    """Every `argument.shape[0]` of a function that takes it; CompileError where the name is given another value."""
    if argument not in {given.arg for given in function.args.args}:
        return
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and node.id == argument and not isinstance(node.ctx, ast.Load):
            raise CompileError(f"function '{function.name}' gives '{argument}' another value, so that its rows are no "
                               "constant: give the other value a name of its own")
        match node:
            case ast.Subscript(ast.Attribute(ast.Name(name), "shape"), ast.Constant(0)) if name == argument:
                yield node


def _changed(text: str, changes: Sequence[_Change]) -> str:
    """The text with its changes, from the last to the first, so that none moves the place of another."""
    lines = text.encode().splitlines(keepends=True)  # the parser counts bytes
    for line, first, last, new in sorted(changes, reverse=True):
        old = lines[line - 1]
        lines[line - 1] = old[:first] + new.encode() + old[last:]
    return b"".join(lines).decode()
