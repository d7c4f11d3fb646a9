"""Records on their way to a worker of a cluster and back: by pickle, which takes functions by their names, between
processes of one user as `multiprocessing` does it. Paths of what was uploaded become the paths of its copies there, and
a file that was not comes along.
"""

from __future__ import annotations

import io
import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from workbench.errors import WorkbenchError
from workbench.files.regular import LARGEST_DATA, contents
from workbench.files.upload import put_file


class _Sender(pickle.Pickler):
    def __init__(self, stream: io.BytesIO, roots: frozenset[Path]) -> None:
        super().__init__(stream, pickle.HIGHEST_PROTOCOL)
        self._roots = roots

    def persistent_id(self, value: Any) -> tuple[str, bytes | None] | None:
        """The whole path of what was uploaded, or of a file with what is in it, as pickle asks for it."""
        if not isinstance(value, Path):
            return None
        path = value.resolve()
        if path in self._roots or not self._roots.isdisjoint(path.parents):
            return path.as_posix(), None
        return (path.as_posix(), contents(path, LARGEST_DATA)) if path.is_file() else None


class _Receiver(pickle.Unpickler):
    def __init__(self, data: bytes, tree: Path) -> None:
        super().__init__(io.BytesIO(data))
        self._tree = tree

    def persistent_load(self, pid: tuple[str, bytes | None]) -> Path:
        """The copy of what was uploaded, as pickle asks for it."""
        name, data = pid
        path = Path(f"{self._tree}{name}")
        if data is not None:
            put_file(path, data)
        return path


class _Answer(pickle.Pickler):
    def __init__(self, stream: io.BytesIO, tree: Path) -> None:
        super().__init__(stream, pickle.HIGHEST_PROTOCOL)
        self._tree = str(tree)

    def persistent_id(self, value: Any) -> tuple[str, bool] | None:
        """A path, or a text with one, below the copies: as it is where it came from."""
        if isinstance(value, Path | str) and self._tree in (text := str(value)):
            return text.replace(self._tree, ""), isinstance(value, Path)
        return None


class _AnswerReader(pickle.Unpickler):
    def persistent_load(self, pid: tuple[str, bool]) -> Path | str:
        """The path, or the text, as pickle asks for it."""
        text, is_path = pid
        return Path(text) if is_path else text


@contextmanager
def named_things_alone() -> Iterator[None]:
    """WorkbenchError where what is to be sent holds what has no name in its module, as a function within a function."""
    try:
        yield
    except (pickle.PicklingError, AttributeError, TypeError) as trouble:
        raise WorkbenchError(f"a run cannot be handed to other processes ({trouble}): give functions and classes names "
                             "at the top level of their module, or run with --workers 1") from trouble


def job_bytes(job: Any) -> bytes:
    """What processes of this machine are given to run; raises WorkbenchError as `named_things_alone`."""
    with named_things_alone():
        return pickle.dumps(job, pickle.HIGHEST_PROTOCOL)


def job_of(data: bytes) -> Any:
    """In such a process: what was given."""
    return pickle.loads(data)  # noqa: S301 - from the process that has started this one


def packed(value: Any, roots: frozenset[Path]) -> bytes:
    """A value for a worker; raises WorkbenchError as `named_things_alone`."""
    stream = io.BytesIO()
    with named_things_alone():
        _Sender(stream, roots).dump(value)
    return stream.getvalue()


def received(data: bytes, tree: Path) -> Any:
    """On a worker: what was packed; tree: where the archive was unpacked."""
    return _Receiver(data, tree).load()


def answered(value: Any, tree: Path) -> bytes:
    """On a worker: a result to be sent back."""
    stream = io.BytesIO()
    _Answer(stream, tree).dump(value)
    return stream.getvalue()


def answer_of(data: bytes) -> Any:
    """What a worker has answered."""
    return _AnswerReader(io.BytesIO(data)).load()
