"""What is written is whole or not there, and stands in the folder that was asked for."""

import os
import resource
import stat
import subprocess
from contextlib import contextmanager
from pathlib import Path, PurePath

import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal

from workbench.files.json_output import write_json
from workbench.files.writing import make_folder, require_inside, write_bytes, write_text, write_tree
from workbench.proof.cache import decision_cache
from workbench.simulate.journal import FORMAT, Journal

OLD = "what stood there\n"


@contextmanager
def files_up_to(count: int):
    """Files may not grow beyond so many bytes, as on a disk that is full."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (count, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@given(before=st.none() | st.binary(max_size=50), data=st.binary(max_size=200))
def test_a_file_holds_what_was_written(before, data):
    import tempfile

    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "sub" / "a"
        if before is not None:
            path.parent.mkdir()
            path.write_bytes(before)
        write_bytes(path, data)
        assert path.read_bytes() == data
        assert [p.name for p in path.parent.iterdir()] == ["a"]


def test_a_new_file_has_the_mode_of_any_other_and_an_old_one_keeps_its_own(tmp_path):
    plain, ours = tmp_path / "plain", tmp_path / "ours"
    plain.write_text("x")
    write_text(ours, "x")
    assert ours.stat().st_mode == plain.stat().st_mode
    ours.chmod(0o640)
    write_text(ours, "y")
    assert stat.S_IMODE(ours.stat().st_mode) == 0o640


@pytest.mark.parametrize("write", [
    lambda path: write_text(path, "x" * 10_000), lambda path: write_json(path, {"x": "x" * 10_000}),
])
def test_a_full_disk_is_one_line_and_leaves_what_stood_there(write, tmp_path):
    path = tmp_path / "a.json"
    path.write_text(OLD)
    with files_up_to(1000):
        message = refusal(write, path)
    assert message.startswith(f"{path}: cannot be written (")
    assert path.read_text() == OLD
    assert [p.name for p in tmp_path.iterdir()] == ["a.json"]


@pytest.fixture
def full(tmp_path):
    """A folder on a disk of a few pages; skipped where none can be mounted."""
    place = tmp_path / "disk"
    place.mkdir()
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", place], capture_output=True, check=False)
    if done.returncode:
        pytest.skip("no disk can be mounted here: RLIMIT_FSIZE stands for it in other tests")
    yield place
    subprocess.run(["umount", place], check=True)


def test_a_disk_that_is_really_full(full):
    path = full / "a"
    path.write_text(OLD)
    assert "No space left" in refusal(write_text, path, "x" * 100_000)
    assert path.read_text() == OLD
    assert [p.name for p in full.iterdir()] == ["a"]


def test_a_journal_on_a_full_disk_keeps_its_whole_records(tmp_path):
    path = tmp_path / "j.jsonl"
    with Journal(path, {"a": 1}, resume=False) as journal:
        journal.append({"n": 1})
        with files_up_to(path.stat().st_size + 20):
            assert "cannot be used as a journal" in refusal(journal.append, {"n": "x" * 100})
        journal.append({"n": 2})
    with Journal(path, {"a": 1}, resume=True) as journal:
        assert journal.records == [{"n": 1}, {"n": 2}]


def test_a_cache_on_a_full_disk_costs_time_and_no_result(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))
    cached = decision_cache()
    with files_up_to(10):
        cached.keep_file(tmp_path / "p.py", type("Entry", (), {"papers": 1, "decisions": ()})(), (), 0)
    assert cached.file(tmp_path / "p.py") is None


BAD_PLACES = {
    "below a file": lambda folder: folder / "file" / "a.json",
    "a folder": lambda folder: folder / "sub",
    "a loop of links": lambda folder: folder / "loop" / "a.json",
    "no path": lambda folder: folder / "a\0b",
    "too long a name": lambda folder: folder / ("x" * 300),
    "a pipe that nobody reads": lambda folder: folder / "pipe",
}


@pytest.mark.parametrize("place", BAD_PLACES.values(), ids=BAD_PLACES)
def test_what_cannot_be_written_is_one_line(place, tmp_path):
    (tmp_path / "file").write_text(OLD)
    (tmp_path / "sub").mkdir()
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    os.mkfifo(tmp_path / "pipe")
    before = sorted(p.name for p in tmp_path.iterdir())
    refusal(write_text, place(tmp_path), "x")
    assert sorted(p.name for p in tmp_path.iterdir()) == before
    assert (tmp_path / "file").read_text() == OLD


def test_a_link_is_replaced_and_not_written_through(tmp_path):
    (tmp_path / "other").write_text(OLD)
    (tmp_path / "a").symlink_to(tmp_path / "other")
    write_text(tmp_path / "a", "new")
    assert (tmp_path / "other").read_text() == OLD
    assert (tmp_path / "a").read_text() == "new"


def test_the_shells_output_is_written_as_it_is(tmp_path):
    before = Path("/dev/null").stat()
    write_text(Path("/dev/null"), "x")
    assert Path("/dev/null").stat().st_rdev == before.st_rdev
    reading = os.open(os.devnull, os.O_RDONLY)
    os.close(reading)
    out, into = os.pipe()
    write_text(Path(f"/dev/fd/{into}"), "text\n")
    assert os.read(out, 100) == b"text\n"
    os.close(out)
    os.close(into)


def test_no_link_leads_out_of_a_folder(tmp_path):
    (tmp_path / "asked").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "asked" / "inner").symlink_to(tmp_path / "elsewhere")
    for place in ("inner", "inner/new", "../elsewhere"):
        assert "link" in refusal(make_folder, tmp_path / "asked" / place, tmp_path / "asked")
    assert "outside" in refusal(require_inside, tmp_path / "elsewhere", tmp_path / "asked")
    assert not any((tmp_path / "elsewhere").iterdir())
    (tmp_path / "link").symlink_to(tmp_path / "asked")  # the folder asked for may be a link itself
    make_folder(tmp_path / "link" / "new", tmp_path / "link")
    assert (tmp_path / "asked" / "new").is_dir()


def test_of_a_tree_all_is_written_or_nothing(tmp_path):
    folder = tmp_path / "a" / "b"
    files = {PurePath("x.txt"): b"x", PurePath("deep/y.txt"): b"y", PurePath("z.txt"): b"z" * 5000}
    with files_up_to(1000):
        refusal(write_tree, folder, files)
    assert not any(tmp_path.iterdir())
    write_tree(folder, files)
    assert {PurePath(p.relative_to(folder)) for p in folder.rglob("*.txt")} == set(files)
    (folder / "z.txt").write_text(OLD)
    (folder / "x.txt").unlink()
    assert "exists already" in refusal(write_tree, folder, files)
    assert (folder / "z.txt").read_text() == OLD and not (folder / "x.txt").exists()


@pytest.mark.parametrize("resume", [True, False])
@pytest.mark.parametrize("text", ["mine, without an end of line", "mine\n", '{"format": "other"}\n'])
def test_a_file_of_someone_elses_where_a_journal_goes_is_kept(text, resume, tmp_path, capsys):
    path = tmp_path / "j.jsonl"
    path.write_text(text)
    if resume:
        assert "is not a journal" in refusal(Journal, path, {}, True)
        assert path.read_text() == text
        return
    Journal(path, {}, resume=False).close()
    assert path.with_name("j.jsonl.before").read_text() == text
    Journal(path, {"job": 2}, resume=False).close()  # a second time nothing is lost either
    assert path.with_name("j.jsonl.before").read_text() == text
    assert path.with_name("j.jsonl.before2").read_text().startswith('{"format": "workbench journal')
    assert capsys.readouterr().err.count("--resume") == 2


def test_a_journal_is_not_written_through_a_link(tmp_path):
    (tmp_path / "other").write_text("")
    (tmp_path / "j.jsonl").symlink_to(tmp_path / "other")
    refusal(Journal, tmp_path / "j.jsonl", {}, True)
    Journal(tmp_path / "j.jsonl", {}, resume=False).close()
    assert (tmp_path / "other").read_text() == ""
    assert FORMAT in (tmp_path / "j.jsonl").read_text()
