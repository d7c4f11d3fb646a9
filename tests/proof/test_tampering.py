"""Every committed certificate, corrupted: refused, or true all the same by an independent check.

Three corruptions, at places drawn with a fixed seed, in every part of certificates: a digit changed, a term missing,
another claim's certificate. Of those that a certificate can suffer one in four is drawn, so that each kind in each
part meets a hundred certificates and more; test_checker_standalone.py holds that they pass as they are. What the
checker still accepts may be true (a coefficient with some slack, another counterexample): then sympy, numpy and mpmath
must say so too, from the certificate's text alone.
"""

import ast
import copy
import functools
import json
import random
import re
import sys
from collections import Counter
from pathlib import Path

import pytest
import sympy as sp
from independent import Evaluated, model_breaks, path_obeys
from verdicts import accepted

from workbench.proof.checker import MANIFEST
from workbench.proof.claim import D, Goal, Relation
from workbench.proof.paper import collect_papers
from workbench.proof.pinned import pinned
from workbench.proof.text import goal_text

PROOFS = Path(__file__).parents[2] / "proofs"
FILES = sorted(path for path in PROOFS.glob("*/certificates/*.json") if path.name != MANIFEST)
NAMES = [f"{path.parents[1].name}:{path.stem}" for path in FILES]
TURNED = {" <= ": " > ", " >= ": " < ", " < ": " >= ", " > ": " <= ", " == ": " != ", " != ": " == "}
SHOWN_BY = ("proofs", "example", "point", "functions", "path", "duration", "always", "fails")
PARTS = ("goal", *SHOWN_BY, "correction", "repair")
SHARE = 0.25  # of the corruptions of a certificate
COUNTS: Counter[str] = Counter()


@functools.cache
def loaded(path):
    return json.loads(path.read_text(encoding="utf-8"))


# --- corruptions -----------------------------------------------------------------------------------------


def texts(part, way=()):
    """(way, text) of every string and number below a part of a certificate."""
    if isinstance(part, str | int):
        yield way, part
    elif isinstance(part, dict | list):
        for key, value in sorted(part.items()) if isinstance(part, dict) else enumerate(part):
            yield from texts(value, (*way, key))


def with_text(certificate, way, text):
    """A copy of the certificate with another string at one place."""
    other = copy.deepcopy(certificate)
    *above, last = way
    functools.reduce(lambda part, key: part[key], above, other)[last] = text
    return other


def with_other_digit(certificate, part, rng):
    """One digit of a number (not of a name) in one part changed; None when the part holds no number."""
    places = [(way, hit.start()) for way, text in texts(certificate[part], (part,)) if way[-1] not in ("rule", "fact")
              for hit in re.finditer(r"(?<![A-Za-z_0-9])\d+", str(text))]
    if not places:
        return None
    way, start = rng.choice(places)
    text = functools.reduce(lambda value, key: value[key], way, certificate)
    if isinstance(text, int):  # the place of an assumption
        return with_text(certificate, way, text + rng.choice((-1, 1)))
    end = re.compile(r"\d+").match(text, start).end()
    place = rng.randrange(start, end)
    digits = "1234" if text[:start].endswith("**") else "0123456789"  # higher powers only take time to be refused
    digit = rng.choice([d for d in digits if d != text[place] and (d != "0" or place > start)])
    return with_text(certificate, way, text[:place] + digit + text[place + 1:])


def without_term(certificate, part, rng):
    """One term missing in one part: of a combination, of a sum in a relation, or of a list of values."""
    cuts = list(missing(certificate[part], (part,)))
    return rng.choice(cuts)(certificate) if cuts else None


def missing(value, way):
    """Functions that leave one thing out, for every place below a part where something may be missing."""
    if isinstance(value, dict):
        for key, inner in sorted(value.items()):
            if way[-1] in ("point", "example", "functions", "path"):
                yield functools.partial(dropped, way=(*way, key))
            yield from missing(inner, (*way, key))
    elif isinstance(value, list):
        for place, inner in enumerate(value):
            yield functools.partial(dropped, way=(*way, place))
            yield from missing(inner, (*way, place))
    elif any(f" {sign} " in str(value) for sign in "+-"):
        yield functools.partial(shortened, way=way)


def dropped(certificate, way):
    other = copy.deepcopy(certificate)
    *above, last = way
    functools.reduce(lambda part, key: part[key], above, other).pop(last)
    return other


def shortened(certificate, way):
    """One text with the last term of its first sum left out."""
    text = functools.reduce(lambda part, key: part[key], way, certificate)
    left, operator, right = re.fullmatch(r"(.*?)(?: (<=|>=|==|!=|<|>) (.*))?", text).groups()
    sides = [ast.parse(side, mode="eval").body for side in (left, right) if side]
    side = next(s for s in sides if any(isinstance(n, ast.BinOp) and isinstance(n.op, ast.Add | ast.Sub)
                                        for n in ast.walk(s)))

    class Shorter(ast.NodeTransformer):
        done = False

        def visit_BinOp(self, node):
            if not self.done and isinstance(node.op, ast.Add | ast.Sub):
                self.done = True
                return node.left
            return self.generic_visit(node)

    sides[sides.index(side)] = Shorter().visit(side)
    written = [ast.unparse(s) for s in sides]
    return with_text(certificate, way, f" {operator} ".join(written) if operator else written[0])


