"""The paper to start from: every verb takes it as it is written, and nothing of the user's is lost to it."""

import errno
import json
import os
from pathlib import Path

import pytest
from command_line import one_line, run

from workbench.errors import InputError
from workbench.files import writing
from workbench.paper.loading import load
from workbench.paper.new_paper import TEMPLATE, template_files, write_new_paper

FILES = ["claims/section_2.py", "laws.py", "line.toml", "paper.py", "study.toml"]


@pytest.fixture(scope="module")
def mine(tmp_path_factory):
    folder = tmp_path_factory.mktemp("new")
    written = run("new-paper", "mine2026", folder=folder)
    assert written.returncode == 0, written.stderr
    assert "workbench prove mine2026" in written.stdout and "workbench compare mine2026" in written.stdout
    return folder / "mine2026"


def test_a_newcomer_reads_less_than_a_hundred_and_fifty_lines(mine):
    assert sorted(p.relative_to(mine).as_posix() for p in mine.rglob("*") if p.is_file()) == FILES
    texts = [(mine / name).read_text(encoding="utf-8") for name in FILES]
    assert sum(len(text.splitlines()) for text in texts) < 150
    assert "$" not in "".join(texts)


def test_it_is_decided_as_recorded_and_shows_what_claims_there_are(mine):
    result = run("prove", "mine2026", "--write", "--json", "out.json", folder=mine.parent)
    assert result.returncode == 0, result.stderr
    claims = json.loads((mine.parent / "out.json").read_text())["claims"]
    assert {c["kind"] for c in claims} >= {"identity", "inequality", "condition", "implication"}
    assert {c["verdict"] for c in claims} == {"proved", "refuted", "violated", "assumed"}
    assert {c["paper"] for c in claims} == {"mine2026"}
    (refuted,) = (c for c in claims if c["verdict"] == "refuted")
    assert refuted["correction"] and refuted["counterexample"]
    (axiom,) = (c for c in claims if c["verdict"] == "assumed")
    assert len(axiom["premises"]) >= 2
    text = (mine / "claims" / "section_2.py").read_text()
    assert "D(V)" in text and "flow=" in text and "assume=" in text and "# " in text
    assert run("check-certificates", mine / "certificates", folder=mine.parent).returncode == 0


def test_its_law_runs_beside_pid_and_mpc_and_keeps_to_the_desired_curve(mine):
    result = run("compare", "mine2026", "--json", "compared.json", "--workers", 1, folder=mine.parent)
    assert result.returncode == 0, result.stderr
    rows = {row["controller"]: row for row in json.loads((mine.parent / "compared.json").read_text())["rows"]}
    assert list(rows) == ["adaptive_pd", "pid", "mpc"]
    assert all(row["failed"] is None for row in rows.values())
    assert -0.1 < rows["adaptive_pd"]["position_error_min"] < rows["adaptive_pd"]["position_error_max"] < 0.1


def test_it_is_swept_with_the_draws_that_its_study_states(mine):
    result = run("sweep", "mine2026", "--runs", 2, "--out", "swept", "--workers", 1, folder=mine.parent)
    assert result.returncode == 0, result.stderr
    rows = (mine.parent / "swept" / "sweep.csv").read_text().splitlines()
    assert len(rows) == 1 + 2 * 3


def test_it_is_listed_with_what_it_has_and_can_be_tuned(mine):
    listed = run("list", folder=mine.parent / "mine2026").stdout
    assert "mine2026" in listed and "claims, laws, study" in listed
    scenario = load(mine).scenario
    assert scenario.tuning.ranges.keys() == scenario.controllers.keys()


def test_another_name_is_another_paper_with_laws_of_its_own(mine):
    other = write_new_paper("other2026", mine.parent)
    assert "other2026.adaptive_pd" in (other / "laws.py").read_text()
    assert "mine2026" not in "".join((other / name).read_text() for name in FILES)


@pytest.mark.parametrize("there", ["a folder", "a file", "a dangling link"])
def test_nothing_is_overwritten(tmp_path, there):
    path = tmp_path / "mine"
    if there == "a folder":
        path.mkdir()
        (path / "laws.py").write_text("my own work")
    elif there == "a file":
        path.write_text("my own work")
    else:
        path.symlink_to(tmp_path / "nowhere")
    with pytest.raises(InputError, match="exists already"):
        write_new_paper("mine", tmp_path)
    assert [p.read_text() for p in tmp_path.rglob("*") if p.is_file()] == ([] if "link" in there else ["my own work"])
    assert not (tmp_path / "nowhere").exists()


@pytest.mark.parametrize("name", ["2020doe", "a b", "a-b", "a.b", "../a", "..", "", "class", "None", "json", "sympy",
                                  "nan", "inf", "_a", "workbench", "étude", "a\0b", "a" * 101])
def test_a_name_that_no_module_can_have_is_refused(tmp_path, name):
    with pytest.raises(InputError) as caught:
        write_new_paper(name, tmp_path)
    assert "as in doe2026" in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_a_refused_name_is_one_line(tmp_path):
    assert "as in doe2026" in one_line(run("new-paper", "2020doe", folder=tmp_path))


def test_a_folder_that_is_a_file_is_said(tmp_path):
    (tmp_path / "file").write_text("kept")
    for directory in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(InputError, match="another"):
            write_new_paper("mine", directory)
    assert (tmp_path / "file").read_text() == "kept"


@pytest.mark.parametrize("at", range(len(FILES)))
def test_a_full_disk_leaves_nothing_behind(tmp_path, monkeypatch, at):
    write, done = writing._all, []

    def full(handle, data):
        if len(done) == at:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        done.append(handle)
        write(handle, data)

    monkeypatch.setattr(writing, "_all", full)
    with pytest.raises(InputError, match="No space left"):
        write_new_paper("mine", tmp_path / "new" / "below")
    assert list(tmp_path.iterdir()) == []


def test_the_template_names_its_paper_in_every_module_and_in_its_study():
    assert [place.as_posix() for place in template_files()] == FILES
    for name in ("paper.py", "laws.py", "study.toml", Path("claims") / "section_2.py"):
        assert "$name" in (TEMPLATE / name).read_text(encoding="utf-8")
    assert not any(os.access(TEMPLATE / name, os.X_OK) for name in FILES)
