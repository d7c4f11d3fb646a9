"""Goals with one thing changed: what a random search breaks must not come out proved."""

import random
import sys
from collections import Counter
from pathlib import Path

import pytest
from independent import Evaluated

from workbench.errors import ClaimError
from workbench.proof.decide.engine import pinned, prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.mutate import mutants
from workbench.proof.paper import collect_papers

PROOFS = Path(__file__).parents[2] / "proofs"
WANTED = 60


def sampled_mutants():
    rng = random.Random(2021)
    pool = []
    for claim in (c for paper in collect_papers([PROOFS]) for c in paper.claims if c.build is not None):
        goal = claim.build()
        if goal.eventually is None:
            try:
                goal = pinned(goal, claim.at) if claim.at else goal
            except ClaimError:
                continue
            pool.append((claim.id, list(mutants(goal))))
    chosen = []
    while len(chosen) < WANTED:
        name, candidates = pool[len(chosen) % len(pool)]
        if candidates:
            chosen.append((name, candidates.pop(rng.randrange(len(candidates)))))
        else:
            pool.remove((name, candidates))
    return chosen


@pytest.fixture(scope="module")
def outcomes():
    found = []
    for number, (claim, mutant) in enumerate(sampled_mutants()):
        broken = Evaluated(mutant.goal).falsifying_point(number, batches=3)
        proved = prove_goal(mutant.goal) is not None
        refuted = not proved and find_counterexample(mutant.goal, "refuted") is not None
        found.append((claim, mutant, broken, "proved" if proved else "refuted" if refuted else "undecided"))
    return found


def test_no_broken_mutant_is_proved(outcomes):
    wrong = [f"{claim}: {m.kind} at {m.place}: {point}" for claim, m, point, verdict in outcomes
             if point is not None and verdict == "proved"]
    assert wrong == []


def test_most_mutants_are_broken_and_decided(outcomes, capsys):
    broken = Counter(verdict for _, _, point, verdict in outcomes if point is not None)
    rest = Counter(verdict for _, _, point, verdict in outcomes if point is None)
    with capsys.disabled():
        sys.stdout.write(f"\nmutants: {len(outcomes)}; broken by random search: {dict(broken)}; "
                         f"not broken: {dict(rest)}\n")
    assert broken.total() >= WANTED // 2
    assert broken["refuted"] >= 0.8 * broken.total()
