"""Which goals Coq's kernel has accepted, as `check-coq --record` notes it in a paper's folder.

The note is nobody's proof: it says what was seen, and `workbench check-coq` sees it again. So nothing but the word for
a verdict's trust is taken from it, and only for a goal that is decided with a certificate of its own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from workbench.errors import InputError
from workbench.files.text import read_text
from workbench.files.writing import write_text
from workbench.proof.checker import DIGEST, goal_digest
from workbench.proof.verdict import Decision, is_equation

RECORD = "kernel.txt"  # no JSON: every JSON file beside certificates is taken for one
FIRST = "accepted by Coq "


def record_path(path: Path) -> Path:
    """Where the record of a paper's folder lies, that of a single proof file beside it."""
    return path / RECORD if path.is_dir() else path.with_suffix(f".{RECORD}")


def write_record(path: Path, coq: str, accepted: Mapping[str, str]) -> None:
    """Note by equation the digests of the goals that this version of Coq has accepted. Raises InputError where it
    cannot be written."""
    lines = [f"{FIRST}{coq}", *(f"{digest} {name}" for name, digest in sorted(accepted.items()))]
    write_text(record_path(path), "\n".join(lines) + "\n")


def read_record(path: Path) -> dict[str, str]:
    """By equation the digests of the goals that were accepted, empty where none was noted; InputError where what lies
    there is no record."""
    place = record_path(path)
    if not place.exists():
        return {}
    first, *lines = read_text(place, "record").splitlines() or [""]
    rows = [line.partition(" ") for line in lines]
    if not first.startswith(FIRST) or not all(DIGEST.fullmatch(digest) and is_equation(name)
                                              for digest, _, name in rows):
        raise InputError(place, "", "is no record of what Coq has accepted: run 'workbench check-coq FOLDER --record "
                         f"{path}' again, or remove it")
    return {name: digest for digest, _, name in rows}


def recorded_version(path: Path) -> str:
    """The version of Coq that a paper's record names, empty where there is no record."""
    place = record_path(path)
    return read_text(place, "record").partition("\n")[0].removeprefix(FIRST) if place.exists() else ""


def with_kernel(decisions: Sequence[Decision], records: Mapping[str, Mapping[str, str]]) -> list[Decision]:
    """The decisions, their trust `kernel` where Coq's kernel has accepted the goal; records: by the papers' names."""
    return [replace(d, trust="kernel") if d.certificate and records.get(d.claim.paper, {}).get(
        d.claim.equation) == goal_digest(d.certificate) else d for d in decisions]
