"""A pasted line as a question: the goal that it states, decided."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import sympy as sp

from workbench.errors import OutOfTime
from workbench.files.time_limit import at_most_seconds, out_of_time
from workbench.proof.claim import Claim, D, Decision, Goal, Relation, at_least
from workbench.proof.decide.engine import decide
from workbench.proof.document_format import AnswerDocument
from workbench.proof.latex.convert import Converter
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.function_values import apart, one_value_at_one_argument, values_of_one_function
from workbench.proof.latex.notation import Notation
from workbench.proof.latex.parts import parted
from workbench.proof.latex.read import read_line
from workbench.proof.latex.statement import relations, statement
from workbench.proof.latex.symbols import Symbols
from workbench.proof.latex.tree import PARTED, Chain, Letter, Line, Number, Terms, letters_of_node
from workbench.proof.latex.varying import printed_of_time
from workbench.proof.latex.write import latex


@dataclass(frozen=True)
class Answer:
    """A line decided, with the goal as it was read, in LaTeX made from what was decided.

    constant: symbols that have no rate, where others have one; inputs: those of them that may vary nevertheless.
    """

    line: str
    decision: Decision
    shown: tuple[str, ...]
    given: tuple[str, ...]
    flow: tuple[str, ...]
    constant: tuple[str, ...]
    inputs: tuple[str, ...]
    counterexample: Mapping[str, str]

    def document(self) -> AnswerDocument:
        """The answer as the stable JSON document."""
        found = self.decision
        return {"version": 1, "line": self.line, "verdict": found.verdict, "method": found.method, "trust": found.trust,
                "goal": {"show": list(self.shown), "assume": list(self.given), "flow": list(self.flow),
                         "constant": list(self.constant), "inputs": list(self.inputs)},
                "counterexample": dict(self.counterexample) or None, "certificate": found.certificate}


def asked(line: str, symbols: Symbols) -> Goal:
    """The goal that a line states; raises LatexError where it cannot be read."""
    tree = read_line(line)
    notation = Notation(symbols.notation, symbols.definitions, {
        *symbols.flow, *symbols.inputs, *printed_of_time(tree, Notation(symbols.notation))})
    converter = Converter(notation, symbols.limits, declared=symbols.declared)
    if not {"=>", ":"} & {word for words in tree.separators for word in words}:
        _require_told_apart(tree)
    stated = statement(tree, converter)
    flow = dict(symbols.flow)
    found_here: set[sp.Expr] = set()
    assume = list(symbols.assume)
    for relation in relations(stated.conditions):
        moving = relation.left.args[0] if isinstance(relation.left, D) else None
        if relation.operator == "==" and isinstance(moving, (sp.Symbol, sp.Indexed)) and moving not in flow:
            flow[moving] = relation.right
            found_here.add(moving)
        else:
            assume.append(relation)
    claimed = tuple(_counted(r, symbols.limits) for r in relations(stated.claimed))
    assume = [_counted(r, symbols.limits) for r in assume]
    if all(r.left == r.right for r in claimed) and not any(r.left.has(D) for r in claimed):
        raise LatexError("both sides are the same as soon as the line is read, so that nothing is left to decide")
    rates = {found for r in (*claimed, *assume) for found in r.left.atoms(D) | r.right.atoms(D)}
    for rate in rates:
        if rate.args[0].has(D) and any(rate.has(symbol) for symbol in found_here):
            raise LatexError("a second rate of what has its rate in the line itself, which may hold at one instant "
                             "alone: give the rate under [flow]")
        if not any(rate.args[0].has(symbol) for symbol in flow):
            raise LatexError(f"a rate of {latex(rate.args[0], symbols.letters)}, which does not move: give the rates "
                             "of its letters under [flow], or before an arrow")
    varying = (*symbols.inputs, *sorted(printed_of_time(tree, converter.notation) - {*symbols.inputs}, key=str))
    return Goal(claimed, tuple(assume), flow if rates else {},
                inputs=tuple(symbol for symbol in varying if symbol not in flow) if rates else ())


def _require_told_apart(line: Line) -> None:
    """Raise LatexError for a line such as `1/x <= x, x >= 1`: whether its end is claimed too, or a condition."""
    claimed = {chain.position for chain in parted(line)[0]}
    for number, (chain, words) in enumerate(zip(line.chains, line.separators, strict=False)):
        if number and words in PARTED and chain.position in claimed and _is_bound(chain) and any(
                earlier.signs and not _is_bound(earlier) and letters_of_node(chain) & letters_of_node(earlier)
                for earlier in line.chains[:number]):
            raise LatexError(r"what stands behind the comma may be claimed or a condition: write \text{for} or "
                             r"\text{and} before it, or the condition and \Rightarrow first", chain.position)


def _counted(relation: Relation, limits: sp.Tuple | None) -> Relation:
    """The relation with the number of a vector's components as the sum of as many ones."""
    def put(expr: sp.Expr) -> sp.Expr:
        if limits is None or not expr.has(limits[2]):
            return expr
        if isinstance(expr, sp.Sum):
            return sp.Sum(put(expr.function), limits)
        return sp.Sum(1, limits) if expr == limits[2] else expr.func(*map(put, expr.args))

    return Relation(put(relation.left), relation.operator, put(relation.right))


