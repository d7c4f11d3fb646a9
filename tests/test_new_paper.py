"""The proof file to start from: it runs as it is written, and nothing of the user's is lost to it."""

import json
import tomllib
from fnmatch import fnmatch
from pathlib import Path

import pytest
from test_cli import ROOT, one_line, run

import workbench
from workbench.errors import InputError
from workbench.proof.new_paper import write_new_paper


def test_the_new_paper_is_decided_as_recorded_and_shows_each_kind_of_claim(tmp_path):
    assert run("new-paper", "mine2026", folder=tmp_path).returncode == 0
    result = run("prove", "mine2026.py", "--json", "out.json", folder=tmp_path)
    assert result.returncode == 0, result.stderr
    claims = json.loads((tmp_path / "out.json").read_text())["claims"]
    assert {c["kind"] for c in claims} >= {"identity", "inequality"}
    assert {c["paper"] for c in claims} == {"mine2026"}
    (refuted,) = (c for c in claims if c["verdict"] == "refuted")
    assert refuted["correction"] and refuted["counterexample"]
    (axiom,) = (c for c in claims if c["verdict"] == "assumed")
    assert len(axiom["premises"]) >= 2
    text = (tmp_path / "mine2026.py").read_text()
    assert "D(V)" in text and "flow=" in text and "assume=" in text and "# " in text
    assert "$" not in text and max(map(len, text.splitlines())) <= 120
    assert run("check-certificates", "certificates", folder=tmp_path).returncode == 0


def test_nothing_is_overwritten(tmp_path):
    path = tmp_path / "there" / "mine.py"
    assert run("new-paper", "mine", "--directory", path.parent).returncode == 0
    path.write_text("my own work")
    assert "exists already" in one_line(run("new-paper", "mine", "--directory", path.parent))
    assert path.read_text() == "my own work"


@pytest.mark.parametrize("name", ["2020chen", "a b", "a-b", "a.b", "../a", "", "class", "None", "json", "sympy", "_a"])
def test_a_name_that_no_module_can_have_is_refused(tmp_path, name):
    with pytest.raises(InputError) as caught:
        write_new_paper(name, tmp_path)
    assert "as in yang2021" in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_refused_name_is_one_line(tmp_path):
    assert "as in yang2021" in one_line(run("new-paper", "2020chen", folder=tmp_path))


def test_a_folder_that_is_a_file_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="another"):
        write_new_paper("mine", tmp_path / "file")
    with pytest.raises(InputError, match="another"):
        write_new_paper("mine", tmp_path / "file" / "below")


def test_every_file_of_the_package_that_is_no_module_is_packed_with_it():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    packed = settings["tool"]["setuptools"]["package-data"]
    package = Path(workbench.__file__).parent
    # Beside modules lie their bytecode and what numba compiled of them.
    others = [p for p in package.rglob("*") if p.is_file() and p.suffix != ".py" and p.parent.name != "__pycache__"]
    assert package / "proof" / "new_paper.txt" in others
    for path in others:
        name = ".".join(path.relative_to(package.parent).parent.parts)
        assert any(fnmatch(path.name, pattern) for pattern in packed.get(name, [])), path
