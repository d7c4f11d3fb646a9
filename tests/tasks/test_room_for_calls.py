"""No call waits for memory, however deep it is made."""

import resource

import pytest

from workbench.cli import app
from workbench.tasks import processes
from workbench.tasks.room_for_calls import with_room_for_calls

CALLS = 1000


def nothing():
    pass


def waits(depth):
    """How often memory had to be found for CALLS calls that are made below so many others."""
    if depth:
        return waits(depth - 1)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for _ in range(CALLS):
        nothing()
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before


def most_waits():
    """At the worst of 400 depths, some 50 kB of frames."""
    return max(waits(depth) for depth in range(400))


def within_a_command(monkeypatch):
    found = []
    monkeypatch.setattr(app, "_command", lambda: lambda *_, **__: found.append(most_waits()))
    with pytest.raises(SystemExit):
        app.main()
    return found[0]


def within_a_worker(monkeypatch):
    monkeypatch.setattr(processes, "_job", (lambda *_: most_waits(), None), raising=False)
    return processes._work(None)


@pytest.mark.parametrize("run", [lambda _: with_room_for_calls(most_waits), within_a_command, within_a_worker],
                         ids=["alone", "command", "worker"])
def test_calls_of_any_depth_find_their_memory_at_once(run, monkeypatch):
    assert run(monkeypatch) < CALLS / 10
