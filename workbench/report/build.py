"""The main job: a paper in, a folder with its report and data out."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES, is_paper
from workbench.files.json_output import write_json
from workbench.files.outputs import check_outputs
from workbench.files.own_files import read_manifest
from workbench.files.regular import contents
from workbench.files.writing import make_folder, require_inside, write_text
from workbench.gains.result import GainReport
from workbench.paper.gain_effects import NONE_YET, effects, gains_of, left_out
from workbench.paper.gain_search import Runs, gain_search_of
from workbench.paper.loading import CONTEST, Loaded
from workbench.paper.recorded_front import searched_or_recorded, shown_fronts
from workbench.paper.reproduced import ReproducedStudy
from workbench.paper.results import StudyResult
from workbench.paper.study import Study
from workbench.paper.tuning_record import Pairs
from workbench.proof import checker
from workbench.proof.document import Places, claims_document, write_certificates
from workbench.proof.prove import prove
from workbench.proof.selection import Target, targets
from workbench.report.charts.chart import chart_of
from workbench.report.charts.files import ANOTHER_OUT, CURVES, write_curves
from workbench.report.finding import findings
from workbench.report.finding_sentences import findings_document
from workbench.report.gains import gains_document, gains_result
from workbench.report.headline import CHANGES
from workbench.report.letters import with_letters
from workbench.report.page import ReportContent, build_page, scenario_charts
from workbench.report.runs import Progress, comparison_document, run_study, study_document
from workbench.report.study_page import StudyContent, build_study_page
from workbench.simulate.compare import Comparison, checked_variants, compare
from workbench.simulate.sweep import summarise, sweep
from workbench.simulate.sweep_rows import SweepSummary

MONTE_CARLO, CHECKER = "monte_carlo", "checker.py"
# What a report writes in its folder, certificates and curves apart, which their manifests name.
FILES = ("report.html", "claims.json", CHECKER, "compare.json", "gains.json", f"{MONTE_CARLO}/sweep.csv",
         f"{MONTE_CARLO}/sweep.journal.jsonl", "matches.journal.jsonl", "pareto.journal.jsonl")
# So many drawn trains a report takes at the most, unless it is to be full.
QUICK_DRAWS = 8


@dataclass(frozen=True)
class Asked:
    """A report that is asked for, with everything it needs checked; gains: what was found of the paper's gains.

    full: with what the file marks `only_full` and on all drawn trains that it states, else without and on the first
    QUICK_DRAWS of them.
    """

    loaded: Loaded
    proofs: tuple[Target, ...]
    out: Path
    gains: GainReport | None
    resume: bool
    workers: int | None
    command: str
    full: bool = True

    @classmethod
    def of(cls, loaded: Loaded, proofs: Sequence[str], out: Path, with_gains: bool = False, resume: bool = False,
           workers: int | None = None, full: bool = True) -> Asked:
        """Check before anything runs: claims and gains can be had, variants fit, the folder can be written.

        proofs: papers whose claims are on the page; without any the paper's own. Raises InputError.
        """
        _check_folder(loaded, out)
        asked = tuple(targets(list(proofs))) if proofs else tuple(_own(loaded))
        if loaded.kind is None:
            checked_variants(loaded.path, loaded.data, loaded.scenario, True)
        make_folder(out, out, ANOTHER_OUT)
        # A contest drives another file's scenario, which is where gains are stated.
        searched = with_gains and loaded.data.get("kind") != CONTEST and gain_search_of(loaded) is not None
        gains = gains_of(loaded) if searched else None
        named = [str(loaded.path), *proofs]
        command = f"workbench report {' '.join(named)} --out {out}{' --full' if full else ''}"
        return cls(loaded, asked, out, gains, resume, workers, command, full)

    def draws(self, stated: int) -> int:
        """How many trains are drawn where the file states so many."""
        return stated if self.full else min(stated, QUICK_DRAWS)


def _own(loaded: Loaded) -> list[Target]:
    """The claims of the paper in whose folder the file lies; none for another file."""
    return targets([loaded.folder], none_is_fine=True) if is_paper(loaded.folder) else []


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


def build_report(asked: Asked, runs: int | None = None, seed: int | None = None,
                 on_progress: Progress = lambda what, done, total: None) -> Report:
    """Decide the claims, run and compare the controllers, and write report.html, claims.json, compare.json,
    the certificates, their checker and the Monte Carlo table; with `resume` the Monte Carlo kept there goes on."""
    loaded, scenario, out, workers = asked.loaded, asked.loaded.scenario, asked.out, asked.workers
    timings: dict[str, float] = {}
    claims = _decide(asked, on_progress, timings)
    changes = tuple(change for change in scenario.variants if asked.full or not change.only_full)
    compared = scenario.model_copy(update={"variants": changes})
    with _timed(timings, "runs and variants"):
        comparison = compare(loaded.path, loaded.data, compared, workers=workers,
                             on_progress=lambda done, total, _: on_progress("runs and variants", done, total))
        write_json(out / "compare.json", comparison_document(comparison))
    stated = len(scenario.variants)
    shortened = {CHANGES: f"{len(changes)} of {stated}"} if len(changes) < stated else {}
    if runs is None:
        runs = asked.draws(scenario.uncertainty.runs)
        shortened |= _fewer_trains(runs, scenario.uncertainty.runs)
    seed = scenario.uncertainty.seed if seed is None else seed
    with _timed(timings, "Monte Carlo"):
        rows = sweep(scenario, loaded.path, runs, seed, out=out / MONTE_CARLO, resume=asked.resume, workers=workers,
                     on_progress=lambda done, total: on_progress("Monte Carlo", done, total))
    content = ReportContent(
        scenario=scenario, claims=claims, runs=comparison.runs, metrics=comparison.metrics, sweep=rows,
        sweep_seed=seed, variants=comparison.variants, timings=timings,
        commands=(f"{asked.command} --runs {runs}",), gains=_gains(asked, on_progress, timings),
        shortened=shortened)
    page = out / "report.html"
    with _timed(timings, "page"):
        write_curves(list(scenario_charts(content).values()), out)
        write_text(page, build_page(content), ANOTHER_OUT)
    return Report(page, claims, comparison, summarise(rows, scenario), timings)


def build_study_report(asked: Asked, on_progress: Progress = lambda what, done, total: None) -> StudyReport:
    """Decide the claims, run the study, and write report.html, claims.json, compare.json, the certificates and
    the curves of every figure; with `resume` the runs that `run_study` has kept there are not run again."""
    study, out = asked.loaded.study, asked.out
    timings: dict[str, float] = {}
    claims = _decide(asked, on_progress, timings)
    with _timed(timings, "runs"):
        result = run_study(_as_short(asked), asked.workers, on_progress, out, asked.resume)
        write_json(out / "compare.json", study_document(study, result))
    write_curves(list(map(chart_of, result.plots)), out)
    found = _gains(asked, on_progress, timings, result.runs)
    page = out / "report.html"
    with _timed(timings, "page"):
        text = build_study_page(StudyContent(study, result, claims, timings, (asked.command,), found,
                                             _shortened(asked, result)))
        write_text(page, text, ANOTHER_OUT)
    return StudyReport(page, claims, study, result, timings)


def _as_short(asked: Asked) -> Loaded:
    """What is run: the file's study, without what is for full reports alone and on as many trains as are asked for."""
    study = asked.loaded.study
    if asked.full or not isinstance(study, ReproducedStudy):
        return asked.loaded
    fewer = study.pairs and study.pairs.model_copy(update={"draws": asked.draws(study.pairs.draws)})
    return replace(asked.loaded, record=study.model_copy(update={"pairs": fewer}).shortened())


