"""A light installation proves, and says in one line what it lacks. The packages of extras are hidden as if absent."""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from workbench.errors import EXTRAS
from workbench.paper.new_paper import write_new_paper

PROJECT = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PROGRAM = """
import contextlib, io, json, sys

class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in hidden:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

hidden, commands = json.loads(sys.argv[1])
sys.meta_path.insert(0, Hidden())
from workbench.cli.app import main
told = []
for command in commands:
    sys.argv, errors = ["workbench", *command], io.StringIO()
    with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
        try:
            main()
        except SystemExit as end:
            code = end.code or 0
    told.append([code, errors.getvalue()])
import workbench as wb
try:
    wb.simulate
except wb.errors.MissingExtraError as trouble:
    told.append([None, str(trouble)])
print(json.dumps(told))
"""


def names_of(requirements):
    return {re.split(r"[\[>=<]", one)[0] for one in requirements}


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    folder = tmp_path_factory.mktemp("light")
    paper = str(write_new_paper("mine2026", folder, "plant"))
    commands = [["prove", f"{paper}::{claim}", "--workers", "1", "--no-cache"] for claim in (4, 7)] + [
                ["compare", paper, "--workers", "1"], ["tune", paper, "--workers", "1"],
                ["report", paper, "--out", str(folder / "page"), "--workers", "1"]]
    done = subprocess.run([sys.executable, "-c", PROGRAM, json.dumps([sorted(EXTRAS), commands])], check=False,
                          capture_output=True, text=True, timeout=300, cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder, json.loads(done.stdout.splitlines()[-1])


def test_proofs_and_counterexamples_need_no_extra(told):
    _, (proved, refuted, *_) = told
    assert proved[0] == 0 and refuted[0] == 0, (proved, refuted)


def test_a_verb_that_needs_one_says_which_in_one_line(told):
    folder, (_, _, *refused, in_python) = told
    for code, line in (*refused, in_python):
        found = re.findall(r"(\w+) is not installed, which this needs: pip install 'workbench\[(\w+)\]'", line)
        assert code in (2, None) and len(found) == 1 and EXTRAS[found[0][0]] == found[0][1], line
        assert "Traceback" not in line
    assert not (folder / "page").exists()


def test_what_an_extra_brings_is_what_is_said_of_it_and_all_brings_everything():
    extras = PROJECT["optional-dependencies"]
    for name, extra in EXTRAS.items():
        assert name == "llvmlite" or name in names_of(extras[extra])
        assert name not in names_of(PROJECT["dependencies"])
    (everything,) = extras["all"]
    assert {"simulate", "mpc", "optimal", "tune", "report"} == set(re.findall(r"\w+", everything)) - {"workbench"}
