"""A sample of benchmarks/faults.py: what is killed, interrupted, or finds its disk full goes on to the same bytes."""

import random
import signal
import sys
import time

import pytest
from command_line import one_line, run
from scenarios import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
from faults import Bench, full_disk, instants, trouble_of
from long_jobs import jobs

import workbench.proof.worker  # noqa: F401 - forked processes need not import it

JOBS = jobs(workers=1)


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    """Its processes are forks of this one, after it has imported and compiled what they need."""
    made = Bench(tmp_path_factory.mktemp("faults"), by_fork=True, left_s=300.0)  # a busy machine may take long
    folder = made.fresh(JOBS["sweep"])
    assert run("sweep", ".", "--runs", 1, "--out", "once", "--workers", 1, folder=folder).returncode == 0
    return made


@pytest.fixture(scope="module")
def whole(bench):
    """What an uninterrupted sweep makes, and how long it takes."""
    return bench.whole(JOBS["sweep"])


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_a_sweep_that_is_stopped_anywhere_goes_on_to_the_same_bytes(bench, whole, how):
    made, seconds = whole
    [after] = instants(random.Random(how), 1, seconds)
    assert trouble_of(bench, JOBS["sweep"], made, after, how) == ""


def test_so_does_a_proof_that_is_killed(bench):
    made, seconds = bench.whole(JOBS["prove"])
    [after] = instants(random.Random(1), 1, seconds)
    assert trouble_of(bench, JOBS["prove"], made, after, signal.SIGKILL) == ""


def test_a_sweep_on_a_full_disk_ends_in_a_line_and_goes_on_once_there_is_room(bench, whole):
    found = full_disk(bench, JOBS["sweep"], whole[0])
    if found is None:
        pytest.skip("no tmpfs can be mounted here")
    assert found == ""


def test_a_folder_that_cannot_be_written_is_named(bench):
    folder = bench.fresh(JOBS["sweep"])
    said = one_line(run("sweep", ".", "--runs", 1, "--out", "/proc/here", folder=folder))
    assert said.startswith("workbench: /proc/here") and said.endswith("name another place")


def test_a_clock_that_steps_back_changes_nothing(bench, whole, monkeypatch):
    now = time.time()
    monkeypatch.setattr(time, "time", lambda: (steps.append(0), now - 3600 * len(steps))[1])
    monkeypatch.setattr(time, "time_ns", lambda: int(time.time() * 1e9))
    steps: list[int] = []
    folder = bench.fresh(JOBS["sweep"])
    line = JOBS["sweep"].begin.split()
    assert run(*["20" if word == "60" else word for word in line], folder=folder).returncode == 0
    assert run(*line, "--resume", folder=folder).returncode == 0
    assert JOBS["sweep"].result(folder) == whole[0]
    assert steps
