"""The only place where sympy expressions become code: numba kernels to simulate, casadi functions for MPC."""

from __future__ import annotations

import hashlib
import inspect
import keyword
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

import casadi as ca
import sympy as sp
from sympy.printing.codeprinter import PrintMethodNotImplementedError
from sympy.printing.pycode import PythonCodePrinter

from workbench.compile.cases import numbers_of
from workbench.compile.code_cache import imported_kernel
from workbench.compile.literals import require_short
from workbench.compile.parts import free_symbols
from workbench.compile.text import module_text, shared_text
from workbench.errors import CompileError
from workbench.files.modules import OF_A_KERNEL
from workbench.model.law import MEASUREMENTS, ControlLaw, neuron, neuron_count
from workbench.trains.multi_particle import cars
from workbench.trains.train import Plant

Estimates = Literal["corrected", "explicit"]

# Whose functions make text of expressions, this file first.
KERNEL_SOURCES = (Path(__file__), Path(inspect.getfile(require_short)))

_CASADI: dict[str, Any] = {
    "exp": ca.exp, "log": ca.log, "sqrt": ca.sqrt, "tanh": ca.tanh, "sin": ca.sin, "cos": ca.cos,
    "Abs": ca.fabs, "sign": ca.sign, "Max": ca.fmax, "Min": ca.fmin,
}


class _Printer(PythonCodePrinter):
    """Python source of scalar expressions; an indexed symbol prints as its base's name."""

    def _print_Indexed(self, expr: sp.Indexed) -> str:
        return str(expr.base.label)

    def _print_Sum(self, expr: sp.Sum) -> str:
        raise CompileError(f"a sum inside a sum cannot be compiled: {expr}")


class _NeuronPrinter(_Printer):
    """For a pass over neurons, most of which are far away: of less than -746 exp is zero, and takes five times as long
    to say so as it takes for other numbers."""

    def _print_exp(self, expr: sp.exp) -> str:
        x = self._print(expr.args[0])
        return f"(0.0 if {x} < -746.0 else math.exp({x}))"


_QUALIFIED = {"fully_qualified_modules": True}
_printer, _neuron_printer = _Printer(_QUALIFIED), _NeuronPrinter(_QUALIFIED)


# What the generated functions call their own variables.
_TAKEN = {"math", "neurons", "neuron_data", "parameters", "scalars"}


# A car's neighbours: where they stand in the train, and how their values are called.
_NEIGHBOURS = {-1: ("_ahead", "max(_j - 1, 0)"), 0: ("", "_j"), 1: ("_behind", "min(_j + 1, _last)")}


def _offset(symbol: sp.Indexed) -> int:
    """How many places behind j the index of a symbol is; CompileError for another index."""
    found = {number for number in _NEIGHBOURS if symbol.indices == (neuron + number,)}
    if not found:
        raise CompileError(f"'{symbol}' has no value there: an index is j, j - 1 or j + 1")
    return found.pop()


def _name(symbol: sp.Expr) -> str:
    name = str(symbol)
    if isinstance(symbol, sp.Indexed):
        name = f"{symbol.base.label}{_NEIGHBOURS[_offset(symbol)][0]}"
    if not name.isidentifier() or keyword.iskeyword(name) or name in _TAKEN or name.startswith("_"):
        raise CompileError(f"symbol '{name}' cannot be the name of a variable: rename it")
    return name


def _require_known(exprs: Iterable[sp.Expr], known: Iterable[sp.Expr], where: str) -> None:
    allowed = {_name(s): s for s in known}
    for expr in exprs:
        used = free_symbols(expr)
        labels = {symbol.base.label for symbol in used if isinstance(symbol, sp.Indexed)}
        for symbol in sorted(used - labels, key=str):
            if isinstance(symbol, sp.IndexedBase) or symbol in (neuron, neuron_count, cars):
                continue
            if _name(symbol) not in allowed:
                raise CompileError(f"{where}: symbol '{symbol}' has no value there: "
                                   f"make it a state, a parameter or a measurement")
            if symbol != allowed[_name(symbol)]:
                raise CompileError(f"{where}: symbol '{symbol}' has other assumptions than the declared one of that "
                                   "name: use the same object")


