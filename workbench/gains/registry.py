"""The papers whose gains are looked at; each module has `report(stated) -> GainReport`."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from workbench.errors import InputError, WorkbenchError
from workbench.gains.result import GainReport
from workbench.gains.stated import Stated

PAPERS: dict[str, str] = {paper: f"workbench.gains.{paper}"
                          for paper in ("chen2019", "jiao2025", "liu2020", "mao2018", "yang2021")}


def file_of(paper: str) -> Path:
    """The file of a paper's stated gains: the argument itself if it is a TOML file, else benchmarks/<paper>.toml."""
    path = Path(paper) if paper.endswith(".toml") else Path("benchmarks") / f"{paper}.toml"
    if not paper.endswith(".toml") and paper not in PAPERS:
        raise InputError("", paper, f"gains are known of {', '.join(PAPERS)}: name one of them, or a TOML file of one")
    return path


def gains_of(path: Path, proofs: Path | None = None) -> GainReport:
    """Conditions, certificates and found gains of a paper's file; InputError naming file and key.

    proofs: the folder with the paper's proof file, `proofs` beside the file's folder unless given.
    """
    stated = Stated(path, proofs)
    paper = str(stated.entry("paper"))
    if paper not in PAPERS:
        raise InputError(path, "paper", f"gains are known of {', '.join(PAPERS)}, not of '{paper}': name one of them")
    try:
        found: GainReport = import_module(PAPERS[paper]).report(stated)
    except WorkbenchError:
        raise
    except Exception as trouble:  # a file may be well formed and still leave nothing to search
        what = " ".join(f"{type(trouble).__name__}: {trouble}".split())
        raise InputError(path, "", f"the search of gains fails on its numbers ({what}): take those of the paper's own "
                                   "file as a model") from trouble
    return found
