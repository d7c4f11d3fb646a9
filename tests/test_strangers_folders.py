"""Whose Python is run: that of a paper which was named, and of nobody else."""

import json

import pytest
from command_line import one_line, run
from small_folders import small_folder, with_claims

from workbench.files import folders
from workbench.files.folders import paper_named, papers_near

MARK = 'from pathlib import Path\nPath(__file__).with_name("was_run").touch()\n'


@pytest.fixture
def marked(tmp_path):
    """A paper's folder every module of which leaves a mark when it is run."""
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2")
    for path in folder.rglob("*.py"):
        path.write_text(MARK + path.read_text())
    return folder


def was_run(folder):
    return any(folder.rglob("was_run"))


def test_what_lists_and_compares_runs_nothing_of_a_paper(marked, tmp_path):
    document = tmp_path / "a.json"
    document.write_text(json.dumps({"claims": [{"id": "doe2030:1", "verdict": "proved"}]}))
    for arguments in (("list", marked), ("list", tmp_path), ("diff", document, document),
                      ("export-coq", marked, "--out", tmp_path / "coq")):
        run(*arguments, folder=tmp_path)
        assert not was_run(marked), arguments
    assert run("prove", marked, folder=tmp_path).returncode in (0, 1) and was_run(marked)


def test_a_paper_that_another_user_has_laid_on_the_way_is_not_found(marked, monkeypatch):
    """As in a temporary folder, where anybody may put a folder under a name that is looked for."""
    mine = marked.parent / "here"
    mine.mkdir()
    assert paper_named("doe2030", mine) == marked and marked in papers_near(mine)
    monkeypatch.setattr(folders, "owner", lambda path: 4321 if path == marked else 1234)
    monkeypatch.setattr(folders.os, "geteuid", lambda: 1234)
    assert paper_named("doe2030", mine) is None and marked not in papers_near(mine)
    assert "doe2030: no such paper" in one_line(run("prove", "doe2030", folder=mine))
    assert not was_run(marked)
    monkeypatch.setattr(folders, "owner", lambda path: 4321)  # of one who owns the place where it is looked for too
    assert paper_named("doe2030", mine) == marked
