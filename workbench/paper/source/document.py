"""The body of a paper's LaTeX source as rows, in order and with the numbers that LaTeX would print."""

from __future__ import annotations

import re
from dataclasses import dataclass

from workbench.files.regular import LARGEST_TEXT, size_words
from workbench.paper.source.letters import values_and_rates
from workbench.paper.source.lines import (
    DISPLAYS,
    LABEL,
    TAG,
    WITHOUT_NUMBER,
    chained,
    cleaned,
    goes_on,
    lines_of,
    references,
    system_lines,
    without_displays,
    without_marks,
)
from workbench.paper.source.macros import SourceError, decided, expanded, group, optional, without_comments
from workbench.paper.source.markdown import with_latex_headings
from workbench.paper.source.passages import Display, passages
from workbench.paper.source.pieces import require_plain
from workbench.paper.source.row import Row, resolve, row_id
from workbench.paper.source.shown import Shown
from workbench.paper.source.spread import spread
from workbench.paper.source.standing import Text
from workbench.proof.latex.rows import is_assumption
from workbench.proof.latex.sides import letters_of_text

WHOLE = ("equation", "multline", "dmath", "displaymath")  # one formula, however many lines it has
UNNUMBERED = "display1"  # the id of the first formula without a number
WITH_ARGUMENT = ("alignat", "IEEEeqnarray")
SKIPPED = ("verbatim", "lstlisting", "comment", "thebibliography", "tikzpicture")
# Environments that styles define without \newtheorem in the source.
USUAL = {"theorem": "Theorem", "lemma": "Lemma", "assumption": "Assumption", "remark": "Remark",
         "definition": "Definition", "proposition": "Proposition", "corollary": "Corollary", "property": "Property",
         "example": "Example"}
PROOFS = ("proof", "IEEEproof", "pf")
_MARK = re.compile(r"\\(begin|end|section|appendix|eqref|[cC]ref|autoref|ref|label|setcounter)(?![A-Za-z])\*?"
                   r"|(?<!\\)(?:\\\[|\$\$)")
_PARENTHESIS = re.compile(r"(?<!\\)\\[()]")  # another way to type a dollar sign
_NEWTHEOREM = re.compile(r"\\newtheorem(\*?)\s*\{([^{}]*)\}\s*(?:\[([^\]]*)\])?\s*\{([^{}]*)\}\s*(?:\[([^\]]*)\])?")
_WITHIN = re.compile(r"\\numberwithin\s*\{equation\}\s*\{section\}")
_REMARKS = re.compile("remark|example|note", re.IGNORECASE)

MOST_SHOWN = LARGEST_TEXT // 2  # verdicts are added to what is shown, and the table is read again
TOO_MUCH = (f"becomes tables of more than {size_words(MOST_SHOWN)}, as where a macro writes itself many times over: "
            "leave out what is not mathematics, or give it in parts")


@dataclass
class Source:
    """What was found: rows in order, the running text, and what its sentences say."""

    rows: list[Row]
    text: str
    said: Text


def read_source(text: str) -> Source:
    """The rows of a LaTeX source; raises SourceError in one line for what is not closed or has no rows."""
    plain = _PARENTHESIS.sub("$", expanded(decided(without_comments(with_latex_headings(text)))))
    begin = plain.find(r"\begin{document}")
    preamble, body = (plain[:begin], plain[begin + 16:]) if begin >= 0 else (plain, plain)
    end = body.find(r"\end{document}")
    body = body if end < 0 else body[:end]
    require_plain(body)
    body, typed = spread(body), body
    reader = _Reader(preamble, body)
    reader.read()
    _as_typed(reader.rows, preamble, typed, body)
    resolve(reader.rows, reader.group_labels)
    if not reader.rows:
        raise SourceError("the source has no displayed formula, assumption, theorem or remark: give the paper's own "
                          "file, with what it inputs put in")
    whats = {name: title for name, (title, _, _) in reader.names.items()}
    text_of = Text(body, passages(body, reader.displays, (*whats, *PROOFS)), whats,
                   [name for name, what in whats.items() if is_assumption(what)], _formulas(reader))
    return Source(reader.rows, body, text_of)


def _as_typed(rows: list[Row], preamble: str, typed: str, read: str) -> None:
    """Give formulas that are read otherwise than they are typed their printed form back."""
    if typed == read:
        return
    reader = _Reader(preamble, typed)
    reader.read()
    for row, own in zip(rows, reader.rows, strict=True):
        if row.what == "Equation" and row.printed != own.printed:
            row.line, row.printed = row.line or row.printed, own.printed


