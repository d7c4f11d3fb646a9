"""Read a line of LaTeX into its tree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, lru_cache
from typing import Any

from lark import Lark, Token, Transformer
from lark.exceptions import UnexpectedInput, VisitError
from lark.lexer import Lexer

from workbench.proof.latex.adjacent import require_no_mixed_number, require_own_slash
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.grammar import GRAMMAR
from workbench.proof.latex.tokens import tokens
from workbench.proof.latex.tree import (
    END,
    Accented,
    At,
    Big,
    Chain,
    Dot,
    Ellipsis,
    Group,
    Letter,
    Line,
    Named,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Root,
    Size,
    Terms,
    Transposed,
    Words,
)

NAMES = {"RELATION": "a relation sign", "COMMA": "a comma", "PLUS": "'+'", "MINUS": "'-'", "CLOSE": "a closing bracket",
         "BARS_CLOSE": "a closing bar", "IMPLIES": "an arrow", "RB": "the end of an argument"}


class _Handed(Lexer):
    """Hands the grammar the words that are made already."""

    def __init__(self, lexer_conf: Any) -> None:
        pass

    def lex(self, data: list[Token]) -> Iterator[Token]:  # type: ignore[override]
        """The words themselves."""
        yield from data


def read_line(text: str) -> Line:
    """The tree of a line; raises LatexError naming the place."""
    return _read(text)


@lru_cache(maxsize=4096)
def _read(text: str) -> Line:
    words = tokens(text)
    if not words:
        raise LatexError("the line is empty: write a formula")
    try:
        line = _parser().parse(words)
    except UnexpectedInput as trouble:
        raise _unexpected(trouble, words) from None
    except VisitError as trouble:
        if isinstance(trouble.orig_exc, LatexError):
            raise trouble.orig_exc from None
        raise
    assert isinstance(line, Line)
    return line


@cache
def _parser() -> Lark:
    return Lark(GRAMMAR, start="line", parser="lalr", lexer=_Handed, transformer=_Builder(), maybe_placeholders=False)


def _unexpected(trouble: UnexpectedInput, words: list[Token]) -> LatexError:
    token = getattr(trouble, "token", None)
    if token is None or token.type == "$END":
        return LatexError("the line ends where a formula goes on: complete it", words[-1].start_pos)
    name = NAMES.get(token.type, f"'{token.value}'")
    return LatexError(f"{name} is not expected here: correct what stands before it", token.start_pos)


class _Builder(Transformer[Token, Line]):
    """Makes the tree of what the grammar found; its methods are named by the rules."""

    def line(self, parts: list[Any]) -> Line:
        chains: list[Chain] = []
        separators: list[tuple[str, ...]] = []
        between: tuple[str, ...] = ()
        for part in parts:
            if isinstance(part, Chain):
                chains.append(part)
                separators.append(between)
                between = ()
            else:
                between = part
        return Line(tuple(chains), (*separators, between), position=chains[0].position if chains else 0)

    def separators(self, parts: list[Token]) -> tuple[str, ...]:
        words = {"COMMA": ",", "COLON": ":", "IMPLIES": "=>", "IFF": "<=>"}
        return tuple(END if p.type == "COMMA" and p.value in ";." else words.get(
            p.type, f"\\{p.value}" if p.type == "QUANTIFIER" else f"text {p.value}") for p in parts)

    def chain(self, parts: list[Any]) -> Chain:
        return Chain(tuple(parts[::2]), tuple(str(sign) for sign in parts[1::2]), position=parts[0].position)

    def words(self, parts: list[Token]) -> Node:
        return Words(str(parts[0]), position=_at(parts))

    def terms(self, parts: list[Any]) -> Node:
        signed = [part if isinstance(part, tuple) else (1, part) for part in parts]
        signed = [(sign, _unbraced(node, with_sign=sign != 1)) for sign, node in signed]
        if len(signed) == 1 and signed[0][0] == 1:
            return signed[0][1]
        return Terms(tuple(signed), position=signed[0][1].position)

    def negative(self, parts: list[Any]) -> tuple[int, Node]:
        return -1, parts[1]

    def positive(self, parts: list[Any]) -> tuple[int, Node]:
        return 1, parts[1]

    def either(self, parts: list[Any]) -> tuple[int, Node]:
        return 0, parts[1]

    def product(self, parts: list[Any]) -> Node:
        factors: list[Node] = []
        if len(parts) == 1:
            return parts[0]
        require_no_mixed_number(parts)
        for place, held in enumerate(parts):
            divides = place > 0 and isinstance(parts[place - 1], Token) and parts[place - 1].type == "SLASH"
            part = _unbraced(held, divides, beside=True)
            if isinstance(part, Token):
                if part.type == "CDOT":
                    factors.append(Dot(position=part.start_pos or 0))
                continue
            if divides:
                after = parts[place + 1] if place + 1 < len(parts) else None
                if after is not None and not (isinstance(after, Token) and after.type == "CDOT"):
                    raise LatexError("what a slash divides by is open: write \\frac, or brackets and \\cdot",
                                     part.position)
                require_own_slash(factors, part)
                top = _product(factors)
                factors = [Quotient(top, part, position=top.position)]
            else:
                factors.append(part)
        return _product(factors)

    def factor(self, parts: list[Any]) -> Node:
        if len(parts) == 1:
            return parts[0]
        if isinstance(parts[0], _Braced):
            raise _not_printed(parts[0])
        node: Node = parts[0]
        raised = [token for token, exponent in parts[1:] if exponent is not None]
        if len(raised) > 1:  # TeX refuses it too
            raise LatexError("two exponents stand side by side: put braces around what is raised", raised[1].start_pos)
        for token, exponent in parts[1:]:
            node = _scripted(node, token, exponent)
        return node

    def script(self, parts: list[Any]) -> tuple[Token, Node | None]:
        return parts[0], parts[2] if len(parts) > 1 else None

    def letter(self, parts: list[Token]) -> Node:
        return Letter(str(parts[0]), position=_at(parts))

    def number(self, parts: list[Token]) -> Node:
        return Number(Fraction(str(parts[0])), position=_at(parts))

    def named(self, parts: list[Token]) -> Node:
        return Named(str(parts[0]), position=_at(parts))

    def big(self, parts: list[Token]) -> Node:
        return Big(str(parts[0]), position=_at(parts))

    def ellipsis(self, parts: list[Token]) -> Node:
        return Ellipsis(position=_at(parts))

    def at(self, parts: list[Token]) -> Node:
        return At(str(parts[0]), position=_at(parts))

    def fraction(self, parts: list[Any]) -> Node:
        return Quotient(parts[2], parts[5], position=_at(parts))

    def root(self, parts: list[Any]) -> Node:
        return Root(parts[2], position=_at(parts))

    def accent(self, parts: list[Any]) -> Node:
        accent, body = str(parts[0]), parts[2]
        if isinstance(body, Letter):
            return replace(body, accents=(*body.accents, accent), position=_at(parts))
        return Accented(accent, body, position=_at(parts))

    def size(self, parts: list[Any]) -> Node:
        if str(parts[0]) != str(parts[2]):
            raise LatexError("a bar is closed by one of another kind: write the same bars", parts[2].start_pos)
        if any(chain.signs for chain in parts[1].chains) or any(s not in ((), (",",)) for s in parts[1].separators):
            raise LatexError("a relation between bars: correct the bars", _at(parts))
        return Size(str(parts[0]), tuple(chain.sides[0] for chain in parts[1].chains), position=_at(parts))

    def group(self, parts: list[Any]) -> Node:
        return Group(str(parts[0]), str(parts[2]), parts[1], position=_at(parts))

    def braces(self, parts: list[Any]) -> Node:
        found = parts[1]
        held = isinstance(found, (Terms, Product, Quotient, Power))
        return _Braced(found, position=found.position) if held else found


@dataclass(frozen=True)
class _Braced(Node):
    """Several pieces within TeX's own braces, which are not printed: what holds them together is not seen."""

    body: Node


