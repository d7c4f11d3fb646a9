"""MPC in a study's own scenario: what it knows of the train, its runs in the study's setting, who is best."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Any

from pydantic import Field, Strict

from workbench.files.numbers import number
from workbench.files.toml import NonNegative, Positive, SourcedRecord
from workbench.model.desired_curve import DesiredCurve
from workbench.mpc.controller import KINDS, MpcController
from workbench.simulate.closed_loop import Factors, Run, Setting, simulate_in
from workbench.trains.scenario import ControllerSpec, Interval, Scenario, Simulation
from workbench.trains.train import Plant
from workbench.trains.train_record import Train

# Offset-free MPC has an observer, the linear one has none and costs the least.
MPC_KINDS = ("mpc.linear", "mpc.offset_free")
# Over plant steps, and over the rows of a log, which misses what happens between them.
JERK = ("jerk_rms", "logged_jerk_rms")
# Whose speed errs by more (RMS) does not follow: a train that stands still has no jerk.
FOLLOWS_MPS = 1.0


class MpcData(SourcedRecord):
    """MPC in a study: sampling, horizon, weights as in `mpc.controller`, and limits that it knows.

    band_m: beyond which position errors are priced.
    """

    period_s: Interval
    horizon: Annotated[int, Strict(), Field(ge=2, le=200)]
    position_weight: Positive
    speed_weight: Positive
    command_weight: Positive
    change_weight: NonNegative
    band_price: NonNegative
    band_m: Positive
    observer_gain: Annotated[float, Strict(), Field(gt=0, le=1, allow_inf_nan=False)]
    max_traction_mps2: Annotated[float, Strict(), Field(gt=0, le=20, allow_inf_nan=False)]
    max_braking_mps2: Annotated[float, Strict(), Field(gt=0, le=20, allow_inf_nan=False)]


class _OnCurve(Scenario):
    """A scenario whose desired curve is given, made by `known` alone."""

    drawn: Any = None

    def desired_curve(self) -> DesiredCurve:
        """The given curve."""
        found: DesiredCurve = self.drawn
        return found


def known(data: MpcData, curve: DesiredCurve, mass_kg: float, davis_n: tuple[float, float, float],
          end_s: float) -> Scenario:
    """What MPC knows: the nominal train on a level line, the desired curve, limits; a controller per kind."""
    a, b, c = (value / mass_kg for value in davis_n)
    train = Train.model_construct(
        mass_kg=mass_kg, davis_a_mps2=a, davis_b_per_s=b, davis_c_per_m=c, max_power_w=None,
        max_traction_n=data.max_traction_mps2 * mass_kg, max_braking_n=data.max_braking_mps2 * mass_kg)
    common = {"horizon": float(data.horizon), "band_price": data.band_price, **{
        f"{name}_weight": getattr(data, f"{name}_weight") for name in ("position", "speed", "command", "change")}}
    controllers = {}
    for kind in MPC_KINDS:
        given = common | dict.fromkeys(KINDS[kind].parameters, data.observer_gain)
        controllers[kind] = ControllerSpec.model_construct(
            law=kind, title=None, period_s=data.period_s, estimates="corrected", initial={}, neurons=None,
            parameters=given)
    simulation = Simulation.model_construct(position_band_m=data.band_m,
                                            dwell_s=max(0.0, end_s - curve.trip_time_s))
    return _OnCurve.model_construct(name="mpc", train=train, simulation=simulation, controllers=controllers,
                                    drawn=curve)


def controller(of: Scenario, kind: str) -> MpcController:
    """An MPC of a kind, for a study whose loop is its own."""
    return MpcController(of, of.controllers[kind], kind)


def differing(setting: Setting, factors: Factors) -> Setting:
    """The setting of a train whose mass and resistance, in every mode, differ by factors."""
    of_davis = (factors.davis_a, factors.davis_b, factors.davis_c)
    a, b, c = (value * factor for value, factor in zip(setting.davis_n, of_davis, strict=True))
    changes = setting.changes.copy()
    changes[:, 1:4] *= of_davis
    return replace(setting, mass_kg=setting.mass_kg * factors.mass, davis_n=(a, b, c), changes=changes)


def run_mpc(of: Scenario, kind: str, setting: Setting, plant: Plant | None = None) -> Run:
    """MPC in a study's setting, under the limits that it knows."""
    train = of.train
    limits = (train.max_traction_n, train.max_braking_n, setting.limits[2])
    return simulate_in(of, kind, replace(setting, nominal_mass_kg=train.mass_kg, limits=limits), plant)


def follows(row: Mapping[str, Any]) -> bool:
    """Whether a run follows the desired curve at all; else its comfort says nothing."""
    return row["failed"] is None and row["speed_rms"] <= FOLLOWS_MPS


def best_words(rows: Sequence[tuple[str, Mapping[str, Any]]], metric: str, what: str, unit: str) -> str:
    """Who has the smallest of a metric among (name, row), and the next one behind it, in a sentence's words.

    In jerk those that do not follow the desired curve are left out.
    """
    able = sorted((abs(row[metric]), name) for name, row in rows
                  if row["failed"] is None and (metric not in JERK or follows(row)))
    if not able:
        return f"no run that ends and follows has a {what}" if metric in JERK else "no run ends"
    words = f"{able[0][1]} has the smallest {what}, {number(able[0][0])} {unit}"
    return words + (f", then {able[1][1]} with {number(able[1][0])} {unit}" if len(able) > 1 else "")


def counter_name(key: str) -> str:
    """What a controller counts, by its key: `qp_failed` is quadratic programs failed."""
    return key.replace("_", " ").replace("qp", "quadratic programs").replace("lqr", "LQR")


def counters_words(counters: Sequence[Mapping[str, int]]) -> str:
    """What MPC counted in all runs, for a note."""
    total: dict[str, int] = {}
    for of_run in counters:
        for key, count in of_run.items():
            total[key] = total.get(key, 0) + count
    told = (f"{counter_name(key)} {number(count)}" for key, count in sorted(total.items()) if count)
    return ", ".join(told) or "nothing"
