"""Names, paths and messages are shown as they are: brackets and colons in them are no markup of the terminal's."""

import json

import pytest
from command_line import run

from workbench.cli.console import err_console, out_console
from workbench.cli.study_tables import print_study
from workbench.cli.terminal import metrics_table, print_failures, progress
from workbench.paper.results import ResultTable, StudyResult

HOSTILE = ["o[/red]x", "[bold]x[/bold]", "[/]", ":smile:", "\\[x]", "[link=file:///x]y"]
ROW = dict.fromkeys(("period_s", "position_error_min", "position_error_max", "speed_error_min", "speed_error_max",
                     "stopping_error", "energy_J", "step_us_median"), 0.001)


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_name_is_shown_letter_by_letter(name, monkeypatch):
    monkeypatch.setattr(out_console, "_width", 200)
    monkeypatch.setattr(err_console, "_width", 200)
    with out_console.capture() as shown:
        out_console.print(metrics_table([{**ROW, "controller": name, "failed": name}], name))
    assert shown.get().count(name) == 2
    table = ResultTable(name, name, (name, "value"), ((name, 1.0),))
    with out_console.capture() as shown, err_console.capture() as failed:
        print_study(StudyResult((), (table,), (), (name,), ((name, name),)))
        print_failures([{"controller": name, "failed": name}])
    assert shown.get().count(name) == 5 and failed.get().count(name) == 4
    with err_console.capture() as shown, progress() as show:
        show(name, 1, 1)
    assert shown.get() == f"{name}: 1 done\n"


@pytest.mark.parametrize("name", ["o[/red]x", ":smile:"])
def test_a_certificate_in_a_hostile_folder_is_named_in_a_line(name, tmp_path):
    folder = tmp_path / name.replace("/", "∕")
    folder.mkdir()
    (folder / "a.json").write_text(json.dumps({"verdict": name}))
    ended = run("check-certificates", folder)
    assert ended.returncode == 1
    assert f"{folder / 'a.json'}: {name}: INVALID: " in ended.stderr


def test_a_column_of_results_has_as_many_digits_in_every_row(monkeypatch):
    monkeypatch.setattr(out_console, "_width", 200)
    values = {"stopping_error": -0.0038, "position_error_min": -0.239, "energy_J": 6.477e9, "step_us_median": 0.0}
    with out_console.capture() as shown:
        out_console.print(metrics_table([{**ROW, **values, "controller": "c", "failed": None}], "t"))
    assert shown.get().splitlines()[-3].split() == [
        "c", "1", "[−239,", "1.00]", "[1.00,", "1.00]", "−3.80", "1799.2", "0"]
