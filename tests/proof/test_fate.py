"""What becomes of a headline statement, by the truth table of what it rests on; who is charged with what."""

import pytest

from workbench.errors import ClaimError
from workbench.proof.fate import fates
from workbench.proof.premises import premises_problem, with_taint
from workbench.proof.verdict import Decision, Stated


def decided(equation, verdict, functions=False, **more):
    claim = Stated(id=f"p2020:{equation}", title="t", kind=more.pop("kind", "inequality"), printed="x",
                   recorded="proved", **{name: f"p2020:{value}" if name in ("glyph", "mends") else
                                         tuple(f"p2020:{v}" for v in value) if isinstance(value, tuple) else value
                                         for name, value in more.items()})
    return Decision(claim, verdict, "m", "exact", 0.0, {"functions": {"x": "t"}} if functions else {})


def fate(*decisions):
    return fates(with_taint(decisions))["p2020:T"]


def test_a_theorem_stands_when_it_is_proved_and_nothing_on_its_way_fails():
    found = fate(decided("1", "proved"), decided("T", "proved", severity="result", premises=("1",)))
    assert (found.word, found.by) == ("stands", ())


def test_it_stands_with_corrections_when_its_own_proof_avoids_the_step_that_fails():
    found = fate(decided("1", "refuted"), decided("2", "proved", premises=(), rests_on=("1",)),
                 decided("T", "proved", severity="result", premises=(), rests_on=("2",)))
    assert (found.word, found.by) == ("stands with corrections", ("p2020:1",))
    assert "(1)" in found.why


@pytest.mark.parametrize(("count", "told"), [(1, "uses equation (1), which fails"), (2, "(1) and (2), which fail"),
                                             (6, "uses 6 lines that fail")])
def test_the_lines_that_its_text_uses_are_named_where_they_are_few(count, told):
    names = tuple(str(n) for n in range(1, count + 1))
    found = fate(*(decided(name, "refuted") for name in names),
                 decided("T", "proved", severity="result", premises=(), rests_on=names))
    assert found.why.startswith("holds, but not by the way of the text, which uses ") and found.why.endswith(told)


def test_a_slip_on_its_way_is_told_and_costs_it_nothing():
    found = fate(decided("1", "gap", severity="cosmetic"), decided("2", "proved", premises=(), rests_on=("1",)),
                 decided("T", "proved", severity="result", premises=("2",)))
    assert found.word == "stands" and found.why.endswith("only equation (1) fails, a slip that changes no result")


def test_it_holds_but_not_at_the_printed_numbers_where_these_break_its_conditions_alone():
    found = fate(decided("1", "violated"), decided("T", "proved", severity="result", premises=(), rests_on=("1",)))
    assert (found.word, found.by) == ("stands with corrections", ("p2020:1",))
    assert found.why == "holds, but not at the printed numbers, which break equation (1)"
    also = fate(decided("1", "violated"), decided("2", "gap"),
                decided("T", "proved", severity="result", premises=(), rests_on=("1", "2")))
    assert "not by the way of the text" in also.why


def test_it_is_open_when_its_proof_uses_a_line_that_fails():
    found = fate(decided("1", "gap"), decided("2", "proved", premises=("1",)),
                 decided("T", "proved", severity="result", premises=("2",)))
    assert (found.word, found.by) == ("open", ("p2020:1",))


@pytest.mark.parametrize("verdict", ["gap", "violated", "undecided", "assumed"])
def test_what_is_not_proved_is_open_unless_a_mended_form_is(verdict):
    theorem = decided("T", verdict, severity="result")
    assert fate(theorem).word == "open"
    mended = decided("T.mended", "proved", origin="ours", mends="T")
    assert fate(theorem, mended).word == "stands with corrections"
    assert fate(theorem, mended).by == ("p2020:T.mended",)
    assert fate(theorem, decided("T.mended", "undecided", origin="ours", mends="T")).word == "open"


def test_a_mended_form_that_uses_a_failing_line_mends_nothing():
    mended = decided("T.mended", "proved", origin="ours", mends="T", premises=("1",))
    assert fate(decided("1", "refuted"), decided("T", "gap", severity="result"), mended).word == "open"


@pytest.mark.parametrize(("functions", "how"), [(True, "an exact motion"), (False, "a counterexample")])
def test_what_is_refuted_falls_and_says_by_what(functions, how):
    theorem = decided("T", "refuted", functions, severity="result")
    assert fate(theorem).word == "falls"
    assert how in fate(theorem).why
    mended = decided("T.mended", "proved", origin="ours", mends="T")
    assert fate(theorem, mended).word == "falls"
    assert f"it holds in a mended form, “{mended.claim.title}”" in fate(theorem, mended).why
    assert fate(theorem, mended).by == (mended.claim.id,)


