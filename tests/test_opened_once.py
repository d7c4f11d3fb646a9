"""A file is read once: in one process no verb opens an input of a paper's folder twice."""

import os
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from child_process import made_in_a_fork
from command_line import run
from small_folders import OBJECTIVE, small_folder, small_scenario, with_claims
from test_curve_table import rows_of, written

from workbench.files.modules import TICK_NS
from workbench.trains.scenario import load_scenario

GAINS = '''
from workbench.gains.result import GainReport
from workbench.paper.gain_search import GainSearch

from .laws import pd
from .numbers import SHARE


def report(stated):
    """Nothing is searched; numbers of the file and of the folder are looked at."""
    assert stated.number("train.mass_kg") > 0 and SHARE
    return GainReport("doe2030", (), (), (), (), (pd.title,))


KIND = GainSearch(report, lambda found: [], lambda loaded, task: ({}, None))
'''


def opened(folder: Path, *arguments: object) -> dict[str, int]:
    """How often a verb opened each file of the folder for reading; in a fork, since a hook stays in its process."""
    return made_in_a_fork(_watched, folder, arguments)


def _watched(folder: Path, arguments: tuple[object, ...]) -> dict[str, int]:
    counted: Counter[str] = Counter()

    def remember(event: str, given: tuple[Any, ...]) -> None:
        if event != "open" or not isinstance(given[0], str | bytes):
            return
        path, mode, flags = given
        name = Path(os.fsdecode(path)).absolute()
        writes = any(c in mode for c in "wax+") if isinstance(mode, str) else bool((flags or 0) & 3)
        if name.is_relative_to(folder) and not writes:
            counted[str(name.relative_to(folder))] += 1

    sys.addaudithook(remember)
    ended = run(*arguments, folder=folder.parent)
    assert ended.returncode == 0, ended.stderr
    return dict(counted)


@pytest.fixture
def paper(tmp_path: Path) -> Path:
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2", "section_3")
    (folder / "gains.py").write_text(GAINS, encoding="utf-8")
    # Of a copy, so that this process knows nothing of the folder whose opened files are counted.
    curve = load_scenario(small_folder(tmp_path / "copy") / "study.toml").desired_curve()
    times = np.unique(np.concatenate((curve.breaks_s, np.linspace(0, curve.trip_time_s, 60))))
    written(folder / "curve.csv", rows_of(curve, times))
    head, _, rest = small_scenario().partition("[reference]")
    rest = rest[rest.index("[simulation]"):]
    text = f'{head}[reference]\nkind = "table"\nfile = "curve.csv"\n{rest}'
    (folder / "study.toml").write_text(text + TUNING + SEARCHED, encoding="utf-8")
    (folder / "contest.toml").write_text(CONTEST + SEARCHED, encoding="utf-8")
    time.sleep(2 * TICK_NS * 1e-9)  # what is newer than a tick may have changed while it was read, and is read anew
    return folder


SEARCHED = OBJECTIVE + """
[tuning.ranges.own]
K_p = [0.5, 2.0]
K_d = [0.5, 4.0]
"""
TUNING = """
[[variants]]
title = "a lighter train"
set = { "train.mass_kg" = 150000.0 }

[tuning]
runs = 2
seed = 1
"""
CONTEST = """
version = 1
kind = "contest"
name = "small"
title = "a small contest"
paper = "contest"
citation = "none"
scenario = "study.toml"
seeds = 2
seed = 1
resamples = 20
confidence = 0.95
[source]
seeds = "assumed"
seed = "assumed"
resamples = "assumed"
confidence = "assumed"
[conditions.nominal]
title = "nominal"
[tuning]
runs = 2
seed = 1
condition = "nominal"
draws = 1
"""
STUDY = {"study.toml", "line.toml", "curve.csv", "laws.py", "numbers.py"}
CLAIMS = {"paper.py", "claims/section_2.py", "claims/section_3.py", "laws.py", "numbers.py"}


@pytest.mark.parametrize(("arguments", "needed"), [
    (("compare", "doe2030", "--variants", "--workers", 1), STUDY),
    (("sweep", "doe2030", "--runs", 1, "--out", "out", "--workers", 1), STUDY),
    (("tune", "doe2030", "--controller", "own", "--workers", 1), STUDY),
    (("compare", "doe2030/contest.toml", "--workers", 1), STUDY | {"contest.toml"}),
    (("gains", "doe2030", "--no-runs"), STUDY | {"gains.py"}),
    (("prove", "doe2030", "--jobs", 1), CLAIMS),
    (("prove", "doe2030", "--jobs", 1, "--no-cache"), CLAIMS),
    (("report", "doe2030", "--runs", 1, "--out", "out", "--workers", 1), STUDY | CLAIMS | {"gains.py"}),
], ids=lambda given: given[0] if isinstance(given, tuple) else "")
def test_no_input_is_opened_twice_in_a_process(paper, arguments, needed):
    found = opened(paper, *arguments)
    inputs = {name: count for name, count in found.items() if not name.startswith("certificates/")}
    assert set(inputs) >= needed
    assert {name: count for name, count in inputs.items() if count > 1} == {}


def test_a_file_that_is_opened_twice_would_be_seen(paper):
    (paper / "numbers.py").write_text("from pathlib import Path\nfor _ in range(2):\n"
                                      "    Path(__file__).with_name('line.toml').read_text()\nSHARE = 1\n")
    assert opened(paper, "gains", "doe2030", "--no-runs")["line.toml"] == 3
