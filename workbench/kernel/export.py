"""Certificates as Coq files: one a certificate, the library beside them, an index of what was exported and what not."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.own_files import sha256
from workbench.files.text import read_text
from workbench.kernel import points, proved, theorem
from workbench.kernel.syntax import NotExportedError
from workbench.proof.checker import CertificateError, check

LIBRARY = ("Workbench.v", "WorkbenchFlow.v", "WorkbenchFractions.v")
INDEX = "index.json"
OPENING = "Open Scope R_scope.\n\n"
HERE = Path(__file__).resolve().parent
IMPORTS = {  # in this order: what is loaded last changes a tactic of what is loaded before it
    "WorkbenchFlow": "From Coquelicot Require Import Coquelicot.\nRequire Import WorkbenchFlow.\n",
    "Interval": "From Interval Require Import Tactic.\n",
    "Workbench": "Require Import Workbench.\n",
    "WorkbenchFractions": "Require Import WorkbenchFractions.\n",
}
WRITE_AGAIN = "write it again with 'workbench prove --write'"
LONG_FRACTION = re.compile(r"/ \d{12}")  # from here on rational coefficients cost less than whole ones
UNLIKE_A_NAME = re.compile(r"[^A-Za-z0-9_]")


@dataclass(frozen=True)
class Exported:
    """What became of one certificate: its Coq file's text, or the reason why it has none."""

    claim: str
    verdict: str
    goal_digest: str
    certificate: str  # its sha256
    motion: bool  # whether it speaks of a motion through time
    text: str | None
    reason: str | None = None

    @property
    def file(self) -> str:
        """The name of its Coq file; the digest keeps two claims apart whose names differ in signs alone."""
        name = UNLIKE_A_NAME.sub("_", self.claim)
        return f"{name}_{sha256(self.claim)[:6]}.v"


def export(certificate: dict[str, Any], digest: str = "") -> Exported:
    """One certificate, which the checker must accept; CertificateError where it does not.

    What it rests on besides its proof or point, a correction or a repair, is exported with it or not at all.
    """
    check(certificate)
    of_time = ("initial", "always", "eventually")
    motion = any(part["goal"].get(key) for part in _parts(certificate).values() for key in of_time)
    text, reason = None, None
    try:
        text = document(certificate)
    except NotExportedError as trouble:
        reason = str(trouble)
    except CertificateError as trouble:
        reason = f"the export asks what the checker refuses: {trouble}"
    return Exported(str(certificate["claim"]), certificate["verdict"], str(certificate.get("goal_digest", "")), digest,
                    motion, text, reason)


def _parts(certificate: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """What a certificate establishes, by its theorem's name: the claim, and a correction or repair where it has one."""
    others: dict[str, dict[str, Any]] = {
        name: certificate[name] for name in ("correction", "repair") if name in certificate}
    return {"claim": certificate, **others}


def document(certificate: dict[str, Any]) -> str:
    """The Coq file of a certificate, which need not hold: then Coq refuses it. NotExportedError where it has none."""
    libraries: set[str] = set()
    theorems = []
    for name, part in _parts(certificate).items():
        goal = theorem.read(part["goal"])
        if name == "claim" and certificate["verdict"] != "proved":
            statement, script = points.statement_of(goal), points.proof_at_point(goal, certificate)
        else:
            statement, script = goal.statement(), proved.proof_of(goal, part)
        libraries |= script.libraries | ({"WorkbenchFlow"} if goal.kind != "static" else set())
        lines = "\n".join(script.lines)
        if LONG_FRACTION.search(lines):
            libraries.add("WorkbenchFractions")
        theorems.append(f"{_comment(part['goal'])}Definition {name}_states : Prop :=\n  {statement}.\n\n"
                        f"Theorem {name}_holds : {name}_states.\nProof.\nunfold {name}_states.\n{lines}\nQed.\n"
                        f"Print Assumptions {name}_holds.\n")
    head = (f"(* {_harmless(str(certificate['claim']))}: {certificate['verdict']}\n   goal digest "
            f"{_harmless(str(certificate.get('goal_digest')))} *)\n"
            "Require Import Reals Lra.\n")
    imports = "".join(text for name, text in IMPORTS.items() if name in libraries | {"Workbench"})
    return head + imports + OPENING + "\n".join(theorems)


def _comment(goal: dict[str, Any]) -> str:
    return f"(* {_harmless(json.dumps(goal, sort_keys=True))} *)\n"


def _harmless(text: str) -> str:
    """A text that ends no comment, begins none, and opens no string in it."""
    return text.replace("(*", "( *").replace("*)", "* )").replace('"', "'")


def export_folder(folder: Path) -> Iterator[Exported]:
    """All certificates below a folder, in the order of their names; InputError for one that does not hold."""
    for path in sorted(path for path in folder.rglob("*.json") if path.name != "manifest.json"):
        text = read_text(path, "certificate")
        try:
            certificate = json.loads(text)
        except (ValueError, RecursionError) as trouble:
            raise InputError(path, "", f"is no certificate ({trouble}): {WRITE_AGAIN}") from None
        try:
            yield export(certificate, sha256(text))
        except CertificateError as trouble:
            raise InputError(path, "", f"does not hold ({trouble}): {WRITE_AGAIN}") from None


def files_of(exported: list[Exported]) -> dict[str, str]:
    """The files of a folder of exports by name: the library, a file a certificate, the index."""
    files = {name: read_text(HERE / name, "library") for name in LIBRARY}
    rows = []
    for one in exported:
        row: dict[str, Any] = {"claim": one.claim, "verdict": one.verdict, "goal_digest": one.goal_digest,
                               "certificate": one.certificate, "motion": one.motion}
        if one.text is None:
            rows.append({**row, "not_exported": one.reason})
        else:
            files[one.file] = one.text
            rows.append({**row, "file": one.file, "sha256": sha256(one.text)})
    index = {"version": 1, "library": {name: sha256(files[name]) for name in LIBRARY}, "certificates": rows}
    files[INDEX] = json.dumps(index, indent=1, ensure_ascii=False) + "\n"
    return files
