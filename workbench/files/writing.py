"""Files written whole or not at all: aside and renamed, so that neither a full disk nor an interruption leaves half."""

from __future__ import annotations

import errno
import os
import secrets
import stat
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path, PurePath

from workbench.errors import InputError
from workbench.files.outputs import is_stream

ANOTHER_PLACE = "name another place"

_NEW = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)


def as_bytes(text: str) -> bytes:
    """A text as UTF-8; of the name of a file that is no text, the bytes that are none by their numbers, as JSON has
    them too."""
    return text.encode(errors="backslashreplace")


def write_pieces(path: Path, pieces: Iterable[bytes], remedy: str = ANOTHER_PLACE) -> None:
    """`write_bytes` of what need not be in memory as a whole."""
    def written() -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, pieces)

    _in_one_line(path, written, remedy)


def set_aside(path: Path, remedy: str = ANOTHER_PLACE) -> None:
    """Keep a file under its name with `.before` appended, in place of what stood there; InputError where that fails."""
    def moved() -> None:
        path.replace(path.with_name(path.name + ".before"))

    _in_one_line(path, moved, remedy)


def write_text(path: Path, text: str, remedy: str = ANOTHER_PLACE) -> None:
    """Write a text as UTF-8, its lines ended as they are in it; InputError, nothing half-written, where that fails."""
    write_bytes(path, as_bytes(text), remedy)


def write_bytes(path: Path, data: bytes, remedy: str = ANOTHER_PLACE) -> None:
    """Write a file, its folder with it; InputError where that fails, and then what stood there is as it was.

    A link is replaced and never written through; a stream, such as /dev/stdout, is written as it is.
    """
    def written() -> None:
        if is_stream(path):
            _to_stream(path, data)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(path, data)

    _in_one_line(path, written, remedy)


def write_tree(folder: Path, files: Mapping[PurePath, bytes], remedy: str = ANOTHER_PLACE) -> None:
    """Write new files below a folder, by their places in it; where one is there already or cannot be written, what
    this call has made is removed again, and InputError."""
    made: list[Path] = []
    try:
        for place, data in files.items():
            path = folder / place
            made += reversed([above for above in path.parents if not above.exists() and above not in made])
            _write_new(path, data, remedy)
            made.append(path)
    except BaseException:
        for path in reversed(made):
            with suppress(OSError, ValueError):  # a folder that was not made, or is not empty, stays as it is
                if path.is_dir():
                    path.rmdir()
                else:
                    path.unlink(missing_ok=True)
        raise


def _write_new(path: Path, data: bytes, remedy: str) -> None:
    def written() -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            handle = os.open(path, _NEW, 0o666)
        except FileExistsError:
            raise InputError(path, "", "exists already: give another name, or move it away first") from None
        try:
            _all(handle, data)
        except BaseException:
            path.unlink(missing_ok=True)
            raise
        finally:
            os.close(handle)

    _in_one_line(path, written, remedy)


def require_inside(folder: Path, within: Path, remedy: str = ANOTHER_PLACE) -> None:
    """InputError where a link leads from a folder that was asked for to somewhere else than its own subfolder."""
    try:
        there, inside = os.path.realpath(folder), os.path.realpath(within)
    except ValueError as trouble:  # a null character in the path
        raise InputError(folder, "", f"is no path ({trouble}): correct the name") from None
    if not folder.is_relative_to(within):
        raise InputError(folder, "", f"lies outside of {within}, where nothing is written: {remedy}")
    if Path(there) != Path(inside) / folder.relative_to(within):
        raise InputError(folder, "", f"leads elsewhere by a link, through which nothing is written: remove the link, "
                         f"or {remedy}")


def make_folder(folder: Path, within: Path, remedy: str = ANOTHER_PLACE) -> None:
    """Make a folder that is another one or lies in it; InputError where it cannot be made, or a link leads out."""
    require_inside(folder, within, remedy)
    _in_one_line(folder, lambda: folder.mkdir(parents=True, exist_ok=True), remedy)


def remove_old(path: Path) -> None:
    """Remove a file that the caller knows to be the workbench's; InputError where it cannot be removed."""
    _in_one_line(path, lambda: path.unlink(missing_ok=True), "check its permissions")


def write_whole(path: Path, data: str | bytes | Iterable[bytes]) -> None:
    """Write a file, given whole or in pieces, aside and rename it, with the mode that the file had or a new one gets;
    raises OSError."""
    aside = path.parent / f".workbench-{secrets.token_hex(8)}.tmp"
    handle = os.open(aside, _NEW, 0o666)
    try:
        try:
            before = path.lstat() if path.exists() else None
            if before is not None and stat.S_ISREG(before.st_mode):
                aside.chmod(stat.S_IMODE(before.st_mode))
            for piece in (data,) if isinstance(data, str | bytes) else data:
                _all(handle, as_bytes(piece) if isinstance(piece, str) else piece)
        finally:
            os.close(handle)
        aside.replace(path)
    except BaseException:
        aside.unlink(missing_ok=True)
        raise


def _to_stream(path: Path, data: bytes) -> None:
    # Without waiting for a reader: a pipe that nobody reads would keep the command for ever.
    handle = os.open(path, os.O_WRONLY | os.O_APPEND | getattr(os, "O_NONBLOCK", 0))
    try:
        os.set_blocking(handle, True)
        _all(handle, data)
    finally:
        os.close(handle)


def _all(handle: int, data: bytes) -> None:
    rest = memoryview(data)
    while rest:
        done = os.write(handle, rest)
        if not done:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        rest = rest[done:]


def _in_one_line(path: Path, action: Callable[[], None], remedy: str) -> None:
    try:
        action()
    except FileExistsError as trouble:  # where a folder would have to be
        raise InputError(path, "", f"cannot be written ({trouble.filename} is a file): {remedy}") from None
    except OSError as trouble:
        raise InputError(path, "", f"cannot be written ({trouble.strerror}): {remedy}") from None
    except ValueError as trouble:  # a null character in the path
        raise InputError(path, "", f"is no path ({trouble}): correct the name") from None
