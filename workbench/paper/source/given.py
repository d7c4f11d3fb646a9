"""What the sentences of a source give letters: values and rates, in displays and within the text, understood or not."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

from workbench.paper.source.letters import kinds_in, values_and_rates
from workbench.paper.source.passages import Word
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.sides import letters_of_text, valued_in
from workbench.proof.latex.tree import Line


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


RATE = r"\dot{"  # what the rate of a letter is called
# Behind these a letter is given a number, and not compared with one.
_GIVING = _words("let set put take choose becomes become define redefine setting letting taking putting choosing")
# What a rate is called that is given within the text.
_MOVING = _words("system systems plant plants model models dynamics subsystem subsystems consider motion")
_REACH = 4  # words before a formula that say what it is
_CLOSED = {"closed", "closed-loop"}  # such a rate follows from others


@dataclass(frozen=True)
class Gift:
    """What a sentence gives a letter, or its rate; form: as `Reading.shown` says of its display, or `inline`."""

    at: int
    letter: str
    value: str
    form: str


def rate_of(letter: str) -> str:
    """What the rate of a letter is called."""
    return f"{RATE}{letter}}}"


def letter_of(name: str) -> str:
    """A letter, of itself or of what its rate is called."""
    return name.removeprefix(RATE).removesuffix("}") if name.startswith(RATE) else name


def given_within(words: Sequence[Word]) -> Iterator[tuple[str, str]]:
    """The letters that formulas within a sentence give a value, and the rates, whatever its words say."""
    for place, word in enumerate(words):
        if word.kind == "math":
            before = [one.text for one in words[max(place - _REACH, 0):place]]
            for letter, value in _given_by(word.text):
                rate = letter.startswith(RATE)
                if ({*before} & _MOVING and not {*before} & _CLOSED) if rate else (
                        {*before} & _GIVING or letters_of_text(value)):
                    yield letter, value


def given_twice(gifts: Iterable[Gift]) -> set[str]:
    """The letters that get two different values, or two rates; a rate that a display gives anew may be claimed."""
    values: dict[str, str] = {}
    moved: list[Gift] = []
    twice: set[str] = set()
    for gift in gifts:
        if not gift.letter.startswith(RATE):
            if not same(values.setdefault(gift.letter, gift.value), gift.value):
                twice.add(gift.letter)
            continue
        claimed = gift.form not in ("defined", "inline")
        if any(one.letter == gift.letter and not same(one.value, gift.value) and (
                not claimed or one.at == gift.at or one.form == "inline") for one in moved):
            twice.add(gift.letter.removeprefix(RATE)[:-1])
        moved.append(gift)
    return twice


@lru_cache(maxsize=4096)
def _given_by(formula: str) -> tuple[tuple[str, str], ...]:
    values, rates = values_and_rates(formula)
    found = [*values.items(), *((rate_of(letter), rate) for letter, rate in rates.items())]
    if not found and not [*kinds_in(formula)]:
        right = formula.partition("=")[2].strip()  # `V(x) = x^2`, and `W = U + x^2 = 2 x^2`
        found = [(letter, right) for letter in valued_in(formula.partition(",")[0]) if right]
    return tuple(found)


@lru_cache(maxsize=4096)
def _tree(value: str) -> Line | str:
    try:
        return read_line(value)
    except LatexError:
        return "".join(value.split())


def same(one: str, other: str) -> bool:
    r"""Whether two values are typed alike, but for layout, as `\tfrac12` and `\frac{1}{2}`."""
    return _tree(one) == _tree(other)
