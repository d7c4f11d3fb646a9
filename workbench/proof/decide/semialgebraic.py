"""Read a relation to be shown, and what is known, as polynomials of known sign in one ring.

Denominators of known sign are cleared, functions become generators with the facts that the checker knows of them,
and equalities that give one symbol as a polynomial of the others are substituted. Sums over neurons are left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import sympy as sp
from sympy.polys.rings import PolyRing

from workbench.errors import ClaimError
from workbench.proof.claim import Goal, Relation
from workbench.proof.decide.atoms import Atoms, Item, flatten
from workbench.proof.decide.facts import additions, arctans, circles, tangents
from workbench.proof.decide.laurent import as_fraction, goal_atoms, positive_by_terms
from workbench.proof.decide.situation import Polynomial, Signed, Situation, Substitution
from workbench.proof.derive import SUM, Size
from workbench.proof.text import text

MOST_GENERATORS, MOST_KNOWN = 14, 12

Stated = tuple[tuple[Item, ...], sp.Expr, str]


def read_situation(goal: Goal, shown: Relation, relations: tuple[Relation, ...]) -> Situation | None:
    """The relation and the relations known, at their positions, as polynomials; None when they are not of that kind.

    None also for sums over neurons in the target, for a denominator of unknown sign and for too many symbols.
    """
    atoms = goal_atoms(relations)
    try:
        flat = flatten(shown.margin, atoms, goal.flow)
        if flat.has(SUM):
            return None
        numerator, cleared = _cleared(flat, atoms, relations)
        given = [*_assumptions(goal, relations, atoms), *_facts(goal, relations, atoms)]
    except ClaimError:
        return None
    near, given = _related(numerator.free_symbols, given)
    generators = sorted(near, key=lambda s: (str(s), sp.default_sort_key(s)))
    if not numerator.free_symbols or len(generators) > MOST_GENERATORS:
        return None
    ring = PolyRing(generators, sp.QQ, sp.lex)
    signs: dict[int, tuple[Item, bool]] = {}
    for place, generator in enumerate(generators):
        if generator in atoms.positive:
            signs[place] = (atoms.positive[generator][0], True)
        elif generator in atoms.nonnegative:
            signs[place] = (atoms.nonnegative[generator], False)
    try:
        target = ring.from_expr(sp.expand(numerator))
        known = tuple(Signed(items, ring.from_expr(sp.expand(value)), sign) for items, value, sign in given)
    except (ValueError, sp.CoercionFailed):
        return None
    names = _names(atoms)
    situation = Situation(ring, target, shown.strict, cleared, known, signs,
                          tuple(names.get(g, g) for g in generators), not names)
    situation = _with_substitutions(situation)
    return replace(situation, scales=situation.balance()) if situation.substituted(target) else None


def _names(atoms: Atoms) -> dict[sp.Symbol, sp.Symbol]:
    """What function generators are printed as: `exp(x)` stays itself in powers, as the checker reads it."""
    return {generator: sp.Symbol(text(meaning)) for generator, meaning in atoms.meanings().items()}


def _cleared(flat: sp.Expr, atoms: Atoms, relations: tuple[Relation, ...]) -> tuple[sp.Expr, tuple[Item, ...]]:
    """Numerator and the factor items of the positive denominator; ClaimError when its sign is not known."""
    numerator, denominator = as_fraction(flat)
    items: list[Item] = []
    for margin, position in atoms.strict:
        while denominator.has(*margin.free_symbols):
            quotient = sp.cancel(denominator / margin)
            if not quotient.is_polynomial(*quotient.free_symbols):
                break
            denominator, items = quotient, [*items, {"assume": position}]
    constant, whole = denominator.primitive()
    factors = [(whole, 1)]
    if not positive_by_terms(whole, atoms):
        constant, factors = sp.factor_list(denominator)
    numerator, names = numerator / constant, _names(atoms)
    for factor, power in factors:
        if factor == 1:
            continue
        sign = next((s for s in (1, -1) if positive_by_terms(s * factor, atoms)), 0)
        if sign:
            items += [{"positive": text((sign * factor).xreplace(names))}] * power
            numerator *= sign**power
        else:
            position, scale = _nonzero(factor, atoms, relations)
            half = (power + 1) // 2
            items += [{"square_of": position}] * half
            numerator *= factor ** (2 * half - power) * scale ** (2 * half)
    return numerator, tuple(items)


def _nonzero(factor: sp.Expr, atoms: Atoms, relations: tuple[Relation, ...]) -> tuple[int, sp.Expr]:
    """Position of an assumption that a factor is not zero, and its margin divided by the factor, a number."""
    for position, relation in enumerate(relations):
        if relation.operator == "!=":
            scale = sp.cancel(flatten(relation.margin, atoms, {}) / factor)
            if scale.is_Rational and scale != 0:
                return position, scale
    raise ClaimError(f"the denominator {factor} is not assumed positive: state its sign in the goal")


def _assumptions(goal: Goal, relations: tuple[Relation, ...], atoms: Atoms) -> Iterator[Stated]:
    """(items, polynomial, sign) of assumptions that are more than the sign of a symbol."""
    for position, relation in enumerate(relations):
        if relation.operator not in ("==", "!=") and relation.margin.is_Symbol:
            continue
        try:
            flat = flatten(relation.margin, atoms, goal.flow)
            if flat.has(SUM) or flat.is_number:
                continue
            value, cleared = _cleared(flat, atoms, relations)
        except ClaimError:
            continue
        if relation.operator == "!=":
            yield ({"square_of": position}, *cleared, *cleared), value**2, ">"
        else:
            sign = relation.operator if relation.operator == "==" else ">" if relation.strict else ">="
            yield ({"assume": position}, *cleared), value, sign


def _facts(goal: Goal, relations: tuple[Relation, ...], atoms: Atoms) -> Iterator[Stated]:
    """(items, polynomial, sign) of angles' circles, squares of roots and sizes, and then of tangents of functions."""
    bounds: list[Stated] = []
    for fact, argument, excess in tangents(goal, atoms):  # these may add functions, of which the others speak too
        try:
            value, cleared = _cleared(flatten(excess, atoms, {}), atoms, relations)
        except ClaimError:
            continue
        bounds.append((({"fact": fact, "of": text(argument)}, *cleared), value, ">="))
    equalities = [(item, zero, "==") for item, zero in (*circles(atoms), *additions(atoms))]
    for item, stated, sign in (*equalities, *arctans(atoms)):
        try:
            value, cleared = _cleared(stated, atoms, relations)
        except ClaimError:
            continue
        yield (item, *cleared), value, sign
    for root, (itself, square) in list(atoms.squares.items()):
        inner = flatten(itself.args[0], atoms, {})
        if inner.has(SUM):
            continue
        try:
            value, cleared = _cleared(root**2 - (inner**2 if isinstance(itself, Size) else inner), atoms, relations)
        except ClaimError:
            continue
        yield (square, *cleared), value, "=="
    yield from bounds


