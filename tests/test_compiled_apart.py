"""A fork that compiles a kernel for a test is waited for as long as it works, and no longer."""

import os
import time

import compiled_apart


def test_a_fork_that_does_nothing_is_ended(monkeypatch):
    monkeypatch.setattr(compiled_apart, "PATIENCE_S", 0.05)
    compiled_apart.in_a_fork(time.sleep, 1e6)


def test_work_is_told_from_waiting_by_what_a_process_had_of_processors():
    before, until = compiled_apart.ticks_of(os.getpid()), time.process_time() + 0.1
    while time.process_time() < until:
        pass
    worked = compiled_apart.ticks_of(os.getpid())
    assert worked - before >= 0.08 * os.sysconf("SC_CLK_TCK")
