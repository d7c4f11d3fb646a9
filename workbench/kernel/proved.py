"""A proved goal as a Coq theorem with its proof."""

from __future__ import annotations

from typing import Any

from workbench.kernel.combination import at_once
from workbench.kernel.rules import prove, show_lemma, stated
from workbench.kernel.script import MARGINS, Script
from workbench.kernel.syntax import NotExportedError, split_margin
from workbench.kernel.theorem import Goal, texts_of
from workbench.kernel.totals import read_closed
from workbench.kernel.writing import conjunction
from workbench.proof.checker import Context, Relations, calls, margin, read_goal, split_relation


def proof_of(goal: Goal, certificate: dict[str, Any]) -> Script:
    """The script that proves what `goal.statement()` says, step by step as the certificate does.

    A sum over the index is told apart from what stands beside it; where sums are multiplied each is a number.
    """
    try:
        return _proof_of(goal, certificate, *read_goal(goal.stated))
    except NotExportedError:
        if not any(calls(text, "Sum") for text in texts_of(goal.stated)):
            raise
    return _proof_of(goal, certificate, *read_closed(goal.stated))


def _proof_of(goal: Goal, certificate: dict[str, Any], context: Context, given: Relations) -> Script:
    script = Script(context, goal)
    script.given = given.with_margins([])
    binders = goal.binders()
    names = [name for part in binders.strip("()").split(") (") for name in part.partition(" : ")[0].split()]
    names += [name for name, _ in goal.hypotheses()]
    if names:
        script.say(f"intros {' '.join(names)}.")
    for number, text in enumerate(goal.stated.get("assume", [])):
        script.defined(text)
        conditions = [script.facts.conditions[condition] for condition in goal.conditions(text)]
        script.say(f"refine {conjunction([*conditions, f'(fun assumed_{number} => _)'])}.")
        script.assumption(text, f"assumed_{number}")
    shown: list[str] = []
    open_equations = 0
    assumed, hypotheses = script.given, script.names
    for text, whole_proof in zip(goal.stated["show"], certificate["proofs"], strict=True):
        _, operator = margin(context, text)  # first, for a function's atom is that of its first argument: x or -x
        script.given, script.names = assumed, hypotheses
        proof = _defined_by_lemmas(script, text, whole_proof)
        conditions = [script.facts.conditions[condition] for condition in goal.conditions(text)]
        if (whole := at_once(script, text, operator, proof)) is not None:
            shown += [*conditions, whole]
            open_equations += 1
            continue
        # with a sum the same value may be another fraction than the checker's: what the equation says is shown
        equation, value = script.evaluate(split_margin(text))
        name = script.fresh("M")
        script.say(f"assert ({name} : {stated(script, value, operator)}).")
        with script.subproof():
            prove(script, value, operator, proof)
        shown += [*conditions, f"({MARGINS[split_relation(text)[1]]}_of _ _ _ {equation} {name})"]
    script.say(f"{'refine' if open_equations else 'exact'} {conjunction(shown)}.")
    for _ in range(open_equations):
        script.say("{ same. }")
    return script


def _defined_by_lemmas(script: Script, text: str, proof: dict[str, Any]) -> dict[str, Any]:
    """Show what a relation needs to be defined, if need be with the lemmas that its proof shows first, as the checker
    does; what is left of the proof."""
    while True:
        try:
            script.defined(text)
            return proof
        except NotExportedError:
            if proof["rule"] != "cut":
                raise
        show_lemma(script, proof)
        proof = proof["then"]