def _require_distinct(names: Iterable[str], where: str) -> None:
    """CompileError where two symbols would be one variable, of which one would take the other's value."""
    taken: set[str] = set()
    for name in names:
        if name in taken:
            raise CompileError(f"{where}: two symbols would be called '{name}', a state's next value, a measurement or "
                               "the sampling period among them: rename one")
        taken.add(name)


def _assignments(targets: Sequence[str], exprs: Sequence[sp.Expr], prefix: str, indent: str,
                 printer: _Printer = _printer) -> list[str]:
    """Source lines that compute exprs into targets, common subexpressions first."""
    # Sums were replaced before; Indexed symbols become plain symbols so that cse treats them as leaves.
    leaves = {i: sp.Symbol(_name(i)) for e in exprs for i in e.atoms(sp.Indexed)}
    shared, reduced = sp.cse([e.xreplace(leaves) for e in numbers_of(exprs)], sp.numbered_symbols(prefix))
    require_short(reduced + [expr for _, expr in shared])
    try:
        lines = [f"{indent}{name} = {printer.doprint(expr)}" for name, expr in shared]
        return lines + [f"{indent}{t} = {printer.doprint(e)}" for t, e in zip(targets, reduced, strict=True)]
    except PrintMethodNotImplementedError as trouble:
        name = str(trouble).partition(": ")[2].partition("\n")[0]
        raise CompileError(f"function '{name}' cannot be compiled: state it by functions that can be") from None
    except ValueError as trouble:  # Python's own limit on the digits of an integer
        raise CompileError(f"a number cannot be written out ({trouble}): state it as a float") from None


def _unpack(symbols: Sequence[sp.Expr], array: str, indent: str = "    ", index: str = "") -> list[str]:
    return [f"{indent}{_name(s)} = {array}[{i}{index}]" for i, s in enumerate(symbols)]


def _take_sums(exprs: Sequence[sp.Expr], prefix: str) -> tuple[list[sp.Expr], dict[sp.Sum, sp.Symbol]]:
    """Replace every sum over neurons by a symbol; the same sum gets the same symbol."""
    sums = sorted({s for e in exprs for s in e.atoms(sp.Sum)}, key=sp.default_sort_key)
    names = {s: sp.Symbol(f"{prefix}{i}") for i, s in enumerate(sums)}
    return [e.xreplace(names) for e in exprs], names


def _neuron_loop(law: ControlLaw, sums: dict[sp.Sum, sp.Symbol], updates: Sequence[sp.Expr],
                 at_next: dict[sp.Expr, sp.Expr], prefix: str) -> list[str]:
    """One pass over the neurons: their updates, and the sums evaluated where `at_next` says."""
    if not sums and not updates:
        return []
    lines = [f"    {symbol} = 0.0" for symbol in sums.values()]
    lines.append("    for _j in range(neurons.shape[1]):")
    indent = "        "
    lines += _unpack([s.symbol for s in law.neuron_states], "neurons", indent, ", _j")
    lines += _unpack(law.neuron_data, "neuron_data", indent, ", _j")
    names = [f"{_name(s.symbol)}_next" for s in law.neuron_states] if updates else []
    # The next values stand in the summands as expressions, so that one cse shares each neuron's output.
    summands = [s.function.xreplace(at_next) for s in sums]
    terms = [f"{n}_term" for n in sums.values()]
    lines += _assignments([*names, *terms], [*updates, *summands], f"{prefix}_", indent, _neuron_printer)
    lines += [f"{indent}{n} += {n}_term" for n in sums.values()]
    lines += [f"{indent}neurons[{i}, _j] = {name}" for i, name in enumerate(names)]
    return lines


