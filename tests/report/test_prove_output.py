"""What `workbench prove` and `show` say: failures first, nothing cut, nothing written unasked."""

import json

import pytest
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.cli.console import out_console
from workbench.errors import InputError

TEXT = '''
import sympy as sp
from workbench.proof.claim import Goal, at_least
from workbench.proof.paper import Paper

paper = Paper("doe2026", "J. Doe, A paper, 2026")
z = sp.symbols("z_1:20", real=True)


@paper.claim("1", "a step of many letters", "inequality", r"z_1 + \\\\dots \\\\ge 1", "refuted")
def step() -> Goal:
    """It fails where z_1 <= 0."""
    return Goal((at_least(sum(z), 1000003),))


@paper.claim("theorem1", "the theorem", "inequality", r"z_1^2 \\\\ge 0", "proved", severity="result", rests_on=("1",))
def theorem() -> Goal:
    return Goal((at_least(z[0] ** 2, 0),))
'''


@pytest.fixture
def doe(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "doe2026.py").write_text(TEXT.replace("\\\\\\\\", "\\\\"))
    return tmp_path


def run(*arguments, code=0):
    out_console.stderr = False
    done = CliRunner().invoke(app, list(arguments))
    out_console.stderr = False
    assert done.exit_code == code, done.output
    return done


def test_failures_come_first_counts_last_and_nothing_is_cut_or_written(doe):
    lines = run("prove", "doe2026.py", "--workers", "1").stdout.splitlines()
    assert lines[1].strip().startswith("Theorem 1 (the theorem) holds, but not by the way of the text")
    failing = next(line for line in lines if line.strip().startswith("doe2026:1 "))
    assert "is false as printed" in failing and "Theorem 1 rests on it." in failing and "…" not in failing
    assert lines[-2].startswith("2 lines of the paper: 1 proved, 1 refuted")
    assert not (doe / "certificates").exists()

    everything = run("prove", "doe2026.py", "--all", "--verbose").stdout
    assert "doe2026:theorem1  proved  the theorem" in everything and "It fails where z₁ ≤ 0." in everything
    assert run("prove", "doe2026.py", "--quiet").stdout == ""

    document = json.loads(run("prove", "doe2026.py", "--json", "-").stdout)
    assert [row["certificate"] for row in document["claims"]] == [None, None]
    run("prove", "doe2026.py", "--write", "--jobs", "1")
    assert (doe / "certificates" / "doe2026" / "1.json").is_file()
    document = json.loads(run("prove", "doe2026.py", "--json", "-").stdout)
    assert all(row["certificate"] for row in document["claims"])

    shown = run("show", "doe2026.py:1").stdout
    assert "a step of many letters" in shown and "refuted" in shown
    with pytest.raises(InputError, match="two places"):
        CliRunner().invoke(app, ["prove", "doe2026.py", "--write", "--certificates", "x"], catch_exceptions=False)
    with pytest.raises(InputError, match=r"did you mean 'doe2026\.py'"):
        CliRunner().invoke(app, ["prove", "doe206.py"], catch_exceptions=False)


def test_errata_are_written_into_the_folder_named(doe):
    done = run("errata", "doe2026.py", "--out", "e", "--workers", "1")
    assert "errata.md" in done.stdout
    assert "J. Doe, A paper, 2026" in (doe / "e" / "errata.md").read_text()
