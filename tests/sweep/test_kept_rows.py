"""Rows that are kept: an interruption loses none, damage is found, and another sweep is not taken for this one."""

import hashlib
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pandas
import pytest
from scenarios import ROOT
from short_sweep import RUNS, SEED, sweep_of, write_scenario

from workbench.errors import InputError
from workbench.simulate import parts, row_store
from workbench.simulate.row_store import MANIFEST_NAME


def chunks_written(folder: Path) -> list[dict]:
    return [json.loads(line) for line in (folder / MANIFEST_NAME).read_text().splitlines()[1:]]


def rows_kept(folder: Path) -> int:
    """How many rows the manifest names."""
    return sum(count for chunk in chunks_written(folder) for _, _, count in chunk["parts"])


def test_chunks_are_parquet_that_others_read_in_a_line(whole):
    out, rows = whole
    table = pandas.read_parquet(out / "sweep").sort_values(["run", "controller"])
    assert len(table) == len(rows) and set(table["controller"]) == {"pocrac", "narrow", "pid"}
    stops = {(row.run, row.controller): row.stopping_error for row in rows}
    for row in table.itertuples():
        assert stops[row.run, row.controller] in (row.stopping_error, None)
    record = chunks_written(out)[0]
    assert record["sha256"] == hashlib.sha256((out / "sweep" / "00000.parquet").read_bytes()).hexdigest()


def test_an_interruption_at_any_run_loses_none_of_the_others(whole, scenario_path, tmp_path, every_run_is_a_chunk):
    for stop_at in (1, 4, 8):
        def stop(done, total, stop_at=stop_at):
            if done == stop_at:
                raise KeyboardInterrupt

        out = tmp_path / str(stop_at)
        with pytest.raises(KeyboardInterrupt):
            sweep_of(scenario_path, RUNS, SEED, out=out, workers=1, on_progress=stop)
        assert not (out / "sweep.csv").exists()
        assert rows_kept(out) == stop_at
        fresh = []
        sweep_of(scenario_path, RUNS, SEED, out=out, resume=True, workers=1,
                 on_progress=lambda *one, fresh=fresh: fresh.append(one))
        assert len(fresh) == 9 - stop_at
        assert (out / "sweep.csv").read_bytes() == (whole[0] / "sweep.csv").read_bytes()


DAMAGE = {
    "a changed digit in a chunk": lambda out: changed(out / "sweep" / "00002.parquet", 90),
    "half a chunk": lambda out: cut(out / "sweep" / "00001.parquet"),
    "an empty chunk": lambda out: (out / "sweep" / "00000.parquet").write_bytes(b""),
    "a chunk that is gone": lambda out: (out / "sweep" / "00003.parquet").unlink(),
    "one chunk in the place of another": lambda out: (out / "sweep" / "00001.parquet").write_bytes(
        (out / "sweep" / "00002.parquet").read_bytes()),
    "a changed digit in the manifest": lambda out: changed(out / MANIFEST_NAME, -40),
    "a record twice": lambda out: (out / MANIFEST_NAME).write_text(
        (out / MANIFEST_NAME).read_text() + (out / MANIFEST_NAME).read_text().splitlines(keepends=True)[-1]),
    "half a record": lambda out: cut(out / MANIFEST_NAME),
    "a record of something else": lambda out: (out / MANIFEST_NAME).write_text(
        (out / MANIFEST_NAME).read_text() + '{"run": NaN}\n[1]\nnot json\n'),
}


def changed(path: Path, place: int) -> None:
    data = bytearray(path.read_bytes())
    data[place] ^= 1
    path.write_bytes(data)


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


@pytest.fixture(scope="module")
def in_chunks(scenario_path, tmp_path_factory):
    """The folder of a sweep of which every run is a chunk."""
    out = tmp_path_factory.mktemp("chunks")
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(row_store, "CHUNK_S", 0.0)
        patched.setattr(parts, "TASK_S", 0.0)
        sweep_of(scenario_path, RUNS, SEED, out=out, workers=1)
    (out / "sweep.csv").unlink()
    assert len(chunks_written(out)) == 9
    return out


