"""A law's name leads to the law of that folder, of that paper or in that file, and to no other."""

import shutil
from pathlib import Path

import pytest
from refusals import changed, refusal
from scenarios import LAWS, PROOFS
from small_folders import small_folder, small_scenario
from test_cli import LINE

from workbench.cli.loading import load
from workbench.errors import InputError
from workbench.files.modules import module_in, package_of
from workbench.model.law import ControlLaw, desired_position
from workbench.model.laws import law_named, laws_near
from workbench.model.pid import pid
from workbench.simulate.controllers import compiled_law
from workbench.simulate.law_values import check_controllers
from workbench.simulate.sweep import sweep
from workbench.trains.scenario import load_scenario

OWN = '''
from workbench.model.law import ControlLaw, desired_position, desired_speed, position, speed
import sympy as sp
K_p, K_d = sp.symbols("K_p K_d", positive=True)
mine = ControlLaw("mine", "mine", "nobody", "full state, model unknown",
                  K_p * (desired_position - position) + K_d * (desired_speed - speed), parameters=(K_p, K_d))
other = 3
'''


@pytest.fixture
def paper(tmp_path: Path) -> Path:
    return small_folder(tmp_path / "doe2030")


def share_of(law: ControlLaw | None) -> object:
    """The factor by which the small law's gain is multiplied."""
    assert law is not None
    K_p = next(s for s in law.parameters if str(s) == "K_p")
    return law.command.expand().coeff(K_p * desired_position)


def test_a_papers_law_is_found_from_the_folder_beside_it_and_below(paper, tmp_path):
    law = law_named("doe2030.pd", paper)
    assert law is not None and law.id == "doe2030.pd" and share_of(law) == 1
    (tmp_path / "other2031").mkdir()
    assert law_named("doe2030.pd", tmp_path / "other2031") is law
    (tmp_path / "elsewhere" / "below").mkdir(parents=True)
    assert law_named("doe2030.pd", tmp_path / "elsewhere" / "below") is None
    small_folder(tmp_path / "elsewhere" / "proofs" / "doe2030", share=5)
    (tmp_path / "elsewhere" / "below2").mkdir()
    assert share_of(law_named("doe2030.pd", tmp_path / "elsewhere" / "below2")) == 5


def test_pid_is_nobodys_and_no_folder_can_take_its_name(paper):
    (paper / "laws.py").write_text((paper / "laws.py").read_text().replace('"doe2030.pd"', '"pid"'))
    assert law_named("pid", paper) is pid


def test_every_shipped_law_is_found_by_its_id():
    assert len(LAWS) >= 14
    for name, law in LAWS.items():
        assert law_named(name, PROOFS / "yang2021") is law


def test_a_copy_under_another_name_keeps_the_names_of_its_laws_and_has_its_own(paper, tmp_path):
    copy = tmp_path / "mine2032"
    shutil.copytree(paper, copy)
    (copy / "numbers.py").write_text("SHARE = 7\n")
    assert share_of(law_named("doe2030.pd", copy)) == 7
    assert share_of(law_named("mine2032.pd", copy)) == 7
    assert share_of(law_named("doe2030.pd", paper)) == 1
    scenario = load(copy).scenario
    check_controllers(scenario)
    assert share_of(compiled_law(scenario, scenario.controllers["own"])) == 7


def test_two_folders_with_laws_of_one_name_are_not_taken_for_each_other(tmp_path):
    one, two = small_folder(tmp_path / "a" / "doe2030"), small_folder(tmp_path / "b" / "doe2030", share=3)
    assert package_of(one) != package_of(two)
    assert module_in(one, "laws") is not module_in(two, "laws")
    assert (share_of(law_named("doe2030.pd", one)), share_of(law_named("doe2030.pd", two))) == (1, 3)
    for folder, share in ((one, 1), (two, 3)):
        scenario = load(folder).scenario
        assert share_of(compiled_law(scenario, scenario.controllers["own"])) == share