def law_source(law: ControlLaw, estimates: Estimates = "corrected") -> str:
    """Python source of `control_step` (advance the law's states, return u) and `domain_margin`.

    All next values use the current states. With `corrected` estimates the command uses the next ones, so that
    an estimate is corrected by the very sample that the command answers; with `explicit` the current ones.
    """
    scalars, neurons = law.scalar_states, law.neuron_states
    known = (*MEASUREMENTS, *law.parameters, *(s.symbol for s in law.states), *law.neuron_data)
    next_scalars = [law.next_value(s) for s in scalars]
    next_neurons = [law.next_value(s) for s in neurons]
    _require_known([*next_scalars, *next_neurons, law.command, *law.domain], known, law.id)
    _require_distinct([*map(_name, known), *(f"{_name(s.symbol)}_next" for s in law.states)], law.id)

    at_next: dict[sp.Expr, sp.Expr] = {}
    sums_next: dict[sp.Sum, sp.Symbol] = {}
    if estimates == "explicit":  # everything from the current values, so that each sum is needed once
        (*updates, command), sums_now = _take_sums([*next_scalars, *next_neurons, law.command], "_sum_now_")
    else:
        updates, sums_now = _take_sums([*next_scalars, *next_neurons], "_sum_now_")
        (command,), sums_next = _take_sums([law.command], "_sum_next_")
        at_next |= {s.symbol: sp.Symbol(f"{_name(s.symbol)}_next") for s in scalars}
        at_next |= {s.symbol: u for s, u in zip(neurons, updates[len(scalars):], strict=True)}
    moved = updates[len(scalars):]
    # Neurons that need no sum move in the pass that takes the sums, which then evaluates their outputs only once.
    in_one = estimates == "explicit" and not any(u.free_symbols & set(sums_now.values()) for u in moved)

    given = zip(MEASUREMENTS, _MEASUREMENT_ARGUMENTS, strict=True)
    head = [f"    {_name(s)} = {argument}" for s, argument in given]
    head += _unpack(law.parameters, "parameters")
    body = [*head, *_unpack([s.symbol for s in scalars], "scalars")]
    body += _neuron_loop(law, sums_now, moved if in_one else [], {}, "_a")
    body += _assignments([f"{_name(s.symbol)}_next" for s in scalars], updates[: len(scalars)], "_b", "    ")
    body += _neuron_loop(law, sums_next, [] if in_one else moved, at_next, "_c")
    body += [f"    scalars[{i}] = {_name(s.symbol)}_next" for i, s in enumerate(scalars)]
    body += _assignments(["_command"], [command.xreplace(at_next)], "_d", "    ")
    margins = [f"_margin_{i}" for i in range(len(law.domain))]
    margin = [*head, *_assignments(margins, law.domain, "_e", "    ")]
    smallest = ", ".join([*margins, "math.inf", "math.inf"])
    arguments = ", ".join(_MEASUREMENT_ARGUMENTS)
    return "\n".join([
        f"def control_step({arguments}, parameters, scalars, neurons, neuron_data):", *body,
        "    return _command", "", "",
        f"def domain_margin({arguments}, parameters):", *margin, f"    return min({smallest})", "",
    ])


_MEASUREMENT_ARGUMENTS = tuple(f"_in_{i}" for i in range(len(MEASUREMENTS)))


def function_source(name: str, arguments: Sequence[sp.Symbol], parameters: Sequence[sp.Symbol],
                    exprs: Sequence[sp.Expr]) -> str:
    """Python source of `name(*arguments, parameters)`: the value of one expression, a tuple of those of several.

    The parameters come as one array in the order given. Raises CompileError for a symbol that has no value.
    """
    _require_known(exprs, (*arguments, *parameters), name)
    targets = [f"_value_{i}" for i in range(len(exprs))]
    return "\n".join([
        f"def {name}({', '.join([*map(_name, arguments), '_parameters'])}):", *_unpack(parameters, "_parameters"),
        *_assignments(targets, exprs, "_t", "    "), f"    return {', '.join(targets)}", "",
    ])


def plant_source(plant: Plant) -> str:
    """Python source of `plant_rates(states..., command, disturbance, parameters)`, a tuple of derivatives."""
    arguments = (*plant.rates, plant.command, plant.disturbance)
    return function_source("plant_rates", arguments, plant.parameters, list(plant.rates.values()))


