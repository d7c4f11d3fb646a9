"""The rule `nonincreasing` in Coq: the mean value theorem, once, along the motion from time zero to the instant t."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from workbench.kernel.derivative import Differentiation
from workbench.kernel.normal import Normal
from workbench.kernel.script import Script
from workbench.kernel.syntax import NotExportedError, operation, replaced, text_of
from workbench.kernel.theorem import condition_text, partial_places
from workbench.kernel.writing import conjunction
from workbench.proof.checker import SUM, Ratio, Sign, atoms_of, parse, same, symbols_of
from workbench.proof.checker import substitute as substitute_ratio

COQ = {">": ">", ">=": ">=", "==": "=", "!=": "<>"}
Prover = Callable[[Script, Ratio, str, dict[str, Any]], None]


def nonincreasing(script: Script, proof: dict[str, Any], prove: Prover) -> tuple[Sign, str]:
    """Shows that a function of the flow is at most what it was at time zero; the relation and its hypothesis."""
    if script.normal.letters.instant != "t" or script.normal.letters.indexed:
        raise NotExportedError("a motion of indexed states")
    script.libraries.add("WorkbenchFlow")
    context = script.context
    function = parse(proof["function"])
    value = context.read(proof["function"])
    rate = Differentiation(script.rates, script.normal.letters.at("s")).of(function)
    slope = rate.value if rate.value is not None else ast.Constant(0)
    letters = script.normal.letters.at("s")
    of_s, slope_of_s = text_of(function, letters), text_of(slope, letters)
    soon = letters
    conditions = [condition_text(part, wanted, soon) for part, wanted in partial_places(proof["function"])]
    whole = " /\\ ".join([*conditions, f"is_derive (fun s => {of_s}) s {slope_of_s}", f"{slope_of_s} <= 0"])
    along = script.fresh("L")
    script.say(f"assert ({along} : forall s, 0 <= s <= t -> {whole}).")
    with script.subproof():
        _along(script, proof, function, slope, value, prove, len(conditions))
    bound = script.show("G", f"{text_of(function, script.normal.letters)} <= {text_of(function, letters.at('0'))}",
                        f"apply (nonincreasing (fun s => {of_s}) (fun s => {slope_of_s})); [exact t_later| |]; "
                        f"intros s within_; pose proof ({along} s within_) as all_; tauto.")
    return _drop(script, function, value, along, bound, proof)


def _along(script: Script, proof: dict[str, Any], function: ast.expr, slope: ast.expr, value: Ratio, prove: Prover,
           conditions: int) -> None:
    """At any instant s on the way the function is defined and its derivative along the flow is not positive."""
    context = script.context
    script.say("intros s within_.")
    kept, names, moving = script.given, list(script.names), context.moving()
    script.given = kept.free_of(moving)
    script.names = ["nothing" if symbols_of(context, old) & moving else name
                    for (old, _), name in zip(kept.margins, names, strict=True)]
    script.normal = Normal(context, script.normal.letters.at("s"))
    for name in script.rates:
        script.say(f"pose proof (rate_of_{name} s within_) as rate_{name}s. cbv beta in rate_{name}s.")
    _steady(script, moving)
    for number, text in enumerate(kept.always):
        script.say(f"pose proof (always_{number} s within_) as always_{number}s.")
        script.defined(text)
        script.assumption(text, f"always_{number}s")
    for text in (*context.rates.values(), proof["function"]):
        script.defined(text)
    soon = script.normal.letters
    found = [script.facts.conditions[condition_text(part, wanted, soon)]
             for part, wanted in partial_places(proof["function"])]
    rate = Differentiation(script.rates, script.normal.letters).of(function)
    of_s, slope_of_s = text_of(function, script.normal.letters), text_of(slope, script.normal.letters)
    term = rate.proof
    for name in script.rates:
        term = term.replace(f"rate_{name} ", f"rate_{name}s ").replace(f"rate_{name})", f"rate_{name}s)")
        term = f"rate_{name}s" if term == f"rate_{name}" else term
    derives = script.show("X", f"is_derive (fun s => {of_s}) s {slope_of_s}",
                          f"refine {term}; cbv beta; solve [assumption | reflexivity | simpl; linear | nonzero].")
    falls = -context.derivative(value, context.flow)
    equation, found_value = script.evaluate(ast.UnaryOp(ast.USub(), slope))
    if not same(found_value, falls):
        raise NotExportedError("a derivative reads differently here and in the checker")
    script.prepare_all(falls)
    name = script.fresh("M")
    script.say(f"assert ({name} : {script.normal.value(falls)} >= 0).")
    with script.subproof():
        prove(script, falls, ">=", proof["decrease"])
    down = script.show("G", f"{slope_of_s} <= 0",
                       f"generalize {equation} {name}. linear.")
    script.say(f"exact {conjunction([*found, derives, down])}.")


def _steady(script: Script, moving: set[str]) -> None:
    """What is assumed of states whose rate is zero holds at the instant s as it does at t: they are the same there."""
    letters = script.normal.letters
    steady = sorted(letters.moving - moving)
    for name in steady:
        still = script.show("H", f"forall s, 0 <= s <= t -> is_derive v_{name} s 0",
                            f"intros r between_. apply (D_same _ _ _ _ (rate_of_{name} r between_)). cbv beta. ring.")
        script.say(f"pose proof (constant v_{name} t {still} s within_) as steady_{name}.")
    change = "".join(f"rewrite ?steady_{name}. " for name in steady)
    names = []
    for (value, operator), name in zip(script.given.margins, script.names, strict=True):
        if symbols_of(script.context, value) & letters.moving:
            if atoms_of(value) & script.context.functions.keys():
                raise NotExportedError("a function of what has the rate zero")
            names.append(script.show("M", f"{script.normal.value(value)} {COQ[operator]} 0", f"{change}exact {name}."))
        else:
            names.append(name)
    script.names = names
    script.facts.nonzero = [(poly, name, strict) for poly, name, strict in script.facts.nonzero
                            if not symbols_of(script.context, Ratio(poly)) & letters.moving]


def _drop(script: Script, function: ast.expr, value: Ratio, along: str, bound: str,
          proof: dict[str, Any]) -> tuple[Sign, str]:
    """What the function was at time zero minus what it is: not negative."""
    context, given = script.context, script.given
    starts = {name: parse(text) for name, text in script.goal.stated["initial"].items()}
    at_start = replaced(function, lambda part: starts.get(part.id) if isinstance(part, ast.Name) else None)
    change = "".join(f"rewrite ?start_{name} in zero_. " for name in starts)
    script.say(f"pose proof ({along} 0 (conj (Rle_refl 0) t_later)) as zero_. {change}")
    for part, wanted in partial_places(proof["function"]):
        begun = replaced(part, lambda each: starts.get(each.id) if isinstance(each, ast.Name) else None)
        text = condition_text(begun, wanted, script.normal.letters)
        name = script.show("W", text, "tauto.")
        equation, ratio = script.evaluate(begun)
        if SUM in atoms_of(ratio):
            raise NotExportedError("a sum below a fraction bar")
        script.remember(ratio.num, script.show(
            "N", f"{script.normal.poly(ratio.num)} <> 0",
            f"intro none_. apply (not_zero {text_of(begun, script.normal.letters)}); "
            f"[first [exact {name} | apply pos_ne; exact {name}]|]. "
            f"rewrite ?{equation}. {'' if ratio.den.keys() == {()} else 'unfold Rdiv. '}rewrite none_. ring."))
    drop = substitute_ratio(context, value, given.initial) + -value
    equation, found = script.evaluate(operation(at_start, ast.Sub(), function))
    if not same(found, drop):
        raise NotExportedError("what drops reads differently here and in the checker")
    script.prepare_all(drop)
    start = "".join(f"rewrite ?start_{name} in begun_. " for name in starts)
    name = script.show("M", f"{script.normal.value(drop)} >= 0",
                       f"pose proof {bound} as begun_. {start}generalize {equation} begun_. linear.")
    return (drop, ">="), name