def _shortened(asked: Asked, result: StudyResult) -> dict[str, str]:
    """What a page is shorter by than a full one, and how much of it there is; empty of a full one."""
    pairs, found = getattr(asked.loaded.study, "pairs", None), {}
    if result.left_out:
        found["runs"] = f"{len(result.runs)} of {len(result.runs) + result.left_out}"
    if isinstance(pairs, Pairs):
        found |= _fewer_trains(asked.draws(pairs.draws), pairs.draws)
    return found


def _fewer_trains(drawn: int, stated: int) -> dict[str, str]:
    return {"drawn trains": f"the first {drawn} of {stated}"} if drawn < stated else {}


def _decide(asked: Asked, on_progress: Progress, timings: dict[str, float]) -> dict[str, Any]:
    """The document of the claims that are asked for; empty when none is."""
    if not asked.proofs:
        return {}
    with _timed(timings, "proof"):
        decisions = prove(asked.proofs, asked.workers,
                          on_progress=lambda *step: on_progress("claims", *step)).decisions
        places = Places(asked.out / CERTIFICATES)
        write_certificates(decisions, places)
        claims = {**with_letters(claims_document(decisions, places), decisions),
                  **findings_document(findings(decisions))}
        write_json(asked.out / "claims.json", claims)
        write_text(asked.out / CHECKER, contents(Path(checker.__file__)).decode(), ANOTHER_OUT)
    return claims


def _gains(asked: Asked, on_progress: Progress, timings: dict[str, float], runs: Runs = NONE_YET
           ) -> StudyResult | None:
    """What is known of the paper's gains, and gains.json; none for a paper that searches none. runs: see `effects`."""
    if asked.gains is None:
        return None
    with _timed(timings, "gains"):
        done = effects(asked.loaded, asked.gains, asked.workers,
                       lambda at, total, _: on_progress("runs of gains", at, total), runs, asked.full)
        fronts = shown_fronts(asked.loaded, searched_or_recorded(asked.loaded, False), asked.workers,
                              lambda at, total, _: on_progress("fronts of gains", at, total))
        write_json(asked.out / "gains.json", gains_document(asked.gains, done, fronts))
    return gains_result(asked.gains, done, fronts, left_out(asked.loaded, asked.gains, done))


def _check_folder(loaded: Loaded, out: Path) -> None:
    """InputError unless the report can be written there, beside or over nothing that it is made from."""
    check_outputs({}, [loaded.path], {"--out": (out, FILES)})
    if is_paper(loaded.folder) and out.is_dir() and (
            out.samefile(loaded.folder) or out.resolve().is_relative_to((loaded.folder / CERTIFICATES).resolve())):
        raise InputError(out, "--out", "is the paper's own folder, which a report would mix with its own files: name "
                         "another folder")
    for part in (CERTIFICATES, CURVES, MONTE_CARLO):
        require_inside(out / part, out, ANOTHER_OUT)
    read_manifest(out / CURVES, ANOTHER_OUT)


@contextmanager
def _timed(timings: dict[str, float], what: str) -> Iterator[None]:
    started = time.perf_counter()
    yield
    timings[what] = time.perf_counter() - started
