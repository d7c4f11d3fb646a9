"""Many exports are one file for coqc in which none sees another, and a part that fails is found."""

import subprocess
from pathlib import Path
from typing import Any

import pytest

from workbench.kernel import coqc
from workbench.kernel.batches import batch_text, expected_seconds, export_of, parted, planned
from workbench.kernel.export import document
from workbench.kernel.vernacular import without_comments

FLOW = {"flow": {"x": "-x"}, "show": ["D(x**2) == -2*x**2"]}


def exported(number: int, goal: dict[str, Any] | None = None) -> Any:
    """The export of an identity."""
    goal = goal or {"show": [f"{number}*x == x*{number}"]}
    text = document({"version": 2, "claim": f"mine:{number}", "verdict": "proved", "example": {"x": "1"}, "goal": goal,
                     "proofs": [{"rule": "identity"}]})
    return export_of(f"mine_{number}.v", text)


def test_a_batch_holds_all_theorems_each_in_a_module_and_loads_once() -> None:
    batch = [exported(number) for number in range(3)]
    text = batch_text(batch)
    assert text.count("Require Import Reals Lra.") == text.count("Open Scope R_scope.") == 1
    bare = without_comments(text)
    assert bare is not None
    for number, one in enumerate(batch):
        module = bare.partition(f"Module Export_{number}.")[2].partition(f"End Export_{number}.")[0]
        assert f"({number} * v_x) = (v_x * {number})" in module and "Print Assumptions" not in module
        assert one.text.endswith(one.theorems) and one.printed == ["claim_holds"]


def test_what_the_theorems_of_a_batch_rest_on_is_asked_once_of_all() -> None:
    text = batch_text([exported(number) for number in range(3)])
    assert text.endswith("Definition all_hold := (Export_0.claim_holds, Export_1.claim_holds, Export_2.claim_holds).\n"
                         "Print Assumptions all_hold.\n")
    assert text.count("Print Assumptions") == 1


@pytest.mark.parametrize("spoil", [
    lambda text: text + "Require Import Reals Lra.\n", lambda text: text.replace("Open Scope R_scope.", ""),
    lambda text: f"(* {text}", lambda text: text.replace("Print Assumptions claim_holds.", ""),
    lambda text: text.replace("Require Import Reals Lra.", "")])
def test_a_file_of_another_shape_is_shown_alone(spoil: Any) -> None:
    odd = export_of("mine_9.v", spoil(exported(9).text))
    assert not odd.loads
    assert [odd] in [list(batch) for batch in planned([exported(1), odd, exported(2)], 1, 120)]


def test_batches_load_the_same_and_the_longest_come_first() -> None:
    plain, moving = [exported(number) for number in range(40)], [exported(number, FLOW) for number in range(40, 45)]
    batches = planned([*plain, *moving], 2, 120)
    assert sorted(one.name for batch in batches for one in batch) == sorted(one.name for one in (*plain, *moving))
    assert all(len({one.loads for one in batch}) == 1 for batch in batches)
    assert len(batches) < 10
    costs = [expected_seconds(batch) for batch in batches]
    assert costs == sorted(costs, reverse=True) and max(costs) < 20
    assert planned(reversed([*plain, *moving]), 2, 120) == batches


def test_the_file_that_coqc_stops_at_is_taken_out_and_else_halves_are_tried() -> None:
    batch = tuple(exported(number) for number in range(4))
    text = batch_text(batch)
    for at, one in enumerate(batch):
        for mark in (f"Module Export_{at}.", f"({at} * v_x) = ", f"End Export_{at}."):
            lines = [number for number, line in enumerate(text.splitlines(), 1) if mark in line]
            assert [parted(batch, line) for line in lines] == [[(one,), (*batch[:at], *batch[at + 1:])]], mark
    halves = [batch[:2], batch[2:]]
    assert parted(batch, None) == parted(batch, 1) == parted(batch, len(text.splitlines())) == halves


@pytest.mark.parametrize("told", [True, False])
def test_every_file_is_accepted_in_a_run_that_ends_well_or_refused_alone(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch, told: bool) -> None:
    """Whatever coqc says of a batch that fails; told: whether it says how far it came."""
    batch, runs = tuple(exported(number) for number in range(9)), list[str]()

    def run(folder: Path, name: str, seconds: float) -> coqc.Ran:
        text = (folder / name).read_text()
        runs.append(name)
        wrong = [(number, line) for line, said in enumerate(text.splitlines(), 1) for number in (2, 7)
                 if f"({number} * v_x)" in said]
        if wrong:
            return coqc.Ran("", f"of {wrong[0][0]}", wrong[0][1] if told else None)
        return coqc.Ran(coqc.CLOSED)

    monkeypatch.setattr(coqc, "_coqc", run)
    found = coqc._troubles(tmp_path, batch, "Batch'0", 5)
    assert {one.name: why for one, why in found.items() if why} == {"mine_2.v": "of 2", "mine_7.v": "of 7"}
    assert list(map(len, (found, set(found)))) == [9, 9] and len(runs) <= 16


def test_a_run_that_tells_less_than_it_was_asked_accepts_nothing(
        tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(coqc, "_coqc", lambda folder, name, seconds: coqc.Ran(coqc.CLOSED * 2))
    found = coqc._troubles(tmp_path, (exported(1), exported(2)), "B'", 5)
    assert set(found.values()) == {"says not what it rests on"}
    monkeypatch.setattr(coqc, "_coqc", lambda folder, name, seconds: coqc.Ran(""))
    assert set(coqc._troubles(tmp_path, (exported(1), exported(2)), "B'", 5).values()) == {
        "says not what it rests on"}


def test_a_limit_of_the_processors_time_that_stands_already_is_kept(
        monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No shell can raise one, and coqc would not be run at all."""
    asked: list[list[str]] = []

    def run(command: list[str], **_: Any) -> subprocess.CompletedProcess[str]:
        asked.append(command)
        return subprocess.CompletedProcess(command, 0, "", "")

    monkeypatch.setattr(coqc.subprocess, "run", run)
    for most, told in ((7, "7"), (500, "120"), (coqc.resource.RLIM_INFINITY, "120")):
        monkeypatch.setattr(coqc.resource, "getrlimit", lambda _, most=most: (most, most))
        coqc._coqc(tmp_path, "a.v", 120)
        assert asked[-1][3] == told
