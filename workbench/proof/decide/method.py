"""How a claim was proved, in words, as its certificate shows it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


def method_of(proofs: Iterable[dict[str, Any]]) -> str:
    """The methods of the proofs of a goal's relations, each named once, in their order."""
    return ", ".join(dict.fromkeys(map(_words, proofs)))


def _words(proof: dict[str, Any]) -> str:
    match proof.get("rule"):
        case "cut":
            while proof["rule"] == "cut":
                proof = proof["then"]
            return f"lemmas and {_words(proof)}"
        case "combination":
            squares = any("square" in factor for term in proof["terms"] for factor in term["factors"])
            return "sum of squares" if squares else "combination"
        case "cases":
            negative = proof.get("negative", {})
            return "contradiction" if negative.get("rule") == "contradiction" and proof["positive"] == proof.get(
                "zero") else "cases and combination"
        case "monotone":
            return "a margin that grows"
        case "nonincreasing":
            return "a function that does not increase, and combination"
        case rule:
            return str(rule)
