"""Decide an inequality between polynomials as a sum of squares, weighted by what is assumed.

multiplier * target = sum_k weight_k * (sum of squares) + multiples of equalities, after denominators of known sign
are cleared. Weights are assumptions and their products; a short list of multipliers is tried, and of polytopes
within which monomials are taken, small ones first. What is returned is only a proposal: the certificate counts
when `checker.py` has re-checked it.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import combinations, combinations_with_replacement
from math import gcd, lcm
from typing import Any

import numpy as np
import sympy as sp
from sympy.polys.rings import PolyRing

from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Item
from workbench.proof.decide.gram import Block, Program, Shape, TooLargeError, Weight, assemble, support
from workbench.proof.decide.rounding import Rows, Solution, solve
from workbench.proof.decide.semialgebraic import read_situation
from workbench.proof.decide.situation import Polynomial, Signed, Situation
from workbench.proof.decide.zeros import kernel_vectors, rational_zeros

MOST_MULTIPLIERS, MOST_STRICT, MOST_PRODUCTS, MOST_TRADED = 12, 24, 20, 100
MOST_TERMS, MOST_WORK = 250, 5_000  # terms of a target; unknowns of all programs tried for it


Multiplier = tuple[tuple[Item, ...], Polynomial]  # factor items, and their product


def find_squares(goal: Goal, shown: Relation, relations: tuple[Relation, ...]) -> dict[str, Any] | None:
    """A proof by weighted squares for one relation from `relations`, in the order the checker sees them, or None."""
    if shown.operator in ("==", "!="):
        return None
    try:
        return _search(goal, shown, relations)
    except OverflowError:  # numbers that floating point cannot hold
        return None


def _search(goal: Goal, shown: Relation, relations: tuple[Relation, ...]) -> dict[str, Any] | None:
    situation = read_situation(goal, shown, relations)
    if situation is None or situation.false_somewhere():
        return None
    zeros = cache(lambda: rational_zeros(situation))

    def kernels(block: Block) -> Rows:
        return kernel_vectors(situation, zeros(), block)

    work = 0
    for multiplier, program in _programs(situation):
        work += len(program.columns)
        if work > MOST_WORK:
            return None
        solution = solve(program, situation.strict, kernels)
        if solution is not None:
            proof = _proof(situation, multiplier, solution, program)
            if proof is not None:
                return proof
    return None


def _programs(situation: Situation) -> Iterator[tuple[Multiplier, Program]]:
    """Multipliers and programs worth trying, cheap ones first; the same program is given only once."""
    ring = situation.ring
    known = [k for k in situation.known if situation.substituted(k.value)]
    zeros = [_weight(situation, k) for k in known if k.sign == "=="]
    signed = [k for k in known if k.sign != "==" and not situation.substituted(k.value).is_ground]
    one = Signed((), ring.one, ">")
    several = [_product(some, ring) for count in (2, 3) for some in combinations(signed, count)][:MOST_PRODUCTS]
    squared = [_product((k, k), ring) for k in signed if k.sign == ">"]
    seen = set()
    constrained = bool(signed or zeros)
    for multiplier, level in _order(_multipliers(situation, constrained), constrained):
        factors = [one, *signed, *several] if level >= 3 else [one, *signed]
        if multiplier[0] and level == 1:  # what it takes to make the target a square is often wanted beside others too
            factors += [_product((Signed(*multiplier, ">"), factor), ring) for factor in signed]
        weights = [_weight(situation, f) for f in factors]
        target = situation.rooted(situation.substituted(multiplier[1] * situation.target))
        if len(target) > MOST_TERMS:
            continue
        shape = Shape(_extent(target, [*weights[1:], *zeros], level))
        try:
            strict = _strict_weights(situation, [one, *signed, *several, *squared], shape) if situation.strict else []
            program = assemble(ring, target, [*weights, *strict], zeros, shape)
        except TooLargeError:
            continue
        key = program and (frozenset(target.terms()), len(program.multiples),
                           *((repr(b.weight.items), b.basis) for b in program.blocks))
        if program is not None and key not in seen:
            seen.add(key)
            yield multiplier, program


def _product(factors: tuple[Signed, ...], ring: PolyRing) -> Signed:
    """The product of what is known positive or non-negative."""
    strict = all(f.sign == ">" for f in factors)
    return Signed(tuple(i for f in factors for i in f.items), sp.prod([f.value for f in factors], ring.one),
                  ">" if strict else ">=")


def _order(multipliers: list[Multiplier], constrained: bool) -> list[tuple[Multiplier, int]]:
    """(multiplier, level) in the order they are tried; without constraints there is one level."""
    if not constrained:
        return [(m, 0) for m in multipliers]
    first, *others = multipliers
    return [(first, 0), (first, 1), *((m, level) for m in others for level in (0, 1)),
            (first, 2), (first, 3), *((m, 2) for m in others), (first, 4)]


def _extent(target: Polynomial, weights: list[Weight], level: int) -> np.ndarray:
    """Exponents whose polytope bounds a program, of shape (points, generators).

    0: those of the target; 1: also what takes their place when a term of a weight is traded for another one of it;
    2: traded twice; 3: also those of the weights themselves; 4: also two degrees more.
    """
    extent = support([target])
    supports = [support([weight.value]) for weight in weights if len(weight.value) > 1]
    for _ in range((0, 1, 2, 1, 1)[level]):
        if len(extent) <= MOST_TRADED:
            extent = np.unique(np.concatenate([extent, *(_traded(extent, terms) for terms in supports)]), axis=0)
    if level >= 3:
        extent = np.unique(np.concatenate([extent, *supports, np.zeros_like(extent[:1])]), axis=0)
    if level == 4:
        steps = 2 * np.diag(extent.any(axis=0).astype(np.int64))
        extent = np.concatenate([extent, *(extent + step for step in steps)])
    return extent


def _traded(extent: np.ndarray, terms: np.ndarray) -> np.ndarray:
    """Exponents in which one term of a weight is replaced by another."""
    without = (extent[:, None] - terms[None]).reshape(-1, extent.shape[1])
    without = without[np.all(without >= 0, axis=1)]
    return (without[:, None] + terms[None]).reshape(-1, extent.shape[1])


def _weight(situation: Situation, known: Signed) -> Weight:
    return Weight(known.items, situation.rooted(situation.substituted(known.value)), known.value)


def _multipliers(situation: Situation, constrained: bool) -> list[Multiplier]:
    """1, what is known positive and shares a symbol with the target, the sum of its symbols' squares, and products."""
    ring = situation.ring
    own = sorted({i for e in situation.target for i, n in enumerate(e) if n})
    # A positive symbol counts without the square; with none, the sum needs a 1 in order to be positive.
    spread = sum((ring.gens[i] ** (1 if i in situation.signs else 2) for i in own), ring.zero)
    if not any(situation.signs.get(i, ({}, False))[1] for i in own):
        spread += ring.one
    positive: list[Multiplier] = [(({"positive": situation.text(spread)},), spread)]
    strict = [i for i in own if situation.signs.get(i, ({}, False))[1]]
    if constrained and len(strict) > 1:
        weight = sum((ring.gens[i] for i in strict), ring.zero)
        positive.append((({"positive": situation.text(weight)},), weight))
    if constrained:  # a symbol alone helps to trade terms, but makes no sum of squares of what is none
        positive += [((item,), ring.gens[i]) for i, (item, strict) in situation.signs.items() if strict and i in own]
        positive += [(k.items, k.value) for k in situation.known
                     if k.sign == ">" and any(e[i] for e in k.value for i in own)]
    products = [((*a[0], *b[0]), a[1] * b[1]) for a, b in combinations_with_replacement(positive, 2)]
    positive.sort(key=lambda m: len(m[1]))
    products.sort(key=lambda m: len(m[1]))
    return [((), ring.one), *positive, *products][:MOST_MULTIPLIERS]


