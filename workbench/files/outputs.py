"""What is written: checked before anything runs, and never over what was read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from workbench.errors import InputError
from workbench.files.text import inputs_read


def check_outputs(outputs: Mapping[str, Path | None], inputs: Iterable[Path] = ()) -> None:
    """InputError, naming the option, for an output that is an input, another output, or a folder.

    inputs: beside all files that have been read so far.
    """
    taken = {path.resolve(): f"is an input ({path})" for path in (*inputs_read(), *inputs)}
    for option, path in outputs.items():
        if path is None:
            continue
        resolved = path.resolve()
        if resolved in taken:
            raise InputError(path, option, f"{taken[resolved]}: it would be overwritten, name another file")
        if path.is_dir():
            raise InputError(path, option, "is a folder: name a file")
        taken[resolved] = f"is what {option} writes too"
