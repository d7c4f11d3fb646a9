"""No false statement comes out proved, whichever feature of the goal language it uses."""

from collections import Counter
from functools import cache

import pytest
from false_statements import FAMILIES, statements

from workbench.errors import WorkbenchError
from workbench.proof.claim import Claim
from workbench.proof.decide.engine import decide

EVERY = list(statements())
OUTCOMES: Counter[str] = Counter()


@cache
def outcome(number):
    """The verdict on a statement, or `refused` where no goal can be made of it, in one line."""
    _, build = EVERY[number]
    try:
        return decide(Claim(id=f"attack:{number}", title="false", kind="inequality", printed="x", recorded="refuted",
                            build=build)).verdict
    except WorkbenchError as trouble:
        assert "\n" not in str(trouble)
        return "refused"


@pytest.mark.parametrize("number", range(len(EVERY)), ids=[name for name, _ in EVERY])
def test_it_is_not_proved(number):
    OUTCOMES[outcome(number)] += 1
    assert outcome(number) in ("refuted", "undecided", "refused")


def test_there_are_enough_of_them_and_most_are_broken_not_merely_left_open():
    assert len(EVERY) == len({name for name, _ in EVERY}) >= 400
    assert len(FAMILIES) == len({name.partition(":")[0] for name, _ in EVERY})
    if sum(OUTCOMES.values()) == len(EVERY):  # a worker of several runs only some
        assert OUTCOMES["refuted"] > 0.7 * len(EVERY), OUTCOMES
