"""The records of a proof: relations, goals, claims and their verdicts."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Literal

import sympy as sp

from workbench.errors import ClaimError

Kind = Literal["identity", "inequality", "condition", "implication", "limit"]
Verdict = Literal["proved", "refuted", "violated", "gap", "assumed", "undecided"]
Operator = Literal["==", "<=", "<", ">=", ">", "!="]

VERDICTS: tuple[Verdict, ...] = ("proved", "refuted", "violated", "gap", "assumed", "undecided")
FAILED: tuple[Verdict, ...] = ("refuted", "violated", "gap")


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


ACCENTS = {"hat": r"\hat{{{}}}", "tilde": r"\tilde{{{}}}", "dot": r"\dot{{{}}}", "star": "{}^{{*}}",
           "square": "{}^{{2}}"}


def latex(expr: sp.Expr) -> str:
    """LaTeX of an expression; accents come from names such as a_tilde, derivatives along the flow are d/dt."""
    plain = expr.replace(D, lambda inner: sp.Symbol(rf"\frac{{d}}{{dt}}\left[{sp.latex(inner)}\right]"))
    return str(sp.latex(plain, symbol_names={s: latex_name(str(s)) for s in plain.free_symbols
                                             if isinstance(s, sp.Symbol) and "_" in str(s)}))


def latex_name(name: str) -> str:
    """LaTeX of a symbol's name: parts after underscores are accents where known, else indices."""
    if "\\" in name:
        return name
    stem, *parts = name.split("_")
    result = str(sp.latex(sp.Symbol(stem)))
    indices = [part for part in parts if part not in ACCENTS]
    if indices:
        result = f"{result}_{{{','.join(indices)}}}"
    for accent in (part for part in parts if part in ACCENTS):
        result = ACCENTS[accent].format(f"{{{result}}}" if accent == "square" else result)
    return result


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
            self._name(str(expr), expr)
            if expr == index:
                raise ClaimError(f"the index {index} stands as a number in a sum: use it as an index only")
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
            if not expr.exp.is_Integer:
                raise ClaimError(f"'{expr}' has no meaning in certificates: only whole powers have")
            self.check(expr.base, index)
        elif isinstance(expr, (sp.Add, sp.Mul, sp.log, sp.exp, D)):
            for part in expr.args:
                self.check(part, index)
        elif isinstance(expr, sp.Float):
            raise ClaimError(f"the number {expr} is not exact: write it as sympy.Rational or Fraction")
        elif not isinstance(expr, sp.Rational) and expr != sp.E:
            raise ClaimError(f"'{expr}' has no meaning in certificates: state the claim with + - * / **, log and exp")

    def _name(self, name: str, owner: sp.Expr) -> None:
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) or keyword.iskeyword(name) or name in LANGUAGE:
            raise ClaimError(f"symbol '{name}': certificates need names of letters, digits and underscores, "
                             f"other than {', '.join(LANGUAGE)} and Python's own words")
        if self.names.setdefault(name, owner) != owner:
            raise ClaimError(f"two different symbols are named '{name}' (other assumptions, or one of them indexed): "
                             "certificates could not tell them apart; give each its own name")


LANGUAGE = ("Sum", "D", "log", "exp")


def name_of(symbol: sp.Expr) -> str:
    """The name under which a symbol or an indexed symbol stands in certificates."""
    return str(symbol.base.label) if isinstance(symbol, sp.Indexed) else str(symbol)


@dataclass(frozen=True)
class Claim:
    """One step of a paper: what is printed, in which form it is decided, and what it rests on.

    id: `<paper>:<equation>`; statement: LaTeX as printed; build: makes the goal; premises: ids of claims;
    at: stated parameters at which a condition is evaluated; correction: builds the nearest true statement;
    repair: parameters at which a violated condition holds; axiom: a cited result that is assumed;
    recorded: the verdict on record; reading: how a garbled place was read.
    """

    id: str
    title: str
    kind: Kind
    statement: str
    recorded: Verdict
    build: Callable[[], Goal] | None
    premises: tuple[str, ...] = ()
    scope: str = "all values of the domain"
    at: dict[sp.Expr, Fraction] | None = None
    correction: Callable[[], Goal] | None = None
    corrected_statement: str | None = None
    repair: dict[sp.Expr, Fraction] | None = None
    axiom: str | None = None
    note: str = ""

    def __post_init__(self) -> None:
        paper, _, equation = self.id.partition(":")
        if not paper or not equation:
            raise ClaimError(f"claim id '{self.id}': write it as <paper>:<equation>")
        if self.recorded not in VERDICTS:
            raise ClaimError(f"claim {self.id}: recorded verdict '{self.recorded}' is none of {', '.join(VERDICTS)}")
        if (self.build is None) == (self.axiom is None):
            raise ClaimError(f"claim {self.id}: give either a goal or the axiom it is assumed as")

    @property
    def paper(self) -> str:
        """The paper's name."""
        return self.id.partition(":")[0]

    @property
    def equation(self) -> str:
        """The equation's number, with a suffix for a part."""
        return self.id.partition(":")[2]


@dataclass(frozen=True)
class Decision:
    """A claim decided: the verdict, the certificate that shows it, and how it was found."""

    claim: Claim
    verdict: Verdict
    method: str
    trust: str | None
    seconds: float
    certificate: dict[str, Any] | None = None
    counterexample: dict[str, str] | None = None
    correction: str | None = None
    computed: str | None = None
    tainted_by: tuple[str, ...] = ()
