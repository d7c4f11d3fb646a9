"""The words of the grammar, made of a line's pieces: arguments in braces, bars that are known to open or close."""

from __future__ import annotations

import re
from dataclasses import dataclass

from lark import Token

from workbench.proof.latex.commands import (
    BARS,
    BIG,
    CLOSES_BAR,
    CLOSING,
    DROPPED,
    ELLIPSES,
    EQUIVALENT,
    FONTS,
    FRACTIONS,
    FUNCTIONS,
    GREEK,
    IMPLIES,
    OPENING,
    OPENS_BAR,
    QUANTIFIERS,
    RELATIONS,
    SAME_ACCENT,
    SAME_FUNCTION,
    SPELLED,
    STAR,
    TIMES,
    UPRIGHT,
    WIDE,
)
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.limits import DEEPEST_NESTING, LONGEST_NUMBER
from workbench.proof.latex.scan import Piece, argument, arguments, plain, scan
from workbench.proof.latex.spaces import COMPLETE, require_no_formula

SIGNS = {"/": "SLASH", "+": "PLUS", "-": "MINUS", "=": "RELATION", "<": "RELATION", ">": "RELATION", "(": "OPEN",
         "[": "OPEN", ")": "CLOSE", "]": "CLOSE", "'": "MARK", ",": "COMMA", ";": "COMMA", ":": "COLON", ".": "COMMA"}
_COMMANDS: dict[str, dict[str, str] | frozenset[str]] = {
    "OPEN": OPENING, "CLOSE": CLOSING, "LETTER": GREEK, "NAMED": {name: SAME_FUNCTION.get(name, name)
                                                                  for name in FUNCTIONS},
    "RELATION": RELATIONS, "BIG": BIG, "IMPLIES": IMPLIES, "IFF": EQUIVALENT, "QUANTIFIER": QUANTIFIERS,
    "ELLIPSIS": ELLIPSES, "CDOT": TIMES, "PLUS_MINUS": frozenset(("pm", "mp")), "MARK": dict.fromkeys(STAR, "*"),
    "COLON": frozenset(("colon",)),
}
TYPED = {"<=": "<=", ">=": ">=", "!=": "!=", ":=": "=", "<<": "<<", ">>": ">>"}
_MARK = re.compile(r"\*|\+|-|0|\\pm|\\prime|'+|\(\d+\)|\\infty")
_STARRED = re.compile(r"(\*)(T|2|\\top)")


def tokens(line: str) -> list[Token]:
    """The words of a line; raises LatexError for what no grammar could read."""
    pieces = scan(line)
    return _Words(pieces).range(0, len(pieces), 0)


