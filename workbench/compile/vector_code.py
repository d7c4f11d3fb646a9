"""Vector functions as source for numba: expressions over arrays of states, inputs, signals and parameters.

Symbols are renamed to plain variables, so that every name that sympy takes will do, `lambda` and `\\theta` too.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.printing.codeprinter import PrintMethodNotImplementedError
from sympy.printing.pycode import PythonCodePrinter

from workbench.compile.literals import require_short
from workbench.compile.parts import free_symbols, parts
from workbench.errors import CompileError
from workbench.model.law import time

Arrays = Mapping[str, Sequence[sp.Symbol]]
_printer = PythonCodePrinter({"fully_qualified_modules": True})
_INDENT = "    "
UNDONE = (sp.Sum, sp.Product, sp.Integral, sp.Derivative)


def _printed(expr: sp.Expr) -> str:
    require_short([expr])
    try:
        return str(_printer.doprint(expr))
    except PrintMethodNotImplementedError as trouble:
        name = str(trouble).partition(": ")[2].partition("\n")[0]
        raise CompileError(f"function '{name}' cannot be compiled: state it by exp, log, roots, trigonometric "
                           "functions, abs, sign, Min, Max or Piecewise") from None
    except ValueError as trouble:  # Python's own limit on the digits of an integer
        raise CompileError(f"a number cannot be written out ({trouble}): state it as a float") from None


def _names(arrays: Arrays, scalars: Mapping[str, sp.Symbol]) -> dict[sp.Symbol, sp.Symbol]:
    plain = {symbol: sp.Symbol(f"{array}_{i}", real=True) for array, symbols in arrays.items()
             for i, symbol in enumerate(symbols)}
    return plain | {symbol: sp.Symbol(name, real=True) for name, symbol in scalars.items()}


def _body(exprs: Sequence[sp.Expr], arrays: Arrays, scalars: Mapping[str, sp.Symbol],
          unpacked: Sequence[str] = ()) -> tuple[list[str], list[str]]:
    """Lines that load what is used and compute what is shared, and the text of each expression."""
    names = _names(arrays, scalars)
    for expr in exprs:  # before symbols are renamed, so that what is told is what was stated
        if any(isinstance(part, UNDONE) for part in parts(expr)):
            raise CompileError(f"{expr}: sums, products, integrals and derivatives cannot be compiled: carry them out")
    used = {symbol for expr in exprs for symbol in free_symbols(expr)}
    lost = sorted(map(str, used - set(names)))
    if lost:
        raise CompileError(f"symbol '{lost[0]}' has no value there: make it a state, an input or a parameter")
    lines = [f"{_INDENT}{names[symbol]} = {array}[{i}]" for array, symbols in arrays.items() if array not in unpacked
             for i, symbol in enumerate(symbols) if symbol in used]
    shared, reduced = sp.cse([expr.xreplace(names) for expr in exprs], sp.numbered_symbols("shared_"), order="none")
    lines += [f"{_INDENT}{symbol} = {_printed(expr)}" for symbol, expr in shared]
    return lines, [_printed(expr) for expr in reduced]


def into_array(name: str, exprs: Sequence[sp.Expr], arrays: Arrays, scalars: Mapping[str, sp.Symbol] | None = None,
               out: Sequence[str] | None = None) -> str:
    """Source of name(scalars..., arrays..., out), which writes every expression into `out`.

    out: where each expression goes, `out[0]`, `out[1]`, ... unless given. All is computed before anything is written.
    Raises CompileError for a function without code and a symbol without value.
    """
    given = scalars or {"t": time}
    lines, values = _body(exprs, arrays, given)
    targets = out or [f"out[{i}]" for i in range(len(values))]
    lines += [f"{_INDENT}found_{i} = {value}" for i, value in enumerate(values)]
    lines += [f"{_INDENT}{target} = found_{i}" for i, target in enumerate(targets)]
    return "\n".join([f"def {name}({', '.join([*given, *arrays, 'out'])}):", *(lines or [f"{_INDENT}pass"]), ""])


def smallest(name: str, exprs: Sequence[sp.Expr], arrays: Arrays,
             scalars: Mapping[str, sp.Symbol] | None = None) -> str:
    """Source of name(scalars..., arrays...) -> the smallest of the expressions; 1 without any."""
    given = scalars or {"t": time}
    lines, values = _body(exprs, arrays, given)
    found = f"min({', '.join(values)})" if len(values) > 1 else (values or ["1.0"])[0]
    return "\n".join([f"def {name}({', '.join([*given, *arrays])}):", *lines, f"{_INDENT}return {found}", ""])


def runge_kutta_step(exprs: Sequence[sp.Expr], states: Sequence[sp.Symbol], arrays: Arrays) -> str:
    """Source of plant_rates and plant_step: one classical Runge-Kutta step of x, in place, without arrays in between.

    exprs: the rates of the first states and of integrals that follow them; arrays: what else they use, each given at
    the step's begin, middle and end, but `p`, which is constant.
    """
    count, moving = len(exprs), [name for name in arrays if name != "p"]
    x = [f"x_{i}" for i in range(count)]
    lines, values = _body(exprs, {"x": states, **arrays}, {"t": time}, unpacked=("x",))
    rest = [*arrays]
    source = [f"def plant_rates(t, {', '.join([*x, *rest])}):", *lines,
              f"{_INDENT}return ({', '.join(f'1.0 * ({value})' for value in values)},)", ""]
    given = [f"{name}_{place}" for place in ("begin", "middle", "end") for name in moving]
    source += [f"def plant_step(t, h, x, {', '.join([*given, *(['p'] if 'p' in arrays else [])])}):"]
    source += [f"{_INDENT}{name} = x[{i}]" for i, name in enumerate(x)]
    stages = (("a", "", "begin", "0.0"), ("b", "a", "middle", "0.5 * h"), ("c", "b", "middle", "0.5 * h"),
              ("d", "c", "end", "h"))
    for stage, before, place, ahead in stages:
        at = [f"{name} + {ahead} * {before}_{i}" if before else name for i, name in enumerate(x)]
        others = [name if name == "p" else f"{name}_{place}" for name in rest]
        slopes = ", ".join(f"{stage}_{i}" for i in range(count))
        source.append(f"{_INDENT}{slopes}, = plant_rates(t + {ahead}, {', '.join([*at, *others])})")
    source += [f"{_INDENT}x[{i}] = x_{i} + h / 6.0 * (a_{i} + 2.0 * b_{i} + 2.0 * c_{i} + d_{i})" for i in range(count)]
    return "\n".join([*source, ""])


def jump_step(updates: Sequence[sp.Expr], integrands: Sequence[sp.Expr], states: Sequence[sp.Symbol],
              arrays: Arrays) -> str:
    """Source of plant_rates and plant_step of a plant in discrete time, as `runge_kutta_step` of one in continuous.

    plant_rates gives the next states and the integrands; an integral is the sum of its integrand times the step.
    """
    count, moving = len(updates) + len(integrands), [name for name in arrays if name != "p"]
    x = [f"x_{i}" for i in range(count)]
    lines, values = _body([*updates, *integrands], {"x": states, **arrays}, {"t": time}, unpacked=("x",))
    given = [f"{name}_{place}" for place in ("begin", "middle", "end") for name in moving]
    others = ["p" if name == "p" else f"{name}_begin" for name in arrays]
    found = ", ".join(f"a_{i}" for i in range(count))
    return "\n".join([
        f"def plant_rates(t, {', '.join([*x, *arrays])}):", *lines,
        f"{_INDENT}return ({', '.join(f'1.0 * ({value})' for value in values)},)", "",
        f"def plant_step(t, h, x, {', '.join([*given, *(['p'] if 'p' in arrays else [])])}):",
        *(f"{_INDENT}{name} = x[{i}]" for i, name in enumerate(x)),
        f"{_INDENT}{found}, = plant_rates(t, {', '.join([*x, *others])})",
        *(f"{_INDENT}x[{i}] = a_{i}" if i < len(updates) else f"{_INDENT}x[{i}] = x_{i} + h * a_{i}"
          for i in range(count)), ""])


def rates_into(count: int, arrays: Arrays) -> str:
    """Source of rates_into(t, x, arrays..., out), which puts what plant_rates gives of so many states into `out`."""
    rest, places = ", ".join(arrays), range(count)
    return "\n".join([
        f"def rates_into(t, x, {rest}, out):",
        f"{_INDENT}{', '.join(f'out[{i}]' for i in places)}, = plant_rates(t, {', '.join(f'x[{i}]' for i in places)}, "
        f"{rest})", ""])


def numeric_vector(arguments: Sequence[sp.Symbol], exprs: Sequence[sp.Expr]) -> Callable[..., Any]:
    """A Python function (time, *arguments) -> list of numbers, interpreted: for other libraries and for checks."""
    names = {symbol: sp.Symbol(f"argument_{i}", real=True) for i, symbol in enumerate((time, *arguments))}
    # What only a case that holds may calculate, such as a root, must not be taken out of it: Python's raises an error.
    shares = not any(expr.has(sp.Piecewise) for expr in exprs)
    found: Callable[..., Any] = sp.lambdify([*names.values()], [expr.xreplace(names) for expr in exprs],
                                            modules=["math"], cse=shares)
    return found
