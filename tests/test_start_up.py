"""What commands import: a mistake is said without any solver, and a run is found without tools it has no use for."""

import gc
import json
import subprocess
import sys

import pytest
from command_line import run
from scenarios import SHARED, YANG
from small_folders import small_folder

from workbench.cli.loading import load
from workbench.simulate import compare as compare_module
from workbench.tasks.collection import MANY, SELDOM, collect_later, imports_left_out
from workbench.tasks.processes import LocalProcesses

HEAVY = ("scipy.optimize", "control", "cvxpy", "casadi", "matplotlib", "sympy", "numba", "clarabel", "scipy")
# What reads values, shows tables or starts processes: of no use where a path is wrong.
READERS = ("numpy", "multiprocessing", "rich.progress", "workbench.trains.scenario", "workbench.paper.study",
           "workbench.proof.document", "workbench.optimal.inputs.line")
PAGE = ("jinja2", "plotly", "grandalf", "workbench.report.page", "workbench.contest.matches")
BROUGHT_ALONG = ("numpy.f2py.f2py2e", "numpy.f2py.crackfortran", "numpy.testing._private.utils", "pycparser.c_parser")
OTHER_VERBS = tuple(f"workbench.cli.{verb}" for verb in ("show", "sweep", "report", "gains", "errata", "check_coq"))
LINE, TRAIN = SHARED / "lines" / "hills.toml", SHARED / "trains" / "yang2021.toml"
CLAIM = """
import sympy as sp
from workbench.proof.claim import Goal, at_least
from workbench.proof.paper import Paper

paper = Paper("small", "nobody")


@paper.claim("1", "one", "inequality", "x", "proved")
def one() -> Goal:
    return Goal((at_least(sp.Symbol("x", real=True)**2, 0),))
"""
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
    """The exit code of a command in a process of its own, and what it imported of what is named above."""
    names = (*HEAVY, *READERS, *PAGE, *OTHER_VERBS, *BROUGHT_ALONG)
    done = subprocess.run([sys.executable, "-c", PROGRAM, json.dumps(list(map(str, arguments)))], check=True,
                          input=json.dumps(names), capture_output=True, text=True, timeout=300)
    code, found = json.loads(done.stdout.splitlines()[-1])
    return code or 0, set(found)


@pytest.mark.parametrize("arguments", [
    ("reference", "nowhere.toml", TRAIN, "--time", 2600), ("compare", "nowhere.toml"), ("prove", "nowhere"),
], ids=lambda arguments: arguments[0])
def test_a_wrong_path_is_said_before_anything_is_imported_that_reads_or_runs(arguments):
    code, names = imported(*arguments)
    assert code == 2
    assert names == set()


@pytest.mark.parametrize("arguments", [
    ("reference", LINE, YANG, "--time", 2600), ("reference", LINE, TRAIN, "--time", 2600, "--every", 0),
], ids=str)
def test_a_mistake_is_said_before_anything_heavy_is_imported(arguments):
    code, names = imported(*arguments)
    assert code == 2
    assert names.isdisjoint({*HEAVY, *PAGE, *OTHER_VERBS})


def test_an_unchanged_paper_is_told_without_expressions_numbers_or_other_processes(tmp_path):
    (tmp_path / "small.py").write_text(CLAIM, encoding="utf-8")
    assert run("prove", tmp_path / "small.py").returncode == 0
    code, names = imported("prove", tmp_path / "small.py")
    assert code == 0
    assert names <= {"workbench.proof.document", "rich.progress"}


def test_certificates_are_held_against_their_claims_without_any_solver_or_decider():
    names = {*HEAVY, "workbench.proof.decide.engine"} - {"sympy"}
    program = "import json, sys; from pathlib import Path; from workbench.proof.at_hand import papers_at_hand; " \
        "from workbench.proof.binding import check_claims; found = papers_at_hand(Path(sys.argv[1]), []); " \
        "bound = sum(check_claims(*each)[1] for each in found.items()); print(json.dumps([bound, [*sys.modules]]))"
    done = subprocess.run([sys.executable, "-c", program, SHARED.parent / "proofs"], check=True, capture_output=True,
                          text=True, timeout=300)
    bound, there = json.loads(done.stdout)
    assert bound > 0
    assert names.isdisjoint(there)


