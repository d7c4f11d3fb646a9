"""yang2021: which gains are searched for what runs cost against what is proved of the sampled, delayed loop.

At a constant speed v the law answers the estimates by their sum a_hat + b_hat v + c_hat v^2 alone. Where the three leak
at one rate, lambda_i sigma_i = leak as in section 6.1, that sum moves by itself: its rate by (34)-(36) is
-(lambda_1 + lambda_2 v^2 + lambda_3 v^4) e_2 - leak times it. So the loop that is proved has one estimate, and one neuron
that answers with 1; speed and mass may change within their box from sample to sample. Its disturbances are the line's
resistance, at most f* (claim A2), and what the leak draws off the estimate, which is the train's resistance at most. What
the estimates' parts do as the speed changes is not in it, nor is the barrier's growth away from zero error.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import sympy as sp

from workbench.gains.exact import rational
from workbench.gains.held_loop import SampledLoop
from workbench.gains.stated import Stated
from workbench.model.law import desired_acceleration, desired_position, desired_speed
from workbench.model.tuning import at_the_rail
from workbench.paper.gain_search import FrontSearch, FrontSetting, Numbers, Values
from workbench.paper.loading import Loaded
from workbench.paper.parameter_search import score
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.trains.actuator import Actuator
from workbench.trains.scenario import with_parameters
from workbench.trains.train import b_star, c_star, f, single_particle_per_mass, u

from . import laws as law
from .error_dynamics import STATED_F_STAR

NAME = "rbfnn_pocrac"
LAMBDAS, SIGMAS = ("lambda_1", "lambda_2", "lambda_3"), ("sigma_1", "sigma_2", "sigma_3")
OTHERS = ("alpha", "beta", "k", "chi")
SPEEDS = (Fraction(0), Fraction(33))  # m/s, standstill to just above the cruise speed
speed, share = sp.symbols("speed share", positive=True)  # of motion; of nominal in the train's mass, inverted
summed, weight, drawn_off = sp.symbols("summed W drawn_off", real=True)  # summed: off what it should be


def law_parameters(gains: Mapping[str, float]) -> dict[str, float]:
    """The law's parameters: sigma_i = leak / lambda_i."""
    return {name: gains[name] for name in (*OTHERS, *LAMBDAS)} | {
        sigma: gains["leak"] / gains[lam] for lam, sigma in zip(LAMBDAS, SIGMAS, strict=True)}


def stated_gains(stated: Stated) -> dict[str, float]:
    """Those of section 6.1."""
    where = f"controllers.{NAME}.parameters"
    leaks = {stated.number(f"{where}.{lam}") * stated.number(f"{where}.{sigma}")
             for lam, sigma in zip(LAMBDAS, SIGMAS, strict=True)}
    return {name: float(stated.number(f"{where}.{name}")) for name in (*OTHERS, *LAMBDAS)} | {"leak": float(max(leaks))}


