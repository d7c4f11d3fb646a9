"""Which words of a sentence with a displayed formula are understood, and where they may stand.

All that is taken from a paper, or claimed of it, is said in words of closed lists: of the things in `things`, of what
moves in `moving`, of mathematics, and of function words. Any other word, or a word before a thing that is none of its
kinds, is not understood.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise

from workbench.paper.source import moving, things, vocabulary, words


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_ORDINALS = _words("first second third fourth next last final")
# What may be numbered: no thing, since a second one of its kind may be another.
_COUNTED = vocabulary.DERIVED | vocabulary.TEXT | _words("stage row line bracket summand display displays")
_PREPOSITIONS = _words("of in for with by to as at from into under along via upon on over within through")
# What may stand directly before a thing, beside its own kinds.
_BEFORE = (vocabulary.DETERMINERS | (vocabulary.CONNECTIVES - _ORDINALS) | vocabulary.DEFINE | vocabulary.DEFINING
           | vocabulary.GERUNDS | _PREPOSITIONS | vocabulary.IS | vocabulary.GIVES | _words("""
    are be and that whose where which proposed following above given considered designed resulting called denote
    denotes use uses using setting have has get obtain us both this corresponding
""")) - {"each"}
# Function words, and those by which something is given or follows.
_GIVING = (vocabulary.DETERMINERS | (vocabulary.CONNECTIVES - _ORDINALS - {"again"}) | vocabulary.HAVE | vocabulary.HAS
           | vocabulary.SEEN | vocabulary.GIVES | vocabulary.IS | vocabulary.MADE | vocabulary.DEFINE
           | vocabulary.DEFINING | vocabulary.AIM | vocabulary.GERUNDS | vocabulary.ADVERBS | vocabulary.DERIVED
           | vocabulary.TEXT | vocabulary.NAMES | _PREPOSITIONS | _words("""
    we us let let's it that this these those its there here where which whose all both is are be been being has have
    and since because form take takes order view obeying satisfying see easy clear obvious good real nonnegative
    positive semidefinite definite stabilization setting sequel later purpose so will indeed throughout recall known
    use uses respectively moves move evolves according behaves basis based motivated denoting denotes denote denoted
    called say says following
""")) - _words("average mean maximum minimum value mode modes estimated updated reduced simplified implemented used "
               "posed their bounded dominated majorized upper-bounded lower-bounded second first choice approach "
               "method each")
# The same of what is claimed, of which nothing is taken.
_CLAIMING = (_GIVING | vocabulary.CLAIMING | vocabulary.HELD | _ORDINALS | words.VERBS | words.QUALITIES | words.MATTERS
             | _words("if when whenever provided while assume suppose such exists true valid satisfied until every "
                      "value not standing switching")) - _words(
                          "mean time work heat mass charge fuel budget start beginning middle end half halves")
# What headings say besides.
_HEADINGS = _words("""
    introduction problem formulation statement preliminaries main results description modelling modeling lecture
    controlled setup synthesis notation notations background backstepping sliding mode adaptive passivity digital
    discrete-time on-board action anti-windup event-triggered iss input-to-state observer reference
    controller law laws stabilisation performance exercise solution day week
    interconnection interconnected small-gain prescribed funnel command-filtered
""")
# By these a sentence without formulas changes what was given, or speaks of a part of it.
_TURNS = _words("""
    leader leaders follower followers literature practice half twice average averaged limited clipped sampled delayed
    saturated filter filters maximum minimum
""")
# A word for another thing, or for a part of one, where it stands otherwise than in the forms that are understood.
_OTHER = (vocabulary.GIVEN | vocabulary.MODIFIERS | things.HEADS | things.OF_THEM | _ORDINALS) - vocabulary.TEXT - (
    vocabulary.TELLING - things.HEADS) - _words("smooth continuous differentiable known bounded available scalar real")
_MARK = re.compile(r"\\(?:wide)?(?:hat|tilde|bar|check|breve)(?![A-Za-z])|_\{?[a-z]")
_CHOSEN = _words("design assumption construction choice hypothesis")
_ENSURES = _words("guarantee guarantees guaranteed ensure ensures ensured")
_NAMING = things.HEADS | things.OF_THEM
_OTHERS = _words("other another old new left right front rear inner outer same")
_SEVERAL = things.NUMBERS | _words("signals states variables")
_MODELS = _words("model models linear")  # what belongs to a model may be none of the plant's
_PLACES = _words("on at over within before after behind beyond")  # what is said of such a place holds there alone
# Names of a plant that a filter's or an error's motion has none of.
_OWN = moving.PLANTS - _words("system systems dynamics model models equation equations motion integrator")
_NO_PLANTS = moving.FILTERS | moving.BESIDE | _words("error errors deviation deviations")
_MOTIONS = _words("dynamics motion equation equations trajectories trajectory solutions solution")


def is_marked(letter: str) -> bool:
    r"""Whether a letter, or its rate, bears a mark by which it is none of the plant's, as `\\hat x` and `x_m`."""
    return letter in ("r", "w") or _MARK.search(letter) is not None


