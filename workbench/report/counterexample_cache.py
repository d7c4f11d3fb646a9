"""Counterexamples as they are shown, and what they say of other lines, kept in the user's cache by their certificates
and by what reads these."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

from workbench.files.cache_folder import cache_folder, drop, keep
from workbench.files.regular import contents, sha256_of
from workbench.files.writing import as_bytes
from workbench.proof import checker, names
from workbench.proof.latex import letters
from workbench.report import (
    certificate_latex,
    counterexample,
    number_style,
    premises_at_counterexample,
    side_values,
)
from workbench.report.counterexample import Counterexample, counterexample_of
from workbench.report.premises_at_counterexample import Other, kept_and_broken

READERS = (checker, names, letters, certificate_latex, number_style, side_values, counterexample,
           premises_at_counterexample)
READERS_KEPT = 4


def cached_counterexample(certificate: Mapping[str, Any]) -> Counterexample | None:
    """What breaks the goal of a certificate that shows it false, as `counterexample_of` says it."""
    if certificate.get("verdict") == "proved":
        return counterexample_of(certificate)

    def found() -> dict[str, Any] | None:
        point = counterexample_of(certificate)
        return None if point is None else asdict(point)

    return _made(_remembered(certificate, found))


def cached_kept(certificate: Mapping[str, Any], others: Mapping[str, Other]) -> tuple[list[str], list[str]]:
    """What a counterexample keeps and breaks of other lines, as `kept_and_broken` says it."""
    asked = [certificate, [[name, other.certificate, other.obeyed] for name, other in others.items()]]
    keeps, breaks = _remembered(asked, lambda: list(kept_and_broken(certificate, others)))
    return keeps, breaks


def _remembered(asked: object, made: Callable[[], Any]) -> Any:
    """Plain data that is made of other plain data, from the cache where it lies there whole."""
    folder = _folder()
    if folder is None:
        return made()
    path = folder / f"{_sha256(json.dumps(asked, sort_keys=True))}.json"
    with suppress(OSError, ValueError, KeyError, TypeError):
        seal, text, rest = contents(path, own=True).decode().split("\n")
        if seal == _sha256(text) and not rest:
            return json.loads(text)
    text = json.dumps(made())
    keep(path, f"{_sha256(text)}\n{text}\n")
    return json.loads(text)


def _made(record: dict[str, Any] | None) -> Counterexample | None:
    if record is None:
        return None
    return Counterexample(**record | {
        **{name: tuple(record[name]) for name in ("values", "given", "along", "beside")},
        "everything": tuple(map(tuple, record["everything"])),
        "put_in": None if record["put_in"] is None else tuple(record["put_in"])})


@cache
def _folder() -> Path | None:
    """The folder of what these versions of the readers say; those of older ones are dropped."""
    place = cache_folder("counterexamples")
    if place is None:
        return None
    folder = place / _sha256(" ".join(sha256_of(str(module.__file__)) for module in READERS))[:20]
    with suppress(OSError):  # another process may tidy up too
        others = sorted((path for path in place.iterdir() if path.is_dir() and path != folder),
                        key=lambda path: path.stat().st_mtime_ns)
        for old in others[:-READERS_KEPT]:
            drop(old)
    return folder


def _sha256(text: str) -> str:
    return hashlib.sha256(as_bytes(text)).hexdigest()
