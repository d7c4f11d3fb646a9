"""Decide what is asked for: from the cache what has not changed, the rest by as many workers as wanted."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from workbench.errors import InputError
from workbench.proof.cache import DecisionCache, FileEntry, decision_cache
from workbench.proof.dependencies import digest
from workbench.proof.fate import judged
from workbench.proof.kernel_record import read_record, with_kernel
from workbench.proof.messages import Decided, Listing
from workbench.proof.premises import below, premises_problem
from workbench.proof.selection import NO_PAPER, Target, chosen, files_of
from workbench.proof.verdict import Decision, Stated
from workbench.tasks.executor import named

Progress = Callable[[int, int], None]
LIMIT = 60.0  # seconds of processor time for one claim


@dataclass(frozen=True)
class Proof:
    """The claims that were asked for, decided; `now` are the ids of all that were not found in the cache, `certified`
    those of them that a certificate showed which lies with its paper, checked again.

    papers: by the name of each paper its folder or proof file; misstated: by id why a claim that was asked for could
    not be decided, in one line; it is not among the decisions.
    """

    decisions: list[Decision]
    now: frozenset[str]
    papers: Mapping[str, Path]
    misstated: Mapping[str, str] = field(default_factory=dict)
    certified: frozenset[str] = frozenset()


def prove(found: Sequence[Target], jobs: int | None = None, use_cache: bool = True,
          on_progress: Progress = lambda done, total: None, limit: float | None = LIMIT) -> Proof:
    """Decide the claims that the targets ask for, and those that they rest on; on_progress(decided, to decide).

    use_cache: what has not changed comes from the cache, and what a certificate in the paper's folder shows, which is
    checked like one just found, is not searched for; without it every claim is decided by search.
    The result is the same for every number of jobs, the seconds apart. A claim that takes more than `limit` seconds of
    processor time stays undecided. Raises InputError, naming the file, for a proof file that cannot be read and for
    claims that do not fit together; a claim that states nothing is told of, and the others are decided.
    """
    started_ns = time.time_ns()
    cached = decision_cache() if use_cache else None
    files = files_of(found)
    records = {file: read_record(file) for file in files}
    digests = cache(digest)  # many proof files read the same modules
    entries = {file: entry for file in files if cached and (entry := cached.file(file, digests))}
    missing = [file for file in files if file not in entries]
    with ExitStack() as stack:
        listings: dict[Path, Listing] = {}
        if missing:
            from workbench.proof.process_pool import worker_pool  # noqa: PLC0415 - what is known needs nobody
            from workbench.tasks.handing_out import places  # noqa: PLC0415 - as above

            workers = stack.enter_context(worker_pool(places(jobs), cached, limit))
            listings = dict(zip(missing, workers.listings(missing), strict=True))
        stated = {file: listings[file].claims if file in listings else tuple(d.claim for d in entries[file].decisions)
                  for file in files}
        claims = _well_formed(files, stated, {**entries, **listings})
        asked = chosen(found, stated)
        wanted = below(asked, claims)
        tasks = [(file, claim.id) for file in missing for claim in stated[file] if claim.id in wanted]
        known, total = len(wanted) - len(tasks), len(wanted)
        on_progress(known, total)
        results = workers.decided(tasks, lambda done: on_progress(known + done, total)) if tasks else []
    decided = {claim_id: result for (_, claim_id), result in zip(tasks, results, strict=True)}
    if cached and named() is None:  # what the processes of a cluster have read is not known here
        _keep_files(cached, listings, decided, started_ns)
    every = {d.claim.id: d for entry in entries.values() for d in entry.decisions if d.claim.id in wanted}
    every |= {claim_id: result.decision for claim_id, result in decided.items()}
    misstated = {claim_id: result.misstated for claim_id, result in decided.items()
                 if result.misstated is not None and claim_id in asked}
    paper_files = {claim.paper: file for file in files for claim in stated[file]}
    every_judged = with_kernel(judged([every[claim_id] for claim_id in claims if claim_id in wanted]),
                               {paper: records[file] for paper, file in paper_files.items()})
    return Proof([d for d in every_judged if d.claim.id in asked and d.claim.id not in misstated],
                 frozenset(claim_id for claim_id, result in decided.items()
                           if result.now and claim_id not in misstated),
                 paper_files, misstated,
                 frozenset(claim_id for claim_id, result in decided.items() if result.certified))


def _well_formed(files: Sequence[Path], stated: dict[Path, tuple[Stated, ...]],
                 papers: dict[Path, FileEntry | Listing]) -> dict[str, Stated]:
    """All claims by id, in their order; raises InputError when there is no paper or the premises do not fit."""
    if not any(papers[file].papers for file in files):
        raise InputError(files[0], "", NO_PAPER)
    every = [(file, claim) for file in files for claim in stated[file]]
    problem = premises_problem([claim for _, claim in every])
    if problem is not None:
        raise InputError(next(file for file, claim in reversed(every) if claim.id == problem[0]), "", problem[1])
    return {claim.id: claim for _, claim in every}


def _keep_files(cached: DecisionCache, listings: dict[Path, Listing], decided: dict[str, Decided],
                started_ns: int) -> None:
    """Keep the proof files of which every claim is decided."""
    for file, listing in listings.items():
        results = [decided[claim.id] for claim in listing.claims if claim.id in decided]
        if len(results) == len(listing.claims) and all(result.lasting for result in results):
            reads = listing.reads.union(*(result.reads for result in results))
            cached.keep_file(file, FileEntry(listing.papers, tuple(r.decision for r in results)), reads, started_ns)
    if listings:
        cached.tidy()
