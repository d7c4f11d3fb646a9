"""What a paper's own text says of its letters, by formulas within the text and words such as "positive constants"."""

from __future__ import annotations

import re
from collections.abc import Iterator

from workbench.paper.source.bounds import bounded_in
from workbench.proof.latex.error import LatexError
from workbench.proof.latex.parts import parted
from workbench.proof.latex.read import read_line
from workbench.proof.latex.rows import LetterEntry, RowEntry, text_of
from workbench.proof.latex.sides import (
    RATES,
    is_of_time,
    letter_latex,
    letters_in,
    letters_of_text,
    letters_of_time,
    moving_sides,
    sides_of,
)
from workbench.proof.latex.tree import Letter, Node, Number, Product

_FOR = re.compile(
    r"\b(?:for|on)\s+(?:(?:all|every|any|each|some)\s*)?\$[^$]*(?:[=<>]|\\(?:leq?|geq?|leqslant|geqslant|ne|neq|in)(?![A-Za-z])"
    r"(?!\s*\\mathbb\s*\{R\}(?:\^[^$\s]*)?\s*\$))[^$]*\$", re.IGNORECASE | re.DOTALL)
INLINE = re.compile(r"(?<![\\$])\$(?!\$)(.+?)(?<!\\)\$(?!\$)|\\\((.+?)\\\)", re.DOTALL)
_LIST = r"((?:\$[^$]+\$(?:\s*,\s*(?:and\s+)?|\s+and\s+)?)+)"
_CONSTANTS = re.compile(r"\b(?:constants?|gains?|parameters?)\b"
                        r"(?![^$]{0,30}\b(?:on|over|in|for|of|at|when|with|to|by)\b)[^.,;:$]{0,30}" + _LIST,
                        re.IGNORECASE)
_NOUNS = (r"(?:(?:real|known|unknown|finite|scalar|design|control|controller|tuning|feedback|observer|adaptation|"
          r"learning|constants?|numbers?|scalars?|gains?|parameters?|bounds?|coefficients?|integers?|weights?|reals?)"
          r"\s+){0,3}")
_POSITIVE = re.compile(r"\b(?<!non)(?<!non-)(?<!or )(?<!for )(?<!all )(?<!any )(?<!every )(?<!each )positive\s+"
                       + _NOUNS + _LIST, re.IGNORECASE)
_ARE_POSITIVE = re.compile(
    _LIST + r"\s*(?:be|are|is)\s+(?:an?\s+|all\s+|some\s+)?(?:(?:known|unknown|given|real|fixed|finite)\s+)*"
    r"positive\s+(?:\w+\s+){0,2}?"
    r"(?:constants?|gains?|numbers?|scalars?|parameters?)\b", re.IGNORECASE)
_ARE_CONSTANTS = re.compile(
    _LIST + r"\s*(?:be|are|is)\s+(?:an?\s+|all\s+|some\s+|the\s+)?"
    r"(?:(?:(?:positive|nonnegative|real|known|unknown|design|control|controller|feedback|observer|filter|adaptation|"
    r"tuning)\s+)*(?:constants?|gains?|parameters?|(?<=filter )bandwidth|(?<=observer )bandwidth)\b"
    r"|(?!piecewise|locally|almost|nearly|slowly|not|no)[a-z-]+\s+constants?(?=[\s]*(?:[,.;]|and\b|of\b|\Z)))",
    re.IGNORECASE)
_INPUTS = re.compile(r"\b(?:disturbances?|inputs?|references?)\b[^.,;:$]{0,30}" + _LIST, re.IGNORECASE)
_ARE_REFERENCES = re.compile(
    _LIST + r"\s*(?:be|are|is|denotes?)\s+(?:an?\s+|the\s+)?(?:(?:desired|reference|commanded|prescribed)\s+[a-z]+"
    r"|(?:(?:bounded|smooth|given|known|once|twice|thrice|continuously|differentiable)\s+)*reference\b)",
    re.IGNORECASE)
_CONDITIONAL = re.compile(
    r"\b(?:if|when|whenever|unless|otherwise|either|or|not|without|then|impl\w+|(?:all|every|any|each)\b.*\bexists?)\b"
    r"|\\(?:forall|exists|Rightarrow|implies|to|rightarrow)(?![A-Za-z])", re.IGNORECASE | re.DOTALL)
_ON_CONDITION = re.compile(
    r"\b(?:if|when|whenever|while|until|unless|provided(?:\s+that)?|such\s+that|case|for(?:\s+(?:all|every|any|each))?|on|or|"
    r"not|as\s+(?:long|soon)\s+as)\s+\Z", re.IGNORECASE)
