"""Mutation test of the deciders: claims changed in one place; what an independent search breaks must be refuted.

    python benchmarks/mutation.py [PATHS] [--count 1500] [--seed 2021] [--jobs 2 | --dask ADDRESS] [--limit 30]
                                  [--json FILE]

Mutants are drawn evenly over all claims of all papers and over all kinds of change. A falsifier that shares no code
with the deciders (tests/proof/falsifier.py) looks for a point where a mutant's assumptions hold and its statement
fails, confirmed to as many digits as it takes. Mutants for which it finds one are `broken`; the deciders, which do not
see that point, should then answer `refuted`, `gap` or `violated` with a counterexample of their own, and never
`proved`. Mutants are handed to the executors of every long command. Exit code 1 when a broken mutant is proved.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import sys
import time
from collections import Counter
from contextlib import suppress
from dataclasses import asdict, dataclass
from fractions import Fraction
from itertools import zip_longest
from pathlib import Path
from typing import Any

import sympy as sp

from workbench.cli.options import on_cluster
from workbench.errors import ClaimError
from workbench.files.modules import module_in, package_of
from workbench.files.time_limit import OutOfTime, at_most_seconds
from workbench.proof.building import built
from workbench.proof.checker import CertificateError, margin, read_goal
from workbench.proof.claim import FAILED, Claim, Goal, Kind, name_of
from workbench.proof.decide.engine import decide, prove_goal
from workbench.proof.mutate import KINDS, Mutation, mutations
from workbench.proof.paper import collect_papers
from workbench.proof.pinned import pinned
from workbench.proof.text import goal_text, relation_text
from workbench.tasks.handing_out import run_tasks

ROOT = Path(__file__).parents[1]
FALSIFIER = ROOT / "tests" / "proof"
WANTED_SHARE = 0.99


@dataclass(frozen=True)
class Task:
    """A mutant of a claim, with what is needed to decide it in another process."""

    number: int
    claim: str
    kind: Kind
    at: dict[sp.Expr, Fraction] | None
    change: str
    place: str
    goal: Goal
    text: str


@dataclass(frozen=True)
class Outcome:
    """What the falsifier and the deciders said of one mutant."""

    number: int
    claim: str
    change: str
    place: str
    broken: bool
    witness: str
    verdict: str
    seconds: float
    text: str

    @property
    def paper(self) -> str:
        """The paper of the claim."""
        return self.claim.partition(":")[0]


def plan(paths: list[Path], count: int, seed: int) -> list[Task]:
    """`count` mutants, drawn in turn from every paper, every claim and, within a claim, from every kind of change."""
    rng = random.Random(seed)
    papers = [[claim for claim in paper.claims if claim.build is not None] for paper in collect_papers(paths)]
    for claims in papers:
        rng.shuffle(claims)
    in_turn = [claim for nth in zip_longest(*papers) for claim in nth if claim is not None]
    waiting = [_Pile(claim, rng) for claim in in_turn[:count]]
    tasks: list[Task] = []
    drawn: Counter[str] = Counter()
    while len(tasks) < count and waiting:
        for pile in tuple(waiting):
            mutation = pile.next(drawn)
            if mutation is None:
                waiting.remove(pile)
            elif len(tasks) < count:
                drawn[mutation[0]] += 1
                claim, goal = pile.claim, mutation[2]
                shown = "; ".join(relation_text(r) for r in goal.show)
                tasks.append(Task(len(tasks), claim.id, claim.kind, _stated(claim, goal), *mutation, shown))
    return tasks


def _stated(claim: Claim, goal: Goal) -> dict[sp.Expr, Fraction] | None:
    """The claim's stated values, for the symbols as they are in the mutant."""
    if claim.at is None:
        return None
    by_name = {name_of(s): s for s in goal.symbols()}
    return {by_name.get(name_of(s), s): Fraction(value) for s, value in claim.at.items()}


