"""Counterexamples as they are shown, kept in the user's cache by their certificates and by what reads these."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
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
from workbench.report import certificate_latex, counterexample, number_style
from workbench.report.counterexample import Counterexample, counterexample_of

READERS = (checker, names, letters, certificate_latex, number_style, counterexample)
READERS_KEPT = 4


def cached_counterexample(certificate: Mapping[str, Any]) -> Counterexample | None:
    """What breaks the goal of a certificate that shows it false, as `counterexample_of` says it."""
    folder = _folder()
    if folder is None or certificate.get("verdict") == "proved":
        return counterexample_of(certificate)
    path = folder / f"{_sha256(json.dumps(certificate, sort_keys=True))}.json"
    with suppress(OSError, ValueError, KeyError, TypeError):
        seal, text, rest = contents(path, own=True).decode().split("\n")
        if seal == _sha256(text) and not rest:
            return _made(json.loads(text))
    found = counterexample_of(certificate)
    text = json.dumps(None if found is None else asdict(found))
    keep(path, f"{_sha256(text)}\n{text}\n")
    return found


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