_ALL = r"for\s+(?:all|every|any|each)\s*"
_AT_ALL_TIMES = re.compile(
    rf"(?:\b{_ALL})?\$\s*(?:\\forall\s*)?t\s*(?:\\geq|\\geqslant|\\ge|>)\s*0\s*\$|\$\s*\\forall\s*t\s*\$"
    rf"|\b{_ALL}(?:times?\b|\$\s*t\s*\$)", re.IGNORECASE)
_FOR_ALL = re.compile(rf"\b{_ALL}\Z", re.IGNORECASE)
_DEFINING = re.compile(r"\b(?:(?:let|defin(?:e|ing)|denot(?:e|ing)|introduc(?:e|ing))\b[^.;:$]{0,60}|where\s+)\Z",
                       re.IGNORECASE)
_ENVIRONMENT = re.compile(r"\\begin\s*\{((?!def)\w+\*?)\}.*?\\end\s*\{\1\}", re.DOTALL)  # a Definition is kept
_SENTENCE = re.compile(r"(?<=[.!?;])\s|\\(?:begin|end)\s*\{[^{}]*\}|\\(?:item|(?:sub)*section)|\n\s*\n|\\[\[\]]|\$\$")
# A sentence with one of these says of no letter that it has a sign everywhere, or is constant.
NOT_EVERYWHERE = re.compile(
    r"\b(?:if|when|whenever|while|until|unless|provided|cases?|either|n?or|neither|not|whether|suppose|then|may|might|"
    r"could|can|would|should|follow\w*|hence|thus|therefore|impl(?:y|ies)|yields?|since|because|sets?(?!-)|region|domain|"
    r"(?:in|out)side|instance|example|show\w*|prove\w*|conclude\w*|near|small|large|initially|first|once)\b|\bas\s*\$",
    re.IGNORECASE)
_ESTIMATE = re.compile(r"\\(?:hat|tilde)\{([^{}]+)\}(.*)")
_VARIES = re.compile(r"\b(?:var(?:y|ies|ying)|changes?|changing|switch\w*|adapt\w*|updated?|time-dependent|"
                     r"functions?)\b", re.IGNORECASE)
_FUNCTION = r"\b(?:energy|storage|Lyapunov|functions?|functionals?|candidates?)\b"
_FUNCTIONS = re.compile(_FUNCTION + r"[^.,;:$]{0,20}(\$[^$]+\$)", re.IGNORECASE)
_ARE_FUNCTIONS = re.compile(r"(\$[^$]+\$)\s*(?:be|is|denotes?)\s+(?:an?|the|our|its)\s+(?:[\w-]+\s+){0,4}?" + _FUNCTION,
                            re.IGNORECASE)
_RELATION = re.compile(r"[=<>]|\\(?:leq?|geq?|leqslant|geqslant|in|ll|approx)(?![A-Za-z])")
_DEFINED = re.compile(r":=|\\(?:triangleq|coloneqq|doteq)(?![A-Za-z])")
_HOLDING = {"=", "<", ">", "<=", ">="}
_REACH = 600  # letters before and behind a piece that its sentence is looked for in
_SIGNS = {">": "positive", ">=": "nonnegative"}


def letters_said(fact: str) -> set[str]:
    """The letters of a fact's formulas."""
    formulas = [(inline[1] or inline[2]).strip(" .,;") for inline in INLINE.finditer(fact)]
    return {letter for formula in formulas for letter in letters_of_text(formula)}


def says_sign(fact: str) -> bool:
    """Whether a fact says a sign, by a word or a formula."""
    formulas = [(inline[1] or inline[2]).strip(" .,;") for inline in INLINE.finditer(fact)]
    return "positive" in fact or "negative" in fact or any(
        kind != "real" for formula in formulas for _, kind in kinds_in(formula)) or any(map(bounded_in, formulas))


def signed_by_words(fact: str) -> set[str]:
    """The letters of a fact that speaks of their sign in words, but those that it calls real."""
    if "positive" not in fact and "negative" not in fact:
        return set()
    formulas = [(inline[1] or inline[2]).strip(" .,;") for inline in INLINE.finditer(fact)]
    return {letter for formula in formulas if not [*kinds_in(formula)] for letter in letters_of_text(formula)}


def said_of(facts: str) -> dict[str, str]:
    """Of each letter the first fact that speaks of it."""
    found: dict[str, str] = {}
    for fact in facts.split("\n\n"):
        for inline in INLINE.finditer(fact):
            for letter in letters_of_text((inline[1] or inline[2]).strip(" .,;")):
                found.setdefault(letter, fact.removesuffix("."))
    return found


