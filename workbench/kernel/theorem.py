"""What a goal says, as Coq text, and the walk through it: assumption by assumption, then each relation shown."""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from workbench.kernel.syntax import Letters, NotExportedError, called, names_in, relation_text, text_of
from workbench.proof.checker import calls, has_relation, parse, partial_operations, split_relation

EACH = "forall i : nat, "


@dataclass(frozen=True)
class Goal:
    """A certificate's goal, and how its symbols are written.

    `kind` is 'static' (no time), 'rate' (derivatives at one instant) or 'motion' (from time zero to the instant t).
    """

    stated: dict[str, Any]
    kind: str
    letters: Letters
    constants: tuple[str, ...]

    @property
    def flow(self) -> dict[str, str]:
        """The rates, where time matters."""
        return self.stated.get("flow", {}) if self.kind != "static" else {}

    @property
    def rates(self) -> dict[str, ast.expr]:
        """The same, read."""
        return {name: parse(rate) for name, rate in self.flow.items()}

    def binders(self) -> str:
        """The symbols that a statement is about, with what each is."""
        letters = self.letters
        groups = {"nat -> R -> R": letters.moving & letters.indexed, "nat -> R": letters.indexed - letters.moving,
                  "R -> R": letters.moving - letters.indexed, "R": set(self.constants)}
        found = ["(n : nat)"] if letters.indexed or self._sums() else []
        found += [f"({' '.join(f'v_{name}' for name in sorted(names))} : {kind})"
                  for kind, names in reversed(groups.items()) if names]
        return " ".join(found + (["(t : R)"] if self.kind != "static" else []))

    def _sums(self) -> bool:
        return any(calls(text, "Sum") for text in texts_of(self.stated))

    def hypotheses(self) -> list[tuple[str, str]]:
        """(name, text) of what is assumed of the motion."""
        letters, found = self.letters, list[tuple[str, str]]()
        if self.kind == "rate":
            for name, rate in self.rates.items():
                each, at = ("forall i : nat, ", " i") if name in letters.indexed else ("", "")
                moving = f"(v_{name} i)" if at else f"v_{name}"
                found.append((f"rate_{name}", f"({each}is_derive {moving} t {text_of(rate, letters)})"))
        if self.kind == "motion":
            found.append(("t_later", "0 <= t"))
            soon = letters.at("s")
            for name, rate in self.rates.items():
                found.append((f"rate_of_{name}",
                              f"(forall s, 0 <= s <= t -> is_derive v_{name} s {text_of(rate, soon)})"))
            for name, text in self.stated.get("initial", {}).items():
                found.append((f"start_{name}", f"{letters.at('0').symbol(name)} = {text_of(parse(text), letters)}"))
            for number, text in enumerate(self.stated.get("always", [])):
                found.append((f"always_{number}", f"(forall s, 0 <= s <= t -> {relation_text(text, soon)})"))
        return found

    def conditions(self, text: str) -> list[str]:
        """What a relation needs to be defined, innermost first; of a derivative also that there is one."""
        return [condition for condition, _, _ in self.places(text, self.letters)]

    def places(self, text: str, letters: Letters) -> Iterable[tuple[str, ast.expr, str]]:
        """(condition, expression, 'non-zero', 'positive', 'non-negative' or 'derivative')."""
        found = list[tuple[str, ast.expr, str]]()
        derived = calls(text, "D")
        rates = [part for rate in self.flow.values() for part in partial_places(rate)] if derived else []
        for part, wanted in [*reversed(rates), *reversed(partial_places(text))]:
            found.append((condition_text(part, wanted, letters), part, wanted))
        for side in sides_of(text):
            for node in ast.walk(parse(side)):
                if called(node, "D"):
                    inner = node.args[0]  # type: ignore[attr-defined]
                    each = EACH if of_each_index(inner, letters) else ""
                    derivable = f"ex_derive (fun s => {text_of(inner, letters.at('s'))}) {letters.instant}"
                    found.append((f"({each}{derivable})" if each else derivable, node, "derivative"))  # type: ignore[arg-type]
        return list({condition: (condition, part, wanted) for condition, part, wanted in found}.values())

    def statement(self) -> str:
        """The goal: under its assumptions, each of them defined, every relation shown is defined and holds."""
        shown = " /\\\n  ".join(self._defined(text, f"({relation_text(text, self.letters)})", "/\\")
                               for text in self.stated["show"])
        lines = []
        for text in self.stated.get("assume", []):
            lines.append(self._defined(text, f"({relation_text(text, self.letters)} ->", "/\\"))
        closing = ")" * len(lines)
        binders = self.binders()
        start = f"forall {binders},\n  " if binders else ""
        given = "".join(f"{text} ->\n  " for _, text in self.hypotheses())
        return start + given + "\n  ".join([*lines, shown]) + closing

    def _defined(self, text: str, relation: str, joined: str) -> str:
        conditions = self.conditions(text)
        return "".join(f"({condition}) {joined} " for condition in conditions) + relation


