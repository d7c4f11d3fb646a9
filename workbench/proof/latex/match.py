"""Whether a printed line and a goal are the same statement, by machine."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.claim import Claim, D, Goal, Operator, Relation, equal
from workbench.proof.latex.compare import Comparison
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.parts import ProseError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.scan import scan
from workbench.proof.latex.statement import Related, statement

FLIPPED: dict[Operator, Operator] = {"==": "==", "!=": "!=", "<=": ">=", ">=": "<=", "<": ">", ">": "<"}


@dataclass(frozen=True)
class Match:
    """Whether the line was parsed and equals the goal, and why (not); `words`: the line is no formula throughout."""

    parsed: bool
    why: str
    words: bool = False


def match(printed: str, notation: Mapping[str, sp.Expr], goal: Goal) -> Match:
    """Compare a printed line with a goal, its letters read by the notation.

    Parsed is a line each of whose relations the goal shows, side by side or turned around as a whole, when the goal
    shows nothing else, and each of whose conditions the goal assumes. Sides are compared by exact algebra; no term is
    moved between them. In a chain `a = b <= c` equal sides stand for each other.
    """
    try:
        if {piece.kind for piece in scan(printed)} == {"text"}:
            return Match(False, "the line is words alone: it is read by a person", words=True)
        goal, line = goal.evaluated(), read_line(printed)
        stated = statement(line, Converter(Notation(notation), limits_of(goal)))
        return _compared(stated.claimed, stated.conditions, goal)
    except ProseError as trouble:
        return Match(False, str(trouble), words=True)
    except (LatexError, ClaimError) as trouble:
        return Match(False, str(trouble))


def match_claim(claim: Claim, goal: Goal) -> Match:
    """The match of a claim's printed line with its goal, by the claim's letters; what is declared prose is not read."""
    if claim.match == "words":
        return Match(False, "declared as prose", words=True)
    return match(claim.printed, claim.notation, goal)


def limits_of(goal: Goal) -> sp.Tuple | None:
    """The limits of the goal's sums, which are the same in all of them."""
    sides = [side for r in goal.relations() for side in (r.left, r.right)]
    for side in (*sides, *goal.flow.values()):
        for total in side.atoms(sp.Sum):
            return total.limits[0]
    return None


def _compared(claimed: tuple[Related, ...], conditions: tuple[Related, ...], goal: Goal) -> Match:
    if goal.eventually is not None:
        return Match(False, "the goal holds from some time on, which the line does not say")
    at_rest = _at_rest([side for r in goal.relations() for side in (r.left, r.right)], goal)
    if resting := _at_rest([side for related in claimed for side in related.sides], goal) - at_rest:
        return Match(False, f"the goal gives no rate of {', '.join(sorted(map(str, resting)))}, which the line's "
                            "derivatives need: state one, 0 for a constant")
    comparison = Comparison(goal.flow)
    lines = [_Sides(related, comparison) for related in claimed]
    used: set[int] = set()
    for sides in lines:
        taken = sides.shown_by(list(goal.show))
        if isinstance(taken, str):
            return Match(False, taken)
        used |= taken
    for number, shown in enumerate(goal.show):
        if number not in used:
            return Match(False, f"the goal shows more than is printed: {_brief(shown)}")
    given = [*goal.assume, *goal.always, *goal.signs(), *(equal(s, value) for s, value in goal.initial.items())]
    for related in conditions:
        taken = _Sides(related, comparison).shown_by(given, what="assume")
        if isinstance(taken, str):
            return Match(False, taken)
    return Match(True, "equal side by side")


def _at_rest(sides: list[sp.Expr], goal: Goal) -> set[sp.Symbol]:
    """What derivatives in these sides hold constant because the goal gives no rate of it; parameters, whose sign is
    known, and the entries of vectors are left out."""
    found: set[sp.Symbol] = set()
    for side in sides:
        for part in side.atoms(D):
            inside = {s for i in part.atoms(sp.Indexed) for s in i.free_symbols}
            limits = [limit for total in part.atoms(sp.Sum) for limit in total.limits]
            inside |= {s for limit in limits for e in limit for s in e.free_symbols}
            found |= part.atoms(sp.Symbol) - inside
    return {s for s in found if not s.is_nonnegative} - goal.flow.keys() - set(goal.inputs)


