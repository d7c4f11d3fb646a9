"""The main job: a paper's scenario or study and its proof files in, a folder with its report and data out."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.gains.registry import PAPERS
from workbench.json_output import write_json
from workbench.proof.document import claims_document, write_certificates
from workbench.proof.prove import prove
from workbench.proof.selection import Target, targets
from workbench.report.gains import gains_document, gains_result
from workbench.report.page import ReportContent, build_page
from workbench.report.study_page import StudyContent, build_study_page, write_curves
from workbench.scenario import load_scenario
from workbench.simulate.compare import Comparison, compare
from workbench.simulate.sweep import SweepSummary, summarise, sweep
from workbench.studies.base import Study, StudyResult
from workbench.studies.gain_effects import checked_gains, effects
from workbench.studies.registry import load_study, study_kind
from workbench.toml_input import read_toml
from workbench.workers import cores

# (what is being done, done, total); total 0 while it is not known
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Report:
    """What a scenario's report was made of, and where its page is."""

    page: Path
    claims: dict[str, Any]
    comparison: Comparison
    summaries: list[SweepSummary]
    timings: dict[str, float]


@dataclass(frozen=True)
class StudyReport:
    """What a study's report was made of, and where its page is."""

    page: Path
    claims: dict[str, Any]
    study: Study
    result: StudyResult
    timings: dict[str, float]


def build_report(scenario_path: Path, proof_paths: list[Path], out: Path, runs: int | None = None,
                 seed: int | None = None, workers: int | None = None,
                 on_progress: Progress = lambda what, done, total: None, with_gains: bool = False,
                 resume: bool = False) -> Report:
    """Decide the claims, run and compare the controllers, and write report.html, claims.json, compare.json,
    the certificates and the Monte Carlo table into `out`; `resume` goes on with the Monte Carlo kept there.

    Raises InputError for input that cannot be used, before anything is computed.
    """
    scenario = load_scenario(scenario_path)
    asked = targets(proof_paths) if proof_paths else []
    _require_folder(out)
    timings: dict[str, float] = {}
    claims = _decide(asked, out, workers, on_progress, timings)
    with _timed(timings, "runs and variants"):
        comparison = compare(scenario_path, workers=workers,
                             on_progress=lambda done, total, _: on_progress("runs and variants", done, total))
        write_json(out / "compare.json", comparison_document(comparison))
    runs = scenario.uncertainty.runs if runs is None else runs
    seed = scenario.uncertainty.seed if seed is None else seed
    with _timed(timings, "Monte Carlo"):
        rows = sweep(scenario_path, runs, seed, out=out / "monte_carlo", resume=resume, workers=workers,
                     on_progress=lambda done, total, _: on_progress("Monte Carlo", done, total))
    found = _gains(scenario_path, asked, out, workers, on_progress, timings) if with_gains else None
    command = f"workbench report {scenario_path} {' '.join(map(str, proof_paths))} --out {out} --runs {runs}"
    content = ReportContent(
        scenario=scenario, claims=claims, runs=comparison.runs, metrics=comparison.metrics, sweep=rows,
        sweep_seed=seed, variants=comparison.variants, timings=timings, commands=(command,),
        gains=found)
    page = out / "report.html"
    with _timed(timings, "page"):
        page.write_text(build_page(content), encoding="utf-8")
    return Report(page, claims, comparison, summarise(rows, scenario), timings)


def build_study_report(study_path: Path, proof_paths: list[Path], out: Path, workers: int | None = None,
                       on_progress: Progress = lambda what, done, total: None,
                       with_gains: bool = False, resume: bool = False) -> StudyReport:
    """Decide the claims, run the study, and write report.html, claims.json, compare.json, the certificates and
    the curves of every figure into `out`; with `resume` the runs that `run_study` has kept there are not run again.

    Raises InputError for input that cannot be used, before anything is computed.
    """
    study = load_study(study_path)
    asked = targets(proof_paths) if proof_paths else []
    _require_folder(out)
    timings: dict[str, float] = {}
    claims = _decide(asked, out, workers, on_progress, timings)
    with _timed(timings, "runs"):
        result = run_study(study, workers, on_progress, out, resume)
        write_json(out / "compare.json", study_document(study, result))
    write_curves(result.plots, out / "curves")
    found = _gains(study_path, asked, out, workers, on_progress, timings) if with_gains else None
    command = f"workbench report {study_path} {' '.join(map(str, proof_paths))} --out {out}"
    page = out / "report.html"
    with _timed(timings, "page"):
        text = build_study_page(StudyContent(study, result, claims, timings, (command,), found))
        page.write_text(text, encoding="utf-8")
    return StudyReport(page, claims, study, result, timings)


def run_study(study: Study, workers: int | None = None, on_progress: Progress = lambda what, done, total: None,
              kept: Path | None = None, resume: bool = False) -> StudyResult:
    """All runs of a study, in `workers` processes or one a core.

    kept: a folder for what is finished, from which `resume` goes on; of no effect for a study whose runs are few.
    Raises InputError for a folder that another study has used, or that cannot be written.
    """
    kind = study_kind(study.paper)

    def told(done: int, total: int, _: str) -> None:
        on_progress("runs", done, total)

    if kept is not None and kind.run_kept is not None:
        return kind.run_kept(study, workers or cores(), told, kept, resume)
    return kind.run(study, workers or cores(), told)


def study_document(study: Study, result: StudyResult) -> dict[str, Any]:
    """The document of `workbench compare --json` of a study."""
    tables = [{"title": t.title, "source": t.source, "note": t.note, "header": list(t.header),
               "rows": [list(row) for row in t.rows]} for t in result.tables]
    failures = [{"run": run, "why": why} for run, why in result.failures]
    return {"version": 1, "scenario": study.name, "rows": list(result.rows), "tables": tables,
            "findings": list(result.findings), "failures": failures}


def comparison_document(comparison: Comparison) -> dict[str, Any]:
    """The document of `workbench compare --json`."""
    return {"version": 1, "scenario": comparison.scenario.name, "rows": [m.row() for m in comparison.metrics],
            "variants": [{"title": variant.title, "set": variant.set, "rows": [m.row() for m in metrics]}
                         for variant, metrics in comparison.variants]}


def _decide(asked: list[Target], out: Path, workers: int | None, on_progress: Progress,
            timings: dict[str, float]) -> dict[str, Any]:
    """The document of the claims that are asked for; empty when none is."""
    if not asked:
        return {}
    with _timed(timings, "proof"):
        decisions = prove(asked, workers, on_progress=lambda *step: on_progress("claims", *step)).decisions
        write_certificates(decisions, out / "certificates")
        claims = claims_document(decisions, out / "certificates")
        write_json(out / "claims.json", claims)
    return claims


def _gains(path: Path, asked: list[Target], out: Path, workers: int | None, on_progress: Progress,
           timings: dict[str, float]) -> StudyResult | None:
    """What is known of the paper's gains, and gains.json in `out`; none for a file of which no gains are known."""
    if not asked or str(read_toml(path).get("paper")) not in PAPERS:
        return None
    with _timed(timings, "gains"):
        report = checked_gains(path, asked[0].path.parent)
        done = effects(path, report, workers, lambda at, total, _: on_progress("runs of gains", at, total))
        write_json(out / "gains.json", gains_document(report, done))
    return gains_result(report, done)


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
