"""What the text of a source lets be decided of each displayed formula: that it is true, that it is false, neither."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from workbench.paper.source.forms import NOUNS
from workbench.paper.source.letters import letters_said, says_sign, signed_by_words, values_and_rates
from workbench.paper.source.passages import Passages, Sentence
from workbench.paper.source.reading import Reading, heading_unknown, printed, read_sentence
from workbench.paper.source.vocabulary import DERIVED, POINTERS, TEXT

LOCAL = ("theorem", "lemma", "proposition", "corollary", "remark", "example", "proof", "note", "claim", "property",
         "fact", "problem")
# Words by which a sentence may speak of what stands before it: pronouns and the names of formulas.
POINTING = POINTERS | DERIVED | TEXT
BEHIND = 2  # paragraphs behind a statement that may go on with what it supposes
SHORT = 5  # words of a sentence that speaks of what stands before it, whatever they are
ASIDE = {"remark", "note", "definition", "assumption"}  # environments that may speak of what stands around them
# Nouns and adjectives by which a letter that had a sign is said to be something else.
OTHERWISE = {"real", "number", "numbers", "scalar", "scalars", "function", "functions", "variable", "variables",
             "signal", "signals", "timevarying", "state", "input", "disturbance", "output", "vector", "matrix"}
# Words of an assumption's title beside those that are understood.
TITLES = {"matching", "condition", "conditions", "persistence", "excitation", "growth", "smoothness", "sector",
          "existence", "controllability", "observability", "detectability", "stabilizability", "regularity",
          "minimum-phase"}
_RATE = r"\dot{"  # what the rate of a letter is called where displays give it
ALL = ("all", "every", "each", "any", "throughout", "everywhere", "always", "both", "paper", "none", "no", "never")


@dataclass(frozen=True)
class Standing:
    """What is known of a display.

    form: as `Reading.shown` says. unread: why nothing is claimed of it or taken from it, a line each; named: why it is
    not claimed, as sentences elsewhere that name it may take it back. doubts: why it is not refuted: what may restrict
    its letters. contested: of its letters those of which something is said there that is not understood; signed: those
    of which a sign is said. tied: whether it is said of some values alone. letters: those that it is made of.
    """

    form: str
    unread: tuple[str, ...] = ()
    named: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()
    contested: frozenset[str] = frozenset()
    signed: frozenset[str] = frozenset()
    tied: bool = False
    letters: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Shown:
    """What a display says: its letters, and the letters that it gives values or rates, with those; nothing else."""

    letters: frozenset[str]
    gives: Mapping[str, str]


@dataclass
class Text:
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

    def __post_init__(self) -> None:
        self.readings = [read_sentence(one, self.body, self._assumes(one)) for one in self.passages.sentences]
        self.shown = {number: at for at, one in enumerate(self.readings) for number in one.shown}

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
        return "\n\n".join(f"{fact}." for sentence, reading in zip(self.passages.sentences, self.readings, strict=True)
                           if not self.local(sentence) for fact in reading.facts)

    def understood(self, start: int, end: int) -> bool:
        """Whether all sentences between two places of the body are, and the titles of their environments."""
        return not any(reading.unknown or self._titled(sentence) for sentence, reading in
                       zip(self.passages.sentences, self.readings, strict=True)
                       if start <= sentence.words[0].start < end)

    def _titled(self, sentence: Sentence) -> bool:
        """Whether an environment in which a sentence stands has a title that is not understood."""
        return any({*heading_unknown(self.passages.titles[scope])} - TITLES for scope in sentence.place.scopes)

    def standing(self, display: int, letters: Collection[str], names: Collection[str], nouns: Mapping[str, set[str]],
                 facts: Mapping[str, str]) -> Standing:
        """What may be decided of a display.

        letters: its own and those that they are made of; names: its labels and number; nouns: the letters that the text
        calls by a noun; facts: what the whole text says of a letter.
        """
        at = self.shown[display]
        sentence, reading = self.passages.sentences[at], self.readings[at]
        doubts: list[str] = []
        contested: set[str] = set()
        signed: set[str] = set()
        for before, (other, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            near = _near(other, sentence)
            aside = other.aside or (said.unknown and {self._what(name) for name in self._names(other)} <= ASIDE)
            untold = self._assumes(other) and self._titled(other)
            if not (before < at or near) or not (aside or untold or self._holds_at(other, sentence)):
                continue
            words = {word.text for word in other.words if word.kind == "word"}
            hidden = frozenset(letter for one in said.shown if said.unknown for letter in self.formulas[one].letters)
            spoken = said.letters | hidden | {letter for word in words for letter in nouns.get(word, ())}
            if said.unknown:
                contested |= spoken
                section = other.place.headings[:1] == sentence.place.headings[:1]
                if spoken & {*letters} or words & {*ALL} or near or (section and not said.letters):
                    doubts.append(self._told(before))
            differs = self._differs(said, facts) if self.local(other) else set()
            contested |= differs
            supposed = self._supposed(said, display, self._assumes(other))
            supposed |= said.letters if untold else set()
            signed |= {letter for fact in said.facts for letter in signed_by_words(fact)}
            if (said.restricted | supposed | differs) & {*letters}:
                doubts.append(self._told(before))
        contested |= self._anew(at)
        if display in reading.tied:
            doubts.append(self._told(at))
        return Standing(reading.shown[display], tuple(dict.fromkeys(self._unread(at))),
                        tuple(dict.fromkeys(self._named(names))), tuple(dict.fromkeys(doubts)),
                        frozenset(contested & {*letters}), frozenset(signed & {*letters}), display in reading.tied,
                        frozenset(letters))

    def _supposed(self, said: Reading, display: int, assuming: bool) -> set[str]:
        """The letters of the other displays of a sentence that it supposes, or gives though they define nothing; of an
        assumption those that hold for some values, too."""
        others = [one for one, form in said.shown.items() if one != display and not self.formulas[one].gives
                  and (form in ("defined", "supposed", "given") or (assuming and one in said.tied))]
        return {letter for one in others for letter in self.formulas[one].letters}

    def _anew(self, at: int) -> set[str]:
        """The letters that the text has given two different values, or a sign and then another kind, before a sentence
        ends."""
        values: dict[str, str] = {}
        moved: list[tuple[str, str]] = []
        signed: set[str] = set()
        anew = set()
        for sentence, said in zip(self.passages.sentences[:at + 1], self.readings, strict=False):
            inline = {} if self.local(sentence) else {letter: value for fact in said.facts if fact.startswith("Define ")
                                                      for letter, value in values_and_rates(fact[8:-1])[0].items()}
            for fact in said.facts if not self.local(sentence) else ():
                letters = letters_said(fact)
                if says_sign(fact):
                    signed |= letters
                elif OTHERWISE & {*fact.replace("-", "").split()}:
                    anew |= letters & signed
            shown = [self.formulas[one].gives for one, form in said.shown.items() if form in ("given", "defined")]
            rates = [pair for given in shown for pair in given.items() if pair[0].startswith(_RATE)]
            again = [*moved, *rates] if "defined" in said.shown.values() else rates  # another may be claimed
            anew |= {letter[len(_RATE):-1] for letter, rate in rates
                     for other, known in again if letter == other and rate.split() != known.split()}
            moved += rates
            for letter, value in (pair for given in (inline, *shown) for pair in given.items()):
                if values.setdefault(letter, value).split() != value.split():
                    anew.add(letter)
        return anew

    def _differs(self, said: Reading, facts: Mapping[str, str]) -> set[str]:
        """The letters of which a sentence says something that the whole text does not."""
        told = {letter for letter in said.letters if facts.get(letter) not in said.facts} if said.facts else set()
        return told | said.restricted

    def _holds_at(self, other: Sentence, sentence: Sentence) -> bool:
        """Whether what a sentence says may hold where another stands: in its environment; of a statement, in proofs and
        in what is said directly behind it."""
        scopes, own = other.place.scopes, sentence.place.scopes
        stated = not any(name.removesuffix("*") not in self.whats for name in self._names(other))
        proof = any(name.removesuffix("*") not in self.whats for name in self._names(sentence))
        near = sentence.place.paragraphs[0] - other.place.paragraphs[-1] <= BEHIND
        behind = near and scopes[:-1] == own and not self._assumes(other)
        return own[:len(scopes)] == scopes or (stated and (proof or behind))

    def _named(self, names: Collection[str]) -> Iterator[str]:
        """The sentences that are not understood and name one of some rows."""
        for at, (one, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            if said.unknown and any(name.strip().strip("()") in names for word in one.words if word.kind == "reference"
                                    for name in word.text.split(",")):
                yield self._told(at)

    def _unread(self, at: int) -> Iterator[str]:
        """Why what is shown in a sentence may be taken back, or said of something else."""
        sentence = self.passages.sentences[at]
        for heading in sentence.place.headings:
            if unknown := heading_unknown(self.passages.headings[heading]):
                yield f"heading with {_quoted(unknown)}"
        for scope in sentence.place.scopes:
            name = self.passages.scopes[scope]
            if name.startswith("?"):
                yield f"environment {name[1:]!r}"
            elif unknown := heading_unknown(self.passages.titles[scope]):
                yield f"title with {_quoted(unknown)}"
        for other, (one, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            if said.unknown and (other == at or (_near(one, sentence) and (abs(other - at) == 1 or _points(one)))):
                yield self._told(other)

    def _told(self, at: int) -> str:
        unknown = self.readings[at].unknown
        sentence = printed(self.passages.sentences[at], self.body)
        return f"{_quoted(unknown)} in '{sentence}'" if unknown else f"'{sentence}'"

    def nouns(self) -> dict[str, set[str]]:
        """The letters that the text calls by a noun, as the gains $k$ and $c$."""
        found: dict[str, set[str]] = {}
        for sentence, reading in zip(self.passages.sentences, self.readings, strict=True):
            if reading.facts:
                for word in sentence.words:
                    if word.kind == "word" and word.text in NOUNS:
                        for form in (word.text, word.text.removesuffix("s"), f"{word.text}s"):
                            found.setdefault(form, set()).update(reading.letters)
        return found


def _points(sentence: Sentence) -> bool:
    """Whether a sentence may speak of what stands beside it: by a pronoun, a formula's name, or as it is short."""
    words = [word for word in sentence.words if word.kind == "word"]
    return len(words) <= SHORT or any(word.text in POINTING for word in words) or any(
        word.kind in ("reference", "display") for word in sentence.words)


def _near(other: Sentence, sentence: Sentence) -> bool:
    """Whether a sentence stands in the paragraph of another, or as the first one behind that and pointing back."""
    own = other.place.paragraphs if _points(other) else other.place.paragraphs[-1:]
    return bool({*own} & {*sentence.place.paragraphs})


def _quoted(words: Sequence[str]) -> str:
    return ", ".join(f"'{word}'" for word in words[:6]) + (", ..." if len(words) > 6 else "")
