"""Results by task, wherever they were computed."""

import operator
import time

import pytest

from workbench.errors import WorkbenchError
from workbench.tasks.handing_out import results_of, run_tasks

TASKS = [5, 1, 4, 2]


def slow_first(shared, task):
    """The first task ends last where there are processes for others."""
    if task == TASKS[0]:
        time.sleep(0.5)
    return shared * task


@pytest.mark.parametrize("workers", [1, 2])
def test_results_stand_in_the_order_of_their_tasks_and_are_told_as_they_finish(workers):
    told = []
    found = results_of(slow_first, 10, TASKS, workers, lambda *one: told.append(one))
    assert list(found.items()) == [(task, 10 * task) for task in TASKS]
    assert [done for done, _, _ in told] == [1, 2, 3, 4]
    assert {task: result for _, task, result in told} == found
    assert workers > 1 or [task for _, task, _ in told] == TASKS


def test_a_task_that_fails_is_raised_with_what_it_raised():
    told = []
    with pytest.raises(ZeroDivisionError):
        results_of(operator.truediv, 1.0, [1, 2, 0, 4], 1, lambda *one: told.append(one))
    assert told == [(1, 1, 1.0), (2, 2, 0.5)]


def test_nothing_to_do_gives_nothing():
    assert results_of(operator.add, 1, [], 2, pytest.fail) == {}


def test_what_has_no_name_is_refused_in_a_line_before_a_process_starts():
    """As a study that states a function within a function; without other processes it runs."""
    def nameless(given, task):
        return given + task

    with pytest.raises(WorkbenchError, match=r"cannot be handed to other processes .*nameless.*--workers 1"):
        run_tasks(nameless, 1, [1, 2], 2, lambda result: None)
    found = []
    run_tasks(nameless, 1, [1, 2], 1, found.append)
    assert found == [2, 3]
