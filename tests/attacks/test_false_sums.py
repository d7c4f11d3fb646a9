"""Nothing false about products of sums, tangents or squares of margins is proved, and no forged certificate passes."""

import pytest
from false_sums import STATEMENTS, forged

from workbench.errors import ClaimError
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Claim
from workbench.proof.decide.engine import decide

FORGED = dict(forged())


def test_no_false_statement_is_proved_and_most_are_broken():
    outcomes = {}
    for name, goal in STATEMENTS.items():
        claim = Claim(id="attack:1", title="false", kind="inequality", printed="x", recorded="refuted",
                      build=lambda of=goal: of)
        try:
            outcomes[name] = decide(claim).verdict
        except ClaimError:
            outcomes[name] = "refused"
    assert not {name: verdict for name, verdict in outcomes.items() if verdict == "proved"}
    assert len(outcomes) >= 40
    assert sum(verdict == "refuted" for verdict in outcomes.values()) > 0.7 * len(outcomes), outcomes


@pytest.mark.parametrize("name", FORGED)
def test_no_forged_certificate_is_accepted(name):
    with pytest.raises(CertificateError):
        check(FORGED[name])


def test_there_are_enough_forged_ones():
    assert len(FORGED) >= 30
