"""State feedback of any plant: against poles, norms and theory, and every certificate by the checker."""

import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from hypothesis import example, given
from hypothesis import strategies as st

from workbench.errors import InputError
from workbench.gains.enclosure import enclosed
from workbench.gains.exact import rational
from workbench.gains.feedback import attenuating, decaying, proved_decay
from workbench.gains.linearised import linearised
from workbench.gains.point import at_point
from workbench.gains.search import Infeasible
from workbench.gains.stated import Stated
from workbench.paper.plants.gains import feedback_search
from workbench.proof.checker import check
from workbench.systems.plant import Parameter, Plant

theta, omega, u, w = sp.symbols("theta omega u w", real=True)
g, b = sp.symbols("g b", positive=True)
PENDULUM = Plant("pendulum", (theta, omega), (omega, -g * sp.sin(theta) - b * omega + u), (u,),
                 parameters=(Parameter(g, 9.81), Parameter(b, 0.5, known=(0.2, 0.8))))
UP = {"theta": sp.pi}


def numbers(matrix):
    return np.array(matrix.tolist(), dtype=float)


def test_a_pendulum_held_up_decays_for_every_friction_that_may_be():
    plants = linearised(PENDULUM, UP)
    assert len(plants.extremes) == 2
    assert {A[1, 1] for A, _ in plants.extremes} == {sp.Rational(-1, 5), sp.Rational(-4, 5)}
    found = decaying("mine:hold", plants, Fraction(2), {"theta": Fraction(1, 10), "omega": Fraction(1, 10)})
    check(found.found.certificate)
    K = numbers(found.K)
    P = numbers(sp.Matrix(2, 2, [found.found.values[sp.Symbol(f"P_{i}_{j}", real=True)]
                                 for i, j in ((1, 1), (1, 2), (1, 2), (2, 2))]))
    for A, B in plants.extremes:
        assert np.linalg.eigvals(numbers(A) + numbers(B) @ K).real.max() <= -2 + 1e-6
    # From every state of the ellipsoid x^T P^-1 x <= 1 the command is at most its bound.
    assert math.sqrt((K @ P @ K.T).item()) <= found.bound + 1e-9
    assert np.linalg.eigvalsh(P).min() >= 0.01 - 1e-9
    scaled = decaying("mine:hold", plants, Fraction(2), {"theta": Fraction(1, 10), "omega": Fraction(1, 10)},
                      {"u": Fraction(10)})
    assert scaled.bound == pytest.approx(found.bound / 10, rel=1e-3)
    stated = proved_decay("mine:stated", plants, [[Fraction(-40), Fraction(-8)]], Fraction(2))
    check(stated.certificate)
    with pytest.raises(Infeasible):
        proved_decay("mine:slow", plants, [[Fraction(-40), Fraction(-8)]], Fraction(8))


def test_the_least_gain_of_one_plant_is_that_of_theory():
    """x' = -x + u + w, z = (x, u): with u = K x the gain is that at rest, sqrt(1 + K^2) / (1 - K), least at K = -1."""
    x = sp.Symbol("x", real=True)
    plant = Plant("lag", (x,), (u - x,), (u,))
    found = attenuating("mine:gain", linearised(plant), sp.Matrix([[1]]), sp.Matrix([1, 0]), sp.Matrix([0, 1]))
    check(found.found.certificate)
    assert math.sqrt(0.5) <= found.bound < 1.01 * math.sqrt(0.5)
    K = float(found.K[0])
    assert pytest.approx(-1, abs=0.2) == K and math.sqrt(1 + K**2) / (1 - K) <= found.bound


def test_a_train_in_newtons_and_kilograms_is_within_the_solvers_reach():
    x, v, force = sp.symbols("x v F", real=True)
    m, c = sp.symbols("m c", positive=True)
    train = Plant("train", (x, v), (v, force / m - c * v * sp.Abs(v)), (force,),
                  parameters=(Parameter(m, 8e4, known=(6e4, 1e5)), Parameter(c, 1e-3)))
    plants = linearised(train)
    assert plants.extremes[0][0] == sp.Matrix([[0, 1], [0, 0]])  # quadratic drag has no slope at rest
    assert {B[1] for _, B in plants.extremes} == {sp.Rational(1, 60000), sp.Rational(1, 100000)}
    found = decaying("mine:train", plants, Fraction(1, 10), {"x": Fraction(10), "v": Fraction(1)})
    check(found.found.certificate)
    for A, B in plants.extremes:
        assert np.linalg.eigvals(numbers(A) + numbers(B) @ numbers(found.K)).real.max() <= -0.1 + 1e-6


LEAN = sp.symbols("x", real=True)


