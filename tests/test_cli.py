"""The command line as other programs and newcomers meet it: exit codes, one-line errors, stable JSON."""

import json
import re

import pytest
from command_line import one_line, run, run_apart
from scenarios import LIGHT_TRAIN, ROOT

from workbench.cli.app import VERBS, _verb
from workbench.cli.console import out_console
from workbench.cli.study_tables import result_table
from workbench.paper.results import ResultTable

ROW_KEYS = {"controller", "position_error_min", "position_error_max", "speed_error_min", "speed_error_max",
            "position_rms", "speed_rms", "stopping_error", "energy_J", "jerk_rms", "saturated_fraction",
            "limit_violations", "step_us_median", "step_us_p99", "deadline_misses", "failed"}
CLAIM_KEYS = {"id", "paper", "equation", "kind", "statement", "verdict", "method", "scope", "certificate",
              "counterexample", "correction", "premises", "tainted_by", "trust", "seconds"}
SHORT = """
version = 1
name = "short"
title = "A short run"
paper = "none"
citation = "none"
""" + LIGHT_TRAIN + """\
max_braking_n = 200000.0
[reference]
kind = "cruise_speed"
cruise_mps = 10.0
acceleration_mps2 = 0.5
braking_mps2 = 0.5
ramp_s = 2.0
[simulation]
plant_step_s = 0.01
dwell_s = 1.0
position_band_m = 0.2
log_every_s = 0.1
[disturbance]
amplitude_mps2 = 0.0
period_s = 60.0
[controllers.good]
law = "pid"
period_s = 0.01
parameters = { K_p = 1.0, K_i = 0.1, K_d = 2.0 }
initial = { eta_e = 0.0 }
[controllers.slow]
law = "yang2021.pocrac"
period_s = PERIOD
parameters = { GAINS }
initial = { a_hat = 0.02, b_hat = 0.0, c_hat = 0.0 }
[uncertainty]
runs = 2
seed = 1
spread = 0.1
factors = ["mass"]
"""
LINE = """
name = "line"
length_m = 500.0
grade = [{ start_m = 0.0, end_m = 500.0, grade_permille = 1.0 }]
curve = [{ start_m = 0.0, end_m = 500.0, radius_m = inf }]
"""
LINE_SOURCE = "".join(f'source.{key} = "assumed: a test"\n' for key in ("name", "length_m", "grade", "curve"))
GAINS = ", ".join(["alpha = 0.5, beta = 0.51, k = 0.21",
                   *(f"{n}_{i} = 0.01" for n in ("lambda", "sigma") for i in "123")])


def sourced(text: str) -> str:
    """The TOML text with a source for every value of every table; the values before the first table need none."""
    head, *tables = re.split(r"(?m)^(?=\[)", text)
    lines = [head]
    for table in tables:
        keys = re.findall(r"(?m)^(\w+) = ", table)
        lines.append(table + "source = { " + ", ".join(f'{key} = "assumed: a test"' for key in keys) + " }\n")
    return "".join(lines)


def short_toml(period_s: float = 0.01) -> str:
    return sourced(SHORT.replace("PERIOD", str(period_s)).replace("GAINS", GAINS))


@pytest.fixture
def short(tmp_path):
    (tmp_path / "line.toml").write_text(LINE + LINE_SOURCE)
    path = tmp_path / "short.toml"
    path.write_text(short_toml())
    return path


@pytest.mark.parametrize("verb", VERBS)
def test_help_leaves_nothing_out(verb):
    """Brackets are no markup in it, and its sentences run to the end of the line."""
    command = _verb(verb)
    for parameter in (parameter for parameter in command.params if not getattr(parameter, "hidden", False)):
        assert parameter.help or parameter.name == "help", f"{verb}: {parameter.name} has no help"
        assert "[" not in (parameter.help or ""), f"{verb}: {parameter.name}"
    assert command.help and "\n" not in command.help.replace("\n\n", "")


def test_what_was_nearly_typed_is_asked_for(tmp_path):
    (tmp_path / "study.toml").write_text("")
    assert "did you mean 'prove'? Else see 'workbench --help'" in one_line(run("prov", "x"))
    assert f"did you mean '{tmp_path / 'study.toml'}'?" in one_line(run("compare", tmp_path / "studi.toml"))
    assert "did you mean" not in one_line(run("compare", tmp_path / "nowhere.json"))


def test_help_names_every_command():
    shown = run_apart("--help").stdout
    for command in ("prove", "check ", "new-paper", "check-certificates", "compare", "sweep", "tune", "report",
                    "reference", "gains", "show", "diff", "errata"):
        assert command in shown


