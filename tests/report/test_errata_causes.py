"""Errata begin with the causes: what rests on no other line that fails."""

import re
from dataclasses import replace

from small_decisions import certificate

from workbench.proof.fate import judged
from workbench.proof.verdict import Decision, Stated
from workbench.report.errata.causes import causes_of
from workbench.report.errata.content import errata
from workbench.report.errata.markdown import markdown
from workbench.report.finding import findings

CITATION = "J. Doe, A paper, 2026"


def _line(equation, show, rests_on=(), verdict="refuted", severity="step", point=None):
    """A line of a paper that fails at a point."""
    claim = Stated(id=f"doe2026:{equation}", title=f"the line {equation}", kind="inequality", printed=show,
                   recorded=verdict, section="3", rests_on=tuple(f"doe2026:{name}" for name in rests_on),
                   severity=severity)
    return Decision(claim, verdict, "by hand", "exact", 0.0, certificate(claim.id, verdict, show, point))


def chain():
    """Two causes, one of them said twice in other letters, what falls with them, and a slip."""
    return judged([
        _line("1", "x**2 >= 1", point={"x": "0"}), _line("2", "y**2 >= 1", point={"y": "0"}),
        _line("3", "x >= y + 1", point={"x": "0", "y": "5"}),
        _line("4", "x >= 2", ("1", "3"), point={"x": "0"}), _line("5", "y >= 2", ("2",), "gap", point={"y": "0"}),
        _line("theorem1", "x >= 3", ("4",), severity="result", point={"x": "0"}),
        _line("6", "x == 4", point={"x": "0"})])


def test_causes_are_told_before_what_falls_with_them_and_their_evidence_behind():
    text = markdown(errata(chain(), CITATION))
    causes, falling, alone, shown = (text.index(heading) for heading in (
        "## The causes", "## Lines that fail and rest on them", "## Other lines that fail by themselves",
        "## Evidence: the causes"))
    assert causes < falling < alone < shown
    told = text[causes:falling]
    assert "3 lines fail by themselves, and others rest on them; they are 2 different ones but for" in told
    # (2) says of y what (1) says of x; on (1) rest Theorem 1 and (4).
    assert ("- Corrections 1 and 2: Equation (1) is false as printed; 1 headline statement and 1 other line rest on it."
            "\n") in told
    assert re.findall(r"^### (\d)\. Equation (\(\d\))", told, re.MULTILINE) == [("1", "(1)"), ("3", "(3)")]
    assert "**Likewise.** Equation (2) says the same in other letters and fails alike (correction 2)." in told
    assert "- On corrections 1 and 3: Equation (4), 5.\n" in text[falling:alone]
    assert "- On correction 2: Equation (5), 6 (gap).\n" in text[falling:alone]
    assert ("falls: refuted by a counterexample. See correction 4; its way in the text rests on corrections 1 and 3."
            ) in text[:causes]
    assert "- 7. Equation (6) is false as printed.\n" in text[alone:shown]
    # Every correction has its evidence, a cause's line is not printed again there.
    assert [int(n) for n in re.findall(r"^### (\d+)\. ", text[shown:], re.MULTILINE)] == [1, 2, 3, 4, 5, 6, 7]
    assert "**Printed:**" not in text[shown:text.index("### 2. ", shown)] and re.search(r"^ +1  1 ", text, re.MULTILINE)


def test_lines_that_only_look_alike_are_two_causes():
    rows = [replace(d, certificate=certificate(d.claim.id, "refuted", "y**2 >= 2", {"y": "0"}))
            if d.claim.equation == "2" else d for d in chain()]
    assert len(causes_of(findings(rows), rows)) == 3
    assert causes_of(findings([d for d in chain() if not d.claim.rests_on]), chain()) == []
