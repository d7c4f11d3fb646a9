"""Errata begin with the causes: what rests on no other line that fails."""

import re
from dataclasses import replace

from small_decisions import certificate, proof

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
        "## The causes", "## Lines that fail and rest on them", "## Other lines that fail",
        "## Evidence: the causes"))
    assert causes < falling < alone < shown
    told = text[causes:falling]
    assert "3 lines fail by themselves, and others rest on them; but for their letters they are 2" in told
    assert "3 more lines fail and rest on them. What" in told
    # (2) says of y what (1) says of x; on (1) rest Theorem 1 and (4).
    assert ("- Corrections 1 and 2: Equation (1) is false as printed; 1 headline statement and 1 other line rest on it."
            "\n") in told
    assert re.findall(r"^### (\d)\. Equation (\(\d\))", told, re.MULTILINE) == [("1", "(1)"), ("3", "(3)")]
    assert "**Likewise.** Equation (2) says the same in other letters and fails alike (correction 2)." in told
    assert "- On corrections 1 and 3: Equation (4), 5.\n" in text[falling:alone]
    assert "- On correction 2: Equation (5), 6 (gap).\n" in text[falling:alone]
    assert ("falls: refuted by a counterexample. See correction 4; in the text it rests on corrections 1 and 3."
            ) in text[:causes]
    assert "- 7. Equation (6) is false as printed.\n" in text[alone:shown]
    # Every correction has its evidence, a cause's line is not printed again there.
    assert [int(n) for n in re.findall(r"^### (\d+)\. ", text[shown:], re.MULTILINE)] == [1, 2, 3, 4, 5, 6, 7]
    assert "**Printed:**" not in text[shown:text.index("### 2. ", shown)] and re.search(r"^ +1  1 ", text, re.MULTILINE)


def test_how_a_cause_is_read_is_told_where_it_is_told_first():
    first, *others = chain()
    read = replace(first, claim=replace(first.claim, reading="Shown for one mass."))
    text = markdown(errata([read, *others], CITATION))
    told = text[text.index("## The causes"):text.index("## Evidence: the causes")]
    assert "**How it is read.** Shown for one mass." in told


def test_what_holds_although_the_text_comes_to_it_through_a_line_that_fails_stands_apart():
    holding = [replace(_line(equation, "x**2 >= 1", (on,), severity=severity, point={"x": "0"}), verdict="proved",
                       certificate=None)
               for equation, on, severity in (("7", "4", "step"), ("8", "6", "step"), ("theorem2", "7", "result"))]
    slip = _line("6", "x == 4", severity="cosmetic", point={"x": "0"})
    rows = judged([*(d for d in chain() if d.claim.equation != "6"), slip, *holding])
    text = markdown(errata(rows, CITATION))
    assert "3 more lines fail and rest on them. One headline statement holds, but the text's way to it passes" in text
    held = text[text.index("## What holds as it stands"):text.index("## Evidence")]
    assert "stands\n\n- Section 3: equation (8).\n" in held  # a slip on the way changes nothing
    assert "## What holds, though the text comes to it through lines that fail\n\n- Section 3: equation (7).\n" in held
    assert "Theorem 2" not in held  # its fate is told before


def test_a_false_line_comes_before_one_that_does_not_follow():
    rows = judged([_line("1", "x**2 >= 1", (), "gap", point={"x": "0"}), _line("2", "x**2 >= 2", point={"x": "0"}),
                   _line("3", "x >= 2", ("1",), "gap", point={"x": "0"}),
                   _line("theorem1", "x >= 3", ("1", "2"), severity="result", point={"x": "0"})])
    assert [cause[0].equation for cause in causes_of(findings(rows), rows)] == ["2", "1"]


def test_lines_that_only_look_alike_are_two_causes():
    rows = [replace(d, certificate=certificate(d.claim.id, "refuted", "y**2 >= 2", {"y": "0"}))
            if d.claim.equation == "2" else d for d in chain()]
    assert len(causes_of(findings(rows), rows)) == 3
    assert causes_of(findings([d for d in chain() if not d.claim.rests_on]), chain()) == []


def test_a_statement_that_holds_by_another_way_is_not_counted_among_those_that_fail():
    holds = Stated(id="doe2026:theorem2", title="it holds", kind="inequality", printed=r"x^2 \ge 0", recorded="proved",
                   section="3", rests_on=("doe2026:1",), severity="result")
    shown = proof(holds.id, "x**2 >= 0", [{"coefficient": "1", "factors": [{"square": "x"}]}], {"x": "0"})
    text = markdown(errata(judged([*chain(), Decision(holds, "proved", "by hand", "exact", 0.0, shown)]), CITATION))
    assert "3 more lines fail and rest on them. One headline statement holds, but the text's way to it passes" in text
    assert "Theorem 2 (it holds) holds, but not by the way of the text" in text and "## What holds" not in text


def test_of_causes_with_as_many_headlines_what_is_false_comes_before_what_does_not_follow():
    rows = judged([
        _line("1", "x >= 2", verdict="gap", point={"x": "0"}), _line("2", "y >= 5", point={"y": "0"}),
        _line("3", "x >= 3", ("1",), point={"x": "0"}), _line("4", "x >= 4", ("3",), point={"x": "0"}),
        _line("theorem1", "x >= y + 9", ("2", "4"), severity="result", point={"x": "0", "y": "0"})])
    causes = causes_of(findings(rows), rows)
    assert [[f.equation for f in cause] for cause in causes] == [["2"], ["1"]]
    assert causes[0][0].lines < causes[1][0].lines


def test_a_theorem_whose_condition_the_numbers_break_holds_beside_what_is_proved_without_it():
    def proved(equation, **more):
        claim = Stated(id=f"doe2026:{equation}", title="Theorem 1: it converges", kind="inequality", printed="x >= y",
                       recorded="proved", **more)
        return Decision(claim, "proved", "by hand", "exact", 0.0)

    text = markdown(errata(judged([
        _line("1", "x >= 1", (), "violated", "data", {"x": "0"}),
        proved("theorem1", severity="result", rests_on=("doe2026:1",)),
        proved("theorem1.any", origin="ours", mends="doe2026:theorem1")]), CITATION))
    assert ("- Theorem 1 (it converges) holds, but not at the printed numbers, which break equation (1). "
            "See correction 2; in the text it rests on correction 1.") in text
    assert "**Beside it is proved:**" in text and "Should read" not in text
    # The theorem does not fail.
    assert "One line fails by itself, and others rest on it. One headline statement holds" in text
