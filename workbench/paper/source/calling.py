"""What a sentence calls a letter, and whether that is what it was when it got its value or rate."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from workbench.paper.source import moving, things, understood, vocabulary
from workbench.paper.source.given import RATE, Gift
from workbench.paper.source.narrowing import words_of
from workbench.paper.source.passages import Sentence, Word

BE = {"is", "are", "be", "being", "denotes", "denote", "denoting", "represents", "represent", "stands", "means",
       "designates", "was", "becomes"}
# Nouns that stand before a letter without saying what it is.
_LETTERS = {"letter", "letters", "symbol", "function", "variable", "quantity", "signal", "scalar"}
# What the value of a letter may be called otherwise, by what it was called first.
_ALIKE = (
    (things.LAWS, things.LAWS | things.OF_LAWS), (things.FUNCTIONS, things.FUNCTIONS | things.OF_FUNCTIONS),
    (things.ERRORS, things.ERRORS | things.OF_ERRORS | moving.QUANTITIES | things.SIGNALS),
)
# What a letter that moves may be called.
_MOVING = moving.QUANTITIES | moving.OF_QUANTITIES | things.ERRORS | things.OF_ERRORS | moving.BESIDE | things.SIGNALS


# Where a name that stands before a letter begins.
ENDS = vocabulary.DETERMINERS | vocabulary.GERUNDS | vocabulary.DEFINE | vocabulary.DEFINING | BE | words_of("""
    of in for with by to as at from into under along via upon on over within through and or that which where if since
    because when let we all any every have has obtain get gives yields use uses choose then hence thus both
""")


def recalled(sentences: Sequence[Sentence], gifts: Sequence[Gift], at: int) -> set[str]:
    """The letters that a sentence calls something else, behind the display that gives them a value or rate; at: the
    sentence up to which, and in whose section, that counts."""
    found: set[str] = set()
    shown = {gift.letter: gift for gift in reversed(gifts) if gift.form != "inline"}
    first = {gift.at: {word.text for word in sentences[gift.at].words if word.kind == "word"}
             for gift in shown.values()}
    for place, other in enumerate(sentences):
        if place > at and other.place.headings[:1] != sentences[at].place.headings[:1]:
            continue
        for name, gift in shown.items():
            moves = name.startswith(RATE)
            letter = name.removeprefix(RATE)[:-1] if moves else name
            if (gift.at < place or (gift.at == place and not moves)) and letter not in found and called_otherwise(
                    other.words, letter, first[gift.at], moves):
                found.add(letter)
    return found


def called_otherwise(words: Sequence[Word], letter: str, first: Collection[str], moves: bool) -> bool:
    """Whether a sentence calls a letter something else than it was.

    first: the words of the sentence that gave its value; moves: whether it gave a rate instead.
    """
    alike = frozenset(_MOVING) if moves else frozenset().union(
        *(kinds for heads, kinds in _ALIKE if heads & {*first})) or things.HEADS | things.OF_THEM
    return any(_otherwise(phrase, alike) for place, word in enumerate(words)
               if word.kind == "math" and word.text == letter for phrase in _phrases(words, place))


def _phrases(words: Sequence[Word], place: int) -> Iterator[list[str]]:
    """What a letter is called before it, as `the estimate $x$`, and behind it, as `$x$ is the output`."""
    start = place
    while start and words[start - 1].kind == "word" and words[start - 1].text not in ENDS:
        start -= 1
    if start < place and (start == 0 or words[start - 1].text in vocabulary.DETERMINERS or start == place - 1):
        yield [word.text for word in words[start:place]]
    behind = place + 1
    while behind < len(words) and words[behind].text in ("then", "now", "also", "again"):
        behind += 1
    if behind < len(words) and words[behind].text in BE:
        end = behind + 1
        while end < len(words) and words[end].kind == "word" and words[end].text not in ("and", "where", "while"):
            end += 1
        yield [word.text for word in words[behind + 1:end]]


def _otherwise(phrase: Sequence[str], alike: Collection[str]) -> bool:
    """Whether a phrase calls something by a word that is not understood, or by a thing that is not alike."""
    if {*phrase} <= _LETTERS | vocabulary.DETERMINERS:
        return False
    own = phrase[:next((at for at, text in enumerate(phrase) if text in ("of", "for")), len(phrase))]
    return bool(understood.not_understood(phrase, True, False)) or bool({"estimate", "estimates"} & {*phrase}) or bool(
        {*own} & things.HEADS - {*alike})
