"""What is kept between runs is believed only where this user put it there, whole."""

import os
import resource
import stat
import sys
from pathlib import Path

import compiled_apart
import pytest

from workbench.compile import code_cache
from workbench.compile import sealed as sealed_files
from workbench.errors import CompileError
from workbench.files import cache_folder as folders
from workbench.files.cache_folder import TAG, cache_folder, drop, keep, private, temporary_folder

NAME = "workbench_kernel_of_a_test"
TEXT = """from numba import njit


@njit(cache=True)
def twice(x):
    return 2.0 * x
"""


@pytest.fixture(autouse=True)
def said_anew():
    """Notes are said once a process, and each test is to hear them."""
    folders.note.cache_clear()
    folders._fresh.cache_clear()
    yield
    os.environ.pop(folders.FRESH_VARIABLE, None)


def test_a_folder_is_made_for_this_user_alone_and_found_again(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "new" / "cache"))
    found = cache_folder("kind")
    assert found == tmp_path / "new" / "cache" / "kind" == cache_folder("kind")
    assert stat.S_IMODE(found.stat().st_mode) == 0o700
    assert (found / TAG).read_text().startswith("Signature: 8a477f597d28d172789f06886806bc55\n")
    keep(found / "deep" / "a", "x")
    assert cache_folder("kind") == found
    drop(found / "deep")
    assert [path.name for path in found.iterdir()] == [TAG]
    assert capsys.readouterr().err == ""


def test_a_folder_that_others_can_write_is_closed_to_them(tmp_path):
    found = private(tmp_path / "kind")
    found.chmod(0o777)
    assert private(found) == found
    assert stat.S_IMODE(found.stat().st_mode) == 0o700


def of_another_user(path: Path, monkeypatch) -> None:
    path.mkdir()
    monkeypatch.setattr("os.geteuid", lambda: path.stat().st_uid + 1)


def a_link(path: Path, monkeypatch) -> None:
    (path.parent / "other").mkdir()
    path.symlink_to(path.parent / "other")


def a_dangling_link(path: Path, monkeypatch) -> None:
    path.symlink_to(path.parent / "nowhere")


def with_files_of_someone(path: Path, monkeypatch) -> None:
    path.mkdir()
    (path / "mine.txt").write_text("x")


def with_another_tag(path: Path, monkeypatch) -> None:
    path.mkdir()
    (path / TAG).write_text("Signature: 8a477f597d28d172789f06886806bc55\n# of another program\n")


@pytest.mark.parametrize("make", [of_another_user, a_link, a_dangling_link, with_files_of_someone, with_another_tag],
                         ids=lambda make: make.__name__)
def test_a_folder_that_is_not_ours_is_not_used_and_not_changed(make, tmp_path, monkeypatch, capsys):
    path = tmp_path / "kind"
    make(path, monkeypatch)
    before = sorted((p.name, p.lstat().st_mode) for p in tmp_path.rglob("*"))
    assert private(path) is None
    assert sorted((p.name, p.lstat().st_mode) for p in tmp_path.rglob("*")) == before
    assert "it is not used" in capsys.readouterr().err


def test_a_file_where_the_folder_would_be_is_not_used(tmp_path):
    (tmp_path / "file").write_text("x")
    assert private(tmp_path / "file") is None
    assert private(tmp_path / "file" / "kind") is None
    assert private(tmp_path / "a\0b" / "kind") is None


