"""The PID against the poles its gains were chosen for, and the two forms of the single-particle plant."""

import numpy as np
import pytest
import sympy as sp

from workbench.model.pid import pid
from workbench.trains.train import single_particle, single_particle_per_mass


def test_pid_has_the_poles_its_gains_were_chosen_for():
    # On the double integrator: s^3 + K_d s^2 + K_p s + K_i, with the gains of the shipped scenario (s + 0.5)^3.
    state = pid.states[0]
    e, ei, de = sp.symbols("e ei de")
    position, speed = (s for s in single_particle_per_mass().rates)
    x_d, v_d = sp.symbols("x_d xdot_d", real=True)
    zero = {x_d: 0, v_d: 0, position: e, speed: de, state.symbol: ei}
    feedback = sp.expand(pid.command.xreplace(zero))
    gains = {str(s): g for s, g in zip(pid.parameters, (0.75, 0.125, 1.5), strict=True)}
    p, i, d = (float(-feedback.coeff(e).subs({s: gains[str(s)] for s in pid.parameters})),
               float(feedback.coeff(ei).subs({s: gains[str(s)] for s in pid.parameters})),
               float(-feedback.coeff(de).subs({s: gains[str(s)] for s in pid.parameters})))
    assert state.rate.xreplace(zero) == -e
    assert np.roots([1, d, p, i]) == pytest.approx(-0.5 * np.ones(3), abs=1e-4)


def test_the_two_forms_of_the_plant_are_one():
    newton, per_mass = single_particle(), single_particle_per_mass()
    (_, acceleration), (_, specific) = newton.rates.items(), per_mass.rates.items()
    m, a_0, b_0, c_0 = newton.parameters
    position, speed = newton.rates
    x_1, x_2 = per_mass.rates
    a, b_, c_ = per_mass.parameters
    translated = specific[1].xreplace({x_1: position, x_2: speed, a: a_0 / m, b_: b_0 / m, c_: c_0 / m,
                                       per_mass.command: newton.command / m,
                                       per_mass.disturbance: -newton.disturbance / m})
    assert sp.simplify(translated - acceleration[1]) == 0
