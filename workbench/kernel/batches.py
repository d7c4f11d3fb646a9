"""Many exports in one run of coqc, because starting it and loading its libraries takes longer than most proofs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from workbench.kernel.export import IMPORTS, OPENING
from workbench.kernel.vernacular import without_comments

# An export: what it is for, in a comment; what it loads, which stands before the first statement; its theorems.
_EXPORT = re.compile(r"\(\*(?:(?!\(\*).)*?\*\)\n(?P<loads>(?:(?:From \w+ )?Require Import [\w ]+\.\n)+)"
                     + re.escape(OPENING) + r"(?P<theorems>.*)", re.DOTALL)
_LOADS = re.compile(r"\b(?:Require|Import|Open)\b")
_PRINTED = re.compile(r"^Print Assumptions (\w+)\.\n", re.M)
ALL = "all_hold"  # the pair of pairs of all proofs of a batch
# Processor seconds that coqc takes, measured on committed certificates: for each library, and for the text.
SECONDS_TO_LOAD = {"Interval": 1.0, "WorkbenchFlow": 0.3, "WorkbenchFractions": 0.3, "Workbench": 0.7}
SECONDS_A_LETTER = 3e-4
LOADING_SHARE = 10  # a batch takes at least so many times what loading takes, as far as there are files


@dataclass(frozen=True)
class Export:
    """A Coq file as it was exported: its name, what it loads, and its theorems; `loads` is empty where its text is of
    no known shape, and then it is checked alone."""

    name: str
    text: str
    loads: str
    theorems: str

    @property
    def seconds(self) -> float:
        """What coqc is expected to take for its proofs."""
        return SECONDS_A_LETTER * len(self.text)

    @property
    def printed(self) -> list[str]:
        """The theorems of which it asks what they rest on."""
        return _PRINTED.findall(self.text)


def export_of(name: str, text: str) -> Export:
    """A file's text in its parts."""
    parts = _EXPORT.fullmatch(text)
    bare = None if parts is None else without_comments(parts["theorems"])
    if parts is None or bare is None or _LOADS.search(bare) or not _PRINTED.search(bare):
        return Export(name, text, "", text)
    return Export(name, text, parts["loads"], parts["theorems"])


def planned(exports: Iterable[Export], workers: int, seconds: float) -> list[tuple[Export, ...]]:
    """Batches of exports that load the same, the longest proofs first; each is expected to take at most a sixth of
    `seconds` and of a worker's share of the whole, unless one file alone does or loading would take a larger part."""
    alike: dict[str, list[Export]] = {}
    for export in sorted(exports, key=lambda export: (-export.seconds, export.name)):
        alike.setdefault(export.loads or export.name, []).append(export)
    whole = sum(export.seconds for group in alike.values() for export in group)
    found: list[tuple[Export, ...]] = []
    for group in alike.values():
        limit = max(min(whole / (6 * workers), seconds / 6), LOADING_SHARE * loading_seconds(group[0].loads))
        batch: list[Export] = []
        for export in group:
            if batch and sum(one.seconds for one in batch) + export.seconds > limit:
                found.append(tuple(batch))
                batch = []
            batch.append(export)
        found.append(tuple(batch))
    return sorted(found, key=expected_seconds, reverse=True)


def expected_seconds(batch: Sequence[Export]) -> float:
    """What coqc is expected to take for a batch."""
    return loading_seconds(batch[0].loads) + sum(one.seconds for one in batch)


def loading_seconds(loads: str) -> float:
    """What coqc is expected to take to load the libraries."""
    return sum(taken for name, taken in SECONDS_TO_LOAD.items() if IMPORTS[name] in loads)


def batch_text(batch: Sequence[Export]) -> str:
    """One file with the theorems of all, each in a module of its own, so that no name of one is seen by another.

    What they rest on is asked once of all proofs together: coqc walks through a library such as Interval for each
    question, which takes it longer than most proofs.
    """
    proofs = [f"Export_{number}.{name}" for number, export in enumerate(batch) for name in export.printed]
    return (f"{batch[0].loads}{OPENING}" + "\n".join(_module(number, export) for number, export in enumerate(batch))
            + f"\nDefinition {ALL} := ({', '.join(proofs)}).\nPrint Assumptions {ALL}.\n")


def _module(number: int, export: Export) -> str:
    return f"Module Export_{number}.\n{_PRINTED.sub('', export.theorems)}End Export_{number}.\n"


def parted(batch: Sequence[Export], line: int | None) -> list[tuple[Export, ...]]:
    """A batch that fails, to be tried again in two parts, given the line of its text that coqc stops at: the file that
    stands there alone, and all others; in halves where that tells nothing."""
    at = len((batch[0].loads + OPENING).splitlines()) + 1
    for number, export in enumerate(batch):
        after = at + len(_module(number, export).splitlines()) + 1
        if line is not None and at <= line < after:
            return [(export,), (*batch[:number], *batch[number + 1:])]
        at = after
    half = len(batch) // 2
    return [tuple(batch[:half]), tuple(batch[half:])]