def _not_printed(braced: _Braced) -> LatexError:
    return LatexError("braces are not printed, so that what they hold is read with what stands beside them: write "
                      "brackets", braced.position)


def _unbraced(node: Node, with_sign: bool, beside: bool = False) -> Node:
    """A piece without its braces; LatexError where it reads otherwise without them, as in `a - {b - c}`, `2{a + b}`."""
    if not isinstance(node, _Braced):
        return node
    if (with_sign and isinstance(node.body, Product if beside else Terms)) or (
            beside and isinstance(node.body, (Terms, Quotient))):
        raise _not_printed(node)
    return node.body


def _at(parts: list[Any]) -> int:
    return parts[0].start_pos or 0


def _product(factors: list[Node]) -> Node:
    if len(factors) == 1:
        return factors[0]
    flat = [inner for factor in factors for inner in (factor.factors if isinstance(factor, Product) else (factor,))]
    return Product(tuple(flat), position=flat[0].position)


def _scripted(node: Node, token: Token, exponent: Node | None) -> Node:
    """A node with an index, a mark or an exponent; what belongs to a letter is kept with it."""
    if isinstance(node, Big):
        return _with_ends(node, token, exponent)
    if exponent is not None:
        return Power(node, exponent, position=node.position)
    if token.type == "TRANSPOSE":
        return Transposed(node, position=node.position)
    if isinstance(node, Accented):
        return replace(node, body=_scripted(node.body, token, None))
    return _indexed(node, token) if token.type == "SUB" else _marked(node, token)


def _indexed(node: Node, token: Token) -> Node:
    if isinstance(node, (Letter, Named)) and not node.index:
        return replace(node, index=str(token))
    if isinstance(node, (Power, Transposed)):  # x^2_1 is x_1^2
        return replace(node, base=_indexed(node.base, token))
    if isinstance(node, Size):  # the norm by its name
        return Size(f"{node.bars}_{token}", node.parts, position=node.position)
    raise LatexError(f"the index '{token}' belongs to no letter: write it at one", token.start_pos)


def _marked(node: Node, token: Token) -> Node:
    if isinstance(node, (Letter, Number)):
        return replace(node, mark=node.mark + str(token))
    raise LatexError(f"the mark '{token}' belongs to no letter: write it at one", token.start_pos)


def _with_ends(node: Big, token: Token, exponent: Node | None) -> Node:
    if token.type == "SUB" and not node.below:
        return replace(node, below=str(token))
    if token.type == "SUP" and node.above is None:
        return replace(node, above=exponent)
    raise LatexError(f"'\\{node.name}' has two ends on one side: write one", token.start_pos)
