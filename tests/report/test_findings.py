"""Findings: what a referee would write, made from the decisions alone."""

from dataclasses import replace
from fractions import Fraction

import pytest
from small_decisions import certificate, paper

from workbench.proof.fate import judged
from workbench.proof.places import named_section, place_of, places_of, section_of_place, subject_of, whole_of
from workbench.proof.verdict import Decision, Stated
from workbench.report.claims import certificate_beside, claim_views
from workbench.report.counterexample import counterexample_of
from workbench.report.errata.content import errata
from workbench.report.errata.markdown import markdown
from workbench.report.errata.proof_steps import proof_steps
from workbench.report.finding import findings
from workbench.report.finding_sentences import (
    breaks_at,
    consequence_sentence,
    findings_document,
    printed_sentence,
    sentences,
    verdict_sentence,
)
from workbench.report.findings_view import fated_findings, finding_groups
from workbench.report.plain_formulas import plain_formula
from workbench.report.worded import math, show, worded


def found_by_equation():
    return {f.equation: f for f in findings(paper())}


def test_the_gravest_come_first_and_what_stands_or_is_ours_is_no_finding():
    assert [(f.equation, f.gravity) for f in findings(paper())] == [
        ("theorem1", "falls"), ("4", "step"), ("6", "gap"), ("table1", "alone"), ("5", "cosmetic"), ("7", "reading")]


def test_a_finding_says_where_what_is_true_instead_and_what_falls_with_it():
    step = found_by_equation()["4"]
    assert step.place == "Equation (4)" and step.section == "3" and step.headlines == ("theorem1",)
    text = " ".join(show(s, plain_formula) for s in sentences(step))
    assert text == ("Equation (4) is false as printed: with z₁ = 0.5, the left side of z₁² ≥ 1 is 0.25 and the right "
                    "side 1. "
                    "Printed: z₁² ≥ 1. It should read z₁² ≥ 0. Theorem 1 rests on it.")


def test_a_theorem_that_falls_names_its_mended_form_and_why():
    theorem = found_by_equation()["theorem1"]
    assert theorem.mended_by == "theorem1.mended" and theorem.because == ("4",)
    assert consequence_sentence(theorem) == "In the text it rests on equation (4), which fails."
    assert "Mended, it is proved: $z_1^2 \\ge 0$." in sentences(theorem)


def test_what_a_mended_form_uses_may_be_misstated_and_without_a_decision():
    rows = [replace(d, proved_under=("doe2026:8",)) if d.claim.mends else d for d in paper()]
    assert next(f for f in findings(rows) if f.equation == "theorem1").mended_under == ("8",)


def test_a_step_that_is_taken_without_words_is_not_called_printed():
    rows = [replace(d, claim=replace(d.claim, origin="implied")) if d.claim.equation == "4" else d for d in paper()]
    step, document = next(f for f in findings(rows) if f.equation == "4"), findings_document(findings(rows))
    told = " ".join(sentences(step))
    assert told.startswith("What the text implies at equation (4), “the line 4”, does not hold: with")
    assert "Implied, not printed: $z_1^2 \\ge 1$." in told
    assert "rinted:" not in told.replace("Implied, not printed:", "")
    views = {view.place: view.label for group in finding_groups(document) for view in group.findings}
    assert views.pop("Equation (4)") == "Implied, not printed" and set(views.values()) == {"Printed"}
    text = markdown(errata(rows, "cited"))
    assert text.count("**Implied, not printed:**") == 1 and "of which the text implies and does not print" in text
    assert "implies and does not print" not in markdown(errata(paper(), "cited"))


def test_a_lemma_whose_title_is_its_place_is_not_told_twice():
    rows = [{"id": "p:lemma2", "equation": "lemma2", "title": title} for title in ("Lemma 2", "Lemma 2: it decays")]
    assert [(view.place, view.subject) for view in claim_views({"claims": rows})] == [
        ("Lemma 2", ""), ("Lemma 2", "it decays")]


