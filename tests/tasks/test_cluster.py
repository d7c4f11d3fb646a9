"""A real scheduler with two worker processes that know neither this package nor the paper: the same bytes as here, what
is lost is run again, what cannot be is said in a line, and nothing is left behind."""

import json
import os
import re
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest
from command_line import one_line, run
from scenarios import ROOT
from small_folders import CLAIMS, PAPER, small_folder

sys.path.insert(0, str(ROOT / "benchmarks"))
from bad_input_texts import CONTEST, FLEET, LINE_MORE, TRAIN, line_text
from long_jobs import SEARCH, claims_without_times, contest_without_times

from workbench.proof.prove import prove
from workbench.proof.selection import targets
from workbench.tasks.executor import ThisProcess, on

SEARCHED = SEARCH.format(runs=4).replace("good", "own")
PLACES = ("here", "processes", "cluster")
PATIENCE_S = 120.0  # a busy machine may take long; nothing waits longer than it must
# A variable of the environment that every process started from here inherits: others of the machine are not looked at.
OURS = {"WORKBENCH_TEST_OF": f"cluster {os.getpid()} {time.monotonic_ns()}"}
TASKS = '''
import ctypes
import os
import signal
import sys
from pathlib import Path

import workbench
from workbench.errors import InputError

kill = ctypes.CDLL(None).kill  # a paper's code is refused os.kill


def where(folder, task):
    return int((folder / "numbers.py").read_text().split("=")[1]) * task, str(folder), str(Path(workbench.__file__))


def ends_once(folder, task):
    """Of tasks 2 and 5 the first process that has it is killed, and its worker with that of the fifth."""
    mark = Path(folder) / str(task)
    if task in (2, 5) and not mark.exists():
        mark.touch()
        if task == 5:
            kill(os.getppid(), signal.SIGKILL)
        kill(os.getpid(), signal.SIGKILL)
    return task


def size(shared, path):
    return path.stat().st_size


def fails(folder, task):
    raise InputError(folder / "study.toml", "key", "is wrong: correct it")


def ends_the_scheduler(number, task):
    kill(number, signal.SIGKILL)
    return sum(range(10**10))
'''
# What a program does with the cluster: the same jobs at every place, and then all that can go wrong there.
PROGRAM = '''
import contextlib, io, json, os, sys, time
from pathlib import Path
from workbench.cli.app import main
from workbench.errors import WorkbenchError
from workbench.files.modules import module_in
from workbench.paper.stages import Stage, run_stages
from workbench.tasks import cluster as module
from workbench.tasks.cluster import cluster
from workbench.tasks.executor import on
from workbench.tasks.handing_out import results_of, run_tasks

said = {}


def command(*arguments):
    sys.argv = ["workbench", *map(str, arguments)]
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as errors:
        try:
            main()
        except SystemExit as end:
            return end.code or 0, errors.getvalue()


def tried(function, shared, tasks=2):
    try:
        run_tasks(function, shared, range(tasks), 1, print)
    except Exception as trouble:
        return f"{type(trouble).__name__}: {trouble}"


def jobs():
    for place, where in (("here", ["--workers", 1]), ("processes", ["--workers", 2]), ("cluster", ["--dask", address])):
        said[place] = [command("sweep", folder, "--runs", 4, "--out", out / place, *where)]
        said[place].append(command("compare", folder / "contest.toml", "--json", out / f"{place}.json", *where))
        tuned = folder / f"{place}.toml"
        tuned.write_text((folder / "study.toml").read_text() + (folder / "search").read_text())
        said[place].append(command("tune", tuned, "--write", *where))
        said[place].append(command("reference", "--fleet", folder / "fleet.toml", "--json",
                                   out / f"{place}_day.json", *where))
        if place != "processes":
            said[place].append(command("prove", folder, "--no-cache", "--json", out / f"{place}_claims.json", *where))
    said["more here"] = more(1)
    with cluster(address) as found, on(found):
        said["more cluster"] = more(found.workers)
    said["two kinds"] = command("sweep", folder, "--out", out / "no", "--dask", address, "--workers", 2)
    said["one run"] = command("reference", "a", "b", "--dask", address)


def more(workers):
    """The stages of a study, and mutants of the folder's claims."""
    stage = Stage(module_in(folder, "tasks").where, folder, (3, 1, 2), lambda task, result: str(task))
    stages = [list(one.items()) for one in run_stages((stage, stage), workers, lambda *_: None)]
    for one in stages:  # where the code lies differs
        one[:] = [(task, number, text) for task, (number, text, _) in one]
    mutation = module_in(benchmarks, "mutation")
    with contextlib.redirect_stderr(io.StringIO()):
        found = mutation.run(mutation.plan([folder], 2, 1), 1, workers, 60)
    mutants = [{**vars(one), "seconds": 0} for one in found]
    return stages, mutants


def losses():
    tasks = module_in(folder, "tasks")
    with cluster(address) as found, on(found):
        until = time.monotonic() + patience_s
        while found.workers < 2 and time.monotonic() < until:
            time.sleep(0.05)
        said["workers"] = found.workers
        said["where"] = list(results_of(tasks.where, folder, range(4), 1, lambda *_: None).values())
        os.chdir(folder)
        paths = [Path("numbers.py"), Path("line.toml")]
        sizes = results_of(tasks.size, None, paths, 1, lambda *_: None)
        said["sizes"] = [sizes[path] for path in paths] == [path.stat().st_size for path in paths]
        said["no name"] = tried(lambda shared, task: task, None)
        said["fails"] = tried(tasks.fails, folder)
        said["ends once"] = sorted(results_of(tasks.ends_once, str(out), range(6), 1, lambda *_: None).values())
        said["workers at last"] = found.workers
    module.ANSWER_S = 8  # this long is waited for a scheduler that is gone
    with cluster(address) as found, on(found):
        said["scheduler"] = tried(tasks.ends_the_scheduler, number)
    module.ANSWER_S = 1
    try:
        with cluster(address):
            pass
    except WorkbenchError as trouble:
        said["nobody"] = str(trouble)


if __name__ == "__main__":
    address, number = sys.argv[1], int(sys.argv[2])
    folder, out, benchmarks = map(Path, sys.argv[3:6])
    module.ANSWER_S = patience_s = float(sys.argv[6])
    jobs()
    losses()
    print(json.dumps(said))
'''


