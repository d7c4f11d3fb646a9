"""The records of a proof: relations, goals, claims and their verdicts."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from numbers import Rational
from typing import Any, Literal

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.language import (  # noqa: F401 - what goals are stated with
    CLOCK,
    D,
    Language,
    cosh,
    derivatives_in,
    has_unstated,
    name_of,
    require_clock,
    require_kept_signs,
    saturation,
    sinh,
    symbols_in,
    table_of,
)
from workbench.proof.latex.write import latex
from workbench.proof.typed import as_evaluated, evaluated, kept_as_typed
from workbench.proof.verdict import FAILED, VERDICTS, Decision, Kind, Stated, Verdict  # noqa: F401 - all records here

Operator = Literal["==", "<=", "<", ">=", ">", "!="]
OPPOSITE: dict[Operator, Operator] = {"==": "!=", "!=": "==", "<": ">=", ">=": "<", ">": "<=", "<=": ">"}


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

    @property
    def negation(self) -> Relation:
        """The relation that holds, where both sides are defined, just where this one does not."""
        return Relation(self.left, OPPOSITE[self.operator], self.right)

    def subs(self, values: dict[sp.Expr, sp.Expr]) -> Relation:
        """The relation with symbols replaced."""
        return Relation(self.left.xreplace(values), self.operator, self.right.xreplace(values))

    def latex(self, letters: Mapping[str, str] | None = None) -> str:
        """LaTeX of the relation; letters: LaTeX of names, where it is not made of them."""
        sign = {"==": "=", "<=": r"\le", ">=": r"\ge", "!=": r"\ne"}.get(self.operator, self.operator)
        return f"{latex(self.left, letters)} {sign} {latex(self.right, letters)}"


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

    The sign that sympy knows of a symbol (positive, nonnegative) is an assumption too, of a symbol that moves at the
    instant of which the goal speaks; of what moves from `initial` values, time apart, none is declared. `flow` gives
    the rates that D(...) uses; `inputs` are symbols without a rate that may vary in time, all others are constant;
    `always` holds at every instant along the flow, `initial` names values at time zero; `eventually` is the time symbol
    when `show` is claimed only from some time on. `hint` are functions or lemmas that a proof may use; a hint can help
    a decider, never convince the checker. `named` are symbols that the goal speaks of beside those that stand in it.
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
    inputs: tuple[sp.Symbol | sp.Indexed, ...] = ()
    named: tuple[sp.Expr, ...] = ()

    def __post_init__(self) -> None:
        with as_evaluated():
            self._require_meaning()

    def _require_meaning(self) -> None:
        self._require_shape()
        if not self.show:
            raise ClaimError("a goal shows nothing: give at least one relation")
        self._leave_out_unreached()
        self._require_clock()
        require_kept_signs(self.flow, self.initial)
        language = Language(self.flow, self.inputs)
        for relation in (*self.relations(), *self.lemmas):
            language.check(relation.left)
            language.check(relation.right)
        for moving, rate in self.flow.items():
            index = moving.indices[0] if isinstance(moving, sp.Indexed) else None
            language.check(moving, index)
            language.check_rate(rate, index)
        for expr in (*self.initial.values(), *self.model.values(), *self.facts, sp.Add(self.decreasing or 0)):
            language.check(expr)
        for symbol in (*self.inputs, *self.named):
            language.check(symbol, symbol.indices[0] if isinstance(symbol, sp.Indexed) else None)
        language.check_whole()

    def _require_clock(self) -> None:
        """ClaimError where the flow follows what changes with the time t, in a derivative or from the start to a later
        instant, and does not say that t runs."""
        followed = [inner for side in self._sides() for inner in derivatives_in(side)]
        if self.initial or self.always or self.eventually is not None or self.decreasing is not None:
            followed += [*self._sides(), *self.initial.values(), *self.facts, sp.Add(self.decreasing or 0)]
        if followed:
            require_clock((*self.flow, *self.inputs), (*followed, *self.flow.values()))

    def _leave_out_unreached(self) -> None:
        """Take out of the flow what certificates cannot state and the goal does not speak of.

        A plant's flow has all its rates, of which a goal may need a few; a symbol is needed that stands in the goal
        outside of the flow, or in the rate of one that is needed.
        """
        unstated = {s for s, rate in self.flow.items() if has_unstated(rate)}
        if not unstated:
            return
        others = (*self.facts, *self.inputs, *self.named, *self.initial, *self.initial.values(), *self.model,
                  *self.model.values(), sp.Add(self.decreasing or 0), sp.Add(self.eventually or 0))
        needed = {s for expr in (*self._sides(), *others) for s in expr.free_symbols}
        rest = dict(self.flow)
        while reached := [s for s in rest if s.free_symbols & needed]:
            for symbol in reached:
                needed |= symbol.free_symbols | rest.pop(symbol).free_symbols
        kept = {s: rate for s, rate in self.flow.items() if s not in rest or s not in unstated}
        object.__setattr__(self, "flow", kept)

    def _require_shape(self) -> None:
        for part in ("show", "assume", "always", "lemmas"):
            relations = getattr(self, part)
            if not isinstance(relations, tuple) or not all(isinstance(r, Relation) for r in relations):
                raise ClaimError(f"the part '{part}' of a goal is no tuple of relations: write "
                                 "(at_least(x, 0),), with equal, at_most, less, at_least, greater or differ")
        for part in ("flow", "initial", "model"):
            object.__setattr__(self, part, table_of(getattr(self, part), part))
        if not isinstance(self.inputs, tuple) or not all(
                isinstance(s, (sp.Symbol, sp.Indexed)) for s in self.inputs):
            raise ClaimError("the part 'inputs' of a goal is no tuple of symbols: write inputs=(u, d)")
        if both := [s for s in self.inputs if s in self.flow]:
            raise ClaimError(f"{both[0]} has a rate and is an input as well: give one of the two")

    def relations(self) -> tuple[Relation, ...]:
        """All relations of the goal."""
        return (*self.show, *self.assume, *self.always)

    def _sides(self) -> list[sp.Expr]:
        return [side for r in (*self.relations(), *self.lemmas) for side in (r.left, r.right)]

    def evaluated(self, functions: bool = True) -> Goal:
        """The same goal for deciders, its expressions as sympy would have built them; it has the same symbols.

        functions: whether sympy evaluates abs, sign, Max, Min and the like too, or leaves them to the deciders.
        """
        return self._with_functions_evaluated if functions else self._with_functions_as_typed

    @cached_property
    def _with_functions_evaluated(self) -> Goal:
        return self._evaluated(True)

    @cached_property
    def _with_functions_as_typed(self) -> Goal:
        return self._evaluated(False)

    def _evaluated(self, functions: bool) -> Goal:
        def usual(expr: sp.Expr) -> sp.Expr:
            return evaluated(expr, functions)

        def put(relations: tuple[Relation, ...]) -> tuple[Relation, ...]:
            return tuple(Relation(usual(r.left), r.operator, usual(r.right)) for r in relations)

        return replace(
            self, show=put(self.show), assume=put(self.assume), always=put(self.always), lemmas=put(self.lemmas),
            flow={s: usual(rate) for s, rate in self.flow.items()},
            initial={s: usual(value) for s, value in self.initial.items()},
            decreasing=self.decreasing if self.decreasing is None else usual(sp.Add(self.decreasing)),
            facts=tuple(map(usual, self.facts)), model={s: usual(f) for s, f in self.model.items()},
            named=tuple(self.symbols()))

    def moving(self) -> set[sp.Expr]:
        """The symbols that may change along the flow."""
        return set(self._moving)

    def symbols(self) -> list[sp.Expr]:
        """Free symbols, one per name, indexed symbols by their base's name; sorted by name."""
        return list(self._symbols)

    @cached_property
    def _symbols(self) -> tuple[sp.Expr, ...]:
        found: set[sp.Expr] = set()
        exprs = [e for r in self.relations() for e in (r.left, r.right)]
        for expr in (*exprs, *self.flow, *self.flow.values(), *self.initial.values(), *self.inputs, *self.named):
            found |= symbols_in(expr)
        return tuple(sorted(found, key=name_of))

    @cached_property
    def _moving(self) -> frozenset[sp.Expr]:
        return frozenset(s for s, rate in self.flow.items() if evaluated(rate) != 0) | set(self.inputs)

    def signs(self) -> tuple[Relation, ...]:
        """What sympy knows of the symbols, as relations; of the time of `eventually`, that it starts at zero, is said
        by the rule that uses it."""
        known: list[Relation] = []
        for s in self.symbols():
            if isinstance(s, sp.Indexed) or s == self.eventually:
                continue
            if s.is_positive:
                known.append(greater(s, 0))
            elif s.is_nonnegative:
                known.append(at_least(s, 0))
        return tuple(known)


