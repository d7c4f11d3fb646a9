"""One claim that states nothing, or takes too long, does not keep the others from being decided."""

from __future__ import annotations

import time

import pytest
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.errors import InputError
from workbench.files.time_limit import OutOfTime, at_most_seconds
from workbench.proof.prove import prove
from workbench.proof.selection import targets

TEXT = '''
import sympy as sp
from workbench.proof.claim import Goal, at_least, equal
from workbench.proof.paper import Paper

paper = Paper("a", "a")
x, y = sp.symbols("x y", real=True)


@paper.claim("1", "a square", "inequality", "x", "proved")
def square():
    return Goal((at_least(x**2, 0),))


@paper.claim("2", "nothing", "identity", "x", "proved")
def nothing():
    return Goal((equal(x, x),))


@paper.claim("3", "rests on nothing", "identity", "x", "proved", premises=("2",))
def rests():
    return Goal((equal((x + y)**2, x**2 + 2*x*y + y**2),))


@paper.claim("4", "a correction that is false", "inequality", "x", "refuted",
             correction=lambda: Goal((at_least(x, -1),)))
def mended():
    return Goal((at_least(x, 0),))


@paper.claim("5", "without end", "inequality", "x", "undecided")
def endless():
    while True:
        pass
'''


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_others_are_decided(tmp_path, jobs):
    path = tmp_path / "a.py"
    path.write_text(TEXT)
    proof = prove(targets([path]), jobs, use_cache=False, limit=1.0)
    assert {d.claim.equation: d.verdict for d in proof.decisions} == {"1": "proved", "3": "proved", "5": "undecided"}
    assert "--limit" in next(d.method for d in proof.decisions if d.claim.equation == "5")
    assert list(proof.misstated) == ["a:2", "a:4"]
    assert "states nothing" in proof.misstated["a:2"]
    assert "could not be proved" in proof.misstated["a:4"]


def test_the_command_ends_with_2_and_names_them(tmp_path):
    path = tmp_path / "a.py"
    path.write_text(TEXT)
    result = CliRunner().invoke(app, ["prove", str(path), "--no-cache", "--jobs", "1", "--limit", "1",
                                      "--certificates", str(tmp_path / "c")])
    assert result.exit_code == 2
    assert "misstated" in result.output
    assert (tmp_path / "c").exists()


def test_a_limit_ends_what_catches_every_exception():
    started = time.process_time()
    with pytest.raises(OutOfTime), at_most_seconds(0.2):
        while True:
            try:
                sum(range(1000))
            except Exception:
                continue
    assert time.process_time() - started < 2
    with at_most_seconds(None):
        pass


def test_a_paper_without_claims_is_told(tmp_path):
    (tmp_path / "claims").mkdir()
    (tmp_path / "paper.py").write_text('from workbench.proof.paper import Paper\npaper = Paper("a", "a")\n')
    with pytest.raises(InputError, match="claims: states no claim"):
        CliRunner().invoke(app, ["prove", str(tmp_path)], catch_exceptions=False)
