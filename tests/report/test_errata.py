"""Errata: complete, in every format, and re-checkable by what they say."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from html.parser import HTMLParser
from importlib import import_module
from pathlib import Path

import pytest
from small_decisions import paper

from workbench.proof import checker
from workbench.proof.checker import goal_digest
from workbench.report.counterexample import counterexample_of
from workbench.report.errata import pdf
from workbench.report.errata.blocks import Code, Formula, Heading, Item, Items, Paragraph
from workbench.report.errata.chain import corrections
from workbench.report.errata.content import errata
from workbench.report.errata.latex import latex_document
from workbench.report.errata.markdown import markdown
from workbench.report.errata.names import noted
from workbench.report.errata.page import html_document
from workbench.report.errata.proof_steps import proof_steps
from workbench.report.errata.write import NO_PDF, write_errata
from workbench.report.letters import letters_in

CITATION = "J. Doe, A paper_of one's own & more, 2026"


def test_every_failing_line_has_a_number_a_place_and_its_numbers(tmp_path):
    text = markdown(errata(paper(), CITATION))
    # The cause is told first, and its evidence with that of the others.
    assert [int(n) for n in re.findall(r"^### (\d+)\. ", text, re.MULTILINE)] == [1, 1, 2, 3, 4, 5]
    assert "### 1. Equation (4) (section 3): the line 4" in text
    assert re.search(r"Theorem 1 \([^)]+\) falls", text) and re.search(r"Lemma 2 \([^)]+\) holds", text)
    assert "$$\nz_1^2 \\ge 1\n$$" in text and "0.5^{2} = 0.25" in text
    assert "Of 2 headline statements, 1 falls and 1 stands." in text
    assert text.index("falls: ") < text.index("and no line that the text uses")  # what falls is told first
    assert "Readings that the extracted text leaves open" in text and "Theorem 1, mended" in text


def test_what_a_counterexample_is_given_can_be_followed():
    """Premises, rates and the values of letters that stand in these alone: without them -1 = 0 is a riddle."""
    found = counterexample_of({
        "verdict": "gap", "point": {"w": "0", "V": "2", "mu": "1", "k": "3", "rate": "1/2"},
        "goal": {"assume": ["k > 0", "w <= mu - V/2"], "show": ["D(V*mu) < w"], "flow": {"V": "rate*mu", "k": "0"}}})
    assert found.given == (r"w \le \mu - \frac{V}{2}",) and found.along == (r"\frac{d}{dt} V = \mathrm{rate} \mu",)
    assert found.beside == ("V = 2",) and set(found.values) == {r"\mathrm{rate} = 0.5", r"\mu = 1", "w = 0"}
    assert counterexample_of({"verdict": "gap", "point": {"w": "0", "V": "2"}, "goal": {
        "assume": ["w <= V"], "show": ["w < 0"]}}).beside == ("V = 2",)
    assert counterexample_of({"verdict": "gap", "point": {"x_d": "1", "xdot_d": "1"}, "goal": {
        "show": ["D(x_d) <= 0"], "flow": {"x_d": "xdot_d"}}}).along == ()  # the rate's letter says it
    text = markdown(errata(paper(), CITATION))
    assert "**Under the conditions:**\n\n$$\nz_{2} \\le k\\quad\\text{with}\\ z_{2} = -2\n$$" in text


def test_a_letter_that_is_stated_by_its_logarithm_is_told_itself():
    """An indexed gain that is positive is typed e^log_Gamma; of its value 1 nobody shall read that it is 0."""
    found = counterexample_of({
        "verdict": "refuted", "point": {"log_Gamma": "0", "log_m": "2", "x": "0", "y": "0", "z": "0"},
        "goal": {"assume": ["Sum(0*x) == 0", "x >= y"], "flow": {"y": "z*exp(log_m)"},
                 "show": ["D(y)*exp(log_Gamma) > x"]}})
    assert r"\Gamma = 1" in found.values and r"\ln m = 2" in found.values
    assert dict(found.everything)[r"\Gamma"] == "1" and found.given == (r"x \ge y",)


def test_numbers_with_which_a_condition_holds_are_written_as_those_that_break_it():
    held = r"T_{min} = 1900,\ s_{2} = -\frac{7}{10000}"
    rows = [replace(d, correction=held) if d.verdict == "violated" else d for d in paper()]
    assert r"T_{\mathrm{min}} = 1900,\ s_{2} = -0.0007" in markdown(errata(rows, CITATION))


def test_a_motion_is_written_out_with_the_loop_that_it_obeys_once():
    """Without the loop and its constants nobody can put a motion in."""
    loop = {"always": ["z_dot == k*z - k", "c_dot == m", "z >= 0"], "assume": ["k > 0", "m <= k"], "eventually": "t",
            "flow": {"z": "z_dot", "c": "c_dot", "t": "1"}, "inputs": ["z_dot", "c_dot"]}
    motion = {"claim": "", "version": 2, "verdict": "refuted", "functions": {"z": "1", "c": "3*t"},
              "point": {"k": "5", "m": "3", "epsilon": "1/4"}}
    rows = [replace(d, certificate=motion | {"goal": loop | {"show": [show]}}, correction=None)
            for d, show in zip((paper()[0], paper()[3]), ("c <= epsilon", "z <= epsilon"), strict=True)]
    found = counterexample_of(rows[1].certificate)
    assert found.motion and found.given == (r"m \le k", r"\dot{z} = k z - k", r"\dot{c} = m")
    assert set(found.beside) == {"k = 5", "m = 3"}
    text = markdown(errata(rows, CITATION))
    assert text.count("**What holds at all times:**") == 1 and text.count(r"\dot{z} = k z - k") == 1
    assert "What is assumed, and all numbers, are those of correction 1." in text
    many = loop | {"always": [f"c_dot == {'m + ' * 60}{n}" for n in range(9)], "show": ["z <= epsilon"]}
    text = markdown(errata([replace(rows[1], certificate=motion | {"goal": many})], CITATION))
    assert text.count("$$\n\\dot{c} = m + m") == 9 and "**With:**" in text  # a line for each


def test_how_a_line_was_read_and_what_letters_stand_for_is_said():
    rows = [replace(d, claim=replace(d.claim, reading="theta_hat is read as z_1.")) if d.claim.equation == "6" else d
            for d in paper()]
    letters = {"k": r"the root of $\Gamma$", "z_1": "an entry of z_tilde"}
    text = markdown(errata([replace(d, letters=letters) for d in rows], CITATION))
    assert "**How it is read.** $\\hat{\\theta}$ is read as $z_{1}$." in text
    assert "**Letters.** $k$ is the root of $\\Gamma$." in text[text.index("### 3."):text.index("### 4.")]
    assert "**Letters.** $z_{1}$ is an entry of $\\tilde{z}$." in text[text.index("Theorem 1, mended"):]
    assert "**Letters.**" not in markdown(errata(rows, CITATION))


def test_a_note_names_lines_as_the_paper_does():
    assert noted("D(V_1) along (9), k times D(e).", {}) == "The rate of $V_{1}$ along (9), k times the rate of e."
    note = "See 6, theorem1.mended (7.glyph) and A4; 7.5 % of 4.2 remain."
    decisions = [replace(d, claim=replace(d.claim, note=note)) if d.claim.equation == "4" else d for d in paper()]
    assert ("**Note.** See 6, Theorem 1 “the line theorem1.mended” (equation (7) “the line 7.glyph”) and A4; 7.5 % of "
            "4.2 remain.\n") in markdown(errata(decisions, CITATION))


def test_the_lines_that_a_mended_proof_uses_are_proved_too():
    uses = {"theorem1.mended": ("doe2026:7.glyph", "doe2026:6"), "7.glyph": ("doe2026:lemma2",)}
    rows = [replace(d, claim=replace(d.claim, premises=uses.get(d.claim.equation, ()))) for d in paper()]
    text = markdown(errata(rows, CITATION))
    lemma = text[text.index("## The lines that these proofs use"):text.index("## How to re-check")]
    assert lemma.count("###") == 2 and lemma.index("### Equation (7)") < lemma.index("### Lemma 2")
    assert lemma.count(r"To show: $z_{1}^{2} \ge 0$.") == 2
    assert re.search(r"proof +lemma2 +[0-9a-f]{64}$", text, re.MULTILINE) and "the line 6” (gap)" not in lemma
    assert "these proofs use" not in markdown(errata(paper(), CITATION))


def test_the_commands_it_names_re_check_the_certificates(tmp_path):
    (tmp_path / "checker.py").write_text(Path(checker.__file__).read_text())
    (tmp_path / "certificates").mkdir()
    for d in paper():
        (tmp_path / "certificates" / f"{d.claim.equation}.json").write_text(json.dumps(d.certificate))
    shown = [block.text for block in errata(paper(), CITATION) if isinstance(block, Code)]
    (command,) = (text for text in shown if "--claim" in text)
    rows = [line.split() for line in max(shown, key=len).splitlines()]
    assert [row[0] for row in rows] == ["1", "2", "3", "4", "5", "reading", "proof"]
    for command in [command.replace("NAME", name).replace("DIGEST", digest) for _, name, digest in rows[:2]]:
        done = subprocess.run([sys.executable, *command.split()[1:]], cwd=tmp_path, capture_output=True, text=True,
                              check=False)
        assert done.returncode == 0 and done.stdout.startswith("ok"), done.stdout
    assert goal_digest(paper()[0].certificate) == rows[0][2]


def test_a_proof_is_told_line_by_line_and_what_is_given_has_a_number_where_it_is_used():
    lemma = {"rule": "cut", "lemma": "x**2 >= 1", "proof": {"rule": "combination", "terms": [
        {"coefficient": "2", "factors": [{"assume": 1}]}, {"coefficient": "1", "factors": [{"square": "x - 1"}]}]}}
    unused = {"rule": "cut", "lemma": "k >= 0", "proof": {"rule": "combination", "terms": [
        {"coefficient": "1", "factors": [{"assume": 0}]}]}}
    last = {"rule": "combination", "terms": [
        {"coefficient": "1/4", "factors": [{"assume": 4}, {"assume": 0}, {"assume": 0}, {"inverse": 2}]}]}
    goal = {"assume": ["k > 0", "x >= 1", "m > 0", "y <= 2"], "show": ["k**2*x**2/(4*m) >= k**2/(4*m)"], "flow": {}}
    told = proof_steps({"goal": goal, "proofs": [lemma | {"then": unused | {"then": last}}]})
    # By hand: x^2 - 1 = 2(x - 1) + (x - 1)^2, and k^2 x^2/(4 m) - k^2/(4 m) = (x^2 - 1) k^2/(4 m).
    assert [(line.depth, line.text) for line in told.lines] == [
        (0, r"To show: $\frac{k^{2} x^{2}}{4 m} \ge \frac{k^{2}}{4 m}$."),
        (1, r"[2] $x^{2} \ge 1$, since $x^{2} - 1 = 2 [1] + \left(x - 1\right)^{2}$."),
        (1, r"$\frac{k^{2} x^{2}}{4 m} - \frac{k^{2}}{4 m} = \frac{[2] k^{2}}{4 m}$.")]
    assert told.signs == ("k, m > 0",) and told.given == (r"[1]\ x \ge 1", r"y \le 2")


def test_a_lemma_is_shown_once_unless_it_stands_on_a_case():
    """What was shown in one case without it holds in the other too; what was shown by it does not."""
    free, of_case = ({"rule": "cut", "lemma": text, "proof": {"rule": "combination", "terms": [
        {"coefficient": "1", "factors": [{"assume": index}]}]}} for text, index in (("y >= -1", 0), ("x**2 >= 0", 1)))
    end = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 2}]},
                                            {"coefficient": "1", "factors": [{"assume": 3}]}]}
    both = free | {"then": of_case | {"then": end}}
    told = proof_steps({"goal": {"assume": ["y >= 0"], "show": ["y + x**2 >= -1"], "flow": {}}, "proofs": [
        {"rule": "cases", "of": "x - y", "nonnegative": both, "nonpositive": both}]})
    text = [line.text for line in told.lines]
    assert sum(r"y \ge -1" in line for line in text) == 1 and sum(r"x^{2} \ge 0$, since" in line for line in text) == 2


def test_what_rests_on_a_correction_is_told_by_numbers():
    assert corrections(["a", "b", "c", "d", "x", "f"], {"a": 4, "b": 2, "c": 5, "d": 6, "f": 9}) == (
        "corrections 2, 4 to 6 and 9")
    assert corrections(["a"], {"a": 3}) == "correction 3" and corrections(["a"], {}) == ""
    text = markdown(errata(paper(), CITATION))
    assert "**Consequence.** Theorem 1 (correction 2) rests on it." in text  # (4) is what Theorem 1 rests on
    assert "**Consequence.** In the text it rests on equation (4) (correction 1), which fails." in text
    assert "See correction 2; in the text it rests on correction 1." in text


def test_an_open_reading_is_set_as_formulas_and_one_of_another_line_is_named():
    text = markdown(errata(paper(), CITATION))
    reading = text[text.index("### Equation (7) (section 3)"):]
    assert "**As extracted:**\n\n$$\nz_1 \\ge 0\n$$" in reading
    assert "**Holds when it is read as:**\n\n$$\nz_1^2 \\ge 0\n$$" in reading and re.search(r"reading  7 ", text)
    rows = [replace(d, other_reading=d.claim.printed) if d.claim.equation == "7" else d for d in paper()]
    assert "**Other reading.** It holds with another line read otherwise: “the line 7.glyph”." in markdown(
        errata(rows, CITATION))


def test_a_paper_whose_text_was_not_at_hand_is_charged_with_nothing():
    text = markdown(errata(paper(), CITATION, at_hand=False))
    assert "**As commonly stated:**" in text and "**Printed:**" not in text
    assert "nothing here is charged to the paper itself" in text
    fine = [d for d in paper() if d.claim.equation == "lemma2"]
    text = markdown(errata(fine, CITATION, at_hand=False))
    assert text.startswith("# Corrections: none") and "Refuted" not in text and "Each command" not in text


def test_a_sentence_with_a_power_can_break_and_a_label_keeps_to_its_formula():
    """A power took the whole sentence before it for its base, which no line then broke."""
    source = pdf.typst_source([Formula(r"\text{the largest was 0.48 m/s$^2$ at the start}", "Printed")])
    assert '#"the largest was 0.48 m/s";' in source and '" at the start"' in source and "sticky: true" in source


def test_letters_of_ours_are_written_as_the_paper_writes_them():
    own = letters_in({"goal": {"show": ["k_v*rho_k_hat**2*s <= rho_0**2*b"], "flow": {"rho_k_hat": "rho_k_hat_dot"}}},
                     {"k_v": r"$k_\nu$", "rho_k_hat": r"$\hat\rho_{k\nu}$", "rho_0": r"$\rho_i^0$", "b": "$T_s/M$",
                      "s": "the sign of $z_2$", "w": "$x$"})
    formula = own.in_formula(r"\dot{\hat{\rho}}_{k} = k_{v} \hat{\rho}_{k}^{2} s \le \rho_{0}^{2} b + k_{va}")
    assert formula == r"\dot{\hat\rho}_{k\nu} = k_\nu \hat\rho_{k\nu}^{2} s \le \left(\rho_i^0\right)^{2} b + k_{va}"
    assert own.legend([r"s \le 1"]) == "$s$ is the sign of $z_2$."
    # Where two would look alike, neither is written as the other.
    twins = letters_in({"goal": {"show": ["d_i <= d"]}}, {"d_i": "$d$"})
    assert twins.in_formula(r"d_{i} \le d") == r"d_{i} \le d" and twins.legend(["d_{i}"]) == "$d_{i}$ is $d$."


@pytest.mark.parametrize("proof", [
    {"rule": "identity"}, {"rule": "contradiction", "terms": [{"coefficient": "2", "factors": [{"assume": 0}]}]},
    {"rule": "cases", "of": "x", "nonnegative": {"rule": "identity"}, "nonpositive": {"rule": "identity"}},
    {"rule": "combination", "multiplier": [{"inverse": 0}], "terms": []},
    {"rule": "combination", "terms": [{"coefficient": "1/2", "factors": [
        {"fact": "log_tangent", "of": "x"}, {"square": "x"}, {"sum_of_squares": "x"}, {"positive": "x"}, {"any": "x"},
        {"square_of": 0}]}]},
    {"rule": "monotone", "variable": "x", "from": "0", "derivative": {"rule": "identity"}, "at_start": {
        "rule": "identity"}},
    {"rule": "nonincreasing", "function": "x", "decrease": {"rule": "identity"}, "then": {"rule": "identity"}}])
def test_every_rule_of_the_checker_is_told(proof):
    goal = {"assume": ["x > 0"], "show": ["x >= 0"], "flow": {"x": "-x"}, "initial": {"x": "x_0"}, "always": ["x > 0"]}
    steps = proof_steps({"goal": goal, "proofs": [proof]}).lines
    assert len(steps) >= 2 and all(step.text.count("$") % 2 == 0 for step in steps)


def test_nobodys_text_becomes_markup():
    blocks = [Heading(1, "<b>a & b"), Paragraph("50% of #1 {x} $a < b$ \\cmd", "<i>"), Formula(r"a \& b", "x_y"),
              Items((Item("one_two"), Item("three", 2))), Code("a <b> & c")]
    page = html_document(blocks, "<title>")
    # Without this font the dot of a derivative is not seen, and a correction says something else.
    assert "url(data:font/woff2;base64," in page and "font-src data:" in page and 'font-family:"Page Math"' in page
    reader = HTMLParser()
    reader.feed(page)
    assert "<b>a" not in page and "<i>" not in page and "&lt;b&gt;" in page and "script" not in page
    assert page.count("<ul>") == page.count("</ul>") == 3
    tex = latex_document(blocks)
    assert r"50\% of \#1 \{x\}" in tex and r"\textbackslash{}cmd" in tex and r"one\_two" in tex
    assert r"one\_two" in markdown(blocks)


def test_all_formats_are_written_and_a_missing_one_is_said(tmp_path, monkeypatch):
    written, missing = write_errata(paper(), CITATION, tmp_path / "all")
    assert {path.name for path in written} == {"errata.md", "errata.tex", "errata.html", "findings.json", "errata.pdf"}
    assert missing is None and (tmp_path / "all" / "errata.pdf").read_bytes().startswith(b"%PDF")
    assert json.loads((tmp_path / "all" / "findings.json").read_text())["version"] == 1

    def none(name):
        if name == "typst":
            raise ImportError(name)
        return import_module(name)

    monkeypatch.setattr(pdf, "import_module", none)
    written, missing = write_errata(paper(), CITATION, tmp_path / "some")
    assert len(written) == 4 and missing == NO_PDF


def test_the_same_decisions_make_the_same_bytes():
    blocks = errata(paper(), CITATION)
    assert pdf.pdf_of(blocks) == pdf.pdf_of(errata(paper(), CITATION))
    assert markdown(blocks) == markdown(errata(paper(), CITATION))


def test_the_rate_of_a_letter_is_written_as_the_letter_is():
    """Of a goal that names the rate alone, too."""
    own = letters_in({"goal": {"show": ["rho_k_hat_dot == 1"]}}, {"rho_k_hat": r"$\hat\rho_{k\nu}$"})
    assert own.in_formula(r"\dot{\hat{\rho}}_{k} = 1") == r"\dot{\hat\rho}_{k\nu} = 1"
