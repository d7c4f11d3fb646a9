"""The proof in a certificate as lines that a reader can follow: each says one thing, and the sum that shows it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from workbench.proof.checker import split_relation
from workbench.proof.wording import listed
from workbench.report.certificate_latex import expression_latex, relation_latex
from workbench.report.errata.blocks import Item
from workbench.report.errata.proof_terms import Known, Sum, margin_of, sum_of
from workbench.report.hypotheses import signs

CASES = {"nonnegative": (">=", r"\ge 0"), "nonpositive": (">=", r"\le 0"), "negative": (">", "< 0"),
         "positive": (">", "> 0"), "zero": ("==", "= 0")}
OPPOSITE = {"<=": ">", "<": ">=", ">=": "<", ">": "<=", "==": "!=", "!=": "=="}
LESS = {"<=": "the right side less the left one", ">=": "the left side less the right one",
        "==": "the difference of both sides"}
LESS |= {"<": LESS["<="], ">": LESS[">="]}
SAME = "both sides are the same, multiplied out"
SIDES = 160  # characters of a difference beyond which it is called that
LONGEST = 900  # characters of a sum beyond which its terms stand below each other
LONGEST_SHOWN = 3000  # of what is to be shown, which is written out once
MARK = "\ue001{}\ue001"  # where the number of a line will stand
_MARKED = re.compile("\ue001(\\d+)\ue001")
_SIGN = re.compile(r"([A-Za-z_]\w*) (>=?|!=) 0")
HOW_TO_READ = (
    "In a proof, a number in square brackets is a line of what is given or shown there. In a sum it stands for the two "
    "sides of that line, the smaller one taken from the greater one, which is not negative, and is zero where the line "
    "says that both are the same. Squares are not negative, nor are products of such terms with letters whose signs "
    "are given; so a sum of them is not negative, and that is what each line says.")


@dataclass(frozen=True)
class Told:
    """A proof as it is told. signs: the letters of known sign as LaTeX; given, always: what else is assumed, at the end
    and at all times, each with the number that the lines use for it, where they do; lines: the steps."""

    signs: tuple[str, ...]
    given: tuple[str, ...]
    always: tuple[str, ...]
    lines: tuple[Item, ...]


@dataclass
class _Line:
    """A line; used: keys of what it uses; key: what later lines call it by; lemma: whether it is told only where a
    later line uses it; inside: the lemma in whose proof it stands; terms: of a sum that is too long for a line."""

    text: str
    depth: int
    used: set[int] = field(default_factory=set)
    key: int | None = None
    lemma: bool = False
    inside: int | None = None
    terms: tuple[str, ...] = ()


@dataclass
class _Telling:
    """What is told so far, and which lemmas can be used again: by their text and where they were shown."""

    goal: Mapping[str, Any]
    lines: list[_Line] = field(default_factory=list)
    keys: int = 0
    lemmas: dict[tuple[str, int], list[Known]] = field(default_factory=dict)
    scopes: int = 0

    def key(self) -> int:
        """A new key."""
        self.keys += 1
        return self.keys


@dataclass(frozen=True)
class _Place:
    """Where a step stands: what is known there, how deep, in which scope and in which cases."""

    given: tuple[Known, ...]
    depth: int
    scope: int = 0
    cases: frozenset[int] = frozenset()


def proof_steps(certificate: Mapping[str, Any]) -> Told:
    """The proof of a certificate of verdict `proved`, or of a correction in one: every relation shown, in turn."""
    goal = certificate["goal"]
    telling = _Telling(goal)
    given = tuple(_premise(text, telling) for text in goal.get("assume", []))
    always = tuple(_premise(text, telling) for text in goal.get("always", []))
    for text, proof in zip(goal["show"], certificate["proofs"], strict=True):
        telling.lines.append(_Line(f"To show: ${_shown(relation_latex(text), LONGEST_SHOWN)}$.", 0))
        _step(text, _Place(given, 1), proof, telling, always, None)
    kept = _kept(telling.lines)
    used = {key for line in kept for key in line.used}
    called = [known.key for known in (*given, *always)] + [line.key for line in kept]
    numbers = {key: i for i, key in enumerate((key for key in called if key in used), 1) if key is not None}
    return Told(tuple(signs(goal.get("assume", []))), _stated(given, goal.get("assume", []), numbers),
                _stated(always, goal.get("always", []), numbers), tuple(_items(kept, numbers)))


def _stated(given: Sequence[Known], texts: Sequence[str], numbers: Mapping[int, int]) -> tuple[str, ...]:
    """What is assumed beyond the signs of letters, each with its number, where it has one."""
    return tuple(rf"[{numbers[known.key]}]\ {relation_latex(text)}" if known.key in numbers else relation_latex(text)
                 for known, text in zip(given, texts, strict=True) if known.key is not None)


def _items(lines: Sequence[_Line], numbers: Mapping[int, int]) -> Iterator[Item]:
    """The lines with their numbers."""
    for line in lines:
        text = line.text[:1].upper() + line.text[1:]
        number = f"[{numbers[line.key]}] " if line.key is not None and line.key in numbers else ""
        yield Item(number + _with_numbers(text, numbers), line.depth)
        yield from (Item(_with_numbers(f"${term}$", numbers), line.depth + 1) for term in line.terms)


def _with_numbers(text: str, numbers: Mapping[int, int]) -> str:
    return _MARKED.sub(lambda found: f"[{numbers[int(found[1])]}]", text)


def _kept(lines: Sequence[_Line]) -> list[_Line]:
    """The lines without the lemmas that nothing is shown by, and without their proofs."""
    needed = {key for line in lines if not line.lemma and line.inside is None for key in line.used}
    for line in reversed(lines):
        if line.lemma and line.key in needed:
            needed |= line.used
    return [line for line in lines if (line.key in needed if line.lemma else True)
            and (line.inside is None or line.inside in needed)]


def _premise(text: str, telling: _Telling) -> Known:
    margin, operator = margin_of(text)
    if found := _SIGN.fullmatch(text):
        return Known(margin, operator, expression_latex(found[1]))
    key = telling.key()
    return Known(margin, operator, MARK.format(key), key)


def _step(text: str, place: _Place, proof: Mapping[str, Any], telling: _Telling, always: tuple[Known, ...],
          lemma: int | None) -> frozenset[int]:
    """Tell the proof of a relation; lemma: its key, where it is one. The cases it depends on are returned."""
    rule = proof["rule"]
    if rule == "cut":
        return _cut(text, place, proof, telling, always, lemma)
    if rule == "cases":
        return _cases(text, place, proof, telling, always, lemma)
    if rule == "nonincreasing":
        return _nonincreasing(text, place, proof, telling, always, lemma)
    found, said, ended = _sum(text, place, proof, telling, lemma)
    line = f"${relation_latex(text)}$, since {said}" if lemma is not None else said
    short = len(found.latex) <= LONGEST
    line += f"{ended}{found.latex}$" if short and ended else "" if short else " the sum of these terms"
    if found.facts:
        line += f", as {listed(found.facts)}"
    if found.positive is not None and len(found.terms) > 1 and _strict(text, proof):
        line += f", where ${found.positive}$ is positive"
    telling.lines.append(_Line(f"{line}{'.' if short else ':'}", place.depth, found.used, lemma, lemma is not None,
                               terms=() if short else tuple(found.terms)))
    return found.cases


def _strict(text: str, proof: Mapping[str, Any]) -> bool:
    return proof["rule"] == "contradiction" or split_relation(text)[1] in ("<", ">")


def _sum(text: str, place: _Place, proof: Mapping[str, Any], telling: _Telling,
         lemma: int | None) -> tuple[Sum, str, str]:
    """The sum that shows a relation, what it is, and how the formula with it begins; none where words say all."""
    if proof["rule"] == "contradiction":
        return _against(text, place, proof["terms"], telling, lemma)
    if proof["rule"] == "monotone":
        return Sum(), "it holds at the start and does not fall from there on, as the certificate spells out", ""
    if not proof.get("terms"):
        return Sum(), SAME, ""
    found = sum_of(proof["terms"], place.given)
    times = ""
    if proof.get("multiplier"):
        scale = sum_of([{"coefficient": "1", "factors": proof["multiplier"]}], place.given)
        found.used |= scale.used
        found.cases |= scale.cases
        times = f", times ${scale.latex}$, which is positive,"
    difference = expression_latex(margin_of(text)[0])
    if len(difference) <= SIDES and not times and len(found.latex) <= LONGEST:
        return found, "", f"${difference} = "
    what = f"${difference}$" if len(difference) <= SIDES else LESS.get(split_relation(text)[1], LESS["=="])
    return found, f"{what}{times} is", " $"


def _against(text: str, place: _Place, terms: Sequence[Mapping[str, Any]],
             telling: _Telling, lemma: int | None) -> tuple[Sum, str, str]:
    """What is given, with the opposite of what is to be shown where the sum takes it, adds up to more than zero."""
    given = place.given
    if not any(len(given) in item.values() for term in terms for item in term["factors"]):
        return sum_of(terms, given), "what is given cannot hold together:", " $0 = "
    left, operator, right = split_relation(text)
    key, opposite = telling.key(), f"{left} {OPPOSITE[operator]} {right}"
    telling.lines.append(_Line(f"suppose that ${relation_latex(opposite)}$.", place.depth, set(), key, inside=lemma))
    return sum_of(terms, (*given, Known(*margin_of(opposite), MARK.format(key), key))), "then", " $0 = "


def _cut(text: str, place: _Place, proof: Mapping[str, Any], telling: _Telling, always: tuple[Known, ...],
         lemma: int | None) -> frozenset[int]:
    known = _shown_before(proof["lemma"], place, telling)
    if known is None:
        key = telling.key()
        cases = _step(proof["lemma"], place, proof["proof"], telling, always, key)
        if re.search(r"\b(?:abs|sign)\(", f"{proof['lemma']} {proof['proof']}"):
            cases = place.cases  # a case says what these are
        known = Known(*margin_of(proof["lemma"]), MARK.format(key), key, cases)
        telling.lemmas.setdefault((proof["lemma"], place.scope), []).append(known)
    return _step(text, replace(place, given=(*place.given, known)), proof["then"], telling, always, lemma)


def _shown_before(lemma: str, place: _Place, telling: _Telling) -> Known | None:
    return next((known for known in telling.lemmas.get((lemma, place.scope), ()) if known.cases <= place.cases), None)


def _cases(text: str, place: _Place, proof: Mapping[str, Any], telling: _Telling, always: tuple[Known, ...],
           lemma: int | None) -> frozenset[int]:
    if lemma is not None:
        telling.lines.append(_Line(f"${relation_latex(text)}$, in each of these cases:", place.depth, set(), lemma,
                                   lemma=True))
        own = telling.lines[-1]
    of, found = expression_latex(proof["of"]), frozenset[int]()
    letter = re.fullmatch(r"[A-Za-z_]\w*", proof["of"]) is not None
    for name, (operator, sign) in CASES.items():
        if name not in proof:
            continue
        turned = name in ("nonpositive", "negative")
        key = telling.key()
        mark = of if letter and not turned else rf"\left(-{of}\right)" if letter else MARK.format(key)
        known = Known(f"-({proof['of']})" if turned else proof["of"], operator, mark, None if letter else key,
                      frozenset((key,)))
        telling.lines.append(_Line(f"where ${of} {sign}$:", place.depth, set(), None if letter else key,
                                   inside=lemma))
        start = len(telling.lines)
        inside = replace(place, given=(*place.given, known), depth=place.depth + 1, cases=place.cases | {key})
        found |= _step(text, inside, proof[name], telling, always, None) - {key}
        if lemma is not None:
            for line in telling.lines[start:]:
                line.inside = lemma
                own.used |= line.used
    return found


def _nonincreasing(text: str, place: _Place, proof: Mapping[str, Any], telling: _Telling, always: tuple[Known, ...],
                   lemma: int | None) -> frozenset[int]:
    """A function that does not grow along the motion is at most what it was at time zero."""
    function = proof["function"]
    start = _at_start(function, telling.goal.get("initial", {}))
    bound = f"{function} <= {start}"
    known = _shown_before(bound, place, telling)
    if known is None:
        telling.scopes += 1
        along = _Place((*place.given, *always), place.depth, telling.scopes)
        key = telling.key()
        fall, before = f"D({function}) <= 0", telling.key()
        _step(fall, along, proof["decrease"], telling, always, before)
        telling.lines.append(_Line(f"${relation_latex(bound)}$, its value at time zero, because by "
                                   f"{MARK.format(before)} it does not grow.", place.depth, {before}, key,
                                   lemma=True))
        known = Known(*margin_of(bound), MARK.format(key), key)
        telling.lemmas.setdefault((bound, place.scope), []).append(known)
    return _step(text, replace(place, given=(*place.given, known)), proof["then"], telling, always, lemma)


def _at_start(text: str, initial: Mapping[str, str]) -> str:
    """An expression with the values at time zero in place of the letters that move."""
    return re.sub(r"[A-Za-z_]\w*", lambda found: f"({initial[found[0]]})" if found[0] in initial else found[0], text)


def _shown(latex: str, longest: int) -> str:
    return latex if len(latex) <= longest else r"\text{(a long expression, which the certificate spells out)}"