def table_of(rows: list[RowEntry], facts: str, text: str) -> dict[str, LetterEntry]:
    """Every letter of the rows that can be read, with what the text says of it; empty entries are for the author.

    Letters that a row defines have no entry: their definition says what they are. facts: what the sentences that are
    understood say of letters for the whole paper; text: all of it.
    """
    found: dict[str, None] = {}
    for row in rows:
        if row.role != "words":
            found |= dict.fromkeys(sorted(letters_of_text(text_of(row))))
    defined = {letter for row in rows if row.role == "definition" for letter, _ in sides_of(text_of(row))}
    states = {letter for row in rows if row.role == "dynamics" for letter, _ in moving_sides(text_of(row))}
    kinds = dict(_kinds(facts))
    for row in rows:
        if row.role in ("definition", "dynamics"):
            kinds |= dict(kinds_in(text_of(row)))
    kinds = dict.fromkeys((*_named(_POSITIVE, facts), *_named(_ARE_POSITIVE, facts)), "positive") | kinds
    constant = {*_named(_ARE_CONSTANTS, facts)} - printed_of_time(text, rows)
    constants = {*_named(_CONSTANTS, facts)} - printed_of_time(text, rows) | constant
    inputs = {*_named(_INPUTS, facts)} | ({*_named(_ARE_REFERENCES, facts)} & rated(rows))
    unclear = set(valued_elsewhere(text))
    entries = {}
    for letter in found:
        if letter in defined:
            continue
        said = [role for role, letters in (("constant", constants), ("input", inputs)) if letter in letters]
        if letter in unclear - states:
            kinds.pop(letter, None)
        role = "state" if letter in states else "constant" if letter in constant else said[0] if len(said) == 1 else ""
        kind = kinds.get(letter, "real" if letter in states and kinds.get(_estimated(letter)) else "")
        entries[letter] = LetterEntry.model_validate({"kind": kind, "role": role})
    return entries


def _estimated(letter: str) -> str:
    """Of what a letter is the estimate or its error, which are numbers where it is one."""
    found = _ESTIMATE.fullmatch(letter)
    return found[1] + found[2] if found else ""


def functions_in(text: str) -> set[str]:
    """The letters that the text calls functions of the state: an energy, a storage or a Lyapunov function."""
    return {letter for pattern in (_FUNCTIONS, _ARE_FUNCTIONS) for found in pattern.finditer(text)
            for inline in INLINE.finditer(found[1])
            for letter in letters_of_text(re.split(r"=|\(|\\in(?![A-Za-z])", inline[1] or inline[2])[0])}


def on_condition(text: str) -> bool:
    """Whether the text of an assumption ties what it says to a condition, so that its formulas do not hold by
    themselves."""
    text = _AT_ALL_TIMES.sub(" ", text)
    return _CONDITIONAL.search(text) is not None or _FOR.search(text) is not None


def assumed_formulas(text: str) -> Iterator[str]:
    r"""The relations within the text of an assumption that hold as they stand, as `$|d| \\le D$`; none of a text that
    ties them to a condition. What only says a letter's sign is left to the table of letters."""
    text = _AT_ALL_TIMES.sub(" ", text)
    if on_condition(text):
        return
    for inline in INLINE.finditer(text):
        formula = (inline[1] or inline[2]).strip(" .,;")
        try:
            chains = read_line(formula).chains
        except LatexError:
            continue
        if all(chain.signs and not set(chain.signs) - _HOLDING for chain in chains) and not (
                _FOR_ALL.search(text[:inline.start()]) or any(_kind(chain.signs, chain.sides[1:]) for chain in chains)):
            yield formula


def defined_in_text(text: str) -> dict[str, str]:
    r"""The letters that the running text gives a value of other letters, as "Let $e = v - r$" or "where $q = x / y$",
    and the formula; a letter with two of them is left out, as is what holds within a theorem or a proof alone."""
    text = _ENVIRONMENT.sub(" ", text)
    found: dict[str, set[str]] = {}
    for inline in INLINE.finditer(text):
        formula = (inline[1] or inline[2]).strip(" .,;")
        values, _ = values_and_rates(formula)
        for letter, value in values.items():
            behind = letters_of_text(value)
            says_so = _DEFINED.search(formula) or _DEFINING.search(text[:inline.start()])
            if says_so and behind and letter not in behind and len(values) == 1:
                found.setdefault(letter, set()).add(formula)
    return {letter: formulas.pop() for letter, formulas in found.items() if len(formulas) == 1}


