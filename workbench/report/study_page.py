"""A study's findings, tables, curves, claims and sources on one self-contained page."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from markupsafe import Markup

from workbench.files.own_files import read_manifest, replace_files, sha256
from workbench.paper.results import Plot, StudyResult
from workbench.paper.study import Study
from workbench.report import headline
from workbench.report.claims import claim_views
from workbench.report.sources import sourced_values
from workbench.report.study_figures import study_plot
from workbench.report.table_view import caption, gains_view, table_views
from workbench.report.template import PageFigure, render

CURVES, CURVES_FILE = "curves", re.compile(r"[0-9]{2,3}-[a-z0-9-]*\.csv")
ANOTHER_OUT = "name another folder by --out"


@dataclass(frozen=True)
class StudyContent:
    """All that a study's page shows; claims: the document of `workbench prove --json`, empty without a proof;
    gains: what `workbench gains` finds; draws: on how many drawn trains, where they are fewer than stated."""

    study: Study
    result: StudyResult
    claims: Mapping[str, Any] = field(default_factory=dict)
    timings: Mapping[str, float] = field(default_factory=dict)
    commands: Sequence[str] = ()
    gains: StudyResult | None = None
    draws: str = ""


def build_study_page(content: StudyContent) -> str:
    """The page as HTML: styles, figures and formulas within it, no reference to anything outside."""
    study, result = content.study, content.result
    sources = sourced_values(study)
    lines = [headline.proof_line(claim_views(content.claims)), *result.findings, headline.sources_line(sources)]
    return render(
        "study.html.j2", content.claims, sources, subject=study, headline=[line for line in lines if line],
        settings={"study": study.name} | ({"drawn trains": content.draws} if content.draws else {}),
        commands=content.commands, timings=content.timings,
        tables=table_views(result.tables), gains=gains_view(content.gains),
        figures=[_figure(number, plot) for number, plot in enumerate(result.plots, start=1)],
        failures=result.failures)


def write_curves(plots: Sequence[Plot], out: Path) -> None:
    """One CSV a plot in the folder `curves` of a report: curve, x, y, every point as it was computed; with a manifest,
    by which those of an earlier report are known and taken away.

    Raises InputError where they cannot be written.
    """
    folder = out / CURVES
    files = {f"{number:02d}-{re.sub(r'[^a-z0-9]+', '-', plot.title.lower()).strip('-')[:60]}.csv": _curves_text(plot)
             for number, plot in enumerate(plots, start=1)}
    found = (read_manifest(folder, ANOTHER_OUT) or {}).get("curves")
    before = {name: digest for name, digest in (found if isinstance(found, dict) else {}).items()
              if CURVES_FILE.fullmatch(name) and isinstance(digest, str)}
    manifest = {"version": 1, "curves": {name: sha256(text) for name, text in files.items()}}
    replace_files(folder, out, json.dumps(manifest, indent=1) + "\n", files, before,
                  {name: digest for name, digest in before.items() if name not in files},
                  lambda name, data: data.startswith(b"curve,"), ANOTHER_OUT)


def _curves_text(plot: Plot) -> str:
    text = io.StringIO(newline="")
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(("curve", plot.x_label, plot.y_label))
    for curve in plot.curves:
        rows.writerows((curve.label, f"{x:.10g}", f"{y:.10g}") for x, y in zip(curve.x, curve.y, strict=True))
    return text.getvalue()


def _figure(number: int, plot: Plot) -> PageFigure:
    name = f"figure-{number}"
    return PageFigure(name, Markup(study_plot(plot, name)), caption(plot.title, plot.source, plot.note))
