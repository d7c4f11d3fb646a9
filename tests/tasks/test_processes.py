"""Processes of this machine: what has begun is recorded, what dies is run again."""

import operator
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from scenarios import ROOT
from worker_tasks import end_the_process

from workbench.errors import WorkbenchError
from workbench.tasks import processes
from workbench.tasks.handing_out import run_tasks

PATIENCE_S = 120.0  # a busy machine may take long; nothing waits longer than it must


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


def test_a_server_of_processes_that_has_died_is_said_in_a_line(monkeypatch):
    """As the standard library tells of it: by the end of what it reads, which a command line takes for Ctrl-D."""
    class Context:
        class Process:
            def __init__(self, **_):
                pass

            def start(self):
                raise EOFError("unexpected EOF")

    monkeypatch.setattr(processes.os, "kill", lambda *_: None)  # the server of this process lives
    with pytest.raises(WorkbenchError, match=r"has died .*: run again, with --resume"):
        processes._wait_for_server.__wrapped__(Context())


def test_a_server_of_processes_goes_with_its_parent_in_the_midst_of_its_imports(tmp_path):
    (tmp_path / "slow.py").write_text("import os, pathlib, time\n"
                                      "pathlib.Path(__file__).with_name('pid').write_text(str(os.getpid()))\n"
                                      "time.sleep(600)\n")
    text = "from workbench.tasks.processes import start_method; start_method('slow')"
    path = os.pathsep.join((str(tmp_path), str(ROOT)))
    running = subprocess.Popen([sys.executable, "-c", text], env={**os.environ, "PYTHONPATH": path})
    told, until = tmp_path / "pid", time.monotonic() + PATIENCE_S
    while not (told.exists() and told.read_text()):
        assert running.poll() is None and time.monotonic() < until
        time.sleep(0.05)
    running.kill()
    running.wait()
    while runs(int(told.read_text())):
        assert time.monotonic() < until
        time.sleep(0.05)


def runs(number):
    """Whether a process still does anything."""
    try:
        return "Z" not in Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False


def test_an_exception_in_a_worker_is_raised_here():
    with pytest.raises(ZeroDivisionError):
        run_tasks(operator.truediv, 1.0, [1, 2, 0, 3], 2, print)


def test_tasks_of_a_process_that_dies_are_run_again(tmp_path, capsys):
    recorded = []
    run_tasks(end_the_process, str(tmp_path), range(8), 2, recorded.append)
    assert sorted(recorded) == list(range(8))
    assert "a worker process died" in capsys.readouterr().err


SCRIPT = """
import operator
import workbench as wb
from workbench.tasks.handing_out import run_tasks

print("begun")
found = []
run_tasks(operator.add, 100, range(4), 2, found.append)
print(sorted(found), wb.prove("mine.py", workers=2, cache=False).verdicts)
"""
PAPER = """
import sympy as sp
from workbench.proof.claim import Goal, at_least
from workbench.proof.paper import Paper

paper = Paper("mine", "A. Author, A title, 2026")
x = sp.Symbol("x", real=True)

@paper.claim("1", "A square", "inequality", "x^2 >= 0", "proved")
def square() -> Goal:
    return Goal((at_least(x**2, 0),))
"""


def test_a_plain_script_may_ask_for_several_processes(tmp_path):
    """Without a guard: a process that imported the script would begin all of it again, and die of that."""
    (tmp_path / "mine.py").write_text(PAPER)
    (tmp_path / "script.py").write_text(SCRIPT)
    done = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.stdout.splitlines() == ["begun", "[100, 101, 102, 103] {'mine:1': 'proved'}"], done.stderr
    assert not done.stderr
