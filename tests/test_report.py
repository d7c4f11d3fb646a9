"""The page: complete, self-contained, and nobody's text becomes its code."""

import re
from base64 import b64encode
from dataclasses import replace
from hashlib import sha256
from html import escape, unescape
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest
from small_page import HOSTILE, small_content

from workbench.files import numbers
from workbench.report import figures
from workbench.report.formulas import formula
from workbench.report.page import ReportContent, build_page
from workbench.report.sources import sourced_values
from workbench.report.tables import nominal_table

VOID = {"meta", "link", "br", "img", "input", "hr", "wbr"}

@pytest.fixture(scope="module")
def content(tmp_path_factory):
    return small_content(tmp_path_factory.mktemp("report"))


@pytest.fixture(scope="module")
def page(content):
    return build_page(content)


class Reader(HTMLParser):
    """Checks that elements nest, and keeps ids, links, attributes and headings."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.links, self.tags, self.attributes = [], [], [], [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs
        self.ids += [value for name, value in attrs if name == "id"]
        self.links += [value for name, value in attrs if name in ("href", "xlink:href")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def read(page):
    reader = Reader()
    reader.feed(without_scripts(page))
    assert reader.open == []
    return reader


def without_scripts(page):
    """The page without what a library's script has in it, of which a browser's test shows that nothing is asked for."""
    return re.sub(r"<script>.*?</script>", "", page, flags=re.DOTALL)


def test_page_refers_to_nothing_outside(page):
    text = without_scripts(page)
    for address in re.findall(r"https?://[^\s\"'<>)]*", text):
        assert address.startswith("http://www.w3.org/"), address
    reader = read(page)
    assert all(link.startswith("#") or re.fullmatch(r"curves/[\w-]+\.csv", link) for link in reader.links)
    assert not {"link", "iframe", "object", "embed", "base", "form"} & set(reader.tags)
    assert "url(" not in re.sub(r"url\((#[\w-]+|data:font/woff2;base64,[\w+/=]+)\)", "", text)


def test_links_lead_somewhere_and_figures_do_not_share_ids(page):
    reader = read(page)
    assert len(reader.ids) == len(set(reader.ids))
    for link in reader.links:
        assert link[1:] in reader.ids or link.endswith(".csv"), link


def test_every_claim_is_there_with_its_verdict(content, page):
    text = unescape(page)
    for claim in content.claims["claims"]:
        assert claim["id"] in text
        assert claim.get("verdict", "undecided") in text
    assert page.count("<tbody data-verdict") == len(content.claims["claims"])


def test_nobodys_text_becomes_markup(page):
    reader = read(page)
    scripts = re.findall(r"<script[^>]*>", page)
    assert scripts.count("<script>") == 3  # the page's own, the library, the charts
    assert len(scripts) - 3 == scripts.count('<script type="application/json">') == page.count('<figure id="')
    assert "img" not in reader.tags and "b>title" not in reader.tags
    assert not [name for name, _ in reader.attributes if name.startswith("on")]
    assert '<tr class="extra">' in page
    assert "&lt;b&gt;heavy&lt;/b&gt;" in page and "<b>heavy" not in page
    assert "A &lt;tiny&gt; scenario" in page


def test_the_only_scripts_are_those_that_the_page_allows(page):
    allowed = re.search(r"script-src ((?:'sha256-[\w+/=]{44}' ?)+);", page)[1].split()
    for script, digest in zip(re.findall(r"<script>(.*?)</script>", page, re.DOTALL), allowed, strict=True):
        assert digest == f"'sha256-{b64encode(sha256(script.encode()).digest()).decode()}'"
    assert "default-src 'none'" in page


def test_page_never_says_nan_and_shows_failures(page):
    text = re.sub(r"<style>.*?</style>|<script>.*?</script>|<[^>]*>", " ", page, flags=re.DOTALL)
    assert not re.search(r"\b(nan|NaN|inf|None)\b", text)
    assert "left its domain" in text
    assert re.search(r"failed:\s+yang2021.pocrac left", text)


def test_page_is_accessible(page):
    page = without_scripts(page)
    reader = read(page)
    assert '<html lang="en">' in page and reader.tags.count("h1") == 1
    tables = re.findall(r"<table[^>]*>\s*<(\w+)", page)
    assert set(tables) == {"caption"}
    drawings = re.findall(r"<svg[^>]*>", page)
    assert drawings and all('role="img"' in tag and 'aria-label="' in tag for tag in drawings)


def test_what_is_assumed_is_listed_with_its_reason(content, page):
    values = {value.key: value for value in sourced_values(content.scenario)}
    assert values["train.mass_kg"].kind == "assumed" and values["train.davis_a_mps2"].kind == "paper"
    assert values["track.length_m"].words == "short" and values["simulation.log_every_s"].kind == "convention"
    text = unescape(page).replace("<wbr>", "").replace("\N{MINUS SIGN}", "-")
    for value in values.values():
        assert value.key in text and value.words in text


def test_the_first_screen_has_one_figure(page):
    """Who holds the desired run how well stands before the proof, and is not drawn twice."""
    summary, rest = page.split('id="proof"', 1)
    assert summary.count("<figure") == 1 and 'id="position-errors"' in summary
    assert 'id="position-errors"' not in rest


def test_the_badges_count_lines_of_the_paper_alone(content):
    rows = [{"id": f"a:{n}", "paper": "a", "equation": str(n), "title": "x", "verdict": verdict, "origin": origin}
            for n, (verdict, origin) in enumerate([("proved", "printed"), ("refuted", "ours"), ("proved", "implied")])]
    page = build_page(ReportContent(scenario=content.scenario, claims={"claims": rows}))
    assert re.findall(r"<b>(\d+)</b> (\w+)", page) == [("2", "proved")]


def test_page_of_a_scenario_alone(content):
    page = build_page(ReportContent(scenario=content.scenario))
    read(page)
    assert 'id="proof"' not in page and 'id="assumptions"' in page


@pytest.mark.parametrize("document", [{}, {"claims": None}, {"claims": [None, 3, {}]}, {"claims": "x"}])
def test_page_bears_odd_claim_documents(content, document):
    read(build_page(ReportContent(scenario=content.scenario, claims=document)))


def test_figures_are_reproducible_small_and_dateless(content):
    scenario, runs = content.scenario, content.runs
    for draw in (lambda: figures.line_profile(scenario), lambda: figures.tracking(runs[0]),
                 lambda: figures.errors(scenario, runs, "position"),
                 lambda: figures.errors(scenario, runs, "command"),
                 lambda: figures.spread(scenario, content.sweep, {})):
        text = draw()
        assert text == draw()
        assert len(text) < 150_000 and "<metadata" not in text and "20:" not in text
        ElementTree.fromstring(text)


def test_figures_of_long_runs_and_many_rows_stay_small(content):
    long = replace(content.runs[0], log=content.runs[0].log.repeat(200, axis=0))
    assert len(figures.errors(content.scenario, [long] * 6, "speed")) < 150_000
    rows = [replace(row, run=i) for i in range(300) for row in content.sweep[:3]]
    assert len(figures.spread(content.scenario, rows, {})) < 90_000  # of three controllers


def test_failed_run_keeps_no_whole_run_numbers_and_wins_nothing(content):
    place = list(content.scenario.controllers).index("narrow")
    for row in nominal_table(content.metrics):
        assert place not in row.best
        if row.label in ("Stopping error", "Traction energy at the wheel"):
            assert row.cells[place] == numbers.NOTHING


@pytest.mark.parametrize("latex", [
    r"\dot{V} \le -\rho V", r"\begin{cases} 1 & x < 0 \\ 2 & x > 0 \end{cases}",
    r"$\lim_{t \to \infty} e_1 = 0$", r"\left|x\right| = \sum_{j=1}^{n} w_j",
])
def test_formulas_become_mathml(latex):
    text = str(formula(latex))
    assert ElementTree.fromstring(text).tag == "math"
    assert "\\" not in text and "$" not in text


def test_limits_stand_under_their_operator():
    assert "<munder>" in formula(r"\lim_{t \to \infty} x")
    assert "<munderover>" in formula(r"\sum_{j=1}^{n} w_j")


def test_long_formulas_can_be_broken():
    assert formula(" + ".join(rf"\frac{{a_{i}}}{{b_{i}}}" for i in range(9))).count("<math") == 9


@pytest.mark.parametrize("latex", [r"\frac{1}{", r"\left( a < b", r"\nosuchcommand{<b>x</b>}", "{", "\\"])
def test_what_is_no_formula_comes_back_as_escaped_code(latex):
    assert formula(latex) == f"<code>{escape(latex)}</code>"


def test_formulas_carry_nothing_but_mathml():
    for latex in (r"\href{javascript:alert(1)}{x}", r"\style{background:url(x)}{y}", r"\class{a}{y}", HOSTILE,
                  r"\text{<img src=x onerror=alert(1)>}", r"\text{</math><script>alert(1)</script>}"):
        reader = read(str(formula(latex)))
        assert {name for name, _ in reader.attributes} <= {"display", "displaystyle", "stretchy", "form"}
        assert not {"img", "script", "a"} & set(reader.tags)
    assert formula("") == ""


@pytest.mark.parametrize(("value", "text"), [
    (None, "—"), (float("nan"), "—"), (float("-inf"), "—"), (0.0, "0"), (-0.00562890, "−0.00563"),
    (6477.0105, "6480"), (1234567.0, "1\u202f230\u202f000"), (1.40993e-7, "1.41\u202f×\u202f10⁻⁷"),
    (0.99999, "1.00"), (17904, "17\u202f904"), (-3e12, "−3.00\u202f×\u202f10¹²"),
])
def test_numbers_for_readers(value, text):
    assert numbers.number(value) == text


@pytest.mark.parametrize(("value", "text"), [
    (1e-5, "1\u202f×\u202f10⁻⁵"), (200000.0, "200\u202f000"), (-0.6, "−0.6"),
    (float("inf"), "∞"), (14.8, "14.8"),
])
def test_stated_numbers_keep_their_digits(value, text):
    assert numbers.exact(value) == text


def test_fixed_decimals_have_no_negative_zero():
    assert (numbers.fixed(-0.0001, 2), numbers.fixed(-1234.5, 1)) == ("0.00", "−1234.5")


@pytest.mark.parametrize(("unit", "text"), [("m/s^2", "m/s²"), ("kg m^-3", "kg m⁻³"), ("1/(m^2 s^10)", "1/(m² s¹⁰)"),
                                            ("m", "m"), ("", "")])
def test_units_are_printed_with_raised_powers(unit, text):
    assert numbers.unit_text(unit) == text