def of_another_claim(certificate, rng):
    """(what, certificate) with the statement, or what shows it, taken from another certificate of the same kind."""
    like = [other for other in map(loaded, FILES) if other["verdict"] == certificate["verdict"] and set(other) == set(
        certificate) and other["goal"] != certificate["goal"]]
    if like:
        other = rng.choice(like)
        yield "another's goal", certificate | {"goal": other["goal"]}
        yield "another's proof", certificate | {key: other[key] for key in SHOWN_BY if key in other}


def turned(text):
    operator = next(o for o in TURNED if o in text)
    return text.replace(operator, TURNED[operator])


def corrupted(certificate, seed):
    """(what was done, corrupted certificate): every corruption in every part, and what is shown turned round."""
    rng = random.Random(seed)
    for part in (p for p in PARTS if p in certificate):
        yield f"a digit of {part}", with_other_digit(certificate, part, rng)
        yield f"a term of {part}", without_term(certificate, part, rng)
    yield from of_another_claim(certificate, rng)
    for place, text in enumerate(certificate["goal"]["show"]):
        yield "turned", with_text(certificate, ("goal", "show", place), turned(text))
    for place, text in enumerate(certificate["goal"]["assume"][-1:], len(certificate["goal"]["assume"]) - 1):
        yield "assumption turned", with_text(certificate, ("goal", "assume", place), turned(text))
    for name, rate in list(certificate["goal"].get("flow", {}).items())[-1:]:
        yield "flow", with_text(certificate, ("goal", "flow", name), f"({rate}) + 1")
    yield "verdict", certificate | {"verdict": "refuted" if certificate["verdict"] == "proved" else "proved"}


# --- what is true all the same ---------------------------------------------------------------------------


def goal_of(record):
    """The goal a certificate states, read by sympy alone."""
    names = set(re.findall(r"[A-Za-z_]\w*", json.dumps(record)))
    index, count = sp.Symbol("j", integer=True), sp.Symbol("n_h", integer=True)
    words = {name: sp.Symbol(name, real=True) for name in names}
    words |= {name: sp.IndexedBase(name, real=True)[index] for name in record.get("indexed", [])}
    words |= {"Sum": lambda term: sp.Sum(term, (index, 1, count)), "D": D, "log": sp.log, "exp": sp.exp, "abs": sp.Abs,
              "sqrt": sp.sqrt, "sign": sp.sign, "tanh": sp.tanh, "sin": sp.sin, "cos": sp.cos, "Max": sp.Max,
              "Min": sp.Min}

    def expr(text):
        return sp.sympify(text, locals=words)

    def relation(text):
        left, operator, right = re.split(r" (<=|>=|==|!=|<|>) ", text)
        return Relation(expr(left), operator, expr(right))

    return Goal(tuple(map(relation, record["show"])), tuple(map(relation, record["assume"])),
                {words[s]: expr(rate) for s, rate in record.get("flow", {}).items()},
                tuple(map(relation, record.get("always", []))),
                {words[s]: expr(value) for s, value in record.get("initial", {}).items()},
                words[record["eventually"]] if "eventually" in record else None)


@functools.lru_cache(maxsize=8)
def evaluated(record):
    """A goal, given as JSON, at points; many corruptions leave the goal as it was."""
    return Evaluated(goal_of(json.loads(record)), neurons=1)


@functools.lru_cache(maxsize=8)
def not_broken(record):
    """Whether an independent search finds nothing against a goal, given as JSON."""
    return Evaluated(goal_of(json.loads(record))).falsifying_point(3, batches=2, count=3_000) is None


def established(certificate):
    """Whether the verdict of a corrupted certificate stands, by sympy, numpy and mpmath."""
    for part in ("correction", "repair"):
        if part in certificate and not established(certificate[part] | {"verdict": "proved"}):
            return False
    record = json.dumps(certificate["goal"])
    if certificate["verdict"] == "proved":
        return evaluated(record).holds_at(certificate["example"])[0] and not_broken(record)
    goal = goal_of(certificate["goal"])
    if "functions" in certificate:
        return model_breaks(goal, certificate["functions"], certificate["point"])
    if "path" in certificate and not path_obeys(goal, certificate):
        return False
    assumed, shown = evaluated(record).holds_at(certificate["point"])
    return assumed and not shown


# --- tests -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", FILES, ids=NAMES)
def test_no_corrupted_certificate_is_accepted_unless_it_is_true(path):
    certificate, name = loaded(path), NAMES[FILES.index(path)]
    drawn = random.Random(f"{name} drawn")
    for what, other in corrupted(certificate, name):
        if drawn.random() >= SHARE or other is None:
            continue
        if not accepted(other):
            COUNTS["refused"] += 1
            continue
        COUNTS[f"accepted and true: {what}"] += 1
        assert established(other), what
        assert what != "turned" or len(certificate["goal"]["show"]) > 1


def test_most_corruptions_are_refused(capsys):
    if COUNTS:  # a worker that ran other tests has nothing to count
        with capsys.disabled():
            sys.stdout.write(f"\ncorrupted certificates: {dict(COUNTS)}\n")
        assert COUNTS["refused"] > 4 * (COUNTS.total() - COUNTS["refused"])


def test_a_certificate_states_the_goal_of_its_claim():
    """Another claim's certificate with this claim's name written into it would not."""
    stated = {name: loaded(path)["goal"] for name, path in zip(NAMES, FILES, strict=True)}
    for claim in (claim for paper in collect_papers([PROOFS]) for claim in paper.claims if claim.id in stated):
        goal = claim.build()
        expected = [goal_text(goal), *([goal_text(pinned(goal, claim.at))] if claim.at else [])]
        assert stated[claim.id] in expected, claim.id
