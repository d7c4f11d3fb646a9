"""A small paper for tests of how claims are decided: quick claims of several verdicts, one of them from a data file."""

from contextlib import contextmanager
from pathlib import Path

import pytest

from workbench.proof.document import Places, claims_document, write_certificates
from workbench.proof.engine_digest import SOURCES
from workbench.proof.prove import Proof, prove
from workbench.proof.selection import targets

TEXT = '''
from pathlib import Path

import sympy as sp

from helper import bound
from workbench.proof.claim import D, Goal, at_least, at_most, equal
from workbench.proof.paper import Paper

paper = Paper("small2020", "nobody, nowhere")
x, y = sp.symbols("x y", real=True)
stated = sp.Rational((Path(__file__).parent / "stated.txt").read_text())


@paper.claim("1", "an identity", "identity", "x", "proved")
def identity() -> Goal:
    """The note of 1."""
    return Goal((equal((x + y)**2, x**2 + 2*x*y + y**2),))


@paper.claim("2", "with the helper's bound", "inequality", "y", "proved", premises=("1",))
def helped() -> Goal:
    """The note of 2."""
    return Goal((at_least(x**2, bound),))


def nearest() -> Goal:
    return Goal((at_least(x**2, 0),))


@paper.claim("3", "a false one", "inequality", "z", "refuted", premises=("2",), correction=nearest)
def false() -> Goal:
    """The note of 3."""
    return Goal((at_least(x**2, stated),))


@paper.claim("4", "decay", "identity", r"\\dot V", "proved", premises=("3",))
def decay() -> Goal:
    """The note of 4."""
    return Goal((equal(D(x**2), -2 * x**2),), flow={x: -x})


paper.axiom("5", "a lemma", "w", "somebody's lemma", hypotheses=("4",))
'''
IDS = [f"small2020:{number}" for number in range(1, 6)]


def write_paper(folder: Path, text: str = TEXT, bound: int = -1, stated: str = "1") -> Path:
    """The paper with its helper and its data in a folder; the path of its proof file."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "helper.py").write_text(f"bound = {bound}\n", encoding="utf-8")
    (folder / "stated.txt").write_text(stated, encoding="utf-8")
    path = folder / "small2020.py"
    path.write_text(text, encoding="utf-8")
    return path


def proved(*arguments: object, jobs: int = 1, use_cache: bool = True) -> Proof:
    """What `workbench prove` decides for these arguments."""
    return prove(targets([str(a) for a in arguments]), jobs, use_cache)


def document(proof: Proof, seconds: bool = True) -> dict:
    """The document of `workbench prove --json`."""
    made = claims_document(proof.decisions, Places(Path("certificates")))
    if not seconds:
        for row in made["claims"]:
            del row["seconds"]
    return made


def certificates(proof: Proof, folder: Path) -> dict[str, bytes]:
    """The bytes of all certificates as they are written."""
    write_certificates(proof.decisions, Places(folder))
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.json")}


@contextmanager
def deciders_at_rest():
    """For tests across processes: whoever edits a decider meanwhile invalidates the cache, as it should be."""
    before = {path: path.stat().st_mtime_ns for path in SOURCES.rglob("*.*")}
    try:
        yield
    except AssertionError:
        if before != {path: path.stat().st_mtime_ns for path in SOURCES.rglob("*.*")}:
            pytest.skip("the deciders were edited meanwhile")
        raise
