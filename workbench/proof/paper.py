"""How a proof file states its claims, and how they are collected from a path."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from types import ModuleType

import sympy as sp

from workbench.errors import ClaimError, InputError
from workbench.proof.claim import Claim, Goal, Kind, Verdict

Builder = Callable[[], Goal]


class Paper:
    """The claims of one paper, in the order in which its proof file states them."""

    def __init__(self, name: str, citation: str) -> None:
        self.name, self.citation = name, citation
        self.claims: list[Claim] = []

    def claim(self, equation: str, title: str, kind: Kind, statement: str, recorded: Verdict, *,
              premises: tuple[str, ...] = (), scope: str = "all values of the domain",
              at: dict[sp.Expr, Fraction] | None = None, correction: Builder | None = None,
              corrected_statement: str | None = None, repair: dict[sp.Expr, Fraction] | None = None,
              note: str = "") -> Callable[[Builder], Builder]:
        """State a claim; the decorated function returns its goal. Premises are equations of this paper."""

        def collect(build: Builder) -> Builder:
            self.claims.append(Claim(
                id=self._id(equation), title=title, kind=kind, statement=statement, recorded=recorded, build=build,
                premises=tuple(self._id(p) for p in premises), scope=scope, at=at, correction=correction,
                corrected_statement=corrected_statement, repair=repair, note=note or (build.__doc__ or "").strip(),
            ))
            return build

        return collect

    def axiom(self, equation: str, title: str, statement: str, source: str, *, hypotheses: tuple[str, ...],
              note: str = "") -> None:
        """State a result cited from the literature; its hypotheses are claims of their own."""
        self.claims.append(Claim(
            id=self._id(equation), title=title, kind="implication", statement=statement, recorded="assumed",
            build=None, axiom=source, premises=tuple(self._id(h) for h in hypotheses), note=note))

    def _id(self, equation: str) -> str:
        return equation if ":" in equation else f"{self.name}:{equation}"


def collect_papers(paths: list[Path]) -> list[Paper]:
    """The papers stated in proof files; a folder stands for all .py files in it.

    Raises InputError when a path has no proof file or one cannot be imported.
    """
    files: list[Path] = []
    for path in paths:
        if path.is_dir():
            files += sorted(p for p in path.glob("*.py") if not p.name.startswith("_"))
        elif path.suffix == ".py" and path.exists():
            files.append(path)
        else:
            raise InputError(path, "", "no such proof file: name a .py file or a folder of them")
    if not files:
        raise InputError(paths[0] if paths else "proofs", "", "holds no proof file: name a .py file")
    papers = [paper for file in files for paper in _papers_in(file)]
    if not papers:
        raise InputError(files[0], "", "states no Paper: create one with workbench.proof.paper.Paper")
    return papers


def _papers_in(file: Path) -> list[Paper]:
    try:
        module = _import(file)
    except ClaimError as trouble:
        raise InputError(file, "", str(trouble)) from None
    except (Exception, SystemExit) as trouble:  # a file that exits would end the run before anything is decided
        raise InputError(file, "", f"cannot be imported: {type(trouble).__name__}: {trouble}") from trouble
    return [value for value in vars(module).values() if isinstance(value, Paper)]


def _import(file: Path) -> ModuleType:
    name = f"workbench_proofs_{file.stem}"
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise InputError(file, "", "cannot be imported: is it a Python file?")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
