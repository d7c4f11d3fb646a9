"""What commands import: a mistake is said without any solver, and a run is found without tools it has no use for."""

import json
import subprocess
import sys

import pytest
from scenarios import SHARED, YANG

HEAVY = ("control", "cvxpy", "casadi", "matplotlib", "sympy", "numba", "clarabel", "scipy")
LINE, TRAIN = SHARED / "lines" / "hills.toml", SHARED / "trains" / "yang2021.toml"
PROGRAM = """
import json, sys
from workbench.cli.app import main
sys.argv = ["workbench", *json.loads(sys.argv[1])]
try:
    main()
except SystemExit as end:
    code = end.code
print(json.dumps([code, [name for name in json.loads(sys.stdin.read()) if name in sys.modules]]))
"""


def imported(*arguments: object) -> tuple[int, set[str]]:
    """The exit code of a command in a process of its own, and which of HEAVY it imported."""
    done = subprocess.run([sys.executable, "-c", PROGRAM, json.dumps(list(map(str, arguments)))], check=True,
                          input=json.dumps(HEAVY), capture_output=True, text=True, timeout=300)
    code, names = json.loads(done.stdout.splitlines()[-1])
    return code or 0, set(names)


@pytest.mark.parametrize("arguments", [
    ("reference", "nowhere.toml", TRAIN, "--time", 2600), ("reference", LINE, YANG, "--time", 2600),
    ("reference", LINE, TRAIN, "--time", 2600, "--every", 0),
], ids=str)
def test_a_mistake_is_said_before_anything_heavy_is_imported(arguments):
    code, names = imported(*arguments)
    assert code == 2
    assert names == set()


def test_a_mistake_in_a_scenario_is_said_before_solvers_and_figures_are_imported():
    code, names = imported("compare", "nowhere.toml")
    assert code == 2
    assert names.isdisjoint({"control", "cvxpy", "casadi", "matplotlib"})


def test_a_run_needs_its_solver_and_no_modelling_tools():
    code, names = imported("reference", LINE, TRAIN, "--time", 2600)
    assert code == 0
    assert "clarabel" in names
    assert names.isdisjoint({"control", "cvxpy", "casadi", "matplotlib"})
