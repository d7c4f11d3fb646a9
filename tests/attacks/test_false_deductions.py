"""What takes several steps to prove is not proved where one of them fails."""

import pytest
from false_deductions import FALSE, TRUE

from workbench.errors import WorkbenchError
from workbench.proof.claim import Claim
from workbench.proof.decide.engine import decide


def outcome(build):
    try:
        return decide(Claim(id="attack:1", title="false", kind="inequality", printed="x", recorded="refuted",
                            build=build)).verdict
    except WorkbenchError as trouble:
        assert "\n" not in str(trouble)
        return "refused"


@pytest.mark.parametrize("name", FALSE)
def test_what_is_false_is_not_proved(name):
    assert outcome(FALSE[name]) in ("refuted", "undecided", "refused")


@pytest.mark.parametrize("name", TRUE)
def test_what_is_true_is_not_refuted(name):
    assert outcome(TRUE[name]) in ("proved", "undecided")
