"""One self-contained HTML page out of verdicts, runs and a scenario."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from markupsafe import Markup

from workbench.files.numbers import length
from workbench.paper.results import StudyResult
from workbench.report import figures, headline, tables
from workbench.report.claims import claim_views
from workbench.report.sources import sourced_values
from workbench.report.table_view import gains_view
from workbench.report.template import PageFigure, render
from workbench.simulate.closed_loop import Run
from workbench.simulate.metrics import Metrics
from workbench.simulate.sweep import summarise
from workbench.simulate.sweep_rows import SweepRow
from workbench.trains.scenario import Scenario, Variant


@dataclass(frozen=True)
class ReportContent:
    """All that a page shows; what is empty is left out of it.

    claims: the document of `workbench prove --json`, where each claim may also carry `title`, `note`,
    `recorded`, `stated` and `computed`; runs and metrics: the nominal run of each controller, in the same
    order; sweep: its rows, with sweep_seed; variants: each change with the metrics it gave;
    timings: what was done -> seconds; commands: how to get this page again; gains: what `workbench gains` finds.
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
    gains: StudyResult | None = None


def build_page(content: ReportContent) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside."""
    scenario = content.scenario
    names = tables.titles(scenario, content.runs)
    summaries = summarise(content.sweep, scenario)
    claims = claim_views(content.claims)
    sources = sourced_values(scenario)
    lines = [
        headline.proof_line(claims), headline.nominal_line(scenario, content.metrics, names),
        headline.table_line(scenario, summaries, names, content.sweep),
        headline.variants_line(content.metrics, content.variants, names), headline.sources_line(sources),
    ]
    compared = tables.compared_table(scenario, summaries, names) if summaries else []
    runs_each = max((s.runs for s in summaries), default=0)
    seed = "not told" if content.sweep_seed is None else content.sweep_seed
    return render(
        "page.html.j2", content.claims, sources, subject=scenario, headline=[line for line in lines if line],
        settings={"scenario": scenario.name}
        | ({"Monte Carlo runs a controller": runs_each, "seed": seed} if compared else {}),
        commands=content.commands, timings=content.timings, gains=gains_view(content.gains),
        content=content, scenario=scenario, names=names,
        figures=_figures(content, names), spread=_spread(content, names),
        nominal=tables.nominal_table(content.metrics),
        information=[tables.information(scenario, m.controller) for m in content.metrics],
        compared=compared, runs_each=runs_each, single=tables.printed_values_table(scenario, content.metrics, names),
        variants=tables.variants_table(content.metrics, content.variants) if content.variants else [],
        failures=[(variant.title, m.controller, m.failed)
                  for variant, found in content.variants for m in found if m.failed is not None],
    )


def _figures(content: ReportContent, names: Mapping[str, str]) -> list[PageFigure]:
    scenario, runs = content.scenario, content.runs
    whole = next((run for run in runs if run.failed is None), None)
    shown = [PageFigure("line", Markup(figures.line_profile(scenario)),
                     f"The line ({scenario.track.name}) and the desired speed over it. Grade in ‰ and "
                     f"resistance in N/kN have the same number.")]
    if whole:
        shown.append(PageFigure("tracking", Markup(figures.tracking(whole)),
                             f"Speed and position under {names[whole.controller]}, over the desired ones."))
    if runs:
        bounds = sorted({run_k for run in runs
                         if (run_k := scenario.controllers[run.controller].parameters.get("k")) is not None})
        barrier = f" and the barrier k = {' or '.join(map(length, bounds))} (dotted)" if bounds else ""
        band = f"The band of ±{length(scenario.simulation.position_band_m)} (dashed){barrier}"
        own = "Each panel has its own scale; measured minus desired."
        shown += [
            PageFigure("position-errors", Markup(figures.errors(scenario, runs, "position")),
                    f"Position errors. {own} {band} stand where they lie within the scale."),
            PageFigure("speed-errors", Markup(figures.errors(scenario, runs, "speed")), f"Speed errors. {own}"),
            PageFigure("commands", Markup(figures.errors(scenario, runs, "command")),
                    "Command u = F/m as the controller gives it, before the limits of the train."),
        ]
    return shown


def _spread(content: ReportContent, names: Mapping[str, str]) -> PageFigure | None:
    if not content.sweep:
        return None
    return PageFigure("spread", Markup(figures.spread(content.scenario, content.sweep, dict(names))),
                   "Each dot is a run with its own drawn train and line, the same ones for every controller. "
                   "Logarithmic axes.")
