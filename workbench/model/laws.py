"""Laws by their names: `pid`, `<paper>.<law>` of a paper's folder, `FILE.py::name`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from workbench.errors import InputError
from workbench.files.folders import held_in, is_paper, paper_named, papers_near
from workbench.files.modules import module_in
from workbench.model.cascaded_pid import cascaded_pid
from workbench.model.law import ControlLaw
from workbench.model.pid import pid

# By what makes them: few commands ask for the second, whose expressions take sympy as long as reading a scenario.
GENERAL: dict[str, Callable[[], ControlLaw]] = {"pid": lambda: pid, "cascaded_pid": cascaded_pid}

T = TypeVar("T")

# Modules are imported once in a process, so what they hold is found once.
_found: dict[tuple[str, Path, str, type], Any] = {}


def law_named(name: str, near: Path) -> ControlLaw | None:
    """The law of that name as a file in the folder `near` means it; None where there is none.

    `<paper>.<law>` is looked up in the folder itself, then as `paper_named` finds the paper; `FILE.py::name` relative
    to the folder. Raises InputError where a module cannot be imported, or a named file holds no such law; one without
    a place, which is the caller's to tell, where there is no such file.
    """
    make = GENERAL.get(name)
    return make() if make else named(name, near, "laws", ControlLaw)


def laws_near(near: Path) -> list[str]:
    """The names that `law_named` knows, for a message."""
    return [*GENERAL, *names_near(near, "laws", ControlLaw)]


def named(name: str, near: Path, module: str, kind: type[T]) -> T | None:
    """What a file in the folder `near` means by a name: an object of a kind in that module of a paper's folder."""
    key = name, near.resolve(), module, kind
    if key not in _found:
        _found[key] = _named(name, near.resolve(), module, kind)
    found: T | None = _found[key]
    return found


def _named(name: str, near: Path, module: str, kind: type[T]) -> T | None:
    file, separator, own = name.partition("::")
    if separator:
        return _in_file(near / file, own, kind, name)
    if is_paper(near):
        found = _of_folder(near, name, module, kind)
        if found is not None:
            return found
    paper, dot, _ = name.partition(".")
    folder = paper_named(paper, near) if dot else None
    return _of_folder(folder, name, module, kind) if folder else None


def _of_folder(folder: Path, name: str, module: str, kind: type[T]) -> T | None:
    """By the whole name, or by what follows the folder's own name: a copied folder keeps the names of its laws."""
    held = held_in(folder, module, kind)
    if name in held:
        return held[name]
    paper, _, own = name.rpartition(".")
    if paper not in ("", folder.name):
        return None
    return next((one for key, one in held.items() if key.rpartition(".")[2] == own), None)


def _in_file(path: Path, own: str, kind: type[T], name: str) -> T:
    if path.suffix != ".py" or not path.is_file():
        raise InputError("", "", f"'{name}' names {path}, and there is no such Python file: correct the path, which is "
                         "relative to the file that names it")
    if not path.stem.isidentifier():
        raise InputError(path, "", "cannot be imported: name the file with letters, digits and underscores")
    found = getattr(module_in(path.parent, path.stem), own, None) if own.isidentifier() else None
    if not isinstance(found, kind):
        raise InputError(path, own, f"is no {kind.__name__} of this file: define it at its top level")
    return found


def names_near(near: Path, module: str, kind: type[T]) -> list[str]:
    """Names of all objects of a kind in that module of the paper folders near a folder; a folder with a mistake in it
    has none."""
    names: list[str] = []
    for folder in papers_near(near):
        try:
            names += held_in(folder, module, kind)
        except InputError:
            continue
    return list(dict.fromkeys(names))
