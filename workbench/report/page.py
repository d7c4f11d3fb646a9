"""One self-contained HTML page out of verdicts, runs and a scenario."""

from __future__ import annotations

import base64
import hashlib
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from workbench.metrics import Metrics
from workbench.report import figures, headline, tables
from workbench.report.claims import claim_views, counts
from workbench.report.numbers import length, number
from workbench.report.sources import sourced_values, stated
from workbench.scenario import Scenario, Variant
from workbench.simulate.closed_loop import Run
from workbench.simulate.sweep import SweepRow, summarise

PACKAGES = ("workbench", "numpy", "scipy", "sympy", "numba", "casadi", "matplotlib")

# Shows the filter, which is of no use without scripts, and opens what folds before printing.
SCRIPT = """
const filter = document.getElementById("filter");
const claims = [...document.querySelectorAll("tbody[data-verdict]")];
const say = document.getElementById("shown");
function show(verdict) {
  let count = 0;
  for (const claim of claims) {
    claim.hidden = verdict !== "all" && claim.dataset.verdict !== verdict;
    count += claim.hidden ? 0 : 1;
  }
  for (const button of filter.querySelectorAll("button"))
    button.setAttribute("aria-pressed", String(button.value === verdict));
  say.textContent = count + " of " + claims.length + " claims shown";
}
if (filter) {
  filter.hidden = false;
  filter.addEventListener("click", e => {
    const button = e.target.closest("button");
    if (button) show(button.value);
  });
  // A link to a claim that is filtered away shows all again.
  addEventListener("hashchange", () => {
    const claim = document.getElementById(decodeURIComponent(location.hash.slice(1)))
      || document.getElementById(location.hash.slice(1));
    if (claim && claim.closest("tbody[hidden]")) { show("all"); claim.scrollIntoView(); }
  });
}
addEventListener("beforeprint", () => {
  for (const fold of document.querySelectorAll("details")) fold.open = true;
});
"""


@dataclass(frozen=True)
class ReportContent:
    """All that a page shows; what is empty is left out of it.

    claims: the document of `workbench prove --json`, where each claim may also carry `title`, `note`,
    `recorded`, `stated` and `computed`; runs and metrics: the nominal run of each controller, in the same
    order; sweep: its rows, with sweep_seed; variants: each change with the metrics it gave;
    timings: what was done -> seconds; commands: how to get this page again.
    """

    scenario: Scenario
    claims: Mapping[str, Any] = field(default_factory=dict)
    runs: Sequence[Run] = ()
    metrics: Sequence[Metrics] = ()
    sweep: Sequence[SweepRow] = ()
    sweep_seed: int | None = None
    variants: Sequence[tuple[Variant, Sequence[Metrics]]] = ()
    timings: Mapping[str, float] = field(default_factory=dict)
    commands: Sequence[str] = ()


@dataclass(frozen=True)
class _Figure:
    anchor: str
    svg: Markup
    caption: str


def build_page(content: ReportContent) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside."""
    folder = Path(__file__).parent
    scenario = content.scenario
    names = tables.titles(scenario, content.runs)
    summaries = summarise(content.sweep, scenario)
    claims = claim_views(content.claims)
    sources = sourced_values(scenario)
    lines = [
        headline.proof_line(claims), headline.nominal_line(scenario, content.metrics, names),
        headline.table_line(scenario, summaries, names),
        headline.variants_line(content.metrics, content.variants, names), headline.sources_line(sources),
    ]
    style = (folder / "page.css").read_text(encoding="utf-8")
    environment = Environment(loader=FileSystemLoader(folder), autoescape=True, undefined=StrictUndefined,
                              trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {"number": number, "stated": stated, "breakable": _breakable}
    return environment.get_template("page.html.j2").render(
        content=content, scenario=scenario, names=names, claims=claims, counts=counts(claims),
        headline=[line for line in lines if line], figures=_figures(content, names),
        spread=_spread(content, names), nominal=tables.nominal_table(content.metrics),
        information=[tables.information(scenario, m.controller) for m in content.metrics],
        compared=tables.compared_table(scenario, summaries, names) if summaries else [],
        runs_each=max((s.runs for s in summaries), default=0),
        single=tables.printed_values_table(scenario, content.metrics, names),
        variants=tables.variants_table(content.metrics, content.variants) if content.variants else [],
        failures=[(variant.title, m.controller, m.failed)
                  for variant, found in content.variants for m in found if m.failed is not None],
        sources={kind: [s for s in sources if s.kind == kind] for kind in ("assumed", "paper", "convention")},
        versions=_versions(), style=Markup(style), script=Markup(SCRIPT), script_hash=_hash(SCRIPT),
    )


def _figures(content: ReportContent, names: Mapping[str, str]) -> list[_Figure]:
    scenario, runs = content.scenario, content.runs
    whole = next((run for run in runs if run.failed is None), None)
    shown = [_Figure("line", Markup(figures.line_profile(scenario)),
                     f"The line ({scenario.track.name}) and the desired speed over it. Grade in ‰ and "
                     f"resistance in N/kN have the same number.")]
    if whole:
        shown.append(_Figure("tracking", Markup(figures.tracking(whole)),
                             f"Speed and position under {names[whole.controller]}, over the desired ones."))
    if runs:
        bounds = sorted({run_k for run in runs
                         if (run_k := scenario.controllers[run.controller].parameters.get("k")) is not None})
        barrier = f" and the barrier k = {' or '.join(map(length, bounds))} (dotted)" if bounds else ""
        band = f"The band of ±{length(scenario.simulation.position_band_m)} (dashed){barrier}"
        own = "Each panel has its own scale; measured minus desired."
        shown += [
            _Figure("position-errors", Markup(figures.errors(scenario, runs, "position")),
                    f"Position errors. {own} {band} stand where they lie within the scale."),
            _Figure("speed-errors", Markup(figures.errors(scenario, runs, "speed")), f"Speed errors. {own}"),
            _Figure("commands", Markup(figures.errors(scenario, runs, "command")),
                    "Command u = F/m as the controller gives it, before the limits of the train."),
        ]
    return shown


def _spread(content: ReportContent, names: Mapping[str, str]) -> _Figure | None:
    if not content.sweep:
        return None
    return _Figure("spread", Markup(figures.spread(content.scenario, content.sweep, dict(names))),
                   "Each dot is a run with its own drawn train and line, the same ones for every controller. "
                   "Logarithmic axes.")


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


def _hash(script: str) -> str:
    """The hash by which the page allows this script and no other."""
    return "sha256-" + base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
