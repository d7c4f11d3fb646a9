"""Mutants of the page: of a line as it is printed, and of a number that the paper states.

    python benchmarks/page_mutants.py [PAPERS] [--lines 2000] [--numbers 40] [--seed 2021] [--json FILE]

A line that a machine finds in its goal (`parsed`) is printed with one thing changed: a sign, a relation, an index, a
dot or an accent, a power, a factor. It must no longer be found there, else the page could say other than what is
decided. A number of `study.toml` is changed in a copy of the paper's folder: where a claim reads it, the certificates
must no longer be of the paper's claims. Exit code 1 when a number is read and not noticed.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from workbench.files.folders import CERTIFICATES
from workbench.files.folders import papers_in as folders_in
from workbench.proof.binding import check_claims
from workbench.proof.building import built
from workbench.proof.claim import Claim, Goal
from workbench.proof.fingerprint import fingerprint
from workbench.proof.latex.match import match, match_claim
from workbench.proof.loading import ProofFile
from workbench.proof.paper import papers_in

ROOT = Path(__file__).parents[1]
STUDY = "study.toml"
# By kind what is looked for, and what takes its place.
CHANGES: dict[str, tuple[tuple[str, str], ...]] = {
    "sign": ((r"(?<![\^_{(\[=])\s\+\s", " - "), (r"(?<=[\w}\])])\s*-\s*(?=[\w\\({])", " + "),
             (r"(?<=[\w}\])])\s*\+\s*(?=[\w\\({])", " - ")),
    "relation": ((r"\\leq?(?![A-Za-z])", r"\\ge "), (r"\\geq?(?![A-Za-z])", r"\\le "), (r"<", ">"), (r">", "<"),
                 (r"(?<![\\!<>])=", r"\\le ")),
    "index": ((r"_\{?1(?!\d)\}?", "_{2}"), (r"_\{?2(?!\d)\}?", "_{1}"), (r"_0(?!\d)", "_{1}")),
    "dot": ((r"\\d?dot(?![A-Za-z])", ""),),
    "accent": ((r"\\(?:hat|tilde|bar)(?![A-Za-z])", ""),),
    "power": ((r"\^\{?2(?!\d)\}?", "^{3}"), (r"\^\{?3(?!\d)\}?", "^{2}"), (r"\^\{?4(?!\d)\}?", "^{2}")),
    "factor": ((r"(?<=\\frac\{)1(?=\})", "3"), (r"\\t?frac12", r"\\frac{1}{3}"), (r"(?<=\}\{)2(?=\})", "3"),
               (r"(?<![\d_^{.\w])2(?=[\\A-Za-z({])", "3")),
}
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+|\d+)(?![\w.])")


@dataclass(frozen=True)
class LineMutant:
    """A printed line with one thing changed; noticed: whether it no longer is what was decided."""

    claim: str
    kind: str
    printed: str
    noticed: bool


@dataclass(frozen=True)
class NumberMutant:
    """A number of study.toml changed; read: whether a claim or its goal is another; noticed: by its certificates."""

    paper: str
    line: int
    before: str
    after: str
    read: bool
    noticed: bool


def changed_lines(printed: str) -> Iterator[tuple[str, str]]:
    """(kind, line) for every place of a line at which one thing can be changed."""
    for kind, patterns in CHANGES.items():
        for pattern, replacement in patterns:
            for place in re.finditer(pattern, printed):
                changed = printed[:place.start()] + place.expand(replacement) + printed[place.end():]
                if changed != printed:
                    yield kind, changed


def line_mutants(folder: Path, count: int, seed: int) -> list[LineMutant]:
    """So many mutants of the lines of a paper that a machine reads, drawn from all of them."""
    file, found = ProofFile(folder), []
    with file.at_home():
        claims = [claim for paper in papers_in(file) for claim in paper.claims if claim.build is not None]
        drawn = [(claim, kind, line) for claim in claims for kind, line in dict.fromkeys(changed_lines(claim.printed))]
        random.Random(seed).shuffle(drawn)
        goals = {claim.id: _parsed_goal(claim) for claim in {claim.id: claim for claim, _, _ in drawn}.values()}
        for claim, kind, line in drawn:
            goal = goals[claim.id]
            if goal is not None and len(found) < count:
                found.append(LineMutant(claim.id, kind, line, not match(line, claim.notation, goal).parsed))
    return found


def _parsed_goal(claim: Claim) -> Goal | None:
    assert claim.build is not None
    goal = built(claim, claim.build)
    return goal if match_claim(claim, goal).parsed else None


def number_mutants(folder: Path, count: int, seed: int) -> list[NumberMutant]:
    """So many mutants of the numbers that a paper's study.toml states, outside of texts and comments."""
    text = (folder / STUDY).read_text(encoding="utf-8")
    places = [place for place in NUMBER.finditer(text)
              if "=" in (head := text[text.rfind("\n", 0, place.start()) + 1:place.start()])
              and head.count('"') % 2 == 0 and "#" not in head]
    drawn = random.Random(seed).sample(places, min(count, len(places)))
    with tempfile.TemporaryDirectory() as room:  # a copy too, which must be whole without its surroundings
        before = _fingerprints(Path(shutil.copytree(folder, Path(room) / folder.name)))
    return [_changed_number(folder, text, place, before) for place in sorted(drawn, key=lambda p: p.start())]