def _strict_weights(situation: Situation, factors: list[Signed], shape: Shape) -> list[Weight]:
    """Positive factors times monomials of positive symbols, inside the shape."""
    weights: list[Weight] = []
    for factor in (f for f in factors if f.sign == ">"):
        for m in shape.bases(situation.rooted(situation.substituted(factor.value)), 1):
            powers = [(i, int(n) // 2) for i, n in enumerate(m) if n]
            if all(i in situation.signs and situation.signs[i][1] and m[i] % 2 == 0 for i, _ in powers):
                items = [situation.signs[i][0] for i, n in powers for _ in range(n)]
                stated = factor.value * sp.prod([situation.ring.gens[i] ** n for i, n in powers])
                value = situation.rooted(situation.substituted(stated))
                weights.append(Weight((*factor.items, *items), value, stated, strict=True))
    return weights[:MOST_STRICT]


def _proof(situation: Situation, multiplier: Multiplier, solution: Solution,
           program: Program) -> dict[str, Any] | None:
    """The certificate of a solution, or None when it does not add up after all."""
    ring = situation.ring
    rest = multiplier[1] * situation.target
    terms: list[dict[str, Any]] = []
    for square in solution.squares:
        odd, root = situation.unrooted(square.root)
        root, content = _primitive(root)
        coefficient = square.coefficient * content**2
        factors = [*square.block.weight.items, *(situation.signs[i][0] for i in odd)]
        if root != ring.one:
            factors.append({"square": situation.text(root)})
        same = next((t for t in terms if t["factors"] == factors), None)
        if same is None:
            terms.append({"coefficient": str(coefficient), "factors": factors})
        else:
            same["coefficient"] = str(Fraction(same["coefficient"]) + coefficient)
        rest -= _exact(coefficient) * square.block.weight.stated * root**2 * sp.prod([ring.gens[i] for i in odd])
    multiples: dict[str, tuple[tuple[Item, ...], Polynomial]] = {}
    for factor, multiple in zip(solution.factors, program.multiples, strict=True):
        monomial = situation.unrooted(multiple.monomial)[1] * _exact(factor)
        zero = multiple.zero
        multiples[repr(zero.items)] = zero.items, multiples.get(repr(zero.items), ((), ring.zero))[1] + monomial
        rest -= monomial * zero.stated
    substituted = situation.multiples(rest)
    if substituted is None:
        return None
    for zero_items, factor in (*multiples.values(), *substituted):
        if factor:
            terms.append({"coefficient": "1", "factors": [*zero_items, {"any": situation.text(factor)}]})
    proof: dict[str, Any] = {"rule": "combination", "terms": terms}
    scale = [*multiplier[0], *situation.multiplier]
    return {**proof, "multiplier": scale} if scale else proof


def _primitive(root: Polynomial) -> tuple[Polynomial, Fraction]:
    """A polynomial with whole coefficients, coprime and the first positive, and the number that was taken out."""
    numbers = [Fraction(int(c.numerator), int(c.denominator)) for c in root.coeffs()]
    content = Fraction(gcd(*(c.numerator for c in numbers)), lcm(*(c.denominator for c in numbers)))
    content = content if root.LC > 0 else -content
    return root / _exact(content), content


def _exact(value: Fraction) -> Any:
    return sp.QQ(*value.as_integer_ratio())
