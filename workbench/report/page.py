"""One self-contained HTML page out of verdicts, runs and a scenario."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from workbench.files.numbers import length
from workbench.paper.results import StudyResult
from workbench.report import figures, headline, tables
from workbench.report.charts.chart import Chart
from workbench.report.charts.files import csv_files
from workbench.report.charts.scenario import errors_chart, line_chart, spread_chart, tracking_chart
from workbench.report.claims import claim_views
from workbench.report.sources import sourced_values
from workbench.report.table_view import gains_view
from workbench.report.template import PageFigure, page_figure, render
from workbench.report.winners import winners
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
    timings: what was done -> seconds; commands: how to get this page again; gains: what `workbench gains` finds;
    shortened: what there is less of than on a full page, and how much of it.
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
    shortened: Mapping[str, str] = field(default_factory=dict)


def build_page(content: ReportContent) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside."""
    scenario = content.scenario
    names = tables.titles(scenario, content.runs)
    summaries = summarise(content.sweep, scenario)
    claims = claim_views(content.claims)
    sources = sourced_values(scenario)
    shown = _figures(content, names)
    first, every = shown.pop("position-errors", None), headline.CHANGES not in content.shortened
    lines = [
        headline.proof_line(claims), headline.nominal_line(scenario, content.metrics, names),
        headline.table_line(scenario, summaries, names, content.sweep),
        headline.variants_line(content.metrics, content.variants, names, every),
        headline.sources_line(sources), headline.shortened_line(content.shortened),
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
        figures=[figure for anchor, figure in shown.items() if anchor != "spread"], spread=shown.get("spread"),
        standings=(), standings_tables=(), standings_folded=False, sentences=(), first_figure=first,
        first_figure_first=False,
        winners=winners(scenario, content.metrics, content.variants, content.sweep, names, every),
        nominal=tables.nominal_table(content.metrics),
        information=[tables.information(scenario, m.controller) for m in content.metrics],
        compared=compared, runs_each=runs_each, solved=tables.compiled_words(scenario, names),
        single=tables.printed_values_table(scenario, content.metrics, names),
        variants=tables.variants_table(content.metrics, content.variants) if content.variants else [],
        fewer_variants=content.shortened.get(headline.CHANGES, ""),
        failures=[(variant.title, m.controller, m.failed)
                  for variant, found in content.variants for m in found if m.failed is not None],
    )


def scenario_charts(content: ReportContent) -> dict[str, Chart]:
    """The charts of the page by the anchors of their figures, in their order."""
    scenario, runs = content.scenario, content.runs
    names = tables.titles(scenario, runs)
    shown = {"line": line_chart(scenario)}
    whole = _whole(content)
    if whole:
        shown["tracking"] = tracking_chart(whole)
    if runs:
        shown |= {"position-errors": errors_chart(runs, "position"), "speed-errors": errors_chart(runs, "speed"),
                  "commands": errors_chart(runs, "command")}
    if content.sweep:
        shown["spread"] = spread_chart(content.sweep, names)
    return shown


def _figures(content: ReportContent, names: Mapping[str, str]) -> dict[str, PageFigure]:
    """The figures of the page by their anchors: drawn, said, and as charts with their files."""
    scenario, runs = content.scenario, content.runs
    drawn = {"line": (figures.line_profile(scenario),
                      f"The line ({scenario.track.name}) and the desired speed over it. Grade in ‰ and "
                      f"resistance in N/kN have the same number.")}
    whole = _whole(content)
    if whole:
        drawn["tracking"] = (figures.tracking(whole),
                             f"Speed and position under {names[whole.controller]}, over the desired ones.")
    if runs:
        bounds = sorted({run_k for run in runs
                         if (run_k := scenario.controllers[run.controller].parameters.get("k")) is not None})
        barrier = f" and the barrier k = {' or '.join(map(length, bounds))} (dotted)" if bounds else ""
        band = f"The band of ±{length(scenario.simulation.position_band_m)} (dashed){barrier}"
        own = "Each panel has its own scale; measured minus desired."
        drawn["position-errors"] = (figures.errors(scenario, runs, "position"),
                                    f"Position errors. {own} {band} stand in print where they lie within the scale.")
        drawn["speed-errors"] = (figures.errors(scenario, runs, "speed"), f"Speed errors. {own}")
        drawn["commands"] = (figures.errors(scenario, runs, "command"),
                             "Command u = F/m as the controller gives it, before the limits of the train.")
    if content.sweep:
        drawn["spread"] = (figures.spread(scenario, content.sweep, dict(names)),
                           "The runs with their own drawn train and line, the same ones for every controller: how many "
                           "of them stay at or below a value. In print each dot is a run.")
    charts = scenario_charts(content)
    files = dict(zip(charts, csv_files(list(charts.values())), strict=True))
    return {anchor: page_figure(anchor, svg, text, charts[anchor], files[anchor])
            for anchor, (svg, text) in drawn.items()}


def _whole(content: ReportContent) -> Run | None:
    return next((run for run in content.runs if run.failed is None), None)