def test_a_small_comparison_needs_no_page_no_other_verb_and_no_other_process(tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    code, names = imported("compare", folder)
    assert code == 0
    assert names.isdisjoint({"control", "cvxpy", "matplotlib", "clarabel", *PAGE, *OTHER_VERBS, *BROUGHT_ALONG})


def test_a_small_comparison_is_run_where_it_is_asked_for(tmp_path, monkeypatch):
    def started(*_: object) -> None:
        pytest.fail("a process was started for runs that are shorter than its start")

    monkeypatch.setattr(LocalProcesses, "run", started)
    monkeypatch.setattr(compare_module, "HERE_S", 60.0)  # where kernels are compiled first, too
    path = small_folder(tmp_path / "doe2030") / "study.toml"
    loaded = load(path)
    assert [m.controller for m in compare_module.compare(path, loaded.data, loaded.scenario).metrics] == list(
        loaded.scenario.controllers)


def test_collection_begins_late_and_then_is_seldom():
    before = gc.get_threshold()
    gc.collect()  # so that no count is near the limit yet
    try:
        gc.set_threshold(700, 10, 10)
        collect_later()
        collect_later()  # as of a program that calls the command line twice
        assert gc.get_threshold() == (MANY, 10, 10)
        kept = [[] for _ in range(MANY + 10_000)]
        assert gc.get_threshold() == (SELDOM, 10, 10)
        assert len(kept) > MANY
        gc.set_threshold(SELDOM + 1, 10, 10)
        collect_later()
        assert gc.get_threshold() == (SELDOM + 1, 10, 10)
        gc.set_threshold(0)
        collect_later()
        assert gc.get_threshold()[0] == 0
    finally:
        gc.set_threshold(*before)


def test_what_a_server_imports_is_never_looked_through_and_the_rest_seldom():
    before, frozen = gc.get_threshold(), gc.get_freeze_count()
    try:
        gc.set_threshold(700, 10, 10)
        with imports_left_out():
            assert not gc.isenabled()
            kept = [[] for _ in range(10_000)]
        assert gc.isenabled() and gc.get_threshold() == (SELDOM, 10, 10)
        assert gc.get_freeze_count() >= frozen + len(kept)
    finally:
        gc.unfreeze()
        gc.set_threshold(*before)


def test_a_command_ends_without_looking_through_all_that_it_imported():
    program = """
import sys
from workbench.cli.app import main

class Ring:
    def __del__(self):
        print("searched")

if len(sys.argv) > 1:
    try:
        main()
    except SystemExit:
        pass
ring = Ring()
ring.itself = ring
del ring
"""
    told = [subprocess.run([sys.executable, "-c", program, *arguments], check=True, capture_output=True, text=True,
                           timeout=300).stdout for arguments in ((), ("prove", "nowhere"))]
    assert told == ["searched\n", ""]


def test_a_run_needs_its_solver_and_no_modelling_tools():
    code, names = imported("reference", LINE, TRAIN, "--time", 2600)
    assert code == 0
    assert "clarabel" in names
    assert names.isdisjoint({"control", "cvxpy", "casadi", "matplotlib", "sympy", "scipy.optimize", *BROUGHT_ALONG})


def test_what_is_imported_later_is_there_when_it_is_used():
    program = """
import sys
from workbench.cli.unused import UNUSED, import_unused_later
import_unused_later()
import_unused_later()
import scipy.linalg
import numpy
print("numpy.f2py.f2py2e" in sys.modules, callable(numpy.f2py.get_include), "numpy.f2py.f2py2e" in sys.modules)
"""
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True, timeout=300)
    assert done.stdout.split() == ["False", "True", "True"]


def test_ctrl_c_while_the_command_is_imported_is_no_traceback():
    program = ("import runpy, sys\n"
               "class Pressed:\n"
               "    def find_spec(self, name, *more):\n"
               "        if name == 'typer': raise KeyboardInterrupt\n"
               "sys.meta_path.insert(0, Pressed())\n"
               "runpy.run_module('workbench', run_name='__main__')\n")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")
