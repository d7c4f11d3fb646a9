"""Errata are the same whether a certificate was found now or lay with the paper."""

import json

import sympy as sp

from workbench.proof.claim import D, Goal, at_most
from workbench.proof.decide.engine import decide
from workbench.proof.document import certificate_text
from workbench.proof.fate import judged
from workbench.proof.paper import Paper
from workbench.proof.recorded_certificate import PARTS, decided_by
from workbench.report.errata.write import errata_texts


def test_rates_stand_in_one_order_whether_searched_or_checked_again():
    """A file of certificates has its names sorted; the goal states z before a."""
    paper = Paper("doe2026", "J. Doe, A paper, 2026")
    z, a = sp.symbols("z a", real=True)
    k = sp.Symbol("k", positive=True)

    @paper.claim("1", "V decays", "inequality", r"\dot V \le 0", "refuted")
    def decay() -> Goal:
        """Two rates, that of z first."""
        return Goal((at_most(D(z**2 + a**2), 0),), flow={z: k * a, a: k * z})

    claim = paper.claims[0]
    found = decide(claim)
    kept = json.loads(certificate_text(found.certificate))
    again = decided_by(claim, {name: kept[name] for name in PARTS if name in kept} | {"version": 1})
    assert again is not None and list(found.certificate["goal"]["flow"]) == ["a", "z"]
    cold, warm = (errata_texts(judged([decision]), paper.citation) for decision in (found, again))
    assert cold == warm and r"\dot{a}" in cold["errata.md"]
