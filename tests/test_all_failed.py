"""Where every run failed, a command ends with exit code 1 and a line, and has written what was asked all the same."""

import json
import re
from pathlib import Path

import pytest
from command_line import run
from short_sweep import write_scenario

from workbench.cli.all_failed import end_where_all_failed


@pytest.fixture
def hopeless(tmp_path: Path) -> Path:
    """A scenario with `narrow` alone, whose barrier is so tight that it fails at once."""
    path = write_scenario(tmp_path)
    tables = re.split(r"(?m)^(?=\[)", path.read_text())
    path.write_text("".join(table for table in tables if not re.match(
        r"\[controllers\.(?!narrow)|\[+printed_table", table)))
    return path


def last_line(error: str) -> str:
    return error.strip().splitlines()[-1]


def test_a_comparison_in_which_all_fails_is_exit_code_1_and_its_rows_are_written(hopeless, tmp_path):
    ended = run("compare", hopeless, "--json", tmp_path / "rows.json", "--workers", 1)
    assert ended.returncode == 1
    line = last_line(ended.stderr)
    assert line.startswith("workbench: the only run failed; first narrow: ") and "left its domain" in line
    assert [row["controller"] for row in json.loads((tmp_path / "rows.json").read_text())["rows"]] == ["narrow"]


def test_a_sweep_in_which_all_fails_is_exit_code_1_and_its_rows_are_written(hopeless, tmp_path):
    ended = run("sweep", hopeless, "--runs", 3, "--out", tmp_path / "mc", "--workers", 1)
    assert ended.returncode == 1
    assert last_line(ended.stderr).startswith("workbench: all 3 runs failed; first narrow: ")
    assert len((tmp_path / "mc" / "sweep.csv").read_text().splitlines()) == 1 + 3


def test_one_run_that_comes_to_its_end_is_enough(tmp_path):
    ended = run("sweep", write_scenario(tmp_path), "--runs", 2, "--out", tmp_path / "mc", "--workers", 1)
    assert ended.returncode == 0 and "runs failed" not in ended.stderr


def test_rows_that_stand_for_many_runs_have_all_failed_only_where_every_run_did(capsys):
    some = {"controller": "pid", "failed": "t = 3 s", "runs": 5, "failed_runs": 4}
    end_where_all_failed([some])
    end_where_all_failed([])
    assert capsys.readouterr().err == ""
    with pytest.raises(Exception) as ended:
        end_where_all_failed([some | {"failed_runs": 5}, {"controller": "mpc", "failed": "t = 1 s"}])
    assert ended.value.exit_code == 1
    assert "all 6 runs failed; first pid: t = 3 s" in capsys.readouterr().err
