"""The text of a file that a user names; whatever is wrong with it becomes one line naming the file."""

from __future__ import annotations

from pathlib import Path

from workbench.errors import InputError

_read: set[Path] = set()


def inputs_read() -> frozenset[Path]:
    """The files that this process has read as its inputs."""
    return frozenset(_read)


def read_text(path: Path, kind: str) -> str:
    """A file's text, UTF-8 with or without a mark; kind: what it should hold, as 'TOML'. Raises InputError."""
    _read.add(path.absolute())
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError(path, "", "no such file: check the path") from None
    except IsADirectoryError:
        raise InputError(path, "", f"is a folder: name a .{kind.lower()} file in it") from None
    except UnicodeDecodeError:
        raise InputError(path, "", f"is not UTF-8 text: save it as UTF-8 {kind}") from None
    except OSError as trouble:
        raise InputError(path, "", f"cannot be read ({trouble.strerror}): check its permissions") from None
    except ValueError as trouble:  # a null character in the path
        raise InputError(path, "", f"is no path ({trouble}): correct the name") from None
