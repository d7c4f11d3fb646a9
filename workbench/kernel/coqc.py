"""Coq's compiler on a folder of exports: which files its kernel accepts, and on which axioms they rest."""

from __future__ import annotations

import re
import resource
import subprocess
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from shutil import which
from typing import Any

from workbench.errors import InputError
from workbench.files.json_input import read_json
from workbench.files.own_files import sha256
from workbench.files.scratch import scratch_folder
from workbench.files.text import read_text
from workbench.files.writing import write_text
from workbench.kernel.export import HERE, INDEX, LIBRARY
from workbench.kernel.vernacular import strange_sentence

# The axioms of Coq's classical reals, and the machine integers and floats that interval arithmetic computes with.
OF_THE_REALS = ("ClassicalDedekindReals.", "FunctionalExtensionality.", "Classical_Prop.classic")
OF_THE_MACHINE = ("PrimInt63.", "Uint63.", "PrimFloat.", "FloatAxioms.", "Uint63Axioms.", "Sint63.")
FILE = re.compile(r"[A-Za-z0-9_]+\.v")
AXIOM = re.compile(r"^([A-Za-z_][A-Za-z0-9_.']*)\s*:", re.M)
# What the index says of every certificate, and of one that has a file.
FIELDS: dict[str, type] = {"claim": str, "goal_digest": str, "certificate": str, "motion": bool}
OF_A_FILE: dict[str, type] = {"file": str, "sha256": str}
REMEDY = "on Debian or Ubuntu: apt install coq libcoq-interval libcoq-coquelicot"


@dataclass(frozen=True)
class Checked:
    """One certificate: 'accepted', 'refused' (with what coqc says) or 'not exported' (with the reason)."""

    claim: str
    outcome: str
    reason: str = ""
    goal_digest: str = ""
    certificate: str = ""
    motion: bool = False
    text: str = ""  # the sha256 of its Coq file


def version() -> str:
    """The version of coqc."""
    return subprocess.run(["coqc", "--print-version"], capture_output=True, text=True, check=True).stdout.split()[0]


def missing() -> str | None:
    """What is not installed, with the remedy; None where coqc and its libraries are there."""
    found = which("coqc")
    if found is None:
        return f"coqc is missing: {REMEDY}"
    where = subprocess.run([found, "-where"], capture_output=True, text=True, check=False).stdout.strip()
    absent = [name for name in ("Coquelicot", "Interval") if not (Path(where) / "user-contrib" / name).is_dir()]
    return f"Coq's library {' and '.join(absent)} is missing: {REMEDY}" if absent else None


def check_folder(folder: Path, workers: int, seconds: float,
                 on_progress: Callable[[int, int], None] = lambda done, total: None) -> Iterator[Checked]:
    """Every certificate of a folder that `export-coq` wrote, as coqc finds it; InputError where Coq is missing, the
    library is not this package's, or the folder is none of exports. A file may take `seconds`."""
    if (trouble := missing()) is not None:
        raise InputError("", "", trouble)
    rows = read_index(folder)["certificates"]
    for name in LIBRARY:
        if read_text(folder / name, "library") != read_text(HERE / name, "library"):
            raise InputError(str(folder / name), "", "is not this package's library: run 'workbench export-coq' again")
    # The file of a whole theorem is that of its claim: one run answers for both.
    files = dict.fromkeys((row["file"], row["sha256"]) for row in rows if "file" in row)
    # Elsewhere, because Coq would take a compiled module, or a program, that lies beside a file for one of its own.
    with scratch_folder() as place:
        compile_library(place, seconds)
        with ThreadPoolExecutor(workers) as pool:
            troubles = {file: pool.submit(_trouble, folder, place, *file, seconds) for file in files}
            for done, row in enumerate(rows):
                on_progress(done, len(rows))
                yield _checked(row, lambda file: troubles[file].result())
    on_progress(len(rows), len(rows))


def compile_library(place: Path, seconds: float) -> None:
    """This package's library in a folder, compiled; InputError where coqc refuses it."""
    for name in LIBRARY:
        write_text(place / name, read_text(HERE / name, "library"))
        if trouble := _coqc(place, name, seconds)[1]:
            raise InputError(HERE / name, "", f"coqc refuses the library: {trouble}")


def read_index(folder: Path) -> dict[str, Any]:
    """The index of a folder of exports; InputError where it is none."""
    index = read_json(folder / INDEX)
    if index.get("version") != 1 or not isinstance(index.get("certificates"), list):
        raise InputError(str(folder / INDEX), "", "is no index of exports: run 'workbench export-coq' first")
    for number, row in enumerate(index["certificates"]):
        said = FIELDS | ({"not_exported": str} if isinstance(row, dict) and "not_exported" in row else OF_A_FILE)
        wrong = [key for key, kind in said.items() if not (isinstance(row, dict) and isinstance(row.get(key), kind))]
        if wrong:
            raise InputError(str(folder / INDEX), f"certificates[{number}].{wrong[0]}", "is missing or no such value: "
                             "run 'workbench export-coq' again")
    return index


def cpu_seconds() -> float:
    """The time that coqc has taken so far in all, user and system."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def _checked(row: dict[str, Any], trouble_of: Callable[[tuple[str, str]], str]) -> Checked:
    """What became of a row of the index, given what is wrong with a file."""
    known = {"claim": row["claim"], "goal_digest": row["goal_digest"], "certificate": row["certificate"],
             "motion": row["motion"]}
    if "not_exported" in row:
        return Checked(outcome="not exported", reason=row["not_exported"], **known)
    trouble = trouble_of((row["file"], row["sha256"]))
    return Checked(outcome="refused" if trouble else "accepted", reason=trouble, text=row["sha256"], **known)


def _trouble(folder: Path, place: Path, name: str, digest: str, seconds: float) -> str:
    """Why a file is refused; empty where Coq, in the place of the compiled library, accepts it on the axioms of the
    reals."""
    if not FILE.fullmatch(name) or name in LIBRARY or sha256(text := read_text(folder / name, "Coq file")) != digest:
        return "the file is not the one that was exported"
    if (sentence := strange_sentence(text)) is not None:
        return f"holds what no export does: {sentence}"
    write_text(place / name, text)
    said, trouble = _coqc(place, name, seconds)
    if trouble:
        return trouble
    strange = [axiom for axiom in axioms_in(said) if not axiom.startswith(OF_THE_REALS + OF_THE_MACHINE)]
    if strange:
        return f"rests on {', '.join(strange)}"
    theorems = text.count("\nPrint Assumptions ")
    if not theorems or said.count("Axioms:") + said.count("Closed under the global context") != theorems:
        return "says not what it rests on"
    return ""


def axioms_in(said: str) -> list[str]:
    """The axioms that `Print Assumptions` names."""
    found: list[str] = []
    for block in said.split("Axioms:")[1:]:
        found += AXIOM.findall(block)
    return found


def _coqc(folder: Path, name: str, seconds: float) -> tuple[str, str]:
    """What coqc says of a file, and its trouble, empty where it accepts."""
    command = ["coqc", "-q", "-R", ".", "", name]
    try:
        run = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return "", f"takes more than {seconds:g} s"
    if run.returncode == 0:
        return run.stdout, ""
    lines = run.stderr.partition("Error:")[2].split("\n")
    said = " ".join(line.strip() for line in lines if line.strip())[:300]
    return run.stdout, said or f"coqc ends with {run.returncode}"
