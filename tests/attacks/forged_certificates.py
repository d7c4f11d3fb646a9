"""Forged certificates, made of genuine ones: false mathematics, and true mathematics of something else.

Whoever forges may write any digest and any name into a certificate; what he cannot change is what the claim states.
"""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from workbench.proof.checker import goal_digest

Certificate = dict[str, Any]
TURNED = {" <= ": " > ", " >= ": " < ", " < ": " >= ", " > ": " <= ", " == ": " != ", " != ": " == "}


def genuine(folder: Path, each: int) -> list[Certificate]:
    """The smallest committed certificates of every paper."""
    found: list[Certificate] = []
    for paper in sorted(path for path in folder.iterdir() if (path / "certificates").is_dir()):
        files = sorted((path.stat().st_size, path) for path in (paper / "certificates").glob("*.json")
                       if path.name != "manifest.json")
        found += [json.loads(path.read_text(encoding="utf-8")) for _, path in files[:each]]
    return found


def bound(certificate: Certificate) -> Certificate:
    """The certificate with the digest that its forger writes into it."""
    return certificate | {"version": 2, "goal_digest": goal_digest(certificate)}


def turned(text: str) -> str:
    """The opposite of a relation."""
    operator = next(o for o in TURNED if o in text)
    return text.replace(operator, TURNED[operator])


def with_goal(certificate: Certificate, **parts: Any) -> Certificate:
    """The certificate with other parts of its goal."""
    return copy.deepcopy(certificate) | {"goal": copy.deepcopy(certificate["goal"]) | parts}


def false_mathematics(certificates: list[Certificate]) -> Iterator[tuple[str, Certificate]]:
    """What no proof or point can establish: of a proved claim its opposite, which its own example breaks, or that one
    is at most zero; of a failed one that it is proved, or that it fails at a point where nothing is defined."""
    for certificate in certificates:
        name, goal = certificate["claim"], certificate["goal"]
        if certificate["verdict"] == "proved":
            if goal["show"] and not all(t.split(" == ")[0] == t.split(" == ")[-1] for t in goal["show"]):
                yield f"opposite {name}", with_goal(certificate, show=[turned(t) for t in goal["show"]])
            yield f"absurd {name}", with_goal(certificate, show=["1 <= 0"] * len(goal["show"]))
            yield f"says nothing {name}", with_goal(certificate, show=["1 == 1"] * len(goal["show"])) | {
                "proofs": [{"rule": "identity"}] * len(goal["show"])}
            yield f"refuted at its example {name}", certificate | {
                "verdict": "refuted", "point": certificate["example"]}
            yield f"one shown more {name}", with_goal(certificate, show=[*goal["show"], "1 <= 0"])
            yield f"assumes what fails {name}", with_goal(certificate, assume=[*goal.get("assume", []), "1 <= 0"])
        else:
            yield f"proved {name}", certificate | {
                "verdict": "proved", "example": certificate["point"],
                "proofs": [{"rule": "identity"}] * len(goal["show"])}
            yield f"never fails {name}", with_goal(certificate, show=["0 <= 1"] * len(goal["show"]))
            yield f"of no point {name}", certificate | {"point": {}, "functions": {}}


