"""Problems and closed loops that the tests of MPC share."""

import numpy as np

from workbench.model.desired_curve import start_cruise_stop
from workbench.mpc.model import model
from workbench.mpc.preview import preview
from workbench.mpc.problem import Problem, Weights

PRICE = 1e3
# Acceleration of the desired run and power, W/kg: what binds, and for how long.
LOADS = {"nothing": (0.3, 30.0), "power, a little": (0.4, 8.0), "power, for long": (0.7, 8.0)}


def problem_of(horizon=20, actuator="lag", load="power, a little", **changes):
    """A problem and what lies ahead of it, 2 min long."""
    acceleration, power = LOADS[load]
    values = {
        "horizon": horizon, "period_s": 0.5, "davis": (0.02, 4e-4, 4.8e-5), "lowest_command_mps2": -1.0,
        "highest_command_mps2": 1.0, "weights": Weights(position=1.0, speed=1.0, command=1.0, change=0.2),
        "actuator": actuator, "lag_s": 0.5, "power_w_per_kg": power, "price": ((PRICE, 0.0),) * 4,
        "terminal_speed_mps": 20.0}
    problem = Problem(**(values | changes))
    return problem, preview(problem, start_cruise_stop(1200.0, 20.0, acceleration, 0.7, 4.0), 120.0)


def closed_loop(problem, ahead, tracker, steps=120, start=(-4.0, 0.0, 0.0)):
    """Cost of a loop on the nonlinear model itself, its commands and the solutions."""
    step, w = model(problem.actuator).casadi_step(), problem.weights
    x, cost, commands, solutions = np.array(start), 0.0, [], []
    for k in range(steps):
        solution = tracker.solve(k, x)
        u = float(solution.plan[0])
        e = x - ahead[k, :3]
        cost += (w.position * e[0] ** 2 + w.speed * e[1] ** 2 + w.force * e[2] ** 2
                 + w.command * (u - ahead[k, 3]) ** 2 + w.change * (u - x[2]) ** 2
                 + PRICE * max(0.0, x[1] * x[2] - problem.power_w_per_kg))
        x = np.asarray(step(*x, u, 0.0, *problem.parameters)).ravel()
        commands.append(u)
        solutions.append(solution)
    return cost, np.array(commands), solutions
