"""How many lines have which verdict is said alike on a page and in a terminal."""

import re
from pathlib import Path

from small_decisions import paper

from workbench.cli.verdict_counts import verdict_lines
from workbench.files.numbers import counted
from workbench.proof.document import Places, claims_document
from workbench.report.claims import charged, claim_views, counts
from workbench.report.headline import proof_line


def told(text):
    """The number of each verdict that a text names, before what fails only as extracted."""
    return {verdict.rstrip("s"): int(number) for number, verdict in re.findall(
        r"(\d+) (proved|refuted|violated|gaps?|assumed)\b", re.split(r"[;.]", text.partition(": ")[2])[0])}


def test_a_paper_is_charged_alike_on_a_page_and_in_a_terminal():
    document = claims_document(paper(), Places(Path("none")))
    views = claim_views(document)
    lines = [view for view in views if not view.ours]
    assert sum(view.otherwise for view in lines) == 1
    terminal, page = verdict_lines(document)[0].plain, str(proof_line(views))
    shown = {verdict: number for verdict, number in counts(charged(lines)).items() if number}
    assert told(terminal) == told(page.removeprefix("<strong>Proof.</strong>")) == shown
    assert sum(shown.values()) == len(lines) - 1
    assert "; one more fails only as extracted and holds in another reading" in terminal
    assert ". One more fails only as extracted and holds in another reading." in page


def test_one_is_no_plural():
    assert [counted(number, "draw") for number in (0, 1, 2)] == ["0 draws", "1 draw", "2 draws"]
