"""The only place where sympy expressions become code: numba kernels to simulate, casadi functions for MPC."""

from __future__ import annotations

import hashlib
import importlib.util
import inspect
import keyword
import os
import sys
import tempfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

import casadi as ca
import platformdirs
import sympy as sp
from sympy.printing.pycode import PythonCodePrinter

from workbench.controllers.base import MEASUREMENTS, ControlLaw, neuron, neuron_count
from workbench.errors import CompileError
from workbench.train import Plant

CACHE_VARIABLE = "WORKBENCH_CACHE"

Estimates = Literal["corrected", "explicit"]

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


_printer = _Printer({"fully_qualified_modules": True})


# What the generated functions call their own variables.
_TAKEN = {"math", "neurons", "neuron_data", "parameters", "scalars"}


def _name(symbol: sp.Expr) -> str:
    name = str(symbol.base.label) if isinstance(symbol, sp.Indexed) else str(symbol)
    if not name.isidentifier() or keyword.iskeyword(name) or name in _TAKEN or name.startswith("_"):
        raise CompileError(f"symbol '{name}' cannot be the name of a variable: rename it")
    return name


def _require_known(exprs: Iterable[sp.Expr], known: Iterable[sp.Expr], where: str) -> None:
    allowed = {_name(s) for s in known}
    for expr in exprs:
        for symbol in sorted(expr.free_symbols, key=str):
            if isinstance(symbol, sp.IndexedBase) or symbol in (neuron, neuron_count):
                continue
            if _name(symbol) not in allowed:
                raise CompileError(f"{where}: symbol '{symbol}' has no value there: "
                                   f"make it a state, a parameter or a measurement")


def _assignments(targets: Sequence[str], exprs: Sequence[sp.Expr], prefix: str, indent: str) -> list[str]:
    """Source lines that compute exprs into targets, common subexpressions first."""
    # Sums were replaced before; Indexed symbols become plain symbols so that cse treats them as leaves.
    leaves = {i: sp.Symbol(_name(i)) for e in exprs for i in e.atoms(sp.Indexed)}
    shared, reduced = sp.cse([e.xreplace(leaves) for e in exprs], sp.numbered_symbols(prefix))
    lines = [f"{indent}{name} = {_printer.doprint(expr)}" for name, expr in shared]
    return lines + [f"{indent}{t} = {_printer.doprint(e)}" for t, e in zip(targets, reduced, strict=True)]


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
    lines += _assignments([*names, *terms], [*updates, *summands], f"{prefix}_", indent)
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

    updates, sums_now = _take_sums([*next_scalars, *next_neurons], "_sum_now_")
    (command,), sums_next = _take_sums([law.command], "_sum_next_")
    at_next: dict[sp.Expr, sp.Expr] = {s.symbol: sp.Symbol(f"{_name(s.symbol)}_next") for s in scalars}
    at_next |= {s.symbol: u for s, u in zip(neurons, updates[len(scalars):], strict=True)}
    if estimates == "explicit":
        at_next = {}

    given = zip(MEASUREMENTS, _MEASUREMENT_ARGUMENTS, strict=True)
    head = [f"    {_name(s)} = {argument}" for s, argument in given]
    head += _unpack(law.parameters, "parameters")
    body = [*head, *_unpack([s.symbol for s in scalars], "scalars")]
    body += _neuron_loop(law, sums_now, [], {}, "_a")
    body += _assignments([f"{_name(s.symbol)}_next" for s in scalars], updates[: len(scalars)], "_b", "    ")
    body += _neuron_loop(law, sums_next, updates[len(scalars):], at_next, "_c")
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


def plant_source(plant: Plant) -> str:
    """Python source of `plant_rates(states..., command, disturbance, parameters)`, a tuple of derivatives."""
    states = tuple(plant.rates)
    rates = list(plant.rates.values())
    _require_known(rates, (*states, plant.command, plant.disturbance, *plant.parameters), plant.source)
    arguments = ", ".join(_name(s) for s in (*states, plant.command, plant.disturbance))
    targets = [f"_rate_{i}" for i in range(len(rates))]
    return "\n".join([
        f"def plant_rates({arguments}, _parameters):", *_unpack(plant.parameters, "_parameters"),
        *_assignments(targets, rates, "_t", "    "), f"    return {', '.join(targets)}", "",
    ])


def cache_folder() -> Path:
    """Folder of compiled kernels: $WORKBENCH_CACHE, else the user's cache, else a temporary one."""
    chosen = os.environ.get(CACHE_VARIABLE) or platformdirs.user_cache_dir("workbench")
    for folder in (Path(chosen) / "kernels", Path(tempfile.gettempdir()) / "workbench-kernels"):
        try:
            folder.mkdir(parents=True, exist_ok=True)
            with tempfile.TemporaryFile(dir=folder):
                return folder
        except OSError:
            continue
    raise CompileError(f"no writable folder for compiled kernels: set {CACHE_VARIABLE} to one")


def kernel_module(plant: Plant, law: ControlLaw, loop: ModuleType,
                  estimates: Estimates = "corrected") -> ModuleType:
    """The compiled module of a plant under a law, driven by the functions of `loop`; cached between runs.

    The source of `loop` is joined to the generated functions, and every function becomes a numba kernel.
    """
    loop_source = inspect.getsource(loop).split("# --- kernel ---")[1]
    text = "\n".join([
        f'"""Generated from the sympy expressions of {law.source} and {plant.source}."""', "",
        "import math", "", "from numba import njit", "",
        plant_source(plant), law_source(law, estimates), loop_source,
    ])
    # By numpy's error model a division by zero gives inf or nan, which the loop reports as a diverged law.
    text = text.replace("\ndef ", "\n@njit(cache=True, error_model='numpy')\ndef ")
    digest = hashlib.sha256(text.encode()).hexdigest()[:20]
    name = f"workbench_kernel_{digest}"
    if name in sys.modules:
        return sys.modules[name]
    path = cache_folder() / f"{name}.py"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        # Written aside and renamed, so that no process ever imports half a file.
        with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, suffix=".tmp",
                                         delete=False) as stream:
            stream.write(text)
        Path(stream.name).replace(path)
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise CompileError(f"cannot import the generated kernel {path}: remove it and run again")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def casadi_function(name: str, arguments: Sequence[sp.Symbol], exprs: Sequence[sp.Expr]) -> Any:
    """A casadi Function of scalar arguments from sympy expressions."""
    _require_known(exprs, arguments, name)
    symbols = [ca.SX.sym(str(a)) for a in arguments]
    evaluate = sp.lambdify(arguments, list(exprs), modules=[_CASADI, "math"], cse=True)
    return ca.Function(name, symbols, [ca.vertcat(*evaluate(*symbols))])


def numeric(arguments: Sequence[sp.Symbol], expr: sp.Expr) -> Callable[..., Any]:
    """A numpy function of an expression, for figures and tests."""
    return sp.lambdify(arguments, expr, modules="numpy", cse=True)