def _formulas(reader: _Reader) -> dict[int, Shown]:
    """What each display says."""
    found = {number: Shown(frozenset(), {}) for number in range(len(reader.displays))}
    for row in reader.rows:
        if row.display >= 0:
            line, before = row.line or row.printed, found[row.display]
            parts = [values_and_rates(one) for one in (line, *system_lines(row.printed))]
            gives = {(letter if kind == 0 else rf"\dot{{{letter}}}"): value for part in parts for kind in (0, 1)
                     for letter, value in part[kind].items()}
            found[row.display] = Shown(before.letters | letters_of_text(line), {**before.gives, **gives},
                                       f"{before.printed} {line}".strip())
    return found


class _Reader:
    """Walks through the source once, counting as LaTeX does."""

    def __init__(self, preamble: str, body: str) -> None:
        self.body, self.proving = body, False
        self.rows: list[Row] = []
        self.by_section = _WITHIN.search(preamble) is not None
        self.names: dict[str, tuple[str, str, bool]] = {}  # environment -> name, counter, within sections
        for star, name, shared, title, within in _NEWTHEOREM.findall(preamble):
            self.names[name] = (title, "" if star else shared or name, within == "section")
        for name, title in USUAL.items():
            self.names.setdefault(name, (title, name, False))
        self.counts: dict[str, int] = {}
        self.section, self.part = 0, 0
        self.parent = ""
        self.pending: list[str] = []
        self.group_labels: dict[str, list[str]] = {}
        self.remarking = False
        self.displays: list[Display] = []
        self.shown = 0  # letters of all displays
        self.waiting: list[tuple[str, int]] = []  # labels of subequations, and from which row on they hold

    def read(self) -> None:
        """All rows, those within theorems after the theorem."""
        self._walk(0, len(self.body), "")

    def _walk(self, at: int, end: int, within: str) -> None:
        while (found := _MARK.search(self.body, at, end)) is not None:
            at = found.end()
            word = found[1]
            if word is None:
                close = self._closing(found.group(), at, end)
                self._equations("equation", self.body[at:close], within, (found.start(), close + 2), numbered=False)
                at = close + 2
            elif word == "section" and not found.group().endswith("*"):
                self.section += 1
                if self.by_section:
                    self.counts["equation"] = 0
                self.counts.update({counter: 0 for _, counter, inside in self.names.values() if inside and counter})
            elif word in ("ref", "eqref", "cref", "Cref", "autoref"):
                labels, at = group(self.body, at)
                self.pending += [label.strip() for label in labels.split(",")]
            elif word == "setcounter":
                counter, at = group(self.body, at)
                value, at = group(self.body, at)
                if value.strip().isdigit():
                    self.counts[counter.strip()] = int(value)
            elif word == "label" and self.waiting and self.waiting[-1][0] == "":
                name, at = group(self.body, at)
                self.waiting[-1] = (name.strip(), self.waiting[-1][1])
            elif word in ("begin", "end"):
                name, at = group(self.body, at)
                at = self._environment(word, name.strip(), at, end, within)

    def _environment(self, word: str, name: str, at: int, end: int, within: str) -> int:
        if name == "subequations":
            self._subequations(word)
            return at
        if word == "end":
            return at
        close = self._close(name, at, end)
        if name in SKIPPED:
            return close
        base = name.removesuffix("*")
        if base in DISPLAYS:
            start = optional(self.body, at)[1] if base == "IEEEeqnarray" else at
            inside = self.body[group(self.body, start)[1] if base in WITH_ARGUMENT else start:close]
            around = (self.body.rfind("\\begin", 0, at), self.body.find("}", close) + 1)
            self._equations(base, inside, within, around, numbered=base == name != "displaymath")
            return close
        if base in self.names:
            self._theorem(base, name != base, at, close)
        elif base in PROOFS:
            self._proof(at, close)
        return close if base in self.names or base in PROOFS else at

    def _closing(self, opening: str, at: int, end: int) -> int:
        r"""Where a formula that \\[ or $$ opens is closed."""
        closing = r"\]" if opening == r"\[" else "$$"
        found = self.body.find(closing, at, end)
        if found < 0:
            line = self.body.count("\n", 0, at) + 1
            raise SourceError(f"{opening} in line {line} of the document's body has no end")
        return found

    def _close(self, name: str, at: int, end: int) -> int:
        r"""Where the environment that has just begun ends, at its \\end."""
        depth = 1
        for found in re.compile(rf"\\(begin|end)\s*\{{{re.escape(name)}\}}").finditer(self.body, at, end):
            depth += 1 if found[1] == "begin" else -1
            if depth == 0:
                return found.start()
        line = self.body.count("\n", 0, at) + 1
        raise SourceError(rf"\begin{{{name}}} in line {line} of the document's body has no end")

    def _subequations(self, word: str) -> None:
        if word == "begin":
            self.parent, self.part = self._counted("equation", self.by_section), 0
            self.waiting.append(("", len(self.rows)))
            return
        label, first = self.waiting.pop() if self.waiting else ("", 0)
        if label:
            self.group_labels[label] = [row.id for row in self.rows[first:]]
        self.parent = ""

    def _counted(self, counter: str, by_section: bool) -> str:
        self.counts[counter] = self.counts.get(counter, 0) + 1
        return f"{self.section}.{self.counts[counter]}" if by_section else str(self.counts[counter])

    def _equation_number(self) -> str:
        if self.parent:
            self.part += 1
            return self.parent + chr(ord("a") + self.part - 1)
        return self._counted("equation", self.by_section)

    def _equations(self, name: str, text: str, within: str, around: tuple[int, int], numbered: bool) -> None:
        """The rows of a display; around: where it begins and ends in the body."""
        self.shown += len(text)
        if self.shown > MOST_SHOWN:  # said before they are read, which takes long
            raise SourceError(TOO_MUCH)
        lines = [text] if name in WHOLE else lines_of(text)
        carried, labels = "", ()
        before = len(self.rows)
        self.displays.append(Display(*around, ends=re.search(r"\.[\s\\,]*\Z", without_marks(text)) is not None))

        def add(number: str, printed: str, labels: tuple[str, ...], referred: list[str]) -> None:
            last = self.rows[-1] if len(self.rows) > before else None
            chain = chained(last.line or last.printed, printed) if last else ""
            self._add(Row(row_id(number) if number else UNNUMBERED, "Equation", number, printed, labels, within=within,
                          line=chain, referred=self.pending + referred, display=len(self.displays) - 1,
                          aside=bool(within) or self.proving, remark=self.remarking))
            self.pending = []

        for line in lines:
            if not cleaned(line):
                continue
            if carried and not goes_on(carried, cleaned(line)):
                add("", carried, labels, [])
                carried, labels = "", ()
            printed, labels = _joined(carried, cleaned(line)), (*labels, *LABEL.findall(line))
            tag = TAG.search(line)
            if tag is None and (WITHOUT_NUMBER.search(line) or not (numbered or "IEEEyesnumber" in line)):
                carried = printed
                continue
            add(tag[1].strip() if tag else self._equation_number(), printed, labels, references(line))
            carried, labels = "", ()
        if carried and len(self.rows) > before and goes_on(self.rows[-1].printed, carried):
            self.rows[-1].printed = _joined(self.rows[-1].printed, carried)
        elif carried:
            add("", carried, labels, [])

    def _theorem(self, base: str, starred: bool, at: int, close: int) -> None:
        what, counter, by_section = self.names[base]
        title, begin = optional(self.body, at)
        number = self._counted(counter, by_section) if counter and not starred else ""
        text = self.body[begin:close]
        row = Row(row_id(f"{what.lower()}{number}"), what, number, " ".join(LABEL.sub("", text).split()),
                  tuple(LABEL.findall(without_displays(text))), title or "", referred=references(text),
                  span=(begin, close))
        self._add(row)
        self.pending, self.remarking = [], _REMARKS.search(what) is not None
        self._walk(begin, close, row.id)
        self.remarking = False
        self.pending = []

    def _proof(self, at: int, close: int) -> None:
        named, begin = optional(self.body, at)
        of = references(named or "")
        owner = next((row for row in self.rows if set(row.labels) & set(of)), None) or next(
            (row for row in reversed(self.rows)
             if row.what not in ("Equation", "Remark") and not is_assumption(row.what)), None)
        if owner is not None:
            owner.referred += references(self.body[begin:close])
        self.pending, self.proving = [], True
        self._walk(begin, close, "")
        self.pending, self.proving = [], False

    def _add(self, row: Row) -> None:
        taken = {one.id for one in self.rows}
        number, base = 2, row.id
        while row.id in taken:
            row.id = f"display{number}" if base == UNNUMBERED else f"{base}-{number}"
            number += 1
        self.rows.append(row)


def _joined(first: str, second: str) -> str:
    return f"{first} {second}".strip()
