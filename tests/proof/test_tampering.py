"""Every committed certificate, changed in one place: refused, or true all the same by an independent check."""

import copy
import json
import re
import sys
from collections import Counter
from pathlib import Path

import pytest
import sympy as sp
from independent import Evaluated, model_breaks

from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import D, Goal, Relation

CERTIFICATES = Path(__file__).parents[2] / "proofs" / "certificates"
FILES = sorted(CERTIFICATES.rglob("*.json"))
TURNED = {" <= ": " > ", " >= ": " < ", " < ": " >= ", " > ": " <= ", " == ": " != ", " != ": " == "}


def accepted(certificate):
    try:
        check(certificate)
    except CertificateError:
        return False
    return True


def turned(text):
    operator = next(o for o in TURNED if o in text)
    return text.replace(operator, TURNED[operator])


def scaled(text):
    """The relation with its right side a little off."""
    left, operator, right = re.split(r" (<=|>=|==|!=|<|>) ", text)
    return f"{left} {operator} ({right})*3 - 1"


def tampered(certificate):
    """(what was changed, changed certificate); the claimed verdict stays."""
    def changed(what, edit):
        other = copy.deepcopy(certificate)
        if edit(other) is not False:
            yield what, other

    def each(part, edit):
        for place, text in enumerate(certificate["goal"].get(part, [])):
            def put(other, place=place, text=text):
                other["goal"][part][place] = edit(text)
            yield from changed(f"{part} {place}: {edit.__name__}", put)

    yield from each("show", turned)
    yield from each("show", scaled)
    yield from each("assume", turned)
    yield from each("always", turned)
    for place in range(len(certificate["goal"]["assume"])):
        yield from changed(f"assume {place}: dropped", lambda other, p=place: other["goal"]["assume"].pop(p) and None)
    for name in certificate["goal"].get("flow", {}):
        yield from changed(f"flow {name}: changed", lambda other, n=name: other["goal"]["flow"].update(
            {n: f"({other['goal']['flow'][n]}) + 1"}))
    for name, value in certificate.get("point", {}).items():
        for new in (f"-{value}".replace("--", ""), "1", "0"):
            if new != value and new not in ("-0",):
                yield from changed(f"point {name} = {new}", lambda other, n=name, v=new: other["point"].update({n: v}))
        yield from changed(f"point without {name}", lambda other, n=name: other["point"].pop(n) and None)
    for place, term in terms(certificate):
        def put(other, place=place, term=term):
            list(terms(other))[place][1]["coefficient"] = term["coefficient"] + "7"
        yield from changed(f"coefficient {place}", put)
    for verdict in ("proved", "refuted"):
        if (verdict == "proved") != (certificate["verdict"] == "proved"):
            yield from changed(f"verdict {verdict}", lambda other, v=verdict: other.update(verdict=v))


def terms(part):
    """All terms of all combinations, in a fixed order, with their place."""
    found = []

    def walk(value):
        if isinstance(value, dict):
            if "coefficient" in value:
                found.append(value)
            for key in sorted(value):
                walk(value[key])
        elif isinstance(value, list):
            for one in value:
                walk(one)

    walk(part)
    return enumerate(found)


def goal_of(record):
    """The goal a certificate states, read by sympy alone."""
    names = set(re.findall(r"[A-Za-z_]\w*", json.dumps(record)))
    index, count = sp.Symbol("j", integer=True), sp.Symbol("n_h", integer=True)
    words = {name: sp.Symbol(name, real=True) for name in names}
    words |= {name: sp.IndexedBase(name, real=True)[index] for name in record.get("indexed", [])}
    words |= {"Sum": lambda term: sp.Sum(term, (index, 1, count)), "D": D, "log": sp.log, "exp": sp.exp}

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


def established(certificate):
    """Whether the verdict of a tampered certificate stands, by sympy, numpy and mpmath."""
    goal = goal_of(certificate["goal"])
    if certificate["verdict"] == "proved":
        return Evaluated(goal).falsifying_point(3, batches=3, count=4_000) is None
    if "functions" in certificate:
        return model_breaks(goal, certificate["functions"], certificate["point"])
    assumed, shown = Evaluated(goal, neurons=1).holds_at(certificate["point"])
    return assumed and not shown


COUNTS: Counter[str] = Counter()


@pytest.mark.parametrize("path", FILES, ids=[p.stem for p in FILES])
def test_no_tampered_certificate_is_accepted_for_a_false_claim(path):
    certificate = json.loads(path.read_text(encoding="utf-8"))
    assert accepted(certificate)
    for what, other in tampered(certificate):
        if not accepted(other):
            COUNTS["refused"] += 1
            continue
        COUNTS["accepted and true"] += 1
        assert established(other), what


@pytest.mark.parametrize("path", FILES, ids=[p.stem for p in FILES])
def test_a_turned_statement_is_always_refused(path):
    certificate = json.loads(path.read_text(encoding="utf-8"))
    if len(certificate["goal"]["show"]) == 1:
        other = copy.deepcopy(certificate)
        other["goal"]["show"] = [turned(text) for text in other["goal"]["show"]]
        assert not accepted(other)


def test_most_tampering_is_refused(capsys):
    if COUNTS:  # a worker that ran other tests has nothing to count
        with capsys.disabled():
            sys.stdout.write(f"\ntampered certificates: {dict(COUNTS)}\n")
        assert COUNTS["refused"] > COUNTS["accepted and true"]