def loop(stated: Stated, gains: Mapping[str, Fraction], period_s: Fraction, delay_s: Fraction,
         lag_s: Fraction) -> SampledLoop:
    """The loop near zero error over speeds and masses, one estimate and one neuron."""
    spread = stated.number("uncertainty.spread")
    davis = {star: rational(stated.number(f"train.{key}"))
             for star, key in ((b_star, "davis_b_per_s"), (c_star, "davis_c_per_m"))}
    values = {s: rational(gains[str(s)]) for s in (law.alpha, law.beta, law.k, law.chi, *law_lambdas)}
    values |= {sigma: rational(gains["leak"]) / values[lam] for sigma, lam in zip(law_sigmas, law_lambdas, strict=True)}
    # At this speed any parts with this sum will do.
    parts = {law.b_hat: davis[b_star], law.c_hat: davis[c_star],
             law.a_hat: summed - davis[b_star] * speed - davis[c_star] * speed**2}
    one_neuron = {law.f_hat: weight, law.W_hat: weight, law.h: sp.Integer(1)}
    of_sum = sum((speed**n * state.rate for n, state in enumerate(law.adaptation)), sp.Integer(0))
    plant = {s: sp.sympify(rate, strict=True).xreplace({u: share * u}) for s, rate in
             single_particle_per_mass().rates.items()}
    rest = sp.Integer(0)
    resistance = sum((stated.number(f"train.{key}") * SPEEDS[1] ** n for n, key in enumerate(
        ("davis_a_mps2", "davis_b_per_s", "davis_c_per_m"))), Fraction(0))
    at = values | davis | {law.x_1: rest, law.x_2: speed, desired_position: rest, desired_speed: speed,
                           desired_acceleration: rest, weight: rest}
    return SampledLoop(
        plant, u, {f: STATED_F_STAR, drawn_off: resistance * (1 + spread)}, law.rbfnn_pocrac.command.xreplace(one_neuron).xreplace(parts),
        {summed: sp.expand(of_sum.xreplace(parts)) - rational(gains["leak"]) * drawn_off,
         weight: sp.sympify(law.weight_adaptation.rate, strict=True).xreplace(one_neuron)},
        law.e_1, at, period_s, delay_s, lag_s, {speed: SPEEDS, share: (1 / (1 + spread), 1 / (1 - spread))})


law_lambdas, law_sigmas = (law.lambda_1, law.lambda_2, law.lambda_3), (law.sigma_1, law.sigma_2, law.sigma_3)


def run(loaded: Loaded, gains: Values, period_s: float, actuator: Actuator | None) -> Numbers:
    """The scenario's own train, sampled so and behind that actuator; its cost is the objective of the file's tuning."""
    scenario = loaded.scenario
    assert scenario.tuning is not None
    goal = scenario.tuning.objective
    spec = scenario.controllers[NAME].model_copy(update={"period_s": period_s})
    simulation = scenario.simulation.model_copy(update={"plant_step_s": STEP_S})
    changed = with_parameters(scenario.model_copy(update={
        "actuator": actuator, "simulation": simulation, "controllers": {NAME: spec}}), NAME, law_parameters(gains))
    found = measure(simulate(changed, NAME), changed)
    units = at_the_rail(goal.units, actuator is not None)
    names = ("position_rms", "speed_rms", "largest_position_error", "energy_J", "jerk_rms")
    if found.failed:
        return {"cost": None, **dict.fromkeys(names)}
    return {"cost": score({m: float(getattr(found, m)) for m in units}, units, goal.failed),
            **{name: float(getattr(found, name)) for name in names}}


STEP_S = 0.005  # the plant's; the scenario's own 1 ms changes no digit that is shown


def _setting(name: str, title: str, period: str, delay: str, lag: str) -> FrontSetting:
    """A setting by its decimals in seconds."""
    times = Fraction(period), Fraction(delay), Fraction(lag)
    actuator = Actuator(delay_s=float(times[1]), lag_s=float(times[2])) if any(times[1:]) else None
    return FrontSetting(name, title, lambda stated, gains: loop(stated, gains, *times),
                        lambda loaded, gains: run(loaded, gains, float(times[0]), actuator))


FRONT = FrontSearch(
    "yang2021",
    {"alpha": (0.05, 5.0), "beta": (0.51, 8.0), "k": (0.15, 3.0), "chi": (0.001, 1.0), "lambda_1": (1e-3, 10.0),
     "lambda_2": (1e-7, 0.1), "lambda_3": (1e-10, 0.01), "leak": (5e-6, 0.5)},
    stated_gains, "root mean square of the position error in the long run", "m", (
        _setting("at_once", "every 5 ms, force at once", "0.005", "0", "0"),
        _setting("actuator", "every 20 ms behind a delay of 0.1 s and a lag of 0.3 s", "0.02", "0.1", "0.3")))
