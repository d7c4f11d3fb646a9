"""No verb writes over what it reads, by whatever name, and says so before anything runs."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.errors import InputError
from workbench.files.outputs import check_outputs
from workbench.files.text import read_text

ROOT = Path(__file__).parents[2]
LINE, TRAIN = ROOT / "benchmarks" / "lines" / "hills.toml", ROOT / "benchmarks" / "trains" / "yang2021.toml"


def names_of(path: Path) -> dict[str, Path]:
    """Names by which one file is known: its own, around a corner, a link, a link to its folder, a hard link."""
    folder = path.parent
    (folder / "inner").mkdir()
    (folder / "link").symlink_to(path)
    (folder / "way").symlink_to(folder)
    os.link(path, folder / "hard")
    return {"itself": path, "relative": Path(os.path.relpath(path)), "around": folder / "inner" / ".." / path.name,
            "link": folder / "link", "through a link": folder / "way" / path.name, "hard link": folder / "hard"}


@pytest.mark.parametrize("name", ["itself", "relative", "around", "link", "through a link", "hard link"])
def test_an_input_is_known_by_every_name(name, tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("x")
    other = names_of(path)[name]
    assert "is an input" in refusal(check_outputs, {"--csv": other}, [path])
    assert "is an input" in refusal(check_outputs, {"--csv": path}, [other])
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "rows.csv").symlink_to(other.absolute())
    assert "is an input" in refusal(lambda: check_outputs({}, [path], {"--out": (tmp_path / "out", ("rows.csv",))}))
    assert path.read_text() == "x"


def test_what_has_been_read_is_an_input(tmp_path):
    path = tmp_path / "read.json"
    path.write_text("{}")
    check_outputs({"--json": path})
    read_text(path, "JSON")
    assert "is an input" in refusal(check_outputs, {"--json": path})


@pytest.mark.parametrize("suffix", [".py", ".toml", ".TOML"])
def test_no_output_is_a_file_that_only_inputs_are(suffix, tmp_path):
    path = tmp_path / f"a{suffix}"
    check_outputs({"--json": path})
    path.write_text("x")
    assert "which no output is" in refusal(check_outputs, {"--json": path})


@given(st.lists(st.sampled_from(["a", "b", "./a", "sub/../b", "c"]), min_size=2, max_size=4))
def test_two_outputs_are_never_one_file(tmp_path_factory, names):
    folder = tmp_path_factory.getbasetemp()
    files = {f"--{n}": folder / name for n, name in enumerate(names)}
    distinct = len({os.path.realpath(path) for path in files.values()}) == len(names)
    try:
        check_outputs(files)
        assert distinct
    except InputError:
        assert not distinct


def test_places_that_cannot_be_written_are_named_before_anything_runs(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("x")
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    for path in (tmp_path, tmp_path / "file" / "a.json", tmp_path / "loop", tmp_path / "a\0b", tmp_path / ("x" * 300)):
        assert refusal(check_outputs, {"--json": path}).count("--json") == 1
    for path in (tmp_path / "file", tmp_path / "file" / "sub", tmp_path / "loop", tmp_path / "a\0b"):
        assert "--out" in refusal(lambda path=path: check_outputs({}, folders={"--out": (path, ())}))
    monkeypatch.setattr("os.access", lambda *_: False)  # file modes do not stop root, who may run the tests
    assert "may not be written" in refusal(check_outputs, {"--json": tmp_path / "a.json"})
    assert "may not be written" in refusal(check_outputs, {"--json": tmp_path / "file"})


def test_streams_are_no_files(tmp_path):
    check_outputs({"--json": Path("/dev/stdout"), "--csv": Path("/dev/null"), "--figure": Path("/dev/stdout")})


# --- every verb ----------------------------------------------------------------------------------------------------


@pytest.fixture
def paper(tmp_path, monkeypatch):
    """A paper of one's own, new, as the current folder's."""
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["new-paper", "doe2026"])
    assert done.exit_code == 0, done.output
    for name, source in (("line.toml", LINE), ("train.toml", TRAIN)):
        (tmp_path / name).write_text(source.read_text())
    (tmp_path / "times.toml").write_text("x = 1\n")
    (tmp_path / "a_file").write_text("x")
    (tmp_path / "full").mkdir()
    for name in ("report.html", "sweep.csv", "matches.journal.jsonl", "sweep.manifest.jsonl"):
        os.link(tmp_path / "doe2026" / "study.toml", tmp_path / "full" / name)
    return tmp_path


REFERENCE = ("reference", "line.toml", "train.toml", "--time", "2600")
REFUSED = {
    "prove over the claims": ("prove", "doe2026", "--json", "doe2026/paper.py"),
    "prove over a law": ("prove", "doe2026", "--json", "doe2026/laws.py"),
    "prove over the study": ("prove", "doe2026", "--json", "doe2026/study.toml"),
    "prove a single file over itself": ("prove", "doe2026/paper.py", "--json", "doe2026/paper.py"),
    "prove among certificates": ("prove", "doe2026", "--json", "doe2026/certificates/all.json"),
    "prove into a file": ("prove", "doe2026", "--certificates", "a_file"),
    "compare over the study": ("compare", "doe2026", "--json", "doe2026/study.toml"),
    "compare over a law": ("compare", "doe2026", "--json", "doe2026/laws.py"),
    "compare with runs in a file": ("compare", "doe2026", "--out", "a_file"),
    "compare with runs over the study": ("compare", "doe2026", "--out", "full"),
    "sweep into a file": ("sweep", "doe2026", "--out", "a_file"),
    "sweep over the study": ("sweep", "doe2026", "--out", "full"),
    "report into a file": ("report", "doe2026", "--out", "a_file"),
    "report into the paper": ("report", "doe2026", "--out", "doe2026"),
    "report over the study": ("report", "doe2026", "--out", "full"),
    "gains over the study": ("gains", "doe2026", "--json", "doe2026/study.toml"),
    "gains into a file": ("gains", "doe2026", "--certificates", "a_file"),
    "gains among certificates": ("gains", "doe2026", "--write", "--json", "doe2026/certificates/gains/g.json"),
    "reference over the line": (*REFERENCE, "--json", "line.toml"),
    "reference over the train": (*REFERENCE, "--figure", "train.toml"),
    "reference over the timetable": ("reference", "line.toml", "train.toml", "--timetable", "times.toml", "--json",
                                     "times.toml"),
    "reference by a certificate": (*REFERENCE, "--certificate", "line.toml"),
    "reference by a table": (*REFERENCE, "--csv", "line.toml"),
    "reference by the table beside": (*REFERENCE, "--json", "r.csv"),
    "reference by the cars' table": (*REFERENCE, "--csv", "r.csv", "--json", "r_cars.csv"),
    "reference by the couplers": (*REFERENCE, "--figure", "r.svg", "--certificate", "r_couplers.svg"),
    "reference twice": (*REFERENCE, "--json", "r.json", "--certificate", "./r.json"),
    "examples into a file": ("examples", "a_file"),
    "examples into a full folder": ("examples", "full"),
    "new-paper over a paper": ("new-paper", "doe2026"),
    "new-paper into a file": ("new-paper", "doe2027", "--out", "a_file"),
}


SAID = ("it would be overwritten", "is a file", "Not a directory", "name another folder", "name a folder",
        "lies among the certificates", "exists already", "is not empty")


def everything(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and "__pycache__" not in path.parts}


@pytest.mark.parametrize("arguments", REFUSED.values(), ids=REFUSED)
def test_every_verb_refuses_before_anything_runs(arguments, paper):
    before = everything(paper)
    done = CliRunner().invoke(app, [str(a) for a in arguments])
    assert isinstance(done.exception, InputError), done.output
    message = str(done.exception)
    assert any(words in message for words in SAID) and "\n" not in message, message
    assert everything(paper) == before


EVIL = """
import sympy as sp
from workbench.proof.claim import Goal, equal
from workbench.proof.paper import Paper
x = sp.Symbol("x", real=True)
paper = Paper("NAME", "a citation")
@paper.claim("NUMBER", "a title", "identity", "x", "proved")
def one():
    return Goal((equal(x, x),))
