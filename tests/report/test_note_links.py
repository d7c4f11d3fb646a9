"""Ids of claims in notes lead to these claims, and nothing else in a note is taken for one."""

import pytest
from markupsafe import Markup

from workbench.report.claims import claim_views
from workbench.report.findings_view import finding_groups
from workbench.report.note_links import linked

NOTE = "See 51.zeta.glyph, and 7.bounded."


def claim(equation, note=""):
    return {"id": f"p:{equation}", "equation": equation, "verdict": "refuted", "note": note}


def test_an_id_in_a_note_leads_to_its_claim_in_the_proof_and_in_a_finding():
    document = {"claims": [claim("51", NOTE), claim("51.zeta.glyph"), claim("7.bounded"), {"id": "q:7.bounded"}],
                "findings": [{"paper": "p", "equation": "51", "verdict": "refuted", "sentences": ["It fails."]}]}
    expected = ('See <a href="#claim-p:51.zeta.glyph">51.zeta.glyph</a>, '
                'and <a href="#claim-p:7.bounded">7.bounded</a>.')
    assert claim_views(document)[0].note == expected
    assert finding_groups(document)[0].findings[0].note == expected


@pytest.mark.parametrize("note", [
    "51 is a number", "at 7.5 s", "certificates/p/51.zeta.json", "p:51.zeta stands elsewhere", "A51.zeta", "51.zeta_2",
    '<a title="51.zeta">x</a>', "<math><mn>51.zeta</mn></math>"])
def test_numbers_paths_tags_and_formulas_are_left_alone(note):
    assert linked(Markup(note), {"51": "a", "51.zeta": "b"}) == note
