"""Coq's compiler on a folder of exports: which files its kernel accepts, and on which axioms they rest."""

from __future__ import annotations

import math
import re
import resource
import signal
import subprocess
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
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
from workbench.kernel.batches import Export, batch_text, export_of, parted, planned
from workbench.kernel.export import HERE, INDEX, LIBRARY
from workbench.kernel.vernacular import strange_sentence

# The axioms of Coq's classical reals, and the machine integers and floats that interval arithmetic computes with.
OF_THE_REALS = ("ClassicalDedekindReals.", "FunctionalExtensionality.", "Classical_Prop.classic")
OF_THE_MACHINE = ("PrimInt63.", "Uint63.", "PrimFloat.", "FloatAxioms.", "Uint63Axioms.", "Sint63.")
FILE = re.compile(r"[A-Za-z0-9_]+\.v")
AXIOMS, CLOSED = "Axioms:", "Closed under the global context"  # of each theorem, what it rests on
LINE = re.compile(r'^File "[^"]*", line (\d+), ')  # where coqc stops
AXIOM = re.compile(r"^([A-Za-z_][A-Za-z0-9_.']*)\s*:", re.M)
# What the index says of every certificate, and of one that has a file.
FIELDS: dict[str, type] = {"claim": str, "goal_digest": str, "certificate": str, "motion": bool}
OF_A_FILE: dict[str, type] = {"file": str, "sha256": str}
REMEDY = "on Debian or Ubuntu: apt install coq libcoq-interval libcoq-coquelicot"


@dataclass(frozen=True)
class Checked:
    """One certificate: 'accepted', 'refused' (with what coqc says), 'not exported' (with the reason), 'left out', or
    'noted', which was accepted before."""

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
    which_are = "library {} is" if len(absent) == 1 else "libraries {} are"
    return f"Coq's {which_are.format(' and '.join(absent))} missing: {REMEDY}" if absent else None


def check_folder(folder: Path, workers: int, seconds: float,
                 on_progress: Callable[[int, int], None] = lambda done, total: None,
                 noted: Collection[tuple[str, str]] = (), only: Collection[str] | None = None) -> Iterator[Checked]:
    """Every certificate of a folder that `export-coq` wrote, as coqc finds it; InputError where Coq is missing, the
    library is not this package's, or the folder is none of exports. A file may take `seconds` of processor time.

    noted: (claim, goal digest) of what is not run again; only: the claims beside which all others are left out. Many
    files are shown to coqc in one run; where it refuses that, to smaller ones, so that a file is refused by what coqc
    says of it alone.
    """
    if (trouble := missing()) is not None:
        raise InputError("", "", trouble)
    rows = read_index(folder)["certificates"]
    for name in LIBRARY:
        if read_text(folder / name, "library") != read_text(HERE / name, "library"):
            raise InputError(str(folder / name), "", "is not this package's library: run 'workbench export-coq' again")
    # The file of a whole theorem is that of its claim: one run answers for both.
    files = dict.fromkeys((row["file"], row["sha256"]) for row in rows
                          if "file" in row and (row["claim"], row["goal_digest"]) not in noted
                          and (only is None or row["claim"] in only))
    # Elsewhere, because Coq would take a compiled module, or a program, that lies beside a file for one of its own.
    with scratch_folder() as place:
        compile_library(place, seconds)
        with ThreadPoolExecutor(workers) as pool:
            looks = _looked(folder, files)
            exports = [look for look in looks.values() if isinstance(look, Export)]
            troubles: dict[Export, Future[dict[Export, str]]] = {}
            for number, batch in enumerate(planned(exports, workers, seconds)):
                # No export's name has the sign ', so that none is overwritten.
                found = pool.submit(_troubles, place, batch, f"Batch'{number}", seconds)
                troubles |= dict.fromkeys(batch, found)

            def trouble_of(file: tuple[str, str]) -> str | None:
                look = looks.get(file)
                return troubles[look].result()[look] if isinstance(look, Export) else look

            for done, row in enumerate(rows):
                on_progress(done, len(rows))
                yield _checked(row, trouble_of, only is None or row["claim"] in only)
    on_progress(len(rows), len(rows))


def compile_library(place: Path, seconds: float) -> None:
    """This package's library in a folder, compiled; InputError where coqc refuses it."""
    for name in LIBRARY:
        write_text(place / name, read_text(HERE / name, "library"))
        if trouble := _coqc(place, name, seconds).trouble:
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