"""


@pytest.mark.parametrize(("name", "number"), [("..", "1"), ("doe2026", "../../mine"), ("/tmp", "1"), ("a/../..", "1"),
                                              ("doe2026", "manifest")])
def test_a_paper_named_like_a_path_writes_and_deletes_nothing(name, number, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.json").write_text("{}")
    (tmp_path / "evil.py").write_text(EVIL.replace("NAME", name).replace("NUMBER", number))
    before = everything(tmp_path)
    done = CliRunner().invoke(app, ["prove", "evil.py", "--jobs", "1", "--no-cache"])
    assert isinstance(done.exception, InputError) and "claim id" in str(done.exception)
    assert everything(tmp_path) == before


def test_a_pipe_as_an_input_of_any_verb_is_one_line(paper):
    os.mkfifo("pipe.toml")
    os.mkfifo("pipe.py")
    for arguments in (("prove", "pipe.py"), ("compare", "pipe.toml"), ("sweep", "pipe.toml", "--out", "o"),
                      ("report", "pipe.toml"), ("tune", "pipe.toml"), ("gains", "pipe.toml"),
                      ("reference", "pipe.toml", "train.toml"), ("reference", "line.toml", "pipe.toml")):
        done = CliRunner().invoke(app, list(arguments))
        assert isinstance(done.exception, InputError), arguments
        assert "pipe." in str(done.exception)
