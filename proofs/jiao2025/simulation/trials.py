"""Runs of a law that learns from trial to trial: what a run needs, and what it leaves."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import function_source, loop_module

from .. import laws, plant
from ..laws import TRIAL_LAWS
from . import trial_loop
from .trial_loop import MOST_SPEED_MPS, SAMPLE_COLUMNS, SEEN_BY, TRIAL_COLUMNS, WORKING

Array = NDArray[np.float64]

_PLANT = (plant.T_s, plant.M, plant.unit, plant.divisor)
_DATA = (plant.u_prev, laws.phi_prev, laws.phi_first, laws.Delta_u, laws.Delta_v, laws.e_next, laws.e_now,
         laws.gamma, laws.gamma_prev2)


@dataclass(frozen=True)
class TrialPlan:
    """All that a run needs.

    law: its id; parameters: the law's, by name; lengths: samples of trial 0, 1, ... (whole samples, at most those
    of the desired curve); desired: v_d in m/s at every sample; desired_positions: of the desired trip, in m;
    edges, additional_n: sections of the line in m and their resistance in N; seen_by: which of SEEN_BY; step_s: T_s;
    unit_n: N per unit of u; divisor: of (17); opposed: whether (3) opposes the motion backwards too;
    k_per_sample: by how much the k of (16) and (17) grows in a sample; kept: trials whose samples are kept.
    """

    law: str
    parameters: Mapping[str, float]
    lengths: NDArray[np.int64]
    first_input: float
    first_estimate: float
    desired: Array
    desired_positions: Array
    edges: Array
    additional_n: Array
    seen_by: str
    step_s: float
    mass_kg: float
    unit_n: float
    divisor: float
    opposed: bool
    k_per_sample: float
    kept: tuple[int, ...] = ()


@dataclass(frozen=True)
class TrialRun:
    """What a run left: a row of TRIAL_COLUMNS for every trial that ended, samples of the kept ones among them.

    samples: trial -> rows of SAMPLE_COLUMNS, up to where it ended; failed: why the run ended early, if it did;
    step_us: time of a sample, the train and the learning together, compiling and loading left out.
    """

    law: str
    rows: Array
    samples: dict[int, Array]
    failed: str | None
    step_us: float

    @property
    def mse(self) -> Array:
        """Mean squared error of every trial that ended, in m^2/s^2."""
        return self.column("mse")

    def column(self, name: str) -> Array:
        """One of TRIAL_COLUMNS, trial by trial."""
        return self.rows[:, TRIAL_COLUMNS.index(name)]

    def sample(self, trial: int, name: str) -> Array:
        """One of SAMPLE_COLUMNS of a kept trial, sample by sample."""
        return self.samples[trial][:, SAMPLE_COLUMNS.index(name)]


@cache
def trial_kernel(law_id: str, opposed: bool) -> ModuleType:
    """The compiled loop of a law with the train, and its `learn_trial`."""
    law = TRIAL_LAWS[law_id]
    speed = plant.step_speed_opposed if opposed else plant.step_speed
    return loop_module(f"{law.source} and jiao2025 (1)-(3), (17)", [
        function_source("step_speed", (plant.v_i, plant.u_i, plant.f_a, plant.k), _PLANT, [speed]),
        function_source("step_position", (plant.s_i, plant.v_i), _PLANT, [plant.step_position]),
        function_source("learn", _DATA, law.parameters, [law.next_input, law.next_estimate]),
    ], trial_loop)


def run_trials(plan: TrialPlan) -> TrialRun:
    """Run all trials of a plan; one that diverges ends the run, which then says where.

    Raises KeyError for an unknown law or parameter, ValueError for an unknown rule of the line.
    """
    law = TRIAL_LAWS[plan.law]
    whole = len(plan.desired) - 1
    lengths = np.asarray(plan.lengths, dtype=np.int64)
    rows = np.zeros((len(lengths), len(TRIAL_COLUMNS)))
    samples = np.zeros((len(plan.kept), whole + 1, len(SAMPLE_COLUMNS)))
    kernel = trial_kernel(plan.law, plan.opposed).trials
    arguments = (
        plan.first_input, plan.first_estimate, plan.k_per_sample, plan.desired, plan.desired_positions,
        SEEN_BY.index(plan.seen_by), plan.edges, plan.additional_n,
        np.array([plan.step_s, plan.mass_kg, plan.unit_n, plan.divisor]),
        np.array([plan.parameters[str(s)] for s in law.parameters], dtype=float), MOST_SPEED_MPS,
        np.array(plan.kept, dtype=np.int64), np.zeros((WORKING, whole + 1)), rows, samples)
    kernel(lengths[:0], *arguments)  # no trial at all, so that compiling and loading are not timed
    started = time.perf_counter()
    finished, at, speed, command = kernel(lengths, *arguments)
    seconds = time.perf_counter() - started
    failed = None
    if finished < len(lengths):
        failed = (f"{plan.law} diverged in trial {finished} at sample {at + 1} (t = {(at + 1) * plan.step_s:.3f} s): "
                  f"v = {speed:.3g} m/s under u = {command:.3g}")
    return TrialRun(
        plan.law, rows[:finished],
        {i: samples[place, : lengths[i] + 1] for place, i in enumerate(plan.kept) if i < finished}, failed,
        seconds * 1e6 / (int(lengths[:finished].sum()) + at + 1))
