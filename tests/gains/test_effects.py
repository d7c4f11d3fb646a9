"""Found gains in simulation: what the sentences say of them is what the runs gave."""

from workbench.paper.gain_effects import Effect
from workbench.report.gains import compared


def test_a_run_that_fails_is_said_and_not_compared():
    runs = [Effect("stated", "as it is", {"position_rms": 1.0}, None), Effect("new", "as it is", {}, "left its domain"),
            Effect("other", "as it is", {"position_rms": 1.005}, None)]
    first, second = compared(runs)
    assert "the found gains do not come to the end" in first
    assert "no difference to speak of" in second
