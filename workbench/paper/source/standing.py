"""What the text of a source lets be decided of each displayed formula: that it is true, that it is false, neither."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from workbench.paper.source.calling import recalled
from workbench.paper.source.conventions import of_another, shows_rate
from workbench.paper.source.elsewhere import any_numbers, denoted_in_part, drops, nouns_of_displays, said_elsewhere
from workbench.paper.source.forms import NOUNS
from workbench.paper.source.given import RATE, Gift, given_twice, given_within
from workbench.paper.source.leading import as_led_to, near, points
from workbench.paper.source.letters import letters_said, says_sign, signed_by_words
from workbench.paper.source.narrowing import background, restricts
from workbench.paper.source.passages import Passages, Sentence
from workbench.paper.source.reading import EVERYTHING, Reading, heading_unknown, printed, read_sentence
from workbench.paper.source.shown import Shown, Standing
from workbench.paper.source.understood import is_marked

LOCAL = ("theorem", "lemma", "proposition", "corollary", "remark", "example", "proof", "note", "claim", "property",
         "fact", "problem")
BEHIND = 2  # paragraphs behind a statement that may go on with what it supposes
ASIDE = {"remark", "note", "definition", "assumption"}  # environments that may speak of what stands around them
# Nouns and adjectives by which a letter that had a sign is said to be something else.
OTHERWISE = {"real", "number", "numbers", "scalar", "scalars", "function", "functions", "variable", "variables",
             "signal", "signals", "timevarying", "state", "input", "disturbance", "output", "vector", "matrix"}
VARYING = {"function", "functions", "variable", "variables", "signal", "signals", "timevarying", "time"}
# Words of an assumption's title beside those that are understood.
TITLES = {"matching", "condition", "conditions", "persistence", "excitation", "growth", "smoothness", "sector",
          "existence", "controllability", "observability", "detectability", "stabilizability", "regularity",
          "minimum-phase"}
ALL = ("all", "every", "each", "any", "throughout", "everywhere", "always", "both", "paper", "none", "no", "never")


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
    gifts: tuple[Gift, ...] = field(init=False)
    spoken_of: list[tuple[int, frozenset[str], frozenset[str]]] = field(init=False)

    def __post_init__(self) -> None:
        given = frozenset(letter for shown in self.formulas.values() for letter in shown.gives) | {
            letter for one in self.passages.sentences for letter, _ in given_within(one.words)}
        giving = {number: [*shown.gives] for number, shown in self.formulas.items() if shown.gives}
        self.readings = [read_sentence(one, self.body, self._assumes(one), given, giving)
                         for one in self.passages.sentences]
        self.readings = as_led_to(self.passages.sentences, self.readings, giving)
        self.shown = {number: at for at, one in enumerate(self.readings) for number in one.shown}
        self.gifts = (*self._gifts(),)
        self.spoken_of = nouns_of_displays(self.passages.sentences, self.readings, {
            number: [*shown.gives] for number, shown in self.formulas.items()})

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

    def kept(self, labels: Collection[str], number: str) -> bool:
        """Whether no sentence that is not understood may take back an assumption."""
        return not any(said.unknown and drops(sentence, labels, number) for sentence, said in
                       zip(self.passages.sentences, self.readings, strict=True))

    def _titled(self, sentence: Sentence) -> bool:
        """Whether an environment in which a sentence stands has a title that is not understood."""
        return any({*heading_unknown(self.passages.titles[scope], True)} - TITLES for scope in sentence.place.scopes)

    def standing(self, display: int, letters: Collection[str], names: Collection[str],
                 nouns: Mapping[str, Mapping[str, int]], facts: Mapping[str, str],
                 called: Mapping[str, Collection[str]]) -> Standing:
        """What may be decided of a display.

        letters: its own and those that they are made of; names: its labels and number; nouns: the letters that the text
        calls by a noun, and from which sentence on; facts: what the whole text says of a letter; called: the letters
        that the rows of a label or number give.
        """
        at = self.shown[display]
        sentence, reading = self.passages.sentences[at], self.readings[at]
        doubts: list[str] = []
        contested: dict[str, str] = {}  # each letter with the sentence that says something of it
        signed: set[str] = set()
        for before, (other, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            beside = near(other, sentence)
            aside = other.aside or (said.unknown and {self._what(name) for name in self._names(other)} <= ASIDE)
            untold = self._assumes(other) and self._titled(other)
            behind = said.unknown and 0 < other.place.paragraphs[0] - sentence.place.paragraphs[-1] <= BEHIND
            if behind and not said.letters and restricts([word.text for word in other.words], ()):
                doubts.append(self._told(before))
            if not (before < at or beside) or not (aside or untold or self._holds_at(other, sentence)):
                continue
            words = {word.text for word in other.words if word.kind == "word"}
            hidden = frozenset(letter for one in said.shown if said.unknown for letter in self.formulas[one].letters)
            spoken = said.letters | hidden | {letter for word in words for letter, first in nouns.get(word, {}).items()
                                              if first <= before}
            if said.unknown:
                contested = dict.fromkeys(spoken, self._told(before)) | contested
                section = other.place.headings[:1] == sentence.place.headings[:1]
                heading = [word.text for one in other.place.headings for word in self.passages.headings[one]]
                heading += ["abstract"] if other.words[0].start < self.body.find(r"\end{abstract}") else []
                everywhere = words & {*ALL} and not background(heading)
                if spoken & {*letters} or everywhere or beside or (not said.letters and (
                        section or restricts([*words], heading))):
                    doubts.append(self._told(before))
            differs = self._differs(said, facts) if self.local(other) else set()
            contested = dict.fromkeys(differs, self._told(before)) | contested
            supposed = self._supposed(said, display, self._assumes(other))
            supposed |= said.letters if untold else set()
            signed |= {letter for fact in said.facts for letter in signed_by_words(fact)}
            if (said.restricted | supposed | differs) & {*letters} or EVERYTHING in said.restricted:
                doubts.append(self._told(before))
        contested = dict.fromkeys(self._anew(at), "") | contested
        if display in reading.tied:
            doubts.append(self._told(at))
        own = {letter: told for letter, told in contested.items() if letter in letters}
        return Standing(reading.shown[display], tuple(dict.fromkeys(self._unread(at))),
                        tuple(dict.fromkeys(self._named(names))), tuple(dict.fromkeys(doubts)),
                        own, frozenset(signed & {*letters}), display in reading.tied,
                        frozenset(letters), tuple(self._elsewhere(display, letters, called)))

    def _elsewhere(self, display: int, letters: Collection[str],
                   called: Mapping[str, Collection[str]]) -> Iterator[str]:
        """The sentences by which a display may mean something else."""
        sentence = self.passages.sentences[self.shown[display]]
        moved = [self.passages.sentences[gift.at].place.headings for gift in self.gifts if gift.form != "inline"
                 and gift.letter.startswith(RATE) and gift.letter.removeprefix(RATE)[:-1] in letters]
        for one in sentence.place.headings if moved and shows_rate(self.formulas[display].printed) else ():
            if one not in moved[0] and of_another([word.text for word in self.passages.headings[one]]):
                yield f"the heading '{' '.join(word.text for word in self.passages.headings[one])}'"
        values = " ".join(gift.value for gift in self.gifts if gift.letter in letters)
        for place in said_elsewhere(self.passages.sentences, self.readings, self.gifts, self.shown[display], letters,
                                    f"{self.formulas[display].printed} {values}", called, self.spoken_of):
            other = self.passages.sentences[place]
            if other.aside or not self.local(other) or self._holds_at(other, sentence):
                yield self._told(place)

    def _supposed(self, said: Reading, display: int, assuming: bool) -> set[str]:
        """The letters of the other displays of a sentence that it supposes, or gives though they define nothing; of an
        assumption those that hold for some values, too."""
        others = [one for one, form in said.shown.items() if one != display and not self.formulas[one].gives
                  and (form in ("defined", "supposed", "given") or (assuming and one in said.tied))]
        return {letter for one in others for letter in self.formulas[one].letters}

    def _anew(self, at: int) -> set[str]:
        """The letters that the text gives two different values, whatever its words say: within the text anywhere, in
        displays by the end of a sentence's section; those that got a sign, or were constant, and then another kind."""
        sentence = self.passages.sentences[at]
        signed: set[str] = set()
        fixed: set[str] = set()
        anew = set()
        for other, said in zip(self.passages.sentences[:at + 1], self.readings, strict=False):
            if not self.local(other) or self._holds_at(other, sentence):
                anew |= signed & {*any_numbers(other.words)}
                anew |= {*denoted_in_part(other.words)}
            for fact in said.facts if not self.local(other) else ():
                letters = letters_said(fact)
                anew |= letters & fixed if VARYING & {*fact.replace("-", "").split()} else set()
                if "constant" in fact:
                    fixed |= letters
                if says_sign(fact):
                    signed |= letters
                elif OTHERWISE & {*fact.replace("-", "").split()}:
                    anew |= letters & signed
        return anew | recalled(self.passages.sentences, self.gifts, at) | self._foreign(sentence) | given_twice(
            one for one in self.gifts if self._counts(one, at, sentence))

    def _foreign(self, sentence: Sentence) -> set[str]:
        """The letters that displays of other proofs alone give, and, where a sentence stands in a statement or proof,
        those of other statements."""
        shown = [(one.letter, self.passages.sentences[one.at]) for one in self.gifts if one.form != "inline"]
        local = self.local(sentence)
        own = {letter for letter, other in shown if self._holds_at(other, sentence) or not (
            self.local(other) if local else self._proves(other))}
        return {letter for letter, _ in shown} - own

    def _proves(self, sentence: Sentence) -> bool:
        return any(name.removesuffix("*") not in self.whats for name in self._names(sentence))

    def _counts(self, gift: Gift, at: int, sentence: Sentence) -> bool:
        """Whether what a sentence gives may be what is meant where another stands."""
        other = self.passages.sentences[gift.at]
        if gift.form == "inline":
            return not self.local(other) or self._holds_at(other, sentence)
        return gift.at <= at or other.place.headings[:1] == sentence.place.headings[:1]

    def _gifts(self) -> Iterator[Gift]:
        """What displays and the text give letters, in order."""
        for at, (sentence, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            for letter, value in given_within(sentence.words):
                yield Gift(at, letter, value, "inline")
            for number, form in said.shown.items():
                if form in ("given", "defined", "bare"):
                    for letter, value in self.formulas[number].gives.items():
                        yield Gift(at, letter, value, form)

    def _differs(self, said: Reading, facts: Mapping[str, str]) -> set[str]:
        """The letters of which a sentence says something that the whole text does not."""
        told = {letter for letter in said.letters if facts.get(letter) not in said.facts} if said.facts else set()
        return told | said.restricted

    def _holds_at(self, other: Sentence, sentence: Sentence) -> bool:
        """Whether what a sentence says may hold where another stands: in its environment; of a statement, in proofs and
        in what is said directly behind it."""
        scopes, own = other.place.scopes, sentence.place.scopes
        stated = not self._proves(other)
        proof = self._proves(sentence)
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
        given = [letter for one in self.readings[at].shown for letter in self.formulas[one].gives]
        marked = not given or any(map(is_marked, given))
        for heading in sentence.place.headings:
            unknown = heading_unknown(self.passages.headings[heading], marked)
            if unknown:
                yield f"heading with {_quoted(unknown)}"
        for scope in sentence.place.scopes:
            name = self.passages.scopes[scope]
            if name.startswith("?"):
                yield f"environment {name[1:]!r}"
            elif unknown := heading_unknown(self.passages.titles[scope], marked):
                yield f"title with {_quoted(unknown)}"
        if any(r"\intertext" in self.formulas[one].printed for one in self.readings[at].shown):
            yield "words between its lines"
        for other, (one, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            if said.unknown and (other == at or (near(one, sentence) and (abs(other - at) == 1 or points(one)))):
                yield self._told(other)

    def _told(self, at: int) -> str:
        unknown = self.readings[at].unknown
        sentence = printed(self.passages.sentences[at], self.body)
        return f"{_quoted(unknown)} in '{sentence}'" if unknown else f"'{sentence}'"

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


def _quoted(words: Sequence[str]) -> str:
    return ", ".join(f"'{word}'" for word in words[:6]) + (", ..." if len(words) > 6 else "")
