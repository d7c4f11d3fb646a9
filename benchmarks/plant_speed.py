"""How fast any plant runs: the generated loop against hand-written C, and tracking MPC against do-mpc.

python benchmarks/plant_speed.py [c] [mpc]   (both unless one is named)

Seconds are of processor time, the least of several runs. C is compiled by gcc -O2, and left out with a word where there
is none; do-mpc likewise where it is not installed.
"""

from __future__ import annotations

import ctypes
import importlib.util
import shutil
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import sympy as sp

import workbench as wb
from workbench.simulate.plants.run import Entrant, PlantRun, run

C_SOURCE = """
#include <math.h>
void swing(double *x, double g, double l, double h, long steps) {
  double th = x[0], om = x[1];
  for (long k = 0; k < steps; k++) {
    double a0 = om, a1 = -g / l * sin(th);
    double b0 = om + 0.5 * h * a1, b1 = -g / l * sin(th + 0.5 * h * a0);
    double c0 = om + 0.5 * h * b1, c1 = -g / l * sin(th + 0.5 * h * b0);
    double d0 = om + h * c1, d1 = -g / l * sin(th + h * c0);
    th += h / 6.0 * (a0 + 2.0 * b0 + 2.0 * c0 + d0);
    om += h / 6.0 * (a1 + 2.0 * b1 + 2.0 * c1 + d1);
  }
  x[0] = th; x[1] = om;
}
"""
STEPS, STEP_S, START = 1_000_000, 1e-3, 0.3
CATCH_S, PERIOD_S, HORIZON = 4.0, 0.05, 40


def least(work: Callable[[], Any], times: int = 7) -> float:
    """The least processor time of several calls, seconds."""
    found = []
    for _ in range(times):
        before = time.process_time()
        work()
        found.append(time.process_time() - before)
    return min(found)


def against_c() -> None:
    """Nanoseconds a Runge-Kutta step of the pendulum."""
    theta, omega, torque = sp.symbols("theta omega tau", real=True)
    g, length = sp.symbols("g l", positive=True)
    pendulum = wb.Plant("pendulum", (theta, omega), (omega, -g / length * sp.sin(theta)), inputs=(torque,),
                        parameters=(wb.Parameter(g, 9.81), wb.Parameter(length, 0.5)))
    setting = wb.Setting(pendulum, STEPS * STEP_S, STEP_S, initial={"theta": START})
    entrant = wb.entrant(wb.Law("free", {torque: 0}), 0.01)
    found: list[PlantRun] = [run(setting, entrant)]
    ours = least(lambda: found.append(run(setting, entrant)))
    print(f"pendulum, workbench: {ours / STEPS * 1e9:.1f} ns a step (a sampled law, a metric and the log with it)")
    if shutil.which("gcc") is None:
        print("pendulum, C: left out, no gcc here")
        return
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "swing.c", Path(folder) / "swing.so"
        source.write_text(C_SOURCE)
        subprocess.run(["gcc", "-O2", "-shared", "-fPIC", str(source), "-o", str(library), "-lm"], check=True)
        swing = ctypes.CDLL(str(library)).swing
        state = (ctypes.c_double * 2)()

        def by_hand() -> None:
            state[0], state[1] = START, 0.0
            swing(state, ctypes.c_double(9.81), ctypes.c_double(0.5), ctypes.c_double(STEP_S), ctypes.c_long(STEPS))

        theirs = least(by_hand)
    apart = abs(state[0] - found[0].log[-1, 1])
    print(f"pendulum, C:         {theirs / STEPS * 1e9:.1f} ns a step; ratio {ours / theirs:.2f}; ends differ by "
          f"{apart:.1e} rad")


