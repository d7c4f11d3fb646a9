"""What a claim says of itself and what was decided of it: no formulas here, so that reading it needs no sympy."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Literal

from workbench.errors import ClaimError

Kind = Literal["identity", "inequality", "condition", "implication", "limit"]
Verdict = Literal["proved", "refuted", "violated", "gap", "assumed", "undecided"]

KINDS: tuple[Kind, ...] = ("identity", "inequality", "condition", "implication", "limit")
VERDICTS: tuple[Verdict, ...] = ("proved", "refuted", "violated", "gap", "assumed", "undecided")
FAILED: tuple[Verdict, ...] = ("refuted", "violated", "gap")


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
    """A claim as it is printed.

    id: `<paper>:<equation>`; statement: LaTeX as printed; premises: ids of the claims it rests on;
    recorded: the verdict on record; note: what a reader should know, a garbled place and its reading among it.
    """

    id: str
    title: str
    kind: Kind
    statement: str
    recorded: Verdict
    premises: tuple[str, ...] = ()
    scope: str = "all values of the domain"
    note: str = ""

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
        for name in ("title", "statement", "scope", "note"):
            if not isinstance(getattr(self, name), str):
                raise ClaimError(f"claim {self.id}: its {name} is no text: write it in quotes")

    @property
    def paper(self) -> str:
        """The paper's name."""
        return self.id.partition(":")[0]

    @property
    def equation(self) -> str:
        """The equation's number, with a suffix for a part."""
        return self.id.partition(":")[2]


@dataclass(frozen=True)
class Decision:
    """A claim decided: the verdict, the certificate that shows it, and how it was found."""

    claim: Stated
    verdict: Verdict
    method: str
    trust: str | None
    seconds: float
    certificate: dict[str, Any] | None = None
    counterexample: dict[str, str] | None = None
    correction: str | None = None
    computed: str | None = None
    tainted_by: tuple[str, ...] = ()
