"""A folder of rows that somebody else has made: nothing outside of it is touched, and what is no row of ours is said
in a line, however well it is signed."""

import hashlib
import json
import shutil

import pyarrow as pa
import pyarrow.parquet
import pytest
from refusals import refusal
from short_sweep import RUNS, SEED, sweep_of

from workbench.errors import InputError
from workbench.simulate.journal import _checked
from workbench.simulate.row_store import MANIFEST_NAME


@pytest.fixture
def kept(whole, tmp_path):
    return shutil.copytree(whole[0], tmp_path / "kept")


def resumed(scenario_path, out, resume=True):
    return sweep_of(scenario_path, RUNS, SEED, out=out, resume=resume, workers=1)


def signed(out, **changes):
    """The first record of a manifest changed, and its digest made to fit."""
    path = out / MANIFEST_NAME
    head, first, *others = path.read_bytes().splitlines()
    record = json.loads(first)
    del record["check"]
    path.write_bytes(b"\n".join([head, _checked(record | changes), *others]) + b"\n")


@pytest.mark.parametrize("resume", [True, False])
def test_no_chunk_is_moved_or_written_through_a_link_out_of_the_folder(kept, scenario_path, tmp_path, resume):
    elsewhere = tmp_path / "elsewhere"
    shutil.move(kept / "sweep", elsewhere)
    (kept / "sweep").symlink_to(elsewhere)
    before = {path: path.read_bytes() for path in elsewhere.iterdir()}
    assert "leads elsewhere by a link" in refusal(resumed, scenario_path, kept, resume)
    assert {path: path.read_bytes() for path in elsewhere.iterdir()} == before


@pytest.mark.parametrize("changes", [
    {"parts": None}, {"parts": [["pid", 0]]}, {"parts": [["pid", 0, 10**18]]}, {"parts": [["pid", -1, 1]]},
    {"parts": [[[], 0, 1]]}, {"chunk": "../../x"}, {"chunk": None}, {"sha256": 1}])
def test_a_record_that_is_none_is_refused_though_its_digest_fits(kept, scenario_path, changes):
    signed(kept, **changes)
    assert "is no chunk of a sweep" in refusal(resumed, scenario_path, kept)


def test_a_chunk_with_other_rows_than_the_manifest_names_is_refused(kept, scenario_path):
    """Small as a file, and of any number of rows."""
    path = kept / "sweep" / "00000.parquet"
    table = pa.parquet.read_table(path)
    bomb = pa.concat_tables([table.slice(0, 1)] * 20_000)
    for held in (bomb, table.drop_columns(["controller"])):
        pa.parquet.write_table(held, path)
        signed(kept, sha256=hashlib.sha256(path.read_bytes()).hexdigest())
        with pytest.raises(InputError, match="is no chunk of a sweep"):
            resumed(scenario_path, kept)
