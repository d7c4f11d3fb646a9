"""How a proof file states its claims, and how they are collected from a path."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import sympy as sp

from workbench.errors import ClaimError, InputError
from workbench.proof.claim import Claim, Goal, Kind, Verdict
from workbench.proof.loading import ProofFile
from workbench.proof.selection import NO_PAPER, files_of, targets

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
        ids = self._ids(equation, premises)

        def collect(build: Builder) -> Builder:
            self.claims.append(Claim(
                id=self._id(equation), title=title, kind=kind, statement=statement, recorded=recorded, build=build,
                premises=ids, scope=scope, at=at, correction=correction,
                corrected_statement=corrected_statement, repair=repair, note=note or (build.__doc__ or "").strip(),
            ))
            return build

        return collect

    def axiom(self, equation: str, title: str, statement: str, source: str, *, hypotheses: tuple[str, ...],
              note: str = "") -> None:
        """State a result cited from the literature; its hypotheses are claims of their own."""
        self.claims.append(Claim(
            id=self._id(equation), title=title, kind="implication", statement=statement, recorded="assumed",
            build=None, axiom=source, premises=self._ids(equation, hypotheses), note=note))

    def _ids(self, equation: str, premises: tuple[str, ...] | str) -> tuple[str, ...]:
        if isinstance(premises, str):
            raise ClaimError(f"claim {self._id(equation)}: premises are a tuple of numbers: write ('{premises}',)")
        return tuple(self._id(premise) for premise in premises)

    def _id(self, equation: str) -> str:
        return equation if ":" in equation else f"{self.name}:{equation}"


def collect_papers(paths: list[Path]) -> list[Paper]:
    """The papers stated in proof files; a folder stands for all .py files in it.

    Raises InputError when a path has no proof file or one cannot be imported.
    """
    files = files_of(targets(paths))
    papers = [paper for file in files for paper in papers_in(ProofFile(file))]
    if not papers:
        raise InputError(files[0], "", NO_PAPER)
    return papers


def papers_in(file: ProofFile) -> list[Paper]:
    """The papers that a proof file states; raises InputError when it cannot be imported."""
    stated = {id(value): value for module in file.modules() for value in vars(module).values()
              if isinstance(value, Paper)}
    return list(stated.values())
