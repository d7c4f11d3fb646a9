"""Compiled functions that others call by their address: numba puts all that a function calls into it, compiled anew.

A solver that five functions call, each within the next, would be optimised six times; linked it is compiled once, kept
as other kernels are, and called as numba calls any function, so that numbers keep their bits.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any

from llvmlite import binding
from numba.core import cgutils, sigutils
from numba.core.dispatcher import Dispatcher
from numba.core.typing.templates import Signature
from numba.extending import intrinsic

ATTRIBUTE = "linked_function"


class LinkedFunction:
    """A compiled function with one signature, and the symbol by which the code of others finds it."""

    def __init__(self, dispatcher: Dispatcher, signature: Signature) -> None:
        self.dispatcher, self.signature = dispatcher, signature
        python = dispatcher.py_func
        self.symbol = f"{python.__module__}.{python.__qualname__}"

    def load(self) -> None:
        """Compile it where it was not kept, and tell the linker where it is, before code that calls it is loaded."""
        made = self.dispatcher.get_compile_result(self.signature)
        address = made.library.get_pointer_to_function(made.fndesc.llvm_func_name)
        binding.add_symbol(self.symbol, address)


def linked(signature: str) -> Callable[[Dispatcher], Any]:
    """Mark a function of a kernel that numba compiles as one that is linked; signature: its types, in numba's words."""
    arguments, result = sigutils.normalize_signature(signature)

    def mark(dispatcher: Dispatcher) -> Any:
        function = LinkedFunction(dispatcher, Signature(result, arguments, None))
        call = _call_of(function)
        setattr(call, ATTRIBUTE, function)
        return call

    return mark


def linked_functions(names: dict[str, Any], module: str) -> list[LinkedFunction]:
    """Those that a module itself defines, in the order of their definition."""
    found = [getattr(value, ATTRIBUTE) for value in names.values() if hasattr(value, ATTRIBUTE)]
    return [function for function in found if function.dispatcher.py_func.__module__ == module]


def _call_of(function: LinkedFunction) -> Any:
    """What stands for the function in the code of others: a call of its symbol, with numba's own way of calling."""

    def generate(context: Any, builder: Any, signature: Signature, arguments: Any) -> Any:
        convention = context.call_conv
        of_llvm = convention.get_function_type(signature.return_type, signature.args)
        callee = cgutils.get_or_insert_function(builder.module, of_llvm, function.symbol)
        status, result = convention.call_function(builder, callee, signature.return_type, signature.args, arguments)
        with cgutils.if_unlikely(builder, status.is_error):
            convention.return_status_propagate(builder, status)
        return result

    def typed(_: Any, *given: Any) -> tuple[Signature, Any] | None:
        return (function.signature, generate) if given == function.signature.args else None

    # numba asks for the arguments one by one.
    names = ["context", *inspect.signature(function.dispatcher.py_func).parameters]
    typed.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD) for name in names])
    return intrinsic(typed)