@pytest.mark.parametrize("law", ["own.py::mine", "laws/own.py::mine", "../own.py::mine"])
def test_a_law_of_a_file_is_looked_up_from_the_file_that_names_it(law, tmp_path):
    folder = tmp_path / "scenarios"
    folder.mkdir()
    place = folder / law.partition("::")[0]
    place.parent.mkdir(exist_ok=True)
    place.write_text(OWN)
    (folder / "line.toml").write_text(LINE)
    (folder / "s.toml").write_text(small_scenario(law))
    scenario = load_scenario(folder / "s.toml")
    check_controllers(scenario, folder / "s.toml")
    found = compiled_law(scenario, scenario.controllers["own"])
    assert found is not None and found.title == "mine"


@pytest.mark.parametrize(("law", "words"), [
    ("missing.py::mine", "study.toml: controllers.own.law: 'missing.py::mine' names "),
    ("own.py::nothing", "own.py: nothing: is no ControlLaw of this file"),
    ("own.py::other", "own.py: other: is no ControlLaw of this file"),
    ("own.py::__class__.mine", "is no ControlLaw of this file"),
    ("own.txt::mine", "no such Python file"),
    ("bad-name.py::mine", "cannot be imported: name the file with letters, digits and underscores"),
    ("broken.py::mine", "broken.py: cannot be imported: line 2: NameError"),
    ("doe2030.nothing", "controllers.own.law: unknown 'doe2030.nothing': choose one of pid"),
    ("mpc.linaer", "did you mean 'mpc.linear'"),
    ("nobody2020.pd", "unknown 'nobody2020.pd': choose one of pid, "),
    ("", "law"),
])
def test_a_name_that_leads_nowhere_is_one_line_with_a_remedy(law, words, paper):
    for name, text in (("own", OWN), ("bad-name", OWN), ("broken", "x = 1\ny = undeclared\n")):
        (paper / f"{name}.py").write_text(text)
    (paper / "study.toml").write_text(small_scenario(law))
    message = refusal(lambda: check_controllers(load_scenario(paper / "study.toml"), paper / "study.toml"))
    assert words in message and str(paper) in message


def test_a_mistake_in_laws_is_one_line_that_names_file_and_line(paper):
    (paper / "laws.py").write_text(changed((paper / "laws.py").read_text(), "K_p * (", "K_q * ("))
    message = refusal(law_named, "doe2030.pd", paper)
    assert message.startswith(f"{paper / 'laws.py'}: cannot be imported: line ")
    assert "name 'K_q' is not defined" in message
    # Where another folder's laws are only listed for a message, its mistake is not this one's.
    (paper.parent / "other2031").mkdir()
    assert "pid" in laws_near(paper.parent / "other2031")


def test_worker_processes_find_the_laws_too(paper):
    (paper / "own.py").write_text(OWN)
    text = small_scenario()
    own = text[text.index("[controllers.own]"):text.index("[uncertainty]")]
    mine = own.replace("controllers.own", "controllers.mine").replace("doe2030.pd", "own.py::mine")
    (paper / "study.toml").write_text(text.replace(own, own + mine))
    loaded = load(paper)
    assert list(loaded.scenario.controllers) == ["good", "own", "mine"]
    one, several = (sweep(loaded.scenario, loaded.path, 1, 1, ["own", "mine"], workers=workers) for workers in (1, 2))
    assert one == several
    assert [row.failed for row in one] == [None, None]


def test_a_file_outside_of_any_paper_names_the_papers_it_means(paper, tmp_path):
    (tmp_path / "line.toml").write_text(LINE)
    (tmp_path / "proofs").mkdir()
    paper.rename(tmp_path / "proofs" / "doe2030")
    (tmp_path / "s.toml").write_text(small_scenario())
    scenario = load_scenario(tmp_path / "s.toml")
    check_controllers(scenario)
    with pytest.raises(InputError, match=r"unknown 'doe2030.p'.*doe2030\.pd"):
        check_controllers(load(_written(tmp_path / "t.toml", small_scenario("doe2030.p"))).scenario)


def _written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path