def test_a_taken_name_in_the_temporary_folder_gives_a_fresh_one(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    taken = tmp_path / f"workbench-kind-{os.geteuid()}"
    assert temporary_folder("kind") == taken
    (taken / "planted.py").write_text("x")
    (taken / TAG).unlink()
    fresh = temporary_folder("kind")
    assert fresh != taken and fresh.is_relative_to(tmp_path) and not any(fresh.iterdir())
    assert stat.S_IMODE(fresh.stat().st_mode) == stat.S_IMODE(fresh.parent.stat().st_mode) == 0o700
    folders._fresh.cache_clear()  # as in a process that this one starts
    assert temporary_folder("kind") == fresh


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    """Imports a kernel as if for the first time: what it computes, how often from the cache, where it lies, notes."""
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))
    monkeypatch.delitem(sys.modules, NAME, raising=False)
    monkeypatch.setattr(compiled_apart, "kept", lambda *_: True)  # it is compiled in this process

    def imported() -> tuple[float, int, Path, str]:
        folders.note.cache_clear()
        module = code_cache.imported_kernel(NAME, TEXT)
        value, hits = module.twice(4.0), sum(module.twice.stats.cache_hits.values())
        return value, hits, Path(module.__file__), capsys.readouterr().err

    return imported


def damaged(data: bytes) -> dict[str, bytes]:
    return {"empty": b"", "cut off": data[:-7], "a bit": data[:-20] + bytes([data[-20] ^ 1]) + data[-19:],
            "another format": b"x" + data, "no seal": data[len(sealed_files.FORMAT) + 32:]}


@pytest.mark.parametrize("how", ["empty", "cut off", "a bit", "another format", "no seal"])
def test_damaged_code_is_compiled_anew_with_a_note(how, tmp_path, run):
    assert run()[:2] == (8.0, 0)
    assert run()[:2] == (8.0, 1)
    kept = [path for path in (tmp_path / "compiled-kernels").iterdir() if ".sealed-" in path.name]
    assert {path.suffix for path in kept} == {".sealed-code", ".sealed-index"}
    for path in kept:
        before = path.read_bytes()
        path.write_bytes(damaged(before)[how])
        value, hits, _, notes = run()
        assert (value, hits) == (8.0, 0) and "is damaged: it is compiled anew" in notes
        value, hits, _, notes = run()
        assert (value, hits, notes) == (8.0, 1, "")


def test_source_that_was_changed_is_not_run(run):
    file = run()[2]
    file.write_text(file.read_text().replace("2.0", "3.0"))
    value, _, _, notes = run()
    assert value == 8.0 and "is damaged: it is made anew" in notes
    assert file.read_text() == TEXT


def test_bytecode_and_code_that_only_numba_keeps_are_not_there(run):
    folder = run()[2].parent
    assert not list(folder.rglob("*.pyc")) and not list(folder.rglob("*.nb?"))


def test_a_pipe_in_the_place_of_a_kernel_keeps_nobody_waiting(run):
    file = run()[2]
    file.unlink()
    os.mkfifo(file)
    assert run()[0] == 8.0 and file.is_file()
    index = next(file.parent.glob("*.sealed-index"))
    index.unlink()
    os.mkfifo(index)
    assert run()[0] == 8.0 and index.is_file()


def test_a_folder_in_the_place_of_a_kernel_is_one_line(run):
    file = run()[2]
    file.unlink()
    file.mkdir()
    with pytest.raises(CompileError, match="cannot be written") as caught:
        run()
    assert str(file) in str(caught.value) and "\n" not in str(caught.value)


def test_a_full_disk_costs_time_and_no_result(run):
    file = run()[2]
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    for path in file.parent.glob("*.sealed-*"):
        path.unlink()
    resource.setrlimit(resource.RLIMIT_FSIZE, (300, hard))
    try:
        value, hits, _, notes = run()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert (value, hits) == (8.0, 0) and "cannot be kept" in notes
    assert not list(file.parent.glob(".workbench-*"))


def test_code_of_another_user_is_not_run(tmp_path, monkeypatch):
    sealed = tmp_path / "a.sealed-code"
    sealed_files._write(sealed, b"\x80\x04K\x07.")  # the number 7, pickled
    assert sealed_files.kept(sealed) == 7
    monkeypatch.setattr("os.geteuid", lambda: sealed.stat().st_uid + 1)
    assert sealed_files.kept(sealed) is None
