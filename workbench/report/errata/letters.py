"""Letters of a goal that the paper does not have: written as the paper writes what they stand for where that is one
symbol, else told in words."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from workbench.report.certificate_latex import name_latex
from workbench.report.errata.blocks import Block, Formula, Item, Items, Paragraph
from workbench.report.worded import show, worded

_NAME = re.compile(r"[A-Za-z_]\w*")
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

    def in_text(self, text: str) -> str:
        """A text with the paper's symbols in its formulas."""
        return show(text, lambda latex: f"${self.in_formula(latex)}$")

    def in_blocks(self, blocks: Iterable[Block]) -> list[Block]:
        """Formulas and texts with the paper's symbols."""
        return [self._in_block(block) for block in blocks]

    def _in_block(self, block: Block) -> Block:
        match block:
            case Formula(latex, label):
                return Formula(self.in_formula(latex), label)
            case Paragraph(text, label):
                return Paragraph(self.in_text(text), label)
            case Items(items):
                return Items(tuple(replace(item, text=self.in_text(item.text)) for item in items))
        return block

    def legend(self, blocks: Sequence[Block]) -> str:
        """What the letters stand for that are in these blocks and not the paper's; empty where none is."""
        used = set[str]()
        if self.told:
            letters = _anywhere(self.told)
            used = {found["letter"] for text in map(_text, blocks) for found in letters.finditer(text)}
        told = [f"${latex}$ is {text}" for latex, text in self.told.items() if latex in used]
        return f"{'; '.join(told)}." if told else ""


def letters_of(certificate: Mapping[str, Any] | None, letters: Mapping[str, str]) -> Letters:
    """The letters of a certificate's goal; letters: what names stand for, in words with formulas between dollars."""
    named = set(_NAME.findall(json.dumps((certificate or {}).get("goal", {}))))
    own = {name: text for name, text in letters.items() if name in named}
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


def _text(block: Block) -> str:
    """The formulas of a block."""
    match block:
        case Formula(latex, _):
            return latex
        case Paragraph(text, _):
            return " ; ".join(text.split("$")[1::2])
        case Items(items):
            return " ; ".join(part for item in items for part in _parts(item))
    return ""


def _parts(item: Item) -> list[str]:
    return item.text.split("$")[1::2]
