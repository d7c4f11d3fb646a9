"""A linear program that is given up says nothing on standard output, which may be read by another program."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.sparse import csc_array

from workbench.proof.decide import linear_program
from workbench.proof.decide.linear_program import least

# Columns of any sign among the others, and fewer iterations than it takes.
GIVEN_UP = """
import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csc_array
from workbench.proof.decide import linear_program
rng = np.random.default_rng(0)
matrix = csc_array(np.where(rng.random((10, 24)) < 0.4, rng.integers(-3, 4, size=(10, 24)), 0).astype(float))
right = matrix @ (rng.random(24) < 0.3)
limits = [(None if rng.random() < 0.43 else 0, None) for _ in range(24)]
linear_program.ITERATIONS, linear_program.ITERATIONS_A_ROW = 3, 0
if {quiet}:
    found = linear_program.least(np.ones(24), matrix, right, limits)
else:
    found = linprog(np.ones(24), A_eq=matrix, b_eq=right, bounds=limits, method="highs-ds",
                    options={{"maxiter": 3}})
print("status", found.status, flush=True)
"""


def printed(quiet):
    return subprocess.run([sys.executable, "-c", GIVEN_UP.format(quiet=quiet)], capture_output=True, text=True,
                          check=True).stdout


@pytest.mark.skipif(linear_program._c_streams() is None, reason="C's standard output is no variable here")
def test_what_is_given_up_prints_nothing():
    assert printed(quiet=False) != "status 1\n"  # what is to be kept off
    assert printed(quiet=True) == "status 1\n"


def test_c_prints_again_afterwards(capfd):
    assert least(np.ones(2), csc_array(np.eye(2)), np.ones(2), [(0, None)] * 2).status == 0
    if (found := linear_program._c_streams()) is not None:
        assert found[0].value != found[1]


def test_a_program_that_turns_in_circles_ends(monkeypatch):
    asked = []
    monkeypatch.setattr(linear_program, "linprog", lambda *_, options, **__: asked.append(options["maxiter"]))
    least(np.ones(2), csc_array((2000, 2)), np.zeros(2000), [(0, None)] * 2)
    assert asked == [7000]
