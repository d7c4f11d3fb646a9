"""What a corrected statement holds for: what its proof assumes and along which motion, and the same of what it uses."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.proof.besides import RATES, STARTS
from workbench.proof.checker import calls
from workbench.proof.places import place_of
from workbench.proof.verdict import Decision
from workbench.proof.wording import listed
from workbench.report.certificate_latex import SIGNS, expression_latex, name_latex, rate_latex, relation_latex
from workbench.report.dots import only_names
from workbench.report.letters import Letters, letters_of

Goal = Mapping[str, Any]
_SIGN = re.compile(r"([A-Za-z_]\w*) (>=?|!=) 0")


@dataclass(frozen=True)
class Need:
    """What one statement holds for, as LaTeX.

    equation: of the line that says it, empty for the corrected statement itself; title: what that is called; statement:
    what it says; conditions: what is assumed, without what the lines show that it uses; rates: the motion along which
    it holds, of the letters whose rates matter; uses: the paper's own lines that its proof uses, each with what it
    assumes beyond that; letters: what those letters are that the paper does not have.
    """

    equation: str
    title: str
    statement: str
    conditions: tuple[str, ...]
    rates: tuple[str, ...]
    uses: tuple[str, ...]
    letters: str


def needs_of(d: Decision, mended: Decision | None, by_id: Mapping[str, Decision]) -> tuple[Need, ...]:
    """What the nearest true statement of a line holds for; then, of a mended form, what the lines of ours say that its
    proof uses, directly or not, and what they hold for. Nothing for numbers with which a condition holds."""
    if d.correction:
        goal = ((d.certificate or {}).get("correction") or {}).get("goal")
        return () if goal is None or d.verdict == "violated" else (_need(d, goal, "", "", {}),)
    if mended is None or not mended.certificate:
        return ()
    return (_need(mended, mended.certificate["goal"], "", "", by_id),
            *(_need(used, used.certificate["goal"], used.claim.equation, used.claim.printed, by_id)
              for used in _used(mended, by_id) if used.certificate))


def _used(d: Decision, by_id: Mapping[str, Decision]) -> Iterator[Decision]:
    """The proved lines of ours that a proof uses, directly or not."""
    seen, waiting = {d.claim.id}, [d]
    while waiting:
        for name in waiting.pop(0).claim.premises:
            found = by_id.get(name)
            if found is None or name in seen or found.claim.origin != "ours" or found.verdict != "proved":
                continue
            seen.add(name)
            waiting.append(found)
            yield found


def _need(d: Decision, goal: Goal, equation: str, statement: str, by_id: Mapping[str, Decision]) -> Need:
    shown = {text for name in d.claim.premises if name in by_id
             for text in ((by_id[name].certificate or {}).get("goal") or {}).get("show", [])}
    letters = letters_of(d)
    conditions = tuple(map(letters.in_formula, conditions_of(goal, shown)))
    rates = tuple(rate for rate in map(letters.in_formula, motion_of(goal)) if not only_names(rate))
    uses = tuple(_with_its_own(found, d, letters) for name in d.claim.premises
                 if (found := by_id.get(name)) is not None and found.claim.origin != "ours")
    return Need(equation, d.claim.title if equation else "", statement, conditions, rates, uses,
                letters.legend((*conditions, *rates)))


def _with_its_own(used: Decision, d: Decision, letters: Letters) -> str:
    """A line of the paper that a proof uses, and what that assumes beyond the proof's own conditions."""
    where = f" ({used.claim.equation})"
    own = [text.removesuffix(where) for text in d.besides if text.endswith(where)]
    told = [f"${letters.in_formula(relation_latex(text))}$" for text in own if not text.startswith((RATES, STARTS))]
    told += [said for words, said in ((RATES, "its rates"), (STARTS, "its initial values"))
             for text in own if text.startswith(words)]
    return place_of(used.claim.equation, used.claim.title) + (f" with {listed(told)}" if told else "")


def conditions_of(goal: Goal, shown: Collection[str] = ()) -> list[str]:
    """What a goal assumes, as LaTeX, without what is shown elsewhere; the signs of letters last."""
    given = [text for text in (*goal.get("assume", []), *goal.get("always", [])) if text not in shown]
    return [*_relations(given), *signs(given)]


def _relations(texts: Sequence[str]) -> list[str]:
    found = (relation_latex(text) for text in dict.fromkeys(texts) if not _SIGN.fullmatch(text))
    return [text for text in found if text != "0 = 0"]


def signs(relations: Sequence[str]) -> Iterator[str]:
    """The signs of single letters as LaTeX, those of one sign together."""
    for operator in (">", ">=", "!="):
        letters = dict.fromkeys(expression_latex(found[1]) for text in relations
                                if (found := _SIGN.fullmatch(text)) and found[2] == operator)
        if letters:
            yield f"{', '.join(letters)} {SIGNS[operator]} 0"


def motion_of(goal: Goal) -> list[str]:
    """The motion that a goal speaks of, as LaTeX: where it begins and the rates; none where no rate matters."""
    flow, initial = goal.get("flow", {}), goal.get("initial", {})
    told = [*goal.get("assume", []), *goal["show"]]
    if not (initial or goal.get("eventually") or any(calls(text, "D") for text in told)):
        return []
    moving = [name for name in flow if (flow[name] != "0" or initial.get(name) != name) and not only_names(
        rate_latex(name, flow[name]))]
    return [*(f"{name_latex(name)}(0) = {expression_latex(initial[name])}" for name in initial if name in moving),
            *(rate_latex(name, flow[name]) for name in moving)]
