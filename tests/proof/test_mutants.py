"""A sample of the mutation test of benchmarks/mutation.py: claims with one thing changed.

What an independent search breaks must be refuted, and must never come out proved.
"""

import sys
from collections import Counter
from pathlib import Path

import pytest

from workbench.proof.mutate import KINDS

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from mutation import FAILED, judge, plan  # noqa: E402

WANTED, SEED, LIMIT = 64, 2, 4.0


@pytest.fixture(scope="module")
def outcomes():
    return [judge(task, SEED, LIMIT) for task in plan([ROOT / "proofs"], WANTED, SEED)]


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
    papers = {path.stem for path in (ROOT / "proofs").glob("*.py") if not path.name.startswith("_")}
    assert {o.paper for o in outcomes} == papers
    assert {o.change for o in outcomes} == set(KINDS)


def test_the_plan_is_the_same_for_the_same_seed():
    one, two = (plan([ROOT / "proofs" / "yang2021.py"], 12, 5) for _ in range(2))
    assert one == two
    assert one != plan([ROOT / "proofs" / "yang2021.py"], 12, 6)
