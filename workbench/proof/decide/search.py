"""Search a proof of one relation: identity, cases of abs and sign, lemmas, combination, sums of squares."""

from __future__ import annotations

from typing import Any

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater
from workbench.proof.decide.case_roots import apart, has_root_of_size, not_negative, with_root
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.cuts import after
from workbench.proof.decide.first_lemmas import definedness, first_lemmas, roots_below
from workbench.proof.decide.growth import EMPTY, GROWING, find_by_growth, find_by_growth_both_ways
from workbench.proof.decide.ideals import find_by_ideal
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.log_products import find_by_log_products
from workbench.proof.decide.over_denominator import find_over_denominator
from workbench.proof.decide.parts import find_by_parts
from workbench.proof.decide.pivots import find_by_pivots
from workbench.proof.decide.sines import sine_lemmas
from workbench.proof.decide.smoothing import smoothing_lemmas
from workbench.proof.decide.splits import find_by_factor_signs, find_by_splits
from workbench.proof.decide.squares import find_squares
from workbench.proof.decide.tangents import find_by_tangents
from workbench.proof.decide.totals import find_by_totals
from workbench.proof.decide.two_sides import between, find_by_two_sides, pinched
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.derive import Side, Size, expand_derivatives, unfold
from workbench.proof.text import assumptions, text

Proof = dict[str, Any]
Given = tuple[Relation, ...]
Found = Proof | None

FEW = 3  # assumptions, with which a search is short
MOST_CASES = 6  # expressions whose sign is split, one inside the other


def prove_relation(goal: Goal, shown: Relation) -> Found:
    """A proof of one relation of the goal, to be checked; None when none was found."""
    if goal.decreasing is None or find_identity(goal, shown):
        given = assumptions(goal)
        first = pinched(given)
        first += first_lemmas(goal, shown, (*given, *(lemma for lemma, _ in first)))
        for lemmas in (smoothing_lemmas, sine_lemmas):
            first += lemmas(goal, shown, (*given, *(lemma for lemma, _ in first)), search)
        known = (*given, *(lemma for lemma, _ in first))
        found = search(goal, shown, known, goal.lemmas)
        if found is None and (roots := roots_below(goal, shown, known)):
            first += roots
            known = (*known, *(lemma for lemma, _ in roots))
            found = search(goal, shown, known, goal.lemmas)
        if found is None:
            found = find_over_denominator(goal, shown, known, search) or find_by_splits(goal, shown, known, search)
        return None if found is None else after(first, found)
    return _by_decrease(goal, shown)


def search(goal: Goal, shown: Relation, given: Given, lemmas: Given = (), depth: int = 0) -> Found:
    """A proof of a relation from the relations given, in the order in which the checker holds them.

    Of the goal itself only its flow and its facts are used.
    """
    if shown.operator in ("==", ">=", "<=") and find_identity(goal, shown):
        return {"rule": "identity"}
    inspected = _inspected((shown, *given), goal)
    if inspected is not None and depth < MOST_CASES:
        here, *rest = (_carried(r, goal) for r in (shown, *lemmas, *given))
        found = _by_cases(Goal((EMPTY,), facts=goal.facts), here, tuple(rest[len(lemmas):]), tuple(rest[:len(lemmas)]),
                          *inspected, depth)
        if found is not None:
            return found
    # In a case where little is assumed, what grows is sooner seen than what adds up.
    soon = 0 < len(given) <= FEW and depth > 0
    return ((_by_factors_and_parts(goal, shown, given) if not given else None)
            or (find_by_growth(goal, _carried(shown, goal), given) if soon else None)
            or find_by_log_products(goal, _carried(shown, goal), given)
            or _by_lemmas(goal, shown, given, lemmas) or _by_contradiction(goal, shown, given)
            or (None if soon else find_by_growth(goal, _carried(shown, goal), given))
            or (None if given else find_by_growth_both_ways(goal, _carried(shown, goal), given))
            or find_by_totals(goal, shown, given, search)
            or (_by_factors_and_parts(goal, shown, given) if given else None)
            or find_by_tangents(goal, _carried(shown, goal), given)
            or _by_its_square(goal, shown, given) or find_by_two_sides(goal, shown, given)
            or find_by_pivots(goal, shown, given) or find_by_ideal(goal, shown, given)
            or _by_impossibility(goal, shown, given) or _by_both_bounds(goal, shown, given, lemmas, depth)
            or find_by_log_products(goal, _carried(shown, goal), given, search))


