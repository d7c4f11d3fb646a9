"""The page as a reader has it, in headless Chromium: nothing asked for, nothing complained of, everything reached."""

import shutil
from importlib.resources import files

import pytest
from short_sweep import write_scenario

from workbench.paper.results import ResultTable, StudyResult
from workbench.report.charts.files import write_curves
from workbench.report.errata.blocks import Code, Formula, Heading, Item, Items, Paragraph
from workbench.report.errata.page import html_document
from workbench.report.page import ReportContent, build_page, scenario_charts
from workbench.trains.scenario import load_scenario

CHROMIUM = shutil.which("chromium")
playwright = pytest.importorskip("playwright.sync_api")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium to look with: apt install chromium")
WIDTHS = (1400, 800, 390)
PATIENCE_MS = 120_000  # a busy machine may take long; nothing waits longer than it must


def claim(equation, verdict, rests_on=(), tainted_by=(), **more):
    return {"id": f"p:{equation}", "paper": "p", "equation": equation, "section": "2", "kind": "identity",
            "statement": r"\dot{V} = \ddot{z}", "verdict": verdict, "origin": "printed", "severity": "step",
            "rests_on": [f"p:{name}" for name in rests_on], "tainted_by": [f"p:{name}" for name in tainted_by], **more}


WIDE = rf"\frac{{{'a_{1}' * 150}}}{{b}}"  # wider than any screen, with no place to break
CLAIMS = {
    "version": 1,
    "claims": [
        claim("1", "proved"), claim("2", "refuted", ["1"], counterexample={"z_1": "-1/2"}, correction="a = b"),
        claim("3", "proved", ["2"], ["2"], section="3", statement=WIDE),
        claim("theorem1", "gap", ["3"], ["2"], section="3", severity="result", fate="open", fate_why="it is open"),
    ],
    "findings": [{"paper": "p", "equation": "2", "gravity": "step", "heading": "Lines that fail",
                  "place": "Equation (2)", "verdict": "refuted", "printed": "a = c", "should_read": "a = b",
                  "sentences": ["Equation (2) is false as printed.", "Theorem 1 rests on it."], "digest": "0" * 64}],
}


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    gains = ResultTable("Conditions", "paper", ("gains", "condition", r"$\dot V$"),
                        (("stated", "k < 2", "1"), ("", "k < 3", "2"), (r"$\hat k$", "", "3")), letters=True)
    many = ResultTable("Rows", "paper", ("row",), tuple((row,) for row in "abcdefghijklmn"))
    content = ReportContent(scenario=load_scenario(write_scenario(folder)), claims=CLAIMS,
                            gains=StudyResult((), (gains, many), (), ()),
                            commands=(f"workbench report {'/a-long-folder' * 9} --out out",))
    (folder / "report.html").write_text(build_page(content), encoding="utf-8")
    write_curves(list(scenario_charts(content).values()), folder)
    return (folder / "report.html").as_uri()


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as running:
        opened = running.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"], timeout=PATIENCE_MS)
        yield opened
        opened.close()


@pytest.fixture(scope="module")
def complaints():
    return []


@pytest.fixture(scope="module")
def view(browser, address, complaints):
    """One page for all tests; `complaints` collects what its console and its network say."""
    page = browser.new_page()
    page.set_default_timeout(PATIENCE_MS)
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: None if request.url.startswith((address, "data:"))
            else complaints.append(request.url))
    page.goto(address, wait_until="domcontentloaded")
    yield page
    page.close()