def test_of_many_lines_on_the_way_those_are_named_that_rest_on_no_other():
    def line(equation, *rests_on):
        stated = Stated(id=f"doe2026:{equation}", title="", kind="identity", printed="x = y", recorded="refuted",
                        rests_on=tuple(f"doe2026:{name}" for name in rests_on))
        return Decision(stated, "refuted", "by hand", "exact", 0.0)

    rows = judged([line("1"), line("2"), *(line(str(n), "1", str(n - 1)) for n in range(3, 8))])
    found = {f.equation: consequence_sentence(f) for f in findings(rows)}
    assert found["5"].endswith("it rests on equations (1), (2), (3) and (4), which fail.")
    one = judged([line("1"), *(line(str(n), str(n - 1)) for n in range(2, 8))])
    assert consequence_sentence(findings(one)[-1]).endswith("(1), which fails, and on 5 more that fail and rest on it.")
    assert found["7"] == ("In the text it rests on equations (1) and (2), which fail, and on 4 more that fail and "
                          "rest on these.")


def test_what_rests_on_a_line_is_computed_not_typed():
    freed = [d for d in paper() if d.claim.equation != "theorem1"]
    freed = [d for d in freed if d.claim.mends is None]
    assert {f.equation: f.gravity for f in findings(judged(freed))}["4"] == "alone"


def test_the_document_has_every_finding_with_its_sentences():
    rows = findings_document(findings(paper()))["findings"]
    assert [row["equation"] for row in rows] == [f.equation for f in findings(paper())]
    assert all(row["sentences"] and row["digest"] and row["printed"] for row in rows)


def test_a_finding_on_a_page_says_why():
    claim = {"id": "doe2026:4", "note": "z_1 may be small.", "certificate": "/far/away/certificates/doe2026/4.json"}
    document = findings_document(findings(paper())) | {"claims": [claim]}
    views = {view.place: view for group in finding_groups(document) for view in group.findings}
    assert "<math" in views["Equation (4)"].note and views["Equation (7)"].note == ""
    # Beside the page, whoever it was sent to.
    assert views["Equation (4)"].command.startswith("python checker.py certificates/doe2026/4.json --claim-digest ")
    assert {certificate_beside(row) for row in (claim, {}, {"certificate": None})} == {
        "certificates/doe2026/4.json", ""}


def test_both_sides_are_evaluated_exactly_and_shown_apart_when_rounded():
    point = counterexample_of(certificate("a:1", "refuted", "exp(x) == 1", {"x": "1/1000000000"}))
    assert point.right.removeprefix(r"\approx ") == "1" and Fraction(point.left.removeprefix(r"\approx ")) > 1
    values = {"k_1": "2", "k_2": "3/2", "k_3": "1"}
    point = counterexample_of(certificate("a:1", "violated", "k_1*k_2 - k_3 == 0", values))
    assert (point.left, point.right, point.put_in) == ("2", "0", (r"2 \cdot 1.5 - 1", "0"))


def test_a_relation_that_holds_is_not_the_one_that_breaks():
    found = certificate("a:1", "refuted", "x >= 0", {"x": "-1"})
    found["goal"]["show"] = ["x <= 0", "x >= 0"]
    assert counterexample_of(found).relation == r"x \ge 0"


def test_many_letters_of_one_value_are_said_together():
    names = [f"a_{i}" for i in range(1, 9)]
    found = certificate("a:1", "refuted", f"{' + '.join(names)} + b == 0", {**dict.fromkeys(names, "1"), "b": "2"})
    point = counterexample_of(found)
    assert point.values == ("b = 2",) and point.others == "1" and len(point.everything) == 9
    assert counterexample_of(certificate("a:1", "proved", "x**2 >= 0", example={"x": "0"}, proofs=[
        {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"square": "x"}]}]}])) is None


def test_a_root_is_told_as_about_a_number():
    goal = {"assume": ["z**2 == 2"], "show": ["2*z <= 1"]}
    point = counterexample_of({"verdict": "refuted", "goal": goal, "point": {"z": "7/5"}, "roots": [
        {"of": "z", "from": "1399999/1000000", "to": "71/50", "equality": "z**2 == 2"}]})
    assert (point.values, point.right, point.put_in) == ((r"z \approx 1.4",), "1", None)
    assert point.left.startswith(r"\approx 2.8")


