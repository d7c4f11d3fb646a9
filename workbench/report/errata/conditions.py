"""What is assumed, as formulas: in one where it is short, in lines below each other where it is not."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from workbench.report.certificate_latex import expression_latex, name_latex, rate_latex
from workbench.report.dots import only_names
from workbench.report.errata.blocks import Block, Formula, Paragraph

LONGEST = 900  # characters of a formula beyond which its parts stand below each other
LINE = 150  # characters of LaTeX up to which short formulas share a line
MOST_GIVEN = 6000  # characters of all conditions beyond which a reader is sent to the certificate
COMMA = r",\ "
# What stands in front of conditions, of what holds at all times, of the rates of a motion and of its beginning.
STATEMENT_CHECKED = "Statement checked"
UNDER, ALWAYS, ALONG, FIRST, WITH = "Under the conditions", "At all times", "For the motion with", "Starting at", "With"


def motion(goal: Mapping[str, Any]) -> dict[str, list[str]]:
    """Where a goal's motion begins and what it obeys, by what stands in front of it, as LaTeX; no more of what stays
    as it is."""
    initial, flow = goal.get("initial", {}), goal.get("flow", {})
    moving = [name for name in flow if (flow[name] != "0" or initial.get(name) != name) and not only_names(
        rate_latex(name, flow[name]))]
    return {FIRST: [f"{name_latex(name)} = {expression_latex(initial[name])}" for name in initial
                         if name in moving],
            ALONG: [rate_latex(name, flow[name]) for name in moving]}


def listed_conditions(conditions: Mapping[str, Sequence[str]], beside: Sequence[str] = ()) -> list[Block]:
    """Conditions as LaTeX, by what stands in front of them, and the values of letters beside them."""
    parts = [(label, part) for label, part in conditions.items() if part]
    if not parts:
        return []
    at = COMMA.join(beside)
    size = sum(len(text) for _, part in parts for text in (*part, COMMA)) + len(at)
    if size > MOST_GIVEN:
        return [Paragraph("What else is assumed holds there too; the certificate spells it out.")]
    if size > LONGEST:
        return [*(Formula(text, "" if i else label) for label, part in parts for i, text in enumerate(_packed(part))),
                *([Formula(at, WITH)] if at else [])]
    (first, given), *others = [(label, COMMA.join(part)) for label, part in parts]
    others += [(WITH, at)] if at else []
    return [Formula(given + "".join(rf"\quad\text{{{label.lower()}}}\ {text}" for label, text in others), first)]


def _packed(texts: Sequence[str]) -> list[str]:
    """Formulas in lines, short ones beside each other."""
    lines: list[str] = []
    for text in texts:
        if lines and len(lines[-1]) + len(text) <= LINE:
            lines[-1] += COMMA + text
        else:
            lines.append(text)
    return lines
