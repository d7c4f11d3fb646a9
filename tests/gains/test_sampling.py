"""Sampled loops: the linear map against the nonlinear loop itself, its border against theory, its proof."""

import numpy as np
import pytest
import sympy as sp
from scenarios import PROOFS
from scipy.integrate import solve_ivp

from proofs.mao2018 import gains as mao2018
from proofs.yang2021 import gains as yang2021
from proofs.yang2021 import laws as law
from workbench.cli.loading import load
from workbench.errors import SolverError
from workbench.files.toml import read_toml
from workbench.gains.sampling import largest_period_s, sampled_map, stability_certificate
from workbench.gains.stated import Stated
from workbench.model.law import desired_acceleration, desired_position, desired_speed
from workbench.proof.checker import check
from workbench.trains.train import f, single_particle_per_mass, u

SPEED = sp.Rational(326, 10)


def stated_of(paper):
    file = PROOFS / paper / "study.toml"
    return Stated(file, read_toml(file))


def stated(paper):
    loaded = load(PROOFS / paper)
    return Stated(loaded.path, loaded.data)


@pytest.fixture(scope="module")
def values():
    return yang2021.stated_values(stated_of("yang2021"))


x, command = sp.symbols("x command", real=True)
estimate = sp.Symbol("estimate", real=True)


INTEGRATOR = {x: command}


def test_a_held_command_on_an_integrator_is_stable_up_to_two_over_its_gain():
    matrix = sampled_map(INTEGRATOR, command, -5 * x, {estimate: -estimate}, {}, "corrected")
    assert largest_period_s(matrix) == pytest.approx(2 / 5, rel=2e-3)


def test_the_order_of_the_estimates_decides():
    """x' = u, u = -w: an oscillator whose explicit Euler step always gains energy and whose corrected one does not."""
    rates = {estimate: 9 * x}
    corrected = sampled_map(INTEGRATOR, command, -estimate - x / 100, rates, {}, "corrected")
    explicit = sampled_map(INTEGRATOR, command, -estimate - x / 100, rates, {}, "explicit")
    assert largest_period_s(corrected) == pytest.approx(2 / 3, rel=1e-2)
    assert largest_period_s(explicit) < 0.01


@pytest.mark.parametrize("period_s", [0.001, 0.05])
def test_yangs_map_is_the_derivative_of_its_nonlinear_sampled_loop(values, period_s):
    """One sample of plant and law, integrated, perturbed in each state; without the network."""
    parameters = {s: float(v) for s, v in values.items()}
    plant = single_particle_per_mass()
    states = (law.a_hat, law.b_hat, law.c_hat)
    known = (law.x_1, law.x_2, *states)
    fixed = parameters | {desired_position: 0.0, desired_speed: float(SPEED), desired_acceleration: 0.0}
    steps = sp.lambdify(known, [s.symbol + period_s * s.rate.xreplace(fixed) for s in law.adaptation])
    answer = sp.lambdify(known, law.pocrac.command.xreplace(fixed))
    rate = sp.lambdify((law.x_2, u), plant.rates[law.x_2].xreplace({f: sp.Integer(0)} | parameters))

    def one_sample(state):
        moved = steps(*state)
        held = answer(*state[:2], *moved)
        # In a frame that moves with the desired speed.
        ran = solve_ivp(lambda _, y: [y[1] - float(SPEED), rate(y[1], held)], (0, period_s), state[:2], rtol=1e-12,
                        atol=1e-14)
        return np.array([*ran.y[:, -1], *moved])

    rest = np.array([0.0, float(SPEED), *(float(values[s]) for s in yang2021.STARS)])
    matrix = yang2021.periods(values, yang2021.Fraction(326, 10))[2](period_s)[:5, :5]
    for column, step in enumerate((1e-6, 1e-6, 1e-5, 1e-7, 1e-9)):
        ahead, behind = (one_sample(rest + sign * step * np.eye(5)[column]) for sign in (1, -1))
        slope = (ahead - behind) / (2 * step)
        scale = np.abs(matrix[:, column]).max()
        assert slope == pytest.approx(matrix[:, column], rel=1e-4, abs=1e-5 * scale)


def test_the_border_at_the_stated_gains_is_that_of_the_paper_files_rule(values):
    """Claim 36.sampling.corrected: about 2/(sqrt(lambda_3) v^2), which leaves the other estimates out."""
    corrected, explicit, _ = yang2021.periods(values, yang2021.Fraction(326, 10))
    assert corrected == pytest.approx(2 / (0.01**0.5 * 32.6**2), rel=0.02)
    assert explicit < 1e-4


def test_maos_estimate_of_c_needs_the_period_that_theory_says():
    """(27)-(31) in SI units turn at sqrt(gain (1 + v^2 + v^4 + ...)); the corrected order bears 2 over that."""
    stated = stated_of("mao2018")
    matrix = mao2018._loop(stated, "SI", yang2021.Fraction(0), yang2021.Fraction(0))
    speed = float(mao2018.top_speed(stated))
    turns = (2 * (1 + speed**2 + speed**4 + 9.81**2 + 0.004**2)) ** 0.5
    assert largest_period_s(matrix) == pytest.approx(2 / turns, rel=5e-3)


def test_a_stable_map_is_proved_and_an_unstable_one_is_not():
    check(stability_certificate("test:stable", np.array([[0.5, 400.0], [0.0, -0.9]])))
    check(stability_certificate("test:slow", np.array([[0.999999, 1e-3], [0.0, 0.3]])))
    for matrix in (np.array([[1.0001, 0.0], [0.0, 0.5]]), np.array([[0.0, 1.1], [-1.1, 0.0]])):
        with pytest.raises(SolverError, match="border of stability"):
            stability_certificate("test:unstable", matrix)
