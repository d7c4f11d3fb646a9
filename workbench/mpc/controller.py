"""The MPC family as controllers of a scenario: called once a sample, they answer with a command and count troubles."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from workbench.errors import InputError
from workbench.mpc.adaptive import AdaptiveMpc
from workbench.mpc.economic import Prices, economic_mpc
from workbench.mpc.fallback import Fallback
from workbench.mpc.linear import LinearMpc
from workbench.mpc.nonlinear import NonlinearMpc
from workbench.mpc.offset_free import Observer
from workbench.mpc.predictor import Predictor, told
from workbench.mpc.preview import preview
from workbench.mpc.problem import Array, Problem, Weights
from workbench.mpc.solution import Tracker
from workbench.mpc.tube import TubeMpc, checked_tube
from workbench.trains.scenario import ControllerSpec, Scenario
from workbench.trains.track import resistance_table

# A train is nowhere near these, so a measurement beyond them is no measurement.
FARTHEST_M, FASTEST_MPS = 1e9, 1e4

Values = dict[str, float]


def _linear(problem: Problem, ahead: Array, values: Values, start_m: float) -> LinearMpc:
    del values, start_m
    return LinearMpc(problem, ahead)


def _nonlinear(problem: Problem, ahead: Array, values: Values, start_m: float) -> NonlinearMpc:
    del values, start_m
    return NonlinearMpc(problem, ahead)


def _economic(problem: Problem, ahead: Array, values: Values, start_m: float) -> Tracker:
    del start_m
    prices = Prices(values["energy_price"], values["time_price"], values["regenerated"])
    return economic_mpc(problem, ahead, prices)


def _tube(problem: Problem, ahead: Array, values: Values, start_m: float) -> TubeMpc:
    return TubeMpc(problem, ahead, checked_tube(problem, ahead, values["disturbance_mps2"], start_m))


def _adaptive(problem: Problem, ahead: Array, values: Values, start_m: float) -> Tracker:
    del start_m
    return AdaptiveMpc(problem, ahead, values["forgetting"])


@dataclass(frozen=True)
class Kind:
    """One of the family: what it is called, what it knows, how it solves, and the parameters beside COMMON.

    told_grades: and curves and tunnels. follows_curve: within the band; one that does not keeps the line's speed limits
    instead, and takes from the curve when and where it is to arrive. tracker: of the problem, what lies ahead, the
    parameters, and how far from the curve the train starts (m).
    """

    title: str
    information: str
    tracker: Callable[[Problem, Array, Values, float], Tracker]
    parameters: tuple[str, ...] = ()
    told_grades: bool = False
    follows_curve: bool = True

    def __call__(self, scenario: Scenario, spec: ControllerSpec, name: str) -> MpcController:
        """A controller of this kind."""
        return MpcController(scenario, spec, name)


COMMON = ("horizon", "position_weight", "speed_weight", "command_weight", "change_weight", "band_price")
# held_samples: how many samples of the loop a command is held for; the period of the problem is so many of the loop's.
OPTIONAL = {"deadline_s": math.inf, "held_samples": 1.0}
KINDS: dict[str, Kind] = {
    "mpc.linear": Kind("linear MPC", "full state, nominal model", _linear),
    "mpc.nonlinear": Kind("nonlinear MPC", "full state, nominal model", _nonlinear),
    "mpc.offset_free": Kind("offset-free nonlinear MPC", "full state, nominal model", _nonlinear, ("observer_gain",)),
    "mpc.told": Kind("offset-free nonlinear MPC, told the grades", "full state, nominal model, the line", _nonlinear,
                     ("observer_gain",), told_grades=True),
    "mpc.adaptive": Kind("adaptive MPC", "full state, nominal model at the start", _adaptive, ("forgetting",)),
    "mpc.economic": Kind("economic MPC", "full state, nominal model, the line", _economic,
                         ("observer_gain", "energy_price", "time_price", "regenerated"), told_grades=True,
                         follows_curve=False),
    "mpc.tube": Kind("tube MPC", "full state, nominal model, bound of the disturbance", _tube, ("disturbance_mps2",)),
}


class MpcController:
    """One of KINDS on a scenario's train; raises InputError for parameters that are missing, unknown or unfit.

    learned: pushes (m/s^2) that it foresees beside what it is told, one a sample of the problem.
    `command` never raises and never answers NaN; `counters` and `explain` say what went otherwise than planned.
    """

    def __init__(self, scenario: Scenario, spec: ControllerSpec, name: str, learned: Array | None = None) -> None:
        kind, where = KINDS[spec.law], f"controllers.{name}.parameters"
        values = _checked(_with_horizon(spec, where), kind, where)
        train, curve = scenario.train, scenario.desired_curve()
        self._held_samples, self._loop_period_s, self._held = int(values["held_samples"]), spec.period_s, 0.0
        try:
            price = (values["band_price"], 0.0)
            self.problem = Problem(
                horizon=_whole(values["horizon"]),
                period_s=spec.period_s * self._held_samples,
                davis=(train.davis_a_mps2, train.davis_b_per_s, train.davis_c_per_m),
                lowest_command_mps2=-train.max_braking_n / train.mass_kg,
                highest_command_mps2=train.max_traction_n / train.mass_kg,
                weights=Weights(position=values["position_weight"], speed=values["speed_weight"],
                                command=values["command_weight"], change=values["change_weight"]),
                power_w_per_kg=train.max_power_w / train.mass_kg if train.max_power_w else math.inf,
                band_m=scenario.simulation.position_band_m if kind.follows_curve else math.inf, price=(price,) * 4,
                terminal_speed_mps=float(curve.at(np.linspace(0, curve.trip_time_s, 100))[1].max()))
            duration = curve.trip_time_s + scenario.simulation.dwell_s
            line = resistance_table(scenario.track, train.length_m) if kind.told_grades else None
            kept = () if kind.follows_curve else scenario.track.speed_limit
            late_s = 0.0
            if spec.predictor and scenario.actuator is not None:
                if kind.tracker is _tube:  # whose promise is of states as measured
                    raise InputError("", "predictor", f"'{spec.law}' cannot be told of an actuator: leave it out")
                self.problem, late_s = told(self.problem, scenario.actuator)
            self.ahead = preview(self.problem, curve, duration, line=line, limits=kept, late_s=late_s, learned=learned)
            now = preview(self.problem, curve, duration, line=line, learned=learned) if late_s else self.ahead
            start = scenario.simulation.initial_position_m - float(self.ahead[0, 0])
            tracker = kind.tracker(self.problem, self.ahead, values, start)
            self._observer = Observer(self.problem, now, values.get("observer_gain", 0.0))
        except InputError as trouble:
            raise InputError("", f"{where}: {trouble.key}", trouble.problem) from None
        self._predictor: Predictor | None = None
        if spec.predictor and scenario.actuator is not None:
            self._predictor = Predictor(self.problem, now[:, 5], late_s)
            self._observer.force = 0.0  # an actuator starts at rest
        limits = (self.problem.lowest_command_mps2, self.problem.highest_command_mps2)
        self._fallback = Fallback(tracker, tracker.lqr, self.ahead, limits, values["deadline_s"])
        self.title, self.information, self.counters = kind.title, kind.information, self._fallback.counters
        self.tracker = tracker
        self._bound, self._farthest = math.inf, 0.0
        if isinstance(tracker, TubeMpc):
            self._bound = tracker.around.disturbance_mps2 * (1 + 1e-6) + 1e-9
            self.counters["premises_failed"] = sum(not premise.holds for premise in tracker.around.premises)
            self.counters["beyond_bound"] = 0
        self._last_sample, self._sample = len(self.ahead) - self.problem.horizon - 1, -1

    def explain(self) -> list[str]:
        """A line for everything that went otherwise than planned, and for every premise of a tube that fails."""
        premises = self.tracker.around.report() if isinstance(self.tracker, TubeMpc) else []
        lines = [line for line in premises if line.startswith("FAILS")]
        if beyond := self.counters.get("beyond_bound", 0):
            lines.append(f"beyond_bound: {beyond} (samples over which the train was pushed by more than the stated "
                         f"bound, by up to {self._farthest:.3g} m/s^2)")
        return lines + self._fallback.explain()

    def command(self, time_s: float, position_m: float, speed_mps: float) -> float:
        """The command u = F/m in m/s^2 for the sample at time_s."""
        position_m, speed_mps = float(position_m), float(speed_mps)  # numpy's scalars are slow to count with
        good = math.isfinite(time_s) and abs(position_m) < FARTHEST_M and abs(speed_mps) < FASTEST_MPS
        if math.isfinite(time_s) and round(time_s / self._loop_period_s) % self._held_samples:
            return self._held
        k = round(time_s / self.problem.period_s) if math.isfinite(time_s) else self._sample + 1
        k = self._sample = min(max(k, 0), self._last_sample)
        if good:
            disturbance = self._observer.correct(speed_mps)
            if abs(self._observer.surprise) > self._bound:
                self.counters["beyond_bound"] += 1
                self._farthest = max(self._farthest, abs(self._observer.surprise))
            state = np.array([position_m, speed_mps, self._observer.force])
            if isinstance(self.tracker, AdaptiveMpc) and self.tracker.learn(k, speed_mps, self._observer.force):
                train = self.tracker.estimator
                if self._predictor:
                    self._predictor.drive(train.davis, train.gain, train.push)
            if self._predictor:
                state = self._predictor.ahead(k, state, disturbance)
            answer = self._fallback.command(k, state, disturbance)
        else:
            answer = self._fallback.command(k, None, self._observer.disturbance)
        before, acts = self._predictor.acting(answer) if self._predictor else (answer, answer)
        self._observer.predict(k, speed_mps if good else None, acts,
                               (before, self._predictor.rest_s) if self._predictor else None)
        self._held = answer
        return answer


def _with_horizon(spec: ControllerSpec, where: str) -> Values:
    """The parameters with `horizon_s`, where that is given, in samples of the plan: for a law at several periods."""
    given = dict(spec.parameters)
    if (seconds := given.pop("horizon_s", None)) is None:
        return given
    if "horizon" in given:
        raise InputError("", where, "horizon and horizon_s are both stated: leave one of the two out")
    return given | {"horizon": float(round(seconds / (spec.period_s * given.get("held_samples", 1.0))))}


def _whole(horizon: float) -> int:
    """The horizon as a number of samples; InputError where it is none."""
    if not (math.isfinite(horizon) and horizon == int(horizon)):
        raise InputError("", "horizon", f"{horizon:g} is no whole number: give the number of samples predicted")
    return int(horizon)


def _checked(given: Values, kind: Kind, where: str) -> Values:
    wanted = (*COMMON, *kind.parameters)
    for key in wanted:
        if key not in given:
            raise InputError("", where, f"'{key}' is missing: add it")
    for key in given:
        if key not in (*wanted, *OPTIONAL):
            raise InputError("", where, f"unknown '{key}': choose among {', '.join((*wanted, *OPTIONAL))}")
    values = OPTIONAL | given
    if not values["deadline_s"] > 0:
        raise InputError("", where, f"deadline_s = {values['deadline_s']:g} must be positive: leave it out for none")
    if not (1 <= values["held_samples"] <= 1000 and values["held_samples"] == int(values["held_samples"])):
        raise InputError("", where, f"held_samples = {values['held_samples']:g} is no whole number from 1 to 1000: "
                         "leave it out for a command every sample")
    return values