def test_the_example_of_the_readme_is_decided(tmp_path):
    section = (ROOT / "README.md").read_text().partition("## State your own claim")[2].partition("\n## ")[0]
    (code,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    (tmp_path / "my_paper.py").write_text(code)
    result = run_apart("prove", "my_paper.py", "--write", "--json", "out.json", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    document = json.loads((tmp_path / "out.json").read_text())
    assert document["version"] == 2 and document["summary"]["proved"] == 1
    (claim,) = document["claims"]
    assert claim.keys() >= CLAIM_KEYS and claim["id"] == "mine:3" and claim["trust"] == "exact"
    assert run("check-certificates", "certificates", folder=tmp_path).returncode == 0


def test_a_verdict_that_differs_from_the_record_is_exit_code_1(tmp_path):
    section = (ROOT / "README.md").read_text().partition("## State your own claim")[2].partition("\n## ")[0]
    (code,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    (tmp_path / "my_paper.py").write_text(code.replace('"proved"', '"refuted"'))
    result = run("prove", "my_paper.py", folder=tmp_path)
    assert result.returncode == 1
    assert "mine:3" in result.stderr and "proved" in result.stderr and "refuted" in result.stderr


def test_compare_writes_the_stable_rows(short, tmp_path):
    result = run("compare", short, "--json", tmp_path / "rows.json", "--workers", 1)
    assert result.returncode == 0, result.stderr
    document = json.loads((tmp_path / "rows.json").read_text())
    assert document["version"] == 1 and document["scenario"] == "short"
    for row in document["rows"]:
        assert row.keys() >= ROW_KEYS
        assert row["failed"] is None and row["energy_J"] > 0


def test_a_run_that_fails_is_a_failed_row_and_stops_no_other(short, tmp_path):
    short.write_text(short_toml(2.0))
    result = run("compare", short, "--json", tmp_path / "rows.json", "--workers", 1)
    assert result.returncode == 0, result.stderr
    text = (tmp_path / "rows.json").read_text()
    assert "NaN" not in text and "Infinity" not in text
    good, bad = json.loads(text)["rows"]
    assert good["failed"] is None
    assert "left its domain" in bad["failed"] and "yang2021.pocrac" in bad["failed"] and "t = " in bad["failed"]
    assert bad["stopping_error"] is None and bad["energy_J"] is None
    assert "slow" in result.stderr


def test_report_of_a_short_scenario_without_a_proof(short, tmp_path):
    result = run("report", short, "--out", tmp_path / "out", "--runs", 1, "--workers", 1)
    assert result.returncode == 0, result.stderr
    page = (tmp_path / "out" / "report.html").read_text()
    assert "A short run" in page
    assert str(tmp_path / "out" / "report.html") in result.stdout.replace("\n", "")


def test_bad_input_is_one_line_and_exit_code_2(short, tmp_path):
    missing = tmp_path / "missing.toml"
    assert "missing.toml" in one_line(run_apart("compare", missing))
    assert "name a paper's folder, a proof file" in one_line(run("prove", tmp_path / "missing.py"))
    assert "no such folder or file" in one_line(run("check-certificates", tmp_path / "nothing"))
    short.write_text(short_toml().replace("mass_kg = 200000.0", "mass_kg = -1.0"))
    line = one_line(run("compare", short))
    assert "short.toml" in line and "train.mass_kg" in line
    occupied = tmp_path / "file"
    occupied.write_text("")
    short.write_text(short_toml())
    assert "name another place" in one_line(run("report", short, "--out", occupied / "out"))


def test_a_broken_proof_file_is_one_line(tmp_path):
    (tmp_path / "broken.py").write_text("import nothing_of_this_name\n")
    assert "broken.py" in one_line(run("prove", tmp_path / "broken.py"))
    (tmp_path / "empty.py").write_text("x = 1\n")
    assert "Paper" in one_line(run("prove", tmp_path / "empty.py"))


def test_a_tampered_certificate_is_named(tmp_path):
    section = (ROOT / "README.md").read_text().partition("## State your own claim")[2].partition("\n## ")[0]
    (code,) = re.findall(r"```python\n(.*?)```", section, re.DOTALL)
    (tmp_path / "mine.py").write_text(code)
    run("prove", "mine.py", "--write", folder=tmp_path)
    result = run("check-certificates", "certificates", "--paper", "mine.py", folder=tmp_path)
    assert result.returncode == 0 and "the goals of their papers' claims: 1" in result.stdout
    (path,) = (p for p in (tmp_path / "certificates").rglob("*.json") if p.name != "manifest.json")
    path.write_text(path.read_text().replace("proved", "refuted"))
    result = run("check-certificates", "certificates", folder=tmp_path)
    assert result.returncode == 1 and path.name in result.stderr


@pytest.mark.parametrize("verb", ["prove", "show", "compare", "gains"])
def test_an_empty_name_is_not_the_folder_one_is_in(verb, tmp_path):
    assert "'.' for" in one_line(run(verb, "", folder=tmp_path))


@pytest.mark.parametrize("width", [40, 60, 80, 200])
def test_no_word_of_a_study_table_is_broken_however_narrow_the_screen(width, monkeypatch):
    """Columns of one letter each were what was left of nine of them on 80; now a row stands below the other."""
    monkeypatch.setattr(out_console, "_width", width)
    words = ("Reading", "iCFDL-MFAILC", "diverges", "in", "trial", "122", "nonlinear", "offset-free", "samples")
    table = ResultTable("every reading", "section 4", words, tuple((*words[n:], *words[:n]) for n in range(9)))
    with out_console.capture() as shown:
        out_console.print(result_table(table))
    lines = shown.get().splitlines()
    assert max(map(len, lines)) <= width
    assert {word: shown.get().split().count(word) for word in words[1:]} == dict.fromkeys(words[1:], (
        10 if width == 200 else 18))
