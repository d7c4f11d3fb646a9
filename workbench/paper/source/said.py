"""The sentences of a source with what each says, and what is taken from the whole text."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from workbench.paper.source.elsewhere import drops, nouns_of_displays
from workbench.paper.source.forms import NOUNS
from workbench.paper.source.given import RATE, Gift, given_within, letter_of
from workbench.paper.source.idioms import plainly
from workbench.paper.source.leading import as_led_to
from workbench.paper.source.letters import kinds_in, letters_said
from workbench.paper.source.naming import named, of_another_value
from workbench.paper.source.narrowing import background
from workbench.paper.source.passages import Passages, Sentence, printed
from workbench.paper.source.reading import DEFINE, GIVING, Reading, heading_unknown, read_sentence
from workbench.paper.source.shown import Shown
from workbench.paper.source.telling import as_told
from workbench.paper.source.things import FUNCTIONS
from workbench.paper.source.understood import one_of_several
from workbench.proof.latex.sides import left_of, letters_of_text

LOCAL = ("theorem", "lemma", "proposition", "corollary", "remark", "example", "proof", "note", "claim", "property",
         "fact", "problem")
BEHIND = 2  # paragraphs behind a statement that may go on with what it supposes
_SAID = {"real": r"\in \mathbb{R}", "positive": "> 0", "nonnegative": r"\ge 0"}
# Words of an assumption's title beside those that are understood.
TITLES = {"matching", "condition", "conditions", "persistence", "excitation", "growth", "smoothness", "sector",
          "existence", "controllability", "observability", "detectability", "stabilizability", "regularity",
          "minimum-phase"}


@dataclass
class SaidText:
    """The sentences of a source with what each says, and the environments in which they stand.

    whats: what each environment is called, by its name; assuming: those whose text is taken as it is; formulas: what
    each display says.
    """

    body: str
    passages: Passages
    whats: Mapping[str, str]
    assuming: Collection[str]
    formulas: Mapping[int, Shown]
    readings: list[Reading] = field(init=False)
    shown: dict[int, int] = field(init=False)
    gifts: tuple[Gift, ...] = field(init=False)
    called: dict[str, list[tuple[int, str]]] = field(init=False)
    renamed: dict[str, int] = field(init=False)
    spoken_of: list[tuple[int, frozenset[str], frozenset[str]]] = field(init=False)

    def __post_init__(self) -> None:
        given = frozenset(letter for shown in self.formulas.values() for letter in shown.gives) | {
            letter for one in self.passages.sentences for letter, _ in given_within(one.words)}
        giving = {number: [*shown.gives] for number, shown in self.formulas.items() if shown.gives}
        self.readings = [read_sentence(one, self.body, self._assumes(one), given, giving)
                         for one in self.passages.sentences]
        self.readings = as_led_to(self.passages.sentences, self.readings, giving)
        self.readings = [said if self._assumes(one) else as_told(one, said, giving, given)
                         for one, said in zip(self.passages.sentences, self.readings, strict=True)]
        self.shown = {number: at for at, one in enumerate(self.readings) for number in one.shown}
        self.gifts = (*self._gifts(),)
        self.called = self._called()
        gifts = {letter_of(gift.letter) for gift in self.gifts}
        self.renamed = {letter: at for at, (one, said) in enumerate(zip(
            self.passages.sentences, self.readings, strict=True)) if not said.shown for letter in said.letters & gifts
            if one_of_several([word.text for word in one.words]) or of_another_value(one.words, (letter,))}
        self.spoken_of = nouns_of_displays(self.passages.sentences, self.readings, {
            number: [*shown.gives] for number, shown in self.formulas.items()})

    def _called(self) -> dict[str, list[tuple[int, str]]]:
        """What the text calls each letter, with the sentence that does so."""
        found: dict[str, list[tuple[int, str]]] = {}
        for at, one in enumerate(self.passages.sentences):
            for letter, name in named(plainly(one.words)):
                found.setdefault(letter, []).append((at, name))
        for gift in self.gifts:
            words = {word.text for word in self.passages.sentences[gift.at].words}
            if not gift.letter.startswith(RATE) and words & FUNCTIONS:
                found.setdefault(gift.letter, []).append((gift.at, "function"))
        return found

    def _names(self, sentence: Sentence) -> list[str]:
        return [self.passages.scopes[scope] for scope in sentence.place.scopes]

    def _assumes(self, sentence: Sentence) -> bool:
        return any(name.removesuffix("*") in self.assuming for name in self._names(sentence))

    def local(self, sentence: Sentence) -> bool:
        """Whether what a sentence says of letters is said for its own environment alone."""
        return sentence.aside or any(
            name.startswith("?") or self._what(name) in LOCAL for name in self._names(sentence))

    def _what(self, name: str) -> str:
        """The noun by which an environment is called, from its name."""
        return self.whats.get(name.removesuffix("*"), "proof").lower().split()[-1]

    def facts(self) -> str:
        """What the whole text says of letters, for the whole paper."""
        facts = [fact for sentence, reading in zip(self.passages.sentences, self.readings, strict=True)
                 for fact in reading.facts if not self.local(sentence) or (
                     fact.startswith(DEFINE) and self._proves(sentence))]
        return "\n\n".join(f"{fact}." for fact in (*facts, *self._quantified(facts)))

    def _quantified(self, facts: Collection[str]) -> Iterator[str]:
        """What claims say of the letters of all of which they speak, where nothing else is said of those anywhere."""
        told = {letter for fact in facts for letter in letters_said(fact)}
        told |= {letter_of(gift.letter) for gift in self.gifts}
        kinds: dict[str, set[str]] = {}
        for reading in self.readings:
            for formula in reading.quantified:
                for letter, kind in kinds_in(formula):
                    kinds.setdefault(letter, set()).add(kind)
        for letter, found in kinds.items():
            if letter not in told and len(found) == 1:
                yield rf"${letter} {_SAID[found.pop()]}$"

    def _defines(self, gift: Gift) -> bool:
        """Whether a sentence defines the letter to which it gives a value."""
        return any(gift.letter in letters_of_text(fact.removeprefix(DEFINE).strip("$").partition("=")[0])
                   for fact in self.readings[gift.at].facts if fact.startswith(DEFINE))

    def limits(self) -> list[str]:
        """The bounds of constants and signals that the text states for the whole paper, but of what it bounds twice."""
        found = [(one, limit, frozenset(letters_of_text(left_of(limit)))) for one, reading in zip(
            self.passages.sentences, self.readings, strict=True) for limit in reading.limits]
        return [limit for sentence, limit, of in found if not self.local(sentence) and not any(
            of == another for other, _, another in found if other is not sentence)]

    def understood(self, start: int, end: int) -> bool:
        """Whether all sentences between two places of the body are, and the titles of their environments."""
        return not any(reading.unknown or self._titled(sentence) for sentence, reading in
                       zip(self.passages.sentences, self.readings, strict=True)
                       if start <= sentence.words[0].start < end)

    def kept(self, labels: Collection[str], number: str) -> bool:
        """Whether no sentence that is not understood may take back an assumption."""
        return not any(said.unknown and drops(sentence, labels, number) for sentence, said in
                       zip(self.passages.sentences, self.readings, strict=True))

    def _titled(self, sentence: Sentence) -> bool:
        """Whether an environment in which a sentence stands has a title that is not understood."""
        return any({*heading_unknown(self.passages.titles[scope], True)} - TITLES for scope in sentence.place.scopes)

    def _proves(self, sentence: Sentence) -> bool:
        return any(name.removesuffix("*") not in self.whats for name in self._names(sentence))

    def _heading(self, sentence: Sentence) -> list[str]:
        """The words of the headings above a sentence."""
        found = [word.text for one in sentence.place.headings for word in self.passages.headings[one]]
        return [*found, "abstract"] if sentence.words[0].start < self.body.find(r"\end{abstract}") else found

    def _background(self, sentence: Sentence) -> bool:
        """Whether what a sentence tells says nothing of what is given."""
        return background(self._heading(sentence))

    def _gifts(self) -> Iterator[Gift]:
        """What displays and the text give letters, in order."""
        for at, (sentence, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            for letter, value in given_within(sentence.words):
                yield Gift(at, letter, value, "inline")
            for number, form in said.shown.items():
                if form in GIVING:
                    for letter, value in self.formulas[number].gives.items():
                        yield Gift(at, letter, value, form)

    def _holds_at(self, other: Sentence, sentence: Sentence) -> bool:
        """Whether what a sentence says may hold where another stands: in its environment; of a statement, in proofs and
        in what is said directly behind it."""
        scopes, own = other.place.scopes, sentence.place.scopes
        stated = not self._proves(other)
        proof = self._proves(sentence)
        near = sentence.place.paragraphs[0] - other.place.paragraphs[-1] <= BEHIND
        behind = near and scopes[:-1] == own and not self._assumes(other)
        return own[:len(scopes)] == scopes or (stated and (proof or behind))

    def _told(self, at: int) -> str:
        unknown = self.readings[at].unknown or self.readings[at].beyond
        sentence = printed(self.passages.sentences[at], self.body)
        return f"{quoted(unknown)} in '{sentence}'" if unknown else f"'{sentence}'"

    def nouns(self) -> dict[str, dict[str, int]]:
        """The letters that the text calls by a noun, as the gains $k$ and $c$, and which sentence does so first."""
        found: dict[str, dict[str, int]] = {}
        for at, (sentence, reading) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            if reading.facts:
                for word in sentence.words:
                    if word.kind == "word" and word.text in NOUNS:
                        for form in (word.text, word.text.removesuffix("s"), f"{word.text}s"):
                            found[form] = dict.fromkeys(reading.letters, at) | found.get(form, {})
        return found


def quoted(words: Sequence[str]) -> str:
    """The first of some words, each in quotation marks."""
    return ", ".join(f"'{word}'" for word in words[:6]) + (", ..." if len(words) > 6 else "")
