"""A point at which a goal fails, as a Coq theorem: there are values at which all assumptions hold, every relation shown
is defined, and they do not all hold."""

from __future__ import annotations

import ast
from fractions import Fraction
from typing import Any

from workbench.kernel import theorem
from workbench.kernel.derivative import Differentiation
from workbench.kernel.normal import is_number
from workbench.kernel.script import MARGINS, Script
from workbench.kernel.syntax import (
    RELATIONS,
    NotExportedError,
    call,
    called,
    operation,
    relation_text,
    replaced,
    split_margin,
    text_of,
)
from workbench.kernel.theorem import EACH, Goal
from workbench.kernel.writing import conjunction
from workbench.proof.checker import bounds, margin, parse, read_goal, split_relation


def statement_of(goal: Goal) -> str:
    """That there is a point at which the goal fails."""
    parts: list[str] = [text for _, text in goal.hypotheses()]
    for text in goal.stated.get("assume", []):
        parts += [*goal.conditions(text), relation_text(text, goal.letters)]
    for text in goal.stated["show"]:
        parts += goal.conditions(text)
    shown = " /\\ ".join(f"({relation_text(text, goal.letters)})" for text in goal.stated["show"])
    parts.append(f"~ ({shown})")
    binders = goal.binders()
    return (f"exists {binders},\n  " if binders else "") + " /\\\n  ".join(f"({part})" for part in parts)


def proof_at_point(goal: Goal, certificate: dict[str, Any]) -> Script:
    """The script that proves what `statement_of` says, by the certificate's values."""
    if goal.kind == "motion" or "functions" in certificate or "path" in certificate:
        raise NotExportedError("a point of a motion: that it goes on from there is not shown in Coq")
    if "roots" in certificate:
        raise NotExportedError("a point that is a root: no theorem of intermediate values is used in Coq")
    values = {name: number_of(Fraction(text)) for name, text in certificate["point"].items()}
    indexed = goal.letters.indexed
    rows = [{name: number_of(Fraction(text)) for name, text in row.items()} for row in certificate["terms"]
            ] if "terms" in certificate else [{name: values[name] for name in indexed & values.keys()}]
    if indexed and (not rows or any(row.keys() != indexed for row in rows)):
        raise NotExportedError("a point of sums without terms")
    if indexed and goal.kind != "static" and len(rows) > 1:
        raise NotExportedError("a point of rates with several terms of a sum")
    if missing := (set(goal.constants) | goal.letters.moving - indexed) - values.keys():
        raise NotExportedError(f"a point without a value for {min(missing)}")
    here = _Here(goal, values, rows)
    here.prove()
    return here.script


def number_of(value: Fraction) -> ast.expr:
    """A rational number as an expression."""
    size: ast.expr = ast.Constant(abs(value.numerator))
    if value < 0:
        size = ast.UnaryOp(ast.USub(), size)
    return size if value.denominator == 1 else operation(size, ast.Div(), ast.Constant(value.denominator))


