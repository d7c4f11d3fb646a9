"""How a proof file states its claims, and how they are collected from a path."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from pathlib import Path

import sympy as sp

from workbench.errors import ClaimError, InputError
from workbench.proof.building import built, take
from workbench.proof.claim import Claim, Goal, Kind, Relation, Verdict
from workbench.proof.lemmas.lemma import Lemma
from workbench.proof.loading import ProofFile
from workbench.proof.places import named_section
from workbench.proof.selection import NO_PAPER, files_of, targets
from workbench.proof.verdict import Match, Origin, Severity

Builder = Callable[[], Goal]
_SECTION = re.compile(r"section_(\d+)(?:_(\d+)|[a-z])?(?=_|$)")


class Paper:
    """The claims of one paper, in the order in which its proof file states them.

    notation: what the letters of its printed lines stand for, LaTeX to expression; letters: what letters that are not
    the paper's stand for, names of symbols to a few words, in which formulas may stand between dollar signs; at_hand:
    whether its lines stand as its own text has them, not as its result is commonly stated.
    """

    def __init__(self, name: str, citation: str, notation: Mapping[str, sp.Expr] | None = None,
                 letters: Mapping[str, str] | None = None, at_hand: bool = True) -> None:
        self.at_hand = at_hand
        self.name, self.citation, self.notation = name, citation, dict(notation or {})
        self.letters = dict(letters or {})
        self.claims: list[Claim] = []

    def claim(self, equation: str, title: str, kind: Kind, printed: str, recorded: Verdict, *,
              premises: tuple[str, ...] = (), rests_on: tuple[str, ...] | None = None, origin: Origin = "printed",
              severity: Severity | None = None, match: Match = "read", reading: str = "",
              glyph: str | None = None, mends: str | None = None, closed_loop: bool = False,
              where: Mapping[str, sp.Expr] | None = None, scope: str = "all values of the domain",
              at: dict[sp.Expr, Fraction] | None = None, correction: Builder | None = None,
              corrected_statement: str | None = None, repair: dict[sp.Expr, Fraction] | None = None,
              note: str = "", section: str = "") -> Callable[[Builder], Builder]:
        """State a claim; the decorated function returns its goal. Claims it names are equations of this paper.

        printed: the line as the paper has it; premises: what our proof uses; rests_on: what the paper's text uses,
        where that differs; origin, severity, match, reading, glyph, mends: see `Stated`; closed_loop: see `Claim`;
        where: letters of this line besides the paper's notation; section: where the line stands, unless its file says.
        """
        ids = self._ids(equation, premises, "premises")
        chain = None if rests_on is None else self._ids(equation, rests_on, "rests_on")

        def collect(build: Builder) -> Builder:
            self.claims.append(Claim(
                id=self._id(equation), title=title, kind=kind, printed=printed, recorded=recorded, build=build,
                premises=ids, rests_on=chain, origin=origin, severity=severity, match=match, reading=reading,
                glyph=glyph and self._id(glyph), mends=mends and self._id(mends), closed_loop=closed_loop,
                notation={**self.notation, **(where or {})}, scope=scope, at=at, correction=correction,
                corrected_statement=corrected_statement, repair=repair, note=note or (build.__doc__ or "").strip(),
                section=section or named_section(equation) or section_of(build.__module__), letters=self.letters,
            ))
            return build

        return collect

    def definition(self, equation: str, title: str, printed: str, *, reading: str = "", note: str = "") -> None:
        """State a line that gives something its name, of which nothing can be true or false."""
        self.axiom(equation, title, printed, "definition of the paper", hypotheses=(), severity="cosmetic",
                   reading=reading, note=note)

    def shown(self, equation: str) -> tuple[Relation, ...]:
        """What an earlier claim's goal shows, for the assumptions of a claim that has it among its premises.

        Raises ClaimError where there is none; a claim that takes it and does not name it is refused when it is built.
        """
        found = next((claim for claim in self.claims if claim.id == self._id(equation)), None)
        if found is None or found.build is None:
            raise ClaimError(f"claim {self._id(equation)}: has no goal that another one could use: state it first")
        shown = built(found, found.build).show
        take(found.id)
        return shown

    def axiom(self, equation: str, title: str, printed: str, source: str, *, hypotheses: tuple[str, ...],
              origin: Origin = "printed", severity: Severity = "step", match: Match = "read", reading: str = "",
              note: str = "") -> None:
        """State a result cited from the literature; its hypotheses are claims of their own."""
        self.claims.append(Claim(
            id=self._id(equation), title=title, kind="implication", printed=printed, recorded="assumed", build=None,
            axiom=source, premises=self._ids(equation, hypotheses, "hypotheses"), origin=origin, severity=severity,
            match=match, reading=reading, note=note))

    def lemma(self, equation: str, title: str, printed: str, lemma: Lemma, *,
              recorded: Mapping[str, Verdict] | None = None, rests_on: tuple[str, ...] = (), origin: Origin = "printed",
              severity: Severity = "step", match: Match = "read", note: str = "") -> None:
        """State a conclusion that the paper draws by a named lemma: each hypothesis is a claim `equation.name` that is
        decided, and the conclusion is assumed by the lemma's name, on these.

        recorded: verdicts of hypotheses that are not `proved`, by their names; rests_on: what else the text uses here.
        Raises ClaimError for a verdict of a hypothesis that the lemma has not.
        """
        stated, names = dict(recorded or {}), tuple(one.name for one in lemma.hypotheses)
        if unknown := stated.keys() - set(names):
            raise ClaimError(f"claim {self._id(equation)}: {lemma.source} has no hypothesis '{min(unknown)}': choose "
                             f"of {', '.join(names)}")
        for one in lemma.hypotheses:
            collect = self.claim(
                f"{equation}.{one.name}", f"{title}: {one.title[0].lower()}{one.title[1:]}", "implication",
                r",\ ".join(relation.latex() for relation in one.goal.show), stated.get(one.name, "proved"),
                origin="implied", reading=f"A hypothesis of {lemma.source}.", note=f"Asked by {lemma.source}.")
            collect(_answering(one.goal))
        self.axiom(equation, title, printed or lemma.conclusion, lemma.source, origin=origin, severity=severity,
                   match=match, hypotheses=(*(f"{equation}.{name}" for name in names), *rests_on),
                   note=" ".join(filter(None, (note, lemma.taken))))

    def unstated(self, equation: str, title: str, printed: str, why: str, *, rests_on: tuple[str, ...] = (),
                 severity: Severity = "step") -> None:
        """State a line that has no goal yet, and why; it stays undecided."""
        self.claims.append(Claim(
            id=self._id(equation), title=title, kind="implication", printed=printed, recorded="undecided", build=None,
            unstated=why, rests_on=self._ids(equation, rests_on, "rests_on"), severity=severity))

    def _ids(self, equation: str, named: tuple[str, ...] | str, what: str) -> tuple[str, ...]:
        if isinstance(named, str):
            raise ClaimError(f"claim {self._id(equation)}: {what} are a tuple of numbers: write ('{named}',)")
        return tuple(self._id(one) for one in named)

    def _id(self, equation: str) -> str:
        return equation if ":" in equation else f"{self.name}:{equation}"


def _answering(goal: Goal) -> Builder:
    def build() -> Goal:
        return goal
    return build


def section_of(module: str) -> str:
    """The section that a module of claims is named after: 5.1 for `...section_5_1_laws`, 2 for `...section_2a_train`;
    empty for a module of another name."""
    found = _SECTION.search(module.rpartition(".")[2])
    return ".".join(filter(None, found.groups())) if found else ""


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
