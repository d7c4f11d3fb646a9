"""A run of jiao2025's study as a plan: a law in a reading of the units, on drawn lengths, with what the study states."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from workbench.compile.kernel import numeric
from workbench.paper.reproduced import STATED
from workbench.simulate.closed_loop import Factors

from .. import laws, plant
from ..laws import TRIAL_LAWS
from .trials import Array, TrialPlan

if TYPE_CHECKING:
    from ..study.record import JiaoStudy, Reading, Trials

GRAVITY = 9.80665
_speed_at = numeric((plant.k,), plant.desired_curve)
_additional = numeric((plant.slope_coefficient, plant.slope_angle), plant.additional_resistance)


@dataclass(frozen=True)
class Case:
    """One run: reading, law, seed of the lengths, number of the change, another unit of u in m/s^2.

    opposed: whether (3) opposes the motion backwards too, as it does not as printed.
    """

    reading: str
    law: str
    seed: int
    change: int = STATED
    unit_mps2: float | None = None
    opposed: bool = False


def plan(study: JiaoStudy, case: Case) -> TrialPlan:
    """The plan of one run."""
    study = study.changed(case.change)
    reading, mass = study.readings[case.reading], study.train.mass_kg
    unit_n = reading.unit_n if case.unit_mps2 is None else case.unit_mps2 * mass
    desired, positions = desired_trip(study, reading)
    law = TRIAL_LAWS[case.law]
    learning = study.learning
    estimate = learning.kept_estimate if law is laws.fixed_estimate else learning.first_estimate
    fractions = [0.0, *(section.end_fraction for section in study.line.sections)]
    slope = np.arctan([section.grade_permille * 1e-3 for section in study.line.sections])
    return TrialPlan(
        law=case.law, parameters={str(s): getattr(learning, str(s)) for s in law.parameters},
        lengths=lengths(study.trials, case.seed) * reading.per_k if law.random_lengths
        else np.full(study.trials.count + 1, len(desired) - 1, dtype=np.int64),
        first_input=learning.first_input,
        first_estimate=reading.step_s * unit_n / mass if estimate == "derivative" else float(estimate),
        desired=desired, desired_positions=positions, edges=np.array(fractions) * positions[-1],
        additional_n=np.asarray(_additional(mass * GRAVITY, slope), dtype=float), seen_by=study.line.seen_by,
        step_s=reading.step_s, mass_kg=mass, unit_n=unit_n,
        divisor=mass if study.train.resistance == "as_printed" else 1.0,
        opposed=case.opposed, k_per_sample=reading.k_per_sample, kept=_kept(study, case))


def _kept(study: JiaoStudy, case: Case) -> tuple[int, ...]:
    """The trials of which figures show every sample, and the last, whose jerk is held against that of MPC."""
    stated = case == Case(case.reading, case.law, study.trials.seed)
    drawn = {(entry.reading, entry.law) for entry in study.shown}
    shown = {*study.trials.compared, *study.trials.line_shown} if (case.reading, case.law) in drawn else set()
    return tuple(sorted(shown | {study.trials.count})) if stated else ()


def plan_on(study: JiaoStudy, case: Case, factors: Factors) -> TrialPlan:
    """The plan of a run on a train whose mass and resistance (`davis_a`) differ by factors from what is stated."""
    train = study.train.model_copy(update={"mass_kg": study.train.mass_kg * factors.mass})
    of = plan(study.model_copy(update={"train": train}), case)
    return replace(of, divisor=of.divisor / factors.davis_a)


def lengths(trials: Trials, seed: int) -> NDArray[np.int64]:
    """T_0, T_1, ...: uniform from above the shortest length up to the desired one, in the k of (16)."""
    drawn = np.random.default_rng(seed).integers(trials.shortest_length_k, trials.desired_length_k, trials.count + 1)
    return drawn + 1


def desired_trip(study: JiaoStudy, reading: Reading) -> tuple[Array, Array]:
    """(16) at every sample in m/s, and the positions in m of a train that follows it."""
    samples = np.arange(study.trials.desired_length_k * reading.per_k + 1)
    speed = np.asarray(_speed_at(samples * reading.k_per_sample), dtype=float)
    return speed, np.concatenate(([0.0], np.cumsum(speed[:-1]))) * reading.step_s