def test_a_line_with_an_unclear_glyph_taints_and_costs_a_theorem_nothing_where_its_other_reading_holds():
    for other, word in (("proved", "stands"), ("refuted", "stands with corrections")):
        rows = with_taint([decided("1", "refuted", glyph="1.glyph"),
                           decided("1.glyph", other, origin="ours", glyph="1"),
                           decided("T", "proved", severity="result", premises=(), rests_on=("1",))])
        assert rows[2].tainted_by == ("p2020:1",)
        if word == "stands":
            assert fate(*rows).why.endswith(", but for one that holds in another reading of the extracted text")
        assert fate(*rows).word == word
        assert ("(1)" in fate(*rows).why) is (other == "refuted")  # the paper is not charged with a lost sign
    rows = (decided("T", "refuted", severity="result", glyph="T.glyph"),
            decided("T.glyph", "proved", origin="ours", glyph="T"))
    assert fate(*rows).word == "open"
    gap = decided("T", "gap", severity="result", glyph="T.glyph")
    mended = decided("T.mended", "proved", origin="ours", mends="T")
    found = fate(gap, rows[1], mended)
    assert found.word == "stands with corrections"
    assert found.why.startswith("follows in another reading of the extracted text alone; it holds in a mended form")


def test_a_cosmetic_slip_taints_nothing():
    rows = with_taint([decided("1", "refuted", severity="cosmetic"), decided("2", "proved", premises=("1",))])
    assert rows[1].tainted_by == ()


def test_a_slip_on_the_way_to_a_theorem_is_named():
    def why(*slips):
        rows = [decided(str(n), "refuted", severity="cosmetic") for n in slips]
        found = fate(*rows, decided("T", "proved", severity="result", premises=(), rests_on=tuple(map(str, slips))))
        assert found.word == "stands"
        return found.why
    assert why() == "holds, and no line that the text uses to get there fails"
    assert why(1).startswith("holds, and of the lines that the text uses to get there only equation (1) fails, a slip")
    assert why(1, 2).endswith("only equations (1) and (2) fail, slips that change no result")


def test_taint_runs_along_the_paper_s_chain_not_along_ours():
    rows = with_taint([decided("1", "refuted"), decided("2", "proved", premises=("1",), rests_on=()),
                       decided("3", "proved", premises=(), rests_on=("1",))])
    assert [d.tainted_by for d in rows] == [(), (), ("p2020:1",)]


def test_a_question_of_ours_stands_in_no_chain_of_the_paper():
    rows = with_taint([decided("1", "refuted"), decided("2", "proved", premises=("1",), origin="ours")])
    assert rows[1].tainted_by == ()


def test_only_printed_headlines_have_a_fate():
    rows = with_taint([decided("1", "proved", severity="result", origin="ours"), decided("2", "proved"),
                       decided("3", "proved", severity="result", origin="implied")])
    assert fates(rows) == {}


@pytest.mark.parametrize(("field", "value", "message"), [
    ("origin", "mine", "origin 'mine' is none of printed, implied, ours"),
    ("severity", "huge", "severity 'huge' is none of result, step, data, cosmetic"),
    ("match", "parsed", "leave it out where the line can be parsed"),
    ("glyph", "1", "names itself"), ("mends", "1", "names itself")])
def test_a_field_that_is_none_is_refused_in_a_line(field, value, message):
    with pytest.raises(ClaimError, match=message):
        decided("1", "proved", **{field: value})


def test_severity_follows_the_kind_where_it_is_not_stated():
    assert decided("1", "proved", kind="condition").claim.severity == "data"
    assert decided("1", "proved").claim.severity == "step"


@pytest.mark.parametrize("field", ["rests_on", "glyph", "mends"])
def test_what_names_no_claim_is_told(field):
    value = ("9",) if field == "rests_on" else "9"
    problem = premises_problem([decided("1", "proved", **{field: value}).claim])
    assert problem is not None
    assert f"{field} 'p2020:9' is no claim" in problem[1]


def test_a_circle_of_the_paper_s_chain_is_told():
    claims = [decided("1", "proved", rests_on=("2",)).claim, decided("2", "proved", rests_on=("1",)).claim]
    problem = premises_problem(claims)
    assert problem is not None
    assert "rests on itself through its rests_on" in problem[1]
