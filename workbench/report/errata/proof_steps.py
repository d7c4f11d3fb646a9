"""The proof in a certificate as steps that a reader can follow: each one line, with the reason that it is true."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from workbench.proof.checker import split_relation
from workbench.report.certificate_latex import expression_latex, relation_latex
from workbench.report.errata.blocks import Item
from workbench.report.number_style import value_latex

FACTS = {"log_tangent": r"$\ln x \le x - 1$", "exp_tangent": r"$e^x \ge 1 + x$", "exp_positive": r"$e^x > 0$",
         "enclosure": "a number, enclosed by fractions", "abs_square": r"$\left|x\right|^2 = x^2$",
         "abs_nonnegative": r"$\left|x\right| \ge 0$", "sqrt_square": r"$\sqrt{x}^2 = x$",
         "sqrt_nonnegative": r"$\sqrt{x} \ge 0$", "sqrt_positive": r"$\sqrt{x} > 0$"}
CASES = {"nonnegative": r"\ge 0", "nonpositive": r"\le 0", "negative": "< 0", "positive": "> 0", "zero": "= 0"}
LONGEST = 700  # characters of a formula beyond which it is called by what it is
LONGEST_SHOWN = 3000  # of what is to be shown, which is written out once


@dataclass(frozen=True)
class _Known:
    """What may be used: its margin (>= 0, > 0 or = 0) in the certificate language, and why it holds."""

    margin: str
    reason: str


@dataclass(frozen=True)
class _Wanted:
    """What is to be shown: its margin, and that of its opposite."""

    margin: str
    opposite: str


def proof_steps(certificate: Mapping[str, Any]) -> list[Item]:
    """The steps of a certificate of verdict `proved`, or of a correction in one: every relation shown, in turn."""
    goal = certificate["goal"]
    given = [_known(text) for text in goal.get("assume", [])]
    found = []
    for text, proof in zip(goal["show"], certificate["proofs"], strict=True):
        found.append(Item(f"To show: ${_shown(relation_latex(text), LONGEST_SHOWN)}$.", 0))
        found += _steps(_wanted(text), given, proof, 1, goal)
    return found


def _steps(value: _Wanted, given: Sequence[_Known], proof: Mapping[str, Any], depth: int,
           goal: Mapping[str, Any]) -> Iterator[Item]:
    rule = proof["rule"]
    if rule == "identity":
        yield Item("Both sides are the same: their difference is zero, multiplied out.", depth)
    elif rule == "cut":
        yield Item(f"First, ${_shown(relation_latex(proof['lemma']))}$:", depth)
        yield from _steps(_wanted(proof["lemma"]), given, proof["proof"], depth + 1, goal)
        yield Item("With it:", depth)
        yield from _steps(value, [*given, _known(proof["lemma"], "shown above")], proof["then"], depth + 1, goal)
    elif rule == "cases":
        yield from _cases(value, given, proof, depth, goal)
    elif rule == "nonincreasing":
        yield from _nonincreasing(value, given, proof, depth, goal)
    else:
        yield from _combination(value, given, proof, depth)


def _cases(value: _Wanted, given: Sequence[_Known], proof: Mapping[str, Any], depth: int,
           goal: Mapping[str, Any]) -> Iterator[Item]:
    of = expression_latex(proof["of"])
    for name, sign in CASES.items():
        if name in proof:
            yield Item(f"Where ${of} {sign}$:", depth)
            turned = name in ("nonpositive", "negative")
            margin = f"-({proof['of']})" if turned else proof["of"]
            yield from _steps(value, [*given, _Known(margin, f"the case ${of} {sign}$")], proof[name], depth + 1, goal)


def _nonincreasing(value: _Wanted, given: Sequence[_Known], proof: Mapping[str, Any], depth: int,
                   goal: Mapping[str, Any]) -> Iterator[Item]:
    function = expression_latex(proof["function"])
    yield Item(f"Along the motion $F = {_shown(function)}$ does not grow, because $-\\dot F \\ge 0$:", depth)
    along = [*given, *(_known(text, "at all times") for text in goal.get("always", []))]
    fall = _Wanted(f"-D({proof['function']})", f"D({proof['function']})")
    yield from _steps(fall, along, proof["decrease"], depth + 1, goal)
    start = _at_start(proof["function"], goal.get("initial", {}))
    drop = _Known(f"({start}) - ({proof['function']})", "$F$ is at most what it was at time zero")
    yield Item("So it is at most what it was at time zero. With that:", depth)
    yield from _steps(value, [*given, drop], proof["then"], depth + 1, goal)


def _at_start(text: str, initial: Mapping[str, str]) -> str:
    """An expression with the values at time zero in place of the letters that move."""
    return re.sub(r"[A-Za-z_]\w*", lambda found: f"({initial[found[0]]})" if found[0] in initial else found[0], text)


def _combination(value: _Wanted, given: Sequence[_Known], proof: Mapping[str, Any], depth: int) -> Iterator[Item]:
    terms = proof["terms"]
    contradiction = proof["rule"] == "contradiction"
    opposite = contradiction and any(len(given) in item.values() for term in terms for item in term["factors"])
    if opposite:
        given = [*given, _Known(value.opposite, "the opposite of what is to be shown")]
    scale = "".join(_factor(item, given)[0] for item in proof.get("multiplier", []))
    what = "If it were not so, what is assumed could not hold together, for zero" if opposite else (
        "What is assumed cannot hold together, for zero") if contradiction else (
        _difference(value.margin) + (f", times ${scale}$, which is positive," if scale else ""))
    if not terms:
        yield Item(f"{what} is zero, multiplied out.", depth)
        return
    plural = "the sum of these terms, none of them negative" if len(terms) > 1 else "this term, which is not negative"
    yield Item(f"{what} is {plural}:", depth)
    for term in terms:
        factors = [_factor(item, given) for item in term["factors"]]
        coefficient = Fraction(term["coefficient"])
        shown = value_latex(coefficient) if coefficient != 1 or not factors else ""
        shown = "-" if shown == "-1" and factors else shown
        formula = shown + " ".join(text for text, _ in factors)
        reasons = list(dict.fromkeys(reason for _, reason in factors if reason))
        yield Item(f"${_shown(formula)}$" + (f" ({'; '.join(reasons)})" if reasons else ""), depth + 1)


def _factor(item: Mapping[str, Any], given: Sequence[_Known]) -> tuple[str, str]:
    """A factor as LaTeX in brackets, and why its sign is known."""
    kind, content = next((key, item[key]) for key in ("fact", "assume", "inverse", "square_of", "square",
                                                      "sum_of_squares", "positive", "any") if key in item)
    if kind == "fact":
        return rf"\left[{_fact(content, expression_latex(item['of']))}\right]", FACTS[content]
    if kind in ("assume", "inverse", "square_of"):
        known = given[content]
        inside = expression_latex(known.margin)
        power = {"assume": "", "inverse": "^{-1}", "square_of": "^2"}[kind]
        return rf"\left[{inside}\right]{power}", known.reason
    inside = expression_latex(content)
    return {"square": (rf"\left[{inside}\right]^2", "a square"),
            "sum_of_squares": (rf"\sum_i \left[{inside}\right]^2", "a sum of squares"),
            "positive": (rf"\left[{inside}\right]", "positive"), "any": (rf"\left[{inside}\right]", "")}[kind]


def _fact(name: str, of: str) -> str:
    return {"log_tangent": rf"{of} - 1 - \ln\left({of}\right)", "exp_tangent": rf"e^{{{of}}} - 1 - \left({of}\right)",
            "exp_positive": rf"e^{{{of}}}", "enclosure": of,
            "abs_square": rf"\left|{of}\right|^2 - \left({of}\right)^2", "abs_nonnegative": rf"\left|{of}\right|",
            "sqrt_square": rf"\sqrt{{{of}}}^2 - \left({of}\right)"}.get(name, rf"\sqrt{{{of}}}")


def _known(text: str, why: str = "assumed") -> _Known:
    return _Known(_margin(text), f"{why}: ${_shown(relation_latex(text))}$")


def _wanted(text: str) -> _Wanted:
    margin = _margin(text)
    return _Wanted(margin, margin if split_relation(text)[1] in ("==", "!=") else f"-({margin})")


def _margin(text: str) -> str:
    left, operator, right = split_relation(text)
    return f"({right}) - ({left})" if operator in ("<=", "<") else f"({left}) - ({right})"


def _difference(margin: str) -> str:
    latex = expression_latex(margin)
    return f"${latex}$" if len(latex) <= LONGEST else "The difference of both sides"


def _shown(latex: str, longest: int = LONGEST) -> str:
    return latex if len(latex) <= longest else r"\text{(a long expression, which the certificate spells out)}"