@dataclass
class _Words:
    pieces: list[Piece]

    def range(self, start: int, end: int, depth: int) -> list[Token]:
        """The words of some pieces, whose brackets and bars are their own."""
        if depth > DEEPEST_NESTING:
            raise LatexError(f"arguments are nested more than {DEEPEST_NESTING} deep: write a flatter line",
                             self.pieces[start].position)
        out: list[Token] = []
        opened: list[str] = []
        spaces: list[tuple[int, bool]] = []
        at = start
        while at < end:
            piece = self.pieces[at]
            if piece.kind == "apart" or (piece.kind == "command" and piece.text in DROPPED):
                at += 1
                if piece.kind == "apart" or piece.text in WIDE:
                    spaces.append((len(out), piece.kind == "apart"))
                # \left. and \right. are brackets that are not there.
                if piece.text in ("left", "right") and at < end and self.pieces[at].text == ".":
                    at += 1
            elif piece.text == "|" or (piece.kind == "command" and piece.text in BARS):
                at = self._bar(out, opened, at, end)
            elif piece.text == "%" and out and out[-1].type == "NUMBER" and "e" not in out[-1]:
                out[-1] = out[-1].update(value=f"{out[-1]}e-2")
                at += 1
            elif piece.kind == "digit" or self._starts_with_point(at, end):
                at = self._number(out, at, end)
            elif (sign := self._typed_sign(at, end)) is not None:
                out.append(_token("RELATION", sign, piece))
                at += 2
            elif piece.kind == "sign" and piece.text in "_^":
                at = (self._index if piece.text == "_" else self._above)(out, at, end, depth)
            elif arguments(piece):
                at = self._with_arguments(out, at, end, depth)
            else:
                self._require_no_name(at, end)
                out.append(_simple(piece))
                self._brackets(out[-1], opened)
                at += 1
        require_no_formula(out, spaces)
        return out

    def _require_no_name(self, at: int, end: int) -> None:
        """Raise LatexError for letters side by side that spell a function: `sin x` is s times i times n times x."""
        run, longest = "", max(map(len, SPELLED))
        while len(run) < longest and at + len(run) < end and (
                piece := self.pieces[at + len(run)]).kind == "letter" and self._adjacent(at, at + len(run)):
            run += piece.text
        if name := next((name for name in SPELLED if run.startswith(name)), None):
            raise LatexError(f"the letters '{name}' are a product: write \\{name} for the function, or spaces between "
                             "the letters", self.pieces[at].position)

    def _brackets(self, token: Token, opened: list[str]) -> None:
        if token.type in ("OPEN", "LB"):
            opened.append(token.value)
            if len(opened) > DEEPEST_NESTING:
                raise LatexError(f"brackets are nested more than {DEEPEST_NESTING} deep: write a flatter line",
                                 token.start_pos)
        elif token.type in ("CLOSE", "RB") and opened:
            opened.pop()

    def _bar(self, out: list[Token], opened: list[str], at: int, end: int) -> int:
        piece = self.pieces[at]
        kind = "|" if piece.text == "|" and piece.kind == "sign" else BARS[piece.text]
        sized = self.pieces[at - 1].text if at else ""  # \left| opens whatever stands before it
        fits = bool(opened) and opened[-1] == kind
        if {piece.text, sized} & OPENS_BAR:
            closes = False
        elif {piece.text, sized} & CLOSES_BAR:
            closes = fits
        else:
            closes = fits and bool(out) and out[-1].type in COMPLETE
        follows = self.pieces[at + 1].text if at + 1 < end else ""
        if closes:
            opened.pop()
            out.append(_token("BARS_CLOSE", kind, piece))
        elif follows == "_" and kind == "|":
            first, last, after = argument(self.pieces, at + 2, end)
            out.append(_token("AT", plain(self.pieces[first:last]), piece))
            return after
        else:
            opened.append(kind)
            if len(opened) > DEEPEST_NESTING:
                raise LatexError(f"bars are nested more than {DEEPEST_NESTING} deep: write a flatter line",
                                 piece.position)
            out.append(_token("BARS_OPEN", kind, piece))
        return at + 1

    def _number(self, out: list[Token], at: int, end: int) -> int:
        """Digits that stand side by side, with a decimal point if digits follow it."""
        start, text = at, ""
        while at < end and self._adjacent(start, at):
            piece = self.pieces[at]
            point = piece.text == "." and "." not in text and at + 1 < end and self.pieces[at + 1].kind == "digit"
            if piece.kind != "digit" and not (point and self._adjacent(start, at + 1)):
                break
            text += piece.text
            at += 1
        if len(text) > LONGEST_NUMBER:
            raise LatexError(f"a number of {len(text)} digits: write at most {LONGEST_NUMBER}",
                             self.pieces[start].position)
        if out and out[-1].type == "NUMBER":
            raise LatexError(f"the numbers {out[-1].value} and {text} stand side by side: write a sign between them",
                             self.pieces[start].position)
        if self._exponent(start, at, end):
            raise LatexError(f"{text}e with digits behind it may be a power of ten or a product: write 10^{{-3}}, or a "
                             "space before e", self.pieces[start].position)
        if self._thousands(start, at, end):
            raise LatexError(f"{text} and a comma before three digits: write one number without the comma, or two with "
                             "a space after it", self.pieces[start].position)
        out.append(_token("NUMBER", f"0{text}" if text.startswith(".") else text, self.pieces[start]))
        return at

    def _starts_with_point(self, at: int, end: int) -> bool:
        """Whether a point stands here that no digit stands before and one stands right behind, as in `.5`."""
        return self.pieces[at].text == "." and self.pieces[at].kind == "sign" and at + 1 < end and (
            self.pieces[at + 1].kind == "digit" and self._adjacent(at, at + 1))

    def _typed_sign(self, at: int, end: int) -> str | None:
        """A relation of two signs side by side, as programs write it."""
        if at + 1 < end and self._adjacent(at, at + 1) and self.pieces[at].kind == self.pieces[at + 1].kind == "sign":
            return TYPED.get(self.pieces[at].text + self.pieces[at + 1].text)
        return None

    def _exponent(self, start: int, at: int, end: int) -> bool:
        """Whether an `e` and digits stand right behind a number, as programs write powers of ten."""
        behind = at + 1 + (at + 1 < end and self.pieces[at + 1].text in "+-")
        return behind < end and self.pieces[at].text == "e" and self.pieces[behind].kind == "digit" and (
            self._adjacent(start, behind))

    def _thousands(self, start: int, at: int, end: int) -> bool:
        """Whether a comma and three digits, no more, stand right behind a number."""
        digits = [piece.kind == "digit" and self._adjacent(start, at + 1 + i)
                  for i, piece in enumerate(self.pieces[at + 1:min(at + 5, end)])]
        return at < end and self.pieces[at].text == "," and self._adjacent(start, at) and digits in (
            [True] * 3, [True] * 3 + [False])

    def _adjacent(self, start: int, at: int) -> bool:
        return self.pieces[at].position - self.pieces[start].position == at - start

    def _script(self, at: int, end: int) -> tuple[int, int, int]:
        """The argument of the ^, _ or root at a piece."""
        first, last, after = argument(self.pieces, at + 1, end)
        if first == at + 1 and self.pieces[first].kind == "digit" and after < end and (
                self.pieces[after].kind == "digit" and self._adjacent(first, after)):
            raise LatexError("of digits behind ^, _ or \\sqrt without braces TeX takes the first alone: write x^{23}",
                             self.pieces[at].position)
        return first, last, after

    def _index(self, out: list[Token], at: int, end: int, depth: int) -> int:
        first, last, after = self._script(at, end)
        out.append(_token("SUB", plain(self.pieces[first:last]), self.pieces[at]))
        return after

    def _above(self, out: list[Token], at: int, end: int, depth: int) -> int:
        piece = self.pieces[at]
        first, last, after = self._script(at, end)
        text = plain(self.pieces[first:last]).replace("\\star", "*").replace("\\ast", "*").replace(" ", "")
        of_big = bool(out) and (out[-1].type == "BIG" or (
            out[-1].type == "SUB" and len(out) > 1 and out[-2].type == "BIG"))
        starred = _STARRED.fullmatch(text)
        if of_big:
            pass
        elif starred or _MARK.fullmatch(text):
            out.append(_token("MARK", "*" if starred else text.replace("\\prime", "'"), piece))
            if starred is None:
                return after
            if starred[2] != "2":
                out.append(_token("TRANSPOSE", "T", piece))
                return after
            first = last - 1
        elif text in ("T", "\\top", "\\intercal"):
            out.append(_token("TRANSPOSE", "T", piece))
            return after
        self._braced(out, "SUP", first, last, depth)
        return after

    def _with_arguments(self, out: list[Token], at: int, end: int, depth: int) -> int:
        piece = self.pieces[at]
        word = piece.text
        if word in FONTS or word in UPRIGHT:
            first, last, after = argument(self.pieces, at + 1, end)
            text = plain(self.pieces[first:last])
            if word in FONTS:
                out.append(_token("LETTER", f"\\{word}{{{text}}}", piece))
            elif text in FUNCTIONS:
                out.append(_token("NAMED", SAME_FUNCTION.get(text, text), piece))
            else:  # an upright d is that of derivatives and integrals
                out.append(_token("LETTER", "d" if text == "d" else f"\\mathrm{{{text}}}", piece))
            return after
        kind = "FRAC" if word in FRACTIONS else "SQRT" if word == "sqrt" else "ACCENT"
        if kind == "SQRT" and at + 1 < end and self.pieces[at + 1].text == "[":
            raise LatexError(r"a root other than the square root: write \sqrt{...}", piece.position)
        out.append(_token(kind, SAME_ACCENT.get(word, word), piece))
        after = at + 1
        for _ in range(2 if kind == "FRAC" else 1):
            first, last, after = argument(self.pieces, after, end) if kind != "SQRT" else self._script(at, end)
            self._braced(out, None, first, last, depth)
        return after

    def _braced(self, out: list[Token], before: str | None, first: int, last: int, depth: int) -> None:
        piece = self.pieces[min(first, len(self.pieces) - 1)]
        if first >= last:
            raise LatexError("an argument is empty: write what belongs there", piece.position)
        if before is not None:
            out.append(_token(before, "^", piece))
        out += [_token("LB", "{", piece), *self.range(first, last, depth + 1), _token("RB", "}", piece)]


def _simple(piece: Piece) -> Token:
    kinds = {"text": "WORDS", "letter": "LETTER", "open": "LB", "close": "RB"}
    if piece.kind == "command":
        return _command(piece)
    kind = kinds.get(piece.kind) or SIGNS.get(piece.text)
    if kind is None:
        raise LatexError(f"'{piece.text}' has no meaning in a formula: write \\cdot for a product, words in "
                         "\\text{...}", piece.position)
    return _token(kind, piece.text, piece)


def _command(piece: Piece) -> Token:
    word = piece.text
    for kind, known in _COMMANDS.items():
        if word in known:
            value = known[word] if isinstance(known, dict) else word
            return _token(kind, f"\\{word}" if kind == "LETTER" else value, piece)
    raise LatexError(f"the command \\{word} is not known here: write it with known ones, or in \\text{{...}}",
                     piece.position)


def _token(kind: str, value: str, piece: Piece) -> Token:
    return Token(kind, value, start_pos=piece.position)
