"""A study's findings, tables, curves, claims and sources on one self-contained page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from workbench.paper.results import Plot, StudyResult
from workbench.paper.study import Study
from workbench.report import headline
from workbench.report.charts.chart import chart_of
from workbench.report.charts.files import csv_files
from workbench.report.claims import claim_views
from workbench.report.sources import sourced_values
from workbench.report.standings import parted, standings
from workbench.report.study_figures import study_plot
from workbench.report.table_view import caption, gains_view, table_views
from workbench.report.template import PageFigure, page_figure, render

WHO_WINS = "Who wins, and at what price"


@dataclass(frozen=True)
class StudyContent:
    """All that a study's page shows; claims: the document of `workbench prove --json`, empty without a proof;
    gains: what `workbench gains` finds; shortened: what there is less of than on a full page, and how much of it."""

    study: Study
    result: StudyResult
    claims: Mapping[str, Any] = field(default_factory=dict)
    timings: Mapping[str, float] = field(default_factory=dict)
    commands: Sequence[str] = ()
    gains: StudyResult | None = None
    shortened: Mapping[str, str] = field(default_factory=dict)


def build_study_page(content: StudyContent) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside."""
    study, result = content.study, content.result
    sources = sourced_values(study)
    lines = [headline.proof_line(claim_views(content.claims)), headline.sources_line(sources),
             headline.shortened_line(content.shortened)]
    figures = _figures(result.plots)
    first = None if result.first_plot is None else figures.pop(result.first_plot)
    return render(
        "study.html.j2", content.claims, sources, subject=study, headline=[line for line in lines if line],
        sentences=result.findings,
        settings={"study": study.name} | {
            what: f"{some}; all with --full" for what, some in content.shortened.items()},
        commands=content.commands, timings=content.timings,
        tables=table_views(result.tables), gains=gains_view(content.gains),
        figures=figures, first_figure=first, first_figure_first=bool(result.standings), failures=result.failures,
        standings=[parted(sentence) for sentence in result.standings or standings(result.winners)],
        standings_title=result.winners.title if result.winners and not result.standings else WHO_WINS,
        standings_folded=bool(result.standings and result.winners),
        standings_tables=table_views([result.winners] if result.winners else [], "winners"), winners=None)


def _figures(plots: Sequence[Plot]) -> list[PageFigure]:
    charts = list(map(chart_of, plots))
    return [page_figure(f"figure-{number}", study_plot(plot, f"figure-{number}"),
                        caption(plot.title, plot.source, plot.note), chart, file)
            for number, (plot, chart, file) in enumerate(zip(plots, charts, csv_files(charts), strict=True), start=1)]
