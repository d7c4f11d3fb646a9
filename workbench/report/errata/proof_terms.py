"""The terms of a combination as a reader would write them: one fraction each, in which [3] is the difference of the
sides of line [3]."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from workbench.proof.checker import parse, split_relation
from workbench.report.certificate_latex import expression_latex, factor_latex
from workbench.report.sum_index import index_of

FACTS = {"log_tangent": r"$\ln x \le x - 1$", "exp_tangent": r"$e^x \ge 1 + x$", "exp_positive": r"$e^x > 0$",
         "enclosure": "a number, enclosed by fractions", "abs_square": r"$\left|x\right|^2 = x^2$",
         "abs_nonnegative": r"$\left|x\right| \ge 0$", "sqrt_square": r"$\sqrt{x}^2 = x$",
         "sqrt_nonnegative": r"$\sqrt{x} \ge 0$", "sqrt_positive": r"$\sqrt{x} > 0$"}
POSITIVE_FACTS = frozenset(("exp_positive", "sqrt_positive"))


@dataclass(frozen=True)
class Known:
    """What may be used: its margin (> 0, >= 0, = 0 or != 0) in the certificate language; mark: what it is called in
    sums; key: of the line that says so, None for the sign of a letter; cases: those it holds in."""

    margin: str
    operator: str
    mark: str
    key: int | None = None
    cases: frozenset[int] = frozenset()


@dataclass
class Sum:
    """A sum of terms as LaTeX, which lines it uses, by which facts its terms are of known sign, and a term that is
    positive."""

    terms: list[str] = field(default_factory=list)
    used: set[int] = field(default_factory=set)
    facts: list[str] = field(default_factory=list)
    positive: str | None = None
    cases: frozenset[int] = frozenset()

    @property
    def latex(self) -> str:
        """All terms, with their signs between them."""
        text = " + ".join(self.terms).replace("+ -", "- ")
        return text or "0"


def margin_of(relation: str) -> tuple[str, str]:
    """A relation as its greater side less its smaller one, and the sign that this has."""
    left, operator, right = split_relation(relation)
    if operator in ("<=", "<"):
        return f"({right}) - ({left})", operator.replace("<", ">")
    return (left if right.strip() == "0" else f"({left}) - ({right})"), operator


def sum_of(terms: Sequence[Mapping[str, Any]], given: Sequence[Known]) -> Sum:
    """The terms of a combination, put together from what is given."""
    found = Sum()
    for term in terms:
        coefficient = Fraction(term["coefficient"])
        factors = [_factor(item, given, found) for item in term["factors"]]
        latex = product_latex(coefficient, [part for parts, _ in factors for part in parts])
        found.terms.append(latex)
        if coefficient > 0 and all(strict for _, strict in factors) and found.positive is None:
            found.positive = latex
    return found


def product_latex(coefficient: Fraction, factors: Sequence[tuple[str, int]]) -> str:
    """A product of factors and their powers as one fraction; sums over an index stand behind it."""
    powers: dict[str, int] = {}
    for latex, power in factors:
        powers[latex] = powers.get(latex, 0) + power
    above = [_raised(latex, power) for latex, power in powers.items() if power > 0 and not latex.startswith(r"\sum")]
    below = [_raised(latex, -power) for latex, power in powers.items() if power < 0]
    sums = [latex for latex in powers if latex.startswith(r"\sum")]
    whole, part = abs(coefficient.numerator), coefficient.denominator
    above.sort(key=lambda latex: (latex.startswith(r"\left("), not latex.startswith("\ue001")))
    above = ([str(whole)] if whole != 1 or not (above or (sums and not below and part == 1)) else []) + above
    below = ([str(part)] if part != 1 else []) + below
    if not below and not sums and len(above) == 1 and _in_brackets(above[0]) and coefficient > 0:
        return above[0].removeprefix(r"\left(").removesuffix(r"\right)")
    fraction = rf"\frac{{{' '.join(above)}}}{{{' '.join(below)}}}" if below else " ".join(above)
    return ("-" if coefficient < 0 else "") + " ".join(filter(None, [fraction, *sums]))


def _in_brackets(latex: str) -> bool:
    """Whether one pair of brackets holds all of it."""
    depth, signs = 0, re.findall(r"\\left|\\right|.", latex, re.DOTALL)
    for i, sign in enumerate(signs):
        depth += (sign == r"\left") - (sign == r"\right")
        if depth == 0 and i < len(signs) - 2:
            return False
    return latex.startswith(r"\left(") and latex.endswith(r"\right)")


def _raised(latex: str, power: int) -> str:
    if power == 1:
        return latex
    return rf"\left({latex}\right)^{{{power}}}" if "^" in latex and not latex.startswith(r"\left(") else (
        f"{latex}^{{{power}}}")


def _factor(item: Mapping[str, Any], given: Sequence[Known], found: Sum) -> tuple[list[tuple[str, int]], bool]:
    """A factor as bases and their powers, and whether it is positive; what it uses is noted."""
    kind, content = next((key, item[key]) for key in ("fact", "assume", "inverse", "square_of", "square",
                                                      "sum_of_squares", "positive", "any") if key in item)
    if kind == "fact":
        if content in FACTS and FACTS[content] not in found.facts:
            found.facts.append(FACTS[content])
        return [(_fact(content, expression_latex(item["of"])), 1)], content in POSITIVE_FACTS
    if kind in ("assume", "inverse", "square_of"):
        known = given[content]
        if known.key is not None:
            found.used.add(known.key)
        found.cases |= known.cases
        return [(known.mark, {"assume": 1, "inverse": -1, "square_of": 2}[kind])], (
            kind != "assume" or known.operator == ">")
    if kind == "sum_of_squares":
        return [(rf"\sum_{index_of(parse(content))} {_raised(factor_latex(content, True), 2)}", 1)], False
    if kind == "square":
        return [(factor_latex(content, True), 2)], False
    return _bases(content), kind == "positive"


def _bases(text: str) -> list[tuple[str, int]]:
    """An expression as a factor: the reciprocal of one stands below the bar."""
    tree = parse(text)
    if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Div) and ast.unparse(tree.left) == "1":
        return [(factor_latex(ast.unparse(tree.right), True), -1)]
    return [(factor_latex(text), 1)]


def _fact(name: str, of: str) -> str:
    inside = {"log_tangent": rf"{of} - 1 - \ln\left({of}\right)", "exp_tangent": rf"e^{{{of}}} - 1 - \left({of}\right)",
              "abs_square": rf"\left|{of}\right|^2 - \left({of}\right)^2",
              "sqrt_square": rf"\sqrt{{{of}}}^2 - \left({of}\right)"}.get(name)
    if inside is not None:
        return rf"\left({inside}\right)"
    return {"exp_positive": rf"e^{{{of}}}", "enclosure": rf"\left({of}\right)",
            "abs_nonnegative": rf"\left|{of}\right|"}.get(name, rf"\sqrt{{{of}}}")