def test_a_contradiction_is_told_with_the_opposite_of_what_is_shown():
    steps = [item.text for item in proof_steps({"goal": {"assume": ["x > 0"], "show": ["x != 0"]}, "proofs": [
        {"rule": "contradiction", "terms": [{"coefficient": "1", "factors": [{"assume": 0}]},
                                            {"coefficient": "-1", "factors": [{"assume": 1}]}]}]}).lines]
    assert steps == [r"To show: $x \ne 0$.", "[1] Suppose that $x = 0$.", "Then $0 = x - [1]$, where $x$ is positive."]


def test_a_motion_is_told_as_functions_of_time():
    goal = {"assume": [], "always": ["v == 1"], "show": ["x <= 1"], "flow": {"x": "v", "t": "1"}, "inputs": ["v"],
            "eventually": "t"}
    point = counterexample_of({"verdict": "refuted", "goal": goal, "functions": {"x": "2 + t"}, "point": {}})
    assert point.motion and point.left == "2 + t" and point.right == "1" and point.values == ("x = 2 + t",)
    assert breaks_at(point).endswith("but the left side of $x \\le 1$ is $2 + t$ and the right side $1$")
    goal["show"] = ["x <= t"]
    point = counterexample_of({"verdict": "refuted", "goal": goal, "functions": {"x": "2 + t"}, "point": {}})
    assert breaks_at(point).endswith("$x$ stays greater than the time itself, so that it is not bounded")
    theorem = found_by_equation()["theorem1"]
    assert "motion" not in verdict_sentence(theorem)


@pytest.mark.parametrize(("equation", "place"), [
    ("44", "Equation (44)"), ("45.a", "Equation (45) [a]"), ("theorem2", "Theorem 2"), ("theorem1.3", "Theorem 1.3"),
    ("remark4.mean", "Remark 4 [mean]"), ("A1", "Assumption 1"), ("VIII.stop", "Section VIII [stop]"),
    ("intro.gain", "Introduction [gain]"), ("conclusion", "Conclusion")])
def test_places_are_named_as_a_reader_names_them(equation, place):
    assert place_of(equation) == place


def test_places_of_one_kind_stand_together():
    assert places_of(["theorem2", "41", "theorem3", "41.a", "44"]) == ["Theorems 2 and 3", "equations (41) and (44)"]
    assert places_of(["theorem1.10", "theorem1.9", "41", "7"]) == ["Theorems 1.9 and 1.10", "equations (7) and (41)"]
    titles = {"41.a": "the rates", "gamma.b": "p is positive", "45": "V decreases"}
    assert places_of(["41.a", "45", "gamma.b"], titles) == [
        "equations (41) “the rates” and (45)", "the statement “p is positive”"]
    titles = {"text.a": "one", "text.b": "two", "figures.c": "three", "figures.d": "four"}
    assert places_of([*titles, "figures"], titles) == ["the text “one” and “two”", "the figures"]
    assert places_of(["figures.c", "figures.d"], titles) == ["the figures “three” and “four”"]
    titles = {"41.a": "the rates", "gamma.b": "p is positive", "45": "V decreases"}
    # Where the whole line fails, so does its part, which is not told again.
    assert places_of(["41", "41.a"], titles) == ["equation (41)"]


def test_what_stands_beside_a_numbered_line_is_not_called_by_its_number():
    titles = {"41": "The display before (42): rate of V", "52.T": "The text after (52): V is small", "44": "the law"}
    assert place_of("41", titles["41"]) == whole_of("41", titles["41"]) == "The display before (42)"
    assert place_of("52.T", titles["52.T"]) == "The text after (52) “V is small”"
    assert whole_of("52.T", titles["52.T"]) == "The text after (52)" and whole_of("44", "the law") == "Equation (44)"
    assert places_of(titles, titles) == ["the display before (42)", "the text after (52) “V is small”", "equation (44)"]
    assert subject_of(titles["41"]) == "rate of V"


def test_what_holds_in_its_other_reading_is_not_told_to_fail_as_printed():
    found = found_by_equation()
    assert verdict_sentence(found["7"]).startswith("Equation (7) is false as extracted: ")
    own = {d.claim.equation: d for d in paper()}
    both = replace(own["4"], claim=replace(own["4"].claim, rests_on=("doe2026:7", "doe2026:lemma2")))
    rows = {f.equation: f for f in findings(judged([both if d is own["4"] else d for d in own.values()]))}
    assert rows["4"].because == ("7",) and rows["4"].otherwise == ("7",)
    assert consequence_sentence(rows["4"]) == "Theorem 1 rests on it."  # the paper is not charged with it