def cart_pole() -> tuple[wb.Setting, dict[str, float]]:
    """A pendulum on a cart, to be caught from 0.6 rad; and its parameters.

    From hanging the problem has many local optima, of which the two controllers find different ones.
    """
    x, theta, v, omega, force = sp.symbols("x theta v omega F", real=True)
    M, m, length, g = sp.symbols("M m l g", positive=True)
    s, c = sp.sin(theta), sp.cos(theta)
    D = M + m * s**2
    rates = (v, omega, (force + m * s * (length * omega**2 - g * c)) / D,
             (-force * c - m * length * omega**2 * s * c + (M + m) * g * s) / (length * D))
    values = {"M": 1.0, "m": 0.2, "l": 0.5, "g": 9.81}
    plant = wb.Plant("cart_pole", (x, theta, v, omega), rates, inputs=(force,), input_limits={force: (-15.0, 15.0)},
                     parameters=tuple(wb.Parameter(p, values[str(p)]) for p in (M, m, length, g)))
    cost = x**2 + 10 * (theta**2) + sp.Rational(1, 100) * force**2
    zero = wb.Constant(value=0.0)
    return wb.Setting(plant, CATCH_S, STEP_S, references={"x_d": zero, "theta_d": zero}, initial={"theta": 0.6},
                      tracks={"x": "x_d", "theta": "theta_d"}, metrics=(wb.Metric("cost", "integral", cost),)), values


def quadrotor() -> tuple[wb.Setting, dict[str, float]]:
    """A quadrotor of twelve states, with roll, pitch and yaw, to be brought a metre along all axes."""
    position, angle, speed, turn = (sp.symbols(names, real=True) for names in ("x y z", "phi theta psi", "v_x v_y v_z",
                                                                               "p q r"))
    inputs = thrust, *torques = sp.symbols("f t_x t_y t_z", real=True)
    m, g, j_x, j_y, j_z = sp.symbols("m g j_x j_y j_z", positive=True)
    (phi, theta, psi), (p, q, r) = angle, turn
    s, c = sp.sin, sp.cos
    push = (c(phi) * s(theta) * c(psi) + s(phi) * s(psi), c(phi) * s(theta) * s(psi) - s(phi) * c(psi),
            c(phi) * c(theta))
    forces = tuple(thrust / m * one - (g if i == 2 else 0) for i, one in enumerate(push))
    rates = (*speed, p + (q * s(phi) + r * c(phi)) * s(theta) / c(theta), q * c(phi) - r * s(phi),
             (q * s(phi) + r * c(phi)) / c(theta), *forces, (torques[0] + (j_y - j_z) * q * r) / j_x,
             (torques[1] + (j_z - j_x) * p * r) / j_y, (torques[2] + (j_x - j_y) * p * q) / j_z)
    values = {"m": 1.0, "g": 9.81, "j_x": 0.01, "j_y": 0.01, "j_z": 0.02}
    plant = wb.Plant("quadrotor", (*position, *angle, *speed, *turn), rates, inputs,
                     input_limits={thrust: (0.0, 20.0), **dict.fromkeys(torques, (-0.3, 0.3))},
                     parameters=tuple(wb.Parameter(one, values[str(one)]) for one in (m, g, j_x, j_y, j_z)))
    names = ("x", "y", "z", "psi")
    channels = [wb.Reference(f"{name}_d") for name in names]
    square = sum((one - channel.value) ** 2 for one, channel in zip((*position, psi), channels, strict=True))
    cost = square + ((thrust - values["m"] * values["g"]) ** 2 + sum(one**2 for one in torques)) / 100
    wanted = {f"{name}_d": wb.Constant(value=0.0 if name == "psi" else 1.0) for name in names}
    return wb.Setting(plant, CATCH_S, STEP_S, references=wanted, tracks={name: f"{name}_d" for name in names},
                      metrics=(wb.Metric("cost", "integral", cost),)), values


