"""Which rows of a source are decided, and which verdicts on them count."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise

from workbench.paper.source.conventions import shows_rate
from workbench.paper.source.document import Source
from workbench.paper.source.letters import defined_in_text, said_of, values_and_rates
from workbench.paper.source.narrowing import words_of
from workbench.paper.source.passages import Sentence, Word
from workbench.paper.source.row import Row
from workbench.paper.source.shown import Standing
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.read import read_line
from workbench.proof.latex.rows import LetterEntry, RowEntry, text_of
from workbench.proof.latex.sides import letter_latex, letters_of_text, moving_sides, rated_in, sides_of
from workbench.proof.latex.tree import Letter, Number, Product, Quotient, Terms, parts_of

_TYPED = re.compile(r"[A-Z]?[.-]?\d+(?:\.\d+)*[a-z]?")  # a number by which a text refers without a label
# What a number is of, where one says it.
_KINDS = words_of("""
    assumption assumptions lemma lemmas theorem theorems proposition propositions corollary corollaries definition
    definitions table tables condition conditions property properties hypothesis hypotheses figure figures case cases
""")
_STEM = 5  # letters that such a word shares with its plural


def standings(made: list[tuple[Row, RowEntry]], found: Source, facts: str) -> dict[str, Standing]:
    """What may be decided of each row of a displayed formula."""
    lines = [text_of(entry) for _, entry in made if entry.role != "words"]
    made_of = {letter: letters_of_text(right) for line in (*lines, *defined_in_text(facts).values())
               for letter, right in values_and_rates(line)[0].items()}

    moved_by: dict[str, set[str]] = {}
    for line in lines:
        for letter, right in values_and_rates(line)[1].items():
            moved_by.setdefault(letter, set()).update(letters_of_text(right))

    def within(text: str) -> set[str]:
        """The letters of a line with those that they are made of, and, where it has a rate, those that move them."""
        letters, known, rates = letters_of_text(text), set[str](), shows_rate(text)
        while letters - known:
            known |= letters
            letters = known.union(*(made_of.get(one, set()) for one in known),
                                  *(moved_by.get(one, set()) for one in known if rates))
        return known

    nouns, said = found.said.nouns(), said_of(facts)

    def names(row: Row) -> set[str]:
        """What the text may call a row by: its labels and number, and those of the statement in which it stands."""
        around = (label for one in found.rows if one.id == row.within for label in one.labels)
        return {*row.labels, row.number, row.within, *around} - {""}

    called: dict[str, set[str]] = {}
    for row, entry in made:
        given = {letter for part in values_and_rates(text_of(entry)) for letter in part}
        for name in {*row.labels, row.number} - {""} if given else ():
            called.setdefault(name, set()).update(given)
    known = {(name, row.what.lower()) for row in found.rows for name in (row.number, *row.labels) if name}
    judged = {}
    for row, entry in made:
        if row.display >= 0:
            standing = found.said.standing(row.display, within(text_of(entry)), names(row), nouns, said, called)
            sentence = found.said.passages.sentences[found.said.shown[row.display]]
            strange = [f"what it refers to, {one}, which is not in the text" for one in unresolved(sentence, known)]
            judged[entry.id] = replace(standing, doubts=(*standing.doubts, *strange))
    return judged


def unresolved(sentence: Sentence, known: Collection[tuple[str, str]]) -> Iterator[str]:
    """What a sentence refers to that stands nowhere in the text, as `Table 1`; known: numbers and labels of rows, each
    with what it is a number of."""
    names = {name for name, _ in known}
    for before, word in pairwise((Word("mark", "", 0, 0), *sentence.words)):
        for name in word.text.split(",") if word.kind == "reference" else ():
            plain = name.strip().strip("()")
            if _TYPED.fullmatch(plain) is None:
                continue  # a label, which LaTeX itself looks up
            if plain not in names or (before.text in _KINDS and not any(
                    one == plain and before.text.startswith(kind[:_STEM]) for one, kind in known)):
                yield f"{before.text} {name.strip()}".strip()


def as_read(row: RowEntry, standing: Standing | None) -> RowEntry:
    """A row as what its sentence makes of it: what is not claimed is not decided, what is not understood not taken."""
    if standing is None or row.role == "words":
        return row
    unread = (*standing.unread, *(standing.named if row.role == "claim" else ()))
    if unread:
        return row.model_copy(update={"role": "words", "unread": "; ".join(dict.fromkeys(unread))})
    if row.role == "claim" and standing.form in ("defined", "supposed"):
        return row.model_copy(update={"role": "words", "unread": "its sentence supposes it"})
    if row.role == "assumption" and standing.tied:
        return row.model_copy(update={"role": "words", "unread": "it is assumed of some values alone"})
    return row


def given_otherwise(rows: list[RowEntry], verdicts: Mapping[str, str],
                    standing: Mapping[str, Standing]) -> frozenset[str]:
    """The letters of which a sentence gives another value or rate than the one that is taken, as of a second model."""
    again = [(row, standing[row.id].form) for row in rows if row.role == "claim" and row.id in standing
             and verdicts.get(row.id) not in ("proved", "assumed")]
    refuted = [(row, form) for row, form in again if verdicts.get(row.id) == "refuted"]
    given = [part for row, form in refuted for number, part in enumerate(values_and_rates(text_of(row)))
             if form == "given" or (form in ("bare", "stated") and number == 0)]
    moved = [rated_in(text_of(row)) for row, form in again if form == "given"]
    return frozenset(letter for part in (*given, *moved) for letter in part)


def left_to_the_author(row: RowEntry, verdict: str, standing: Standing | None, rows: list[RowEntry],
                        letters: Mapping[str, LetterEntry], otherwise: frozenset[str] = frozenset(),
                        asked: frozenset[str] = frozenset()) -> str:
    """Why the verdict on a row does not count; empty where it does. otherwise: letters that are given twice; asked:
    constants of which another row may ask something."""
    if standing is None or verdict == "undecided":
        return ""
    if verdict != "proved":
        given = standing.form == "given"
        unsigned = sorted(one for one in standing.signed if one in letters and letters[one].kind in ("", "real"))
        own = letters_of_text(text_of(row))
        gains = bool(own) and all(one in letters and letters[one].role == "constant" for one in own)
        valued = {letter for one in rows if one.role == "definition" for letter in dict(sides_of(text_of(one)))}
        gains = gains or (not own & valued and relates_letters_alone(text_of(row)))
        gains = gains or bool((asked | asked_of(row, letters)) & standing.letters)
        natural = [standing.natural[one] for one in own & standing.natural.keys()
                   if one in letters and letters[one].kind in ("", "real")]
        untaken = sorted(standing.given & letters.keys())
        again = [f"what is said of {one}: {told or 'it is given twice'}" for one, told in standing.contested.items()]
        doubts = standing.doubts or natural or again or (
            (f"what is given for {', '.join(untaken)}",) if untaken else ()) or (
            ("what its sentence gives is no definition",) if given else ()) or (
            (f"what is said of the sign of {', '.join(unsigned)}",) if unsigned else ()) or (
            ("a relation of letters alone, which may be asked of them",) if gains else ()) or standing.otherwise
        return f"false by itself; what may restrict it is for you to read: {'; '.join(doubts)}" if doubts else ""
    if standing.otherwise:
        return f"what is said elsewhere may change what it means: {'; '.join(standing.otherwise)}"
    rates = shows_rate(text_of(row))
    taken = {letter for one in rows if one.role in ("definition", "dynamics")
             for letter in (*dict(sides_of(text_of(one))), *(dict(moving_sides(text_of(one))) if rates else ()))}
    taken |= {letter for one in rows if one.role == "assumption" for letter in letters_of_text(text_of(one))}
    known = {letter for letter, entry in letters.items() if entry.kind in ("positive", "nonnegative")
             or (rates and entry.role == "constant")} | taken
    used = sorted(({*standing.contested} | (otherwise & standing.letters)) & known)
    told = "; ".join(dict.fromkeys(standing.contested.get(one) or "it is given twice" for one in used))
    return f"what is not understood may say otherwise of {', '.join(used)}: {told}" if used else ""


def asked_of(row: RowEntry, letters: Mapping[str, LetterEntry]) -> frozenset[str]:
    """The constants of which a line may ask something, in a relation of its own: `V' <= -x^2, k > 1`."""
    try:
        chains = read_line(text_of(row)).chains
    except LatexError:
        return frozenset()
    own = [{letter_latex(part) for side in chain.sides for part in parts_of(side) if isinstance(part, Letter)}
           for chain in chains if chain.signs]
    return frozenset(letter for found in own for letter in found
                     if all(one in letters and letters[one].role == "constant" for one in found))


def relates_letters_alone(text: str) -> bool:
    """Whether a line relates letters, their sums and multiples alone, as a condition on them does, `x = y`."""
    try:
        sides = [side for chain in read_line(text).chains for side in chain.sides]
    except LatexError:
        return False
    parts = [part for side in sides for part in parts_of(side)]
    return all(isinstance(part, (Letter, Number, Terms)) or (
        isinstance(part, (Product, Quotient)) and len([one for one in parts_of(part) if isinstance(one, Letter)]) < 2)
        for part in parts) and not any("dot" in accent for part in parts if isinstance(part, Letter)
                                       for accent in part.accents)


def left_out(why: str) -> str:
    """What is told of a row that is left to the author."""
    return f"left to you: {why}; where it is claimed, set its role to 'claim'"


def doubted(row: RowEntry, verdicts: Mapping[str, str], standing: Mapping[str, Standing]) -> str | None:
    """What may restrict a row that waits for its letters, for who fills them in."""
    waits = row.id in standing and verdicts.get(row.id, "undecided") == "undecided"
    return "; ".join(standing[row.id].doubts) or None if waits else None
