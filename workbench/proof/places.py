"""How a reader calls a line of a paper: Theorem 2, equation (44)."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from workbench.proof.wording import listed

_WORDS = {"theorem": "Theorem", "lemma": "Lemma", "remark": "Remark", "table": "Table", "figure": "Figure",
          "proposition": "Proposition", "contribution": "Contribution", "section": "Section", "A": "Assumption",
          "assumption": "Assumption", "corollary": "Corollary", "property": "Property", "algorithm": "Algorithm"}
# Places that a paper has without a number.
_UNNUMBERED = {"intro": "Introduction", "text": "The text", "figures": "The figures", "tables": "The tables"} | {
    word.lower(): word for word in ("Abstract", "Objective", "Conclusion", "Example", "Notation", *_WORDS.values())}
STATEMENT = "Statement"  # of a line that has no number in its paper
_TOLD = f"The {STATEMENT.lower()} "
_PLACED = re.compile(rf"(?:{'|'.join(_WORDS.values())}) \d+[^:]*: |The (?:display|text) (?:before|after) \(\d+\): ")
_BESIDE = re.compile(r"The (?:display|text) (?:before|after) \(\d+\)(?=: )")  # what the paper does not number
_KIND = re.compile(r"The \w+|\w+")  # what numbers stand behind
_NAMED = re.compile(r"([A-Za-z]+?)(\d+)((?:\.\w+)*)")
_NUMBERED = re.compile(r"(\d+)((?:\.\w+)*)")
_SECTION = re.compile(r"section(\d+)(?![\w-])")
_NUMBER = re.compile(r"\(?(\d+(?:\.\d+)*)\b")
_TELLING = ("Section", "Abstract", "Introduction", "Conclusion")  # names of lines that say where they stand


def place_of(equation: str, title: str | None = None) -> str:
    """The name of a line by its claim's number: `44` is equation (44), `theorem2.speed` a part of Theorem 2.

    title: what the claim says. A part of a line is told by it, `Theorem 2 “The speed tracks too”`, and so is a line
    that has no number in the paper; one that begins with `The display before (42): ` or `The text after (42): ` says
    where a line stands that has none. Without it a part has its short name in brackets, `Theorem 2 [speed]`; with an
    empty one the part is left out, for a place beside which the title stands.
    """
    if title and (beside := _BESIDE.match(title)):
        return beside[0] + (_quoted(title) if "." in equation else "")
    found = _NUMBERED.fullmatch(equation)
    if found:
        return _with_part(f"Equation ({found[1]})", found[2], title)
    found = _NAMED.fullmatch(equation)
    if found and found[1] in _WORDS:
        return _with_part(f"{_WORDS[found[1]]} {found[2]}", found[3], title)
    stem, dot, rest = equation.partition(".")
    if re.fullmatch(r"[IVX]+", stem):
        return _with_part(f"Section {stem}", dot + rest, title)
    if title is not None and stem not in _UNNUMBERED:
        return f"{_TOLD.strip()}{_quoted(title)}" if title else STATEMENT
    return _with_part(_UNNUMBERED.get(stem, stem[:1].upper() + stem[1:]), dot + rest, title)


def whole_of(equation: str, title: str) -> str:
    """The name of the line that a claim is about or a part of, beside which its title stands."""
    beside = _BESIDE.match(title)
    return beside[0] if beside else place_of(equation, "")


def _with_part(place: str, suffix: str, title: str | None) -> str:
    """A place and what tells its parts apart, in brackets or told by the title; numbers of parts as they are. A title
    that begins with the place goes on from it: Theorem 1 “where b > 0”."""
    numbers, rest = re.fullmatch(r"((?:\.\d+(?!\w))*)(.*)", suffix).groups()  # type: ignore[union-attr]
    place += numbers
    if not rest:
        return place
    return place + (f" [{rest[1:]}]" if title is None else _quoted(title, place.removeprefix("Equation ")))


def _quoted(title: str, place: str = "") -> str:
    return f" “{subject_of(title).removeprefix(f'{place} ')}”" if title else ""


def subject_of(title: str) -> str:
    """The title of a line without the name of its place: `Theorem 1, part 2: z converges` is `z converges`."""
    return _PLACED.sub("", title)


def places_of(equations: Sequence[str], titles: Mapping[str, str] | None = None) -> list[str]:
    """The names of several lines, those of one kind together: `Theorems 2, 3 and 4`, `equations (41) and (44)`.

    titles: what the lines say, by equation. A part whose whole line is not among them is told by its title, `equations
    (41) “The rates” and (44)`, as another part of it may hold; without titles parts are left out.
    """
    groups: dict[str, list[str]] = {}
    named = titles or {}
    for equation in equations:
        place, whole = place_of(equation, named.get(equation)), place_of(equation, "")
        in_whole = any(other != equation and place_of(other, named.get(other)) == whole for other in equations)
        beside = _BESIDE.match(named.get(equation, ""))
        if titles is None or (in_whole and not beside):
            place = whole
        kind = place if beside else f"{(_KIND.match(place) or [place])[0]} "
        number = place.removeprefix(kind.rstrip()).lstrip()
        if number not in groups.setdefault(kind, []):
            groups[kind].append(number)
    found = []
    for kind, members in groups.items():
        numbers = _in_order(members)
        # Several parts of the one introduction or of the figures are no more than that.
        is_many = len(numbers) > 1 and (kind == _TOLD or not numbers[0].startswith("“"))
        plural = kind.strip() + ("s" if is_many else "")
        if kind.startswith(("Equation ", "The ")):
            plural = plural[0].lower() + plural[1:]
        found.append(f"{plural} {listed(numbers)}".strip())
    return found


def _in_order(numbers: list[str]) -> list[str]:
    """Numbered lines of one kind by their numbers, Theorems 1.1, 1.2 and 1.3; others as they come."""
    found = [_NUMBER.match(number) for number in numbers]
    keys = [[int(part) for part in one[1].split(".")] for one in found if one]
    if len(keys) < len(numbers):
        return numbers
    return [number for _, number in sorted(zip(keys, numbers, strict=True), key=lambda pair: pair[0])]


def named_section(equation: str) -> str:
    """The number of the section that a claim's own name says, `5` of `section5.converge`; empty where it says none."""
    found = _SECTION.match(equation)
    return found[1] if found else ""


def section_of_place(equation: str, section: str) -> str:
    """`section 5.2`, where a line stands; empty where that is not known, or where its own name says it: Section VIII,
    Conclusion."""
    return f"section {section}" if section and not place_of(equation, "").startswith(_TELLING) else ""
