"""Decide an inequality as a non-negative combination of what is assumed, of squares, and of tangent facts.

A linear program over products of assumptions, monomials of known sign and squares of binomials proposes the
combination; its support is then solved exactly over the rationals. What is returned is only a proposal: the
certificate counts when `checker.py` has re-checked it.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import reduce
from itertools import combinations_with_replacement
from math import prod
from typing import Any

import numpy as np
import sympy as sp
from scipy.sparse import csc_array
from sympy.polys.matrices import DomainMatrix

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Atoms, flatten
from workbench.proof.decide.facts import known_facts
from workbench.proof.decide.laurent import (
    Exponents,
    Laurent,
    add,
    goal_atoms,
    multiply,
    ratio_of,
    reduce_inverses,
    shift,
    to_laurent,
    trim,
    unreduced,
)
from workbench.proof.decide.linear_program import least
from workbench.proof.decide.unwritten import (
    Candidate,
    Factor,
    any_monomial,
    binomial_square,
    candidate,
    monomial,
    written,
)
from workbench.proof.derive import SUM
from workbench.proof.text import text

MAX_COLUMNS = 6_000
MAX_PRODUCT = 12
MANY_SIGNED = 8  # of more, no products of three are taken
# (rounds of multiplication, factors of products of assumptions, monomials that z s = 1 hides), cheap ones first
ATTEMPTS = ((1, 1, False), (1, 2, False), (1, 1, True), (2, 1, False), (2, 2, False), (2, 3, False))
SUPPORT_TOLERANCE = 1e-9
COUNT: Exponents = (-99,)  # no monomial of any goal


def find_combination(goal: Goal, shown: Relation, relations: tuple[Relation, ...],
                     quick: bool = False) -> dict[str, Any] | None:
    """A proof by combination for one relation from `relations`, in the order the checker sees them, or None.

    quick: only the cheapest attempt.
    """
    if shown.operator == "!=":
        return None
    atoms = goal_atoms(relations)
    try:
        target = to_laurent(flatten(shown.margin, atoms, goal.flow), atoms)
        known = [candidate(fact) for fact in known_facts(goal, relations, atoms)]
    except ClaimError:
        return None
    for rounds, factors, hidden in ATTEMPTS[:1] if quick else ATTEMPTS:
        terms = _candidates(target, known, atoms, rounds, factors, hidden)
        if shown.operator == "==":  # what is not negative would show no more than that
            terms = [term for term in terms if term.sign == "=="]
        if len(terms) <= MAX_COLUMNS:
            try:
                chosen = _solve(target, terms, shown.strict)
            except OverflowError:  # numbers that floating point cannot hold
                return None
            if chosen is not None:
                return {"rule": "combination", "terms": [
                    {"coefficient": str(c), "factors": written(term.items)} for c, term in chosen]}
    return None


def _strict(exponents: Exponents, atoms: Atoms) -> bool:
    return all(power == 0 or g in atoms.positive for g, power in zip(atoms.generators, exponents, strict=False))


def _candidates(target: Laurent, known: list[Candidate], atoms: Atoms, rounds: int,
                factors: int, hidden: bool) -> list[Candidate]:
    """Terms of known sign that could add up to the target."""
    pool = list(known)
    sum_place = atoms.generators.index(SUM)
    signed = [k for k in known if k.items and k.sign != "==" and not any(
        e[sum_place] for e in k.value if len(e) > sum_place)]
    for count in range(2, factors + 1):
        if count > 2 and len(signed) > MANY_SIGNED:
            break
        for several in combinations_with_replacement(signed, count):
            if prod(len(k.value) for k in several) <= MAX_PRODUCT:
                sign = ">" if all(k.sign == ">" for k in several) else ">="
                value = reduce(lambda one, two: reduce_inverses(multiply(one, two), atoms), (k.value for k in several))
                pool.append(Candidate(tuple(item for k in several for item in k.items), value, sign))
    # Nothing to aim at: a contradiction among the assumptions themselves.
    support = (set(target) or {e for k in known for e in k.value}) | (unreduced(target, atoms) if hidden else set())
    terms: dict[tuple[str, ...], Candidate] = {}
    for _ in range(rounds):
        fresh: list[Candidate] = []
        for base in pool:
            aimed = {ratio_of(wanted, own) for wanted in support for own in base.value}
            for by in sorted(aimed if target else aimed | {()}):  # products may cancel among themselves
                fresh += _scaled(base, by, atoms, terms)
            if len(terms) > MAX_COLUMNS:
                return list(terms.values())
        fresh += _binomial_squares(target, support, atoms, terms)
        support |= {e for term in fresh for e in term.value}
    return list(terms.values())


def _scaled(base: Candidate, by: Exponents, atoms: Atoms, seen: dict[tuple[str, ...], Candidate]) -> list[Candidate]:
    """base times a monomial, when that has a known sign."""
    sum_place = atoms.generators.index(SUM)
    sums = by[sum_place] if len(by) > sum_place else 0
    if sums and (sums != 1 or any(e[sum_place] for e in base.value if len(e) > sum_place)):
        return []
    if base.sign == "==":
        items: tuple[Factor, ...] | None = (any_monomial(by, atoms),) if by else ()
        if any((p and g in atoms.indexed | {SUM}) or (p < 0 and g not in atoms.positive)
               for g, p in zip(atoms.generators, by, strict=False)):
            return []
    elif sums:
        items = _sum_of_squares(by, atoms)
    else:
        items = monomial(by, atoms)
    if items is None:
        return []
    key = tuple(sorted(map(str, (*base.items, *items))))
    if key in seen:
        return []
    sign = base.sign if base.sign != ">" or _strict(by, atoms) else ">="
    term = Candidate((*base.items, *items), reduce_inverses(shift(base.value, by), atoms), sign)
    seen[key] = term
    return [term]


def _sum_of_squares(exponents: Exponents, atoms: Atoms) -> tuple[Factor, ...] | None:
    """Items of SUM times an even monomial of indexed symbols times a scalar monomial of known sign."""
    scalar, root = list(exponents), sp.Integer(1)
    for i, (generator, power) in enumerate(zip(atoms.generators, exponents, strict=False)):
        if generator == SUM:
            scalar[i] = 0
        elif generator in atoms.indexed and power:
            if power % 2 or power < 0:
                return None
            root *= generator ** (power // 2)
            scalar[i] = 0
    items = monomial(tuple(scalar), atoms)
    return None if items is None else ({"sum_of_squares": text(root)}, *items)


def _binomial_squares(target: Laurent, support: set[Exponents], atoms: Atoms,
                      seen: dict[tuple[str, ...], Candidate]) -> list[Candidate]:
    """c (p + r q)^2 for monomials c p^2 and c q^2 in the support, c of known sign."""
    size, sum_place = len(atoms.generators), atoms.generators.index(SUM)
    # c keeps the odd powers of positive atoms; everything else is halved into p and q.
    signed = [g == SUM or g in atoms.positive or g in atoms.nonnegative for g in atoms.generators]
    halved = [g in atoms.indexed and g != SUM and g not in atoms.positive for g in atoms.generators]
    fresh = []
    alike: dict[tuple[Exponents, int], list[Exponents]] = {}
    wide = [e + (0,) * (size - len(e)) for e in sorted(support)]
    kinds = [(tuple(n % 2 for n in e), e[sum_place]) for e in wide]
    for e, kind in zip(wide, kinds, strict=True):
        alike.setdefault(kind, []).append(e)
    for one, kind in zip(wide, kinds, strict=True):
        del alike[kind][0]  # itself: each pair once
        for two in alike[kind]:
            c = tuple(0 if not s else x - x % 2 if h else x for x, s, h in zip(map(min, one, two), signed, halved,
                                                                               strict=True))
            if any((x - y) % 2 for x, y in zip(one, c, strict=True)):  # as in the other
                continue
            p, q = (tuple((x - y) // 2 for x, y in zip(e, c, strict=True)) for e in (one, two))
            items = monomial(tuple(0 if i == sum_place else x for i, x in enumerate(c)), atoms)
            if items is None or min((*p, *q)) < 0:
                continue
            first, second, cross = trim(one), trim(two), trim(tuple(map(sum, zip(p, q, c, strict=True))))
            for ratio in _ratios(target, first, second, cross):
                square = binomial_square(p, q, ratio, c[sum_place] == 1, atoms)
                key = tuple(sorted(map(str, (square, *items))))
                if key in seen:
                    continue
                value = add({first: Fraction(1), second: ratio**2}, {cross: 2 * ratio})
                seen[key] = Candidate((square, *items), reduce_inverses(value, atoms), ">=")
                fresh.append(seen[key])
    return fresh


def _ratios(target: Laurent, one: Exponents, two: Exponents, cross: Exponents) -> list[Fraction]:
    """Weights r worth trying in (p + r q)^2: +-1, and those that complete the target's own squares."""
    found = [Fraction(1), Fraction(-1)]
    mixed = target.get(cross, Fraction(0))
    if mixed:
        found += [mixed / (2 * target[one])] if target.get(one) else []
        found += [2 * target[two] / mixed] if target.get(two) else []
    return list(dict.fromkeys(found))


