"""What a search is asked: polynomial inequalities for all states, with coefficients that are to be found.

A condition such as `at_most(D(V), -V)` holds for all values of the states; what is unknown enters it linearly. For
quadratic forms that is a linear matrix inequality, for polynomials a sum-of-squares problem.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import combinations_with_replacement, product

import sympy as sp

from workbench.errors import InputError
from workbench.gains.exact import fraction
from workbench.proof.claim import Relation
from workbench.proof.derive import expand_derivatives

Exponents = tuple[int, ...]
Poly = dict[Exponents, Fraction]
MOST_BASIS, MOST_CANDIDATES = 60, 20_000


@dataclass(frozen=True)
class Problem:
    """Find `unknowns` so that every condition holds for all values of the other symbols, its states.

    id: `<paper>:<name>`, as certificates are named; conditions: by the name of their family, <= or >= between
    polynomials in the states, affine in the unknowns; flow: the rates that D(...) uses; where: inequalities in the
    states under which the conditions are wanted; minimise: an affine expression of the unknowns; scales: typical sizes
    of symbols (1 unless given), which only helps the solver.
    """

    id: str
    unknowns: tuple[sp.Symbol, ...]
    conditions: Mapping[str, Relation]
    flow: Mapping[sp.Expr, sp.Expr] = field(default_factory=dict)
    where: tuple[Relation, ...] = ()
    minimise: sp.Expr | None = None
    scales: Mapping[sp.Symbol, Fraction] = field(default_factory=dict)


@dataclass(frozen=True)
class Block:
    """A Gram matrix: what its square form is multiplied by (number of the region's inequality, -1: one), its basis."""

    number: int
    weight: Poly
    basis: tuple[Exponents, ...]


@dataclass(frozen=True)
class Family:
    """A condition as a polynomial: exponents of the states -> (constant, one slope for each unknown)."""

    name: str
    terms: dict[Exponents, tuple[Fraction, ...]]
    blocks: tuple[Block, ...]

    @property
    def determined(self) -> bool:
        """Whether the coefficients leave no choice of the Gram matrix."""
        products = [_plus(a, b) for a, b in combinations_with_replacement(self.blocks[0].basis, 2)]
        return len(self.blocks) == 1 and len(set(products)) == len(products)

    @property
    def of_points(self) -> bool:
        """Whether every vector of the basis stands for a point of the states, or one at infinity, so that the condition
        is met where its Gram matrix is no less than zero, and nowhere else."""
        return len(self.blocks) == 1 and all(sum(one) <= 1 for one in self.blocks[0].basis)

    def at(self, values: tuple[Fraction, ...]) -> Poly:
        """The polynomial for values of the unknowns."""
        return {e: c[0] + sum((x * y for x, y in zip(c[1:], values, strict=True)), Fraction(0))
                for e, c in self.terms.items()}


def _plus(one: Exponents, other: Exponents) -> Exponents:
    return tuple(a + b for a, b in zip(one, other, strict=True))


def states_of(problem: Problem) -> tuple[sp.Symbol, ...]:
    """The symbols for all of whose values the conditions must hold, by name."""
    margins = [expand_derivatives(r.margin, dict(problem.flow)) for r in problem.conditions.values()]
    found = {s for m in (*margins, *(r.margin for r in problem.where)) for s in m.free_symbols} | {*problem.unknowns}
    if twice := sorted({str(s) for s in found if [*map(str, found)].count(str(s)) > 1}):
        raise InputError(problem.id, twice[0], "names two symbols (with other assumptions): give each its own name")
    if signed := sorted((s for s in found - {*problem.unknowns} if s.is_nonnegative), key=str):
        raise InputError(problem.id, str(signed[0]), "is declared with a sign, and conditions are to hold for all "
                         "real values of the states: declare it real, and state its sign in where")
    return tuple(sorted(found - set(problem.unknowns), key=str))


def families_of(problem: Problem) -> tuple[Family, ...]:
    """The conditions as polynomials with their bases; InputError naming the family that is none of what is solved."""
    states = states_of(problem)
    regions = []
    for number, relation in enumerate(problem.where):
        terms = _terms(problem, f"where[{number}]", relation, states)
        if any(any(c[1:]) for c in terms.values()):
            raise InputError(problem.id, f"where[{number}]", "mentions an unknown: a region is stated by numbers")
        regions.append({e: c[0] for e, c in terms.items() if c[0]})
    if not problem.conditions:
        raise InputError(problem.id, "conditions", "there are none: state at least one inequality")
    found = {name: _terms(problem, name, relation, states) for name, relation in problem.conditions.items()}
    for name, terms in found.items():
        if not any(any(slopes) for slopes in terms.values()):
            raise InputError(problem.id, name, "says 0 >= 0 whatever the unknowns: leave it out")
    return tuple(_family(problem, name, terms, regions) for name, terms in found.items())


def affine(problem: Problem, name: str, expr: sp.Expr) -> tuple[Fraction, ...]:
    """(constant, slopes) of an expression in the unknowns; InputError where it is not affine with exact numbers."""
    try:
        if not problem.unknowns:
            return (fraction(sp.sympify(expr, strict=True)),)
        poly = sp.Poly(expr, *problem.unknowns)
        if poly.total_degree() > 1:
            raise InputError(problem.id, name, f"the unknowns enter {expr} as a product or power: fix one of them, or "
                                               "take new unknowns for the products")
        units = [tuple(int(i == j) for j in range(len(problem.unknowns))) for i in range(len(problem.unknowns))]
        return tuple(fraction(poly.coeff_monomial(e)) for e in ((0,) * len(problem.unknowns), *units))
    except (sp.PolynomialError, TypeError):
        raise InputError(problem.id, name, f"'{expr}' is not affine in the unknowns with exact numbers: write numbers "
                                           "as Fraction or sympy.Rational") from None


def _terms(problem: Problem, name: str, relation: Relation,
           states: tuple[sp.Symbol, ...]) -> dict[Exponents, tuple[Fraction, ...]]:
    if relation.operator not in ("<=", ">="):
        raise InputError(problem.id, name, f"is stated by '{relation.operator}': write at_most or at_least")
    margin = sp.expand(expand_derivatives(relation.margin, dict(problem.flow)))
    if margin.has(sp.nan, sp.zoo, sp.oo):
        raise InputError(problem.id, name, "is not defined: correct the expression")
    if not states:
        return {(): affine(problem, name, margin)}
    try:
        poly = sp.Poly(margin, *states)
    except sp.PolynomialError:
        raise InputError(problem.id, name, "is no polynomial in the states: multiply denominators out, and replace "
                                           "functions by symbols with bounds in `where`") from None
    return {e: affine(problem, name, c) for e, c in poly.terms() if c != 0}


def _family(problem: Problem, name: str, terms: dict[Exponents, tuple[Fraction, ...]], regions: list[Poly]) -> Family:
    size = len(next(iter(terms), ()))
    moving = [g for g in regions if any(any(e) for e in terms)]  # a condition on numbers alone has no region
    blocks = []
    support = set(terms)
    top = 2 * -(-max((sum(e) for e in terms), default=0) // 2)
    for number, weight in enumerate(moving):
        room = max(top - max(sum(e) for e in weight), 0) // 2
        basis = tuple(e for e in product(range(room + 1), repeat=size) if sum(e) <= room)
        blocks.append(Block(number, weight, basis))
        support |= {_plus(_plus(a, b), e) for a, b in combinations_with_replacement(basis, 2) for e in weight}
    main = Block(-1, {(0,) * size: Fraction(1)}, _halves(problem, name, support))
    return Family(name, terms, (main, *blocks))


def _halves(problem: Problem, name: str, support: set[Exponents]) -> tuple[Exponents, ...]:
    """Monomials whose squares and products can make the polynomial, those of no use left out."""
    if not support:
        return ()
    tops = [max(e[i] for e in support) // 2 for i in range(len(next(iter(support))))]
    degrees = [sum(e) for e in support]
    least, most = -(-min(degrees) // 2), max(degrees) // 2
    if sp.prod([top + 1 for top in tops]) > MOST_CANDIDATES:
        raise InputError(problem.id, name, "has too many monomials: lower its degree or the number of its states")
    basis = [e for e in product(*(range(top + 1) for top in tops)) if least <= sum(e) <= most]
    while True:
        crossed = {_plus(a, b) for i, a in enumerate(basis) for b in basis[:i]} | support
        kept = [e for e in basis if _plus(e, e) in crossed]
        if len(kept) == len(basis):
            break
        basis = kept
    if len(basis) > MOST_BASIS:
        raise InputError(problem.id, name, f"needs a Gram matrix of {len(basis)} rows, more than {MOST_BASIS}: split "
                                           "the problem")
    return tuple(basis)


def without_spare(family: Family) -> Family:
    """The family without monomials whose squares, all with one sign, would be a term that it does not have."""
    blocks = family.blocks
    while True:
        single: dict[Exponents, set[tuple[int, Exponents]]] = {}
        other = set(family.terms)
        for place, block in enumerate(blocks):
            for one, two in combinations_with_replacement(block.basis, 2):
                for e, number in block.weight.items():
                    whole = _plus(_plus(one, two), e)
                    if one == two and number > 0:
                        single.setdefault(whole, set()).add((place, one))
                    else:
                        other.add(whole)
        spare = {part for whole, parts in single.items() if whole not in other for part in parts}
        if not spare:
            return replace(family, blocks=blocks)
        blocks = tuple(replace(block, basis=tuple(e for e in block.basis if (place, e) not in spare))
                       for place, block in enumerate(blocks))