@pytest.mark.parametrize("damage", DAMAGE)
def test_what_was_damaged_is_found_by_its_digest_and_made_again(whole, in_chunks, scenario_path, tmp_path, capsys,
                                                                damage):
    shutil.copytree(in_chunks, tmp_path, dirs_exist_ok=True)
    DAMAGE[damage](tmp_path)
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, resume=True, workers=1)
    assert (tmp_path / "sweep.csv").read_bytes() == (whole[0] / "sweep.csv").read_bytes()
    rows = pandas.concat(map(pandas.read_parquet, sorted((tmp_path / "sweep").glob("*.parquet"))))
    assert len(rows) == 9, "what readers of sweep/*.parquet see has no row twice"
    assert damage == "half a record" or "note:" in capsys.readouterr().err


def test_a_finished_sweep_serves_fewer_and_more_runs(whole, scenario_path, tmp_path):
    _, rows = whole
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, workers=1)
    assert sweep_of(scenario_path, 2, SEED, ["pid"], tmp_path, resume=True) == [
        row for row in rows if row.controller == "pid" and row.run < 2]
    more = sweep_of(scenario_path, RUNS + 1, SEED, ["pid"], tmp_path, resume=True, workers=1)
    assert [row.run for row in more] == [0, 1, 2, 3]


def test_a_sweep_of_something_else_is_refused_with_a_remedy(whole, scenario_path, tmp_path):
    manifest = tmp_path / MANIFEST_NAME
    manifest.write_bytes((whole[0] / MANIFEST_NAME).read_bytes())
    with pytest.raises(InputError, match=r"seed 7, not 8.*without resume"):
        sweep_of(scenario_path, RUNS, SEED + 1, out=tmp_path, resume=True)
    folder = tmp_path / "other"
    folder.mkdir()
    other = write_scenario(folder)
    line = folder / "line.toml"
    line.write_text(line.read_text().replace("grade_permille = 2.0", "grade_permille = 3.0"))
    with pytest.raises(InputError, match=r"values, line and code.*without resume"):
        sweep_of(other, RUNS, SEED, out=tmp_path, resume=True)
    for text in ("not json\n", '{"a": 1}\n', "[1]\n"):
        manifest.write_text(text)
        with pytest.raises(InputError, match="without resume"):
            sweep_of(scenario_path, RUNS, SEED, out=tmp_path, resume=True)


def test_starting_anew_keeps_the_old_sweep_beside(whole, scenario_path, tmp_path):
    sweep_of(scenario_path, 1, SEED, ["pid"], tmp_path, workers=1)
    before = {path: path.read_bytes() for path in (tmp_path / MANIFEST_NAME, tmp_path / "sweep" / "00000.parquet")}
    sweep_of(scenario_path, 2, SEED, ["pid"], tmp_path, workers=1)
    for path, data in before.items():
        assert path.with_name(path.name + ".before").read_bytes() == data != path.read_bytes()


def test_a_second_writer_is_turned_away_in_a_line(scenario_path, tmp_path):
    script = ("import sys; from pathlib import Path; from workbench.files.folder_lock import FolderLock\n"
              "FolderLock(Path(sys.argv[1])); print('held', flush=True); sys.stdin.read()")
    with subprocess.Popen([sys.executable, "-c", script, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          cwd=ROOT) as other:
        assert other.stdout.readline() == b"held\n"
        for resume in (True, False):
            with pytest.raises(InputError, match="another command writes its results here"):
                sweep_of(scenario_path, 1, SEED, ["pid"], tmp_path, resume=resume)
        other.kill()
    sweep_of(scenario_path, 1, SEED, ["pid"], tmp_path, workers=1)


READS = """
import os
from pyarrow import BufferReader, py_buffer
from pyarrow.parquet import ParquetFile
from workbench.simulate.row_store import _parquet, _rows_of
columns, rows = {"run": "int", "error": "float"}, [(number, 0.5) for number in range(4)]
chunk = ParquetFile(BufferReader(py_buffer(_parquet([rows], columns))))
before = len(os.listdir("/proc/self/task"))
assert _rows_of(chunk, 0, 4, columns) == rows
assert len(os.listdir("/proc/self/task")) == before, "threads were started"
"""


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="threads are counted in /proc")
def test_reading_rows_starts_no_thread():
    """With pyarrow's threads still there as it ended, a finished sweep now and then aborted with exit code 134."""
    found = subprocess.run([sys.executable, "-c", READS], cwd=ROOT, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stderr
