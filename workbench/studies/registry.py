"""All studies: a file's `kind = "study"` and its `paper` choose the record that reads it and what runs it."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from workbench.errors import InputError
from workbench.studies.base import Study, StudyKind
from workbench.toml_input import read_toml, validate_record

# Each module has a `KIND`. It is imported when a file asks for it, since each brings its paper's expressions along.
STUDIES: dict[str, str] = {
    "chen2019": "workbench.studies.chen2019",
    "jiao2025": "workbench.studies.jiao2025",
    "contest": "workbench.contest.study",
    "liu2020": "workbench.studies.liu2020",
    "mao2018": "workbench.studies.mao2018",
}


def is_study(path: Path) -> bool:
    """Whether a TOML file is a study, else a scenario, which states no kind; InputError for another kind."""
    kind = read_toml(path).get("kind")
    if kind not in (None, "study"):
        raise InputError(path, "kind", f"{kind!r} is not known: it is 'study', or left out for a scenario")
    return kind == "study"


def study_kind(paper: str) -> StudyKind:
    """The record and the run of a paper's study; InputError when there is no study of it."""
    if paper not in STUDIES:
        raise InputError("", "paper", f"there is no study of '{paper}': choose one of {', '.join(STUDIES)}")
    found: StudyKind = import_module(STUDIES[paper]).KIND
    return found


def load_study(path: Path) -> Study:
    """The validated record of a study's file, of its paper's own class; InputError naming file, key and remedy."""
    data = read_toml(path)
    paper = data.get("paper")
    if not isinstance(paper, str):
        raise InputError(path, "paper", f"name the paper: one of {', '.join(STUDIES)}")
    try:
        kind = study_kind(paper)
    except InputError as trouble:
        raise trouble.within(path) from None
    study = validate_record(data, kind.record, path)
    return kind.located(study, path) if kind.located else study


def check_kept(study: Study | None, out: Path | None, resume: bool) -> None:
    """InputError unless runs of the study, None for a scenario, can be kept in `out` and gone on with."""
    keeps = study is not None and study_kind(study.paper).run_kept is not None
    if not keeps and (out is not None or resume):
        raise InputError("", "--resume" if out is None else "--out", "is for contests, which alone keep their finished "
                         "runs: leave it out")
    if resume and out is None:
        raise InputError("", "--resume", "needs the folder of the runs to go on with: name it with --out")