def not_understood(texts: Sequence[str], claims: bool, marked: bool) -> tuple[str, ...]:
    """The words of a sentence that are not understood where they stand; none where all are.

    texts: its words, empty for formulas and marks; claims: whether nothing is taken of what it shows; marked: whether
    the letters that it gives bear a hat or another mark, as those of what moves beside the plant do.
    """
    return _odd(texts, _CLAIMING if claims else _GIVING, marked and not claims)


def heading_not_understood(texts: Sequence[str], marked: bool) -> tuple[str, ...]:
    """The same of a heading."""
    return _odd(texts, _CLAIMING | _HEADINGS, marked)


def _odd(texts: Sequence[str], known: Collection[str], beside: bool) -> tuple[str, ...]:
    """The words that are neither known nor of a thing; beside: whether they may tell of what moves beside the plant."""
    odd: dict[str, None] = {}
    held: set[int] = set()
    for start, end in _things(texts):
        odd |= dict.fromkeys(_misplaced(texts, start, end, beside))
        held |= {*range(start, end)}
    for at, text in enumerate(texts):
        behind = texts[at + 1] if at + 1 < len(texts) else ""
        if text and at not in held and text not in known and not _goes_with(
                text, texts[at - 1] if at else "", behind):
            odd[text] = None
    return tuple(odd)


def _goes_with(text: str, before: str, behind: str) -> bool:
    """Whether a word is understood by the one beside it: `second step`, `one gets`, `time derivative`, `this means`."""
    return (text in _ORDINALS and behind in _COUNTED | {""}) or (text == "one" and behind in vocabulary.HAS) or (
        text in ("finite", "fixed") and behind == "time") or (text == "time" and before in ("finite", "fixed")) or (
        text == "used" and before in ("is", "are") and not behind) or (
        text == "updated" and behind in ("by", "according", "as", "via")) or (
        text == "time" and behind.startswith("derivative")) or (
        text == "mean" and (behind in ("value", "inequality") or before in ("that", "this", "which")))


def _things(texts: Sequence[str]) -> Iterator[tuple[int, int]]:
    """The phrases that name things: from where to where, each up to the thing itself."""
    at = 0
    while at < len(texts):
        end = at
        while end < len(texts) and texts[end] in _NAMING:
            end += 1
        last = next((place for place in range(end - 1, at - 1, -1) if texts[place] in things.HEADS), None)
        if last is not None:
            yield at, last + 1
        at = end + 1 if last is None else last + 1


def _misplaced(texts: Sequence[str], start: int, end: int, beside: bool) -> Iterator[str]:
    """The words of and before a thing by which it is another one."""
    thing, before = texts[end - 1], texts[start - 1] if start else ""
    kinds = frozenset().union(*(kinds for heads, kinds in things.KINDS if thing in heads))
    yield from (text for text in texts[start:end - 1] if text not in kinds)
    if before and before not in _BEFORE and not (thing in _SEVERAL and before in vocabulary.ALL):
        yield before
    if not beside and thing not in things.ERRORS | things.NUMBERS:
        yield from moving.BESIDE & {*texts[start:end]}
    at = start - 1 - (before in vocabulary.DETERMINERS)
    place, owner = (texts[at], texts[at - 1] if at else "") if at >= 0 else ("", "")
    if place in _PLACES and owner != "based":
        yield place
    elif place in ("of", "for", "along") and ((thing in moving.BESIDE | moving.FILTERS and owner not in _MOTIONS) or (
            thing in things.LAWS and owner in moving.PLANTS)):
        yield thing
    elif place == "of" and _MODELS & {*texts[start:end]}:
        yield from texts[start:end]


def one_of_several(texts: Sequence[str]) -> tuple[str, ...]:
    """The words by which one of several things is meant, as `second motor`; none where there are no such."""
    return next((pair for pair in pairwise(texts) if pair[0] in _ORDINALS | _OTHERS and pair[1] in things.HEADS), ())


def along_another(texts: Sequence[str], given_by: Sequence[str]) -> bool:
    """Whether a sentence claims something along a plant, where the motion was given of a filter or an error alone.

    texts: the sentence's words; given_by: those of the sentence that gives the motion.
    """
    behind = texts[texts.index("along") + 1:] if "along" in texts else ()
    return bool(_OWN & {*behind} and _NO_PLANTS & {*given_by}) and not _OWN & {*given_by}


def by_design(texts: Sequence[str]) -> bool:
    """Whether a sentence says that something holds by what is chosen or assumed, and so maybe for some values alone."""
    return bool(_ENSURES & {*texts}) or any(one == "by" and two in _CHOSEN for one, two in pairwise(texts))


def changed_by(texts: Sequence[str]) -> tuple[str, ...]:
    """The words by which a sentence without formulas may speak of another thing than was given, or of a part of it."""
    misplaced = {word for start, end in _things(texts) for word in _misplaced(texts, start, end, False)}
    return (*(word for word in not_understood(texts, True, True) if word in _OTHER | misplaced | {"mean"}),
            *(word for word in texts if word in _TURNS))
