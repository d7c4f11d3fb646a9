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


class DoMpc:
    """do-mpc's controller with the same cost, horizon and limits, its defaults otherwise (collocation, ipopt)."""

    def __init__(self, setting: wb.Setting, values: dict[str, float]) -> None:
        do_mpc: Any = importlib.import_module("do_mpc")
        model = do_mpc.model.Model("continuous", "SX")
        names = [*map(str, setting.plant.states)]
        states = [model.set_variable("_x", name) for name in names]
        force = model.set_variable("_u", "F")
        rates = setting.plant.to_casadi(values)(0, ca.vertcat(*states), force, ca.DM.zeros(0))
        for i, name in enumerate(names):
            model.set_rhs(name, rates[i])
        model.setup()
        mpc = do_mpc.controller.MPC(model)
        mpc.settings.n_horizon, mpc.settings.t_step = HORIZON, PERIOD_S
        mpc.settings.store_full_solution = False
        mpc.settings.supress_ipopt_output()
        stage = states[0] ** 2 + 10 * states[1] ** 2
        mpc.set_objective(lterm=stage + 0.01 * force**2, mterm=10 * stage)
        mpc.set_rterm(F=0.0)
        mpc.bounds["lower", "_u", "F"], mpc.bounds["upper", "_u", "F"] = -15.0, 15.0
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
    """Closed-loop cost and processor time, both controllers on the same plant."""
    setting, values = cart_pole()
    how = wb.PlantMpc(HORIZON, {"x": 1.0, "theta": 10.0}, {"F": 0.01}, terminal_weight=10.0)
    builds: dict[str, Callable[[Any, float], Any]] = {"workbench": how.build}
    if importlib.util.find_spec("do_mpc") is None:
        print("cart and pole, do-mpc: left out, not installed (pip install do-mpc)")
    else:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            importlib.import_module("do_mpc")
        builds["do-mpc"] = lambda given, period: DoMpc(given, values)
    seconds = {}
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
        seconds[name] = float(np.median(taken))
        print(f"cart and pole, {name}: closed-loop cost {found.metrics['cost']:.4g}, ends at theta "
              f"{found.metrics['theta_error_final']:.3g} rad; median {np.median(taken) * 1e3:.2f} ms a sample, largest "
              f"{max(taken) * 1e3:.1f} ms")
    if len(seconds) == 2:
        print(f"cart and pole: do-mpc takes {seconds['do-mpc'] / seconds['workbench']:.1f} times as long a sample")


if __name__ == "__main__":
    asked = sys.argv[1:] or ["c", "mpc"]
    if "c" in asked:
        against_c()
    if "mpc" in asked:
        against_do_mpc()
