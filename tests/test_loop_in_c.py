"""The same loop written by hand in C, where there is a compiler: its log has the bits of the compiled one."""

import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "benchmarks"))

import simulation_speed

from workbench.trains.scenario import load_scenario


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc here")
def test_the_loop_in_c_leaves_the_same_log(tmp_path, monkeypatch):
    """The comparison ends where the logs differ: what is timed would not be the same work."""
    monkeypatch.setattr(simulation_speed, "REPEATS", 1)
    scenario = load_scenario(simulation_speed.STATED)
    ours_s, in_c_s = simulation_speed.against_c(scenario, "pid", simulation_speed.in_c(tmp_path))
    assert 0 < ours_s < float("inf") and 0 < in_c_s < float("inf")
    with pytest.raises(SystemExit, match="leaves another log"):
        simulation_speed.against_c(scenario, "pid", lambda *given: 0)