class _Sides:
    """The sides of one printed chain, and which of them are equal by its own equality signs."""

    def __init__(self, related: Related, comparison: Comparison) -> None:
        self.related, self.comparison, self.same = related, comparison, comparison.same
        self.printed = self._classes(related.operators)

    def _classes(self, operators: tuple[Operator, ...]) -> list[int]:
        """For each side the class of sides that the chain's equality signs join it to."""
        number, classes = 0, [0]
        for operator in operators:
            number += operator != "=="
            classes.append(number)
        return classes

    def shown_by(self, relations: list[Relation], what: str = "show") -> set[int] | str:
        """The relations that say the chain, by their places in the list; else what is missing."""
        sides, operators = self.related.sides, self.related.operators
        joined = list(range(len(sides)))
        for first, second in pairwise(range(len(sides))):  # what is equal by the notation needs no relation
            if operators[first] == "==" and self.same(sides[first], sides[second]):
                _join(joined, first, second)
        used: set[int] = set()
        steps: dict[int, int] = {}
        for number, relation in enumerate(relations):
            for first, second, operator in self._places(relation):
                if operator == "==" and self.printed[first] == self.printed[second]:
                    _join(joined, first, second)
                    used.add(number)
                below, above = sorted((first, second))
                step = operator if first < second else FLIPPED[operator]
                if self.printed[above] == self.printed[below] + 1 and self._step(below, above) == step:
                    steps[self.printed[below]] = number
                    used.add(number)
        for place, operator in enumerate(operators):
            there = joined[place] == joined[place + 1] if operator == "==" else self.printed[place] in steps
            if not there:
                return self._missing(place, relations, what)
        return used

    def _step(self, below: int, above: int) -> Operator:
        """The operator that is no equality between two sides of neighbouring classes."""
        return next(op for op in self.related.operators[below:above] if op != "==")

    def _places(self, relation: Relation) -> Iterator[tuple[int, int, Operator]]:
        """Where the relation's sides stand in the chain; sides that are one by the letters stand in its order."""
        alike = self.same(relation.left, relation.right)
        lefts = [i for i, side in enumerate(self.related.sides) if self.same(side, relation.left)]
        rights = [i for i, side in enumerate(self.related.sides) if self.same(side, relation.right)]
        for left in lefts:
            for right in rights:
                if left < right or (left > right and not alike):
                    yield left, right, relation.operator

    def _missing(self, place: int, relations: list[Relation], what: str) -> str:
        left, operator, right = self.related.sides[place], self.related.operators[place], self.related.sides[place + 1]
        said = f"the goal does not {what} what is printed: {_brief(Relation(left, operator, right))}"
        margin = Relation(left, operator, right).margin
        for relation in relations:
            if relation.right == 0 and any(self.same(relation.left, sign * margin) for sign in (1, -1)):
                return f"{said}; it has the difference of the sides, state them side by side"
            ends = {FLIPPED[relation.operator]: (right, left), relation.operator: (left, right)}
            if operator not in ends and all(self.same(a, b) for a, b in ((left, relation.left),
                                                                              (right, relation.right))):
                return f"{said}; it has '{relation.operator}' there"
            for own, missing in ((left, right), (right, left)):
                for beside, other in ((relation.left, relation.right), (relation.right, relation.left)):
                    if what == "show" and self.same(own, beside):
                        return f"{said}; beside {_short(own)} it has {_short(other)} instead of {_short(missing)}"
        if self.comparison.too_large:
            return f"{said}, as far as sides of moderate size were compared: write them as the other has them"
        return said


def _join(joined: list[int], first: int, second: int) -> None:
    old, new = joined[first], joined[second]
    for place, number in enumerate(joined):
        if number == old:
            joined[place] = new


def _brief(relation: Relation) -> str:
    return f"{_short(relation.left)} {relation.operator} {_short(relation.right)}"


def _short(expr: sp.Expr) -> str:
    text = str(expr)
    return text if len(text) <= 120 else f"{text[:117]}..."
