"""Inputs are regular files of bounded size: whatever else a path names is one clear line, soon."""

import json
import os
import signal
from pathlib import Path

import pytest
from refusals import refusal

from workbench.errors import InputError
from workbench.files.json_input import read_json
from workbench.files.modules import module_in, python_files
from workbench.files.regular import LARGEST_DATA, LARGEST_TEXT, TooLargeError, contents
from workbench.files.text import inputs_read, read_text
from workbench.files.toml import read_toml
from workbench.model.curve_table import read_rows
from workbench.optimal.bound_checker import main as check_bounds
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.paper.loading import load
from workbench.proof.checker import check_folder
from workbench.proof.dependencies import digest
from workbench.proof.selection import targets
from workbench.simulate.journal import Journal

READERS = {
    "TOML": (read_toml, "a.toml"), "JSON": (read_json, "a.json"), "CSV": (read_rows, "a.csv"),
    "line": (load_line, "a.toml"), "line of TTOBench": (load_line, "a.json"), "train": (load_vehicle, "a.toml"),
    "study": (load, "a.toml"), "journal": (lambda path: Journal(path, {}, resume=True), "a.jsonl"),
    "Python": (lambda path: targets([path]), "a.py"),
}


@pytest.fixture(autouse=True)
def soon():
    """A reader that waits fails, instead of waiting for ever."""
    def late(*_):
        raise TimeoutError("it waits")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(120)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def pipe(path: Path) -> None:
    os.mkfifo(path)


def endless(path: Path) -> None:
    path.symlink_to("/dev/zero")


def to_itself(path: Path) -> None:
    path.symlink_to(path)


def folder(path: Path) -> None:
    path.mkdir()


def huge(path: Path) -> None:
    with path.open("wb") as stream:
        stream.truncate(2**40)  # sparse: takes no room


@pytest.mark.parametrize("make", [pipe, endless, to_itself, folder, huge], ids=lambda make: make.__name__)
@pytest.mark.parametrize("reader", READERS)
def test_what_is_no_file_of_bounded_size_is_one_line_naming_it(reader, make, tmp_path):
    read, name = READERS[reader]
    if make is huge and reader == "Python":
        pytest.skip("is read where it is imported")
    make(tmp_path / name)
    if make is folder and reader == "study":  # a paper's folder
        assert "has no study.toml" in refusal(read, tmp_path / name)
        return
    message = refusal(read, tmp_path / name)
    assert str(tmp_path / name) in message and "\n" not in message


@pytest.mark.parametrize("name", ["a\0b.toml", "x" * 5000 + ".toml", "", "nowhere/a.toml"])
@pytest.mark.parametrize("read", [read_toml, load, lambda path: read_text(path, "CSV")])
def test_what_cannot_be_a_name_is_one_line(name, read, tmp_path):
    message = refusal(read, tmp_path / name)
    assert "\0" not in message and "\n" not in message


@pytest.mark.parametrize(("kind", "limit", "words"), [("TOML", LARGEST_TEXT, "4 MiB"), ("JSON", LARGEST_DATA, "64 MiB"),
                                                     ("CSV", LARGEST_DATA, "64 MiB")])
def test_the_limit_is_named_and_kept_to_the_byte(kind, limit, words, tmp_path):
    path = tmp_path / "a"
    with path.open("wb") as stream:
        stream.truncate(limit)
    assert len(read_text(path, kind)) == limit
    with path.open("ab") as stream:
        stream.write(b"x")
    assert words in refusal(read_text, path, kind)


def test_a_file_that_grows_while_it_is_read_ends_at_the_limit(tmp_path, monkeypatch):
    path = tmp_path / "a"
    path.write_bytes(b"x" * 11)
    small = os.stat_result((0o100600, 1, 1, 1, 0, 0, 5, 0, 0, 0))
    monkeypatch.setattr("os.fstat", lambda handle: small)
    monkeypatch.setattr(Path, "stat", lambda self, **_: small)
    with pytest.raises(TooLargeError):
        contents(path, 10)


def test_a_file_without_permission_is_named(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    path = tmp_path / "a.toml"
    path.write_text("x = 1\n")
    monkeypatch.setattr("os.open", refuse)  # file modes do not stop root, who may run the tests
    assert refusal(read_toml, path) == f"{path}: cannot be read (Permission denied): check its permissions"


def test_a_file_of_another_user_is_not_read_as_our_own(tmp_path, monkeypatch):
    path = tmp_path / "a"
    path.write_bytes(b"x")
    assert contents(path, own=True) == b"x"
    monkeypatch.setattr("os.geteuid", lambda: path.stat().st_uid + 1)
    with pytest.raises(PermissionError):
        contents(path, own=True)


def test_lines_end_by_a_line_feed_and_a_mark_is_no_text(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"\xef\xbb\xbfone\r\ntwo\rthree\n")
    assert read_text(path, "CSV") == "one\ntwo\nthree\n"
    assert path.absolute() in inputs_read()


def test_a_module_that_is_too_large_is_not_imported(tmp_path):
    huge(tmp_path / "laws.py")
    assert "larger than 4 MiB" in refusal(module_in, tmp_path, "laws")


def test_a_pipe_among_the_modules_of_a_folder_keeps_nobody_waiting(tmp_path):
    pipe(tmp_path / "laws.py")
    assert [digest(path) for path in python_files(tmp_path)] == [None]
    with pytest.raises(InputError):
        module_in(tmp_path, "laws")


@pytest.mark.parametrize("make", [pipe, endless, to_itself, folder, huge], ids=lambda make: make.__name__)
def test_the_checkers_pass_over_what_is_no_file(make, tmp_path, capsys):
    make(tmp_path / "1.json")
    assert [reason is not None for *_, reason in check_folder(tmp_path)] == [True]
    assert check_bounds([str(tmp_path / "1.json")]) == 1
    assert "INVALID" in capsys.readouterr().out


def test_a_pipe_as_manifest_names_nothing(tmp_path):
    pipe(tmp_path / "manifest.json")
    (tmp_path / "1.json").write_text(json.dumps({"claim": "x:1"}))
    assert all(reason for *_, reason in check_folder(tmp_path))
