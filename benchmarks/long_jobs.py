"""The long commands that are killed, interrupted and starved, each with its inputs and with what it has to give."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from bad_input_texts import CLAIMS, CONTEST, PAPER, PID, RUN, UNCERTAINTY, line_text, sourced

from workbench.paper.new_paper import write_new_paper

SEARCH = """\
[tuning]
runs = {runs}
restarts = 4
seed = 1
ranges = {{ good = {{ K_p = [0.5, 2.0], K_d = [1.0, 4.0] }} }}
objective = {{ position_m = 0.1, speed_mps = 0.1, jerk_mps3 = 0.3, failed = 100.0 }}
"""


@dataclass(frozen=True)
class Job:
    """A long command. write: its inputs into a folder; go_on: what `begin` is continued with; result: what it made,
    measured times left out; keeps: the folder of what it resumes from, empty where that is the cache."""

    name: str
    write: Callable[[Path], None]
    begin: str
    go_on: str
    result: Callable[[Path], bytes]
    keeps: str = ""

    @property
    def own_cache(self) -> bool:
        """Whether what it resumes from lies in the cache, so that it is given one of its own."""
        return not self.keeps


def _study(folder: Path, more: str = "") -> None:
    (folder / "line.toml").write_text(line_text(), encoding="utf-8")
    (folder / "study.toml").write_text(sourced(RUN + PID + UNCERTAINTY + more), encoding="utf-8")


def _contest(folder: Path, seeds: int) -> None:
    _study(folder)
    (folder / "study.toml").rename(folder / "run.toml")
    (folder / "contest.toml").write_text(CONTEST.replace("seeds = 2", f"seeds = {seeds}"), encoding="utf-8")


def _claims(folder: Path, copies: int) -> None:
    (folder / "claims").mkdir()
    (folder / "paper.py").write_text(PAPER, encoding="utf-8")
    (folder / "values.toml").write_text("bound = 1\n", encoding="utf-8")
    for number in range(copies):
        text = CLAIMS.replace('"4", "a lemma"', f'"{number}.4", "a lemma"').replace("D(x**2", f"D({number + 1} * x**2")
        for claim in "123":
            text = text.replace(f'"{claim}"', f'"{number}.{claim}"')
        (folder / "claims" / f"section_{number}.py").write_text(
            text.replace('"2",', f'"{number}.2",'), encoding="utf-8"
        )


def _plant(folder: Path) -> None:
    write_new_paper("mine2030", folder, "plant")


def contest_without_times(path: Path) -> bytes:
    """The document of a contest without the columns of how long a step took."""
    document = json.loads(path.read_text(encoding="utf-8"))
    for table in document["tables"]:
        timed = [place for place, heading in enumerate(table["header"]) if "step" in heading or "µs" in heading]
        for row in (*table["rows"], *table["values"]):
            for place in reversed(timed):
                del row[place]
    return json.dumps(document).encode()


def claims_without_times(path: Path) -> bytes:
    """The document of a proof without how long each claim took."""
    document = json.loads(path.read_text(encoding="utf-8"))
    for row in document["claims"]:
        del row["seconds"]
    return json.dumps(document).encode()


def jobs(size: int = 1, workers: int = 2) -> dict[str, Job]:
    """The jobs, `size` times as long as they are in a test."""
    many = f"--workers {workers}"
    sweep, contest = (
        f"sweep . --runs {60 * size} --out mc {many}",
        f"compare contest.toml --json out.json --out kept {many}",
    )
    tune, prove = f"tune study.toml --out tuned {many}", f"prove . --json out.json {many}"
    made = (
        Job(
            "sweep", _study, sweep, f"{sweep} --resume", lambda folder: (folder / "mc" / "sweep.csv").read_bytes(), "mc"
        ),
        Job(
            "contest", lambda folder: _contest(folder, 10 * size), contest, f"{contest} --resume",
            lambda folder: contest_without_times(folder / "out.json"),
            "kept",
        ),
        Job("prove", lambda folder: _claims(folder, 2 * size), prove, prove,
            lambda folder: claims_without_times(folder / "out.json")),
        Job(
            "tune", lambda folder: _study(folder, SEARCH.format(runs=40 * size)), f"{tune} --write",
            f"{tune} --write --resume", lambda folder: (folder / "study.toml").read_bytes(), "tuned",
        ),
        Job(
            "plant", _plant, f"sweep mine2030 --runs {20 * size} --out mc {many}",
            f"sweep mine2030 --runs {20 * size} --out mc {many} --resume",
            lambda folder: (folder / "mc" / "sweep.csv").read_bytes(), "mc",
        ),
        Job(
            "dask", _study, f"{sweep} --dask local", f"{sweep} --resume --dask local",
            lambda folder: (folder / "mc" / "sweep.csv").read_bytes(), "mc",
        ),
    )
    return {job.name: job for job in made}
