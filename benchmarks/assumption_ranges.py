"""In what range the papers' headline numbers lie over all that is assumed, as a page of Markdown.

    python benchmarks/assumption_ranges.py DIR docs/assumptions.md [PAPER ...]     # goes on with the runs that DIR has
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

from contest_summary import shown

from workbench.cli.loading import load
from workbench.cli.terminal import progress
from workbench.paper.loading import Loaded
from workbench.paper.sensitivity import JOURNAL_NAME, Found, sensitivity, sensitivity_lines, sensitivity_table

PAPERS = Path(__file__).parents[1] / "proofs"


def stated() -> Iterator[Loaded]:
    """The papers whose study states a joint sweep."""
    for folder in sorted(path.parent for path in PAPERS.glob("*/study.toml")):
        loaded = load(folder)
        if loaded.record.joint_sensitivity is not None:
            yield loaded


def section(loaded: Loaded, found: Found) -> Iterator[str]:
    """What a paper's sweep says."""
    table, source = found.stated, found.stated.source
    yield from (f"## {loaded.record.name}", "")
    told = (table.case and source.get("case"), table.controller and source.get("controller"), source.get("metric"),
            source.get("failed"), source.get("ranges"))
    words = "; ".join(text.partition(": ")[2] for text in told if text)
    yield from (f"{words[0].upper()}{words[1:]}.", "")
    keys = [table.metric, *table.ranges]
    yield from (*(f"- {_as_code(line, keys)}" for line in sensitivity_lines(found)), "")
    for line in shown(sensitivity_table(found)):
        yield re.sub(r"^\| ([\w.<>]+\.[\w.<>]+)", lambda key: f"| `{key[1].replace('<wbr>', '')}`", line)


def _as_code(line: str, keys: list[str]) -> str:
    """A sentence whose keys of the study's file are code."""
    return re.sub(rf"(?<![\w.])(?:{'|'.join(map(re.escape, keys))})(?![\w.]*\w)", r"`\g<0>`", line)


def main() -> None:
    """Run what is not run yet, and write the page."""
    folder, out = map(Path, sys.argv[1:3])
    wanted, left = sys.argv[3:], []
    lines = ["# What the assumptions decide", "",
             "A paper that does not print a gain, a curve or a step leaves a reader to assume it. Here all assumed "
             "values of a study are drawn at once, each from its range, and the number that carries the paper's "
             "headline is computed anew: `workbench sweep proofs/PAPER --sensitivity` runs one of these sweeps, "
             "`benchmarks/assumption_ranges.py` all of them, and writes this page. Assumed values and the number "
             "that is looked at are named by their keys, as in the paper's `study.toml`, where each has its "
             "reason.", ""]
    for loaded in stated():
        if wanted and loaded.record.name not in wanted:
            left.append(loaded.record.name)
            continue
        own = folder / loaded.record.name
        with progress() as show:
            found = sensitivity(loaded, own, (own / JOURNAL_NAME).exists(), None,
                                lambda done, total, name=loaded.record.name: show(name, done, total))
        lines += section(loaded, found)
    if left:
        lines.append(f"Stated in its file and not run for this page: {', '.join(left)}.")
    out.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
