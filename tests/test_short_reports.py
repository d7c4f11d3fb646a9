"""A scenario's report is short unless it is to be full: what the file marks is not run, and the page says so."""

import json
import re
from pathlib import Path

import pytest
from command_line import run
from short_sweep import write_scenario

VARIANTS = """
[[variants]]
title = "a lighter train"
set = { "train.mass_kg" = 190000.0 }
[[variants]]
title = "a heavier train"
only_full = true
set = { "train.mass_kg" = 210000.0 }
"""


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[str, list[dict[str, object]]]]:
    """The page and the changes of a short report and of a full one."""
    folder = tmp_path_factory.mktemp("short")
    path, made = write_scenario(folder), {}
    path.write_text(path.read_text() + VARIANTS)
    for which, options in (("short", ()), ("full", ("--full",))):
        ended = run("report", path, "--out", folder / which, "--runs", 1, "--workers", 1, *options)
        assert ended.returncode == 0, ended.stderr
        made[which] = words(folder / which / "report.html"), json.loads(
            (folder / which / "compare.json").read_text())["variants"]
    return made


def words(page: Path) -> str:
    return " ".join(re.sub(r"<[^>]+>", " ", page.read_text(encoding="utf-8")).split())


def test_a_change_that_is_for_full_reports_is_not_run_and_the_others_keep_their_numbers(reports):
    (_, short), (_, full) = reports["short"], reports["full"]
    assert [one["title"] for one in short] == ["a lighter train"]
    assert [one["title"] for one in full] == ["a lighter train", "a heavier train"]
    timed = ("step_us_median", "step_us_p99")
    assert [[value for key, value in row.items() if key not in timed] for row in short[0]["rows"]] == [
        [value for key, value in row.items() if key not in timed] for row in full[0]["rows"]]


def test_the_page_says_what_is_left_out_and_how_to_get_it(reports):
    (short, _), (full, _) = reports["short"], reports["full"]
    assert "Shortened: 1 of 2 changes; all with --full." in short
    assert "Short report. Changes of assumed values: 1 of 2. --full makes the rest, too." in short
    assert "Shortened" not in full and "Short report" not in full and "2 changes of assumed data" in full
