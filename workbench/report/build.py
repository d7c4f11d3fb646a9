"""The main job: a paper's scenario and proof files in, a folder with its report and data out."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.proof.decide.engine import decide_all
from workbench.proof.document import claims_document, write_certificates
from workbench.proof.paper import collect_papers
from workbench.report.page import ReportContent, build_page
from workbench.scenario import load_scenario
from workbench.simulate.compare import Comparison, compare
from workbench.simulate.sweep import SweepSummary, summarise, sweep

# (what is being done, done, total); total 0 while it is not known
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Report:
    """What a report was made of, and where its page is."""

    page: Path
    claims: dict[str, Any]
    comparison: Comparison
    summaries: list[SweepSummary]
    timings: dict[str, float]


def build_report(scenario_path: Path, proof_paths: list[Path], out: Path, runs: int | None = None,
                 seed: int | None = None, workers: int | None = None,
                 on_progress: Progress = lambda what, done, total: None) -> Report:
    """Decide the claims, run and compare the controllers, and write report.html, claims.json, compare.json,
    the certificates and the Monte Carlo table into `out`.

    Raises InputError for input that cannot be used, before anything is computed.
    """
    scenario = load_scenario(scenario_path)
    papers = collect_papers(proof_paths) if proof_paths else []
    _require_folder(out)
    timings: dict[str, float] = {}
    claims: dict[str, Any] = {}
    if papers:
        with _timed(timings, "proof"):
            every = [claim for paper in papers for claim in paper.claims]
            decisions = decide_all(every, lambda done: on_progress("claims", done, len(every)))
            write_certificates(decisions, out / "certificates")
            claims = claims_document(decisions, out / "certificates")
            write_json(out / "claims.json", claims)
    with _timed(timings, "runs and variants"):
        comparison = compare(scenario_path, workers=workers,
                             on_progress=lambda done, total, _: on_progress("runs and variants", done, total))
        write_json(out / "compare.json", comparison_document(comparison))
    runs = scenario.uncertainty.runs if runs is None else runs
    seed = scenario.uncertainty.seed if seed is None else seed
    with _timed(timings, "Monte Carlo"):
        rows = sweep(scenario_path, runs, seed, out=out / "monte_carlo", workers=workers,
                     on_progress=lambda done, total, _: on_progress("Monte Carlo", done, total))
    command = f"workbench report {scenario_path} {' '.join(map(str, proof_paths))} --out {out} --runs {runs}"
    content = ReportContent(
        scenario=scenario, claims=claims, runs=comparison.runs, metrics=comparison.metrics, sweep=rows,
        sweep_seed=seed, variants=comparison.variants, timings=timings, commands=(command,))
    page = out / "report.html"
    with _timed(timings, "page"):
        page.write_text(build_page(content), encoding="utf-8")
    return Report(page, claims, comparison, summarise(rows, scenario), timings)


def comparison_document(comparison: Comparison) -> dict[str, Any]:
    """The document of `workbench compare --json`."""
    return {"version": 1, "scenario": comparison.scenario.name, "rows": [m.row() for m in comparison.metrics],
            "variants": [{"title": variant.title, "set": variant.set, "rows": [m.row() for m in metrics]}
                         for variant, metrics in comparison.variants]}


def write_json(path: Path, document: dict[str, Any]) -> None:
    """Write a document as JSON; NaN is refused."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")


def _require_folder(out: Path) -> None:
    try:
        out.mkdir(parents=True, exist_ok=True)
        probe = out / ".writable"
        probe.touch()
        probe.unlink()
    except OSError as trouble:
        raise InputError(out, "--out", f"cannot be written ({trouble.strerror}): name another folder") from None


@contextmanager
def _timed(timings: dict[str, float], what: str) -> Iterator[None]:
    started = time.perf_counter()
    yield
    timings[what] = time.perf_counter() - started