class DoMpc:
    """do-mpc's controller with the same cost, horizon and limits, its defaults otherwise (collocation, ipopt)."""

    def __init__(self, setting: wb.Setting, values: dict[str, float], how: wb.PlantMpc) -> None:
        do_mpc: Any = importlib.import_module("do_mpc")
        model = do_mpc.model.Model("continuous", "SX")
        plant = setting.plant
        state = {str(symbol): model.set_variable("_x", str(symbol)) for symbol in plant.states}
        given = {str(symbol): model.set_variable("_u", str(symbol)) for symbol in plant.inputs}
        rates = plant.to_casadi(values)(0, ca.vertcat(*state.values()), ca.vertcat(*given.values()), ca.DM.zeros(0))
        for i, name in enumerate(state):
            model.set_rhs(name, rates[i])
        model.setup()
        wanted = {name: setting.references[setting.tracks[name]].value for name in how.weights}
        stage = sum(weight * (state[name] - wanted[name]) ** 2 for name, weight in how.weights.items())
        effort = sum(weight * (given[name] - how.input_targets.get(name, 0.0)) ** 2
                     for name, weight in how.input_weights.items())
        mpc = do_mpc.controller.MPC(model)
        mpc.settings.n_horizon, mpc.settings.t_step = HORIZON, PERIOD_S
        mpc.settings.store_full_solution = False
        mpc.settings.supress_ipopt_output()
        mpc.set_objective(lterm=stage + effort, mterm=how.terminal_weight * stage)
        mpc.set_rterm(**dict.fromkeys(given, 0.0))
        for symbol, (low, high) in plant.input_limits.items():
            mpc.bounds["lower", "_u", str(symbol)], mpc.bounds["upper", "_u", str(symbol)] = low, high
        mpc.setup()
        self._mpc, self._first = mpc, True

    def command(self, t: float, measured: np.ndarray) -> np.ndarray:
        """The input that do-mpc answers with."""
        if self._first:
            self._mpc.x0 = measured
            self._mpc.set_initial_guess()
            self._first = False
        return np.asarray(self._mpc.make_step(measured.reshape(-1, 1))).ravel()


def against_do_mpc() -> None:
    """Closed-loop cost and processor time of the three controllers on the same plants."""
    whole = wb.PlantMpc(HORIZON, {"x": 1.0, "theta": 10.0}, {"F": 0.01}, terminal_weight=10.0)
    _against("cart and pole", *cart_pole(), whole)
    setting, values = quadrotor()
    flight = wb.PlantMpc(HORIZON, dict.fromkeys(setting.tracks, 1.0),
                         {str(one): 0.01 for one in setting.plant.inputs}, terminal_weight=10.0,
                         input_targets={"f": values["m"] * values["g"]})
    _against("quadrotor, 12 states", setting, values, flight)


def _against(title: str, setting: wb.Setting, values: dict[str, float], how: wb.PlantMpc) -> None:
    builds: dict[str, Callable[[Any, float], Any]] = {
        "workbench": how.build, "workbench, one iteration": replace(how, one_iteration=True).build}
    if importlib.util.find_spec("do_mpc") is None:
        print(f"{title}, do-mpc: left out, not installed (pip install do-mpc)")
    else:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            importlib.import_module("do_mpc")
        builds["do-mpc"] = lambda given, period: DoMpc(given, values, how)
    seconds, costs = {}, {}
    for name, build in builds.items():
        made = build(setting, PERIOD_S)
        taken: list[float] = []

        class Timed:
            def command(self, t: float, measured: np.ndarray, made: Any = made, taken: list[float] = taken) -> Any:
                before = time.process_time()
                found = made.command(t, measured)
                taken.append(time.process_time() - before)
                return found

        found = run(setting, Entrant(name, PERIOD_S, build=lambda given, period, timed=Timed: timed()))
        seconds[name], costs[name] = float(np.median(taken)), found.metrics["cost"]
        ends = ", ".join(f"{output} {found.metrics[f'{output}_error_final']:.1e}" for output in setting.tracks)
        print(f"{title}, {name}: closed-loop cost {found.metrics['cost']:.4g}, ends off by {ends}; median "
              f"{np.median(taken) * 1e3:.2f} ms a sample, largest {max(taken) * 1e3:.1f} ms")
    for name in [name for name in seconds if "do-mpc" in seconds and name != "do-mpc"]:
        print(f"{title}: do-mpc takes {seconds['do-mpc'] / seconds[name]:.1f} times as long a sample as {name}, whose "
              f"closed-loop cost is {costs[name] / costs['do-mpc']:.3f} of do-mpc's")


if __name__ == "__main__":
    asked = sys.argv[1:] or ["c", "mpc"]
    if "c" in asked:
        against_c()
    if "mpc" in asked:
        against_do_mpc()
