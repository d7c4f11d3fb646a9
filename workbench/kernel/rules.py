"""The checker's rules as Coq proofs: each rule is a lemma of the library, each step of a certificate its use."""

from __future__ import annotations

from typing import Any

from workbench.kernel.combination import combination
from workbench.kernel.motion import COQ, nonincreasing
from workbench.kernel.normal import is_number
from workbench.kernel.script import Script
from workbench.kernel.syntax import FUNCTIONS, NotExportedError
from workbench.kernel.writing import joined_tactics
from workbench.proof.checker import (
    CASES,
    NEGATED,
    Ratio,
    margin,
    number,
    same,
    substitute,
    symbol,
)


def stated(script: Script, value: Ratio, operator: str) -> str:
    """A value's relation to zero as Coq text."""
    script.prepare_all(value)
    return f"{script.normal.value(value)} {COQ[operator]} 0"


def prove(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    """The proof of what `stated` says of a value, at the goal where the script stands."""
    rules = {"identity": _identity, "combination": combination, "cut": _cut, "cases": _cases,
             "contradiction": _contradiction, "nonincreasing": _nonincreasing}
    rule = str(proof.get("rule"))
    if rule not in rules:
        raise NotExportedError(f"the rule {rule[:40]}")
    rules[rule](script, value, operator, proof)


def _identity(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    if not value.is_zero():
        raise NotExportedError("an identity whose sides differ")
    script.say("apply Rge_refl." if operator == ">=" else "reflexivity.")


def _cut(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    show_lemma(script, proof)
    prove(script, value, operator, proof["then"])


def show_lemma(script: Script, proof: dict[str, Any]) -> None:
    """The lemma that a proof shows first, and its own proof: one more assumption in force."""
    lemma = margin(script.context, proof["lemma"])
    name = script.fresh("M")
    script.say(f"assert ({name} : {stated(script, *lemma)}).")
    with script.subproof():
        prove(script, *lemma, proof["proof"])
    script.assume(lemma, name)


def _contradiction(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    script.prepare_all(value)
    text = script.normal.value(value)
    direction, opposite = NEGATED[operator]
    script.say(f"destruct (three_cases {text}) as [case_|[case_|case_]].")
    for sign in (-1, 1, 0):
        with script.subproof():
            known = script.fresh("C")
            script.say(f"rename case_ into {known}.")  # there may be cases within
            intro, case = ("intro eq_. ", f"{known} eq_") if "!=" in (operator, opposite) else ("", known)
            if {">": sign > 0, ">=": sign >= 0, "==": sign == 0, "!=": sign != 0}[operator]:
                script.say(f"exact {known}." if operator == "==" else f"{intro}generalize {case}. linear.")
                continue
            negation, name = number(direction) * value, script.fresh("M")
            script.say(f"assert ({name} : {stated(script, negation, opposite)}).")
            turned = (f"replace {script.normal.value(negation)} with (- {text}) by {script.agree(value, True)}. "
                      if direction < 0 else "")
            script.say(f"{{ {turned}{intro if opposite == '!=' else ''}generalize "
                       f"{case if opposite == '!=' else known}. linear. }}")
            script.assume((negation, opposite), name)
            script.say("exfalso. assert (absurd : 0 > 0).")
            with script.subproof():
                combination(script, number(0), ">", proof)
            script.say("exact (Rgt_irrefl _ absurd).")


def _nonincreasing(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    drop, name = nonincreasing(script, proof, prove)
    script.assume(drop, name)
    prove(script, value, operator, proof["then"])


def _cases(script: Script, value: Ratio, operator: str, proof: dict[str, Any]) -> None:
    context = script.context
    names = tuple(sorted(proof.keys() - {"rule", "of"}))
    inspected = context.read(proof["of"])
    script.prepare_all(inspected)
    text = script.normal.value(inspected)
    if len(names) == 2:
        script.say(f"destruct (two_cases {text}) as [case_|case_].")
    else:
        script.say(f"destruct (three_cases {text}) as [case_|[case_|case_]].")
    for name, (direction, relation, sign) in zip(names, CASES[names], strict=True):
        with script.subproof():
            _case(script, value, operator, proof[name], inspected, direction, relation, sign)


def _case(script: Script, value: Ratio, operator: str, proof: dict[str, Any], inspected: Ratio, direction: int,
          relation: str, sign: int | None) -> None:
    context = script.context
    size = number(direction) * inspected
    text = script.normal.value(inspected)
    hypothesis, case = script.fresh("M"), script.fresh("C")
    script.say(f"rename case_ into {case}.")  # there may be cases within
    # the cases of the library speak of x and - x
    script.say(f"assert ({hypothesis} : {stated(script, size, relation)}).")
    script.say(f"{{ replace {script.normal.value(size)} with ({text if direction > 0 else '- ' + text}) "
               f"by {script.agree(inspected, direction < 0)}. "
               f"exact {case}. }}")
    weakly = hypothesis if relation == ">=" else f"({'Rgt_ge' if relation == '>' else 'Req_ge'} _ _ {hypothesis})"
    known: dict[str, Ratio] = {}
    rewrites: list[str] = []
    for atom, (kind, argument) in list(context.functions.items()):
        turned = same(argument, -inspected)
        if kind == "abs" and (turned or same(argument, inspected)):
            known[atom] = size
        elif kind == "sign" and sign is not None and (turned or same(argument, inspected)):
            known[atom] = number(-sign if turned else sign)
        else:
            continue
        if script.normal.name(atom) not in script.facts.atoms:
            script.prepare(symbol(atom))
        script.prepare(known[atom])
        inner = script.normal.ratio(argument)
        step = f"rewrite {script.normal.name(atom)}_is. "
        if kind == "abs":
            step += f"apply (abs_{'plus' if same(argument, size) else 'minus'} _ _ {weakly}); same."
        else:
            lemma = {1: "sgn_pos", -1: "sgn_neg", 0: "sgn_zero"}[int(is_number(known[atom]) or 0)]
            step += (f"replace {inner} with ({'- ' if turned else ''}{text}) by same. apply {lemma}. "
                     f"generalize {case}. linear.")
        rewrites.append(script.show("K", f"{script.normal.atom(atom)} = {script.normal.ratio(known[atom])}", step))

    def change() -> str:
        return "".join(f"rewrite ?{name}. " for name in reversed(rewrites))

    def case_of(old: Ratio) -> Ratio:
        done = dict(known)
        new = substitute(context, old, known, done)
        for atom in sorted(done.keys() - known.keys(), key=lambda a: int(a.partition("#")[2])):
            if not same(done[atom], symbol(atom)):
                rewrites.append(_deeper(script, atom, done, change()))
            known[atom] = done[atom]
        return new

    margins, names = [], []
    for (old, op), name in zip(script.given.margins, script.names, strict=True):
        new, known_by = case_of(old), name
        if not same(new, old):
            script.prepare_all(new)
            known_by = script.show("M", f"{script.normal.value(new)} {COQ[op]} 0",
                               f"replace {script.normal.value(new)} with {script.normal.value(old)} "
                               f"by ({joined_tactics(change())}{script.agree(old)}). exact {name}.")
        margins.append((new, op))
        names.append(known_by)
    script.given, script.names = script.given.with_margins([*margins, (size, relation)]), [*names, hypothesis]
    new = case_of(value)
    if not same(new, value):
        script.prepare_all(new)
        script.say(f"replace {script.normal.value(value)} with {script.normal.value(new)} "
                   f"by ({joined_tactics(change())}{script.agree(value)}).")
    elif script.normal.value(new) != script.normal.value(value):
        script.say(f"replace {script.normal.value(value)} with {script.normal.value(new)} "
                   f"by {script.agree(value)}.")
    prove(script, new, operator, proof)


def _deeper(script: Script, atom: str, done: dict[str, Ratio], change: str) -> str:
    """The equation of a function in whose argument a case is known."""
    kind, argument = script.context.functions[atom]
    script.prepare(symbol(atom))
    if script.normal.indexed(symbol(atom)):
        raise NotExportedError("a case inside of a function of each index")
    inner = script.normal.ratio(argument)
    new = substitute(script.context, argument, done, done)
    equation = script.function(kind, f"({FUNCTIONS[kind]} {inner})", inner, new, change)
    return script.show("K", f"{script.normal.atom(atom)} = {script.normal.ratio(done[atom])}",
                       f"rewrite {script.normal.name(atom)}_is. exact {equation}.")
