"""liu2020 in a contest: its two networks along the scenario's desired curve, by the rules of its own study."""

from __future__ import annotations

import numpy as np

from workbench.contest.entrant import Entrant, Played
from workbench.simulate.closed_loop import Array, Setting, run_law
from workbench.trains.scenario import ControllerSpec, Scenario

from .laws import LAWS
from .simulation.trip import centers_along

OBSERVED = ("k_1", "k_2", "k_3", "k_4", "k_5")
LEARNED = ("Gamma_f", "alpha_1", "Gamma_v", "alpha_2", "kappa_1", "kappa_2", "leak_rate_per_s", "width", "tau")
PARAMETERS = (*OBSERVED, *LEARNED, "neurons")


def values_of(scenario: Scenario, spec: ControllerSpec) -> tuple[Array, Array, Array, Array]:
    """The law's numbers as the kernel takes them: inputs of order one, empty networks, all estimates leaking alike."""
    law, given, train, curve = LAWS[spec.law], dict(spec.parameters), scenario.train, scenario.desired_curve()
    _, speed, acceleration = curve.at(np.linspace(0.0, curve.trip_time_s, 10_001))
    scale = {"s_scale": curve.length_m, "v_scale": float(speed.max()), "a_scale": float(acceleration.max()),
             "u_scale": train.max_traction_n}
    leak = given["leak_rate_per_s"]
    named = given | scale | {
        "M": train.mass_kg, "b_h": given["width"], "W_f_prior": 0.0, "W_v_prior": 0.0, "delta_0": 0.0, "theta_0": 0.0,
        "sigma_f": leak / given["Gamma_f"], "beta_1": leak / given["alpha_1"],
        "sigma_v": leak / given["Gamma_v"], "beta_2": leak / given["alpha_2"]}
    count = int(given["neurons"])
    return (np.array([named[str(symbol)] for symbol in law.parameters]), np.zeros(len(law.scalar_states)),
            np.zeros((len(law.neuron_states), count)), centers_along(curve, scale, count))


def _play(scenario: Scenario, spec: ControllerSpec, setting: Setting) -> Played:
    law = LAWS[spec.law]
    return Played(run_law(law, values_of(scenario, spec), setting, spec.period_s, "explicit", title=law.title))


ENTRANTS = {f"liu2020.{name}": Entrant(
    f"neural observers, {LAWS[f'liu2020.{name}'].title}", f"{LAWS[f'liu2020.{name}'].information} but for its mass",
    PARAMETERS, _play, counts=("neurons",)) for name in ("position_only", "position_only_speed", "corrected_rate")}
