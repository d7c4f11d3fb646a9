"""Turns of phrase that say what one plain word says: `it is not difficult to see`, `can be easily written`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from workbench.paper.source.passages import Word
from workbench.paper.source.vocabulary import ADVERBS, DERIVED, MADE, NAMES, SEEN, TEXT
from workbench.paper.source.words import VERBS

_NOTED = "noted|remarked|emphasized|mentioned|stressed|observed|recalled|pointed"
_WORTH = "noting|mentioning|pointing|remarking|recalling|emphasizing|observing"
# What is said, words parted by bars standing for one another, and the words for it; "$" is the first word itself.
_IDIOMS = tuple((tuple(frozenset(word.split("|")) for word in said.split()), plain.split()) for said, plain in (
    ("it is not difficult|hard to", "it is easy to"),
    (f"it should|must|may|can be {_NOTED} out that", "note that"),
    (f"it should|must|may be {_NOTED} that", "note that"),
    (f"it is worth {_WORTH} out that", "note that"), (f"it is worth {_WORTH} that", "note that"),
    ("in what follows", "here"), ("in the end", "finally"),
    ("as desired|required|wished", "as stated"), ("at once", "immediately"), ("the claim follows", "it follows"),
    ("let's", "let us"), ("model reference adaptive", "adaptive"), ("model-reference adaptive", "adaptive"),
    ("twice|thrice continuously differentiable", "smooth"),
    ("sufficiently|infinitely smooth", "smooth"),
    ("we|one can", "$"), ("keep|bear in mind that", "note that"), ("after|by some", "$"), ("as can be", "as is"),
    ("some algebra|algebraic|calculation|calculations|manipulation|manipulations|simple|steps|computations", "simple"),
    ("terms of indefinite|unknown sign", "terms"),
    ("left with", "arrive at"), ("end up with", "arrive at"),
    ("evolves|behaves|moves according to", "satisfies"), ("leads to", "gives"), ("results in", "gives")))


def plainly(words: Sequence[Word]) -> tuple[Word, ...]:
    """A sentence with its turns of phrase replaced by plain words, each in its place."""
    found: list[Word] = []
    at = 0
    while at < len(words):
        texts = [word.text if word.kind == "word" else "" for word in words[at:at + 8]]
        length, said = _idiom(texts)
        if length:
            found += [replace(words[at], text=text, end=words[at + length - 1].end) for text in said]
            at += length
        elif words[at].text == "-" and found and found[-1].kind == "reference":  # (3)--(5)
            after = at + 1 + (at + 1 < len(words) and words[at + 1].text == "-")
            is_range = after < len(words) and words[after].kind == "reference"
            found.append(replace(words[at], text="to", kind="word") if is_range else words[at])
            at = after if is_range else at + 1
        elif texts[0] in ("e.g.", "see") and [word.kind for word in words[at + 1:at + 2]] == ["cite"]:
            at += 2
        elif words[at].kind == "cite" and found and found[-1].text in (*NAMES, *DERIVED, *TEXT, "see", "e.g.", "in"):
            at += 1  # where it can be read
        else:
            found.append(words[at])
            at += 1
    return tuple(found)


def _idiom(texts: Sequence[str]) -> tuple[int, tuple[str, ...]]:
    """How many words an idiom has, none where there is none, and the words for it."""
    for said, plain in _IDIOMS:
        if len(texts) >= len(said) and all(text in words for text, words in zip(texts, said, strict=False)):
            return len(said), tuple(texts[0] if word == "$" else word for word in plain)
    if texts[0] in ("can", "may"):
        length = 1
        adverbs: list[str] = []
        while length < len(texts) and (texts[length] in ADVERBS or texts[length] == "be"):
            adverbs += [texts[length]] if texts[length] != "be" else []
            length += 1
        if "be" in texts[1:length] and length < len(texts) and texts[length] in MADE | SEEN | VERBS:
            return length, ("is", *adverbs)
    return 0, ()
