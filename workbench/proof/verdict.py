"""What a claim says of itself and what was decided of it: no formulas here, so that reading it needs no sympy."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from workbench.errors import ClaimError

Kind = Literal["identity", "inequality", "condition", "implication", "limit"]
Verdict = Literal["proved", "refuted", "violated", "gap", "assumed", "undecided"]

# Where a claim stands: a line of the paper; a step it takes without words; a question of ours.
Origin = Literal["printed", "implied", "ours"]
# What falls with a claim: a theorem or headline; a step of its proof; numbers; nothing.
Severity = Literal["result", "step", "data", "cosmetic"]
# How the printed line became the goal: by machine; by a person, whose reading is named; it is prose.
Match = Literal["parsed", "read", "words"]

ORIGINS: tuple[Origin, ...] = ("printed", "implied", "ours")
SEVERITIES: tuple[Severity, ...] = ("result", "step", "data", "cosmetic")
KINDS: tuple[Kind, ...] = ("identity", "inequality", "condition", "implication", "limit")
VERDICTS: tuple[Verdict, ...] = ("proved", "refuted", "violated", "gap", "assumed", "undecided")
FAILED: tuple[Verdict, ...] = ("refuted", "violated", "gap")


def in_number(verdict: str, count: int) -> str:
    """A verdict behind the number of claims that have it: 1 gap, 7 gaps, 67 proved."""
    return "gaps" if verdict == "gap" and count != 1 else verdict


def verdict_words(verdict: str, proved_under: Sequence[str]) -> str:
    """A verdict as it is shown; what is proved from claims that are not shown themselves names them, by their ids."""
    names = "), (".join(name.partition(":")[2] for name in proved_under)
    return f"{verdict} under ({names})" if names else verdict


# Names of papers and numbers of claims become names of folders and files.
LONGEST_EQUATION = 100
_EQUATION = re.compile(r"[A-Za-z0-9][A-Za-z0-9._+-]*")


def is_equation(text: str) -> bool:
    """Whether a text can be a claim's number, which also names its file; `manifest` is the name of another file."""
    return bool(_EQUATION.fullmatch(text)) and len(text) <= LONGEST_EQUATION and text.lower() != "manifest"


def is_paper_name(text: str) -> bool:
    """Whether a text can be a paper's name, which also names a folder: an identifier of Python without accents."""
    return text.isidentifier() and text.isascii() and len(text) <= LONGEST_EQUATION


@dataclass(frozen=True, kw_only=True)
class Stated:
    """A claim as it is printed, and where it stands in the paper.

    id: `<paper>:<equation>`; printed: the paper's LaTeX, letter by letter; recorded: the verdict on record.
    premises: ids of the claims that our proof uses; rests_on: ids of those that the paper's text uses to get here,
    which carry taint: unless stated the premises, and nothing of a question of ours. match: `read` or `words`
    (`parsed` is found by machine), reading: how a line was read by a person. glyph: id of the claim that decides the
    other reading of a line whose extracted text leaves a sign, power or index open; mends: id of the claim of which
    this is a repaired form. note: what a reader should know. section: the paper's section, as the claims' file is
    called.
    """

    id: str
    title: str
    kind: Kind
    printed: str
    recorded: Verdict
    premises: tuple[str, ...] = ()
    rests_on: tuple[str, ...] | None = None
    origin: Origin = "printed"
    severity: Severity | None = None
    match: Match = "read"
    reading: str = ""
    glyph: str | None = None
    mends: str | None = None
    scope: str = "all values of the domain"
    note: str = ""
    section: str = ""

    def __post_init__(self) -> None:
        paper, _, equation = self.id.partition(":")
        if not paper or not equation:
            raise ClaimError(f"claim id '{self.id}': write it as <paper>:<equation>")
        if not is_paper_name(paper):
            raise ClaimError(f"claim id {self.id!r}: '{paper}' is no name of a paper: use letters, digits and "
                             f"underscores, a letter first, at most {LONGEST_EQUATION} of them")
        if not is_equation(equation):
            raise ClaimError(f"claim id {self.id!r}: '{equation}' is no number of a claim: use letters, digits, '.', "
                             f"'_', '+' and '-', a letter or digit first, at most {LONGEST_EQUATION} of them")
        if self.kind not in KINDS:
            raise ClaimError(f"claim {self.id}: kind '{self.kind}' is none of {', '.join(KINDS)}")
        if self.recorded not in VERDICTS:
            raise ClaimError(f"claim {self.id}: recorded verdict '{self.recorded}' is none of {', '.join(VERDICTS)}")
        self._require_place()
        for name in ("title", "printed", "scope", "note", "reading"):
            if not isinstance(getattr(self, name), str):
                raise ClaimError(f"claim {self.id}: its {name} is no text: write it in quotes")

    def _require_place(self) -> None:
        if self.origin not in ORIGINS:
            raise ClaimError(f"claim {self.id}: origin '{self.origin}' is none of {', '.join(ORIGINS)}")
        if self.match not in ("read", "words"):
            raise ClaimError(f"claim {self.id}: match '{self.match}' is neither read nor words: leave it out where the "
                             "line can be parsed, which is found out by itself")
        if self.severity is None:
            object.__setattr__(self, "severity", "data" if self.kind == "condition" else "step")
        if self.severity not in SEVERITIES:
            raise ClaimError(f"claim {self.id}: severity '{self.severity}' is none of {', '.join(SEVERITIES)}")
        if self.rests_on is None:
            object.__setattr__(self, "rests_on", () if self.origin == "ours" else self.premises)
        if self.id in (self.glyph, self.mends):
            raise ClaimError(f"claim {self.id}: names itself as its other reading or as what it mends: name another")

    @property
    def chain(self) -> tuple[str, ...]:
        """Ids of what the paper's text uses to get here."""
        return self.rests_on or ()

    @property
    def paper(self) -> str:
        """The paper's name."""
        return self.id.partition(":")[0]

    @property
    def equation(self) -> str:
        """The equation's number, with a suffix for a part."""
        return self.id.partition(":")[2]


FateWord = Literal["stands", "stands with corrections", "falls", "open"]
FATES: tuple[FateWord, ...] = ("stands", "stands with corrections", "falls", "open")


@dataclass(frozen=True)
class Fate:
    """What becomes of a headline claim; `by` are the ids of the claims that it falls or stands by, `why` a sentence."""

    word: FateWord
    why: str
    by: tuple[str, ...] = ()


@dataclass(frozen=True)
class Decision:
    """A claim decided: the verdict, the certificate that shows it, and how it was found.

    goal: LaTeX made of what was decided; match: `parsed` where a machine found the printed line in the goal; letters:
    what letters of the goal that are not the paper's stand for, by their names.
    tainted_by (failed claims in the paper's chain), proved_under (claims that a proof uses and that are not shown),
    besides (what these claims assume and this one does not, as `x >= 1 (3)`), fate and other_reading (the printed line
    of the claim that decides it) come from the other claims.
    """

    claim: Stated
    verdict: Verdict
    method: str
    trust: str | None
    seconds: float
    certificate: dict[str, Any] | None = None
    counterexample: dict[str, str] | None = None
    correction: str | None = None
    computed: str | None = None
    match: Match | None = None
    goal: str | None = None
    letters: dict[str, str] = field(default_factory=dict)
    tainted_by: tuple[str, ...] = ()
    proved_under: tuple[str, ...] = ()
    besides: tuple[str, ...] = ()
    fate: Fate | None = None
    other_reading: str | None = None

    @property
    def matched(self) -> Match:
        """How the printed line became the goal: what a machine found, else what the claim says."""
        return self.match or self.claim.match
