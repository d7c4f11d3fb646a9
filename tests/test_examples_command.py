"""`workbench examples` and `workbench list`, from the checkout: whole or not at all, and nowhere else."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

import workbench
from workbench.cli.app import app
from workbench.errors import InputError
from workbench.files import writing
from workbench.paper.examples import examples, examples_root, write_examples

ROOT = Path(__file__).resolve().parent.parent


def test_the_checkout_gives_its_own_files_without_caches_and_scripts(tmp_path):
    (tmp_path / "there").mkdir()
    lines = list(write_examples(tmp_path / "there"))
    assert examples_root() == ROOT
    written = sorted(path for path in (tmp_path / "there").rglob("*") if path.is_file())
    assert [path.relative_to(tmp_path / "there") for path in written] == sorted(
        Path(example.place) for example in examples(ROOT))
    assert not any("__pycache__" in path.parts for path in written)
    assert not list((tmp_path / "there" / "benchmarks").rglob("*.py"))
    assert {path.name for path in (tmp_path / "there" / "proofs").iterdir()} >= {"chen2019", "jiao2025", "liu2020"}
    assert lines[-1].startswith(f"{len(written)} files. To go on: ")
    assert list(tmp_path.iterdir()) == [tmp_path / "there"]


def test_a_folder_that_is_not_empty_stays_as_it_is(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(InputError, match="is not empty: name a new or an empty folder"):
        list(write_examples(tmp_path))
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]
    with pytest.raises(InputError):
        list(write_examples(tmp_path / "mine.txt"))
    assert (tmp_path / "mine.txt").read_text() == "mine"


def test_nothing_stays_of_what_could_not_be_written_whole(tmp_path, monkeypatch):
    whole, calls = writing._all, []

    def full(handle, data):
        calls.append(handle)
        if len(calls) > 50:
            raise OSError(28, "No space left on device")
        whole(handle, data)

    monkeypatch.setattr(writing, "_all", full)
    with pytest.raises(InputError, match="No space left"):
        list(write_examples(tmp_path / "new"))
    assert list(tmp_path.iterdir()) == []


def test_without_examples_the_package_says_where_to_get_them(tmp_path, monkeypatch):
    monkeypatch.setattr(workbench, "__file__", str(tmp_path / "workbench" / "__init__.py"))
    with pytest.raises(InputError, match="install the workbench from its wheel"):
        examples_root()


def test_the_list_fits_eighty_columns_and_names_what_each_paper_has(monkeypatch, tmp_path):
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(ROOT)
    shown = CliRunner().invoke(app, ["list", "proofs"])
    assert shown.exit_code == 0 and all(len(line) <= 80 for line in shown.output.splitlines())
    for folder in (ROOT / "proofs").iterdir():
        if (folder / "paper.py").is_file():
            assert f"proofs/{folder.name}" in shown.output
    assert "claims" in shown.output and "gains" in shown.output
    (tmp_path / "bare").mkdir()
    (tmp_path / "bare" / "study.toml").write_text('title = "A bare one"')
    assert "A bare one" in CliRunner().invoke(app, ["list", str(tmp_path)]).output
    assert CliRunner().invoke(app, ["--version"]).output == f"workbench {workbench.__version__}\n"
