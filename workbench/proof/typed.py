"""Expressions as they are typed: within `as_typed`, sympy neither cancels x/x nor multiplies two complex roots.

Sympy simplifies while it builds: x/x becomes 1, 0*(1/x) becomes 0 and sqrt(-2)*sqrt(-3) becomes -sqrt(6), so that a
claim would be decided for more values than it speaks of. `sympy.evaluate(False)` would keep such terms, but under it
sympy's own calculations (expand, integrate, det) do not end or give nonsense. Here only what the caller's code writes
down is kept: operators, functions, `Add` and its like, and what `xreplace` puts together. What sympy calculates for it
is as sympy gives it.

What is built elsewhere is as sympy makes it; while a paper is imported, a term that loses a denominator, a root or a
logarithm thereby is an error (`whole_domains`).

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
from workbench.proof.cancelled import asked_after, asked_of, require_kept

T = TypeVar("T")

BUILDERS: tuple[Any, ...] = (AssocOp, sp.Pow, sp.Function, DefinedFunction, MinMaxBase)
# Names of sympy's functions by which code writes a term down, `__call__` of a Lambda; the last three wrap operators.
WRITTEN = {"sqrt", "xreplace", "__call__", "_func", "binary_op_wrapper", "__sympifyit_wrapper"}
WRITTEN |= {f"__{side}{name}__" for name in ("add", "sub", "mul", "truediv", "pow") for side in ("", "r")}
WRITTEN |= {"__neg__", "__pos__", "__abs__"}
REPLACERS = ("subs", "xreplace")

_blocks: list[int] = []  # the threads of all blocks that are open, in whatever thread
_open: dict[int, int] = {}  # by thread: how many of its blocks of `as_typed` are in force
_before: dict[Any, Any] = {}  # sympy's own way to build a term, while it is replaced
_building: set[int] = set()  # the threads that build a goal
_watching: set[int] = set()  # the threads that import a paper
_replaced: set[int] = set()  # the threads in which something is being put in
_lock = threading.Lock()


@contextmanager
def as_typed() -> Iterator[None]:
    """Keep every term that code outside of sympy writes down within this block, in this thread."""
    me = threading.get_ident()
    with _lock:
        _begin(me)
        _open[me] = _open.get(me, 0) + 1
    try:
        yield
    finally:
        with _lock:
            _open[me] -= 1
            if not _open[me]:
                del _open[me]
            _end(me)


@contextmanager
def whole_domains() -> Iterator[None]:
    """ClaimError where code outside of sympy writes down a term within this block, in this thread, of which sympy makes
    one that has a value where it has none."""
    me = threading.get_ident()
    with _lock:
        outermost = me not in _watching
        _begin(me)
        _watching.add(me)
    try:
        yield
    finally:
        with _lock:
            if outermost:
                _watching.discard(me)
            _end(me)


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


def _begin(thread: int) -> None:
    if not _before:
        _install()
    _blocks.append(thread)


def _end(thread: int) -> None:
    _blocks.remove(thread)
    if not _blocks:
        _remove()


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
    calculated = original.__name__ == "subs"  # by sympy, which cancels what is put in

    @wraps(original)
    def replace(self: Any, *args: Any, **options: Any) -> Any:
        me = threading.get_ident()
        entry = _entry(sys._getframe(1))
        of_matrix = calculated and entry == "subs"  # which asks its entries
        if (me not in _building and me not in _watching) or me in _replaced or not isinstance(self, sp.Expr) or not (
                entry is None or of_matrix):
            return original(self, *args, **options)
        given = args[0] if len(args) == 1 else [args[:2]]
        pairs = list(given.items() if hasattr(given, "items") else given)
        _replaced.add(me)
        try:
            for old, _ in pairs if me in _building and not of_matrix else ():
                if isinstance(old, sp.Expr) and old.args and not isinstance(old, (sp.Indexed, AppliedUndef)):
                    _require_seen(original, self, old)
            found = original(self, *args, **options)
            if calculated:
                with as_evaluated():
                    require_kept(asked_after(self, pairs, lambda of: original(of, *args, **options)), found)
        finally:
            _replaced.discard(me)
        return found

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


def _keeping(original: Callable[..., Any]) -> Callable[..., Any]:
    def build(cls: type, *args: Any, **options: Any) -> Any:
        me = threading.get_ident()
        if options.get("evaluate") is not None or (me not in _open and me not in _watching) or not _written(
                sys._getframe(1)):
            return original(cls, *args, **options)
        if me in _open:
            return original(cls, *args, **options | {"evaluate": False})
        found = original(cls, *args, **options)
        if found == 0 and _in_matrix(sys._getframe(1)):
            return found  # as on the diagonal of A - A.T, and of products with zeros; other entries keep their domain
        _watching.discard(me)  # what is asked of the term is calculated with sympy too
        try:
            require_kept(asked_of(cls, args), found)
        finally:
            _watching.add(me)
        return found

    return build


def _written(frame: FrameType | None) -> bool:
    """Whether a term is built because code outside of sympy writes it down, and not by a calculation of sympy."""
    entry = _entry(frame)
    return entry is None or entry in WRITTEN


def _entry(frame: FrameType | None) -> str | None:
    """The function of sympy that code outside of it has called; None where it builds the term itself."""
    entry = None
    while frame is not None and frame.f_globals.get("__name__", "").startswith("sympy."):
        entry, frame = frame.f_code.co_name, frame.f_back
    return entry


def _in_matrix(frame: FrameType | None) -> bool:
    """Whether a term is an entry of what is calculated with matrices."""
    while frame is not None and (name := frame.f_globals.get("__name__", "")).startswith("sympy."):
        if name.startswith("sympy.matrices."):
            return True
        frame = frame.f_back
    return False
