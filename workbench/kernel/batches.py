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
PRINTED = "\nPrint Assumptions "
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
    def printed(self) -> int:
        """Of how many theorems it asks what they rest on."""
        return self.text.count(PRINTED)


def export_of(name: str, text: str) -> Export:
    """A file's text in its parts."""
    parts = _EXPORT.fullmatch(text)
    bare = None if parts is None else without_comments(parts["theorems"])
    if parts is None or bare is None or _LOADS.search(bare):
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
    """One file with the theorems of all, each in a module of its own, so that no name of one is seen by another."""
    modules = (f"Module Export_{number}.\n{export.theorems}End Export_{number}.\n"
               for number, export in enumerate(batch))
    return f"{batch[0].loads}{OPENING}" + "\n".join(modules)


def parted(batch: Sequence[Export], theorems: int) -> list[tuple[Export, ...]]:
    """A batch that fails, to be tried again in two parts, given of how many theorems coqc has told what they rest on:
    the file after these alone, and all others; in halves where that tells nothing."""
    done = 0
    for number, export in enumerate(batch):
        done += export.printed
        if done > theorems > 0:
            others = (*batch[:number], *batch[number + 1:])
            return [(export,), others]
    half = len(batch) // 2
    return [tuple(batch[:half]), tuple(batch[half:])]


def count_of(batch: Iterable[Export]) -> int:
    """Of how many theorems the files ask what they rest on."""
    return sum(export.printed for export in batch)