@given(st.floats(-2, 2), st.floats(0, 1), st.floats(0, 1))
@example(0.0, 1.0, 0.0)
def test_bounds_hold_all_values(low, width, share):
    box = {LEAN: (Fraction(low), Fraction(low) + Fraction(width))}
    value = Fraction(low) + Fraction(width) * Fraction(share)
    for expr in (LEAN**2 - 3 * LEAN / 7, LEAN**3 * sp.sin(LEAN), sp.exp(-LEAN) / (LEAN**2 + 1), sp.sqrt(LEAN + 3),
                 sp.pi * sp.cos(5 * LEAN), sp.log(LEAN + 3) - 0.1 * LEAN, 1 / sp.sqrt(LEAN + 3), sp.tanh(3 * LEAN)):
        lower, upper = enclosed(expr, box)
        exact = expr.xreplace({LEAN: rational(value)}).evalf(40)
        assert rational(lower) - sp.Rational(1, 10**15) <= exact <= rational(upper) + sp.Rational(1, 10**15)


@pytest.mark.parametrize(("expr", "words"), [(1 / LEAN, "denominator"), (sp.log(LEAN), "finite|log|defined"),
                                             (sp.sqrt(LEAN), "not defined"), (sp.atan(LEAN), "atan are not known"),
                                             (sp.tan(2 * LEAN), "no finite bounds")])
def test_what_has_no_bounds_is_said(expr, words):
    with pytest.raises(ValueError, match=words):
        enclosed(expr, {LEAN: (Fraction(-1), Fraction(1))})


def test_simple_bounds_stay_simple():
    assert enclosed(-b * g + 1, {b: (Fraction(1, 5), Fraction(4, 5)), g: (Fraction(2), Fraction(2))}) == (
        Fraction(-3, 5), Fraction(3, 5))
    assert enclosed(sp.Float(0.1), {}) == (Fraction(1, 10), Fraction(1, 10))


@pytest.mark.parametrize(("at", "words"), [({"theta": 1.0}, "give an equilibrium"),
                                           ({"phi": 1.0}, "no state and no input")])
def test_what_cannot_be_linearised_is_one_line(at, words):
    with pytest.raises(InputError, match=words):
        linearised(PENDULUM, at)


def test_more_uncertain_entries_than_can_be_taken_are_refused():
    names, known = sp.symbols("c_1:8", positive=True), sp.symbols("y_1:8", real=True)
    chain = Plant("chain", known, [-c * y + u for c, y in zip(names, known, strict=True)], (u,),
                  parameters=[Parameter(c, 1.0, known=(0.5, 2.0)) for c in names])
    with pytest.raises(InputError, match="7 entries of its linearisation are uncertain"):
        linearised(chain)


def test_a_point_at_rest_for_some_parameters_alone_is_refused():
    lift = Plant("lift", (omega,), (u * b - g,), (u,),
                 parameters=(Parameter(g, 10.0), Parameter(b, 1.0, known=(0.5, 2))))
    with pytest.raises(InputError, match="for all values of the parameters"):
        linearised(lift, {"u": 10})


@pytest.mark.parametrize("friction", [sp.Abs(omega), sp.Max(0, omega), sp.Piecewise((omega, omega > 0), (0, True))])
def test_a_kink_has_no_linearisation(friction):
    with pytest.raises(InputError, match="kink"):
        linearised(Plant("rough", (omega,), (u - friction,), (u,)))


def test_a_plant_that_decays_alone_is_told_so():
    with pytest.raises(InputError, match="without feedback"):
        decaying("mine:calm", linearised(Plant("lag", (omega,), (u - omega,), (u,))), Fraction(1, 2),
                 {"omega": Fraction(1)})


@pytest.mark.parametrize(("changes", "words"), [
    ({"rate": "fast"}, "'fast' is no decimal"), ({"rate": "-1"}, "not positive"),
    ({"radius": {"theta": "0.1"}}, "radius.omega.*is missing"),
    ({"radius": {"theta": "0.1", "omega": "1", "phi": "1"}}, "radius.phi.*is no state"),
    ({"at": {"phi": 0}}, "at.phi.*no state and no input: name one of theta, omega"),
    *(({"at": {"theta": value}}, "at.theta.*is no finite real number") for value in (
        "up", "1/0", float("nan"), float("inf"), True, None, sp.I, sp.oo, theta)),
    ({"plant": replace(PENDULUM, outputs={theta: theta})}, "out of reach of the iteration"),
    ({"plant": replace(PENDULUM, input_limits={u: (0.0, 1.0)})}, "at or beyond its limits")])
def test_what_a_folder_states_wrongly_is_one_line(changes, words):
    search = feedback_search(**{"paper": "mine", "plant": PENDULUM, "rate": "2", "at": UP,
                                "radius": {"theta": "0.1", "omega": "0.1"}, **changes})
    with pytest.raises(InputError, match=words):
        search.report(Stated(Path("study.toml"), {}))


@pytest.mark.parametrize("third", ["1/3", Fraction(1, 3), sp.Rational(1, 3)])
def test_a_point_is_taken_as_it_is_written(third):
    assert at_point(PENDULUM, {"theta": third, "omega": "0.1", "u": 0.1}) == {
        "theta": sp.Rational(1, 3), "omega": sp.Rational(1, 10), "u": sp.Rational(1, 10)}
    assert at_point(PENDULUM, UP) == {"theta": sp.pi}


