"""Sentences elsewhere by which a display may mean something else than it says: conventions, corrections, new values."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from itertools import pairwise

from workbench.paper.source.conventions import (
    CALLS,
    DENOTES,
    DROPS,
    TAKES_BACK,
    a_part,
    any_number,
    means_otherwise,
    moves_otherwise,
    no_number,
    no_rate,
    shows_rate,
    turns,
)
from workbench.paper.source.given import RATE, Gift, letter_of
from workbench.paper.source.passages import Sentence, Word
from workbench.paper.source.reading import GIVING, Reading
from workbench.proof.latex.sides import letters_of_text


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


# Nouns that stand for one another: by each of them a text may speak of what it gave under another.
_ALIKE = (
    _words("function functions functional functionals candidate candidates energy energies storage"),
    _words("law laws controller controllers input inputs command feedback actuator"),
    _words("surface surfaces manifold manifolds"), _words("observer observers estimator estimators"),
    _words("filter filters"), _words("transformation transformations coordinates"),
)


def nouns_of_displays(sentences: Sequence[Sentence], readings: Sequence[Reading],
                      gives: Mapping[int, Collection[str]]) -> list[tuple[int, frozenset[str], frozenset[str]]]:
    """The sentences that give letters in displays, with the nouns by which a text may speak of those, and these."""
    found = []
    for at, (sentence, reading) in enumerate(zip(sentences, readings, strict=True)):
        letters = frozenset(letter for number, form in reading.shown.items() if form in GIVING
                            for letter in gives[number] if not letter.startswith(RATE))
        words = {word.text for word in sentence.words if word.kind == "word"}
        nouns = frozenset().union(*(alike for alike in _ALIKE if alike & words))
        if letters and nouns:
            found.append((at, nouns, letters))
    return found


def said_elsewhere(sentences: Sequence[Sentence], readings: Sequence[Reading], gifts: Sequence[Gift], at: int,
                   letters: Collection[str], printed: str, called: Mapping[str, Collection[str]],
                   nouns: Sequence[tuple[int, frozenset[str], frozenset[str]]]) -> Iterator[int]:
    """The sentences by which a display in another may mean something else.

    letters: of the display and of what they are made of; printed: it and their values; called: what the rows that the
    text calls by a label or number give; nouns: those by which it speaks of letters, as `nouns_of_displays` finds them.
    """
    rates = shows_rate(printed)
    taken = {letter_of(gift.letter)
             for gift in gifts} & {*letters}
    used = {gift.letter for gift in gifts if not gift.letter.startswith(RATE)} & {*letters} or (
        rates and any(gift.letter.startswith(RATE) for gift in gifts))
    moved = min((gift.at for gift in gifts if gift.letter.startswith(RATE) and gift.form != "inline"
                 and gift.letter.removeprefix(RATE)[:-1] in letters), default=at) if rates else at
    since = min((moved, *(gift.at for gift in gifts if gift.letter in taken and not gift.letter.startswith(RATE))))
    for place, (sentence, said) in enumerate(zip(sentences, readings, strict=True)):
        texts = [word.text for word in sentence.words if word.kind == "word"]
        if means_otherwise(texts, printed) or (moved < place < at and not said.shown and moves_otherwise(texts)):
            yield place
        if said.beyond and used and since < place < at:
            yield place  # it may tell that something else acts than was given
        if not said.unknown:
            continue
        formulas = [word.text for word in sentence.words if word.kind == "math"]
        if since < place < at and sentence.place.headings[:1] == sentences[at].place.headings[:1] and not any(
                word.kind in ("math", "reference", "display", "cite") for word in sentence.words):
            yield place  # what it tells of the world, as `the pivot is now shaken`, may change what was given
            continue
        spoken = {letter for word in sentence.words if word.kind == "reference"
                  for name in word.text.split(",") for letter in called.get(name.strip().strip("()"), ())}
        named = {letter for given, words, ones in nouns if given < place < at and words & {*texts} for letter in ones}
        back = (spoken | said.letters) if TAKES_BACK & {*texts} else set()
        turned = taken if turns(texts) and not said.letters and any(
            gift.at < place < at for gift in gifts if gift.letter in taken) else set()
        if (no_number(texts, formulas) and said.letters & {*letters}) or (named | back | turned) & taken:
            yield place


def any_numbers(words: Sequence[Word]) -> Iterator[str]:
    """The letters that a sentence says to be any numbers, as `for every real $k$`."""
    for place, word in enumerate(words):
        first = place
        while first and (words[first - 1].kind in ("math", "mark") or words[first - 1].text == "and"):
            first -= 1
        before = [one.text for one in words[max(first - 3, 0):first]]
        if word.kind == "math" and (any_number(before) or (r"\mathbb" in word.text and any_number([*before, "real"]))):
            yield from letters_of_text(word.text.partition(r"\in")[0])


def denoted_in_part(words: Sequence[Word]) -> Iterator[str]:
    """The letters of which a sentence says that they denote a part, as `$V$ denotes the second term`, or something
    else, as `we write $k$ for $-c$`."""
    formulas = [word.text for word in words if word.kind == "math"]
    if len(formulas) > 1 and CALLS & {word.text for word in words}:
        yield from (letter for one in formulas if letters_of_text(one) == {one} for letter in (one,))
    for word, behind in pairwise(words):
        texts = [one.text for one in words]
        if word.kind == "math" and behind.text in DENOTES and (a_part(texts) or no_rate(word.text, texts)):
            yield from letters_of_text(word.text)


def drops(sentence: Sentence, labels: Collection[str], number: str) -> bool:
    """Whether a sentence that is not understood may take back the assumption of some labels and a number."""
    named = any(name.strip() in labels for word in sentence.words if word.kind == "reference"
                for name in word.text.split(",")) or any(
        one.text.startswith("assumption") and two.text == number for one, two in pairwise(sentence.words))
    return named and bool(DROPS & {word.text for word in sentence.words})
