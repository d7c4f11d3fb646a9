"""What tests of sweeps begin with."""

import pytest
from short_sweep import RUNS, SEED, sweep_of, write_scenario

from workbench.simulate import parts, row_store


@pytest.fixture(scope="package")
def scenario_path(tmp_path_factory):
    return write_scenario(tmp_path_factory.mktemp("tiny"))


@pytest.fixture(scope="package")
def whole(scenario_path, tmp_path_factory):
    """The folder and rows of an uninterrupted run in one process."""
    out = tmp_path_factory.mktemp("whole")
    return out, sweep_of(scenario_path, RUNS, SEED, out=out, workers=1)


@pytest.fixture
def every_run_is_a_chunk(monkeypatch):
    monkeypatch.setattr(row_store, "CHUNK_S", 0.0)
    monkeypatch.setattr(parts, "TASK_S", 0.0)
