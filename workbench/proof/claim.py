"""The records of a proof: relations, goals, claims and their verdicts."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from numbers import Rational
from typing import Any, Literal

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.latex.write import latex
from workbench.proof.verdict import FAILED, VERDICTS, Decision, Kind, Stated, Verdict  # noqa: F401 - all records here

Operator = Literal["==", "<=", "<", ">=", ">", "!="]


class D(sp.Function):
    """Derivative along the goal's flow, left unevaluated so that decider and checker derive it on their own."""

    nargs = 1


@dataclass(frozen=True)
class Relation:
    """left operator right; never evaluated by sympy, so that nothing is decided by construction."""

    left: sp.Expr
    operator: Operator
    right: sp.Expr

    @property
    def margin(self) -> sp.Expr:
        """The expression that the relation says is == 0, > 0, >= 0 or != 0."""
        return self.right - self.left if self.operator in ("<=", "<") else self.left - self.right

    @property
    def strict(self) -> bool:
        """Whether the margin must be positive."""
        return self.operator in ("<", ">")

    def subs(self, values: dict[sp.Expr, sp.Expr]) -> Relation:
        """The relation with symbols replaced."""
        return Relation(self.left.xreplace(values), self.operator, self.right.xreplace(values))

    def latex(self) -> str:
        """LaTeX of the relation."""
        sign = {"==": "=", "<=": r"\le", ">=": r"\ge", "!=": r"\ne"}.get(self.operator, self.operator)
        return f"{latex(self.left)} {sign} {latex(self.right)}"


def equal(left: Any, right: Any) -> Relation:
    """left == right."""
    return Relation(sp.sympify(left, strict=True), "==", sp.sympify(right, strict=True))


def at_most(left: Any, right: Any) -> Relation:
    """left <= right."""
    return Relation(sp.sympify(left, strict=True), "<=", sp.sympify(right, strict=True))


def less(left: Any, right: Any) -> Relation:
    """left < right."""
    return Relation(sp.sympify(left, strict=True), "<", sp.sympify(right, strict=True))


def at_least(left: Any, right: Any) -> Relation:
    """left >= right."""
    return Relation(sp.sympify(left, strict=True), ">=", sp.sympify(right, strict=True))


def greater(left: Any, right: Any) -> Relation:
    """left > right."""
    return Relation(sp.sympify(left, strict=True), ">", sp.sympify(right, strict=True))


def differ(left: Any, right: Any) -> Relation:
    """left != right."""
    return Relation(sp.sympify(left, strict=True), "!=", sp.sympify(right, strict=True))


