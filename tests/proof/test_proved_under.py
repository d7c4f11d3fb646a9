"""What is proved only from lines that are not shown themselves is never a plain `proved`, wherever it is shown."""

from pathlib import Path

import pytest

from workbench.cli.terminal import verdict_colour
from workbench.cli.verdict_counts import count_words
from workbench.proof.document import Places, claims_document
from workbench.proof.fate import judged
from workbench.proof.premises import proved_under
from workbench.proof.verdict import Decision, Stated, verdict_words
from workbench.report.errata.blocks import Paragraph
from workbench.report.errata.content import errata
from workbench.report.finding import findings
from workbench.report.finding_sentences import condition_sentence, correction_sentence, sentences


def decided(equation, verdict, *premises, **more):
    more.setdefault("rests_on", ())
    claim = Stated(id=f"p2020:{equation}", title="t", kind="inequality", printed="x = y", recorded="proved",
                   premises=tuple(f"p2020:{name}" for name in premises), **more)
    return Decision(claim, verdict, "m", "exact", 0.0)


@pytest.mark.parametrize(("verdict", "under"), [
    ("refuted", True), ("violated", True), ("gap", True), ("undecided", True), ("assumed", False), ("proved", False)])
def test_a_premise_counts_unless_it_is_proved_or_cited(verdict, under):
    rows = [decided("1", verdict, severity="cosmetic"), decided("2", "proved", "1")]
    assert proved_under(rows)["p2020:2"] == (("p2020:1",) if under else ())


def test_it_travels_through_what_is_proved_and_what_is_cited_and_stops_at_the_first_line_that_is_not_shown():
    rows = [decided("0", "gap"), decided("1", "refuted", "0"), decided("2", "proved", "1"),
            decided("3", "assumed", "2"), decided("4", "proved", "3"), decided("5", "gap", "4")]
    assert proved_under(rows) == {"p2020:2": ("p2020:1",), "p2020:4": ("p2020:1",)}


def test_no_verdict_is_shown_as_a_plain_proved():
    rows = judged([decided("1", "gap"), decided("2", "proved", "1"), decided("3", "proved")])
    assert [verdict_words(d.verdict, d.proved_under) for d in rows] == ["gap", "proved under (1)", "proved"]
    assert verdict_colour("proved", rows[1].proved_under) != verdict_colour("proved", ())
    document = claims_document(rows, Places(Path("none")))
    assert [row["proved_under"] for row in document["claims"]] == [[], ["p2020:1"], []]
    assert document["proved_under"] == {"paper": 1, "ours": 0}
    assert count_words("proved", 2, 1) == "2 proved (1 under lines that are not shown)"


@pytest.mark.parametrize("verdict", ["gap", "undecided", "refuted"])
def test_a_headline_and_a_mended_one_need_premises_that_are_shown(verdict):
    theorem = judged([decided("1", verdict), decided("T", "proved", "1", severity="result")])[1]
    assert theorem.fate.word == "open" and "(1)" in theorem.fate.why
    rows = judged([decided("1", verdict), decided("T", "gap", severity="result"),
                   decided("T.mended", "proved", "1", mends="p2020:T", origin="ours")])
    assert rows[1].fate.word == "open"


def test_findings_and_errata_say_under_what_a_mended_line_is_proved():
    rows = judged([decided("1", "gap"), decided("2", "refuted"), decided("2.mended", "proved", "1", mends="p2020:2")])
    found = next(f for f in findings(rows) if f.equation == "2")
    assert correction_sentence(found) == "It should read $x = y$."
    assert condition_sentence(found) == "That is proved only where equation (1) holds, which is not shown."
    texts = " ".join(block.text for block in errata(rows, "cited") if isinstance(block, Paragraph))
    assert condition_sentence(found) in texts and condition_sentence(found) in sentences(found)
    assert "1 of them only where lines hold that are not shown" in texts