def _related(symbols: set[sp.Symbol], given: list[Stated]) -> tuple[set[sp.Symbol], list[Stated]]:
    """The symbols of the target and of everything known that shares one with it, directly or not, and that.

    What would make too many of them is left out, the farther first.
    """
    near, kept = set(symbols), [False] * len(given)
    for _ in given:
        reached = set(near)
        for i, (_, value, _) in enumerate(given):
            fits = len(reached | value.free_symbols) <= MOST_GENERATORS and sum(kept) < MOST_KNOWN
            if value.free_symbols & near and fits and not kept[i]:
                kept[i] = True
                reached |= value.free_symbols
        if reached == near:
            break
        near = reached
    return near, [g for g, keep in zip(given, kept, strict=True) if keep]


def _with_substitutions(situation: Situation) -> Situation:
    """The situation with every generator substituted that an equality gives as a polynomial of the others."""
    ring, zeros = situation.ring, tuple(k for k in situation.known if k.sign == "==")
    situation, used = replace(situation, zeros=zeros), []
    for zero in zeros:
        current = situation.substituted(zero.value)
        place = next((i for i, g in enumerate(ring.gens) if current.degree(g) == 1 and current.diff(g).is_ground
                      and (i not in situation.signs or _seen_positive(g - current / current.diff(g).LC, situation))),
                     None)
        if place is None:
            continue
        # current = zero - (what the substitutions so far contribute), which is a combination of equalities as well.
        cofactors, rest = [ring.one if z is zero else ring.zero for z in zeros], zero.value
        for s in situation.substitutions:
            after = rest.compose(ring.gens[s.place], s.value)
            quotient = (rest - after).exquo(s.difference)
            cofactors = [c - quotient * o for c, o in zip(cofactors, s.cofactors, strict=True)]
            rest = after
        slope = current.diff(ring.gens[place]).LC
        substitution = Substitution(place, ring.gens[place] - current / slope, current / slope,
                                    tuple(c / slope for c in cofactors))
        situation = replace(situation, substitutions=(*situation.substitutions, substitution))
        used.append(zero)
    return replace(situation, known=tuple(k for k in situation.known if k not in used))


def _seen_positive(value: Polynomial, situation: Situation) -> bool:
    """Whether a polynomial is one term whose sign is seen, so that a generator of known sign may make way for it."""
    return len(value) == 1 and value.LC > 0 and all(
        n % 2 == 0 or situation.signs.get(i, ({}, False))[1] for i, n in enumerate(next(iter(value))))
