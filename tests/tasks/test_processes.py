"""Processes of this machine: what has begun is recorded, what dies is run again."""

import operator
import time

import pytest
from worker_tasks import end_the_process

from workbench.tasks import processes
from workbench.tasks.handing_out import run_tasks


def test_what_workers_have_started_is_recorded_before_an_interruption_goes_on(monkeypatch):
    recorded, interrupted = [], []
    monkeypatch.setattr(processes, "GRACE_S", 100.0)

    def record(value):
        recorded.append(value)
        if len(recorded) == 1:
            interrupted.append(time.monotonic())
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_tasks(operator.add, 100, range(50), 2, record)
    assert time.monotonic() - interrupted[0] < processes.GRACE_S / 2  # which is for tasks that have begun
    assert 1 < len(recorded) < 10
    assert set(recorded) <= set(range(100, 150))


def test_an_exception_in_a_worker_is_raised_here():
    with pytest.raises(ZeroDivisionError):
        run_tasks(operator.truediv, 1.0, [1, 2, 0, 3], 2, print)


def test_tasks_of_a_process_that_dies_are_run_again(tmp_path, capsys):
    recorded = []
    run_tasks(end_the_process, str(tmp_path), range(8), 2, recorded.append)
    assert sorted(recorded) == list(range(8))
    assert "a worker process died" in capsys.readouterr().err
