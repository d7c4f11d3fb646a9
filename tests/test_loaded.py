"""What a path names at the command line becomes one record: a scenario, a study, a contest, or a refusal of a line."""

import dataclasses
import pickle
from multiprocessing.reduction import ForkingPickler

import pytest
from contests import COMMON
from refusals import refusal
from scenarios import PROOFS, STUDIES, name_of
from small_folders import small_folder, with_claims

from workbench.cli.loading import load
from workbench.contest.record import Contest
from workbench.errors import InputError
from workbench.paper.contents import contents_of
from workbench.paper.study import Study
from workbench.trains.scenario import Scenario


def test_a_folder_and_its_file_are_the_same(tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    one, other = load(folder), load(folder / "study.toml")
    assert one == other
    assert one.path == folder / "study.toml" and one.folder == folder and one.kind is None
    assert isinstance(one.record, Scenario) and one.scenario is one.record
    assert one.scenario.folder == folder
    with pytest.raises(dataclasses.FrozenInstanceError):
        one.path = folder


@pytest.mark.parametrize("path", STUDIES, ids=name_of)
def test_every_shipped_study_and_contest_is_one_record(path):
    loaded = load(path)
    assert isinstance(loaded.record, Study) and loaded.study is loaded.record
    assert loaded.kind is not None and isinstance(loaded.record, loaded.kind.record)
    assert loaded.study.folder == path.parent
    sent = pickle.loads(ForkingPickler.dumps(loaded))  # noqa: S301 - as it is handed to worker processes
    assert (sent.path, sent.data, sent.record) == (loaded.path, loaded.data, loaded.record)


def test_a_study_is_no_scenario_and_a_scenario_no_study(tmp_path):
    with pytest.raises(InputError, match=r"study\.toml: kind: is a study, where a scenario is needed"):
        _ = load(PROOFS / "liu2020").scenario
    with pytest.raises(InputError, match=r"study\.toml: kind: is a scenario, where a study is needed"):
        _ = load(small_folder(tmp_path / "doe2030")).study


def test_a_contest_has_its_world():
    contest = load(COMMON).record
    assert isinstance(contest, Contest)
    assert set(contest.world.controllers) > set(contest.entrants)
    assert contest.world.folder == COMMON.parent
    bare = Contest.model_validate(contest.model_dump(exclude_unset=True))
    with pytest.raises(InputError, match="load the contest from its file"):
        _ = bare.world


def test_what_is_no_such_file_is_one_line(tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    text = (folder / "study.toml").read_text()
    for kind, words in (('"tale"', "kind: 'tale' is not known: it is one of 'study', 'plant', 'contest', or left out"),
                        ('"study"', "no study/__init__.py lies beside this file with a StudyKind in it"),
                        ("3", "kind: 3 is not known"), ("[]", "kind: [] is not known")):
        (folder / "study.toml").write_text(f"kind = {kind}\n{text}")
        assert words in refusal(load, folder)
    (folder / "study").mkdir()
    (folder / "study" / "__init__.py").write_text("from .runs import KIND\n")
    (folder / "study" / "runs.py").write_text("KIND = undeclared\n")
    (folder / "study.toml").write_text(f'kind = "study"\n{text}')
    message = refusal(load, folder)
    assert message.startswith(f"{folder / 'study' / '__init__.py'}: cannot be imported: runs.py, line 1: NameError")
    (folder / "study.toml").unlink()
    assert refusal(load, folder) == (f"{folder}: has no study.toml, which states the values of its runs: write one, or "
                                     "name a TOML file")
    assert "no such file" in refusal(load, tmp_path / "nobody.toml")


def test_what_a_paper_has_is_listed_without_running_anything(tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    (folder / "laws.py").write_text("raise RuntimeError('nobody runs this')")
    assert set(contents_of(folder).parts) == {"study", "laws"}
    assert set(contents_of(with_claims(folder, "section_2")).parts) == {"claims", "study", "laws"}
    assert contents_of(folder).title == "A short run"
    shipped = {paper.name: contents_of(paper) for paper in PROOFS.iterdir() if paper.is_dir()}
    assert set(shipped["yang2021"].parts) >= {"claims", "study", "laws", "gains"}
    assert set(shipped["liu2020"].parts) >= {"claims", "study", "laws", "gains", "contest"}
    assert shipped["mao2018"].certificates > 50