def _solve(target: Laurent, terms: list[Candidate], strict: bool) -> list[tuple[Fraction, Candidate]] | None:
    """Coefficients with sum c_i term_i = target, exact; c_i >= 0 except for terms that are zero."""
    if not target and strict:  # a contradiction, of which any multiple would do: its strict terms count 1 together
        counted = [replace(t, value=t.value | {COUNT: Fraction(1)}) if t.sign == ">" else t for t in terms]
        return _solve({COUNT: Fraction(1)}, counted, False)
    rows = {e: i for i, e in enumerate(sorted({*target, *(e for t in terms for e in t.value)}))}
    entries = [(rows[e], j, float(c)) for j, t in enumerate(terms) for e, c in t.value.items()]
    if not entries:
        return [] if not target and not strict else None
    i, j, values = (np.array(x) for x in zip(*entries, strict=True))
    matrix = csc_array((values, (i, j)), shape=(len(rows), len(terms)))
    right = np.zeros(len(rows))
    for e, c in target.items():
        right[rows[e]] = float(c)
    limits: list[tuple[int | None, float | None]] = [(None, None) if t.sign == "==" else (0, None) for t in terms]
    cost = np.array([1.0 + len(t.items) for t in terms])
    if strict:  # prefer strictly positive terms so much that one is used whenever one can be
        largest = 1e3 * max(1.0, *(abs(float(c)) for c in target.values()))
        cost = cost - np.array([1e3 if t.sign == ">" else 0.0 for t in terms])
        limits = [(low, largest if low == 0 else None) for low, _ in limits]
    answer = least(cost, matrix, right, limits)
    if answer.status == 3:  # equalities that add up to nothing: leave them out of the cost, which has no least value
        free = np.array([t.sign == "==" for t in terms])
        answer = least(np.where(free, 0.0, cost), matrix, right, limits)
    if answer.status != 0:
        return None
    support = [k for k, c in enumerate(answer.x) if abs(c) > SUPPORT_TOLERANCE]
    exact = _exact(target, [terms[k] for k in support], rows)
    if exact is None or any(c < 0 and terms[k].sign != "==" for k, c in zip(support, exact, strict=True)):
        return None
    chosen = [(c, terms[k]) for k, c in zip(support, exact, strict=True) if c]
    if strict and not any(t.sign == ">" for _, t in chosen):
        return None
    return chosen


def _exact(target: Laurent, terms: list[Candidate], rows: dict[Exponents, int]) -> list[Fraction] | None:
    """The exact solution on a support, or None; free columns are set to zero."""
    used = sorted({e for t in terms for e in t.value} | set(target), key=rows.__getitem__)
    if not terms:
        return [] if not target else None
    table = [[sp.QQ(*(t.value.get(e, Fraction(0)).as_integer_ratio())) for t in terms]
             + [sp.QQ(*target.get(e, Fraction(0)).as_integer_ratio())] for e in used]
    reduced, pivots = DomainMatrix(table, (len(used), len(terms) + 1), sp.QQ).rref()
    if len(terms) in pivots:
        return None
    solution = [Fraction(0)] * len(terms)
    for row, column in enumerate(pivots):
        value = reduced[row, len(terms)].element
        solution[column] = Fraction(int(value.numerator), int(value.denominator))
    return solution