def valued_elsewhere(text: str) -> Iterator[str]:
    """The letters that a formula in the text gives a value of other letters: where nothing says that it defines them,
    they are left to the author."""
    for inline in INLINE.finditer(text):
        for letter, value in values_and_rates((inline[1] or inline[2]).strip(" .,;"))[0].items():
            if letters_of_text(value):
                yield letter


def _named(pattern: re.Pattern[str], text: str) -> Iterator[str]:
    """The letters in the list of formulas that some words stand before."""
    for found in pattern.finditer(text):
        sentence = around(text, found.start(), found.end())
        near = text[max(found.start() - 40, 0):found.end()] + text[found.end():found.end() + 30].partition(",")[0]
        if (pattern is not _INPUTS and NOT_EVERYWHERE.search(sentence)) or (
                pattern is _CONSTANTS and _VARIES.search(near)):
            continue
        for inline in INLINE.finditer(found[1]):
            formula = inline[1] or inline[2]  # the disturbance |d| <= D: d is one, D is not
            yield from letters_of_text(_RELATION.split(formula)[0] if pattern is _INPUTS else formula)


def around(text: str, start: int, end: int) -> str:
    """The sentence in which a piece of a text stands."""
    before, behind = text[max(start - _REACH, 0):start], text[end:end + _REACH]
    return f"{_SENTENCE.split(before)[-1]} {text[start:end]} {_SENTENCE.split(behind)[0]}"


def rated(rows: list[RowEntry]) -> set[str]:
    """The letters of which a rate is printed."""
    return {letter_latex(one) for row in rows if row.role != "words" for one in letters_in(text_of(row))
            if one.accents[-1:] and one.accents[-1] in RATES}


def printed_of_time(text: str, rows: list[RowEntry]) -> set[str]:
    """The letters that are printed with the time somewhere, as `\\theta(t)`: of those no word makes constants."""
    formulas = [inline[1] or inline[2] for inline in INLINE.finditer(text)]
    formulas += [text_of(row) for row in rows if row.role != "words"]
    return {letter for formula in formulas if "(t)" in formula for letter in letters_of_time(formula)}


def _kinds(text: str) -> Iterator[tuple[str, str]]:
    r"""Letters whose sign a formula in the text says, as `k, c > 0`, or that they are real, as `x \in \mathbb{R}`."""
    for inline in INLINE.finditer(text):
        conditional = _ON_CONDITION.search(text[:inline.start()]) is not None or NOT_EVERYWHERE.search(
            around(text, inline.start(), inline.end())) is not None
        formula = (inline[1] or inline[2]).strip(" .,;")
        positive = [(letter, kind) for letter, kind in bounded_in(formula).items() if kind == "positive"]
        for letter, kind in (*kinds_in(formula), *positive):
            if kind == "real" or not conditional:
                yield letter, kind


def kinds_in(formula: str) -> Iterator[tuple[str, str]]:
    """The letters whose sign a formula says, or that they are real, and that."""
    try:
        line = read_line(formula)
    except LatexError:
        return
    waiting: list[Node] = []
    for chain in line.chains:
        waiting.append(chain.sides[0])
        if not chain.signs:
            continue
        kind = _kind(chain.signs, chain.sides[1:])
        for side in waiting:
            timed = isinstance(side, Product) and len(side.factors) == 2 and is_of_time(side.factors[1])
            head = side.factors[0] if isinstance(side, Product) and timed else side
            if kind and isinstance(head, Letter):
                yield letter_latex(head), kind
        waiting = []


def values_and_rates(line: str) -> tuple[dict[str, str], dict[str, str]]:
    """What a line gives a value, and what a rate; nothing where it says anything else than that and letters' signs."""
    values, rates = dict(sides_of(line)), dict(moving_sides(line))
    signs = [*kinds_in(line)]
    try:
        chains = len(parted(read_line(line))[0])
    except LatexError:
        return {}, {}
    return values if len(values) + len(signs) == chains else {}, rates if len(rates) + len(signs) == chains else {}


def _kind(signs: tuple[str, ...], rest: tuple[Node, ...]) -> str:
    if len(signs) != 1:
        return ""
    if signs[0] in _SIGNS and isinstance(rest[0], Number) and rest[0].value == 0:
        return _SIGNS[signs[0]]
    return "real" if signs[0] == "in" and isinstance(rest[0], Letter) and rest[0].name == r"\mathbb{R}" else ""