def test_a_line_whose_name_says_its_section_is_not_told_another():
    assert section_of_place("41.a", "5.2") == "section 5.2" and section_of_place("41", "") == ""
    assert {section_of_place(name, "3") for name in ("section5.converge", "VIII.a", "conclusion", "intro.b")} == {""}
    assert [named_section(name) for name in ("section5.converge", "section4", "section", "55.pointwise")] == [
        "5", "4", "", ""]


@pytest.mark.parametrize(("equation", "title", "place"), [
    ("45.a", "Rate of V_2", "Equation (45) “Rate of V_2”"), ("45.a", "", "Equation (45)"), ("45", "V", "Equation (45)"),
    ("theorem1.1.z", "z is bounded", "Theorem 1.1 “z is bounded”"), ("objective.stable", "", "Objective"),
    ("gamma", "gamma has a mean", "The statement “gamma has a mean”"), ("gamma", "", "Statement"),
    ("theorem1.mended", "Theorem 1 where b > 0", "Theorem 1 “where b > 0”"),
    ("6.same", "(6) at rest", "Equation (6) “at rest”"),
    ("theorem1.whole", "Theorem 12 and more", "Theorem 1 “Theorem 12 and more”")])
def test_a_part_of_a_line_is_told_by_what_it_says(equation, title, place):
    assert place_of(equation, title) == place


def test_a_theorem_names_only_lines_that_fail_on_the_way_to_it():
    """What holds in its other reading is no failure of the paper's way."""
    own = {d.claim.equation: d for d in paper()}
    chain = replace(own["lemma2"], claim=replace(own["lemma2"].claim, rests_on=("doe2026:4", "doe2026:7")))
    found = {f.equation: f for f in findings(judged([chain if d is own["lemma2"] else d for d in own.values()]))}
    assert found["lemma2"].because == ("4", "7")
    assert verdict_sentence(found["lemma2"]) == (
        "Lemma 2 holds, but not by the way of the text, which uses equation (4), which fails.")


@pytest.mark.parametrize(("point", "show", "shown"), [
    ({"x": "-1/4", "y": "1/3"}, "x*y >= 0", "with $x = -\\frac{1}{4}$, $y = \\frac{1}{3}$, the left side of "
     "$x y \\ge 0$ is $-\\frac{1}{12}$ and the right side $0$"),
    ({"x": "-1/4", "y": "3/8"}, "x*y >= 0", "with $x = -0.25$, $y = 0.375$, the left side of $x y \\ge 0$ is "
     "$-0.09375$ and the right side $0$"),
    ({"x": "-1/4", "y": "1/2"}, "x >= y/3", "with $x = -\\frac{1}{4}$, $y = \\frac{1}{2}$, the left side of "
     "$x \\ge \\frac{y}{3}$ is $-\\frac{1}{4}$ and the right side $\\frac{1}{6}$"),
    ({"x": "-1/4"}, "x >= 3/10", "with $x = -0.25$, the left side of $x \\ge 0.3$ is $-0.25$ and the right "
     "side $0.3$"),
    ({"x": "-1/4", "y": "1234567/3"}, "x*y >= 0", "with $x = -0.25$, $y \\approx 4.115 \\times 10^{5}$, the left side "
     "of $x y \\ge 0$ is $-1.029 \\times 10^{5}$ and the right side $0$, rounded")])
def test_numbers_of_one_counterexample_are_all_decimals_or_all_fractions(point, show, shown):
    assert breaks_at(counterexample_of(certificate("a:1", "refuted", show, point))) == shown


def test_all_other_letters_are_those_of_the_two_sides_where_more_have_a_value():
    names = "abcdefgh"
    show, point = f"{'*'.join(names)} >= 1", dict.fromkeys(names, "0")
    alone = counterexample_of(certificate("a:1", "refuted", show, point))
    assert breaks_at(alone).startswith("with all letters equal to $0$, ")
    more = counterexample_of(certificate("a:1", "refuted", show, {**point, "p": "1"}, ("p <= 1",)))
    assert breaks_at(more).startswith("with all letters on which its sides depend equal to $0$, ")


