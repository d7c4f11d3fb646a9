"""The running text of a source as sentences: their words, and the paragraph, section and environment around them."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

from workbench.paper.source.macros import group, optional
from workbench.paper.source.pieces import ENDS, LEVELS, PIECE, SKIPPED, TABLES, WHOLE, WRITTEN_OUT
from workbench.paper.source.vocabulary import LAYOUT


@dataclass(frozen=True)
class Word:
    """A word of a sentence: its kind (word, mark, math, display, reference, table, odd), what is printed, and where."""

    kind: str
    text: str
    start: int
    end: int


@dataclass(frozen=True)
class Place:
    """Where a sentence stands: its paragraphs, headings and environments, each by number."""

    paragraphs: tuple[int, ...]
    headings: tuple[int, ...]
    scopes: tuple[int, ...]


@dataclass(frozen=True)
class Sentence:
    """A sentence: its words and its place; aside for what stands in a footnote or in brackets."""

    words: tuple[Word, ...]
    place: Place
    aside: bool = False


@dataclass(frozen=True)
class Display:
    """A displayed formula: from where to where in the body, and whether a full stop ends it."""

    start: int
    end: int
    ends: bool


@dataclass
class Passages:
    """All sentences in order, what each heading says, the names of the environments and their titles."""

    sentences: list[Sentence] = field(default_factory=list)
    headings: list[tuple[Word, ...]] = field(default_factory=list)
    scopes: list[str] = field(default_factory=list)
    titles: list[tuple[Word, ...]] = field(default_factory=list)


def printed(sentence: Sentence, body: str) -> str:
    """A sentence as it is printed, for telling which one it is; its displays left out."""
    places = dict.fromkeys((word.start, word.end) for word in sentence.words if word.kind != "display")
    pieces = (body[start:end] for start, end in places)
    text = " ".join(" ".join(pieces).split())
    return text if len(text) <= 80 else text[:77] + "..."


def passages(body: str, displays: Sequence[Display], named: Collection[str]) -> Passages:
    """The sentences of a body whose displayed formulas are known.

    named: the environments of statements and proofs. Others, but for those that only lay out, are named by `?` before
    their name, as is one that begins within a sentence. Raises SourceError for what is not closed.
    """
    reader = _Reader(body, displays, named)
    reader.read(0, len(body))
    reader.flush()
    return reader.found


class _Reader:
    def __init__(self, body: str, displays: Sequence[Display], named: Collection[str]) -> None:
        self.body, self.displays, self.named = body, sorted(displays, key=lambda one: one.start), named
        self.order = sorted(range(len(displays)), key=lambda one: displays[one].start)
        self.found = Passages()
        self.words: list[Word] = []
        self.paragraphs = 0
        self.place = Place((0,), (), ())
        self.levels: list[int] = []
        self.next = 0  # the display to come
        self.aside = False  # whether a footnote or brackets are being read
        self.behind = self.broken = False  # whether a display, or a blank line, stands directly before

    def flush(self) -> None:
        """End the sentence."""
        if self.words:
            self.found.sentences.append(Sentence(tuple(self.words), self.place, self.aside))
            self.words = []
            self.place = replace(self.place, paragraphs=self.place.paragraphs[-1:])

    def begin_paragraph(self) -> None:
        self.flush()
        self.paragraphs += 1
        self.place = replace(self.place, paragraphs=(self.paragraphs,))

    def read(self, at: int, end: int) -> None:
        """The text from a place to another."""
        while at < end:
            if self.next < len(self.displays) and at >= self.displays[self.next].start:
                at = self.display()
                continue
            until = min(end, self.displays[self.next].start) if self.next < len(self.displays) else end
            found = PIECE.search(self.body, at, until)
            if found is None:
                at = until
                continue
            at = self.token(found, end)

    def display(self) -> int:
        shown = self.displays[self.next]
        self.broken = False  # a blank line before a display parts nothing
        self.words.append(Word("display", str(self.order[self.next]), shown.start, shown.end))
        if shown.ends:
            self.flush()
        self.next += 1
        self.behind = True
        return shown.end

    def token(self, found: re.Match[str], end: int) -> int:
        kind = WHOLE.get(found.lastgroup or "odd", found.lastgroup or "odd")
        handler = getattr(self, f"_{kind}", None)
        if kind in ("blank", "layout", "gone", "listed"):
            return int(handler(found, end)) if handler else found.end()
        if kind not in ("begin", "end", "heading", "item", "aside", "open"):
            self.break_paragraph()
            if self.behind and self.words and kind == "word" and found.group()[:1].isupper():
                self.flush()  # a display without its full stop, and a new sentence
            self.behind = False
        return int(handler(found, end)) if handler else self.put(kind, found)

    def break_paragraph(self) -> None:
        """Begin a new paragraph where a blank line stood before; its first sentence belongs to a display before it."""
        if self.broken:
            before = self.place.paragraphs[-1:]
            self.begin_paragraph()
            if self.behind:
                self.place = replace(self.place, paragraphs=(*before, self.paragraphs))
            self.broken = False

    def put(self, kind: str, found: re.Match[str]) -> int:
        self.words.append(Word(kind, found.group(), found.start(), found.end()))
        return found.end()

    def _blank(self, found: re.Match[str], end: int) -> int:
        self.broken = True
        return found.end()

    def _gone(self, found: re.Match[str], end: int) -> int:
        at = found.end()
        while True:
            behind = self.body[at:at + 1]
            if behind == "[":
                at = optional(self.body, at)[1]
            elif behind == "{":
                at = group(self.body, at)[1]
            else:
                return at

    def _heading(self, found: re.Match[str], end: int) -> int:
        self.begin_paragraph()
        self.broken = self.behind = False
        title, at = group(self.body, optional(self.body, found.end())[1])
        level = LEVELS[found["heading"]]
        while self.levels and self.levels[-1] >= level:
            self.levels.pop()
        self.found.headings.append(self.title(title))
        kept = self.place.headings[:len(self.levels)]
        self.levels.append(level)
        self.place = replace(self.place, headings=(*kept, len(self.found.headings) - 1))
        return at

    def table(self, start: int, close: int) -> None:
        """The formulas of a table, as a sentence of its own that only names them."""
        formulas = [Word("math", one["formula"].strip(" .,;"), *one.span())
                    for one in PIECE.finditer(self.body, start, close) if one["formula"]]
        if formulas:
            self.found.sentences.append(Sentence((Word("table", "", start, start), *formulas), self.place, True))

    def title(self, text: str) -> tuple[Word, ...]:
        """The words of a heading."""
        inner = _Reader(text, (), self.named)
        inner.read(0, len(text))
        inner.flush()
        return tuple(word for one in inner.found.sentences for word in one.words)

    def _begin(self, found: re.Match[str], end: int) -> int:
        name = found["begun"].strip()
        if name.removesuffix("*") in SKIPPED:
            close = self.body.find(rf"\end{{{name}}}", found.end(), end)
            close = end if close < 0 else close
            if name.removesuffix("*") in TABLES:
                self.table(found.end(), close)
            return close
        at = found.end()
        if name.removesuffix("*") in LAYOUT:
            if name in ("itemize", "enumerate", "description"):
                self.flush()
            return self._gone(found, end) if name in ("minipage", "multicols") else optional(self.body, at)[1]
        unfinished = bool(self.words) and self.words[-1].kind != "display"
        self.begin_paragraph()
        self.broken = self.behind = False
        known = name.removesuffix("*") in self.named and not unfinished
        self.found.scopes.append(name if known else f"?{name}")
        title, at = optional(self.body, at)
        self.found.titles.append(self.title(title or ""))
        self.place = replace(self.place, scopes=(*self.place.scopes, len(self.found.scopes) - 1))
        return at

    def _end(self, found: re.Match[str], end: int) -> int:
        name = found["ended"].strip()
        if name.removesuffix("*") in (*SKIPPED, *LAYOUT):
            if name in ("itemize", "enumerate", "description"):
                self.flush()
            return found.end()
        self.begin_paragraph()
        if self.place.scopes and self.found.scopes[self.place.scopes[-1]].removeprefix("?") == name:
            self.place = replace(self.place, scopes=self.place.scopes[:-1])
        return found.end()

    def _item(self, found: re.Match[str], end: int) -> int:
        self.flush()
        self.broken = False
        label = found["labelled"] or ""
        if re.search("[A-Za-z]{3}", label):  # a name, and no number: `\\item[Leader]`
            self.read(found.start("labelled"), found.end("labelled"))
        return found.end()

    def _aside(self, found: re.Match[str], end: int) -> int:
        _, close = group(self.body, found.end())
        return self.within(self.body.index("{", found.end()) + 1, close - 1, close)

    def _open(self, found: re.Match[str], end: int) -> int:
        depth, at = 1, found.end()
        while at < end and depth:
            depth += {"(": 1, ")": -1}.get(self.body[at], 0)
            at += 1
        if depth or (self.next < len(self.displays) and self.displays[self.next].start < at):
            self.break_paragraph()
            return self.put("odd", found)
        return self.within(found.end(), at - 1, at)

    def within(self, start: int, close: int, behind: int) -> int:
        """What stands in brackets or a footnote as sentences of their own."""
        self.break_paragraph()
        kept, self.words, place, aside = self.words, [], self.place, self.aside
        self.aside = True
        self.read(start, close)
        self.flush()
        self.words, self.place, self.aside = kept, place, aside
        return behind

    def _mark(self, found: re.Match[str], end: int) -> int:
        at = self.put("mark", found)
        if found.group() in ENDS and (len(self.words) > 1 or self.words[0].kind != "mark"):
            self.flush()
        return at

    def _word(self, found: re.Match[str], end: int) -> int:
        text = found.group().lower().replace("’", "'").replace("--", "-")
        self.words.append(Word("word", text, found.start(), found.end()))
        return found.end()

    def _number(self, found: re.Match[str], end: int) -> int:
        self.words.append(Word("reference", found.group(), found.start(), found.end()))
        return found.end()

    def _ref(self, found: re.Match[str], end: int) -> int:
        self.words.append(Word("reference", found["labels"] or found["bracketed"], found.start(), found.end()))
        return found.end()

    def _math(self, found: re.Match[str], end: int) -> int:
        self.words.append(Word("math", found["formula"].strip(" .,;"), found.start(), found.end()))
        return found.end()

    def _short(self, found: re.Match[str], end: int) -> int:
        text = found.group().lower().replace(" ", "")
        for word in WRITTEN_OUT.get(text, (text,)):
            kind = "mark" if word == "," else "word"
            self.words.append(Word(kind, word, found.start(), found.end()))
        return found.end()
