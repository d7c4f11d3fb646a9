"""Expressions as they are typed: within `as_typed`, sympy neither cancels x/x nor multiplies two complex roots.

Sympy simplifies while it builds: x/x becomes 1, 0*(1/x) becomes 0 and sqrt(-2)*sqrt(-3) becomes -sqrt(6), so that a
claim would be decided for more values than it speaks of. `sympy.evaluate(False)` would keep such terms, but under it
sympy's own calculations (expand, integrate, det) do not end or give nonsense. Here only what the caller's code writes
down is kept: operators, functions, `Add` and its like, and what `xreplace` puts together. What sympy calculates for it
is as sympy gives it.

A term kept as typed is another one than sympy's own, so that `subs` would pass over what was built elsewhere, without a
word, and a goal would say what nobody meant. While a goal is built that is an error.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache, wraps
from types import FrameType
from typing import Any, TypeVar

import sympy as sp
from sympy.core.function import AppliedUndef, DefinedFunction
from sympy.core.operations import AssocOp
from sympy.functions.elementary.miscellaneous import MinMaxBase

from workbench.errors import ClaimError

T = TypeVar("T")

BUILDERS: tuple[Any, ...] = (AssocOp, sp.Pow, sp.Function, DefinedFunction, MinMaxBase)
# Names of sympy's functions by which code writes a term down; the last three wrap the operators.
WRITTEN = {"sqrt", "xreplace", "_func", "binary_op_wrapper", "__sympifyit_wrapper"}
WRITTEN |= {f"__{side}{name}__" for name in ("add", "sub", "mul", "truediv", "pow") for side in ("", "r")}
WRITTEN |= {"__neg__", "__pos__", "__abs__"}
REPLACERS = ("subs", "xreplace")

_blocks: list[int] = []  # the threads of all blocks of `as_typed` that are open, in whatever thread
_open: dict[int, int] = {}  # by thread: how many of its blocks are in force
_before: dict[Any, Any] = {}  # sympy's own way to build a term, while it is replaced
_building: set[int] = set()  # the threads that build a goal
_lock = threading.Lock()


@contextmanager
def as_typed() -> Iterator[None]:
    """Keep every term that code outside of sympy writes down within this block, in this thread."""
    me = threading.get_ident()
    with _lock:
        if not _before:
            _install()
        _blocks.append(me)
        _open[me] = _open.get(me, 0) + 1
    try:
        yield
    finally:
        with _lock:
            _blocks.remove(me)
            _open[me] -= 1
            if not _open[me]:
                del _open[me]
            if not _blocks:
                _remove()


@contextmanager
def as_evaluated() -> Iterator[None]:
    """Let sympy evaluate within this block, whatever is open around it."""
    me = threading.get_ident()
    with _lock:
        depth = _open.pop(me, 0)
    try:
        yield
    finally:
        with _lock:
            if depth:
                _open[me] = depth


def kept_as_typed(build: Callable[[], T]) -> Callable[[], T]:
    """The function, run within `as_typed`; one that is so already is given back as it is."""
    if getattr(build, "keeps_typed", False):
        return build

    @wraps(build)
    def typed() -> T:
        me = threading.get_ident()
        outermost = me not in _building
        _building.add(me)
        try:
            with as_typed():
                return build()
        finally:
            if outermost:
                _building.discard(me)

    typed.keeps_typed = True  # type: ignore[attr-defined]
    return typed


@lru_cache(maxsize=4096)  # the same sides are asked for by every decider, and when a goal is made of others
def evaluated(expr: sp.Expr, functions: bool = True) -> sp.Expr:
    """The same expression as sympy would have built it; where the one as typed has a value, this has the same.

    functions: whether sympy evaluates abs, sign, Max, Min, log, exp and tanh as well.
    """
    if not expr.args:
        return expr
    with as_evaluated():
        return _evaluated(expr, functions)


@lru_cache(maxsize=16384)  # what a paper's goals are made of stands in many of them
def _evaluated(expr: sp.Expr, functions: bool) -> sp.Expr:
    if not expr.args or isinstance(expr, sp.Indexed):
        return expr
    if isinstance(expr, sp.Sum):
        return sp.Sum(_evaluated(expr.function, functions), *expr.limits)
    parts = [_evaluated(part, functions) for part in expr.args]
    size_raised = isinstance(expr, sp.Pow) and isinstance(parts[0], sp.Abs)  # sympy makes x**2 of abs(x)**2
    if functions or (isinstance(expr, (sp.Add, sp.Mul, sp.Pow)) and not size_raised):
        return expr.func(*parts)
    return expr.func(*parts, evaluate=False)


def _install() -> None:
    for owner in BUILDERS:
        _before[owner] = owner.__dict__["__new__"]
        owner.__new__ = staticmethod(_keeping(owner.__new__))
    for name in REPLACERS:
        _before[name] = getattr(sp.Basic, name)
        setattr(sp.Basic, name, _replacing(_before[name]))


def _remove() -> None:
    for owner, original in _before.items():
        if isinstance(owner, str):
            setattr(sp.Basic, owner, original)
        else:
            owner.__new__ = original
    _before.clear()


def _replacing(original: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(original)
    def replace(self: Any, *args: Any, **options: Any) -> Any:
        if threading.get_ident() in _building and isinstance(self, sp.Expr) and not _inside_sympy(sys._getframe(1)):
            given = args[0] if len(args) == 1 else [args[:2]]
            for old, _ in given.items() if hasattr(given, "items") else given:
                if isinstance(old, sp.Expr) and old.args and not isinstance(old, (sp.Indexed, AppliedUndef)):
                    _require_seen(original, self, old)
        return original(self, *args, **options)

    return replace


def _require_seen(original: Callable[..., Any], expr: sp.Expr, old: sp.Expr) -> None:
    """ClaimError where a term stands in an expression for sympy, and not in the form in which one of them is typed."""
    mark = sp.Dummy()
    if original(expr, {old: mark}) != expr:
        return
    plain = evaluated(expr)
    with as_evaluated():
        seen = original(plain, {evaluated(old): mark}) != plain
    if seen:
        raise ClaimError(f"nothing is put in for {old}, which stands in the expression in another form, because terms "
                         "are kept as typed within a goal's function: build both above it, in the module")


def _inside_sympy(frame: FrameType) -> bool:
    return str(frame.f_globals.get("__name__", "")).startswith("sympy.")


def _keeping(original: Callable[..., Any]) -> Callable[..., Any]:
    def build(cls: type, *args: Any, **options: Any) -> Any:
        if options.get("evaluate") is None and threading.get_ident() in _open and _written(sys._getframe(1)):
            options["evaluate"] = False
        return original(cls, *args, **options)

    return build


def _written(frame: FrameType | None) -> bool:
    """Whether a term is built because code outside of sympy writes it down, and not by a calculation of sympy."""
    entry = None
    while frame is not None and frame.f_globals.get("__name__", "").startswith("sympy."):
        entry, frame = frame.f_code.co_name, frame.f_back
    return entry is None or entry in WRITTEN
