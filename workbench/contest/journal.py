"""The matches of a contest kept as they are played, so that an interrupted one goes on where it stopped."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from workbench.contest.matches import Match
from workbench.contest.record import Contest
from workbench.errors import InputError
from workbench.simulate.journal import REMEDY, Journal, code_digest, laws_digest

JOURNAL_NAME = "matches.journal.jsonl"
# On which modules of the package a match depends.
PLAYING = ("files/*.py", "model/*.py", "trains/*.py", "compile/*.py", "mpc/*.py", "simulate/*.py", "paper/*.py",
           "contest/*.py")
# What may differ between a contest and the one that goes on with its matches: more draws, other intervals, words.
FREE = ("seeds", "resamples", "confidence", "racing", "scenario", "title", "citation", "source", "absent")


def matches_journal(folder: Path, contest: Contest, resume: bool) -> Journal:
    """The journal of a contest's matches in a folder; InputError where it is another contest's, or cannot be written.

    Matches depend on the contest's values, its scenario and the code alone, all of which the journal's digest holds.
    """
    digest = contest_digest(contest, "pareto")
    return Journal(folder / JOURNAL_NAME, {"contest": contest.name, "seed": contest.seed,
                                           "digest of values, line and code": digest}, resume)


def contest_digest(contest: Contest, *left_out: str) -> str:
    """A digest of the values that runs depend on, but for some of them, of the scenario and of the code."""
    free: Any = dict.fromkeys((*FREE, *left_out), True) | {"tuning": {"results", "results_in"}}
    text = world_digest(contest) + json.dumps(contest.model_dump(exclude=free), sort_keys=True, default=str)
    return hashlib.sha256(code_digest(*PLAYING) + text.encode()).hexdigest()[:20]


def world_digest(contest: Contest) -> str:
    """A digest of the scenario and of the laws of all who take part."""
    text = json.dumps(contest.world.model_dump(exclude={"title", "citation"}), sort_keys=True, default=str)
    return hashlib.sha256(laws_digest(contest.world) + text.encode()).hexdigest()


def matches_of(journal: Journal) -> list[Match]:
    """The matches that a journal held when it was opened; InputError for a record that is none."""
    read: TypeAdapter[Any] = TypeAdapter(Match)
    try:
        return [read.validate_python(record) for record in journal.records]
    except ValidationError:
        raise InputError(journal.path, "", f"holds a record that is no match of a contest: {REMEDY}") from None
