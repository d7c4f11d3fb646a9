"""Letters of a goal that the paper does not have: written as the paper writes what they stand for where that is one
symbol, else told in words."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from workbench.proof.document_format import ClaimsDocument, LettersRow
from workbench.proof.names import names_in
from workbench.proof.verdict import Decision
from workbench.report.certificate_latex import name_latex
from workbench.report.counterexample import Counterexample
from workbench.report.worded import worded

_ACCENT = r"\\(?:hat|tilde|bar|dot|ddot)"
_BASE = rf"{_ACCENT}\{{{_ACCENT} ?(?:\\[A-Za-z]+|[A-Za-z])\}}|{_ACCENT} ?(?:\\[A-Za-z]+|[A-Za-z])|\\[A-Za-z]+|[A-Za-z]"
_BELOW = r"_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\\[A-Za-z]+|\w)"
_ABOVE = r"\^(?:\{[^{}]*\}|\*|\w)"
# One symbol with its indices, of some arguments or changed by a difference; a quotient; a size.
_SYMBOL = re.compile(rf"(?:\\Delta )?(?:{_BASE})(?:{_BELOW})?(?:{_ABOVE})?(?:\((?:[^()]|\{{[^{{}}]*\}})*\))?"
                     r"|\\frac\{[^{}]*\}\{[^{}]*\}|\|(?:\\[A-Za-z]+|[A-Za-z])\|")
_ACCENTED = re.compile(rf"({_BASE})(.*)", re.DOTALL)
# Words in a formula and the names of commands, in which no letter stands; nor does one in an index.
_NO_LETTER = r"\\(?:text|mathrm|operatorname)\{[^{}]*\}|\\frac\{d\}\{dt\}|\\[A-Za-z]+"


@dataclass(frozen=True)
class Letters:
    """The letters of one goal. written: how the paper writes those that stand for one symbol, by how they are written
    here; told: what the others stand for, by how they are written."""

    written: Mapping[str, str]
    told: Mapping[str, str]

    def in_formula(self, latex: str) -> str:
        """A formula with the paper's symbols."""
        if not self.written:
            return latex
        return _anywhere(self.written).sub(self._symbol, latex)

    def _symbol(self, found: re.Match[str]) -> str:
        if found["letter"] is None:
            return found[0]
        symbol = self.written[found["letter"]]
        raised = found.string[found.end():].startswith("^")
        return rf"\left({symbol}\right)" if raised and ("^" in symbol or not re.fullmatch(
            rf"(?:{_BASE})(?:{_BELOW})?", symbol)) else symbol

    def in_counterexample(self, point: Counterexample) -> Counterexample:
        """A counterexample with the paper's symbols."""
        def each(formulas: Iterable[str]) -> tuple[str, ...]:
            return tuple(map(self.in_formula, formulas))

        def known(formula: str | None) -> str | None:
            return None if formula is None else self.in_formula(formula)

        if not self.written:
            return point
        return replace(
            point, relation=self.in_formula(point.relation), values=each(point.values), given=each(point.given),
            along=each(point.along), beside=each(point.beside), left=known(point.left), right=known(point.right),
            unbounded=known(point.unbounded),
            everything=tuple((self.in_formula(name), self.in_formula(value)) for name, value in point.everything),
            put_in=None if point.put_in is None else (self.in_formula(point.put_in[0]),
                                                      self.in_formula(point.put_in[1])))

    def legend(self, formulas: Iterable[str]) -> str:
        """What the letters stand for that are in these formulas and not the paper's; empty where none is."""
        used = set[str]()
        if self.told:
            letters = _anywhere(self.told)
            used = {found["letter"] for formula in formulas for found in letters.finditer(formula)}
        told = [f"${latex}$ is {text}" for latex, text in self.told.items() if latex in used]
        return f"{'; '.join(told)}." if told else ""

    def row(self) -> LettersRow:
        """For programs."""
        return {"written": dict(self.written), "told": dict(self.told)}


def letters_of(d: Decision) -> Letters:
    """The letters of a decision's goal."""
    return letters_in(d.certificate, d.letters)


def with_letters(document: ClaimsDocument, decisions: Sequence[Decision]) -> ClaimsDocument:
    """A document of claims with the letters of these decisions in their rows."""
    rows = {d.claim.id: letters_of(d).row() for d in decisions}
    return {**document, "claims": [{**claim, "letters": rows[claim["id"]]} for claim in document["claims"]]}


def letters_from(row: object) -> Letters:
    """The letters of a document's row; none where there is no such row."""
    parts = row if isinstance(row, Mapping) else {}
    written, told = ({str(latex): str(text) for latex, text in part.items()} if isinstance(part, Mapping) else {}
                     for part in (parts.get("written"), parts.get("told")))
    return Letters(written, told)


def letters_in(certificate: Mapping[str, Any] | None, letters: Mapping[str, str]) -> Letters:
    """The letters of a certificate's goal; letters: what names stand for, in words with formulas between dollars."""
    named = names_in(certificate)
    own = {name: text for name, text in letters.items() if name in named or f"{name}_dot" in named}
    kept = {_bare(name_latex(name)) for name in named if name not in own}
    written, told = dict[str, str](), dict[str, str]()
    for name, text in own.items():
        symbol = text[1:-1] if text.count("$") == 2 and text[0] == text[-1] == "$" else ""
        if _SYMBOL.fullmatch(symbol) and _bare(symbol) not in kept:
            kept.add(_bare(symbol))
            written[name_latex(name)] = symbol
            if f"{name}_dot" in named and f"{name}_dot" not in letters:
                written[name_latex(f"{name}_dot")] = _ACCENTED.sub(r"\\dot{\g<1>}\g<2>", symbol, count=1)
        else:
            told[name_latex(name)] = worded(text)
    return Letters({latex: symbol for latex, symbol in written.items() if latex != symbol}, told)


def _anywhere(letters: Iterable[str]) -> re.Pattern[str]:
    """Finds letters in a formula where they stand alone, not as a part of another one."""
    longest = "|".join(map(re.escape, sorted(letters, key=len, reverse=True)))
    return re.compile(rf"(?P<letter>{longest})(?![A-Za-z_]|\}}_)|{_NO_LETTER}|{_BELOW}")


def _bare(latex: str) -> str:
    """A symbol without what only groups it, to see whether two are the same."""
    return re.sub(r"[{}\s]|\\left|\\right", "", latex).replace(r"\varepsilon", r"\epsilon")
