"""Who waits for what never comes is ended; a process that was stopped for a while and goes on is not."""

import time

import pytest

from workbench.files import time_limit
from workbench.files.time_limit import OutOfTime, at_most_seconds


def compute(seconds: float) -> None:
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass


def test_waiting_is_ended(monkeypatch):
    monkeypatch.setattr(time_limit, "WAITING_S", 0.4)
    started = time.monotonic()
    with pytest.raises(OutOfTime), at_most_seconds(60):
        time.sleep(30)
    assert time.monotonic() - started < 20


def test_a_pause_between_two_computations_is_none(monkeypatch):
    """One of the looks, which come every 1.2 s, finds nothing computed; the next one something."""
    monkeypatch.setattr(time_limit, "WAITING_S", 2.4)
    with at_most_seconds(60):
        compute(0.2)
        time.sleep(2.28)
        compute(0.2)
        time.sleep(1.0)
