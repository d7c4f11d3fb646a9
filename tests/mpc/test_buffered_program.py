"""A program called through buffers answers as casadi's own call does, bit by bit, also after one that raised."""

import casadi as ca
import numpy as np
import pytest

from workbench.mpc.buffered_program import BufferedProgram


def solver() -> ca.Function:
    x, p = ca.SX.sym("x", 4), ca.SX.sym("p", 2)
    cost = ca.sumsqr(x - p[0]) + x[0] * x[1] / 2 + p[1] * x[3]
    return ca.qpsol("small", "daqp", {"x": x, "p": p, "f": cost, "g": x[:3] + x[1:]},
                    {"error_on_fail": False, "print_time": False})


def test_the_answers_are_the_same_bits():
    direct, buffered = solver(), BufferedProgram(solver())
    rng = np.random.default_rng(1)
    for number in range(40):
        asked = {"x0": rng.normal(size=4), "p": rng.normal(size=2), "lbx": np.full(4, -0.5), "ubx": np.full(4, 0.5),
                 "lbg": np.full(3, -np.inf), "ubg": rng.uniform(0.0, 0.4, 3)}
        if number == 20:
            with pytest.raises(RuntimeError):
                buffered(**asked | {"lbx": np.full(4, 1.0)})
        wanted = np.asarray(direct(**asked)["x"]).ravel()
        assert np.array_equal(buffered(**asked)["x"], wanted)
        assert buffered.stats()["success"] is direct.stats()["success"]


def test_an_answer_stays_as_it_is_when_the_next_program_is_solved():
    buffered = BufferedProgram(solver())
    bounds = {"lbx": np.full(4, -1.0), "ubx": np.full(4, 1.0), "lbg": np.full(3, -9.0), "ubg": np.full(3, 9.0)}
    first = buffered(x0=np.zeros(4), p=np.zeros(2), **bounds)["x"]
    kept = first.copy()
    buffered(x0=np.zeros(4), p=np.ones(2), **bounds)
    assert np.array_equal(first, kept)
