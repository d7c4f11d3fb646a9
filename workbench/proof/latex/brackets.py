"""What stands in brackets, and which brackets and functions go on with a product."""

from __future__ import annotations

from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.tree import (
    Dot,
    Group,
    Letter,
    Named,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Size,
    Terms,
    Transposed,
    letters_of_node,
)

TIMES = {Letter(name) for name in ("t", "T", "\\tau")}
STEPS = {Letter(name) for name in "tknij"}  # what counts steps, where it stands alone with numbers
FUNCTION_LETTERS = frozenset(("f", "g", "h", "\\phi", "\\varphi", "\\psi"))  # before a bracket, functions as a rule
PAIRS = {"(": ")", "[": "]", "{": "}"}


def inside(group: Group) -> Node:
    """The one expression between brackets."""
    sides = inside_all(group)
    if len(sides) != 1:
        raise LatexError("several values between brackets: give the piece in the notation", group.position)
    return sides[0]


def inside_all(group: Group) -> list[Node]:
    """The expressions between brackets, which commas part."""
    if PAIRS[group.opening] != group.closing:
        raise LatexError(f"'{group.opening}' is closed by '{group.closing}': write the same brackets", group.position)
    line = group.line
    if any(s != (",",) for s in line.separators[1:-1]) or line.separators[0] or line.separators[-1]:
        raise LatexError("words or arrows between brackets: give the piece in the notation", group.position)
    if any(chain.signs for chain in line.chains):
        raise LatexError("a relation between brackets: write it after a comma", group.position)
    return [chain.sides[0] for chain in line.chains]


def says_nothing(notation: Notation, node: Node) -> bool:
    """Whether a node is an argument that letters are printed with, and no factor: `(t)` with the meaning 1."""
    return isinstance(node, Group) and notation.meaning(node) == 1


def is_argument(notation: Notation, node: Node, before: Node) -> bool:
    """The same, behind what may have an argument: `2(t)`, `\\frac12(t)` and `x \\cdot (t)` are products."""
    return says_nothing(notation, node) and bool(letters_of_node(before))


def require_letter_before(notation: Notation, node: Node) -> None:
    """Raise LatexError for an argument that stands where a number is expected, as in `x + (t)`."""
    if says_nothing(notation, node):
        raise LatexError("an argument of letters stands by itself: give its letter a rate, and write it without "
                         "brackets", node.position)


def require_own_power(last: Node, declared: bool) -> None:
    """Raise LatexError for the power at the end of a declared piece such as `x y`: V(0)^2 is the square of V(0), x y^2
    may be that of y alone."""
    if declared and not isinstance(_base(last), Group):
        raise LatexError("the power may belong to all of a piece of the notation or to its last letter: put brackets "
                         "around one of the two", last.position)


def require_factor(notation: Notation, factors: tuple[Node, ...], at: int, declared: bool = False) -> None:
    """Raise LatexError for brackets that a reader would not take for a factor: `x(t)`, `V(0)`, `= 1 (3)`; where letters
    are declared, neither for a value at another instant, `x(t - T)`, `x(k + 1)`, nor of a function, `V(x + y)`; nor is
    a number behind another factor one, as in `x2`."""
    group, before = _base(factors[at]), factors[at - 1] if at else Dot()
    if declared and isinstance(group, Number) and not isinstance(before, Dot) and notation.piece(factors, at) is None:
        raise LatexError("a number stands behind a factor, and may be its index, its exponent or one more factor: "
                         r"write the number first, or \cdot before it", factors[at].position)
    if not isinstance(group, Group) or isinstance(before, (Dot, Group)) or notation.meaning(group) is not None:
        return
    chains = group.line.chains
    lone = chains[0].sides[0] if len(chains) == 1 and not chains[0].signs else None
    letter = _base(before)
    if isinstance(lone, Number) or (isinstance(letter, Letter) and (isinstance(lone, Letter) or (declared and (
            _is_instant(lone) or _is_function(notation, letter) or _is_place(notation, letter, lone))))):
        raise LatexError("what stands in these brackets may be an argument, a factor or the number of an equation: "
                         r"write \cdot before them for a product, or add the piece with its letter to the notation",
                         group.position)


def _is_instant(node: Node | None) -> bool:
    """Whether an expression holds the letter of time, or is made of times alone, or a step's number: k + 1, 2 n."""
    found = letters_of_node(node)
    return Letter("t") in found or (bool(found) and (found <= TIMES or (
        found <= STEPS and not isinstance(node, Quotient))))


def _is_place(notation: Notation, letter: Letter, inner: Node | None) -> bool:
    """Whether brackets may hold where or when a letter is taken: `x(-1)`, and `x(-T)` or `x(T/2)` where x moves."""
    if not isinstance(inner, (Terms, Product, Quotient)) or (isinstance(inner, Terms) and len(inner.terms) > 1):
        return False
    found = letters_of_node(inner)
    moves = notation.meaning(letter) in notation.moving
    return not found or (moves and not any(notation.meaning(one) in notation.moving for one in found))


def _is_function(notation: Notation, letter: Letter) -> bool:
    """Whether a letter is a capital one that the notation defines, as functions of Lyapunov are, or one that papers
    have for functions."""
    meaning = notation.meaning(letter)
    if letter.name in FUNCTION_LETTERS:
        return True
    return letter.name.isupper() and meaning is not None and not meaning.is_number and not meaning.is_Atom and (
        "Indexed" not in type(meaning).__name__)


def plain_exponent(exponent: Node) -> Node:
    """The exponent; LatexError for one in brackets that may count, as in `x^{(i)}`, and be no power."""
    sides = inside_all(exponent) if isinstance(exponent, Group) else exponent.parts if isinstance(
        exponent, Size) else ()
    parts = [part for side in sides for part in (
        [term for _, term in side.terms] if isinstance(side, Terms) else [side])]
    if parts and all(isinstance(part, (Letter, Number)) for part in parts):
        raise LatexError("a superscript in brackets may count or be a power: write the power without brackets",
                         exponent.position)
    return exponent


def ends_behind_letter(rest: tuple[Node, ...]) -> bool:
    """Whether a number is followed by a letter, and that by what does not belong to the argument: 2 x in `sin 2x`."""
    return len(rest) > 1 and isinstance(_base(rest[1]), Letter) and (len(rest) == 2 or is_next(rest[2]))


def is_next(node: Node) -> bool:
    """Whether the argument of a function ends before a node: at another function or a sign."""
    return isinstance(_base(node), (Named, Dot))


def require_end(name: Named, behind: tuple[Node, ...]) -> None:
    """Raise LatexError where a factor follows what a function is of, to which it may belong too."""
    if behind and not is_next(behind[0]):
        raise LatexError(f"the argument of '{name.name}' is open: write it in brackets", name.position)


def _base(node: Node) -> Node:
    return node.base if isinstance(node, (Power, Transposed)) else node
