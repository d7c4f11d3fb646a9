"""Words of a page are set as people print them."""

import pytest

from workbench.report.claims import by_section, claim_views, in_words
from workbench.report.typography import set_command, set_words


@pytest.mark.parametrize(("typed", "printed"), [
    ("from -3.8 to (-0.5)", "from −3.8 to (−0.5)"), ("u = -1, [-4.22, 4.66]", "u = −1, [−4.22, 4.66]"),
    ("Figures 1-9 and 42(3) (2025) 642-648", "Figures 1–9 and 42(3) (2025) 642–648"),
    ("the law (35)-(37)", "the law (35)–(37)"),
    # Names, dates and differences are as they are.
    ("ISO 2631-1, EN 14033-1:2017, 2026-11-28, x-1, mpc-2", "ISO 2631-1, EN 14033-1:2017, 2026-11-28, x-1, mpc-2"),
    ("first-order, offset-free", "first-order, offset-free"), ("a < b & c", "a &lt; b &amp; c"),
    ("all with --full.", 'all with <span class="unbroken">--full</span>.'),
    ("by 10 %, 1\u202f234.5 mm/s or -2 m/s³.", 'by <span class="unbroken">10 %</span>, <span class="unbroken">'
     '1\u202f234.5 mm/s</span> or −<span class="unbroken">2 m/s³</span>.'),
    ("5.19\u202f×\u202f10⁻³ m; 1 to 3 min", '<span class="unbroken">5.19\u202f×\u202f10⁻³ m</span>; 1 to '
     '<span class="unbroken">3 min</span>'),
    # Words that begin as units do, and letters.
    ("10 more, 2 trains, k_1 2 x, 3 s_d, 5 N/kg/s", "10 more, 2 trains, k_1 2 x, 3 s_d, 5 N/kg/s")])
def test_signs_dashes_and_options(typed, printed):
    assert set_words(typed) == printed == in_words(typed, letters=False)


def test_a_command_is_itself_and_its_options_are_not_broken():
    assert set_command("workbench report a-5 --out 'b & 3 m' -1") == (
        'workbench report a-5 <span class="unbroken">--out</span> &#39;b &amp; 3 m&#39; -1')


def test_a_formula_keeps_its_own_signs():
    assert "−" in in_words("at -2 it is $x_1 - 2$") and "<math" in in_words("at -2 it is $x_1 - 2$")


def test_a_greek_letter_is_one_by_its_name_too():
    for sign, name in (("λ_min", "lambda_min"), ("c_λ > 0", "c_lambda > 0"), ("at γ_a", "at gamma_a")):
        assert in_words(sign) == in_words(name) and "<msub>" in in_words(sign)
    assert in_words("αβ") == "αβ"


@pytest.mark.parametrize(("stated", "shown"), [
    (["2", "", "5.1", "4", "10"], ["2", "4", "5.1", "10", ""]),  # by their numbers, what has none last
    (["V", "", "III"], ["V", "III", ""])])  # no numbers: as they come
def test_sections_of_a_proof_stand_in_their_order(stated, shown):
    claims = claim_views({"claims": [{"id": f"p:{i}", "section": section} for i, section in enumerate(stated)]})
    assert [section for section, _ in by_section(claims)] == shown
