"""What an oracle says of a verdict."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, get_args

from typing_extensions import TypedDict

Answer = Literal["agreed", "unknown", "not asked", "contradicted"]
ANSWERS: tuple[Answer, ...] = get_args(Answer)


class OracleRow(TypedDict):
    """What a solver says of a verdict, with the reason or how far; no verdict rests on it."""

    solver: str
    answer: Answer
    reason: str


@dataclass(frozen=True)
class Opinion:
    """Whether an oracle agrees with a verdict, and why, or how far; `unknown` is an answer that tells nothing."""

    answer: Answer
    reason: str = ""

    def row(self, solver: str) -> OracleRow:
        """As documents have it."""
        return {"solver": solver, "answer": self.answer, "reason": self.reason}


def counted(opinions: Iterable[Opinion]) -> dict[Answer, int]:
    """How many of each answer there are."""
    found = Counter(opinion.answer for opinion in opinions)
    return {answer: found[answer] for answer in ANSWERS}