@dataclass(frozen=True, kw_only=True)
class Claim(Stated):
    """One step of a paper: what is printed, in which form it is decided, and what it rests on.

    build: makes the goal; at: stated parameters at which a condition is evaluated; correction: builds the
    nearest true statement; repair: parameters at which a violated condition holds; axiom: a cited result that
    is assumed; unstated: why a line has no goal yet. closed_loop: the goal assumes the printed plant, law and
    adaptation and nothing else, so that a motion of it that breaks the statement refutes it. notation: what the
    letters of the printed line stand for; letters: what those of the goal that are not the paper's stand for, by their
    names.
    """

    build: Callable[[], Goal] | None
    at: dict[sp.Expr, Fraction] | None = None
    correction: Callable[[], Goal] | None = None
    corrected_statement: str | None = None
    repair: dict[sp.Expr, Fraction] | None = None
    axiom: str | None = None
    unstated: str | None = None
    closed_loop: bool = False
    notation: Mapping[str, sp.Expr] = field(default_factory=dict)
    letters: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        super().__post_init__()
        if sum(part is not None for part in (self.build, self.axiom, self.unstated)) != 1:
            raise ClaimError(f"claim {self.id}: give either a goal or the axiom it is assumed as")
        for symbol, value in (*(self.at or {}).items(), *(self.repair or {}).items()):
            if not isinstance(symbol, sp.Expr) or not isinstance(value, Rational):
                raise ClaimError(f"claim {self.id}: stated value {symbol} = {value}: write a symbol and an exact "
                                 "number, as in {k: Fraction(1, 2)}")
        for name in ("build", "correction"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, kept_as_typed(getattr(self, name)))
