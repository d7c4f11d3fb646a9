"""A paper's folder is proved as one: its claims in order, found anew when a file of it comes, goes or changes."""

import shutil
import time

import pytest
from small_folders import add_claims, small_folder, with_claims
from small_papers import document, proved

from workbench.errors import InputError
from workbench.files.modules import TICK_NS, module_in
from workbench.files.text import read_text
from workbench.proof import cache as cache_module
from workbench.proof.loading import ProofFile, claim_files
from workbench.proof.paper import papers_in


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(cache_module, "engine_digest", lambda: "these deciders")


@pytest.fixture
def paper(tmp_path):
    return with_claims(small_folder(tmp_path / "doe2030"), "section_2", "section_10")


def ids(proof):
    return [decision.claim.id for decision in proof.decisions]


def test_claims_stand_in_the_order_of_their_files_numbers_by_value(paper):
    add_claims(paper, "section_3")
    assert claim_files(paper) == ["section_2", "section_3", "section_10"]
    assert ids(proved(paper)) == ["doe2030:2", "doe2030:3", "doe2030:10"]
    assert ids(proved(paper, jobs=2, use_cache=False)) == ["doe2030:2", "doe2030:3", "doe2030:10"]
    found, = papers_in(ProofFile(paper))
    assert found.name == "doe2030" and len(found.claims) == 3


def test_files_that_begin_with_an_underscore_state_nothing(paper):
    (paper / "claims" / "_later.py").write_text("raise RuntimeError\n")
    assert ids(proved(paper)) == ["doe2030:2", "doe2030:10"]


def test_a_folder_of_claims_alone_can_be_proved(tmp_path):
    folder = tmp_path / "doe2031"
    (folder / "claims").mkdir(parents=True)
    (folder / "claims" / "all.py").write_text(
        "import sympy as sp\nfrom workbench.proof.claim import Goal, at_least\n"
        "from workbench.proof.paper import Paper\n"
        'paper = Paper("doe2031", "nobody")\nx = sp.Symbol("x", real=True)\n\n'
        '@paper.claim("1", "one", "inequality", "x", "proved")\ndef one() -> Goal:\n'
        "    return Goal((at_least(x**2, 0),))\n")
    for asked in (folder, tmp_path, folder / "claims" / "all.py"):
        assert ids(proved(asked)) == ["doe2031:1"]


@pytest.mark.parametrize("asked", ["doe2030/paper.py", "doe2030", "."])
def test_a_folder_is_named_by_itself_its_paper_or_what_it_lies_in(paper, asked):
    assert ids(proved(f"{paper.parent / asked}")) == ["doe2030:2", "doe2030:10"]
    assert ids(proved(f"{paper.parent / asked}::10")) == ["doe2030:10"]


def test_a_new_file_of_claims_is_noticed(paper):
    assert set(proved(paper).now) == {"doe2030:2", "doe2030:10"}
    assert proved(paper).now == frozenset()
    add_claims(paper, "section_3")
    again = proved(paper)
    assert ids(again) == ["doe2030:2", "doe2030:3", "doe2030:10"]
    assert again.now == {"doe2030:3"}
    (paper / "claims" / "section_2.py").unlink()
    assert ids(proved(paper)) == ["doe2030:3", "doe2030:10"]


def test_what_claims_import_from_the_folder_counts(paper):
    proved(paper)
    laws = paper / "laws.py"
    laws.write_text(laws.read_text() + "# a remark\n")
    assert proved(paper).now == frozenset()
    laws.write_text(laws.read_text().replace('"K_p K_d", positive=True', '"K_p K_d", real=True'))
    assert set(proved(paper).now) == {"doe2030:2", "doe2030:10"}
    (paper / "numbers.py").write_text("SHARE = 2\n")
    again = proved(paper)
    assert set(again.now) == {"doe2030:2", "doe2030:10"}
    assert document(again, seconds=False) == document(proved(paper, use_cache=False), seconds=False)


def test_a_changed_number_changes_the_verdict(paper):
    assert [d.verdict for d in proved(paper).decisions] == ["proved", "proved"]
    (paper / "numbers.py").write_text("SHARE = -1\n")
    assert [d.verdict for d in proved(paper).decisions] == ["refuted", "refuted"]


@pytest.mark.parametrize("when", ["imported", "asked"])
def test_only_what_a_folder_has_read_makes_it_be_imported_anew(paper, tmp_path, when):
    """Functions of its modules stay those that others hold, as worker processes are given them."""
    mine, others = tmp_path / "share.txt", tmp_path / "others.txt"
    mine.write_text("2")
    others.write_text("a")
    (paper / "numbers.py").write_text(
        "from pathlib import Path\nfrom workbench.files.text import read_text\n\n\ndef share():\n"
        f"    return int(read_text(Path({str(mine)!r}), 'number'))\n\n\n"
        f"SHARE = {'share()' if when == 'imported' else 2}\n")
    time.sleep(2 * TICK_NS / 1e9)  # what is imported at once after it was written could have changed since
    ProofFile(paper).modules()
    module = module_in(paper, "numbers")
    if when == "asked":
        module.share()
    read_text(others, "text")
    others.write_text("b")
    ProofFile(paper).modules()
    assert module_in(paper, "numbers") is module
    mine.write_text("-1")
    ProofFile(paper).modules()
    assert module_in(paper, "numbers") is not module
    assert (-1 if when == "imported" else 2) == module_in(paper, "numbers").SHARE


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_copy_is_decided_by_its_own_modules(paper, tmp_path, jobs):
    copy = tmp_path / "below" / "doe2030"
    shutil.copytree(paper, copy)
    (copy / "numbers.py").write_text("SHARE = -1\n")
    for folder, verdict in ((paper, "proved"), (copy, "refuted"), (paper, "proved")):
        assert {d.verdict for d in proved(folder, jobs=jobs, use_cache=False).decisions} == {verdict}


def test_two_folders_of_one_paper_are_not_proved_at_once(paper, tmp_path):
    copy = tmp_path / "below" / "doe2030"
    shutil.copytree(paper, copy)
    with pytest.raises(InputError, match=r"doe2030:2"):
        proved(paper, copy)


@pytest.mark.parametrize(("file", "words"), [
    ("claims/section_2.py", "line 1: NameError"), ("laws.py", "laws.py, line 1: NameError"),
    ("paper.py", "line 1: NameError")])
def test_a_mistake_is_one_line_that_names_the_file(paper, file, words):
    (paper / file).write_text("x = undeclared\n")
    with pytest.raises(InputError, match="cannot be imported") as trouble:
        proved(paper)
    assert str(trouble.value).startswith(str(paper)) and words in str(trouble.value)
    assert file.rpartition("/")[2] in str(trouble.value)


def test_a_module_that_a_folder_lacks_is_called_by_its_own_name(paper):
    (paper / "laws.py").unlink()
    (paper / "claims" / "section_2.py").write_text("from .. import laws\n")
    with pytest.raises(InputError) as imported:
        proved(paper)
    (paper / "claims" / "section_2.py").write_text("from ..laws import anything\n")
    with pytest.raises(InputError, match=r"No module named 'laws': install it, or put it beside") as missing:
        proved(paper)
    assert "workbench_folder" not in str(imported.value) + str(missing.value)
