"""A real scheduler with two worker processes that know neither this package nor the paper: the same bytes as here, what
is lost is run again, what cannot be is said in a line, and nothing is left behind."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from command_line import one_line, run, run_apart
from scenarios import ROOT
from small_folders import small_folder

sys.path.insert(0, str(ROOT / "benchmarks"))
from bad_input_texts import CONTEST
from faults import contest_without_times

TASKS = '''
import os
import signal
import sys
from pathlib import Path

import workbench
from workbench.errors import InputError


def where(folder, task):
    return int((folder / "numbers.py").read_text().split("=")[1]) * task, str(folder), str(Path(workbench.__file__))


def ends_once(folder, task):
    """Of tasks 2 and 5 the first process that has it is killed, and its worker with that of the fifth."""
    mark = Path(folder) / str(task)
    if task in (2, 5) and not mark.exists():
        mark.touch()
        if task == 5:
            os.kill(os.getppid(), signal.SIGKILL)
        os.kill(os.getpid(), signal.SIGKILL)
    return task


def fails(folder, task):
    raise InputError(folder / "study.toml", "key", "is wrong: correct it")


def ends_the_scheduler(number, task):
    os.kill(number, signal.SIGKILL)
    return sum(range(10**10))
'''
# What a program does with the cluster: its arguments are the scheduler's address and number, and the paper's folder.
PROGRAM = '''
import json, sys, time
from pathlib import Path
from workbench.errors import WorkbenchError
from workbench.files.modules import module_in
from workbench.tasks.cluster import cluster
from workbench.tasks.executor import on
from workbench.tasks.handing_out import results_of, run_tasks

address, number, folder, marks = sys.argv[1], int(sys.argv[2]), Path(sys.argv[3]), sys.argv[4]
tasks, said = module_in(folder, "tasks"), {}
with cluster(address) as found, on(found):
    said["workers"] = found.workers
    said["where"] = list(results_of(tasks.where, folder, range(4), 1, lambda *_: None).values())
    for name, function in (("no name", lambda shared, task: task), ("fails", tasks.fails)):
        try:
            run_tasks(function, folder, range(4), 1, print)
        except Exception as trouble:
            said[name] = f"{type(trouble).__name__}: {trouble}"
    said["ends once"] = sorted(results_of(tasks.ends_once, marks, range(6), 1, lambda *_: None).values())
    said["workers at last"] = found.workers
    begun = time.monotonic()
    try:
        run_tasks(tasks.ends_the_scheduler, number, range(2), 1, print)
    except WorkbenchError as trouble:
        said["scheduler"] = str(trouble)
    said["seconds"] = time.monotonic() - begun
print(json.dumps(said))
'''


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    """The scheduler and its address; nothing of this package is where its workers look."""
    place = tmp_path_factory.mktemp("dask")
    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def started(what: str, *arguments: str) -> subprocess.Popen:
        return subprocess.Popen([sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments, "--no-dashboard"],
                                cwd=place, env=bare, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    told = place / "scheduler.json"
    here = ("--scheduler-file", str(told))
    processes = [started("scheduler", "--host", "127.0.0.1", "--port", "0", *here)]
    processes += [started("worker", *here, "--nthreads", "1", "--no-nanny", "--local-directory", str(place))
                  for _ in range(2)]
    try:
        until = time.monotonic() + 120
        while not (told.exists() and told.read_text().strip()):
            assert time.monotonic() < until and processes[0].poll() is None
            time.sleep(0.05)
        yield processes[0], json.loads(told.read_text())["address"]
    finally:
        for process in processes:
            process.kill()
            process.wait()


@pytest.fixture(scope="module")
def paper(tmp_path_factory):
    """A folder with a law, a scenario and a contest of its own."""
    folder = small_folder(tmp_path_factory.mktemp("papers") / "doe2030", share=1)
    (folder / "tasks.py").write_text(TASKS)
    (folder / "contest.toml").write_text(CONTEST.replace("run.toml", "study.toml").replace("good", "own"))
    return folder


def test_a_sweep_has_the_same_bytes_wherever_it_is_run(dask, paper, tmp_path):
    _, address = dask
    places = {"here": ("--workers", 1), "processes": ("--workers", 2), "cluster": ("--dask", address)}
    made = {}
    for name, where in places.items():
        ended = run("sweep", paper, "--runs", 6, "--out", tmp_path / name, *where) if name == "here" else run_apart(
            "sweep", paper, "--runs", 6, "--out", tmp_path / name, *where)
        assert ended.returncode == 0, ended.stderr
        made[name] = (tmp_path / name / "sweep.csv").read_bytes()
    assert made["here"] == made["processes"] == made["cluster"]
    assert made["here"].count(b"\n") > 6


def test_so_does_a_contest(dask, paper, tmp_path):
    _, address = dask
    places = {"here": ("--workers", 1), "cluster": ("--dask", address)}
    made = {}
    for name, where in places.items():
        ended = (run if name == "here" else run_apart)("compare", paper / "contest.toml", "--json",
                                                       tmp_path / f"{name}.json", *where)
        assert ended.returncode == 0, ended.stderr
        made[name] = contest_without_times(tmp_path / f"{name}.json")
    assert made["here"] == made["cluster"]


def test_workers_know_folders_by_upload_and_what_is_lost_is_run_again_or_said(dask, paper, tmp_path):
    scheduler, address = dask
    done = subprocess.run([sys.executable, "-c", PROGRAM, address, str(scheduler.pid), str(paper), str(tmp_path)],
                          capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    said = json.loads(done.stdout)
    assert said["workers"] == 2
    for task, (value, folder, code) in enumerate(said["where"]):
        assert value == task
        assert folder == str(paper), "a path comes back as it was sent"
        assert "workbench_upload_" in code or not Path(code).is_relative_to(ROOT)
    assert "local" in said["no name"] or "pickle" in said["no name"]
    assert said["fails"] == f"InputError: {paper / 'study.toml'}: key: is wrong: correct it"
    assert said["ends once"] == list(range(6))
    assert said["workers at last"] == 1
    assert said["scheduler"].startswith("--dask: the scheduler is gone")
    assert said["seconds"] < 30
    assert left_of(done) == []


def left_of(done: subprocess.CompletedProcess) -> list[str]:
    """Processes that still serve tasks some seconds later."""
    until = time.monotonic() + 10
    while (left := [line for line in commands() if "workbench.tasks.serving" in line]) and time.monotonic() < until:
        time.sleep(0.1)
    return left


def commands() -> list[str]:
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                found.append((entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace"))
            except OSError:
                continue
    return found