def wait_until(page, holds):
    """Until an expression of JavaScript holds; asked from here, for a page that forbids eval cannot ask itself."""
    for _ in range(PATIENCE_MS // 50):
        if page.evaluate(holds):
            return
        page.wait_for_timeout(50)
    pytest.fail(f"after {PATIENCE_MS / 1000:g} s it does not hold: {holds}")


def shown_claims(page):
    return page.eval_on_selector_all("tbody[data-verdict]:not([hidden])", "found => found.map(e => e.dataset.verdict)")


def test_filters_show_what_is_chosen_and_live_in_the_address(view, address):
    view.select_option("select[name=verdict]", "proved")
    assert shown_claims(view) == ["proved", "proved"]
    view.select_option("select[name=section]", "3")
    assert shown_claims(view) == ["proved"]
    kept = view.evaluate("location.href")
    assert kept == address + "#show?verdict=proved&section=3"
    assert view.inner_text("#shown") == "1 of 4 claims"
    view.goto(address + "#proof")
    view.reload(wait_until="domcontentloaded")
    assert len(shown_claims(view)) == 4
    view.goto(kept)
    wait_until(view, "document.getElementById('shown').textContent === '1 of 4 claims'")
    assert shown_claims(view) == ["proved"]


def test_search_finds_text_and_a_link_shows_what_was_filtered_away(view):
    view.evaluate("location.hash = '#show?q=p:1'")
    wait_until(view, "document.getElementById('shown').textContent === '1 of 4 claims'")
    view.evaluate("location.hash = '#claim-p:theorem1'")
    wait_until(view, "document.getElementById('shown').textContent === '4 of 4 claims'")
    view.wait_for_selector("[id='claim-p:theorem1']")


def test_a_finding_opens_and_leads_to_its_claim_in_its_folded_section(view):
    assert not view.is_visible(".finding .correction")
    view.click(".finding summary")
    view.wait_for_selector(".finding .correction")
    view.eval_on_selector_all("details.paper-section", "found => found.forEach(fold => { fold.open = false; })")
    view.click(".finding a[href='#claim-p:2']")
    view.wait_for_selector("[id='claim-p:2']")


def test_graph_shows_the_broken_path_and_leads_to_its_lines(view):
    first = view.locator(".graph").first
    assert first.locator("path.broken").count() == 2
    assert [text.split(" ", 1)[1] for text in first.locator("text").all_text_contents()] == ["(2)", "(3)", "Theorem 1"]
    view.locator("#graph details", has_text="in words").first.locator("summary").click()
    assert "(2), refuted: (3) rests on it." in view.inner_text("#graph")
    first.locator("a").nth(1).click()
    wait_until(view, "location.hash === '#claim-p:3'")
    view.wait_for_selector("[id='claim-p:3']")


def test_plots_zoom_tell_values_and_have_their_table_and_file(view):
    figure = view.locator("#line")
    figure.scroll_into_view_if_needed()
    view.wait_for_selector("#line .chart .nsewdrag")
    figure.locator(".plot svg").wait_for(state="hidden")
    span = "document.querySelector('#line .chart').layout.xaxis.range"
    before = view.evaluate(span)
    area = figure.locator(".nsewdrag").first
    area.hover()
    box = area.bounding_box()
    buttons = figure.locator(".modebar-btn")
    assert {button.get_attribute("data-title") for button in buttons.all()} == {"Zoom", "Pan", "Reset axes"}
    view.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 0.5 * box["height"], steps=4)
    view.wait_for_selector("#line .hoverlayer text")
    view.mouse.down()
    view.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + 0.52 * box["height"], steps=4)
    view.mouse.up()
    wait_until(view, f"{span}[1] - {span}[0] < {0.5 * (before[1] - before[0])}")
    figure.locator("summary").click()
    figure.locator("tbody tr").first.wait_for()  # the table is filled once it is opened
    assert figure.locator("tbody tr").count() > 20
    assert (figure.locator("thead").inner_text()).split("\t")[-1].strip() == "value"
    file = figure.locator("a").get_attribute("href")
    assert file == "curves/01-the-line-and-the-desired-speed.csv"


def test_what_scrolls_sideways_is_reached_by_keys_and_nothing_else_is(view):
    view.eval_on_selector_all("details", "found => found.forEach(fold => { fold.open = true; })")
    wait_until(view, "document.querySelectorAll('.math[tabindex]').length > 0")
    scrolling = view.eval_on_selector_all(".math", """found => found.map(e =>
        [e.scrollWidth > e.clientWidth, e.getAttribute('tabindex'), e.getAttribute('role'), e.ariaLabel])""")
    assert {row[0] for row in scrolling} == {True, False}
    for wide, *attributes in scrolling:
        assert attributes == (["0", "group", "Formula, wider than the page"] if wide else [None, None, None])


def test_a_heading_of_a_formula_alone_has_a_name(view):
    names = view.eval_on_selector_all("#gains th .hidden", "found => found.map(e => e.textContent)")
    assert names == ["V\u0307", "k\u0302"]


