"""What a text calls its letters: a letter with two names may be two quantities, and one by itself may have a sign."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from workbench.paper.source import vocabulary
from workbench.paper.source.calling import BE, ENDS
from workbench.paper.source.narrowing import words_of
from workbench.paper.source.passages import Word
from workbench.paper.source.things import FUNCTIONS, HEADS
from workbench.proof.latex.sides import letters_of_text

_ARTICLES = words_of("the a an its our some for now again")
# By these a letter is described, and not named.
_MANNERS = words_of("""
    positive nonnegative negative real constant bounded known unknown smooth continuous differentiable definite
    semidefinite radially unbounded zero stable small large decreasing increasing nonincreasing invariant available
    scalar finite proper quadratic convex good chosen defined given designed selected used introduced taken proved shown
    positive-definite measured true
""")
# Of what is so called any sign may be meant.
_SIGNLESS = words_of("""
    function functional candidate
    state states input inputs output outputs error errors error-signal signal signals disturbance disturbances variable
    variables parameter parameters real reals number numbers scalar scalars gain gains constant constants reference
    references position positions velocity velocities angle angles force forces torque torques current currents voltage
    voltages control controller command law surface coordinate coordinates perturbation uncertainty noise acceleration
    derivative rate estimate estimates coefficient coefficients quantity quantities system systems plant
    vector thrust slip point deviation
""")
# A letter that is described by one of these has another value than the quantity by itself.
_OTHER_VALUES = words_of("""
    estimate estimates estimated estimation average averaged mean part component components half desired filtered
    virtual previous delayed sampled saturated nominal ideal commanded measured measurement approximate
    approximation prediction predicted initial final maximal minimal maximum minimum peak limit steady-state leader
    follower neighbour neighbor percentage percent share fraction increment difference noisy
    lagged old new
""")
# What is so called stands for a quantity wherever it is printed.
_STAND_INS = words_of(
    "estimate estimates estimated average averaged mean delayed sampled filtered prediction lagged noisy")
_NOUNS = vocabulary.GIVEN | HEADS


def named(words: Sequence[Word]) -> Iterator[tuple[str, str]]:
    """The letters to which a sentence gives a name, and the last word of that."""
    for place, word in enumerate(words):
        before = words[place - 1].text if place else ""
        if word.kind == "math" and before in _NOUNS:
            yield from ((letter, before) for letter in _letters(word.text))
        if word.kind == "math" and before in BE:  # the coefficient of friction is $a$
            start = next((at for at in range(place - 1, 0, -1) if words[at - 1].kind != "word"), 0)
            yield from ((letter, one.text) for letter in _letters(word.text) for one in words[start:place]
                        if one.text in _NOUNS)
    yield from ((letter, phrase[-1]) for letter, phrase in described(words) if phrase[-1] not in _MANNERS)


def described(words: Sequence[Word]) -> Iterator[tuple[str, list[str]]]:
    """The letters of which a sentence says what they are, with the words for that, as `$u$ is the traction force`."""
    for place, word in enumerate(words):
        end = place
        while word.kind == "math" and end + 1 < len(words) and (
                words[end + 1].kind in ("mark", "math") or words[end + 1].text == "and"):
            end += 1
        if word.kind == "math" and end + 1 < len(words) and words[end + 1].text in BE:
            phrase = _phrase(words, end + 2)
            yield from ((letter, phrase) for letter in _letters(word.text) if phrase)


def of_another_value(words: Sequence[Word], known: Collection[str]) -> tuple[str, ...]:
    """The words by which one of some letters, or any letter at all, is described as another value than the quantity by
    itself; none where none is."""
    return tuple(dict.fromkeys(text for letter, phrase in described(words) for text in phrase
                               if text in (_OTHER_VALUES if letter in known else _STAND_INS)))


def two_names(heads: Collection[str]) -> bool:
    """Whether a letter with such names is called a function and something else."""
    return bool({*heads} & FUNCTIONS) and bool({*heads} - FUNCTIONS)


def signed_by_nature(head: str) -> bool:
    """Whether what is so called may have a sign that no one says, as a mass or a level."""
    return head not in _SIGNLESS


def _letters(formula: str) -> Iterator[str]:
    """The letters that a formula only names."""
    for one in formula.partition(r"\in")[0].split(","):
        if letters_of_text(one) == {one.strip()}:
            yield one.strip()


def _phrase(words: Sequence[Word], start: int) -> list[str]:
    found: list[str] = []
    for word in words[start:]:
        if word.kind != "word" or word.text in ENDS - _ARTICLES - _MANNERS:
            break
        if word.text not in _ARTICLES:
            found.append(word.text)
    return found
