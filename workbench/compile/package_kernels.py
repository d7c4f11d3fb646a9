"""Functions of this package that numba compiles as they stand, kept where generated kernels are.

By itself numba keeps them beside their source, known by that file's time and size: another file's function or number
that is compiled into them could change unseen, and each copy of the package compiles all anew. Here a function is known
by what stands in the files of it and of all that it calls, and by the numbers that names stand for.
"""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

from numba import njit
from numba.core.dispatcher import Dispatcher

from workbench.compile.sealed import seal, sealed_folder
from workbench.files.regular import sha256_of


def compiled(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Mark a function as one that numba compiles, with options of numba's; it is kept from its first call on.

    Raises CompileError at that call where no folder can be written.
    """
    def mark(function: Callable[..., Any]) -> Any:
        dispatcher = njit(cache=True, **options)(function)
        dispatcher.digest_of_file = _digest(function)  # now, for the file may be another one later

        # Not when it is marked: all functions that it calls are known later.
        def compile_first(*signature: Any) -> Any:
            digest = hashlib.sha256("\n".join(made_of(dispatcher)).encode()).hexdigest()
            name = f"{function.__module__}.{function.__qualname__}.{digest[:20]}.{sys.implementation.cache_tag}"
            seal(dispatcher, sealed_folder(), name, digest)
            in_turn = dispatcher.compile
            return in_turn(*signature)

        dispatcher.compile = compile_first
        return dispatcher

    return mark


def _digest(function: Callable[..., Any]) -> str:
    return sha256_of(function.__code__.co_filename)


def made_of(dispatcher: Dispatcher) -> Iterator[str]:
    """What the code of a function depends on, in words: itself and all that it calls, options and named numbers."""
    waiting, seen = [dispatcher], {dispatcher}
    for one in waiting:
        function = one.py_func
        names, digest = function.__globals__, getattr(one, "digest_of_file", None) or _digest(function)
        yield f"{function.__module__}.{function.__qualname__} {one.targetoptions} {digest}"
        for name in sorted({*function.__code__.co_names} & {*names}):
            value = names[name]
            if not isinstance(value, Dispatcher):
                yield f"{name} = {value.__name__ if isinstance(value, ModuleType) else repr(value)}"
            elif value not in seen:
                seen.add(value)
                waiting.append(value)