class _Here:
    """The proof at one point: every expression becomes one of numbers."""

    def __init__(self, goal: Goal, values: dict[str, ast.expr], rows: list[dict[str, ast.expr]]) -> None:
        self.goal, self.values, self.rows = goal, values, rows
        context, _ = read_goal({"show": []})
        self.script = Script(context, theorem.read({"show": []}))
        self.letters = goal.letters.at("0")
        self.derivatives: dict[str, tuple[str, ast.expr, str]] = {}

    def closed(self, node: ast.expr, row: dict[str, ast.expr] | None = None) -> ast.expr:
        """An expression with numbers for its symbols, sums written out."""
        known = self.values | (row or {})

        def new(part: ast.expr) -> ast.expr | None:
            if called(part, "Sum"):
                total: ast.expr = ast.Constant(0)
                for each in self.rows if self.goal.letters.indexed else [{}]:
                    total = operation(total, ast.Add(), self.closed(part.args[0], each))  # type: ignore[attr-defined]
                return total
            if called(part, "D"):
                return self.closed(self.derivative(part)[1], row)
            return known.get(part.id) if isinstance(part, ast.Name) else None

        if isinstance(node, ast.Call):
            if found := new(node):
                return found
            return call(node.func.id, *(self.closed(part, row) for part in node.args))  # type: ignore[attr-defined]
        return replaced(node, lambda part: new(part) if not isinstance(part, ast.Call) or called(part, "Sum", "D")
                        else self.closed(part, row))

    def partly(self, node: ast.expr) -> ast.expr:
        """An expression with numbers for its constants alone."""
        fixed = {name: value for name, value in (self.values | next(iter(self.rows), {})).items()
                 if name not in self.goal.letters.moving}

        def new(part: ast.expr) -> ast.expr | None:
            if isinstance(part, ast.Call):
                return call(part.func.id, *(self.partly(each) for each in part.args))  # type: ignore[attr-defined]
            return fixed.get(part.id) if isinstance(part, ast.Name) else None

        return replaced(node, new)

    def derivative(self, node: ast.expr) -> tuple[str, ast.expr, str]:
        """The equation of a derivative D(...), its expression, and that there is one."""
        inner = self.partly(node.args[0])  # type: ignore[attr-defined]
        key = text_of(inner, self.letters)
        if key not in self.derivatives:
            rates = {name: self.partly(rate) for name, rate in self.goal.rates.items()}
            found = Differentiation(rates, self.letters).of(inner)
            value = found.value if found.value is not None else ast.Constant(0)
            function, worth = f"(fun s => {text_of(inner, self.letters.at('s'))})", text_of(value, self.letters)
            each = EACH if theorem.of_each_index(node.args[0], self.letters) else ""  # type: ignore[attr-defined]
            intros, at = ("intros i. ", " i") if each else ("", "")
            derives = self.script.show("X", f"{each}is_derive {function} 0 {worth}",
                                       f"{intros}refine {found.proof}; cbv beta; "
                                       "solve [assumption | reflexivity | simpl; linear | nonzero].")
            exists = self.script.show("Y", f"{each}ex_derive {function} 0",
                                      f"{intros}exists {worth}. exact ({derives}{at}).")
            equation = self.script.show("D", f"{each}(Derive {function} 0) = {worth}",
                                        f"{intros}apply is_derive_unique. exact ({derives}{at}).")
            self.derivatives[key] = equation, value, exists
        return self.derivatives[key]

    def moved(self, statement: str, proof: str, each: str = "") -> str:
        """A statement of the motion's values, from the same of numbers; `each`: of every index i."""
        if self.goal.kind == "static":
            return f"(fun _ : nat => {proof})" if each else proof
        intros = "intros i. " if each else ""
        rates = "".join(f"rewrite ?{equation}. " for equation, _, _ in self.derivatives.values())
        if "bigsum" in statement:  # no rewriting reaches below an index: the sum of one term is written out between
            rates += f"cbv [bigsum n]. {rates}"
        at = "".join(f"rewrite ?v_{name}_at. " for name in self.goal.rates)
        return self.script.show("W", f"{each}{statement}", f"{intros}{rates}{at}exact {proof}.")

    def prove(self) -> None:
        """Values first, then all parts of the statement in their order."""
        goal, script = self.goal, self.script
        binders = goal.binders()
        letters = script.normal.letters
        for group in binders.strip("()").split(") (") if binders else []:
            names, _, kind = group.partition(" : ")
            for name in names.split():
                if name[2:] in goal.letters.moving:
                    row = self.rows[0] if name[2:] in goal.letters.indexed else {}
                    at = text_of((self.values | row)[name[2:]], letters)
                    slope = text_of(self.closed(goal.rates[name[2:]], row), letters)
                    script.libraries.add("WorkbenchFlow")
                    script.say(f"destruct ({'motions' if row else 'motion'} 0 {at} {slope}) as "
                               f"[{name} [{name}_at {name}_rate]]. exists {name}.")
                elif name == "t":
                    script.say("exists 0.")
                elif kind == "nat":
                    script.say(f"pose (n := {len(self.rows) if goal.letters.indexed else 1}%nat). exists n.")
                elif kind == "nat -> R":
                    each = [text_of(row[name[2:]], letters) for row in self.rows]
                    cases = "".join(f"{number}%nat => {text} | " for number, text in enumerate(each[:-1]))
                    script.say(f"exists (fun i => match i with {cases}_ => {each[-1]} end)." if cases
                               else f"exists (fun _ => {each[-1]}).")
                else:
                    script.say(f"exists {text_of(self.values[name[2:]], letters)}.")
        parts: list[str] = []
        for name, rate in goal.rates.items():
            of, at = (EACH, " i") if name in goal.letters.indexed else ("", "")
            slope = text_of(self.partly(rate), self.letters)
            parts.append(self.moved(f"is_derive (v_{name}{at}) 0 {slope}", f"(v_{name}_rate{at})", of))
            script.say(f"pose proof {parts[-1]} as rate_{name}.")
        for text in goal.stated.get("assume", []):
            parts += [*self.conditions(text), self.relation(text)]
        for text in goal.stated["show"]:
            parts += self.conditions(text)
        parts.append(self.failing())
        script.say(f"exact {conjunction(parts)}.")

    def conditions(self, text: str) -> list[str]:
        """That a relation is defined at the point."""
        found = []
        for condition, part, wanted in self.goal.places(text, self.goal.letters):
            if wanted == "derivative":
                found.append(self.derivative(part)[2])
                continue
            if not condition.startswith("forall"):
                here = theorem.condition_text(self.partly(part), wanted, self.letters)
                found.append(self.moved(here, self.condition(self.closed(part), wanted)))
                continue
            each = [self.condition(self.closed(part, row), wanted) for row in self.rows]
            if len(each) > 1:
                raise NotExportedError("several terms of a sum, each with a condition")
            here = theorem.condition_text(self.partly(part), wanted, self.letters).removeprefix(EACH)
            found.append(self.moved(here, each[0], EACH))
        return found

    def condition(self, node: ast.expr, wanted: str) -> str:
        """That an expression of numbers has the sign that is wanted."""
        equation, value = self.script.evaluate(node)
        low, _ = bounds(self.script.context, value)
        text = text_of(node, self.script.normal.letters)
        relation = {"positive": "0 < {}", "non-negative": "0 <= {}"}.get(wanted, "{} > 0" if low > 0 else "{} < 0")
        worth = self.script.normal.ratio(value)
        sign = self.script.show("V", relation.format(worth), self._decide(value, worth))
        proof = f"rewrite ?{equation}. generalize {sign}. linear."
        if wanted == "non-zero":
            return self.script.show("W", f"{text} <> 0", proof)
        return self.script.show("W", relation.format(text), proof)

    def _decide(self, value: object, worth: str) -> str:
        if is_number(value) is not None:  # type: ignore[arg-type]
            return "linear."
        self.script.libraries.add("Interval")
        names = sorted(self.script.facts.atoms, key=lambda name: -int(name[1:]))
        return "".join(f"rewrite ?{name}_is. " for name in names) + "interval with (i_prec 120)."

    def relation(self, text: str, wanted: bool = True) -> str:
        """That a relation holds at the point, or that it does not."""
        left, operator, right = split_relation(text)
        node = self.closed(split_margin(text))
        equation, value = self.script.evaluate(node)
        worth = self.script.normal.ratio(value)
        sign = {"<=": ">=", "<": ">"}.get(operator, operator)
        if wanted:
            coq = {"==": "=", "!=": "<>"}.get(sign, sign)
            if sign == "!=":
                shown = self._apart(value, worth)
            else:
                shown = self.script.show("V", f"{worth} {coq} 0", self._decide(value, worth))
            return self.moved(self._partly(text), f"({MARGINS[operator]}_of _ _ _ {equation} {shown})")
        if sign == "==":
            against = self._apart(value, worth)
        else:
            exact = is_number(value) is not None
            opposite = "=" if sign == "!=" else ("<=" if sign == ">" and exact else "<")
            against = self.script.show("V", f"{worth} {opposite} 0", self._decide(value, worth))
        stated = f"{text_of(self.closed(parse(left)), self.script.normal.letters)} " \
                 f"{RELATIONS[operator]} {text_of(self.closed(parse(right)), self.script.normal.letters)}"
        false = self.script.show("U", f"~ ({stated})", f"intro holds_. generalize ({MARGINS[operator]}_margin _ _ _ "
                                                      f"holds_ {equation}) {against}. linear.")
        return self.moved(f"~ ({self._partly(text)})", false)

    def _partly(self, text: str) -> str:
        left, operator, right = split_relation(text)
        sides = [text_of(self.partly(parse(side)), self.letters) for side in (left, right)]
        return f"{sides[0]} {RELATIONS[operator]} {sides[1]}"

    def _apart(self, value: Any, worth: str) -> str:
        low, _ = bounds(self.script.context, value)
        relation = ">" if low > 0 else "<"
        sign = self.script.show("V", f"{worth} {relation} 0", self._decide(value, worth))
        return self.script.show("V", f"{worth} <> 0", f"generalize {sign}. linear.")

    def failing(self) -> str:
        """That not all relations shown hold."""
        context = self.script.context
        shown = self.goal.stated["show"]
        for number, text in enumerate(shown):
            value = context.node(self.closed(split_margin(text)))
            low, high = bounds(context, value)
            _, operator = margin(context, f"0 {split_relation(text)[1]} 0")
            fails = {">": high <= 0, ">=": high < 0, "==": low > 0 or high < 0, "!=": low == high == 0}[operator]
            if fails:
                false = self.relation(text, wanted=False)
                term = "all_"
                for _ in range(number):
                    term = f"(proj2 {term})"
                if number < len(shown) - 1:  # of a conjunction to the right
                    term = f"(proj1 {term})"
                return f"(fun all_ => {false} {term})"
        raise NotExportedError("a point at which no single relation is seen to fail")
