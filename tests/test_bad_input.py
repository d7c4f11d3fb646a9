"""A seeded sample of benchmarks/bad_input.py: whatever is spoiled, a command ends well or says why not in one line."""

import random
import sys

import pytest
from scenarios import ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
from bad_files import spoil
from bad_input import ARGUMENT, cases, faults, run
from bad_input_folders import COMMANDS, write_folders
from bad_input_texts import line_text

from workbench.files import time_limit

# Those that are written and read in no time.
FOLDERS = ("claims", "source")
VERBS = ("prove", "check", "check-certificates", "diff", "export-coq", "list", "new-paper")


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    place = tmp_path_factory.mktemp("valid")
    write_folders(place, FOLDERS)
    return place


def test_a_sample_of_bad_input_is_refused_in_one_line_each_or_ends_well(folders, tmp_path, monkeypatch):
    monkeypatch.setattr(time_limit, "WAITING_S", 2.0)  # a pipe is waited for so long
    commands = [command for command in COMMANDS if command.folder in FOLDERS and command.verb in VERBS]
    found = {}
    for case in cases(60, 20, commands):
        ended = run(case, folders, tmp_path / "here")
        if wrong := faults(case, ended):
            found[case] = ended.how, wrong, ended.said[-300:]
    assert found == {}


def test_what_is_wrong_is_noticed(folders, tmp_path):
    """A command that is none of ours: one that writes where it should not, and ends with a traceback."""
    case = next(case for case in cases(50, 1) if case.spoiled == ARGUMENT and case.command.folder in FOLDERS)
    ended = run(case, folders, tmp_path / "here")
    for change, words in (({"said": "Traceback (most recent call last)\nValueError: x"}, "traceback"),
                          ({"code": -9}, "exit code"), ({"seconds": 30.0}, "more than"), ({"bytes": 2 * 10**9}, "1 GB"),
                          ({"changed": ["study.toml"]}, "changed"), ({"code": 2, "said": "no\n"}, "lines of refusal"),
                          ({"code": 2, "said": f"workbench: a: b: {'x' * 3000}\n"}, "a line of 3")):
        spoiled = type(ended)(**{**vars(ended), "code": 0, "said": "", "seconds": 0.0, "changed": [], **change})
        assert any(words in one for one in faults(case, spoiled)), words


def test_files_are_spoiled_in_every_way_and_alike_for_a_seed(tmp_path):
    path, seen = tmp_path / "line.toml", set()
    for seed in range(60):
        path.unlink(missing_ok=True) if not path.is_dir() else path.rmdir()
        path.write_text(line_text())
        seen.add(spoil(random.Random(seed), path))
    assert {"toml", "text", "bytes"} < seen
    assert seen & {"folder", "pipe", "loop", "device", "huge", "socket", "nothing", "memory", "dangling link"}