class _Pile:
    """The mutants of a claim that say something, of each kind in random order."""

    def __init__(self, claim: Claim, rng: random.Random) -> None:
        assert claim.build is not None
        self.claim, goal = claim, built(claim, claim.build)
        by_kind: dict[str, list[Mutation]] = {kind: [] for kind in KINDS}
        for mutation in mutations(goal):
            by_kind[mutation.kind].append(mutation)
        for pile in by_kind.values():
            rng.shuffle(pile)
        self.order = {kind: rng.random() for kind in KINDS}
        self.mutants = {kind: ((m.kind, m.place, mutant) for m in pile
                               if (mutant := m.of(goal)) is not None and _says_something(mutant))
                        for kind, pile in by_kind.items()}

    def next(self, drawn: Counter[str]) -> tuple[str, str, Goal] | None:
        """The next one, of the kind that was drawn least so far; None where there is no other."""
        for kind in sorted(KINDS, key=lambda kind: (drawn[kind], self.order[kind])):
            if (mutant := next(self.mutants[kind], None)) is not None:
                return mutant
        return None


def _says_something(goal: Goal) -> bool:
    """Whether the checker can read the goal: 1/x in an assumption needs to be known defined, in every certificate."""
    record = goal_text(goal)
    try:
        context, _ = read_goal(record)
        for shown in record["show"]:
            margin(context, shown)
    except CertificateError:
        return False
    return True


def judged(shared: tuple[Path, int, float], task: Task) -> Outcome:
    """`judge`, wherever it is run; shared: the folder of the falsifier, and what `judge` takes."""
    falsifier, seed, limit = shared
    if str(falsifier) not in sys.path:
        sys.path.insert(0, str(falsifier))
    return judge(task, seed, limit)


def judge(task: Task, seed: int, limit: float) -> Outcome:
    """Falsifier and deciders on one mutant, neither knowing of the other."""
    from falsifier import falsified  # noqa: PLC0415 - lies where the tests do

    started = time.perf_counter()
    goal = task.goal
    witness: Any = None
    with suppress(OutOfTime), at_most_seconds(limit):
        witness = falsified(goal, task.at, seed + task.number)
    verdict = "out of time"
    claim = Claim(id=task.claim, title="a mutant", kind=task.kind, printed="", recorded="undecided",
                  build=lambda: goal, at=task.at)
    with suppress(OutOfTime), at_most_seconds(limit):
        try:
            verdict = decide(claim).verdict
        except ClaimError:  # its stated values break its own assumptions: it says nothing
            verdict = "meaningless"
        except Exception as trouble:  # a decider that breaks is a finding, not the end of the run
            verdict = f"{type(trouble).__name__}: {trouble}"
    if witness is not None and verdict != "proved":  # refuted or not: would the provers have believed it?
        with suppress(OutOfTime), at_most_seconds(limit):
            verdict = "proved" if _provable(task) else verdict
    return Outcome(task.number, task.claim, task.change, task.place, witness is not None,
                   "" if witness is None else str(witness), verdict, time.perf_counter() - started, task.text)


def _provable(task: Task) -> bool:
    try:
        return prove_goal(pinned(task.goal, task.at) if task.at else task.goal) is not None
    except ClaimError:
        return False


def run(tasks: list[Task], seed: int, jobs: int, limit: float) -> list[Outcome]:
    """All mutants judged, with a line of progress now and then; in the order of the plan."""
    outcomes: list[Outcome] = []

    def record(outcome: Outcome) -> None:
        outcomes.append(outcome)
        if len(outcomes) % 50 == 0 or len(outcomes) == len(tasks):
            print(f"{len(outcomes)} of {len(tasks)} mutants", file=sys.stderr, flush=True)

    package_of(FALSIFIER)  # so that it is sent to a cluster
    run_tasks(judged, (FALSIFIER, seed, limit), tasks, jobs, record)
    return sorted(outcomes, key=lambda o: o.number)


def table(outcomes: list[Outcome], by: str) -> list[dict[str, Any]]:
    """One row for each paper or kind of change, and one for all."""
    groups: dict[str, list[Outcome]] = {}
    for outcome in outcomes:
        groups.setdefault(getattr(outcome, by), []).append(outcome)
    return [_row(name, group) for name, group in (*sorted(groups.items()), ("all", outcomes))]