@pytest.fixture(scope="module")
def dask(tmp_path_factory):
    """The scheduler and its address; nothing of this package is where its workers look."""
    place = tmp_path_factory.mktemp("dask")
    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | OURS

    def started(what: str, *arguments: str) -> subprocess.Popen:
        return subprocess.Popen([sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments, "--no-dashboard"],
                                cwd=place, env=bare, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    told = place / "scheduler.json"
    here = ("--scheduler-file", str(told))
    processes = [started("scheduler", "--host", "127.0.0.1", "--port", "0", *here)]
    processes += [started("worker", *here, "--nthreads", "1", "--no-nanny", "--local-directory", str(place))
                  for _ in range(2)]
    try:
        until = time.monotonic() + PATIENCE_S
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
    (folder / "paper.py").write_text(PAPER)
    (folder / "claims").mkdir()
    for number in "12":
        (folder / "claims" / f"section_{number}.py").write_text(CLAIMS.format(number=number, name=number))
    (folder / "search").write_text(SEARCHED)
    train = TRAIN + "max_speed_mps = 40.0\nlength_m = 50.0\n"
    sources = "".join(f'source.{key} = "assumed: a test"\n' for key in re.findall(r"(?m)^(\w+) = ", train))
    (folder / "train.toml").write_text(train + sources)
    (folder / "day_line.toml").write_text(line_text(LINE_MORE))
    (folder / "fleet.toml").write_text(FLEET.replace("line.toml", "day_line.toml"))
    (folder / "contest.toml").write_text(CONTEST.replace("run.toml", "study.toml").replace("good", "own"))
    return folder


@pytest.fixture(scope="module")
def found(dask, paper, tmp_path_factory):
    """What the program has said, and the folder of its results."""
    scheduler, address = dask
    out = tmp_path_factory.mktemp("out")
    (out / "program.py").write_text(PROGRAM)
    done = subprocess.run([sys.executable, out / "program.py", address, str(scheduler.pid), str(paper), str(out),
                           str(ROOT / "benchmarks"), str(PATIENCE_S)],
                          env={**os.environ, **OURS, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True,
                          timeout=1000, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(done.stdout), out


def test_a_sweep_has_the_same_bytes_wherever_it_is_run(found):
    said, out = found
    made = {}
    for place in ("here", "processes", "cluster"):
        assert said[place][0][0] == 0, said[place]
        made[place] = (out / place / "sweep.csv").read_bytes()
    assert made["here"] == made["processes"] == made["cluster"]
    assert made["here"].count(b"\n") > 4


def test_so_has_a_contest(found):
    said, out = found
    for place in PLACES:
        assert {code for code, _ in said[place]} == {0}, said[place]
    here, *others = (contest_without_times(out / f"{place}.json") for place in PLACES)
    assert others == [here, here]


def test_so_have_a_search_and_a_days_trips(found, paper):
    _, out = found
    here, *others = ((paper / f"{place}.toml").read_bytes() for place in PLACES)
    assert others == [here, here] and here != (paper / "study.toml").read_bytes() + SEARCHED.encode()
    here, *others = ((out / f"{place}_day.json").read_bytes() for place in PLACES)
    assert others == [here, here]
    assert [row["status"] for row in json.loads(here)["trips"]] == ["optimal", "refused", "optimal"]


def test_so_have_a_proof_the_stages_of_a_study_and_a_mutation_test(found):
    said, out = found
    here, there = (claims_without_times(out / f"{place}_claims.json") for place in ("here", "cluster"))
    assert here == there and b'"proved"' in here
    assert said["more here"] == said["more cluster"]
    (first, second), mutants = said["more here"]
    assert first == second and [row[:2] for row in first] == [[3, 3], [1, 1], [2, 2]]
    assert [(one["broken"], one["verdict"]) for one in mutants] == [(False, "proved")] * 2, "powers of positive numbers"


def test_claims_are_decided_alike_by_a_named_executor_which_keeps_nothing(paper, monkeypatch, tmp_path):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path))
    with on(ThisProcess()):
        there = prove(targets([str(paper)]))
    assert not list(tmp_path.rglob("*.json"))
    here = prove(targets([str(paper)]), 1)
    assert [replace(one, seconds=0.0) for one in there.decisions] == [replace(one, seconds=0.0)
                                                                      for one in here.decisions]
    assert [one.verdict for one in here.decisions] == ["proved", "proved"]


def test_workers_know_folders_by_upload_alone(found, paper):
    said, _ = found
    assert said["workers"] == 2
    for task, (value, folder, code) in enumerate(said["where"]):
        assert value == task
        assert folder == str(paper), "a path comes back as it was sent"
        assert not Path(code).is_relative_to(ROOT)
    assert said["sizes"], "a task is known by its own path, relative here and another there"


def test_an_error_of_a_task_is_raised_here_and_what_is_sent_has_a_name(found, paper):
    said, _ = found
    assert said["fails"] == f"InputError: {paper / 'study.toml'}: key: is wrong: correct it"
    assert "local" in said["no name"] or "pickle" in said["no name"]


def test_tasks_of_a_process_and_of_a_worker_that_are_killed_are_run_again(found):
    said, _ = found
    assert said["ends once"] == list(range(6))
    assert said["workers at last"] == 1


def test_a_scheduler_that_is_lost_or_not_there_is_said_in_a_line_and_nothing_is_left(found):
    said, _ = found
    assert said["scheduler"].startswith("WorkbenchError: --dask: the scheduler is gone")
    assert said["nobody"].startswith("--dask: no scheduler answers at 'tcp://127.0.0.1:")
    assert left() == []
    with subprocess.Popen(["sleep", "60"], env=os.environ | OURS) as seen:
        until = time.monotonic() + PATIENCE_S  # a process may be seen before its command line is
        while not (there := commands()) and time.monotonic() < until:
            time.sleep(0.02)
        assert there == ["sleep 60 "], "what is started from here is looked at"
        seen.kill()


def test_options_that_do_not_fit_a_cluster_are_refused(found):
    said, _ = found
    for name, words in (("two kinds", "--workers: is of processes of this machine"), ("one run", "--dask: is for")):
        code, line = said[name]
        assert code == 2
        assert words in line


def test_without_dask_the_extra_is_named(paper, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    for command in (("sweep", paper, "--out", tmp_path), ("gains", paper)):
        line = one_line(run(*command, "--dask", "local"))
        assert line == "workbench: --dask: Dask is not installed: pip install 'workbench[dask]'"
    assert not list(tmp_path.iterdir())


def left() -> list[str]:
    """Processes of this test that do not stop serving tasks."""
    until = time.monotonic() + PATIENCE_S
    while (there := [line for line in commands() if "workbench.tasks.serving" in line]) and time.monotonic() < until:
        time.sleep(0.1)
    return there


def commands() -> list[str]:
    """The command lines of all processes that were started from here."""
    mark = "=".join(*OURS.items()).encode()
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                if mark in (entry / "environ").read_bytes().split(b"\0"):
                    found.append((entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace"))
            except OSError:
                continue
    return found
