"""A corrected statement stands with what it needs; lines are told by kind; nothing that is named is missing."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest
from small_decisions import paper, proof

from workbench.proof.checker import goal_digest
from workbench.proof.paper import collect_papers
from workbench.report.certificate_latex import expression_latex, name_latex
from workbench.report.dots import dotted
from workbench.report.errata.content import errata
from workbench.report.errata.markdown import markdown
from workbench.report.errata.pdf import typst_source
from workbench.report.errata.referred import lines_referred_to
from workbench.report.finding import findings
from workbench.report.finding_sentences import sentences, verdict_sentence
from workbench.report.letters import letters_in
from workbench.report.worded import worded

PROOFS = Path(__file__).resolve().parents[2] / "proofs"
NEAREST = {"goal": {"assume": ["k > 0", "z_1 <= k", "m >= 1"], "show": ["D(z_1**2) <= k"],
                    "flow": {"z_1": "-k*z_1", "b": "b_dot", "k": "0"}}, "example": {}, "proofs": []}


def told(decisions):
    return markdown(errata(decisions, "J. Doe, 2026"))


def changed(equation, claim=None, **fields):
    """The small paper with one decision changed."""
    return [replace(d, claim=replace(d.claim, **(claim or {})), **fields) if d.claim.equation == equation else d
            for d in paper()]


def test_the_conditions_of_a_correction_stand_directly_below_it():
    own = next(d for d in paper() if d.claim.equation == "4")
    rows = changed("4", certificate=own.certificate | {"correction": NEAREST}, letters={"m": "the mass of a car"})
    text = told(rows)
    below = text[text.index("**Should read:**"):text.index("**Finding.**")]
    assert r"z_{1} \le k,\ m \ge 1,\ k > 0" in below and r"\dot{z}_{1} = -k z_{1}" in below
    assert "**Letters.** $m$ is the mass of a car." in below and r"\dot{b}" not in below  # a rate is its own letter
    said = " ".join(sentences(next(f for f in findings(rows) if f.equation == "4")))
    assert r"That is proved for $z_{1} \le k$, $m \ge 1$, $k > 0$, along $\frac{d}{dt} z_{1} = -k z_{1}$" in said


def test_a_mended_form_says_what_the_lines_say_that_its_proof_uses():
    rows = changed("theorem1.mended", {"premises": ("doe2026:7.glyph", "doe2026:lemma2")})
    def below(rows):
        text = told(rows)
        return text[text.index("### 2. Theorem 1"):text.index("**Finding.** Theorem 1")]

    assert "**Also used.** Lemma 2.\n" in below(rows)
    beyond = [replace(d, besides=("m >= 1 (lemma2)",)) if d.claim.mends else d for d in rows]
    assert "**Also used.** Lemma 2 with $m \\ge 1$.\n" in below(beyond)
    assert "**It uses.** Equation (7) “the line 7.glyph”, under no conditions but the signs of letters." in below(rows)
    # What it assumes belongs to the statement.
    more = [replace(d, certificate=d.certificate | {"goal": d.certificate["goal"] | {"assume": ["z_1 <= 5"]}})
            if d.claim.equation == "7.glyph" else d for d in rows]
    assert "**It uses.** Equation (7) “the line 7.glyph”, which is:\n\n$$\nz_1^2 \\ge 0\n$$" in below(more)
    assert "$$\nz_{1} \\le 5\n$$" in below(more)
    theorem = next(f for f in findings(more) if f.equation == "theorem1")
    assert "Under which conditions that is proved, workbench errata doe2026 writes out." in sentences(theorem)


def test_an_assumption_is_not_met_and_what_is_implied_does_not_hold():
    for equation, verdict, says in (("A1", "refuted", "Assumption 1 is not met: with"),
                                    ("A1", "violated", "Assumption 1 is not met at the printed numbers: with")):
        rows = changed("4", {"id": f"doe2026:{equation}"}, verdict=verdict)
        assert verdict_sentence(next(f for f in findings(rows[:1]))).startswith(says)
    rows = changed("4", {"origin": "implied"})
    assert verdict_sentence(findings(rows)[1]).startswith("What the text implies at equation (4), “the line 4”, does")
    broken = changed("4", {"origin": "implied"}, verdict="violated")
    assert "“the line 4”, does not hold at the printed numbers" in verdict_sentence(findings(broken)[1])


def test_what_fails_only_as_extracted_is_not_counted_as_refuted():
    counts = next(line for line in told(paper()).splitlines() if line.startswith("Of "))
    assert "3 are refuted" in counts and "one more fails only as extracted from the page and holds" in counts


def test_lines_that_are_named_and_stand_nowhere_else_are_written_out():
    rows = changed("4", {"note": "See 7.glyph and theorem1.mended."})
    text = told(rows)
    referred = text[text.index("## Lines referred to"):text.index("## How to re-check")]
    assert re.findall("^### (.*)$", referred, re.MULTILINE) == ["Equation (7) “the line 7.glyph”"]
    assert "$$\nz_1^2 \\ge 0\n$$" in referred and "**Verdict.** Proved." in referred and "To show:" in referred
    assert re.search(rf"^   line  7.glyph +{goal_digest(rows[6].certificate)}$", text, re.MULTILINE)
    # A short proof from what is given is told with the numbers of what it takes.
    terms = [{"coefficient": "1", "factors": [{"assume": 0}]}, {"coefficient": "1", "factors": []}]
    given = proof("doe2026:7.glyph", "z_1 >= 0", terms, {"z_1": "1"}, ("z_1 >= 1",))
    text = told([replace(d, certificate=given) if d.claim.equation == "7.glyph" else d for d in rows])
    referred = text[text.index("## Lines referred to"):text.index("## How to re-check")]
    assert r"[1]\ z_{1} \ge 1" in referred and "- $z_{1} = [1] + 1$." in referred
    assert "## Lines referred to" not in told(paper())


def test_a_line_referred_to_has_its_proof_with_what_is_given_numbered():
    """The proof uses what is given by its number; how that is read is said where no mended statement says it."""
    terms = [{"coefficient": "1", "factors": [factor]} for factor in ({"assume": 0}, {"square": "k"})]
    shown = proof("doe2026:7.glyph", "x >= k", terms, {"x": "1", "k": "0"}, ["x >= k + k**2"])
    rows = [replace(d, certificate=shown) if d.claim.equation == "7.glyph" else d
            for d in changed("4", {"note": "See 7.glyph."})]
    text, how = told(rows), "a number in square brackets is a line of what is given"
    referred = text[text.index("## Lines referred to"):]
    assert "[1]\\ x \\ge k + k^{2}" in referred and "  - $x - k = [1] + k^{2}$." in referred
    assert text.count(how) == 1 and how not in referred  # the mended theorem stands before
    assert how in markdown(lines_referred_to([rows[6]], False))


def test_the_mended_form_of_a_line_is_written_out_though_nothing_names_it():
    rows = changed("7.glyph", {"mends": "doe2026:6", "glyph": None})
    text = told(rows)
    assert "### Equation (7) “the line 7.glyph”" in text[text.index("## Lines referred to"):]


def test_what_holds_is_listed_by_section_with_the_corrections_of_other_parts():
    text = told(paper())
    held = text[text.index("## What holds as it stands"):text.index("## Evidence")]
    assert "- Section 3: Lemma 2 (the line lemma2).\n" in held and "other parts fail" not in held
    ids = {"lemma2": "doe2026:6", "6": "doe2026:6.part"}
    rows = [replace(d, claim=replace(d.claim, id=ids.get(d.claim.equation, d.claim.id), severity="step"), fate=None)
            if d.claim.equation in ids else d for d in paper()]
    held = told(rows)[told(rows).index("## What holds as it stands"):told(rows).index("## Evidence")]
    assert "- Section 3: equation (6).\n\nOf equation (6) other parts fail: correction 3." in held


def test_a_sum_counts_by_the_index_of_its_letters():
    assert expression_latex("Sum(q_j**2*e_j)") == r"\sum_{j} q_{j}^{2} e_{j}"
    assert expression_latex("Sum(p_k*x_i)") == r"\sum_{i} p_{k} x_{i}" and expression_latex("Sum(x)") == r"\sum_{i} x"


def test_a_step_that_the_text_only_implies_is_not_told_as_the_line_at_its_number():
    step = paper_row("8", title="V is positive", origin="implied")
    text = told([*paper(), step])
    held = text[text.index("## What holds as it stands"):text.index("## Evidence")]
    assert "- Section 3: Lemma 2 (the line lemma2); what the text implies at (8) “V is positive”.\n" in held


def paper_row(equation, **fields):
    """The lemma of the small paper as a line of another number."""
    own = next(d for d in paper() if d.claim.equation == "lemma2")
    return replace(own, claim=replace(own.claim, id=f"doe2026:{equation}", severity="step", **fields), fate=None)


@pytest.mark.parametrize(("latex", "shown"), [
    (r"\frac{d}{dt} \tilde{b} = \frac{d}{dt} \left[\tilde{b} + b^{*}\right]",
     r"\dot{\tilde{b}} = \dot{\tilde{b}} + \dot{b}^{*}"),
    (r"\frac{d}{dt} \hat{W}_{v} x", r"\dot{\hat{W}}_{v} x"), (r"\frac{d}{dt} w_{f}^{2}", None),
    (r"\frac{d}{dt} \left[\frac{e^{2}}{2} + x\right]", None), (r"\frac{d}{dt} \hat\phi_c(k, 1)", None),
    (r"\frac{d}{dt} \mathrm{rate}", None), (r"\frac{d}{dt} \ln m", None)])
def test_rates_of_letters_are_dots_and_others_stay(latex, shown):
    assert dotted(latex) == (latex if shown is None else shown)


@pytest.mark.parametrize(("text", "shown"), [
    ("at most l/mu + delta", r"at most $l/\mu$ + $\delta$"), ("chi/mu >= 1/sigma_i", r"$\chi/\mu$ ≥ $1/\sigma_{i}$"),
    ("V_1/2 in N/kg, a/b", "$V_{1}/2$ in N/kg, a/b"), ("(theta - 1)/mu", r"($\theta$ - 1)/$\mu$")])
def test_a_quotient_of_letters_is_one_formula(text, shown):
    assert worded(text) == shown


def test_the_lines_of_code_and_of_cases_stand_below_each_other_in_the_pdf():
    """Two commands in a line are none, and of cases without breaks nobody sees where one ends."""
    source = typst_source(errata(paper(), "J. Doe"))
    assert r'"workbench prove doe2026 --write" + "\n" + "workbench errata doe2026"' in source
    rows = changed("4", {"printed": r"x = \begin{cases} a, & b \\ c, & d \end{cases}"})
    assert re.search(r"cases\(a [^&]*& b *, c [^&]*& d *\)", typst_source(errata(rows, "J. Doe")))
    rows = changed("4", {"printed": r"x = \begin{pmatrix} a & b \\ c & d \end{pmatrix}"})
    assert "mat(delim: #none, align: #left, a, b; c, d)" in typst_source(errata(rows, "J. Doe"))


@pytest.mark.parametrize("folder", sorted(path.parent.name for path in PROOFS.glob("*/certificates")))
def test_the_letters_of_a_goal_are_told_apart_and_are_those_of_its_statement(folder):
    """Two letters that look alike make false what is said of both; an extreme that the statement does not name may be
    the other one, unless the paper has letters for both."""
    (stated,) = collect_papers([PROOFS / folder])
    for claim in stated.claims:
        path = PROOFS / folder / "certificates" / f"{claim.equation}.json"
        if not path.exists():
            continue
        certificate = json.loads(path.read_text())
        letters = letters_in(certificate, claim.letters)
        names = {name_latex(name) for name in re.findall(r"[A-Za-z_]\w*", json.dumps(certificate["goal"]))}
        shown = [letters.written.get(latex, latex) for latex in sorted(names | letters.written.keys())]
        assert len({re.sub(r"[{}\s]", "", one) for one in shown}) == len(shown), claim.id
        statement = claim.printed + (claim.corrected_statement or "")
        for symbol in letters.written.values():
            other = re.sub(r"\\(min|max)", lambda found: {"min": r"\max", "max": r"\min"}[found[1]], symbol)
            assert other == symbol or symbol in statement or any(
                other in told for told in claim.letters.values()), (claim.id, symbol)
