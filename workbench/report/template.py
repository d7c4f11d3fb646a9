"""A page's frame: the template with its style, its only script, and what every page says about its making."""

from __future__ import annotations

import base64
import hashlib
import platform
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from workbench.files.numbers import counted, number, typeset
from workbench.files.regular import contents
from workbench.paper.mpc_comparison import counter_name
from workbench.proof.verdict import in_number
from workbench.report.charts.chart import Chart, chart_json
from workbench.report.charts.files import CURVES
from workbench.report.claims import ClaimView, by_section, charged, claim_views, counts, fated, in_words
from workbench.report.findings_view import fated_findings, finding_groups
from workbench.report.graph.view import graph_views
from workbench.report.math_font import math_font
from workbench.report.plain_formulas import plain_words
from workbench.report.sources import SourcedValue, stated
from workbench.report.svg import PALETTE
from workbench.report.typography import set_command

PACKAGES = ("workbench", "numpy", "scipy", "sympy", "numba", "casadi", "matplotlib")

@dataclass(frozen=True)
class PageFigure:
    """A figure to stand in a page: its anchor, its SVG element, its caption; its chart as JSON and the CSV file behind
    it, by its path from the page."""

    anchor: str
    svg: Markup
    caption: str
    chart: Markup
    csv: str

    @property
    def name(self) -> str:
        """What its caption calls it, for what reads pages aloud."""
        return plain_words(self.caption.partition(". ")[0].removesuffix("."))


def page_figure(anchor: str, svg: str, caption: str, chart: Chart, file: str) -> PageFigure:
    """A figure with its chart, of which `file` is the name of its CSV file."""
    return PageFigure(anchor, Markup(svg), caption, Markup(chart_json(chart)), f"{CURVES}/{file}")


def render(template: str, document: Mapping[str, Any], sources: Sequence[SourcedValue], **values: Any) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside.

    document: the claims as `workbench prove --json` writes them; values: what else the template shows, among it
    `subject` (what the page is about), `headline`, `settings`, `commands` and `timings`.
    """
    folder = Path(__file__).parent
    claims = claim_views(document)
    scripts = _scripts(folder, bool(values.get("figures") or values.get("first_figure")))
    environment = Environment(loader=FileSystemLoader(folder), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {"number": number, "stated": stated, "typeset": typeset, "breakable": _breakable,
                            "in_words": in_words, "in_number": in_number,
                            "as_heading": _as_heading, "counted": counted, "counter_name": counter_name,
                            "set_command": set_command}
    printed = [claim for claim in claims if not claim.ours] or claims
    return environment.get_template(template).render(
        claims=claims, counts=counts(charged(printed)), findings=finding_groups(document), sections=by_section(claims),
        fated=fated(claims), fated_findings=fated_findings(document), graphs=graph_views(claims),
        choices=[(name, label, found) for name, label in CHOICES if len(found := _values(claims, name)) > 1],
        sources={kind: [s for s in sources if s.kind == kind] for kind in ("assumed", "paper", "convention")},
        versions=_versions(), style=Markup(_style(folder)), scripts=[Markup(script) for script in scripts],
        script_hashes=" ".join(f"'{_hash(script)}'" for script in scripts), **values)


def _style(folder: Path) -> str:
    """The page's style, with the colours of its curves and the font of its formulas."""
    series = " ".join(f"--series-{i}: {colour};" for i, colour in enumerate(PALETTE))
    return f"{math_font()}:root {{ {series} }}\n{contents(folder / 'page.css').decode()}"


def _scripts(folder: Path, charts: bool) -> list[str]:
    """The page's scripts; Plotly, of some megabytes, only where it has something to draw."""
    own = contents(folder / "page.js").decode()
    if not charts:
        return [own]
    library = contents(Path(str(files("plotly") / "package_data" / "plotly.min.js"))).decode()
    # An HTML parser ends a script at these letters, whatever they mean to the script.
    return [own, library.replace("</script", "<\\/script"), contents(folder / "charts" / "charts.js").decode()]


CHOICES = (("verdict", "Verdict"), ("severity", "Severity"), ("origin", "Origin"), ("section", "Section"))


def _values(claims: Sequence[ClaimView], name: str) -> list[tuple[str, int]]:
    """The values that a field of claims has, and how many claims have each."""
    return [(value, n) for value, n in Counter(getattr(claim, name) for claim in claims).items() if value]


def _versions() -> dict[str, str]:
    found = {"Python": platform.python_version(), "system": f"{platform.system()} {platform.machine()}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed as a package"
    return found


def _breakable(text: str) -> Markup:
    """A dotted key that may be broken after its dots."""
    return Markup(".<wbr>").join(text.split("."))


def _as_heading(text: str, letters: bool = True) -> Markup:
    """A heading in words; of one that is a formula alone its text as well, for what reads pages aloud."""
    shown = in_words(text, letters)
    if not (shown.startswith("<math") and shown.endswith("</math>")):
        return shown
    return Markup('<span aria-hidden="true">{}</span><span class="hidden">{}</span>').format(shown, plain_words(text))


def _hash(script: str) -> str:
    """The hash by which the page allows this script and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