def another_statement(certificates: list[Certificate]) -> Iterator[tuple[str, Certificate, Certificate]]:
    """(name, genuine, forged): true or not, it is not what the claim states, and bears the claim's name."""
    simple = {"version": 1, "verdict": "proved", "goal": {"assume": [], "show": ["x**2 >= 0"]}, "example": {"x": "0"},
              "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"square": "x"}]}]}]}
    for number, certificate in enumerate(certificates):
        name, goal = certificate["claim"], certificate["goal"]
        other = certificates[(number + 1) % len(certificates)]
        if (other["verdict"], other["goal"]) != (certificate["verdict"], goal):
            yield f"another claim's {name}", certificate, other | {"claim": name}
        yield f"something simple {name}", certificate, simple | {"claim": name}
        yield f"another name {name}", certificate, certificate | {"claim": name + "x"}
        yield f"assumes more {name}", certificate, with_goal(
            certificate, assume=[*goal.get("assume", []), f"{len(goal['show'])} > 0"])
        if goal.get("assume"):
            yield f"assumes less {name}", certificate, with_goal(certificate, assume=goal["assume"][1:])
        if certificate["verdict"] == "gap":
            yield f"a gap called refuted {name}", certificate, certificate | {"verdict": "refuted"}
        for part in ("correction", "repair"):
            if part in certificate:
                yield f"another {part} {name}", certificate, certificate | {
                    part: {k: v for k, v in simple.items() if k not in ("version", "verdict")}}
                yield f"no {part} {name}", certificate, {k: v for k, v in certificate.items() if k != part}


def no_certificates(certificate: Certificate) -> Iterator[tuple[str, str]]:
    """Texts of files: hostile, or such that two readers would read two things."""
    whole = json.dumps(certificate)
    yield "goal twice", whole[:-1] + ', "goal": {"assume": [], "show": ["1 <= 0"]}}'
    yield "verdict twice", whole[:-1] + ', "verdict": "refuted"}'
    yield "shown twice", whole.replace('"show": [', '"show": ["1 <= 0"], "show": [', 1)
    yield "digest twice", whole[:-1] + ', "goal_digest": "", "goal_digest": ""}'
    yield "nothing behind it", whole + whole
    yield "an array", "[" + whole + "]"
    yield "a float", whole.replace('"version": ', '"weight": 0.5, "version": ', 1)
    for number in ("NaN", "Infinity", "-Infinity", "1e999", "1" * 5000):
        yield f"the number {number[:9]}", whole.replace('"version": ', f'"weight": {number}, "version": ', 1).replace(
            '"show"', f'"indexed": {number}, "show"', 1)
    for opening, closing in (("[", "]"), ('{"a":', "}")):
        for depth in (1_000, 100_000):
            deep = opening * depth + "1" + closing * depth
            yield f"{depth} times {opening}", whole.replace('"proofs"', f'"deep": {deep}, "proofs"', 1)[:-1]
    for value in ("null", "true", '""', "[]", "{}", "1", '"proved"'):
        for key in ("goal", "proofs", "example"):
            if (key, value) != ("example", "{}"):  # nothing is assumed, so that no value is needed
                rest = json.dumps({k: v for k, v in certificate.items() if k != key})
                yield f"{key} is {value}", f'{rest[:-1]}, "{key}": {value}' + "}"


def hostile_expressions() -> Iterator[tuple[str, Certificate]]:
    """What would take a naive reader for ever, or be read as something else; none of them is true."""
    texts = ["((x+1)**64)**64", "9**9**9**9", "((((3**64)**64)**64)**64)", "1" + "0" * 6000, "x**1000000",
             "exp(exp(exp(9)))", "exp(10**30)", "1/(1-1)", "log(0)", "sqrt(-1)",
             "(" * 3000 + "x" + ")" * 3000, "-" * 5000 + "x",
             "*".join(["(x+y+1)**9"] * 9), "+".join(["x"] * 60_000), "abs(" * 400 + "x" + ")" * 400,
             "Max(" * 30 + "x" + ", y)" * 30, "+".join(f"1/(x+{i}*y)" for i in range(1, 40)),
             "__import__('os')", "x if x else y", "[x]", "x.real", "lambda: x", "x and y", "0x10", "1_0", "1e5", "0.5",
             "True", "x(y)", "D(x)", "D(D(x))", "Sum(x, (j, 1, 3))", "Sum(1, 1)", "Sum(Sum(x))", "Sum(x)*Sum(y)",
             "1/Sum(x)", "Max(x)", "Min()", "abs(x, y)", "exp(x=1)", "x**y", "x**0.5", "sqrt(x)",
             "log(x)", "1/x", "x/x", "x**-1", "",
             "x == x", "exp#0", "Sum()", "\u0445"]
    for number, text in enumerate(texts):
        yield f"expression {number}", {
            "claim": "doe2026:1", "version": 1, "verdict": "proved",
            "goal": {"assume": [], "show": [f"{text} == {text} + 1" if number % 2 else f"{text} >= {text} + 1"]},
            "example": {"x": "-1", "y": "0"}, "proofs": [{"rule": "identity"}]}
    for number, text in enumerate(texts[:20]):
        yield f"refuted expression {number}", {
            "claim": "doe2026:1", "version": 1, "verdict": "refuted",
            "goal": {"assume": [], "show": [f"{text} == {text}"]}, "point": {"x": "-1", "y": "0"}}