def test_limits_that_the_proof_does_not_keep_are_told():
    stated = Stated(Path("study.toml"), {})
    for limit, told in ((50.0, False), (1.0, True)):
        plant = replace(PENDULUM, input_limits={u: (-limit, limit)})
        notes = feedback_search("mine", plant, "2", {"theta": "0.1", "omega": "0.1"}, UP).report(stated).notes
        assert any("saturates" in note for note in notes) == told


def test_a_gain_of_metres_beside_volts_is_within_the_solvers_reach():
    """A ball under a magnet: its sizes differ by thousands, and near the least gain itself K would grow to millions."""
    x, v, i, volts = sp.symbols("x v i U", real=True)
    R = sp.symbols("R", positive=True)
    ball = Plant("ball", (x, v, i), (v, 1960 * x - 14 * i + w, 5 * volts - 5 * R * i), (volts,), (w,),
                 parameters=(Parameter(R, 11.0, known=(9, 13)),))
    plants = linearised(ball)
    E, C, D = sp.Matrix([0, 1, 0]), sp.Matrix([[1000, 0, 0], [0, 0, 0]]), sp.Matrix([0, sp.Rational(1, 10)])
    found = attenuating("mine:ball", plants, E, C, D)
    check(found.found.certificate)
    K, peak = numbers(found.K), 0.0
    for A, B in plants.extremes:
        loop = numbers(A) + numbers(B) @ K
        assert np.linalg.eigvals(loop).real.max() < 0
        peak = max(peak, *(np.linalg.norm((numbers(C) + numbers(D) @ K) @ np.linalg.solve(
            1j * rate * np.eye(3) - loop, numbers(E)), 2) for rate in np.logspace(-1, 4, 200)))
    assert 0.9 * found.bound < peak <= found.bound


def test_a_point_of_rest_at_an_irrational_number_is_no_harder_than_one_beside_it():
    """Its entry lies between two rationals that are all but equal, and both are proved."""
    x, v, i, volts = sp.symbols("x v i U", real=True)
    bounds = []
    for weight in (sp.Rational(981, 100), sp.Rational(98, 10)):
        ball = Plant("ball", (x, v, i), (v, weight - (i / x) ** 2 / 2000, 5 * (volts - 11 * i)), (volts,))
        rest = sp.sqrt(2000 * weight) / 100
        plants = linearised(ball, {"x": sp.Rational(1, 100), "i": rest, "U": 11 * rest})
        found = decaying("mine:rest", plants, Fraction(5),
                         {"x": Fraction(1, 1000), "v": Fraction(1, 50), "i": Fraction(1, 10)})
        check(found.found.certificate)
        A, B = (numbers(part) for part in plants.extremes[0])
        assert np.linalg.eigvals(A + B @ numbers(found.K)).real.max() <= -5
        bounds.append((len(plants.extremes), found.bound))
    (two, beside), (one, alone) = bounds
    assert (two, one) == (2, 1) and beside == pytest.approx(alone, rel=1e-2)


def test_entries_that_share_an_uncertain_term_move_together():
    """Of a motor with an inertia between two values there are two extreme plants, not one for each pair of entries."""
    angle, speed, current, volts = sp.symbols("theta omega i V", real=True)
    J, b, K, R, L = sp.symbols("J b K R L", positive=True)
    motor = Plant("motor", (angle, speed, current), (speed, (K * current - b * speed - K * sp.sin(angle)) / J,
                                                     (volts - R * current - K * speed) / L), (volts,),
                  parameters=(Parameter(J, 0.01, known=(0.005, 0.02)), Parameter(b, 0.1), Parameter(K, 0.01),
                              Parameter(R, 1.0), Parameter(L, 0.5)))
    plants = linearised(motor)
    assert sorted(A[1, 1] for A, _ in plants.extremes) == [-20, -5]
    for A, B in plants.extremes:
        assert A[1, :] == A[1, 1] / 10 * sp.Matrix([[1, 10, -1]])
        assert list(B) == [0, 0, 2]
    apart = replace(motor, rates=(speed, K * current / J - b * R * speed, (volts - R * current - K * speed) / L),
                    parameters=(*motor.parameters[:3], Parameter(R, 1.0, known=(1, 2)), motor.parameters[4]))
    assert len(linearised(apart).extremes) == 4  # 1/J and R, where three entries differ
    for J_, R_ in ((0.007, 1.3), (0.02, 1.9)):
        A = sp.Matrix(apart.rates).jacobian(apart.states).subs({J: J_, R: R_, b: 0.1, K: 0.01, L: 0.5})
        corners = [E for E, _ in linearised(apart).extremes]
        assert all(min(E[i] for E in corners) - 1e-12 <= A[i] <= max(E[i] for E in corners) + 1e-12 for i in range(9))
