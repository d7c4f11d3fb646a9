"""What a sign or an index makes of numbers and arrays, found once: numba goes through all that it knows of arrays at
every `a * b` and `a[i]`, and compares all its options with each other each time.

A law takes about a seventh less to compile by it, MPC's solver, which is full of indices, a quarter. The code is the
same.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

from numba.core import types
from numba.core.compiler_lock import global_compiler_lock
from numba.core.targetconfig import TargetConfig
from numba.core.types.containers import Tuple, UniTuple
from numba.core.types.functions import BaseFunction
from numba.core.types.misc import SliceType

# What a function gives is known by these types alone; a literal is known by its value too, an array by what is in it.
SIMPLE: set[type] = {types.Boolean, types.Float, types.Integer}
INDICES: set[type] = {types.IntegerLiteral, SliceType}
_by_numba, _hash_by_numba, _equal_by_numba = BaseFunction.get_call_type, TargetConfig.__hash__, TargetConfig.__eq__


@contextmanager
def typed_once() -> Iterator[None]:
    """Within it numba remembers, as long as the process lives, what signs and builtin functions give of numbers, and
    indices of arrays."""
    with global_compiler_lock:  # which compiling takes anyway
        before = BaseFunction.get_call_type, TargetConfig.__hash__, TargetConfig.__eq__
        _replace(_call_type, _hash, _equal)
        try:
            yield
        finally:
            _replace(*before)


def _replace(call_type: Any, hashed: Any, equal: Any) -> None:
    for kind, name, function in ((BaseFunction, "get_call_type", call_type), (TargetConfig, "__hash__", hashed),
                                 (TargetConfig, "__eq__", equal)):
        setattr(kind, name, function)


@cache
def _remembered(function: Any, context: Any, arguments: tuple[Any, ...]) -> Any:
    return _by_numba(function, context, arguments, {})


def _call_type(function: Any, context: Any, arguments: tuple[Any, ...], named: dict[str, Any]) -> Any:
    if (named or getattr(function.typing_key, "__module__", "") not in ("_operator", "builtins")
            or not all(map(_is_simple, arguments))):
        return _by_numba(function, context, arguments, named)
    return _remembered(function, context, arguments)


def _is_simple(one: Any) -> bool:
    kind = type(one)
    if kind is types.Array:
        return type(one.dtype) in SIMPLE
    if kind in (UniTuple, Tuple):
        return all(type(part) in SIMPLE or type(part) in INDICES for part in one)
    return kind in SIMPLE or kind in INDICES


def _hash(options: Any) -> int:
    kind: Any = type(options)
    return _hash_of(kind)


@cache
def _hash_of(kind: Any) -> int:
    """numba hashes the names of the options alone."""
    return _hash_by_numba(kind())


def _equal(options: Any, others: Any) -> Any:
    if type(options) is type(others) and options._values == others._values:
        return True
    return _equal_by_numba(options, others)