@pytest.mark.parametrize(("show", "sides"), [
    ("-2*exp(-x) >= 0", (r"-2 e^{-1}", "0")), ("log(x + 1) <= exp(0)/2", (r"\ln\left(2\right)", "0.5")),
    ("exp(-x) + 1 <= 1", (r"\approx 1.36788", "1")), ("D(exp(-x)) >= 0", ("-e^{-1}", "0"))])
def test_a_side_that_is_one_exponential_or_logarithm_is_not_rounded(show, sides):
    found = counterexample_of({"verdict": "refuted", "point": {"x": "1"}, "goal": {"show": [show], "flow": {"x": "1"}}})
    assert (found.left, found.right) == sides


def test_numbers_that_differ_are_not_told_to_be_equal():
    """Both are 0.003784 to four digits, and a reader was told that they are the same."""
    found = counterexample_of({"verdict": "violated", "point": {"a": "3784111/1000000000", "b": "3784073/1000000000"},
                               "goal": {"show": ["b >= a"]}})
    assert set(found.values) == {r"a \approx 0.003784111", r"b \approx 0.003784073"}


def test_numbers_in_a_motion_are_written_alike():
    goal = {"assume": [], "show": ["x**2 <= e"], "flow": {"t": "1", "x": "w", "e": "0"}, "inputs": ["w"],
            "eventually": "t"}
    at = {"verdict": "refuted", "goal": goal, "functions": {"x": "8/3 + 16*t"}, "point": {"e": "1/4"}}
    assert counterexample_of(at).values == (r"x = \frac{8}{3} + 16 t", r"e = \frac{1}{4}")
    at["functions"] = {"x": "3/10 + 16*t"}
    assert counterexample_of(at).values == ("x = 0.3 + 16 t", "e = 0.25")


def test_a_printed_sentence_has_one_full_stop():
    line = replace(found_by_equation()["4"], printed=r"\text{it is stable.}")
    assert printed_sentence(line).endswith(r"stable.}$") and printed_sentence(found_by_equation()["4"]).endswith("$.")


@pytest.mark.parametrize(("text", "shown"), [
    ("z_1 <= 0 and rho_hat -> 0", "z₁ ≤ 0 and ρ̂ → 0"), ("see leakage_proof.py and closed_loop", None),
    ("t^2 and x_1^2", "t² and x₁²"), ("see proofs/paper.py", None),
    ("rho_knu_hat, 4c_k and W_v*", "ρ̂_{kν}, 4cₖ and Wᵥ*"),
    ("E_{i-1} and e_(i-1)", "Eᵢ₋₁ and eᵢ₋₁"), ("f^a, x' and 'in'", "f^a, x′ and 'in'"), ("exp^(-mu t)", "exp^{−μt}"),
    ("sum_q omega_q", "∑_q ω_q"), ("least: pi and eta, not pi_1", "least: pi and η, not π₁")])
def test_words_keep_their_letters_as_formulas(text, shown):
    assert show(worded(text), plain_formula) == (text if shown is None else shown)


def test_a_formula_with_dollars_of_its_own_does_not_end_early():
    printed = r"\text{for all $k$}"
    assert show(f"it is {math(printed)}.", lambda latex: f"<{latex}>") == f"it is <{printed}>."


def test_a_page_tells_a_headline_statement_once():
    """With its fate, not among the findings again; what would only repeat the reason is left out."""
    document = findings_document(findings(paper()))
    fate = {"id": "doe2026:theorem1", "fate": "falls", "fate_why": "refuted by a counterexample"}
    told = {view.place for group in finding_groups(document | {"claims": [fate]}) for view in group.findings}
    assert "Theorem 1" not in told and "Equation (4)" in told
    (view,) = fated_findings(document | {"claims": [fate]}).values()
    assert view.place == "Theorem 1" and "is false as printed" in view.sentence and view.command
    proved = [{**entry, "verdict": "proved"} for entry in document["findings"]]
    (view,) = fated_findings({"findings": proved, "claims": [fate]}).values()
    assert view.sentence == ""
    # A document that tells no fate has it among the findings.
    assert "Theorem 1" in {view.place for group in finding_groups(document) for view in group.findings}
