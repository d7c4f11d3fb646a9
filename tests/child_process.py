"""What takes much memory is made in a fork, so that the test process stays small: it runs a hundred modules."""

import os
import pickle
import traceback
import warnings
from collections.abc import Callable
from typing import Any


def made_in_a_fork(make: Callable[..., Any], *arguments: Any) -> Any:
    """What `make` returns; AssertionError with its traceback where it fails there. Made here where nothing can fork."""
    if not hasattr(os, "fork"):
        return make(*arguments)
    reading, writing = os.pipe()
    with warnings.catch_warnings(action="ignore", category=DeprecationWarning):  # threads that only read
        number = os.fork()
    if not number:
        code = 1
        try:
            os.close(reading)
            with os.fdopen(writing, "wb") as stream:
                try:
                    answer = pickle.dumps((True, make(*arguments)))
                except BaseException:  # told where it is seen
                    answer = pickle.dumps((False, traceback.format_exc()))
                stream.write(answer)
            code = 0
        finally:
            os._exit(code)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        answer = stream.read()
    os.waitpid(number, 0)
    assert answer, "the fork ended without an answer"
    made, found = pickle.loads(answer)  # noqa: S301 - of our own fork
    assert made, found
    return found
