"""`workbench prove --oracle`: what a solver says of the verdicts, asked, counted and shown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from enum import StrEnum
from typing import TYPE_CHECKING

from workbench.cli.console import out_console

if TYPE_CHECKING:
    from workbench.proof.document_format import ClaimsDocument
    from workbench.proof.oracle.opinion import Opinion
    from workbench.proof.verdict import Decision


class Oracle(StrEnum):
    """Solvers that give a second opinion."""

    z3 = "z3"


def require_oracle(oracle: Oracle | None) -> None:
    """InputError where one is asked for and not installed."""
    if oracle is not None:
        from workbench.proof.oracle.asking import require_oracle as require

        require(oracle)


def ask_oracle(oracle: Oracle | None, decisions: Sequence[Decision]) -> dict[str, Opinion]:
    """By the claim's id what it says, with progress; nothing where none is asked for."""
    if oracle is None:
        return {}
    from workbench.cli.terminal import progress
    from workbench.proof.oracle.asking import opinions_on

    with progress() as show:
        return opinions_on(decisions, lambda done, total: show(oracle, done, total))


def add_opinions(document: ClaimsDocument, oracle: Oracle | None, opinions: Mapping[str, Opinion]) -> None:
    """Put it into the rows of a document; where none was asked the rows stay as they are."""
    for row in document["claims"] if oracle is not None else ():
        row["oracle"] = opinions[row["id"]].row(oracle or "")


def print_opinions(oracle: Oracle | None, opinions: Mapping[str, Opinion], verbose: bool) -> None:
    """How many verdicts it agrees with, and why it tells nothing of others: how often each reason, verbose of which."""
    if oracle is None:
        return
    from workbench.proof.oracle.opinion import counted

    said = ", ".join(f"{number} {answer}" for answer, number in counted(opinions.values()).items())
    out_console.print(f"{oracle}: {said}", soft_wrap=True)
    untold = {name: opinion for name, opinion in opinions.items() if opinion.answer in ("unknown", "not asked")}
    for alike, number in Counter(untold.values()).most_common():
        names = f" ({', '.join(name for name, o in untold.items() if o == alike)})" if verbose else ""
        out_console.print(f"  {number} {alike.answer}: {alike.reason}{names}", soft_wrap=True, markup=False,
                          style="dim")
