"""Who waits for what never comes is ended; a process that was stopped for a while and goes on is not."""

import signal
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
    """One look finds nothing computed and the next one something; two in turn that find nothing end it."""
    monkeypatch.setattr(time_limit, "WAITING_S", 1e6)  # looks come by hand, so that no busy machine decides
    monkeypatch.setattr(time_limit, "IDLE_S", 0.1)
    with at_most_seconds(60):
        look = signal.getsignal(signal.SIGALRM)
        for _ in range(3):
            look(signal.SIGALRM, None)
            compute(0.11)
        look(signal.SIGALRM, None)
        look(signal.SIGALRM, None)
        with pytest.raises(OutOfTime):
            look(signal.SIGALRM, None)


def test_who_is_kept_from_computing_by_others_does_not_wait(monkeypatch):
    """A process of the least priority on a busy machine is ready all the time, and computes next to nothing."""
    queued = [0.0]
    monkeypatch.setattr(time_limit, "WAITING_S", 1e6)
    monkeypatch.setattr(time_limit, "IDLE_S", 1e6)
    monkeypatch.setattr(time_limit, "_queued_s", lambda: queued[0])
    with at_most_seconds(60):
        look = signal.getsignal(signal.SIGALRM)
        for _ in range(5):
            queued[0] += 0.5e6
            look(signal.SIGALRM, None)
        look(signal.SIGALRM, None)
        with pytest.raises(OutOfTime):
            look(signal.SIGALRM, None)