def _checked(row: dict[str, Any], trouble_of: Callable[[tuple[str, str]], str | None], is_asked: bool) -> Checked:
    """What became of a row of the index, given what is wrong with a file, None of one that was not run."""
    known = {"claim": row["claim"], "goal_digest": row["goal_digest"], "certificate": row["certificate"],
             "motion": row["motion"]}
    if "not_exported" in row:
        return Checked(outcome="not exported", reason=row["not_exported"], **known)
    if not is_asked:
        return Checked(outcome="left out", **known)
    trouble = trouble_of((row["file"], row["sha256"]))
    if trouble is None:
        return Checked(outcome="noted", text=row["sha256"], **known)
    return Checked(outcome="refused" if trouble else "accepted", reason=trouble, text=row["sha256"], **known)


def _looked(folder: Path, files: Iterable[tuple[str, str]]) -> dict[tuple[str, str], Export | str]:
    """By file name and digest what coqc is to be shown, or why it is not."""
    return {file: _look(folder, *file) for file in files}


def _look(folder: Path, name: str, digest: str) -> Export | str:
    """A file as coqc is to be shown it, or why it is not."""
    if not FILE.fullmatch(name) or name in LIBRARY or sha256(text := read_text(folder / name, "Coq file")) != digest:
        return "the file is not the one that was exported"
    if (sentence := strange_sentence(text)) is not None:
        return f"holds what no export does: {sentence}"
    return export_of(name, text)


def _troubles(place: Path, batch: tuple[Export, ...], name: str, seconds: float) -> dict[Export, str]:
    """Why each file is refused, empty where it is not; name: of the file, without its suffix, that holds them all."""
    if len(batch) == 1:
        return {batch[0]: _text_trouble(place, batch[0].name, batch[0].text, len(batch[0].printed), seconds)[0]}
    trouble, line = _text_trouble(place, f"{name}.v", batch_text(batch), 1, seconds)
    if not trouble:
        return dict.fromkeys(batch, "")
    return {export: why for number, part in enumerate(parted(batch, line))
            for export, why in _troubles(place, part, f"{name}'{number}", seconds).items()}


def _text_trouble(place: Path, name: str, text: str, questions: int, seconds: float) -> tuple[str, int | None]:
    """Why a text is refused, empty where Coq, in the place of the compiled library, accepts it on the axioms of the
    reals, and the line that it stops at; questions: how often the text asks what its theorems rest on."""
    write_text(place / name, text)
    ran = _coqc(place, name, seconds)
    if ran.trouble:
        return ran.trouble, ran.line
    strange = [axiom for axiom in axioms_in(ran.said) if not axiom.startswith(OF_THE_REALS + OF_THE_MACHINE)]
    if strange:
        return f"rests on {', '.join(strange)}", None
    if not questions or ran.said.count(AXIOMS) + ran.said.count(CLOSED) != questions:
        return "says not what it rests on", None
    return "", None


def axioms_in(said: str) -> list[str]:
    """The axioms that `Print Assumptions` names."""
    found: list[str] = []
    for block in said.split(AXIOMS)[1:]:
        found += AXIOM.findall(block)
    return found


@dataclass(frozen=True)
class Ran:
    """What coqc says of a file; its trouble, empty where it accepts; the line that it stops at, where it names one."""

    said: str
    trouble: str = ""
    line: int | None = None


def _coqc(folder: Path, name: str, seconds: float) -> Ran:
    """A file as coqc takes it in `seconds` of processor time."""
    # Of the processor's time, since the clock's depends on what else the machine does. No limit can be raised.
    most = resource.getrlimit(resource.RLIMIT_CPU)[1]
    seconds = seconds if most == resource.RLIM_INFINITY else min(seconds, most)
    command = ["sh", "-c", 'ulimit -t "$0" && exec coqc -q -R . "" "$1"', str(math.ceil(seconds)), name]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if run.returncode == 0:
        return Ran(run.stdout)
    if run.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return Ran(run.stdout, f"takes more than {seconds:g} s")
    where, _, why = run.stderr.partition("Error:")
    said = " ".join(line.strip() for line in (why or where).split("\n") if line.strip())[:300]
    stops = [int(found[1]) for found in map(LINE.match, where.splitlines()) if found]
    return Ran(run.stdout, said or f"coqc ends with {run.returncode} and says nothing", stops[-1] if stops else None)