@dataclass(frozen=True)
class Goal:
    """For all values of the symbols: `assume` implies every relation in `show`.

    The sign that sympy knows of a symbol (positive, nonnegative) is an assumption too. `flow` gives the rates
    that D(...) uses; `always` holds at every instant along it, `initial` names values at time zero;
    `eventually` is the time symbol when `show` is claimed only from some time on. `hint` are functions or
    lemmas that a proof may use; a hint can help a decider, never convince the checker.
    """

    show: tuple[Relation, ...]
    assume: tuple[Relation, ...] = ()
    flow: dict[sp.Expr, sp.Expr] = field(default_factory=dict)
    always: tuple[Relation, ...] = ()
    initial: dict[sp.Expr, sp.Expr] = field(default_factory=dict)
    eventually: sp.Symbol | None = None
    decreasing: sp.Expr | None = None
    facts: tuple[sp.Expr, ...] = ()
    lemmas: tuple[Relation, ...] = ()
    model: dict[sp.Expr, sp.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._require_shape()
        if not self.show:
            raise ClaimError("a goal shows nothing: give at least one relation")
        language = _Language()
        for relation in (*self.relations(), *self.lemmas):
            language.check(relation.left)
            language.check(relation.right)
        for moving, rate in self.flow.items():
            index = moving.indices[0] if isinstance(moving, sp.Indexed) else None
            language.check(moving, index)
            language.check(rate, index)
        for expr in (*self.initial.values(), *self.model.values(), *self.facts, sp.Add(self.decreasing or 0)):
            language.check(expr)

    def _require_shape(self) -> None:
        for part in ("show", "assume", "always", "lemmas"):
            relations = getattr(self, part)
            if not isinstance(relations, tuple) or not all(isinstance(r, Relation) for r in relations):
                raise ClaimError(f"the part '{part}' of a goal is no tuple of relations: write "
                                 "(at_least(x, 0),), with equal, at_most, less, at_least, greater or differ")
        for part in ("flow", "initial", "model"):
            exact = {s: sp.sympify(value, strict=True) for s, value in getattr(self, part).items()}
            if not all(isinstance(s, sp.Expr) for s in exact):
                raise ClaimError(f"the part '{part}' of a goal names no symbols: write {{x: rate}}, no text")
            object.__setattr__(self, part, exact)

    def relations(self) -> tuple[Relation, ...]:
        """All relations of the goal."""
        return (*self.show, *self.assume, *self.always)

    def symbols(self) -> list[sp.Expr]:
        """Free symbols, one per name, indexed symbols by their base's name; sorted by name."""
        found: set[sp.Expr] = set()
        exprs = [e for r in self.relations() for e in (r.left, r.right)]
        for expr in (*exprs, *self.flow, *self.flow.values(), *self.initial.values()):
            indexed = expr.atoms(sp.Indexed)
            hidden = {s for i in indexed for s in i.free_symbols}
            hidden |= {s for total in expr.atoms(sp.Sum) for s in total.bound_symbols}
            hidden |= {s for total in expr.atoms(sp.Sum) for limit in total.limits for e in limit[1:]
                       for s in e.free_symbols}
            found |= {s for s in expr.free_symbols if s not in hidden and not isinstance(s, sp.IndexedBase)}
            found |= indexed
        return sorted(found, key=name_of)

    def signs(self) -> tuple[Relation, ...]:
        """What sympy knows of the symbols, as relations."""
        known: list[Relation] = []
        for s in self.symbols():
            if isinstance(s, sp.Indexed) or s in self.flow:
                continue
            if s.is_positive:
                known.append(greater(s, 0))
            elif s.is_nonnegative:
                known.append(at_least(s, 0))
        return tuple(known)


class _Language:
    """What certificates can say without loss; all expressions of one goal go through one of these.

    Certificates know symbols by name only and print W[j] as W, so two symbols must not share a name, and an
    index may stand only where its sum binds it.
    """

    def __init__(self) -> None:
        self.names: dict[str, sp.Expr] = {}
        self.limits: sp.Tuple | None = None

    def check(self, expr: sp.Expr, index: sp.Symbol | None = None) -> None:
        """Raise ClaimError unless certificates can state the expression exactly."""
        if isinstance(expr, sp.Symbol):
            if expr == index:
                raise ClaimError(f"the index {index} stands as a number in a sum: use it as an index only")
            self._name(str(expr), expr)
        elif isinstance(expr, sp.Indexed):
            if index is None or expr.indices != (index,):
                raise ClaimError(f"{expr} stands where no sum binds its index: sum over it, with one index")
            self._name(str(expr.base.label), expr.base)
        elif isinstance(expr, sp.Sum):
            if index is not None or len(expr.limits) != 1 or (self.limits or expr.limits[0]) != expr.limits[0]:
                raise ClaimError(f"{expr}: all sums of a goal need the same one index and range, none in another")
            self.limits = expr.limits[0]
            self.check(expr.function, expr.limits[0][0])
        elif isinstance(expr, sp.Pow):
            if not (expr.exp * 2).is_Integer:
                raise ClaimError(f"'{expr}' has no meaning in certificates: only whole and half powers have")
            self.check(expr.base, index)
        elif isinstance(expr, (sp.Add, sp.Mul, D, *FUNCTIONS)):
            for part in expr.args:
                self.check(part, index)
        elif isinstance(expr, sp.Float):
            raise ClaimError(f"the number {expr} is not exact: write it as sympy.Rational or Fraction")
        elif not isinstance(expr, sp.Rational) and expr != sp.E:
            raise ClaimError(f"'{expr}' has no meaning in certificates: state the claim with + - * / **, "
                             f"{', '.join(LANGUAGE[2:])}")

    def _name(self, name: str, owner: sp.Expr) -> None:
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) or keyword.iskeyword(name) or name in LANGUAGE:
            raise ClaimError(f"symbol '{name}': certificates need names of letters, digits and underscores, "
                             f"other than {', '.join(LANGUAGE)} and Python's own words")
        if self.names.setdefault(name, owner) != owner:
            raise ClaimError(f"two different symbols are named '{name}' (other assumptions, or one of them indexed): "
                             "certificates could not tell them apart; give each its own name")
        if owner.assumptions0 not in (BASES if isinstance(owner, sp.IndexedBase) else SYMBOLS):
            raise ClaimError(f"symbol '{name}': sympy knows more of it than its certificate would say; make it real, "
                             "positive or nonnegative (indexed: real) and state the rest as an assumption")


# What sympy may know of a symbol: by more it would simplify a goal into one that holds for fewer values than stated.
SYMBOLS = [sp.Symbol("x", **known).assumptions0 for known in ({}, {"real": True}, {"positive": True},
                                                              {"nonnegative": True})]
BASES = [sp.IndexedBase("x", **known).assumptions0 for known in ({}, {"real": True})]
FUNCTIONS = (sp.log, sp.exp, sp.tanh, sp.Abs, sp.sign, sp.Max, sp.Min)
LANGUAGE = ("Sum", "D", "log", "exp", "tanh", "abs", "sign", "sqrt", "Max", "Min")


def saturation(value: Any, low: Any, high: Any) -> sp.Expr:
    """sat(value, low, high): value, cut off at low and high (low <= high)."""
    return sp.Min(sp.Max(value, low), high)


def name_of(symbol: sp.Expr) -> str:
    """The name under which a symbol or an indexed symbol stands in certificates."""
    return str(symbol.base.label) if isinstance(symbol, sp.Indexed) else str(symbol)


@dataclass(frozen=True, kw_only=True)
class Claim(Stated):
    """One step of a paper: what is printed, in which form it is decided, and what it rests on.

    build: makes the goal; at: stated parameters at which a condition is evaluated; correction: builds the
    nearest true statement; repair: parameters at which a violated condition holds; axiom: a cited result that
    is assumed. closed_loop: the goal assumes the printed plant, law and adaptation and nothing else, so that a motion
    of it that breaks the statement refutes it. notation: what the letters of the printed line stand for.
    """

    build: Callable[[], Goal] | None
    at: dict[sp.Expr, Fraction] | None = None
    correction: Callable[[], Goal] | None = None
    corrected_statement: str | None = None
    repair: dict[sp.Expr, Fraction] | None = None
    axiom: str | None = None
    closed_loop: bool = False
    notation: Mapping[str, sp.Expr] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.build is None) == (self.axiom is None):
            raise ClaimError(f"claim {self.id}: give either a goal or the axiom it is assumed as")
        for symbol, value in (*(self.at or {}).items(), *(self.repair or {}).items()):
            if not isinstance(symbol, sp.Expr) or not isinstance(value, Rational):
                raise ClaimError(f"claim {self.id}: stated value {symbol} = {value}: write a symbol and an exact "
                                 "number, as in {k: Fraction(1, 2)}")
