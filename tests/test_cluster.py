"""A real scheduler with two worker processes: uploads, the same results, lost workers, what is said in a line."""

import operator
import os
from pickle import PicklingError

import pytest

from workbench.errors import InputError, WorkbenchError
from workbench.files.modules import module_in
from workbench.simulate.cluster import cluster
from workbench.simulate.executor import on
from workbench.simulate.process_pool import results_of, run_tasks

LAW = """
import os
import signal
from pathlib import Path

import workbench
from workbench.errors import InputError


def scaled(where, task):
    return int((where / "table.txt").read_text()) * task, str(where), str(Path(__file__).parent)


def place(shared, task):
    return os.getpid(), workbench.__file__


def fail(shared, task):
    raise InputError("a.toml", "key", "is wrong: correct it")


def die_once(mark, task):
    if task == 3 and not Path(mark).exists():
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return task
"""

pytestmark = pytest.mark.filterwarnings("default")


@pytest.fixture(scope="module")
def two_workers():
    with cluster("local", 2) as found:
        yield found


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder as a paper's is, with a module and a file that it reads."""
    made = tmp_path_factory.mktemp("doe2030")
    (made / "table.txt").write_text("7")
    (made / "law.py").write_text(LAW)
    return made


def test_results_are_those_of_this_process_and_come_from_others_with_the_code_uploaded(two_workers, folder):
    assert two_workers.workers == 2
    with on(two_workers):
        found = results_of(operator.mul, 3, range(20), 1, lambda *one: None)
        places = results_of(module_in(folder, "law").place, None, range(4), 1, lambda *one: None).values()
    assert found == {task: 3 * task for task in range(20)}
    for process, code in places:
        assert process != os.getpid()
        assert "workbench_upload_" in code


def test_workers_have_folders_by_upload_and_not_from_this_disk(two_workers, folder):
    function = module_in(folder, "law").scaled
    with on(two_workers):
        found = results_of(function, folder, [1, 2], 1, lambda *one: None)
    for task, (value, where, code) in found.items():
        assert value == 7 * task
        assert where == code != str(folder) and where.endswith(str(folder))


def test_what_is_sent_has_a_name(two_workers):
    with on(two_workers), pytest.raises((AttributeError, PicklingError), match=r"local|pickle"):
        run_tasks(lambda shared, task: task, None, range(4), 2, print)


def test_an_error_in_a_task_is_raised_here(two_workers, folder):
    with on(two_workers), pytest.raises(InputError, match=r"a\.toml: key: is wrong"):
        run_tasks(module_in(folder, "law").fail, None, range(4), 2, lambda result: None)


def test_tasks_of_a_worker_that_is_killed_are_run_by_others(two_workers, folder, tmp_path):
    recorded = []
    with on(two_workers):
        run_tasks(module_in(folder, "law").die_once, str(tmp_path / "3"), range(6), 2, recorded.append)
    assert sorted(recorded) == list(range(6))
    assert (tmp_path / "3").exists()


def test_a_scheduler_that_is_not_there_is_said_in_a_line(monkeypatch):
    monkeypatch.setattr("workbench.simulate.cluster.CONNECT_S", 1)
    with pytest.raises(WorkbenchError, match=r"no scheduler answers at tcp://127\.0\.0\.1:9"), cluster("tcp://127.0.0.1:9"):
        pass
