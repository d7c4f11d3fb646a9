"""MPC in a contest as one that learns from trip to trip (`mpc/learning.py`): the first trip is offset-free MPC's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from workbench.contest.entrant import Entrant, Played, trial_errors
from workbench.mpc.controller import KINDS
from workbench.mpc.learning import RecordingMpc, learned_from
from workbench.simulate.closed_loop import Run, Setting, simulate_in
from workbench.trains.scenario import ControllerSpec, Scenario

INNER = "mpc.offset_free"
OWN = ("learning_gain", "smoothing_s", "trials")
NAME = "mpc.learning"


def _play(scenario: Scenario, spec: ControllerSpec, setting: Setting) -> Played:
    """As many trips as stated, each foreseeing what the ones before have learned."""
    given = spec.parameters
    inner = spec.model_copy(update={"law": INNER, "parameters": {k: v for k, v in given.items() if k not in OWN}})
    of = scenario.model_copy(update={"controllers": {NAME: inner}})
    steps, per_sample, _, _ = setting.plan(spec.period_s)
    foreseen = np.zeros(-(-steps // per_sample))
    errors: list[tuple[float, float]] = []
    run: Run | None = None
    for trip in range(int(given["trials"])):
        noisy = replace(setting, sensing=replace(setting.sensing, seed=setting.sensing.seed + trip))
        controller = RecordingMpc(of, inner, NAME, foreseen)
        run = replace(simulate_in(of, NAME, noisy, sampled=controller), title=ENTRANTS[NAME].title)
        found = trial_errors(run, scenario.track.length_m)
        if found is None:
            return Played(replace(run, failed=f"trial {trip + 1}: {run.failed}"), tuple(errors))
        errors.append(found)
        foreseen = learned_from(foreseen, controller.pushed, given["learning_gain"],
                                given["smoothing_s"] / spec.period_s)
    assert run is not None
    return Played(run, tuple(errors))


ENTRANTS = {NAME: Entrant(
    "learning MPC", f"{KINDS[INNER].information}, earlier trials", (
        "horizon_s", "position_weight", "speed_weight", "command_weight", "change_weight", "band_price",
        "observer_gain", *OWN), _play, counts=("trials",), learns=True, predicts=True)}
