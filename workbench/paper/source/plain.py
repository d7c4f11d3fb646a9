"""Sentences of plain words without a displayed formula: whether they may give something a value all the same."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from workbench.paper.source import conventions, forms, narrowing, vocabulary
from workbench.paper.source.passages import Word
from workbench.proof.latex.sides import letters_of_text

# A word that denies or changes nothing, as far as its form shows; words for what is no number are not fit either.
_FIT = re.compile(r"(?!non|un|in|im|ir|dis|mis|anti|de|re|pseudo|semi|quasi|half)[a-z]{3,}(?<!less)(?<!ed)(?<!ing)")
_UNFIT = conventions.NO_NUMBER | conventions.TAKES_BACK | narrowing.words_of("""
    arbitrary negative opposite inverse complement reverse former later previous past future never not only some any
    few no nor but yet except save sometimes often maybe perhaps set interval function operator component components
    entry case if when while where which that who whose
""")
# What is called so is of another kind than before, where its formula does not say of which.
_NUMBERS = narrowing.words_of("""
    real reals number numbers scalar scalars constant constants gain gains parameter parameters coefficient coefficients
    integer integers
""")
# Of what is described so not every value is meant.
_CHOSEN = narrowing.words_of("""
    suitable appropriate adequate proper stabilizing stabilising optimal ideal critical solution solutions maximum
    minimum maximal minimal bound bounds limit limits least greatest largest smallest margin root roots eigenvalue
    supremum infimum sufficient sufficiently enough integer integers natural
""")
_COUNTS = narrowing.words_of("zero one two three four five six ten hundred unity integer integers natural")
_ENDS = narrowing.words_of("and where with which while that for in")
_BE = ("is", "are", "denotes", "denote", "represents", "represent", "stands", "being")
_BETWEEN = re.compile(r"[\s=<>,;()\[\]|+]+|\\[a-z]*(?:le|ge|in|to|ne|frac|cdot)[a-z]*(?![A-Za-z])")


def letters_within(formula: str) -> Collection[str]:
    """The letters of a formula; those that its text seems to have where it cannot be read."""
    found = letters_of_text(formula) if formula else set()
    if found or not formula:
        return found
    pieces = {letter for piece in _BETWEEN.split(formula) for letter in letters_of_text(piece)}
    return pieces or set(re.findall(r"\\?[A-Za-z]+", formula))


def neutral(classes: Sequence[str]) -> bool:
    """Whether a sentence without displays is made of words alone that take nothing back."""
    plain = (forms.LETTERS, forms.REAL, forms.VALUE, forms.TIME, forms.REFERENCE, ",", ":", ";")
    return all(one in forms.NEUTRAL or one in plain for one in classes) and classes[-1] != ":"


def exchanges(words: Sequence[Word], classes: Sequence[str]) -> bool:
    """Whether a sentence has a letter by itself and within an expression: it may use one for the other."""
    alone, within = ({letter for word, one in zip(words, classes, strict=True) if one == kind
                      for letter in letters_within(word.text)} for kind in (forms.LETTERS, forms.VALUE))
    return bool(alone & within)


def described(words: Sequence[Word], classes: Sequence[str]) -> tuple[tuple[str, ...], frozenset[int]]:
    """The classes with unknown words that only say what a letter stands for taken for nouns, as in `$u$ is the traction
    force`, and their places: of such a description nothing else is taken than its formula."""
    found, places = list(classes), set()
    phrase = forms.NOUNS | forms.MODIFIERS | vocabulary.DETERMINERS | {"of", "with"}
    for place, (word, one) in enumerate(zip(words, classes, strict=True)):
        if word.kind != "word" or one in forms.KNOWN | forms.NEUTRAL | _UNFIT or not _FIT.fullmatch(one):
            continue
        start = place
        while start and (found[start - 1] in phrase):
            start -= 1
        be = start - 1 - (found[start - 1:start] == ["for"])
        if start < place and be > 0 and found[be] in _BE and found[be - 1] in (
                forms.LETTERS, forms.REAL, forms.SIGN) and not (
                    found[be - 1] == forms.LETTERS and _NUMBERS & {*_phrase(found, start, phrase)}):
            found[place] = "quantity"
            places.add(place)
    return tuple(found), frozenset(places)


def chosen(words: Sequence[Word], classes: Sequence[str], told: frozenset[int]) -> frozenset[str]:
    """The letters that a sentence describes as numbers of some values alone, as `a sufficiently large constant`, `a
    gain to be designed` or `the bound of $d$`; told: the places of its words that are not understood."""
    found: set[str] = set()
    for place, word in enumerate(words):
        behind = _run(classes, place + 2) if word.kind == "math" and classes[place + 1:place + 2] and (
            classes[place + 1] in ("be", *_BE)) else range(0)
        start = place
        while start and words[start - 1].kind == "word" and classes[start - 1] not in _ENDS:
            start -= 1
        near = {*classes[behind.start:behind.stop]}
        if word.kind == "math":
            near |= {*classes[start:place]} - {"ideal"}  # whose matching conditions are stated
        unclear = bool(_NUMBERS & {*classes[behind.start:behind.stop]}) and not told.isdisjoint(behind)
        later = any([*classes[at:at + 2]] in (["to", "be"], ["number", "of"]) for at in behind)
        counted = _COUNTS & {*classes[behind.start:behind.stop]}
        if near & _CHOSEN or unclear or later or counted:
            found |= {*letters_within(word.text)}
    return frozenset(found)


def numbered(words: Sequence[Word], texts: Sequence[str]) -> bool:
    """Whether a sentence of plain words says a number, or what kind of number something is."""
    return bool(_COUNTS & {*texts}) or any(
        word.kind == "math" and re.search(r"\d", word.text) and not letters_within(word.text) for word in words)


def _run(classes: Sequence[str], start: int) -> range:
    """The places of the words from one on up to the end of what may describe a letter."""
    end = start
    while end < len(classes) and classes[end].isalpha() and classes[end] not in _ENDS:
        end += 1
    return range(start, end)


def _phrase(classes: Sequence[str], start: int, phrase: Collection[str]) -> list[str]:
    """The words from a place on that may be one description; unknown ones go on."""
    end = start
    while end < len(classes) and (classes[end] in phrase or _FIT.fullmatch(classes[end])):
        end += 1
    return [*classes[start:end]]


def revalued(words: Sequence[Word], classes: Sequence[str], texts: Sequence[str],
              given: Collection[str]) -> tuple[str, ...]:
    """The expressions by which a sentence of plain words may give something another value; none where it does not."""
    values = tuple(word.text for word, one in zip(words, classes, strict=True) if one == forms.VALUE)
    alone = [letter for word, one in zip(words, classes, strict=True) if one == forms.LETTERS
             for letter in letters_within(word.text)]
    if values and narrowing.revalues(texts, bool({*alone} & {*given}) or (bool(alone) and narrowing.names(texts))):
        return values
    return tuple(alone) if narrowing.calls_alike(texts) or conventions.any_number(texts) or (
        len({*alone}) > 1 and narrowing.exchanges_letters(texts)) else ()
