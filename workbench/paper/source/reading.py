"""What the sentences of a source say of its displayed formulas and letters, as far as they are understood.

A sentence is understood if all of it has one of the forms of `forms`. From any other nothing is taken, and what it may
take back, restrict or define anew is left to the author.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import pairwise
from types import MappingProxyType

from workbench.paper.source import forms, narrowing, things, understood, vocabulary
from workbench.paper.source.classes import classes_of, formula_class
from workbench.paper.source.given import RATE, letter_of
from workbench.paper.source.idioms import plainly
from workbench.paper.source.passages import Sentence, Word
from workbench.paper.source.plain import chosen, described, exchanges, letters_within, neutral, numbered, revalued

DEFINE = "Define "  # with this a fact begins that gives a letter a value
MOVE = "Move "  # and with this one that gives a letter a rate
GIVING = ("given", "defined", "bare")  # what of a display gives letters values or rates
EVERYTHING = "*"  # stands for all letters, where a sentence without any may restrict them
LONGEST = 220  # words of a sentence that is read; a longer one is left to the author
# A value behind one of these is that of what it names: `the analysis is based on the function ...`.
_CHOSEN = {"function", "functional", "candidate", "law", "controller", "observer", "filter", "surface"}
# Of what is so called a bound may be stated for the whole paper.
_BOUNDED = things.SIGNALS - {"signal", "signals"} | narrowing.words_of(
    "constant constants gain gains parameter parameters coefficient coefficients")
_POINTING = {"it", "this", "they", "these", "them", "that"}
# Whose letters are not the plant's.
_STRANGERS = {"leader", "leaders", "follower", "followers", "agent", "agents", "neighbour", "neighbor", "node", "nodes",
              "competitor", "baseline", "benchmark"}
_REACHES = {"arrive", "arrives", "arrived", "result", "results", "resulting", "left"}  # ... at a formula, with it


@dataclass(frozen=True)
class Reading:
    """What a sentence says. Nothing else than `unknown` where it is not understood.

    shown: for each of its displays whether it is claimed, stated of what follows, given, defined, or supposed; bare
    where no word stands with it. facts: what it says of letters, as printed. tied: displays that it says of some values
    alone. restricted: the letters of what it supposes. limits: bounds of constants and signals, for the whole paper.
    quantified: what it says of the letters of all of which it claims something. letters: those of its formulas.
    unknown: the words that are not understood. beyond: where it shows and says nothing, those by which it may tell that
    something else acts.
    """

    shown: Mapping[int, str] = field(default_factory=dict)
    facts: tuple[str, ...] = ()
    tied: frozenset[int] = frozenset()
    restricted: frozenset[str] = frozenset()
    limits: tuple[str, ...] = ()
    quantified: tuple[str, ...] = ()
    letters: frozenset[str] = frozenset()
    unknown: tuple[str, ...] = ()
    beyond: tuple[str, ...] = ()


def read_sentence(sentence: Sentence, body: str, assuming: bool = False, given: Collection[str] = frozenset(),
                  giving: Mapping[int, Collection[str]] = MappingProxyType({})) -> Reading:
    """What a sentence says, if it is understood; assuming: that it stands in the text of an assumption; given: the
    letters that the text gives values; giving: the displays that give some, with the letters."""
    words = plainly(sentence.words)
    if words and words[0].kind == "table":
        letters = frozenset(letter for word in words if word.kind == "math" for letter in letters_within(word.text))
        return Reading(letters=letters, restricted=letters)
    if all(word.kind in ("display", "mark") for word in words):  # or no word at all, as in a rule or a list
        return Reading({int(word.text): "bare" for word in words if word.kind == "display"})
    return _read(words, body, assuming, given, giving)


def _read(words: Sequence[Word], body: str, assuming: bool, given: Collection[str],
          giving: Mapping[int, Collection[str]]) -> Reading:
    asks = words[-1].text == "?"
    while words and words[-1].kind == "mark" and words[-1].text in ".!;,":
        words = words[:-1]
    letters = frozenset(letter for word in words if word.kind == "math" for letter in letters_within(word.text))
    shown = [int(word.text) for word in words if word.kind == "display"]
    classes = classes_of(words)
    texts = [word.text if word.kind == "word" else "" for word in words]
    if not_whole := narrowing.up_to(texts):
        return Reading(dict.fromkeys(shown, ""), letters=letters, unknown=not_whole)
    rule = "assumes" if assuming else "sentence"
    found = _matched(rule, tuple(classes)) if len(words) <= LONGEST and not asks else None
    told: frozenset[int] = frozenset()  # places of words that say what a letter stands for
    if found is None and len(words) <= LONGEST and not asks:
        opened, told = described(words, classes)
        found = _matched(rule, opened) if told else None
    if found is None and not shown and not asks and neutral(classes) and not exchanges(words, classes):
        said = _neutrally(texts, letters, revalued(words, classes, texts, given))
        if not numbered(words, texts):
            return said
        whole = frozenset((EVERYTHING,)) if {*texts} & _BOUNDED else frozenset()
        return replace(said, restricted=said.restricted | (letters or whole))
    if found is None and shown and not asks and not assuming and _loose(classes):
        said = Reading(_loosely(words, classes), tied=frozenset(shown), letters=letters)
    elif found is None:
        return Reading(dict.fromkeys(shown, ""), letters=letters, unknown=_unknown(words, classes))
    else:
        said = _said(words, found, body, letters, told)
        said = replace(said, restricted=said.restricted | chosen(words, classes, told))
    if odd := _no_limits(said, words, found or (), given):
        return Reading(dict.fromkeys(shown, ""), letters=letters, unknown=odd)
    taken = {*range(len(texts))}.difference(*(range(start, end) for rule, start, end in found or ()
                                              if rule in ("fact", "bounded", "limit", "moved")))
    bound = [words[at].text for at in sorted(taken) if classes[at] in (
        forms.SIGN, forms.RELATION, forms.MOVES, forms.NONZERO, forms.BOUND)]
    return _whole(said, texts, [text if at in taken else "" for at, text in enumerate(texts)], bound, giving)


def _no_limits(said: Reading, words: Sequence[Word], found: Sequence[tuple[str, int, int]],
               given: Collection[str]) -> tuple[str, ...]:
    """The letters that bounds of a sentence restrict, where these are no bounds of constants and signals alone."""
    within = {letter for one in said.limits for letter in letters_within(one)}
    named = all({word.text for word in words[start:end]} & _BOUNDED for rule, start, end in found if rule == "bounded")
    return tuple(sorted(within)) if not named or within & {*map(letter_of, given)} else ()


def _neutrally(texts: Sequence[str], letters: frozenset[str], values: tuple[str, ...]) -> Reading:
    """What a sentence of plain words says: nothing, but that it may change or restrict what it speaks of; values: the
    expressions that it may give."""
    restricted = letters if narrowing.SIGNED & {*texts} else frozenset()
    if not letters and narrowing.LIMITING & {*texts}:
        restricted = frozenset((EVERYTHING,))
    changing = narrowing.changing(texts) if letters or {*texts} & (things.HEADS | _POINTING) else ()
    return Reading(letters=letters, restricted=restricted, unknown=values or changing or understood.changed_by(texts))


def _whole(said: Reading, texts: Sequence[str], taken: Sequence[str], bound: Sequence[str],
           giving: Mapping[int, Collection[str]]) -> Reading:
    """What a sentence says; nothing where it speaks of a thing that is not understood, or gives a value or says a fact
    of a part of the motion alone. taken: its words but those that say what letters are; bound: its relations."""
    given = {letter for number, form in said.shown.items() if form in GIVING
             for letter in giving.get(number, ())} or {fact for fact in said.facts if fact.startswith((DEFINE, MOVE))}
    if given and all(letter.startswith("\\") and not letter.startswith(RATE) for letter in given):
        # Of backstepping: a letter of its own, and no input of a plant, which no paper calls by a Greek letter.
        taken = [text for text, behind in zip(taken, (*taken[1:], ""), strict=True)
                 if text != "virtual" or behind not in things.LAWS]
    if said.shown or given:
        odd = understood.not_understood(taken, not given, any(map(understood.is_marked, given))) or (
            (*bound, *(_STRANGERS & {*texts})) if given else narrowing.in_coordinates(texts))
    else:
        odd = () if said.limits or any("$" in fact for fact in said.facts) else understood.changed_by(texts)
    if odd:
        return Reading(dict.fromkeys(said.shown, ""), letters=said.letters, unknown=tuple(odd))
    if understood.by_design(texts):
        said = replace(said, tied=said.tied | {*said.shown})
    gives = {*said.shown.values()} & {*GIVING}
    phrase = narrowing.partial(texts) if gives else narrowing.begins_partial(texts) if said.facts else ()
    if not phrase:
        return said
    return Reading(dict.fromkeys(said.shown, ""), letters=said.letters, unknown=phrase)


@lru_cache(maxsize=1024)
def _matched(rule: str, classes: tuple[str, ...]) -> tuple[tuple[str, int, int], ...] | None:
    return forms.GRAMMAR.match(rule, classes)


def _said(words: Sequence[Word], found: Sequence[tuple[str, int, int]], body: str, letters: frozenset[str],
          told: frozenset[int]) -> Reading:
    said = {int(word.text): "supposed" for word in words if word.kind == "display"}
    for rule, start, end in found:  # what stands within comes behind what holds it
        if rule in ("claimed", "stated", "given", "defined", "supposed"):
            for word in words[start:end]:
                if word.kind == "display":
                    outer = said.get(int(word.text), "")
                    said[int(word.text)] = outer if outer in ("stated", "given") and rule == "claimed" else rule
    laid = [word for rule, start, end in found if rule == "laid" for word in words[start:end] if word.kind == "display"]
    said |= {int(word.text): "bare" for word in laid}
    defines = any(form in GIVING for form in said.values()) or not said
    facts = [body[words[start].start:words[end - 1].end] if told.isdisjoint(range(start, end)) else " and ".join(
        body[word.start:word.end] for word in words[start:end] if word.kind == "math")
        for rule, start, end in found if rule == "inset" or (rule == "fact" and _is_taken(words[start:end], defines))]
    facts += [f"{DEFINE}{body[words[start].start:words[end - 1].end]}" for rule, start, end in found if rule == "value"]
    facts += [f"{MOVE}{body[word.start:word.end]}" for rule, start, end in found if rule == "moved"
              for word in words[start:end] if word.kind == "math"]
    facts += [f"${word.text}$" for rule, start, end in found if rule == "both" for word in words[start:end]
              if word.kind == "math" and formula_class(word.text) in (forms.REAL, forms.SIGN)]
    facts += [" and ".join(f"${word.text}$" for word in words[start:end] if formula_class(word.text) == forms.LETTERS)
              + " are constants" for rule, start, end in found if rule == "suits"]
    limits = [word.text for rule, start, end in found if rule == "limit" for word in words[start:end]
              if word.kind == "math"]
    limits += [word.text for rule, start, end in found if rule in ("fact", "both") for word in words[start:end]
               if word.kind == "math" and formula_class(word.text) == forms.NONZERO]
    limits = limits if {*said.values()} <= {*GIVING} else []
    if laid and not any(re.search(r"[A-Za-z]{3}|\\in", fact.split("$")[0]) or r"\in" in fact for fact in facts):
        return Reading(said, (), frozenset(said), letters=letters)  # with $z > 0$ alone, of such a z
    restricted = {letter for rule, start, end in found if rule in ("held", "then", "supposed", "unsigned", "judged")
                  for word in words[start:end] if word.kind == "math" for letter in letters_within(word.text)}
    bare = [(rule, start, end) for rule, start, end in found
            if rule == "fact" and not _is_taken(words[start:end], defines)]
    bare += [one for one in found if one[0] == "limit" and not limits]
    every = tuple(word.text for rule, start, end in found if rule == "quantified" for word in words[start:end]
                  if word.kind == "math" and formula_class(word.text) in (forms.REAL, forms.SIGN))
    return Reading(said, tuple(facts), _tied(words, found, bare), frozenset(restricted), tuple(limits), every, letters)


def _is_taken(words: Sequence[Word], defines: bool) -> bool:
    """Whether a fact counts for the whole paper: a sign alone, beside what is claimed, may be said for that alone."""
    return defines or any(word.kind == "word" or r"\in" in word.text for word in words)


def _tied(words: Sequence[Word], found: Sequence[tuple[str, int, int]],
          bare: Sequence[tuple[str, int, int]]) -> frozenset[int]:
    """The displays that a relation restricts: those of its clause, those behind it, and those before that are not said
    to hold by themselves."""
    clauses = [(start, end) for rule, start, end in found if rule == "clause"]
    held = [(start, end) for start, end in clauses if any(
        rule == "holds" and start <= one and two <= end for rule, one, two in found)]
    tied: set[int] = set()
    for _, start, end in (*(one for one in found if one[0] in ("restricts", "restricts_bare")), *bare):
        own = next((one for one in clauses if one[0] <= start and end <= one[1]), (0, len(words)))
        before = any(word.kind == "display" for word in words[own[0]:start])
        for place, word in enumerate(words):
            if word.kind == "display" and (place >= own[0] or (before and not any(
                    one <= place < two for one, two in held))):
                tied.add(int(word.text))
    return frozenset(tied)


def _loose(classes: Sequence[str]) -> bool:
    """Whether a sentence is made of words alone that claim what it shows, in whatever form; what stands before
    "implies" may be a condition."""
    plain = (forms.LETTERS, forms.REAL, forms.VALUE, forms.TIME, forms.REFERENCE, forms.SIGN, forms.RELATION,
             forms.BOUND, forms.DEFINES, forms.DISPLAY, ",", ":", ";")
    if not all(one in forms.LOOSE or one in plain for one in classes):
        return False
    pairs = [*pairwise(classes)]
    return not any((one == forms.DISPLAY and two in vocabulary.GIVES) or (one == "let" and two != "us")
                   for one, two in pairs)


def _loosely(words: Sequence[Word], classes: Sequence[str]) -> dict[int, str]:
    """What such a sentence says of each of its displays: behind "with" it may be a condition; it is claimed where words
    before it say that it follows, and given elsewhere."""
    said: dict[int, str] = {}
    start = 0
    for place, word in enumerate(words):
        if word.kind == "display":
            before = classes[start:place]
            held = before[-1:] and before[-1] in vocabulary.HELD and not {*before[-2:-1]} & _REACHES
            named = classes[place + 1:place + 2] in (["is"], ["are"])  # V = x^2 is positive
            chosen = narrowing.chooses(classes) or (before[-1:] and before[-1] in _CHOSEN)
            follows = not named and (forms.FOLLOWS & {*before} or (start and not before) or not chosen)
            said[int(word.text)] = "defined" if held else "stated" if follows else "given"
            start = place + 1
    return said


def _unknown(words: Sequence[Word], classes: Sequence[str]) -> tuple[str, ...]:
    """The words that no form has; all of them where each is known and the form is not."""
    known = forms.KNOWN | forms.NEUTRAL
    odd = [word.text for word, one in zip(words, classes, strict=True)
           if word.kind not in ("math", "display", "mark", "reference") and one not in known]
    return tuple(dict.fromkeys(odd)) or tuple(word.text for word in words if word.kind == "word")


def heading_unknown(words: Sequence[Word], marked: bool) -> tuple[str, ...]:
    """The words of a heading that are not understood; none where all are. marked: whether what it stands over bears a
    mark, as what moves beside the plant does."""
    texts = [word.text if word.kind == "word" else "" for word in plainly(words)]
    return (*(word.text for word in words if word.kind in ("odd", "command", "cite")),
            *understood.heading_not_understood(texts, marked))
