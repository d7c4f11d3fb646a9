"""Decide by what equalities say alone: a product of what is not zero lies in the ideal that they span.

Then the equalities, what is assumed positive or not to be zero, and the opposite of what is shown exclude each other.
So from x y = 0 and x != 0 follows y = 0: x**2 y**2 is a multiple of x y. A Groebner basis finds such products by
their normal forms, and keeps for every element the cofactors by which it is made of the equalities: these are the
certificate (Buchberger's algorithm; Cox, Little and O'Shea, Ideals, Varieties, and Algorithms, chapter 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import prod
from typing import Any

from sympy.polys.orderings import grevlex
from sympy.polys.rings import PolyRing

from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Item
from workbench.proof.decide.semialgebraic import read_situation
from workbench.proof.decide.situation import Polynomial

MOST_PAIRS, MOST_ELEMENTS = 60, 30  # of the basis
MOST_TERMS = 60  # of an element with its cofactors, and of a product
MOST_FACTORS, MOST_PRODUCTS = 4, 200  # of a product; products looked at


@dataclass(frozen=True)
class Element:
    """A polynomial of the ideal, and the cofactors by which it is the sum of their products with the equalities."""

    value: Polynomial
    cofactors: tuple[Polynomial, ...]

    def plus(self, factor: Polynomial, other: Element) -> Element:
        """This element and a multiple of another one."""
        return Element(self.value + factor * other.value, tuple(
            own + factor * others for own, others in zip(self.cofactors, other.cofactors, strict=True)))

    def size(self) -> int:
        """How many terms it takes to write it down."""
        return len(self.value) + sum(map(len, self.cofactors))


def find_by_ideal(goal: Goal, shown: Relation, given: tuple[Relation, ...]) -> dict[str, Any] | None:
    """A proof of a relation from the relations given, in the order the checker sees them, or None."""
    situation = read_situation(goal, shown, (*given, shown.negation))
    if situation is None or not situation.zeros:
        return None
    ring = situation.ring.clone(order=grevlex)
    zeros = [zero.value.set_ring(ring) for zero in situation.zeros]
    nonzero = [(k.items, k.value.set_ring(ring)) for k in situation.known if k.sign == ">"]
    nonzero += [((item,), ring.gens[place]) for place, (item, strict) in situation.signs.items() if strict]
    basis = groebner_basis(ring, zeros)
    product = _product_within(ring, basis, nonzero)
    if product is None:
        return None
    items, value = product
    terms = [{"coefficient": "1", "factors": list(items)}]
    for zero, cofactor in zip(situation.zeros, _cofactors(ring, value, basis), strict=True):
        if cofactor:
            terms.append({"coefficient": "-1", "factors": [*zero.items, {"any": situation.text(cofactor)}]})
    return {"rule": "contradiction", "terms": terms}


def groebner_basis(ring: PolyRing, zeros: list[Polynomial]) -> list[Element]:
    """A Groebner basis of the ideal of polynomials, or what is found of it within the limits."""
    found = [Element(zero, tuple(ring.one if other == place else ring.zero for other in range(len(zeros))))
             for place, zero in enumerate(zeros)]
    pairs = list(combinations(range(len(found)), 2))
    for _ in range(MOST_PAIRS):
        if not pairs or len(found) > MOST_ELEMENTS:
            break
        pair = min(pairs, key=lambda p: sum(ring.monomial_lcm(found[p[0]].value.LM, found[p[1]].value.LM)))
        pairs.remove(pair)
        one, two = (found[place] for place in pair)
        common = ring.monomial_lcm(one.value.LM, two.value.LM)
        if common == ring.monomial_mul(one.value.LM, two.value.LM):  # leading terms without a common factor
            continue
        up, down = (ring.term_new(ring.monomial_div(common, element.value.LM), ring.domain.one / element.value.LC)
                    for element in (one, two))
        nothing = Element(ring.zero, (ring.zero,) * len(zeros))
        rest = _reduced(nothing.plus(up, one).plus(-down, two), found)
        if rest.value and rest.size() <= MOST_TERMS:
            pairs += [(place, len(found)) for place in range(len(found))]
            found.append(rest)
    return found


def _reduced(element: Element, basis: list[Element]) -> Element:
    """An element of the ideal less multiples of others, so that no leading term of theirs divides one of its terms."""
    if element.value:
        for quotient, other in zip(element.value.div([other.value for other in basis])[0], basis, strict=True):
            element = element.plus(-quotient, other)
    return element


def _product_within(ring: PolyRing, basis: list[Element], nonzero: list[tuple[tuple[Item, ...], Polynomial]],
                    ) -> tuple[tuple[Item, ...], Polynomial] | None:
    """A product of what is not zero that lies in the ideal, of as few factors as there is one; None if none is seen."""
    divisors = [element.value for element in basis]
    products: list[tuple[tuple[int, ...], Polynomial]] = [((), ring.one.rem(divisors))]
    for places, rest in products:  # grows on the way
        if not rest:
            factors = [nonzero[place] for place in places]
            return tuple(item for items, _ in factors for item in items), prod((f for _, f in factors), start=ring.one)
        if len(places) < MOST_FACTORS and len(products) < MOST_PRODUCTS:
            products += [((*places, place), (rest * nonzero[place][1]).rem(divisors))
                         for place in range(places[-1] if places else 0, len(nonzero))
                         if len(rest) * len(nonzero[place][1]) <= MOST_TERMS]
    return None


def _cofactors(ring: PolyRing, value: Polynomial, basis: list[Element]) -> tuple[Polynomial, ...]:
    """The cofactors of a polynomial that lies in the ideal."""
    nothing = Element(ring.zero, (ring.zero,) * len(basis[0].cofactors))
    return tuple(-cofactor for cofactor in _reduced(Element(value, nothing.cofactors), basis).cofactors)