def _plainly(goal: Goal, shown: Relation, given: Given) -> Found:
    """What takes no search: that a function grows, or adds up at once."""
    return find_by_growth(goal, _carried(shown, goal), given) or find_combination(goal, shown, given, quick=True)


def _by_factors_and_parts(goal: Goal, shown: Relation, given: Given) -> Found:
    """Of a margin with functions in it: by the signs of its factors, or by parts that share no symbol."""
    if not shown.margin.has(*GROWING, sp.tanh):
        return None
    return find_by_factor_signs(goal, shown, given, _plainly) or find_by_parts(goal, shown, given, search)


def _by_contradiction(goal: Goal, shown: Relation, given: Given) -> Found:
    """Where the relation fails the assumptions cannot all hold; finds what needs a division by the goal's margin."""
    if shown.operator == "==":
        return None
    impossible = find_combination(goal, greater(0, 0), (*given, shown.negation))
    if impossible is None:
        return None
    if shown.operator not in (">=", "<="):
        return impossible | {"rule": "contradiction"}
    here: Proof = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": len(given)}]}]}
    return {"rule": "cases", "of": text(shown.margin), "positive": here, "zero": here,
            "negative": impossible | {"rule": "contradiction"}}


def _by_impossibility(goal: Goal, shown: Relation, given: Given) -> Found:
    """An equality, where the assumptions cannot all hold."""
    if shown.operator != "==":
        return None
    impossible = find_combination(goal, greater(0, 0), (*given, shown.negation))
    return None if impossible is None else impossible | {"rule": "contradiction"}


def _by_its_square(goal: Goal, shown: Relation, given: Given) -> Found:
    """Where the relation fails by c > 0, or c != 0, squares show c^2 <= 0, with c among the factors of what is known.

    So from (p q)^2 >= r^2 for p q >= 0 follows p q >= r, which no sum of squares says at once; and x == y where
    x**2 + y**2 == 2 x y.
    """
    if shown.operator not in ("<=", ">=", "==") or shown.margin.has(sp.Sum):
        return None
    opposite, last = shown.negation, {"assume": len(given)}
    found = find_squares(goal, at_most(opposite.margin**2, 0), (*given, opposite))
    if found is None:
        return None
    square = [{"square_of": len(given)}] if shown.operator == "==" else [last, last]
    term = {"coefficient": "1", "factors": [*found.get("multiplier", []), *square]}
    return {"rule": "contradiction", "terms": [*found["terms"], term]}


def _by_both_bounds(goal: Goal, shown: Relation, given: Given, lemmas: Given, depth: int) -> Found:
    """An equality of sizes from both inequalities, each by a search of its own."""
    if shown.operator != "==" or depth or not _carried(shown, goal).margin.has(Size):
        return None
    lower, upper = (Relation(shown.left, operator, shown.right) for operator in ("<=", ">="))
    first = search(goal, lower, given, lemmas, depth)
    second = first and search(goal, upper, (*given, lower), lemmas, depth)
    if first is None or second is None:
        return None
    return after([(lower, first), (upper, second)], between(len(given), len(given) + 1, len(given) + 2))


def _carried(relation: Relation, goal: Goal) -> Relation:
    """The relation with derivatives carried out and abs, sign, Max and Min as Size and Side."""
    left, right = (unfold(expand_derivatives(side, goal.flow)) for side in (relation.left, relation.right))
    return Relation(left, relation.operator, right)


def _inspected(relations: Given, goal: Goal) -> tuple[sp.Expr, bool] | None:
    """The innermost expression whose abs or sign is taken, and whether its sign is; that of the goal first."""
    for relation in relations:
        carried = _carried(relation, goal)
        parts = [side.atoms(Size, Side) for side in (carried.left, carried.right)]
        inner = sorted({a for a in set().union(*parts) if not a.args[0].has(Size, Side)}, key=_plain_first)
        if inner:
            argument = inner[0].args[0]
            return argument, any(isinstance(a, Side) and _turn(a.args[0], argument) for a in inner)
    return None


def _plain_first(atom: sp.Expr) -> tuple[bool, Any]:
    """Signs of plain expressions come first: they often settle those of functions of them."""
    return atom.has(*GROWING), sp.default_sort_key(atom)


def _turn(one: sp.Expr, other: sp.Expr) -> int:
    """1 when the expressions are equal, -1 when they are opposite, else 0."""
    return 1 if vanishes(one - other) else -1 if vanishes(one + other) else 0


