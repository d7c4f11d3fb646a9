"""Proofs that show lemmas first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from workbench.proof.claim import Relation
from workbench.proof.text import relation_text

Proof = dict[str, Any]


def after(lemmas: Sequence[tuple[Relation, Proof]], final: Proof) -> Proof:
    """A proof that uses lemmas, each shown from what is known before it."""
    for lemma, proof in reversed(lemmas):
        final = {"rule": "cut", "lemma": relation_text(lemma), "proof": proof, "then": final}
    return final
