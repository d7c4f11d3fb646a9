"""Kernels are compiled in a fork that ends, and loaded from where they are kept: a compiler leaves some 20 MB for each
kernel in its process, and a test process needs a hundred."""

import contextlib
import gc
import math
import os
import select
import signal
import warnings
from functools import cache
from pathlib import Path

import one_thread  # noqa: F401 - before numba imports numpy
from numba import float64, njit
from numba.core import sigutils
from numba.core.ccallback import CFunc
from numba.core.dispatcher import Dispatcher

PATIENCE_S = 60.0  # in which a fork that does nothing hangs on what a thread held: the kernel is compiled here
compile_here, compile_function_here = Dispatcher.compile, CFunc.compile


def kept(cache, signature, target) -> bool:
    """Whether code need not be compiled, or could not be loaded by another process."""
    file = getattr(cache, "_cache_file", None)
    return file is None or cache._index_key(signature, target.codegen()) in file._load_index()


def some_of_each(values, x):
    values[0] = min(values[1] * math.sin(x), max(abs(x), 1)) + x**2 / 3
    for i in range(len(values)):
        values[i] += math.exp(x) if x > 0 else math.copysign(1, x) * i


@cache
def first_compilation() -> None:
    """What a process does once before it compiles is done here, so that no fork has to do it."""
    compile_here(njit(error_model="numpy")(some_of_each), (float64[::1], float64))


def ticks_of(number) -> int:
    """What a process has had of processors: a busy machine gives it little, but what hangs takes none."""
    fields = Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()
    return int(fields[11]) + int(fields[12])


def in_a_fork(work, *arguments) -> None:
    """What fails there fails here again, where it is seen."""
    first_compilation()
    try:
        with warnings.catch_warnings(action="ignore", category=DeprecationWarning):  # there is a thread that only reads
            number = os.fork()
    except OSError:
        return
    if number:
        handle, spent = os.pidfd_open(number), -1
        while not select.select([handle], [], [], PATIENCE_S)[0]:
            before, spent = spent, ticks_of(number)
            if spent == before:
                os.kill(number, signal.SIGKILL)
        os.close(handle)
        os.waitpid(number, 0)
        return
    with contextlib.suppress(BaseException):
        Dispatcher.compile, CFunc.compile = compile_here, compile_function_here
        gc.disable()  # it ends too soon for garbage to matter
        work(*arguments)
    os._exit(0)


def compiled(dispatcher, signature):
    arguments, _ = sigutils.normalize_signature(signature)
    if arguments not in dispatcher.overloads and not kept(dispatcher._cache, signature, dispatcher.targetctx):
        in_a_fork(compile_here, dispatcher, signature)
    return compile_here(dispatcher, signature)


def compiled_function(function):
    if not kept(function._cache, function._sig, function._targetdescr.target_context):
        in_a_fork(compile_function_here, function)
    return compile_function_here(function)


def install() -> None:
    if not hasattr(os, "pidfd_open"):  # another system than Linux
        return
    Dispatcher.compile, CFunc.compile = compiled, compiled_function
