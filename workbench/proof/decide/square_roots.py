"""Roots of squares, of which sympy makes sizes: sqrt(x**2/2) is abs(x)/sqrt(2), as in D(V) <= -k sqrt(2) sqrt(V).

A relation is proved as sympy has it; the checker is told that first, then what each root is, and takes both together.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import sympy as sp

from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.two_sides import between
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import assumptions, relation_text, text
from workbench.proof.typed import evaluated

Proof = dict[str, Any]
Step = tuple[str, Proof]  # a lemma and what shows it
MOST_BITS = 64  # of a number below a root, which is taken apart into its factors


@dataclass(frozen=True)
class Root:
    """sqrt(inner) == times * sqrt(number) * abs(size), number whole and without square factors."""

    inner: sp.Expr
    times: sp.Rational
    number: int
    size: sp.Expr

    @property
    def own_text(self) -> str:
        """The root as the checker reads it."""
        return f"sqrt({text(self.inner)})"

    @property
    def other_text(self) -> str:
        """What it is, as the checker reads it."""
        return "*".join([f"({self.times})", *([f"sqrt({self.number})"] if self.number > 1 else []),
                         f"abs({text(self.size)})"])


def with_roots_of_squares(goal: Goal, usual: Goal, proofs: list[Proof]) -> list[Proof]:
    """The proofs of a goal as sympy has it, `usual`, made ones of the goal as it is typed where roots of squares stand
    in what it shows."""
    return [_as_typed(goal, usual, place, proof) or proof for place, proof in enumerate(proofs)]


def _as_typed(goal: Goal, usual: Goal, place: int, proof: Proof) -> Proof | None:
    typed, plain = (_carried(one.show[place], one) for one in (goal, usual))
    roots = list(_roots_in(typed))
    if not roots:
        return None
    numbers = {n: _mark("number", n) for n in sorted({*(r.number for r in roots), *_numbers_in(typed)} - {1})}
    sizes = {root.size: _mark("size", root.size) for root in roots}
    names = {**{mark.name: f"sqrt({n})" for n, mark in numbers.items()},
             **{mark.name: f"abs({text(size)})" for size, mark in sizes.items()},
             **{_mark("root", root.inner).name: root.own_text for root in roots}}
    rest = sp.expand(_marked(typed, numbers, sizes, roots) - _marked(plain, numbers, sizes, []))
    first = len(assumptions(goal))
    terms: list[dict[str, Any]] = [{"coefficient": "1", "factors": [{"assume": first}]}]
    steps: list[Step] = [(relation_text(usual.show[place]), proof)]
    for root in roots:
        steps += _what_it_is(root, first + len(steps))
        mark, value = _mark("root", root.inner), root.times * numbers.get(root.number, 1) * sizes[root.size]
        if not rest.is_polynomial(mark, *sizes.values(), *numbers.values()):
            return None  # a root below a fraction bar, or within a function
        cofactor, rest = sp.div(rest, mark - value, mark)
        terms += _multiple(cofactor, {"assume": first + len(steps) - 1}, names)
    for size, mark in sizes.items():
        cofactor, rest = sp.div(rest, mark**2 - size**2, mark)
        terms += _multiple(cofactor, {"fact": "abs_square", "of": text(size)}, names)
    for n, mark in numbers.items():
        cofactor, rest = sp.div(rest, mark**2 - n, mark)
        terms += _multiple(cofactor, {"fact": "sqrt_square", "of": str(n)}, names)
    if sp.expand(rest) != 0:
        return None
    final: Proof = {"rule": "combination", "terms": terms}
    for lemma, shown_by in reversed(steps):
        final = {"rule": "cut", "lemma": lemma, "proof": shown_by, "then": final}
    return final


def _mark(kind: str, of: Any) -> sp.Symbol:
    """What stands for a root or a size while terms are collected; no symbol of a claim is called so."""
    return sp.Symbol(f"{kind} {of}", positive=True)


def _carried(relation: Relation, goal: Goal) -> Relation:
    return Relation(expand_derivatives(relation.left, goal.flow), relation.operator,
                    expand_derivatives(relation.right, goal.flow))


def _roots_in(relation: Relation) -> Iterator[Root]:
    """Roots of what is a number times a square, in a fixed order."""
    inside = {power.base for side in (relation.left, relation.right) for power in side.atoms(sp.Pow)
              if power.exp.is_Rational and power.exp.q == 2 and power.base.free_symbols}
    for inner in sorted(inside, key=sp.default_sort_key):
        plain = evaluated(inner)
        if not plain.is_polynomial(*plain.free_symbols):
            continue
        number, factors = sp.factor_list(plain)
        if factors and number.is_Rational and number > 0 and all(power % 2 == 0 for _, power in factors) and max(
                number.p, number.q).bit_length() <= MOST_BITS:
            whole = sp.sqrt(number.p * number.q)  # sqrt(p/q) == sqrt(p q)/q
            times, root = whole.as_coeff_Mul()
            size = sp.Mul(*(base ** (power // 2) for base, power in factors))
            yield Root(inner, times / number.q, int(root**2), size)


def _numbers_in(relation: Relation) -> set[int]:
    """Whole numbers of which a root is taken."""
    return {int(power.base) for side in (relation.left, relation.right) for power in side.atoms(sp.Pow)
            if power.base.is_Integer and power.exp == sp.S.Half and power.base > 0}


def _marked(relation: Relation, numbers: dict[int, sp.Symbol], sizes: dict[sp.Expr, sp.Symbol],
            roots: list[Root]) -> sp.Expr:
    """The margin with symbols in the place of roots and sizes."""
    inside = {root.inner: _mark("root", root.inner) for root in roots}
    of_size = {sp.Abs(sign * size): mark for size, mark in sizes.items() for sign in (1, -1)}

    def replaced(side: sp.Expr) -> sp.Expr:
        powers = {power: inside[power.base] ** (2 * power.exp) for power in side.atoms(sp.Pow)
                  if power.base in inside and power.exp.is_Rational and power.exp.q == 2}
        plain = evaluated(side.xreplace(powers)).replace(
            lambda e: e.is_Pow and e.base in numbers and e.exp.is_Rational and e.exp.q == 2,
            lambda e: numbers[e.base] ** (2 * e.exp))
        return plain.xreplace(of_size)

    return Relation(replaced(relation.left), relation.operator, replaced(relation.right)).margin


def _multiple(cofactor: sp.Expr, factor: dict[str, Any], names: dict[str, str]) -> list[dict[str, Any]]:
    """The term of a combination that is the cofactor times what is zero."""
    if cofactor == 0:
        return []
    said = text(cofactor)
    for name in sorted(names, key=len, reverse=True):  # one may begin another
        said = said.replace(name, names[name])
    return [{"coefficient": "1", "factors": [factor, {"any": said}]}]


def _what_it_is(root: Root, place: int) -> list[Step]:
    """What shows that a root is what it is, with `place` hypotheses before it; the last of these lemmas says so.

    Were q > s, of q = sqrt(inner) and s = times sqrt(number) abs(size), then (q - s)**2 + 2 s (q - s) = q**2 - s**2 = 0
    would be positive; likewise were q < s.
    """
    number = {"fact": "sqrt_nonnegative", "of": str(root.number)}
    s = [{"fact": "abs_nonnegative", "of": text(root.size)}, *([number] if root.number > 1 else [])]
    q = [{"fact": "sqrt_nonnegative", "of": text(root.inner)}]
    weight = root.times**2 * root.number
    squares: list[tuple[sp.Expr, list[dict[str, Any]]]] = [
        (sp.Integer(1), [{"fact": "sqrt_square", "of": text(root.inner)}]),
        (-weight, [{"fact": "abs_square", "of": text(root.size)}])]
    if root.number > 1:
        squares.append((-root.times**2, [{"fact": "sqrt_square", "of": str(root.number)},
                                         {"any": f"abs({text(root.size)})**2"}]))
    # The checker sees by itself that x**2/2 is not negative, and not that (x + y)**2/2 is none.
    steps: list[Step] = [(f"{text(root.inner)} >= 0", {"rule": "combination", "terms": [
        {"coefficient": str(weight), "factors": [{"square": text(root.size)}]}]})]
    place += 1
    for operator, sign, factors, twice in (("<=", -1, s, 2 * root.times), (">=", 1, q, sp.Integer(2))):
        negation = {"assume": place + len(steps) - 1}
        terms = [(sp.Integer(1), [negation, negation]), (twice, [negation, *factors]),
                 *((sign * each, fact) for each, fact in squares)]
        steps.append((f"{root.own_text} {operator} {root.other_text}", {"rule": "contradiction", "terms": [
            {"coefficient": str(coefficient), "factors": each} for coefficient, each in terms]}))
    return [*steps, (f"{root.own_text} == {root.other_text}", between(place, place + 1, place + 2))]
