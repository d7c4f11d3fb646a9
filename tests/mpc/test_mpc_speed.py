"""The speed benchmark compares like with like: its solvers and do-mpc close the same loop at the same cost."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from workbench.mpc.nonlinear import NonlinearMpc

FILE = Path(__file__).parent.parent.parent / "benchmarks" / "mpc_speed.py"


@pytest.fixture(scope="module")
def speed():
    spec = importlib.util.spec_from_file_location("mpc_speed", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.STEPS = 60
    return module


@pytest.mark.parametrize("load", ["easy", "hard"])
def test_without_do_mpc_all_costs_are_ipopts_but_those_that_say_otherwise(speed, load):
    rows = {row["solver"]: row for row in speed.measured(20, load, peer=False)}
    reference = rows["casadi ipopt"]["cost"]
    assert {"nonlinear", "linear", "casadi fatrop"} < set(rows)
    for name, row in rows.items():
        row |= {"cost_off": row["cost"] / reference - 1, "ratio": np.nan}
        row["p99_us"] = 0.0  # nothing is asserted of a clock here
        assert speed.shortcomings(row, peer=False) == [], name


def test_a_row_that_falls_short_is_named(speed):
    row = {"solver": "nonlinear", "horizon": 50, "ratio": 24.0, "p99_us": 6e4, "cost_off": 2e-4}
    assert len(speed.shortcomings(row, peer=True)) == 3
    assert len(speed.shortcomings(row | {"ratio": 26.0, "p99_us": 10.0, "cost_off": -1e-5}, peer=True)) == 0


@pytest.mark.filterwarnings("ignore")  # do-mpc's own, of parts that are not installed
def test_do_mpc_closes_the_same_loop(speed):
    pytest.importorskip("do_mpc")
    problem, ahead = speed.problem_of(20, "hard")
    cost, _, commands = speed.closed_loop(problem, ahead, speed.do_mpc_controller(problem, ahead))
    expected, _, at = speed.closed_loop(problem, ahead, speed.of_tracker(NonlinearMpc(problem, ahead)))
    assert cost == pytest.approx(expected, rel=1e-4)
    assert commands == pytest.approx(at, abs=1e-3)
