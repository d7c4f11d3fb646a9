"""Which sentences stand so near to one another that the one may speak of what the other shows."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from workbench.paper.source.passages import Sentence
from workbench.paper.source.reading import Reading
from workbench.paper.source.understood import not_understood
from workbench.paper.source.vocabulary import DERIVED, POINTERS, TEXT

# Words by which a sentence may speak of what stands before it: pronouns and the names of formulas.
POINTING = POINTERS | DERIVED | TEXT
SHORT = 5  # words of a sentence that speaks of what stands before it, whatever they are


def as_led_to(sentences: Sequence[Sentence], readings: Sequence[Reading],
              giving: Mapping[int, Collection[str]]) -> list[Reading]:
    """What each sentence says; a display by itself, that gives something, says nothing where the sentence that leads to
    it is not understood. giving: the displays that give letters something, with these."""
    found = [*readings]
    for at, (sentence, said) in enumerate(zip(sentences, readings, strict=True)):
        alone = sentence.words[0].kind == "display" and any(
            form == "bare" and one in giving for one, form in said.shown.items())
        if not at or not alone or readings[at - 1].shown or readings[at - 1].facts or (
                sentences[at - 1].place.paragraphs != sentence.place.paragraphs[:1]):
            continue
        texts = [word.text if word.kind == "word" else "" for word in sentences[at - 1].words]
        if odd := not_understood(texts, False, True):
            found[at] = Reading(dict.fromkeys(said.shown, ""), unknown=odd)
    return found


def points(sentence: Sentence) -> bool:
    """Whether a sentence may speak of what stands beside it: by a pronoun, a formula's name, or as it is short."""
    words = [word for word in sentence.words if word.kind == "word"]
    return len(words) <= SHORT or any(word.text in POINTING for word in words) or any(
        word.kind in ("reference", "display") for word in sentence.words)


def near(other: Sentence, sentence: Sentence) -> bool:
    """Whether a sentence stands in the paragraph of another, or as the first one behind that and pointing back."""
    own = other.place.paragraphs if points(other) else other.place.paragraphs[-1:]
    return bool({*own} & {*sentence.place.paragraphs})