def partial_places(text: str) -> list[tuple[ast.expr, str]]:
    """Where an expression or relation may be undefined. A whole number below a fraction bar, other than 0, is not asked
    for: coefficients bring hundreds of them, and a conjunction costs Coq the square of its length."""
    return [(part, wanted) for part, wanted in partial_operations(text)
            if not (wanted == "non-zero" and isinstance(part, ast.Constant) and part.value)]


def condition_text(part: ast.expr, wanted: str, letters: Letters) -> str:
    """What an expression needs to be defined, as Coq text."""
    text = text_of(part, letters)
    condition = {"non-zero": f"{text} <> 0", "positive": f"0 < {text}", "non-negative": f"0 <= {text}"}[wanted]
    return f"{EACH}{condition}" if of_each_index(part, letters) else condition


def of_each_index(node: ast.expr, letters: Letters) -> bool:
    """Whether an expression has a value for each index: one with a sum is a single number."""
    return bool(names_in(node) & letters.indexed) and not _bound(node)


def _bound(node: ast.AST) -> bool:
    """Whether indexed symbols stand inside sums only: such an expression is one number."""
    return called(node, "Sum") or (not isinstance(node, ast.Name) and any(
        called(part, "Sum") for part in ast.walk(node)))


def sides_of(text: str) -> tuple[str, ...]:
    """The sides of a relation, or the expression itself."""
    return split_relation(text)[::2] if has_relation(text) else (text,)


def texts_of(stated: dict[str, Any]) -> list[str]:
    """All expressions and relations of a goal."""
    return [text for key in ("assume", "show", "always") for text in stated.get(key, [])] + [
        text for key in ("flow", "initial") for text in stated.get(key, {}).values()]


def read(stated: dict[str, Any]) -> Goal:
    """A goal with its letters; NotExportedError where it has no Coq text."""
    if stated.get("eventually"):
        raise NotExportedError("a statement of some later time")
    flow = stated.get("flow", {})
    if stated.get("always") or stated.get("initial"):
        kind = "motion"
    else:
        kind = "rate" if any(calls(text, "D") for text in texts_of(stated)) else "static"
    moving = set(flow) if kind != "static" else set()
    if kind == "motion":
        moving |= set(stated.get("inputs", []))
    indexed = set(stated.get("indexed", []))
    if kind == "motion" and indexed & moving:
        raise NotExportedError("a motion of indexed states")
    letters = Letters(frozenset(moving), frozenset(indexed))
    used: set[str] = set(stated.get("initial", {}))
    texts = texts_of(stated) if kind != "static" else [*stated.get("assume", []), *stated["show"]]
    for text in texts:
        for side in sides_of(text):
            used |= names_in(parse(side))
    return Goal(stated, kind, letters, tuple(sorted(used - moving - indexed)))
