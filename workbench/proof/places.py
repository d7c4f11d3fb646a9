"""How a reader calls a line of a paper: Theorem 2, equation (44)."""

from __future__ import annotations

import re
from collections.abc import Sequence

from workbench.proof.wording import listed

_WORDS = {"theorem": "Theorem", "lemma": "Lemma", "remark": "Remark", "table": "Table", "figure": "Figure",
          "proposition": "Proposition", "contribution": "Contribution", "section": "Section", "A": "Assumption",
          "corollary": "Corollary", "property": "Property", "algorithm": "Algorithm"}
_TEXT = {"intro": "Introduction", "text": "Text"}
_PLACED = re.compile(rf"(?:{'|'.join(_WORDS.values())}) \d+[^:]*: ")
_NAMED = re.compile(r"([A-Za-z]+?)(\d+)((?:\.\w+)*)")
_NUMBERED = re.compile(r"(\d+)((?:\.\w+)*)")


def place_of(equation: str) -> str:
    """The name of a line by its claim's number: `44` is equation (44), `theorem2.speed` a part of Theorem 2."""
    found = _NUMBERED.fullmatch(equation)
    if found:
        return f"Equation ({found[1]})" + _part(found[2])
    found = _NAMED.fullmatch(equation)
    if found and found[1] in _WORDS:
        return f"{_WORDS[found[1]]} {found[2]}" + _part(found[3])
    stem, dot, rest = equation.partition(".")
    if re.fullmatch(r"[IVX]+", stem):
        return f"Section {stem}" + _part(dot + rest)
    if stem in _TEXT:
        return _TEXT[stem] + _part(dot + rest)
    return stem[:1].upper() + stem[1:] + _part(dot + rest)


def _part(suffix: str) -> str:
    """What tells parts of a line apart, in brackets; numbers of parts as they are."""
    numbers, rest = re.fullmatch(r"((?:\.\d+(?!\w))*)(.*)", suffix).groups()  # type: ignore[union-attr]
    return f"{numbers} [{rest[1:]}]" if rest else str(numbers)


def subject_of(title: str) -> str:
    """The title of a line without the name of its place: `Theorem 1, part 2: z converges` is `z converges`."""
    return _PLACED.sub("", title)


def places_of(equations: Sequence[str], parts: bool = False) -> list[str]:
    """The names of several lines, those of one kind together: `Theorems 2, 3 and 4`, `equations (41) and (44)`; with
    what tells their parts apart where it is asked for, `equations (41) [rate] and (44)`."""
    groups: dict[str, list[str]] = {}
    for equation in equations:
        place = place_of(equation)
        kind, _, number = (place if parts else place.partition(" [")[0]).partition(" ")
        if number not in groups.setdefault(kind, []):
            groups[kind].append(number)
    found = []
    for kind, numbers in groups.items():
        plural = kind if len(numbers) == 1 else {"Lemma": "Lemmas"}.get(kind, f"{kind}s")
        found.append(f"{plural.lower() if kind == 'Equation' else plural} {listed(numbers)}".strip())
    return found
