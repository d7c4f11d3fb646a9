"""What z3 is asked of a verdict, and what its answer says of it."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import z3

from workbench.proof.oracle.opinion import Opinion
from workbench.proof.oracle.rates import Flow, NotStatedError
from workbench.proof.oracle.terms import Terms

COUNTS = (1, 2)  # of terms in a sum: a solver knows no sums over any number of them
_SUM = re.compile(r"\bSum\(")
LONGEST_MODEL = 160


def opinion_on(certificate: Mapping[str, Any], seconds: float) -> Opinion:
    """What z3 says of the verdict of a certificate; `seconds` of processor time for each of at most three questions.

    Proved: no values meet what is assumed and break what is shown, or leave it undefined. Any other verdict: some do.
    Of a motion through time z3 is asked about one instant: that nothing can fail there agrees with a proof and
    contradicts a counterexample; that something can says nothing.
    """
    goal = certificate["goal"]
    if goal.get("eventually") or "functions" in certificate:
        return Opinion("not asked", "the goal speaks of later times")
    try:
        if certificate["verdict"] == "proved":
            return _on_proof(goal, seconds)
        return _on_failure(goal, certificate, seconds)
    except NotStatedError as trouble:
        return Opinion("not asked", str(trouble))
    except RecursionError:
        return Opinion("not asked", "an expression is nested too deeply")


def _on_proof(goal: Mapping[str, Any], seconds: float) -> Opinion:
    for terms in _readings(goal):
        solver = _failing(goal, terms, undefined=True)
        answer = checked(solver, seconds)
        if answer == "unknown":
            return Opinion("unknown", f"z3 finds no answer in {seconds:g} s")
        if answer == "sat" and (weak := _weakness(goal, terms)):
            return Opinion("unknown", f"{weak}: what z3 finds may not be")
        if answer == "sat":
            return Opinion("contradicted", f"proved, but z3 finds that it fails at {_shown(solver.model())}")
    return Opinion("agreed", _scope(goal))


def _on_failure(goal: Mapping[str, Any], certificate: Mapping[str, Any], seconds: float) -> Opinion:
    verdict, unsure, told = certificate["verdict"], "", ""
    for terms in _readings(goal):
        for at_point in (True, False):  # its numbers are decided at once; of a condition they are stated
            if not at_point and verdict == "violated":
                continue
            values = certificate.get("point", {}) if at_point else {}
            if at_point and not values:
                continue
            answer = checked(_failing(goal, terms, values), seconds)
            if answer == "sat" and not (weak := _weakness(goal, terms)):
                return Opinion("agreed", _scope(goal))
            if answer == "sat":
                return Opinion("unknown", f"{weak}: what z3 finds may not be")
            told = answer
        unsure = unsure or (f"z3 finds no answer in {seconds:g} s" if told == "unknown" else "")
    if unsure:
        return Opinion("unknown", unsure)
    if _has_sums(goal):
        return Opinion("unknown", f"holds for sums of {' or '.join(map(str, COUNTS))} terms")
    return Opinion("contradicted", f"{verdict}, but z3 shows that it cannot fail"
                   + (" at the stated values" if verdict == "violated" else ""))


def _failing(goal: Mapping[str, Any], terms: Terms, values: Mapping[str, str] | None = None,
             undefined: bool = False) -> z3.Solver:
    """A solver that looks for an instant at which all that is assumed holds and has values, and what is shown does not
    hold; values: of symbols, where they are given; undefined: whether what is shown may have no values there."""
    solver = z3.Solver()
    solver.add(*(terms.relation(text) for text in (*goal.get("assume", []), *goal.get("always", []))))
    solver.add(*terms.defined)
    terms.defined.clear()
    shown = z3.And(*(terms.relation(text) for text in goal["show"]))
    solver.add(z3.Not(z3.And(shown, *terms.defined)) if undefined else z3.And(z3.Not(shown), *terms.defined))
    solver.add(*(z3.Real(f"{name}[0]" if name in terms.indexed else name) == z3.RealVal(value)
                 for name, value in (values or {}).items()))
    terms.defined.clear()
    solver.add(*terms.true)
    return solver


def _readings(goal: Mapping[str, Any]) -> Iterator[Terms]:
    """Readers of the goal, with each number of terms that its sums are given."""
    rates = {name: Terms.read(text) for name, text in goal.get("flow", {}).items()}
    first = Terms(Flow(rates, frozenset(goal.get("inputs", []))), frozenset(goal.get("indexed", [])))
    for count in COUNTS if _has_sums(goal) else COUNTS[:1]:
        yield first.with_count(count)


def _weakness(goal: Mapping[str, Any], terms: Terms) -> str:
    """Why values that z3 finds may be none, empty where they are."""
    if terms.loose:
        return f"z3 knows too little of {', '.join(sorted(terms.loose))}"
    if goal.get("initial") or goal.get("always"):
        return "the goal speaks of a motion from time zero on, and z3 was asked about one instant"
    return ""


def _has_sums(goal: Mapping[str, Any]) -> bool:
    texts = (*goal.get("assume", []), *goal.get("always", []), *goal["show"], *goal.get("flow", {}).values())
    return bool(goal.get("indexed")) or any(_SUM.search(text) for text in texts)


def _scope(goal: Mapping[str, Any]) -> str:
    return f"for sums of {' and '.join(map(str, COUNTS))} terms" if _has_sums(goal) else ""


def _shown(model: z3.ModelRef) -> str:
    """The values of a model in a line."""
    said = ", ".join(sorted(f"{entry.name()} = {model[entry]}" for entry in model if entry.arity() == 0))
    said = " ".join(said.split())
    return said if len(said) <= LONGEST_MODEL else f"{said[:LONGEST_MODEL]} ..."


def checked(solver: z3.Solver, seconds: float) -> str:
    """sat, unsat or unknown, in at most so many seconds of processor time."""
    started, done = time.process_time(), threading.Event()

    def interrupt() -> None:  # its own limits are of the wall clock, or of steps
        while not done.wait(0.02):
            if time.process_time() - started > seconds:
                solver.ctx.interrupt()

    watch = threading.Thread(target=interrupt, daemon=True)
    watch.start()
    try:
        return str(solver.check())
    except z3.Z3Exception:
        return "unknown"
    finally:
        done.set()
        watch.join()


def implied(assumed: Sequence[Any], shown: Any, seconds: float) -> str:
    """unsat where nested statements, as obligations have them, imply one: nothing meets them and not it; sat where
    something does; unknown. Fractions are as z3 has them: with some value where they are not defined."""
    terms, solver = Terms(), z3.Solver()
    try:
        solver.add(*(_nested(terms, statement) for statement in assumed), z3.Not(_nested(terms, shown)))
    except NotStatedError:
        return "unknown"
    solver.add(*terms.true)
    answer = checked(solver, seconds)
    return "unknown" if answer == "sat" and terms.loose else answer


def _nested(terms: Terms, statement: Sequence[Any]) -> Any:
    name, *parts = statement
    if name in ("and", "or", "not"):
        return {"and": z3.And, "or": z3.Or, "not": z3.Not}[name](*(_nested(terms, part) for part in parts))
    left, right = parts
    return terms.related(name, left, right)
