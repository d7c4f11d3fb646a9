"""Break a bound of a later instant: polynomials of time that obey the flow until the bound fails.

Inputs are constants or polynomials. Where a rate mentions the symbol that moves, that symbol is given a polynomial and
the rate is solved for an input or for the next symbol of the chain, so that nothing but polynomials is integrated.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from typing import Any

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Goal, Relation, Verdict, at_least, name_of
from workbench.proof.decide.combination import find_combination
from workbench.proof.decide.identity import find_identity
from workbench.proof.decide.names import free_name
from workbench.proof.decide.proposals import Point, proposals
from workbench.proof.derive import expand_derivatives
from workbench.proof.text import assumptions, text

LOOKS = 30
# Parts of the duration at which `always` is looked at; it goes on after the end.
SAMPLES = (sp.Integer(0), sp.Rational(1, 2), sp.Integer(1), sp.Integer(100), sp.Integer(10**9))
DEGREES = ((1, 2), (2, 3), (3, 4))  # powers of time that a curve starts with: slow starts keep several values at zero
MOST_TERMS = 80

Way = dict[sp.Expr, sp.Expr]


def find_path(goal: Goal, record: dict[str, Any], verdict: Verdict, seed: int,
              quick: bool = False) -> dict[str, Any] | None:
    """A certificate with a point that the flow reaches from its initial values, or None.

    record: the goal as its certificate states it.
    """
    for reached in reached_points(goal, seed, True, quick):
        certificate = {**reached, "version": 1, "verdict": verdict, "goal": record}
        try:
            check(certificate)
        except CertificateError:
            continue
        return certificate
    return None


def reached_points(goal: Goal, seed: int, break_shown: bool, quick: bool = False) -> Iterator[dict[str, Any]]:
    """Points that meet the assumptions, and where wanted break what is shown, with the paths that lead to them."""
    if not goal.flow or not (goal.initial or goal.always) or any(isinstance(s, sp.Indexed) for s in goal.symbols()):
        return
    taken = {name_of(s) for s in goal.symbols()}
    duration = sp.Symbol(free_name("duration", taken), positive=True)
    time = sp.Symbol(free_name("time", taken), real=True)
    for way in islice(_ways(goal, time), 1 if quick else None):
        for point in _ends(goal, way, duration, time, seed, break_shown, quick):
            reached = _reached(goal, way, point, duration, time)
            if reached is not None:
                yield reached


def _ways(goal: Goal, time: sp.Symbol) -> Iterator[Way]:
    """Polynomials of time, with free coefficients, for what moves and for inputs: constant inputs first."""
    inputs = sorted(goal.inputs, key=str)
    seen: list[Way] = []
    for degrees in DEGREES:
        for varying in (False, True):
            varied = {s: s + time * sp.Symbol(f"slope_of_{s}", real=True) for s in inputs} if varying else {}
            try:
                way = _way(goal, time, inputs, varied, degrees)
            except sp.PolynomialError:  # a rate that is no polynomial of time
                way = None
            if way is not None and way not in seen:
                seen.append(way)
                yield way


def _way(goal: Goal, time: sp.Symbol, inputs: list[sp.Symbol], varied: Way, degrees: tuple[int, ...]) -> Way | None:
    moving = [s for s, rate in goal.flow.items() if rate != 0]
    way, settled = dict(varied), set[sp.Expr]()
    while len(settled) < len(moving):
        before = len(settled)
        # Integrating an input as a constant would leave it no freedom to bend a curve that needs it.
        curved = any(s not in settled and goal.flow[s].has(s) for s in moving)
        for s in moving:
            rate = sp.expand(goal.flow[s].xreplace(way))
            unknown = [u for u in moving if u not in way and rate.has(u)]
            if s in settled:
                continue
            if s not in way and not unknown and not curved:
                way[s] = _start(goal, s) + sp.Poly(rate, time).integrate().as_expr()
            elif s in way:  # its curve is chosen: something in its rate has to follow
                follower = _follower(rate, unknown or [u for u in inputs if u not in way], time)
                if follower is None or len(unknown) > 1:
                    return None
                rest = rate.xreplace({follower: sp.Integer(0)})
                way[follower] = sp.expand((sp.diff(way[s], time) - rest) / sp.diff(rate, follower))
            else:
                continue
            settled.add(s)
        if len(settled) == before:
            stuck = next(s for s in moving if s not in way)
            curve = (sp.Symbol(f"curve_{power}_of_{stuck}", real=True) * time**power for power in degrees)
            way[stuck] = _start(goal, stuck) + sp.Add(*curve)
    right = all(sp.expand(sp.diff(way[s], time) - goal.flow[s].xreplace(way)) == 0
                and sp.expand(way[s].xreplace({time: sp.Integer(0)}) - _start(goal, s)) == 0 for s in moving)
    short = all(len(sp.Add.make_args(sp.expand(f))) <= MOST_TERMS for f in way.values())
    return way if right and short else None


def _start(goal: Goal, symbol: sp.Expr) -> sp.Expr:
    """The initial value, free where the goal names none."""
    return goal.initial.get(symbol, sp.Symbol(f"start_of_{symbol}", real=True))


def _follower(rate: sp.Expr, candidates: list[sp.Symbol], time: sp.Symbol) -> sp.Symbol | None:
    """A symbol for which a rate can be solved without dividing by what changes."""
    slopes = {u: sp.diff(rate, u) for u in candidates}
    return next((u for u, slope in slopes.items() if slope != 0 and not slope.has(time, u)), None)


def _along(goal: Goal, way: Way, relation: Relation) -> Relation:
    """The relation as a function of time."""
    left, right = (expand_derivatives(side, goal.flow).xreplace(way) for side in (relation.left, relation.right))
    return Relation(left, relation.operator, right)


def _ends(goal: Goal, way: Way, duration: sp.Symbol, time: sp.Symbol, seed: int,
          break_shown: bool, quick: bool) -> list[Point]:
    """Points by constants, coefficients and the duration at which the goal at the end of the way seems to fail, or its
    assumptions to hold."""
    ends = {time: duration}
    held = [_along(goal, way, r).subs({time: part * duration}) for r in goal.always for part in SAMPLES]
    # Symbols that no relation mentions need values all the same.
    used = {duration}.union(*(f.free_symbols for f in way.values())) - {time}
    mentioned = tuple(at_least(s**2, 0) for s in sorted(used, key=str))
    try:
        at_end = Goal(tuple(_along(goal, way, r).subs(ends) for r in goal.show),
                      (*(_along(goal, way, r).subs(ends) for r in assumptions(goal)), *held, *mentioned))
        return list(islice(proposals(at_end, seed, break_shown, quick), LOOKS))
    except ClaimError:
        return []


def _reached(goal: Goal, way: Way, point: Point, duration: sp.Symbol, time: sp.Symbol) -> dict[str, Any] | None:
    """What a certificate says of constants, coefficients and a duration; None without a proof of what always holds."""
    chosen = {sp.Symbol(name): sp.Rational(v.numerator, v.denominator) for name, v in point.items()}
    values = {s: chosen[sp.Symbol(s.name)] for f in (*way.values(), *goal.symbols()) for s in f.free_symbols
              if isinstance(s, sp.Symbol) and sp.Symbol(s.name) in chosen}
    path = {s: sp.expand(f.xreplace(values)) for s, f in way.items()}
    lasting = chosen[sp.Symbol(duration.name)]
    if lasting < 0:
        return None
    ends = {name_of(s): f.xreplace({time: lasting}) for s, f in path.items()}
    ends |= {name_of(s): values[s] for s in goal.symbols() if s in values and s not in path}
    if not all(value.is_Rational for value in ends.values()):
        return None
    proofs = []
    for relation in goal.always:
        along = _along(goal, path, relation).subs(values)
        if along.operator in ("==", "<=", ">=") and find_identity(Goal((along,)), along):
            proofs.append({"rule": "identity"})
            continue
        found = find_combination(Goal((along,)), along, (at_least(time, 0),))
        if found is None:
            return None
        proofs.append(found)
    exact = {name: str(Fraction(int(value.p), int(value.q))) for name, value in ends.items()}
    return {"point": exact, "path": {name_of(s): text(f) for s, f in path.items()}, "time": str(time),
            "duration": str(lasting), "always": proofs}
