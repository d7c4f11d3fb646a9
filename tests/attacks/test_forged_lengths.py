"""Certificates that are long rather than false: refused by their steps of work, which count all that takes time."""

import pytest

from workbench.proof import checker
from workbench.proof.checker import CertificateError, check, goal_digest

FIRST = {"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 0}]}]}


def of(*assume, proof=FIRST, name="1", **parts):
    one = {"claim": f"doe2026:{name}", "version": 2, "verdict": "proved", "example": {"x": "1"}, "proofs": [proof],
           "goal": {"assume": list(assume), "show": ["x > 0"]}} | parts
    return one | {"goal_digest": goal_digest(one)}


def test_an_assumption_that_is_defined_by_others_is_counted_with_all_of_them():
    check(of("x > 0", *["1/x >= 0"] * 20))
    with pytest.raises(CertificateError, match="steps of work"):  # its time grows with the square of their number
        check(of("x > 0", *["1/x >= 0"] * 2500))


def test_an_enclosure_by_long_numbers_is_counted_by_their_length(monkeypatch):
    monkeypatch.setattr(checker, "MOST_WORK", 100_000)
    enclosed = {"fact": "enclosure", "of": "exp(9999) + exp(9998)"}

    def times(number):
        terms = [{"coefficient": "0", "factors": [enclosed]}] * number
        return of("x > 0", proof=FIRST | {"terms": [*FIRST["terms"], *terms]})

    check(times(2))
    with pytest.raises(CertificateError, match="steps of work"):
        check(times(100))


def test_the_digest_of_a_part_is_made_once_however_many_use_it(monkeypatch):
    parts = {"big": of("x > 0", name="big")}
    used = {"big": parts["big"]["goal_digest"]}
    parts |= {str(n): of("x > 0", name=str(n), premises=used) for n in range(20)}
    top = of("x > 0", name="top", premises={name: part["goal_digest"] for name, part in parts.items()})
    asked = []
    made = checker.goal_digest
    monkeypatch.setattr(checker, "goal_digest", lambda part: asked.append(part["claim"]) or made(part))
    check(top | {"composition": {"certificates": parts, "cited": {}, "links": [],
                                 "assumes": {name: ["x > 0"] for name in [*parts, "top"]}}})
    assert asked.count("doe2026:big") == 2  # as a certificate of its own, and as a part
