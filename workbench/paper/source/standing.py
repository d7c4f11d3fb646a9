"""What the text of a source lets be decided of each displayed formula: that it is true, that it is false, neither."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

from workbench.paper.source import moving, things
from workbench.paper.source.calling import recalled
from workbench.paper.source.conventions import of_another, shows_rate
from workbench.paper.source.elsewhere import any_numbers, denoted_in_part, said_elsewhere
from workbench.paper.source.given import RATE, Gift, given_twice
from workbench.paper.source.leading import near, points
from workbench.paper.source.letters import letters_said, says_sign, signed_by_words
from workbench.paper.source.naming import signed_by_nature, two_names
from workbench.paper.source.narrowing import background, restricts, words_of
from workbench.paper.source.passages import Sentence
from workbench.paper.source.reading import DEFINE, EVERYTHING, GIVING, Reading, heading_unknown
from workbench.paper.source.said import BEHIND, SaidText, quoted
from workbench.paper.source.shown import Standing
from workbench.paper.source.telling import of_a_motion
from workbench.paper.source.understood import along_another, is_marked
from workbench.proof.latex.sides import letters_of_text, valued_in

ASIDE = {"remark", "note", "definition", "assumption"}  # environments that may speak of what stands around them
# Nouns and adjectives by which a letter that had a sign is said to be something else.
OTHERWISE = {"real", "number", "numbers", "scalar", "scalars", "function", "functions", "variable", "variables",
             "signal", "signals", "timevarying", "state", "input", "disturbance", "output", "vector", "matrix"}
VARYING = {"function", "functions", "variable", "variables", "signal", "signals", "timevarying", "time"}
_FOLLOWS = words_of("therefore hence thus consequently so")
# A sentence with one of these says by itself what it gives, whatever stands over it.
_NAMED = moving.PLANTS | things.LAWS | things.FUNCTIONS
ALL = ("all", "every", "each", "any", "throughout", "everywhere", "always", "both", "paper", "none", "no", "never")


class Text(SaidText):
    """The sentences of a source, of which each of its displays is judged."""

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
        limits = self.limits()
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
            if said.beyond and not self._background(other):
                doubts.append(self._told(before))
            if said.unknown:
                contested = dict.fromkeys(spoken, self._told(before)) | contested
                section = other.place.headings[:1] == sentence.place.headings[:1]
                heading = self._heading(other)
                everywhere = words & {*ALL} and not background(heading)
                if spoken & {*letters} or everywhere or beside or (not said.letters and (
                        section or restricts([*words], heading))):
                    doubts.append(self._told(before))
            follows = before > at and other.words[0].text in _FOLLOWS  # what follows from it restricts it not
            restricted = frozenset[str]() if follows else said.restricted
            differs = (self._differs(said, facts) if self.local(other) else set()) - (said.restricted - restricted)
            contested = dict.fromkeys(differs, self._told(before)) | contested
            supposed = self._supposed(said, display, self._assumes(other)) | self._in_proof(other, said, sentence)
            supposed |= said.letters if untold else set()
            supposed |= {letter for one in said.limits if one not in limits for letter in letters_of_text(one)}
            signed |= {letter for fact in said.facts for letter in signed_by_words(fact)}
            if (restricted | supposed | differs) & {*letters} or EVERYTHING in restricted:
                doubts.append(self._told(before))
        doubts += [self._told(place) for place in (*self._valued(letters), *self._followed(at))]
        last = self.readings[at - 1] if at else reading
        if not last.shown and not last.facts and of_a_motion(self.passages.sentences[at - 1].words):
            doubts.append(self._told(at - 1))  # the loop is stable, hence some number is negative
        named = {letter: self.called.get(letter, []) for letter in letters}
        natural = {letter: self._told(place) for letter, one in named.items() for place, name in one
                   if signed_by_nature(name)}
        given = frozenset(gift.letter for gift in self.gifts) & {*letters}
        contested |= {letter: self._told(named[letter][-1][0]) for letter in given
                      if two_names([name for _, name in named[letter]])}
        contested |= {letter: self._told(place) for letter, place in self.renamed.items() if letter in letters}
        contested = dict.fromkeys(self._anew(at), "") | contested
        if display in reading.tied:
            doubts.append(self._told(at))
        own = {letter: told for letter, told in contested.items() if letter in letters}
        return Standing(reading.shown[display], tuple(dict.fromkeys(self._unread(at))),
                        tuple(dict.fromkeys(self._named(names))), tuple(dict.fromkeys(doubts)),
                        own, frozenset(signed & {*letters}), display in reading.tied,
                        frozenset(letters), tuple(self._elsewhere(display, letters, called)), given, natural)

    def _followed(self, at: int) -> Iterator[int]:
        """The sentence before one that begins with `hence` or `then`, and before those that it follows from in turn,
        where what that claims holds for some values alone."""
        while at and self.passages.sentences[at].words[0].text in _FOLLOWS | {"then"}:
            at -= 1
            if self.readings[at].tied:
                yield at

    def _elsewhere(self, display: int, letters: Collection[str],
                   called: Mapping[str, Collection[str]]) -> Iterator[str]:
        """The sentences by which a display may mean something else."""
        sentence = self.passages.sentences[self.shown[display]]
        givers = [self.passages.sentences[gift.at] for gift in self.gifts if gift.form != "inline"
                  and gift.letter.startswith(RATE) and gift.letter.removeprefix(RATE)[:-1] in letters]
        said = [word.text for word in sentence.words]
        if any(along_another(said, [word.text for word in giver.words]) for giver in givers):
            yield self._told(self.shown[display])
        moved = [giver.place.headings for giver in givers]
        for one in sentence.place.headings if moved and shows_rate(self.formulas[display].printed) else ():
            if one not in moved[0] and of_another([word.text for word in self.passages.headings[one]]):
                yield f"the heading '{' '.join(word.text for word in self.passages.headings[one])}'"
        values = " ".join(gift.value for gift in self.gifts if gift.letter in letters)
        for place in said_elsewhere(self.passages.sentences, self.readings, self.gifts, self.shown[display], letters,
                                    f"{self.formulas[display].printed} {values}", called, self.spoken_of):
            other = self.passages.sentences[place]
            if self.readings[place].beyond and self._background(other):
                continue
            if other.aside or not self.local(other) or self._holds_at(other, sentence):
                yield self._told(place)

    def _supposed(self, said: Reading, display: int, assuming: bool) -> set[str]:
        """The letters of the other displays of a sentence that it supposes, or gives though they define nothing; of an
        assumption those that hold for some values, too."""
        others = [one for one, form in said.shown.items() if one != display and not self.formulas[one].gives
                  and (form in ("defined", "supposed", "given") or (assuming and one in said.tied))]
        return {letter for one in others for letter in self.formulas[one].letters}

    def _in_proof(self, other: Sentence, said: Reading, sentence: Sentence) -> frozenset[str]:
        """The letters of what a statement supposes for what it shows, in a proof."""
        return said.letters if said.tied and self._proves(sentence) and not self._proves(other) else frozenset()

    def _anew(self, at: int) -> set[str]:
        """The letters that the text gives two different values, whatever its words say: within the text anywhere, in
        displays by the end of a sentence's section; those that got a sign, or were constant, and then another kind."""
        sentence = self.passages.sentences[at]
        signed: set[str] = set()
        fixed: set[str] = set()
        anew: set[str] = set()
        still: set[str] = set()  # constants that nothing else is said of
        for other, said in zip(self.passages.sentences[:at + 1], self.readings, strict=False):
            if not self.local(other) or self._holds_at(other, sentence):
                anew |= signed & {*any_numbers(other.words)}
                anew |= {*denoted_in_part(other.words)}
            for fact in said.facts if not self.local(other) else ():
                letters = letters_said(fact)
                anew |= letters & fixed if VARYING & {*fact.replace("-", "").split()} else set()
                if "constant" in fact:
                    fixed |= letters
                    still |= letters if r"\in" not in fact else set()
                if says_sign(fact):
                    signed |= letters
                elif OTHERWISE & {*fact.replace("-", "").split()}:
                    anew |= letters & signed
        anew |= {gift.letter for gift in self.gifts if gift.letter in still and letters_of_text(gift.value)
                 and not any("constant" in fact for fact in self.readings[gift.at].facts)}
        return anew | recalled(self.passages.sentences, self.gifts, at) | self._foreign(sentence) | given_twice(
            one for one in self.gifts if self._counts(one, at, sentence))

    def _valued(self, letters: Collection[str]) -> list[int]:
        """The sentences that claim a value of a letter which nothing gives: it may be what defines the letter."""
        given = {gift.letter for gift in self.gifts}
        return [at for at, said in enumerate(self.readings) for number, form in said.shown.items()
                if form not in GIVING and ({*self.formulas[number].gives} & {*letters}) - given]

    def _foreign(self, sentence: Sentence) -> set[str]:
        """The letters that displays of other proofs alone give, and, where a sentence stands in a statement or proof,
        those of other statements."""
        shown = [(one.letter, self.passages.sentences[one.at]) for one in self.gifts if one.form != "inline" or (
            self._proves(self.passages.sentences[one.at]) and self._defines(one))]
        local = self.local(sentence)
        own = {letter for letter, other in shown if self._holds_at(other, sentence) or not (
            self.local(other) if local else self._proves(other))}
        return {letter for letter, _ in shown} - own

    def _counts(self, gift: Gift, at: int, sentence: Sentence) -> bool:
        """Whether what a sentence gives may be what is meant where another stands."""
        other = self.passages.sentences[gift.at]
        if gift.form == "inline":
            return not self.local(other) or self._holds_at(other, sentence)
        return gift.at <= at or other.place.headings[:1] == sentence.place.headings[:1]

    def _differs(self, said: Reading, facts: Mapping[str, str]) -> set[str]:
        """The letters of which a sentence says something that the whole text does not."""
        letters = said.letters if any(not fact.startswith(DEFINE) for fact in said.facts) else {
            letter for fact in said.facts for letter in valued_in(fact.removeprefix(DEFINE).strip("$"))}
        told = {letter for letter in letters if facts.get(letter) not in said.facts} if said.facts else set()
        return told | said.restricted

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
        moved = [letter for letter in given if letter.startswith(RATE)]
        claimed = {*self.readings[at].shown.values()}.isdisjoint(GIVING)
        marked = claimed or not moved or any(map(is_marked, given)) or bool(
            _NAMED & {word.text for word in sentence.words if word.kind == "word"})
        for heading in sentence.place.headings:
            unknown = heading_unknown(self.passages.headings[heading], marked)
            if unknown:
                yield f"heading with {quoted(unknown)}"
        for scope in sentence.place.scopes:
            name = self.passages.scopes[scope]
            if name.startswith("?"):
                yield f"environment {name[1:]!r}"
            elif unknown := heading_unknown(self.passages.titles[scope], marked):
                yield f"title with {quoted(unknown)}"
        if any(r"\intertext" in self.formulas[one].printed for one in self.readings[at].shown):
            yield "words between its lines"
        for other, (one, said) in enumerate(zip(self.passages.sentences, self.readings, strict=True)):
            if said.unknown and (other == at or (near(one, sentence) and (abs(other - at) == 1 or points(one)))):
                yield self._told(other)