def cars_source(name: str, arguments: Sequence[sp.Symbol], parameters: Sequence[sp.Symbol],
                given: Sequence[Sequence[sp.Indexed]], found: Sequence[Sequence[sp.Expr]],
                shared: Sequence[sp.Expr] = ()) -> str:
    """Python source of `name(*arguments, parameters, *given, *found, shared)`: expressions of every car of a train.

    given: arrays of shape (rows, cars), by the symbols of their rows; found: arrays of that shape that the expressions
    are put into, one a row; shared: one array for what no car has of its own. Sums over the cars are taken first, in
    one pass. `x[j - 1]` is the car ahead and `x[j + 1]` the one behind; at the ends, where there is none, the car
    itself, so that a found array must not be given at the same time where neighbours are used.
    Raises CompileError for a symbol that has no value.
    """
    where = {x.base[neuron + step]: f"_given_{i}[{row}, {place}]" for i, array in enumerate(given)
             for row, x in enumerate(array) for step, (_, place) in _NEIGHBOURS.items()}
    flat = [x for array in found for x in array]
    _require_known([*flat, *shared], (*arguments, *parameters, *where), name)
    every, sums = _take_sums([*flat, *shared], "_sum_")
    own, common, terms = every[: len(flat)], every[len(flat):], [s.function for s in sums]

    def one_pass(exprs: Sequence[sp.Expr], targets: Sequence[str], prefix: str) -> list[str]:
        used = sorted({x for e in exprs for x in e.atoms(sp.Indexed)}, key=_name)
        return ["    for _j in range(_last + 1):", *(f"        {_name(x)} = {where[x]}" for x in used),
                *_assignments(targets, exprs, prefix, "        ")]

    arrays = [f"_{kind}_{i}" for kind, rows in (("given", given), ("found", found)) for i in range(len(rows))]
    receiving = [*map(_name, arguments), "_parameters", *arrays, *(["_shared"] if common else [])]
    lines = [f"def {name}({', '.join(receiving)}):", *_unpack(parameters, "_parameters"),
             "    _last = _given_0.shape[1] - 1"]
    if sums:
        lines += [f"    {total} = 0.0" for total in sums.values()]
        lines += one_pass(terms, [f"{total}_term" for total in sums.values()], "_a")
        lines += [f"        {total} += {total}_term" for total in sums.values()]
    lines += _assignments([f"_shared[{i}]" for i in range(len(common))], common, "_b", "    ")
    values = [f"_value_{i}" for i in range(len(own))]
    lines += one_pass(own, values, "_c")
    places = [f"_found_{i}[{row}, _j]" for i, array in enumerate(found) for row in range(len(array))]
    return "\n".join([*lines, *(f"        {place} = {value}" for place, value in zip(places, values, strict=True)), ""])


def loop_module(source: str, functions: Sequence[str], loop: ModuleType) -> ModuleType:
    """The compiled module of generated functions, driven by what stands below the marker in `loop`; cached.

    source: what the functions were generated from, in words; functions: their Python source. All of it is joined
    into one module on disk, in which every function becomes a numba kernel, as `module_text` says.
    Raises CompileError where no folder can be written.
    """
    common = shared_text(loop)
    shared = _of_text(common).__name__ if common else ""
    return _of_text(module_text(source, functions, loop, shared))


def _of_text(text: str) -> ModuleType:
    name = f"{OF_A_KERNEL}{hashlib.sha256(text.encode()).hexdigest()[:20]}"
    return sys.modules.get(name) or imported_kernel(name, text)


def casadi_function(name: str, arguments: Sequence[sp.Symbol], exprs: Sequence[sp.Expr]) -> Any:
    """A casadi Function of scalar arguments from sympy expressions."""
    _require_known(exprs, arguments, name)
    symbols = [ca.SX.sym(str(a)) for a in arguments]
    evaluate = sp.lambdify(arguments, list(exprs), modules=[_CASADI, "math"], cse=True)
    return ca.Function(name, symbols, [ca.vertcat(*evaluate(*symbols))])


def numeric(arguments: Sequence[sp.Symbol], expr: sp.Expr) -> Callable[..., Any]:
    """A numpy function of an expression, for figures and tests."""
    return sp.lambdify(arguments, expr, modules="numpy", cse=True)