def _is_bound(chain: Chain) -> bool:
    """Whether a chain bounds one letter by numbers."""
    return bool(chain.signs) and len(letters_of_node(chain)) == 1 and all(
        isinstance(side, (Letter, Number, Terms)) for side in chain.sides)


def _decided(claim: Claim, goal: Goal, symbols: Symbols) -> tuple[Decision, Goal]:
    """The decision, with the goal that is decided: a vector has a component, a function one value at one argument."""
    decision = decide(claim)
    certificate = decision.certificate or {}
    if decision.verdict in ("refuted", "gap") and certificate.get("terms") == [] and symbols.limits is not None:
        goal = replace(goal, assume=(*goal.assume, at_least(sp.Sum(1, symbols.limits), 1)))
        decision = decide(replace(claim, build=lambda: goal))
        certificate = decision.certificate or {}
    pairs = values_of_one_function(symbols.notation, goal)
    if decision.verdict in ("refuted", "gap") and not one_value_at_one_argument(pairs, certificate.get("point", {})):
        other = replace(goal, assume=(*goal.assume, *apart(pairs)))
        elsewhere = decide(replace(claim, build=lambda: other))
        if elsewhere.verdict in ("refuted", "gap"):
            return elsewhere, other
        return Decision(claim, "undecided", "it fails only where a function has two values at one argument", None,
                        decision.seconds), goal
    return decision, goal


def answer(line: str, symbols: Symbols, limit_s: float | None = None) -> Answer:
    """Decide a line, which stays undecided after so many seconds of processor time; raises LatexError or ClaimError
    where it is no goal."""
    goal = asked(line, symbols)
    claim = Claim(id="pasted:line", title="the pasted line", kind="inequality", printed=line, recorded="undecided",
                  build=lambda: goal, origin="ours")
    try:
        with at_most_seconds(limit_s):
            decision, goal = _decided(claim, goal, symbols)
    except OutOfTime:
        decision = Decision(claim, "undecided", out_of_time(limit_s), None, 0.0)

    def written(relation: Relation) -> str:
        return relation.latex(symbols.letters)

    return Answer(
        line, replace(decision, claim=claim), tuple(map(written, goal.show)),
        tuple(map(written, (*goal.signs(), *goal.assume))),
        tuple(rf"\frac{{d}}{{dt}} {latex(s, symbols.letters)} = {latex(rate, symbols.letters)}"
              for s, rate in goal.flow.items()),
        tuple(latex(s, symbols.letters) for s in goal.symbols()
              if s not in goal.flow and s not in goal.inputs) if goal.flow else (),
        tuple(latex(s, symbols.letters) for s in goal.inputs),
        {symbols.letters.get(name, name): value for name, value in (decision.counterexample or {}).items()})
