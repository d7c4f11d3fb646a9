"""Phrases of words that are all understood, and by which a formula is nonetheless said of a part of the values alone.

`On the sliding surface, y = x` gives y no value elsewhere, `the mean input is u = ...` none at an instant.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from workbench.paper.source import vocabulary, words


def words_of(text: str) -> frozenset[str]:
    """The words of a list."""
    return frozenset(text.split())


_WHERE = words_of("on in at for during before after over within between through throughout along near into")
# What a motion passes through, or keeps for a while.
_PLACES = words_of("""
    surface surfaces manifold manifolds mode modes trajectory trajectories curve path start beginning end middle period
    equilibrium speed speeds velocity temperature pressure load level voltage current boundary slope phase
""")
# What is averaged, sampled or extreme has no value at an instant, and a part is not the whole.
_PARTIAL = words_of("""
    average averaged mean sampled maximum minimum maximal minimal half halves twice contribution contributions summand
    summands numerator denominator increment decrement fraction quotient remainder open-loop feedforward compare
    compares compared comparing
""")
# Of an expansion: what is of another order is left out.
_ORDERS = words_of("first second third leading lowest zeroth higher lower")
# The coefficient of W is not W.
_OF = words_of("coefficient coefficients factor factors weight weights growth ratio exponent power root sign size norm")
_CHOSEN = vocabulary.DEFINE | vocabulary.DEFINING | words_of("""
    chosen designed selected proposed defined introduced given constructed governed described modelled modeled called
    denoted obeys obey satisfies satisfy
""")
# By these a letter is said to vary, and what was given to be changed.
_CHANGES = words_of("""
    change changes changed changing vary varies drift drifts switch switched grow grows increase increases decrease
    decreases add adds added adding subtract subtracts subtracted scale scales scaled multiply multiplies multiplied
    replace replaces replaced rotate rotates rotated normalize normalized
""")
# What is done once in such a while is not done all the time.
_PERIODS = words_of("second seconds minute hour day step sample sampling period instant cycle tick millisecond frame")
# Behind these a place is none of the motion's: `forces that act on the surface`, `based on the level`.
_ACTING = words_of("acting acts act based depends depending depend relies rely exerted mounted moves moving move")
_WITHIN = (vocabulary.MODIFIERS | vocabulary.ADJECTIVES | vocabulary.GIVEN | vocabulary.TEXT | vocabulary.NAMES
           | words.QUALITIES)
# Words of a sign or size, by which a sentence of which nothing is taken may restrict its letters.
SIGNED = words_of("positive nonnegative non-negative negative nonpositive non-positive definite semidefinite bounded")
# Words by which a sentence without letters may restrict all of them.
LIMITING = SIGNED - {"definite", "semidefinite", "bounded"} | words_of("""
    between within half halves limit limited limits limiting range interval quadrant set
""")
# Words of a sentence without letters, not understood, that may say of what values the paper speaks.
_RESTRICTING = LIMITING | words_of("""
    only never cannot not no zero below above orthant domain region exclude excluded excludes restrict restricted
    restricts confine confined attention assume assumed suppose always stays must exceed exceeds small large less
    greater least most saturated saturation constrained constraint constraints unit integer integers binary admissible
    if when unless whenever provided case cases one
""")
# What stands under these headings says nothing of what the values are.
_BACKGROUND = words_of("introduction conclusion conclusions acknowledgment acknowledgements abstract literature")
# Nouns of what a letter may stand for, which a text may give another value by words alone.
_NAMED = words_of("""
    function functions functional candidate energy storage law laws controller controllers input inputs error-signal
    observer filter surface manifold output estimate state states signal signals variable variables symbol symbols
    letter letters
""")
# By these one letter may be put for another.
_PUT = words_of("""
    computed calculated evaluated implemented realized realised approximated used uses using replaced substituted
    measured estimated taken known formed built
""")
# By words of both kinds a letter may stand for another.
_CALLS = (words_of("write writes denote denotes call called use keep put stands means"),
          words_of("both all same them again one two"))


def partial(texts: Sequence[str]) -> tuple[str, ...]:
    """The words by which a sentence's value is one of a part of the motion alone; none where it has none."""
    found = tuple(text for at, text in enumerate(texts)
                  if text in _PARTIAL or (text in _OF and texts[at + 1:at + 2] == ["of"]))
    return found or next((phrase for at in range(len(texts)) if (phrase := _placed(texts, at))), ())


def changing(texts: Sequence[str]) -> tuple[str, ...]:
    """The words by which a sentence without displays may change what was given before; none where it has none."""
    return tuple(text for text in texts if text in _CHANGES) or next(
        (pair for pair in pairwise(texts) if pair[0] in ("every", "each", "per") and pair[1] in _PERIODS), ())


def chooses(texts: Sequence[str]) -> bool:
    """Whether a sentence says that a value is given or chosen."""
    return bool(_CHOSEN & {*texts}) or texts[:1] == ["with"]


def begins_partial(texts: Sequence[str]) -> tuple[str, ...]:
    """The same, of a phrase with which the sentence begins."""
    return _placed(texts, 0) if texts else ()


def up_to(texts: Sequence[str]) -> tuple[str, ...]:
    """`up to a constant`, `to first order`: what is left out is not said; none where the sentence has no such words."""
    order = next(((one, two) for one, two in pairwise(texts) if one in _ORDERS and two.startswith("order")), ())
    return ("up", "to") if ("up", "to") in pairwise(texts) else order


def in_coordinates(texts: Sequence[str]) -> tuple[str, ...]:
    """`in the new coordinates`: letters and rates may be others there; none where it has no such words."""
    return tuple(text for text in texts if text.startswith("coordinate") or text.endswith("-coordinates"))


def revalues(texts: Sequence[str], given: bool) -> bool:
    """Whether a sentence with an expression may give something its value; given: whether it has a letter by itself to
    which the text gives a value elsewhere."""
    return given or bool(_NAMED & {*texts}) or any(
        one == "it" and two in ("is", "becomes", "equals", "reads", "now") for one, two in pairwise(texts))


def calls_alike(texts: Sequence[str]) -> bool:
    """Whether a sentence may call two things by one letter."""
    return all(words & {*texts} for words in _CALLS)


def names(texts: Sequence[str]) -> bool:
    """Whether a sentence with a letter and an expression may call the one by the other."""
    return bool(_CALLS[0] & {*texts})


def exchanges_letters(texts: Sequence[str]) -> bool:
    """Whether a sentence with two letters may put one for the other."""
    return bool(_PUT & {*texts})


def restricts(texts: Sequence[str], heading: Sequence[str]) -> bool:
    """Whether a sentence without letters, not understood, may say of what values the paper speaks."""
    return bool(_RESTRICTING & {*texts}) and not background(heading)


def background(heading: Sequence[str]) -> bool:
    """Whether what stands under a heading says nothing of what values are."""
    return bool(_BACKGROUND & {*heading})


def _placed(texts: Sequence[str], at: int) -> tuple[str, ...]:
    """The phrase at a word that names a place of the motion: its last word is one."""
    if texts[at] not in _WHERE or (at and texts[at - 1] in _ACTING):
        return ()
    end = at + 1 + (at + 1 < len(texts) and texts[at + 1] in vocabulary.DETERMINERS)
    while end < len(texts) and texts[end] in _WITHIN | _PLACES:
        end += 1
    return tuple(texts[at:end]) if texts[end - 1] in _PLACES else ()
