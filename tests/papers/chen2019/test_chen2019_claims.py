"""chen2019's rows: every number of the paper has one, and its learning rules have the printed factors."""

import numpy as np
import sympy as sp
from papers_import import PROOFS

from proofs.chen2019.laws import c_3, gamma_mass, learning_gains, learning_steps, mass_step
from proofs.chen2019.stated_values import MOTOR_CARS, stated_gains, stated_learning
from workbench.proof.paper import collect_papers

CLAIMS = {claim.equation: claim for paper in collect_papers([PROOFS / "chen2019"]) for claim in paper.claims}


def test_every_number_has_a_row():
    numbers = {int(equation.split(".")[0]) for equation in CLAIMS if equation.split(".")[0].isdigit()}
    assert set(range(1, 56)) <= numbers


def test_the_simulated_steps_have_the_factors_that_section_4_prints():
    values = {**stated_learning, **stated_gains}
    steps = [*learning_steps, -mass_step(sp.Integer(1), sp.Integer(1))]
    factors = [step.xreplace(values).as_coeff_Mul()[0] for step in steps]
    assert factors == [sp.Rational(text) for text in ("0.4", "0.0008", "320", "320", "320", "320")]
    assert gamma_mass in learning_gains and c_3 in stated_gains


def test_the_motor_cars_are_those_of_the_pattern():
    assert MOTOR_CARS == (1, 3, 5)


def test_the_letters_of_the_extracted_rule_of_theta_a_are_charged_as_a_slip_with_its_reading():
    assert CLAIMS["18"].recorded == "refuted" and CLAIMS["18"].severity == "cosmetic"
    assert CLAIMS["18"].glyph == CLAIMS["18.glyph"].id and CLAIMS["18.glyph"].recorded == "proved"


def test_limited_forces_let_the_states_grow_no_faster_than_the_claim_says():
    """(1)-(3) for six cars, typed from the paper, at random states and coefficients as they are at one instant."""
    rng = np.random.default_rng(5)
    for _ in range(500):
        s, v, m = rng.normal(size=6), rng.normal(size=6), rng.uniform(0.5, 2, 6)
        v[0] = abs(v[0])
        force, (c_v, c_a, c_k, c_d) = rng.normal(size=6), rng.uniform(0, 3, 4)
        coupler = c_k * (s[:-1] - s[1:]) + c_d * (v[:-1] - v[1:])
        pull = force - m * c_v * v - np.append(coupler, 0) + np.append(0, coupler)
        pull[0] -= m.sum() * c_a * v[0] ** 2
        rate = np.sum(s * v + v * pull / m)
        most = 1 + 4 * c_k / m.min() + 4 * c_d / m.min()
        assert rate <= np.sum((force / m) ** 2) / 2 + 3 * most * np.sum(s**2 + v**2)


def test_the_errors_obey_the_bound_of_part_3_for_all_gains():
    """c_1^2 int e_s^2 + int e_v^2 <= 2 int z_2^2 + 2 (c_3/c_2)^2 int Delta u^2 for random z_2, Delta u."""
    rng, step = np.random.default_rng(7), 1e-3
    for first, second, third in rng.uniform(0.05, 3, (20, 3)):
        e_s, lambda_2, sums = 0.0, 0.0, np.zeros(4)
        for z_2, difference in np.repeat(rng.normal(size=(40, 2)), 100, axis=0):
            e_v = z_2 + lambda_2 - first * e_s
            sums += step * np.array([e_s, e_v, z_2, difference]) ** 2
            e_s, lambda_2 = e_s + step * e_v, lambda_2 + step * (-second * lambda_2 + third * difference)
        assert first**2 * sums[0] + sums[1] <= 1.01 * (2 * sums[2] + 2 * (third / second) ** 2 * sums[3])