def test_in_print_the_drawn_figures_stand(view):
    view.emulate_media(media="print")
    view.locator("#line .plot svg").wait_for()
    view.locator("#line .chart").wait_for(state="hidden")
    rules = view.evaluate("[...document.styleSheets[0].cssRules].map(rule => rule.cssText)")
    graphs = view.eval_on_selector_all(".premises", """found => found.map(e =>
        [e.getBoundingClientRect().right, e.closest(".scroll").getBoundingClientRect().right, e.style.minWidth])""")
    assert graphs and all(graph <= box and least for graph, box, least in graphs)  # on paper nothing can be scrolled to
    assert any(rule.startswith("@page {") and "margin: 1cm" in rule for rule in rules)  # not up to the paper's edge
    view.emulate_media(media="print", color_scheme="dark")
    assert view.evaluate("getComputedStyle(document.querySelector('h1')).color") == "rgb(27, 29, 33)"  # paper is white
    view.emulate_media(media="screen", color_scheme="light")


def test_what_is_printed_is_findings_and_tables_and_evidence_where_it_is_open(view):
    folded = "found => found.map(fold => [fold.closest('#graph') ? 'graph' : fold.className, fold.open])"
    view.eval_on_selector_all("details", "found => found.forEach(fold => { fold.open = false; })")
    view.eval_on_selector_all(".paper-section", "found => { found[1].open = true; }")
    before = view.eval_on_selector_all("details", folded)
    view.evaluate("dispatchEvent(new Event('beforeprint'))")
    printed = view.eval_on_selector_all("details", folded)
    kinds = ("group", "more", "long")
    assert any(name in kinds for name, _ in printed)
    assert all(is_open == (name in kinds or was == ["paper-section", True])
               for (name, is_open), was in zip(printed, before, strict=True))
    view.evaluate("dispatchEvent(new Event('afterprint'))")
    assert view.eval_on_selector_all("details", folded) == before  # what the reader had folded is folded again


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_is_cut_and_axe_finds_nothing(view, complaints, width, scheme):
    if scheme == "dark" and width != WIDTHS[0]:
        pytest.skip("colours do not depend on the width")
    view.set_viewport_size({"width": width, "height": 900})
    view.emulate_media(color_scheme=scheme)
    view.eval_on_selector_all("details", "found => found.forEach(fold => { fold.open = true; })")
    for figure in view.locator("figure").all():
        figure.scroll_into_view_if_needed()
    wait_until(view, "document.querySelectorAll('figure.drawn .nsewdrag').length > 1")
    # A chart takes its new width a moment after the window has it.
    wait_until(view, f"document.documentElement.scrollWidth <= {width}")
    # Nor does it lie over the text below it.
    wait_until(view, """[...document.querySelectorAll("figure.drawn")].every(found =>
        found.querySelector(".main-svg").getBoundingClientRect().bottom
        <= found.querySelector("figcaption").getBoundingClientRect().top + 1)""")
    view.evaluate(AXE)
    found = view.evaluate("axe.run(document, {resultTypes: ['violations']})")
    assert [(entry["id"], [node["target"] for node in entry["nodes"]][:3]) for entry in found["violations"]] == []
    assert complaints == []


def test_errata_that_are_wider_than_a_telephone_are_reached_by_keys(browser, tmp_path):
    blocks = [Heading(1, "Corrections"), Paragraph(f"Where ${WIDE}$ holds", "Finding"), Formula(WIDE, "Printed:"),
              Items((Item("in each case:"), Item("$a < b$", 1), Item("$b < c$", 1), Item(f"${WIDE}$"))), Code("a")]
    (tmp_path / "errata.html").write_text(html_document(blocks, "Corrections"), encoding="utf-8")
    page = browser.new_page(viewport={"width": WIDTHS[-1], "height": 900})
    said = []
    page.on("console", lambda message: said.append(message.text))
    page.goto((tmp_path / "errata.html").as_uri())
    page.evaluate(AXE)
    found = page.evaluate("axe.run(document, {resultTypes: ['violations']})")
    assert [(entry["id"], entry["nodes"][0]["html"]) for entry in found["violations"]] == []
    assert page.evaluate("document.documentElement.scrollWidth") == WIDTHS[-1] and said == []
    page.close()


AXE = (files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")


def test_axes_have_numbers_to_read_by(view):
    """Less than two powers of ten are drawn on a linear axis, and trials have no halves."""
    axes = """y => { const found = layout({ x: "", log: false, panels: [{ y: "", log: true, curves: [{ x: [1, 2, 3],
        y }] }] }); return [found.yaxis.type, found.xaxis.dtick] }"""
    assert view.evaluate(axes, [3.0, 5.0, 9.0]) == ["linear", 1]
    assert view.evaluate(axes, [0.5, 5.0, 50.0]) == ["log", 1]