def _row(name: str, group: list[Outcome]) -> dict[str, Any]:
    broken = Counter(o.verdict for o in group if o.broken)
    rest = Counter(o.verdict for o in group if not o.broken)
    failed = sum(broken[v] for v in FAILED)
    return {"group": name, "mutants": len(group), "broken": broken.total(), "broken_refuted": failed,
            "broken_proved": broken["proved"], "broken_undecided": broken.total() - failed - broken["proved"],
            "share": failed / broken.total() if broken.total() else None,
            "other_proved": rest["proved"], "other_refuted": sum(rest[v] for v in FAILED),
            "other_undecided": rest.total() - rest["proved"] - sum(rest[v] for v in FAILED)}


def print_table(rows: list[dict[str, Any]]) -> None:
    """The rows as text."""
    print(f"{'':26}{'mutants':>8}{'broken':>8}{'refuted':>9}{'undecided':>11}{'proved':>8}{'share':>9}"
          f"   not broken: {'proved':>7}{'refuted':>9}{'undecided':>11}")
    for r in rows:
        share = "-" if r["share"] is None else f"{100 * r['share']:.1f} %"
        print(f"{r['group']:26}{r['mutants']:8}{r['broken']:8}{r['broken_refuted']:9}{r['broken_undecided']:11}"
              f"{r['broken_proved']:8}{share:>9}{'':15}{r['other_proved']:7}{r['other_refuted']:9}"
              f"{r['other_undecided']:11}")
    print()


def print_cases(title: str, cases: list[Outcome]) -> None:
    """Mutants worth a look, one in two lines."""
    print(f"{title}: {len(cases)}")
    for o in cases:
        print(f"  {o.claim}, {o.change} at {o.place}, {o.verdict} ({o.seconds:.1f} s): {o.text[:300]}")
        if o.broken:
            print(f"    false at {o.witness[:300]}")


def main() -> int:
    """Run the mutation test; 1 when a broken mutant is proved, else 0."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("paths", nargs="*", type=Path, default=[ROOT / "proofs"], help="proof files or folders")
    parser.add_argument("--count", type=int, default=1500)
    parser.add_argument("--seed", type=int, default=2021)
    parser.add_argument("--jobs", type=int, default=2, help="processes of this machine")
    parser.add_argument("--dask", help="the address of a Dask cluster, or 'local'")
    parser.add_argument("--limit", type=float, default=30.0, help="seconds to falsify, to decide and to prove a mutant")
    parser.add_argument("--json", type=Path, help="also write tables and outcomes here")
    arguments = parser.parse_args()
    started = time.perf_counter()
    tasks = plan(arguments.paths, arguments.count, arguments.seed)
    with on_cluster(arguments.dask, None):
        outcomes = run(tasks, arguments.seed, arguments.jobs, arguments.limit)
    by_paper, by_change = table(outcomes, "paper"), table(outcomes, "change")
    print_table(by_paper)
    print_table(by_change)
    print_cases("broken, but not decided", [o for o in outcomes if o.broken and o.verdict not in (*FAILED, "proved")])
    print_cases("refuted, though the falsifier found nothing",
                [o for o in outcomes if not o.broken and o.verdict in FAILED])
    wrong = [o for o in outcomes if o.broken and o.verdict == "proved"]
    print_cases("BROKEN, BUT PROVED", wrong)
    print(f"{time.perf_counter() - started:.0f} s; wanted: no broken mutant proved, "
          f"at least {100 * WANTED_SHARE:.0f} % of the broken ones refuted")
    if arguments.json:
        arguments.json.write_text(json.dumps({
            "version": 1, "count": len(tasks), "seed": arguments.seed, "papers": by_paper, "changes": by_change,
            "outcomes": [asdict(o) for o in outcomes]}, indent=1) + "\n", encoding="utf-8")
    return 1 if wrong else 0


if __name__ == "__main__":
    if os.environ.get("PYTHONHASHSEED") != "0":  # which mutants are drawn depends on the order of sets
        os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | {"PYTHONHASHSEED": "0"})
    # As a module of a folder, under whose name other machines import it too.
    sys.exit(module_in(Path(__file__).parent, "mutation").main())