def _by_cases(goal: Goal, shown: Relation, given: Given, lemmas: Given, argument: sp.Expr, signed: bool,
              depth: int) -> Found:
    """One proof for each sign of the argument."""
    cases: dict[str, tuple[Relation, int, int | None]] = (
        {"positive": (greater(argument, 0), 1, 1), "zero": (equal(argument, 0), 1, 0),
         "negative": (greater(-argument, 0), -1, -1)} if signed else
        {"nonnegative": (at_least(argument, 0), 1, None), "nonpositive": (at_least(-argument, 0), -1, None)})
    proof: Proof = {"rule": "cases", "of": text(argument)}
    rooted = has_root_of_size((shown, *given))
    for name, (case, direction, sign) in cases.items():
        here, *rest = (Relation(_settled(r.left, argument, direction, sign), r.operator,
                                _settled(r.right, argument, direction, sign)) for r in (shown, *lemmas, *given))
        known = (*rest[len(lemmas):], case)
        first = [not_negative(argument, len(known) - 1)] if rooted and name == "zero" else []
        found = _search_case(goal, here, (*known, *(one for one, _ in first)), tuple(rest[:len(lemmas)]), depth + 1)
        if found is None:
            return None
        if rooted and direction > 0 and name != "zero":
            kept = _settled(apart(shown.margin, argument), argument, direction, sign)
            found = with_root(found, kept, here.margin, argument)
        proof[name] = after(first, found)
    return proof


def _settled(expr: sp.Expr, argument: sp.Expr, direction: int, sign: int | None) -> sp.Expr:
    """The expression where the argument's abs is direction * argument and its sign, when one is given, is known."""
    values: dict[sp.Expr, sp.Expr] = {}
    for atom in expr.atoms(Size, Side):
        turn = _turn(atom.args[0], argument)
        if turn and isinstance(atom, Size):
            values[atom] = direction * argument
        elif turn and sign is not None:
            values[atom] = sp.Integer(turn * sign)
    return expr.xreplace(values)


def _search_case(goal: Goal, shown: Relation, given: Given, lemmas: Given, depth: int) -> Found:
    """A proof of a case, or of its impossibility."""
    impossible = find_combination(goal, greater(0, 0), given, quick=True)
    if impossible is not None:
        return impossible | {"rule": "contradiction"}
    first = pinched(given)
    # 1 + abs(x + y) is plainly not zero; 1 + x + y where x + y >= 0 wants a word.
    first += definedness(goal, shown, (*given, *(lemma for lemma, _ in first)))
    found = search(goal, shown, (*given, *(lemma for lemma, _ in first)), lemmas, depth)
    return None if found is None else after(first, found)


def _by_lemmas(goal: Goal, shown: Relation, given: Given, lemmas: Given) -> Found:
    """First every lemma that can be had, then the relation from them and what is given."""
    steps: list[tuple[Relation, Proof]] = []
    for lemma in (*lemmas, *_signs_of_logs((shown, *given))):
        known = tuple(r for r, _ in steps)
        # Only what shares a symbol with the lemma is offered, so that side lemmas stay cheap; positions stay.
        near = tuple(r if lemma.margin.free_symbols & r.margin.free_symbols else EMPTY for r in (*given, *known))
        proof = find_combination(goal, lemma, near) or (find_squares(goal, lemma, near) if lemma in lemmas else None)
        if proof is not None:
            steps.append((lemma, proof))
    final = find_combination(goal, shown, (*given, *(r for r, _ in steps)))
    if final is None and steps:  # what does not help can still make a search too large
        steps, final = [], find_combination(goal, shown, given)
    if final is None:
        final = find_squares(goal, shown, given)
    if final is None:
        return None
    return after(steps, final)


def _signs_of_logs(relations: Given) -> list[Relation]:
    """log A >= 0 for every logarithm in the relations: worth trying as a lemma."""
    logs = sorted({log for r in relations for log in r.margin.atoms(sp.log)}, key=sp.default_sort_key)
    return [at_least(log, 0) for log in logs if relations[0].margin != log]


def _by_decrease(goal: Goal, shown: Relation) -> Found:
    """A bound from a function that does not increase along the flow."""
    function = sp.Add(goal.decreasing)
    # As the checker will see it: assumptions of the moving symbols emptied, those that always hold appended.
    moving = goal.moving()
    given = assumptions(goal)
    kept = tuple(EMPTY if r.margin.free_symbols & moving else r for r in given)
    decrease = search(goal, at_least(-D(function), 0), (*kept, *goal.always))
    start = function.xreplace(goal.initial)
    final = search(goal, shown, (*given, at_least(start, function)))
    if decrease is None or final is None:
        return None
    return {"rule": "nonincreasing", "function": text(function), "decrease": decrease, "then": final}
