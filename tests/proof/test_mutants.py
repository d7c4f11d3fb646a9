"""A sample of the mutation test of benchmarks/mutation.py: claims with one thing changed.

What an independent search breaks must be refuted, and must never come out proved.
"""

import gc
import sys
import time
import weakref
from collections import Counter
from contextlib import suppress
from pathlib import Path

import pytest
from child_process import made_in_a_fork

from workbench.files.folders import papers_in
from workbench.files.time_limit import OutOfTime, at_most_seconds
from workbench.proof.mutate import KINDS

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from mutation import FAILED, judge, plan  # noqa: E402

WANTED, SEED, LIMIT = 24, 2, 1.5


@pytest.fixture(scope="module")
def outcomes():
    return made_in_a_fork(lambda: [judge(task, SEED, LIMIT) for task in plan([ROOT / "proofs"], WANTED, SEED)])


def test_no_broken_mutant_is_proved(outcomes):
    assert [o for o in outcomes if o.broken and o.verdict == "proved"] == []


def test_broken_mutants_are_refuted(outcomes, capsys):
    broken = Counter("refuted" if o.verdict in FAILED else o.verdict for o in outcomes if o.broken)
    rest = Counter("refuted" if o.verdict in FAILED else o.verdict for o in outcomes if not o.broken)
    with capsys.disabled():
        sys.stdout.write(f"\nmutants: {len(outcomes)}; broken by random search: {dict(broken)}; "
                         f"not broken: {dict(rest)}\n")
    assert broken.total() >= WANTED // 2
    assert broken["refuted"] >= 0.95 * (broken.total() - broken["out of time"])


def test_the_sample_has_all_papers_and_all_kinds_of_change(outcomes):
    papers = {folder.name for folder in papers_in(ROOT / "proofs")}
    assert {o.paper for o in outcomes} == papers
    assert {o.change for o in outcomes} == set(KINDS)


def test_the_plan_is_the_same_for_the_same_seed():
    one, two = (plan([ROOT / "proofs" / "ilchmann2002"], 12, 5) for _ in range(2))
    assert one == two
    assert one != plan([ROOT / "proofs" / "ilchmann2002"], 12, 6)


def _collected(_phase: str, _info: dict[str, int]) -> None:
    _work_for(0.05)


class _Finalized:
    def __del__(self) -> None:
        _work_for(0.05)


def _work_for(seconds: float) -> None:
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass


@pytest.mark.parametrize("work", [gc.collect, _Finalized, lambda: weakref.finalize(_Finalized(), _work_for, 0.05)])
def test_a_limit_holds_where_python_drops_exceptions(work):
    """An exception raised in such a place would be reported as a warning, which is an error here, and end nothing."""
    gc.callbacks.append(_collected)
    started = time.process_time()
    try:
        with suppress(OutOfTime), at_most_seconds(0.1):
            while time.process_time() < started + 5:
                work()
                _work_for(0.03)
    finally:
        gc.callbacks.remove(_collected)
    assert time.process_time() < started + 4
