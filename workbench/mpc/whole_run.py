"""An `MpcController` in a form that a compiled loop drives through a whole run, instead of a call of Python a sample.

All that it works on lies in one array of numbers, which the loop hands to its laws: matrices of the problem, warm
starts, estimates and counters, in the order of BLOCKS. The code that finds them there is made from the same list.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from workbench.compile import views
from workbench.compile.kernel import function_source
from workbench.compile.text import loop_text
from workbench.mpc import adaptive_kernel, whole_run_kernel
from workbench.mpc.adaptive import AdaptiveMpc, TrainEstimator
from workbench.mpc.controller import MpcController
from workbench.mpc.kernels import base, kernels, memory, workspace
from workbench.mpc.learning import STANDING_MPS, RecordingMpc
from workbench.mpc.linear import LinearMpc
from workbench.mpc.model import SOFT, Actuator
from workbench.mpc.nonlinear import MOST_INTERIOR, MOST_PASSES, NonlinearMpc
from workbench.mpc.problem import Array
from workbench.mpc.solution import Tracker
from workbench.mpc.tube import TubeMpc
from workbench.trains.resistance import davis_resistance
from workbench.trains.train import a_star, b_star, c_star, x_2

# Sizes: of the horizon N, of what lies ahead S, of it where the model is linearised once L, of the soft rows R, of
# the commands under way W, of programs and what comes after the last of them C, of what is taken down F, of the samples
# that an equation takes and the one before them P, of what an adaptive MPC sees ahead A.
DIMENSIONS = ("N", "S", "L", "R", "W", "C", "F", "P", "A")
WHOLE = "whole numbers"
BEFORE_ANY = -2  # so that no sample comes after it
BLOCKS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("kind", WHOLE, ("7",)), ("state", WHOLE, ("5",)), ("own", "", ("14",)), ("counts", WHOLE, ("7",)),
    ("ahead", "", ("S", "6")), ("told", "", ("S",)),
    ("along_x", "", ("L", "3")), ("along_u", "", ("L",)), ("along_jac", "", ("L", "12")), ("along_gap", "", ("L", "3")),
    ("along_h", "", ("L", "4")), ("along_g", "", ("L", "4", "3")), ("along_answer", "", ("L", "3")),
    ("parameters", "", ("5",)), ("rest", "", ("5",)), ("left", "", ("5",)), ("weights", "", ("5",)),
    ("terminal", "", ("6",)), ("limits", "", ("4",)), ("rows", WHOLE, ("R",)), ("price", "", ("4", "2")),
    ("gain", "", ("3",)),
    ("fixed", WHOLE, ("N",)), ("soft", WHOLE, ("N + 1", "4")), ("pull", "", ("N + 1", "4")),
    ("Q0", "", ("N + 1", "6")), ("q0", "", ("N + 1", "3")), ("R", "", ("N",)), ("r", "", ("N",)), ("low", "", ("N",)),
    ("high", "", ("N",)), ("bound", "", ("N",)), ("slope", "", ("N",)), ("Q", "", ("N + 1", "6")),
    ("q", "", ("N + 1", "3")), ("kept", "", ("N", "5")), ("dx", "", ("N + 1", "3")), ("du", "", ("N",)),
    ("base_x", "", ("N + 1", "3")), ("tried_x", "", ("N + 1", "3")), ("tried", "", ("N",)), ("jac", "", ("N", "12")),
    ("base_gap", "", ("N", "3")), ("h", "", ("N + 1", "4")), ("g", "", ("N + 1", "4", "3")),
    ("window", "", ("N + 1", "6")), ("gap", "", ("N", "3")), ("plan", "", ("N",)), ("kept_plan", "", ("N",)),
    ("under_way", "", ("W",)), ("unconverged", WHOLE, ("C",)), ("foreseen", "", ("F",)), ("pushed", "", ("F",)),
    ("x", "", ("3",)), ("tube", WHOLE, ("2",)), ("nominal", "", ("7",)), ("learner", WHOLE, ("4",)),
    ("known", "", ("8",)), ("past", "", ("P", "2")), ("estimate", "", ("5",)), ("covariance", "", ("5", "5")),
    ("widest", "", ("5",)), ("learning", "", ("3", "5")), ("acceleration", "", ("A",)), ("model", "", ("5",)),
    ("own_rest", "", ("5",)), ("own_limits", "", ("4",)), ("seen", "", ("A", "6")),
)
# By kind: what finds a block among all numbers.
VIEWS = {"": "floats_at", WHOLE: "integers_at"}
COUNTED = ("qp", "qp_failed", "unconverged", "shifted_plan", "lqr", "feedforward", "bad_measurement")
"""Of `fallback.COUNTERS`, in the order of the kernel; without a deadline nothing is late."""


@dataclass(frozen=True)
class WholeRun:
    """What a compiled loop needs of a controller: the law's source, its parameters, and its numbers, shape (1, n).

    parameters: DIMENSIONS, and the clock; the numbers are written to as the run goes on.
    """

    controller: MpcController
    parameters: Array
    numbers: Array

    def taken_us(self, samples: int) -> Array:
        """What each of the first samples took."""
        ahead = int(self.parameters[DIMENSIONS.index("S")])
        return self.numbers[0, -ahead:][:samples] * 1e6

    def take_over(self) -> None:
        """Give the controller what the run has counted and taken down."""
        found = self._blocks()
        of, fallback = self.controller, self.controller._fallback
        of.counters.update(zip(COUNTED, found["counts"].tolist(), strict=True))
        for programs, times in enumerate(found["unconverged"].tolist()):
            if times:
                fallback.trouble[f"no convergence in {programs} programs"] += times
        if failed := of.counters["qp_failed"]:
            fallback.trouble["the program was not solved" if found["kind"][0] else "a program was not solved"] += failed
        if isinstance(of, RecordingMpc):
            of.pushed[:] = found["pushed"]
        if isinstance(of.tracker, TubeMpc):
            of.counters["beyond_bound"], of._farthest = int(found["tube"][1]), float(found["nominal"][6])
        if isinstance(of.tracker, AdaptiveMpc):
            of.tracker.estimator.estimate[:] = found["estimate"]

    def _blocks(self) -> dict[str, NDArray[Any]]:
        sizes = dict(zip(DIMENSIONS, self.parameters[: len(DIMENSIONS)].astype(int).tolist(), strict=True))
        found, at = {}, 0
        for name, kind, shape in BLOCKS:
            lengths = [_length(text, sizes) for text in shape]
            numbers = self.numbers[0, at : at + math.prod(lengths)]
            found[name] = (numbers.view(np.int64) if kind == WHOLE else numbers).reshape(lengths)
            at += math.prod(lengths)
        return found


def whole_run(controller: object) -> WholeRun | None:
    """The compiled form of a controller that has not been called yet; None for one that has none.

    None has what is more than its solver, a tube or an estimator: a program of casadi's, a deadline, commands that are
    held for several samples; and no machine without the clock that every sample is timed by.
    """
    if type(controller) not in (MpcController, RecordingMpc) or not hasattr(time, "clock_gettime"):
        return None
    assert isinstance(controller, MpcController)
    tracker, fallback = controller.tracker, controller._fallback
    tracker = tracker.nominal if isinstance(tracker, TubeMpc) else tracker
    tracker = tracker.inner if isinstance(tracker, AdaptiveMpc) else tracker
    if type(tracker) not in (LinearMpc, NonlinearMpc) or controller._held_samples != 1 or controller._sample >= 0 or \
            math.isfinite(fallback._deadline_s):
        return None
    assert isinstance(tracker, LinearMpc | NonlinearMpc)
    given = _given(controller, tracker)
    sizes = {"N": tracker.horizon, "S": len(tracker.ahead), "L": len(given["along_x"]), "R": len(given["rows"]),
             "W": len(given["under_way"]), "C": len(given["unconverged"]), "F": len(given["pushed"]),
             "P": len(given["past"]), "A": len(given["seen"])}
    parts = []
    for name, kind, shape in BLOCKS:
        array = np.ascontiguousarray(given[name], dtype=np.int64 if kind == WHOLE else np.float64)
        assert array.shape == tuple(_length(text, sizes) for text in shape), name
        parts.append(array.ravel().view(np.float64))
    clock = np.zeros(2 + sizes["S"])  # two whole numbers, and what each sample took
    parameters = np.array([*(float(sizes[name]) for name in DIMENSIONS), float(time.CLOCK_MONOTONIC)])
    return WholeRun(controller, parameters, np.concatenate([*parts, clock])[np.newaxis])


def _given(controller: MpcController, tracker: LinearMpc | NonlinearMpc) -> dict[str, Any]:
    """The blocks by name, as they are before the first sample."""
    observer, predictor, problem = controller._observer, controller._predictor, controller.problem
    solved = tracker.problem  # within a tube its limits are tighter
    once = isinstance(tracker, LinearMpc)
    programs, close = (1, 0.0) if isinstance(tracker, LinearMpc) else (tracker.most_programs, tracker._close)
    rest_s = predictor.rest_s if predictor else 0.0
    N, low, high = tracker.horizon, problem.lowest_command_mps2, problem.highest_command_mps2
    found: dict[str, Any] = {
        "kind": [once, controller._last_sample, programs, MOST_PASSES, MOST_INTERIOR, predictor is not None,
                 {TubeMpc: 1, AdaptiveMpc: 2}.get(type(controller.tracker), 0)],
        "state": [-1, 0, 0, 0, -1],
        "own": [observer._gain, observer._largest, 0.0, observer.force, 0.0, 0.0, problem.period_s, rest_s, low, high,
                close, 0.0, 0.0, STANDING_MPS],
        "counts": np.zeros(len(COUNTED)), "ahead": tracker.ahead, "told": observer._ahead[:, 5],
        "parameters": problem.parameters, "rest": problem.parameters_over(rest_s),
        "left": problem.parameters_over(problem.period_s - rest_s), "weights": problem.weights.array(),
        "terminal": tracker.lqr.upper(), "limits": solved.limits(), "rows": solved.rows(tracker.ahead),
        "price": solved.price, "gain": tracker.lqr.gain, "window": np.zeros((N + 1, 6)), "gap": np.zeros((N, 3)),
        "plan": np.zeros(N), "kept_plan": np.zeros(N), "unconverged": np.zeros(programs + 1), "x": np.zeros(3),
        "under_way": predictor._under_way if predictor else np.zeros(1),
        "foreseen": controller._foreseen if isinstance(controller, RecordingMpc) else np.zeros(0),
        "pushed": controller.pushed if isinstance(controller, RecordingMpc) else np.zeros(0),
        "tube": [BEFORE_ANY, 0], "nominal": [0.0, 0.0, 0.0, *_feedback(controller.tracker), controller._bound, 0.0],
        "model": problem.parameters, "own_rest": problem.parameters_over(rest_s), "own_limits": problem.limits(),
        **_learned(controller)}
    for name in ("x", "u", "jac", "gap", "h", "g", "answer"):
        shape = {"jac": (0, 12), "h": (0, len(SOFT)), "g": (0, len(SOFT), 3), "u": (0,)}.get(name, (0, 3))
        found[f"along_{name}"] = getattr(tracker.along, name) if isinstance(tracker, LinearMpc) else np.zeros(shape)
    for names, arrays in (("fixed soft pull", memory(N)), ("Q0 q0 R r low high bound slope Q q kept dx du",
                          workspace(N)), ("base_x tried_x tried jac base_gap h g", base(N))):
        found |= dict(zip(names.split(), arrays, strict=True))
    return found


def _feedback(tracker: Tracker) -> Array:
    return tracker.around.gain if isinstance(tracker, TubeMpc) else np.zeros(2)


def _learned(controller: MpcController) -> dict[str, Array]:
    """The blocks of an estimator, as it stands before the first sample; empty ones without one."""
    tracker = controller.tracker
    of = tracker.estimator if isinstance(tracker, AdaptiveMpc) else TrainEstimator(controller.problem.davis, 1.0)
    seen = tracker.inner.ahead if isinstance(tracker, AdaptiveMpc) else np.zeros((0, 6))
    acceleration = tracker.acceleration if isinstance(tracker, AdaptiveMpc) else np.zeros(0)
    return {name: getattr(of, name) for name in ("learner", "known", "past", "estimate", "covariance", "widest",
                                                 "learning")} | {"seen": seen, "acceleration": acceleration}


def _length(text: str, sizes: dict[str, int]) -> int:
    name, plus, more = text.partition(" + ")
    return (int(name) if name.isdigit() else sizes[name]) + int(more if plus else 0)


def source(actuator: Actuator) -> tuple[str, ...]:
    """Python source of the law of a whole run, as `written_loop` takes it, for the model with one actuator."""
    names = "follow, shift, solve_linear, solve_nonlinear"
    lines = [f"    {name} = int(parameters[{i}])" for i, name in enumerate(f"_{name}" for name in DIMENSIONS)]
    lines += ["    _numbers = neuron_data[0]", "    _at = 0"]
    for name, kind, shape in BLOCKS:
        sizes = [text if text.isdigit() else f"(_{text})" for text in shape]
        lines += [f"    {name} = {VIEWS[kind]}(_numbers, _at, ({', '.join(sizes)},))",
                  f"    _at += {' * '.join(sizes)}"]
    law = ["def control_step(_t, _p, _v, _x_d, _v_d, _a_d, _period, parameters, scalars, neurons, neuron_data):",
           *lines,
           "    _clock = integers_at(_numbers, _at, (2,))", "    _sample = int(round(_t / _period))",
           f"    _which = int(parameters[{len(DIMENSIONS)}])", "    _started = nanoseconds_now(_which, _clock)",
           f"    _command = command_of(_sample, _p, _v, {', '.join(name for name, _, _ in BLOCKS)})",
           "    _numbers[_at + 2 + min(_sample, _S - 1)] = 1e-9 * (nanoseconds_now(_which, _clock) - _started)",
           "    return _command", "", ""]
    # What is kept of the code is known by its text, in which that of the views does not stand.
    imports = [f"# views.py: {views.DIGEST}", "from numba import types",
               f"from {views.__name__} import {', '.join(VIEWS.values())}",
               f"from {kernels(actuator).__name__} import {names}",
               "clock_gettime = types.ExternalFunction('clock_gettime', types.intc(types.intc, "
               "types.CPointer(types.int64)))", "", ""]
    resistance = function_source("resistance_at", (x_2,), (a_star, b_star, c_star),
                                 [davis_resistance(x_2, a_star, b_star, c_star)])
    return ("\n".join(imports), resistance, loop_text(adaptive_kernel), loop_text(whole_run_kernel),
            "\n".join(law))