def _changed_number(folder: Path, text: str, place: re.Match[str], before: dict[str, str | None]) -> NumberMutant:
    number = place.group()
    after = f"{float(number) * 1.25 + 0.125:.6g}" if "." in number else str(int(number) + 1)
    with tempfile.TemporaryDirectory() as room:
        copy = Path(room) / folder.name
        shutil.copytree(folder, copy)
        (copy / STUDY).write_text(text[:place.start()] + after + text[place.end():], encoding="utf-8")
        line = text.count("\n", 0, place.start()) + 1
        try:
            read = _fingerprints(copy) != before
            noticed = read and bool(check_claims(copy / CERTIFICATES, copy)[0])
        except Exception:  # the paper itself refuses the number
            return NumberMutant(folder.name, line, number, after, True, True)
    return NumberMutant(folder.name, line, number, after, read, noticed)


def _fingerprints(folder: Path) -> dict[str, str | None]:
    """By claim what says whether it is the same claim with the same goal."""
    file = ProofFile(folder)
    with file.at_home():
        return {claim.id: fingerprint(claim) for paper in papers_in(file) for claim in paper.claims if claim.build}


def main() -> int:
    """Print shares and what was not noticed; 1 when a number that a claim reads can be changed unnoticed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("papers", nargs="*", type=Path, help="folders of papers; default: all in proofs")
    parser.add_argument("--lines", type=int, default=2000, help="mutants of lines, of each paper")
    parser.add_argument("--numbers", type=int, default=8, help="mutants of numbers, of each paper")
    parser.add_argument("--seed", type=int, default=2021)
    parser.add_argument("--json", type=Path, help="also write all mutants here")
    asked = parser.parse_args()
    folders = asked.papers or sorted(folders_in(ROOT / "proofs"))
    lines = [mutant for folder in folders for mutant in line_mutants(folder, asked.lines, asked.seed)]
    kinds, noticed = Counter(m.kind for m in lines), Counter(m.kind for m in lines if m.noticed)
    for kind in (*kinds, "all"):
        of, seen = (kinds.total(), noticed.total()) if kind == "all" else (kinds[kind], noticed[kind])
        print(f"{kind:10} {of:6} mutants of lines, noticed {seen:6}: {100 * seen / max(of, 1):.1f} %")
    for mutant in lines:
        if not mutant.noticed:
            print(f"  not noticed: {mutant.claim}, {mutant.kind}: {mutant.printed[:200]}")
    numbers = [mutant for folder in folders if (folder / STUDY).exists()
               for mutant in number_mutants(folder, asked.numbers, asked.seed)]
    read = [mutant for mutant in numbers if mutant.read]
    wrong = [mutant for mutant in read if not mutant.noticed]
    print(f"{len(numbers)} mutants of numbers, read by a claim: {len(read)}, "
          f"of these noticed: {len(read) - len(wrong)}")
    for one in wrong:
        print(f"  not noticed: {one.paper}/{STUDY}, line {one.line}: {one.before} -> {one.after}")
    if asked.json:
        asked.json.write_text(json.dumps({"version": 1, "lines": [asdict(m) for m in lines],
                                          "numbers": [asdict(m) for m in numbers]}, indent=1) + "\n", encoding="utf-8")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
