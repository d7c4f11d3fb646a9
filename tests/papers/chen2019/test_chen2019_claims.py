"""chen2019's rows: every number of the paper has one, and its learning rules have the printed factors."""

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
