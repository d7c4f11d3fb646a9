"""What a long command says while it runs: how far, how fast, how long; every so often where there is no terminal."""

import time

import pytest
from rich.console import Console

from workbench.cli import terminal
from workbench.cli.terminal import Stage, progress


@pytest.fixture
def lines(monkeypatch, capsys):
    """What stands on standard error, which is no terminal."""
    monkeypatch.setattr(terminal, "err_console", Console(stderr=True, force_terminal=False))

    def read() -> list[str]:
        return capsys.readouterr().err.splitlines()

    return read


def test_rate_and_time_left_are_those_of_what_was_done_since_it_began(monkeypatch):
    monkeypatch.setattr(time, "monotonic", lambda: 1050.0)
    stage = Stage("runs", first=100, begun_s=1000.0)
    stage.at(600, 10_600)
    assert stage.line() == "runs: 600 of 10600, 10/s, 17 min left"
    stage.at(100, 10_600)
    assert stage.line() == "runs: 100 of 10600"


def test_without_a_terminal_a_line_comes_now_and_then_and_one_at_the_end(lines, monkeypatch):
    monkeypatch.setattr(terminal, "LINE_EVERY_S", 0.02)
    with progress() as show:
        show("[runs]", 1, 5)
        for _ in range(12_000):  # the line comes when the thread that says it has its turn
            if said := lines():
                break
            time.sleep(0.01)
        show("[runs]", 5, 5)
    assert said[0].startswith("[runs]: 1 of 5") and "[runs]: 5 done" in lines()


def test_a_short_command_says_when_a_stage_has_ended_and_no_more(lines):
    with progress() as show:
        for done in (1, 2):
            show("runs", done, 2)
    assert lines() == ["runs: 2 done"]


def test_a_count_that_begins_anew_under_the_same_name_has_a_rate_of_its_own(lines, monkeypatch):
    """As of a contest, whose Pareto fronts come after its matches: those do not say how long a front takes."""
    clock = iter([0.0, 3600.0, 3660.0])  # the matches begin, the fronts begin, and a first one is ready after a minute
    now = [next(clock)]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    monkeypatch.setattr(terminal, "LINE_EVERY_S", 0.02)
    with progress() as show:
        show("runs", 1, 500)
        now[0] = next(clock)
        show("runs", 500, 500)
        show("runs", 0, 4)
        now[0] = next(clock)
        show("runs", 1, 4)
        said: list[str] = []
        for _ in range(12_000):
            said += lines()
            if any(line.startswith("runs: 1 of 4") for line in said):
                break
            time.sleep(0.01)
    assert "runs: 500 done" in said
    assert next(line for line in said if line.startswith("runs: 1 of 4")) == "runs: 1 of 4, 0.0167/s, 3 min left"
