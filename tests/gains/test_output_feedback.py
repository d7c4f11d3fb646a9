"""Output feedback, gains from disturbances, and margins of the loops: against poles, theory and the checker."""

import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import workbench as wb
from workbench.errors import InputError
from workbench.gains.frequency import feedback_margins
from workbench.gains.linearised import disturbance_matrix, linearised, output_matrix
from workbench.gains.output_feedback import output_decaying
from workbench.gains.stated import Stated
from workbench.paper.plants.attenuation import attenuation_search
from workbench.paper.plants.gains import feedback_search
from workbench.proof.checker import check

x, v, i, u, w = sp.symbols("x v i u w", real=True)
b, k = sp.symbols("b k", positive=True)
DRIVE = wb.Plant("drive", (x, v, i), (v, i + x, u - 5 * i), (u,), outputs={x: x, v: v})
SPRING = wb.Plant("spring", (x, v), (v, u - b * v - x + w), (u,), disturbances=(w,),
                  parameters=(wb.Parameter(b, 2.0, known=(1.5, 2.5)),))


def numbers(matrix):
    return np.array(matrix.tolist(), dtype=float)


def test_an_output_feedback_decays_as_it_is_proved_to_for_every_extreme_plant():
    sizes = {"x": Fraction(1), "v": Fraction(1), "i": Fraction(1)}
    plants, C = linearised(DRIVE), output_matrix(DRIVE)
    assert C.tolist() == [[1, 0, 0], [0, 1, 0]]
    found = output_decaying("mine:out", plants, C, Fraction(1, 2), sizes)
    check(found.found.certificate)
    (A, B), = plants.extremes
    assert np.linalg.eigvals(numbers(A + B * found.F * C)).real.max() < -0.5
    # By its position alone the unstable drive cannot be held: the speed's coefficient would have to be negative.
    with pytest.raises(InputError, match="out of reach of the iteration"):
        output_decaying("mine:out", plants, C[:1, :], Fraction(1, 2), sizes)
    plants, sizes = linearised(SPRING), {"x": Fraction(1), "v": Fraction(1)}
    found = output_decaying("mine:out", plants, sp.Matrix([[1, 0]]), Fraction(11, 20), sizes)
    check(found.found.certificate)
    assert max(np.linalg.eigvals(numbers(A + B * found.F * sp.Matrix([[1, 0]]))).real.max()
               for A, B in plants.extremes) < -0.55


def test_what_is_measured_must_be_known_exactly():
    scaled = wb.Plant("p", (x,), (u,), (u,), parameters=(wb.Parameter(k, 1.0, known=(0.5, 2)),), outputs={v: k * x})
    with pytest.raises(InputError, match="by a factor that is not known exactly"):
        output_matrix(scaled)
    assert output_matrix(wb.Plant("p", (x,), (u,), (u,), outputs={v: sp.sin(x) + 2 * x})) == sp.Matrix([[3]])
    assert disturbance_matrix(SPRING) == sp.Matrix([0, 1])


def test_margins_are_those_of_the_loops_transfer_function():
    """x'' = u, u = -x - v: the loop (s + 1) / s^2 has gain one at w^2 = (1 + sqrt(5)) / 2, and its phase lags by 180
    degrees nowhere. Two such beside each other are no other loops."""
    A, B, K = np.array([[0.0, 1], [0, 0]]), np.array([[0.0], [1]]), np.array([[-1.0, -1]])
    (found,) = feedback_margins(A, B, K)
    crossover = math.sqrt((1 + math.sqrt(5)) / 2)
    assert found.least == 0 and found.most == math.inf
    assert found.phase_deg == pytest.approx(math.degrees(math.atan(crossover)))
    assert found.delay_s == pytest.approx(math.atan(crossover) / crossover)
    two = feedback_margins(np.kron(np.eye(2), A), np.kron(np.eye(2), B), np.kron(np.eye(2), K))
    assert [one.delay_s for one in two] == pytest.approx([found.delay_s] * 2)
    # x' = x + u, u = -4 x: stable as long as the gain is more than a quarter of that.
    (lower,) = feedback_margins(np.eye(1), np.eye(1), np.array([[-4.0]]))
    assert lower.least == pytest.approx(0.25) and lower.most == math.inf
    # x''' = u with poles at -1: by Routh's condition (3)(3) > 1, so the gain may fall to a ninth of it... of all three.
    chain = feedback_margins(np.eye(3, k=1), np.array([[0.0], [0], [1]]), np.array([[-1.0, -3, -3]]))[0]
    assert chain.least == pytest.approx(1 / 9) and chain.most == math.inf


def test_a_gain_from_disturbances_is_at_least_that_of_the_loop_and_close_to_it():
    search = attenuation_search("mine", SPRING, {"x": "1", "u": "0.5"})
    report = search.report(Stated(Path("study.toml"), {}))
    check(report.certificates[0])
    K = np.array([[float(report.found[0].values[f"K_u_{name}"]) for name in ("x", "v")]])
    largest = 0.0
    for A, B in linearised(SPRING).extremes:
        loop, out = numbers(A) + numbers(B) @ K, np.vstack([[1.0, 0.0], 0.5 * K])
        largest = max(largest, *(np.linalg.norm(out @ np.linalg.solve(1j * at * np.eye(2) - loop, [0.0, 1.0]))
                                 for at in np.linspace(0, 5, 201)))
    assert largest <= report.quantities[0].proved < 1.3 * largest
    for plant, weights, words in ((DRIVE, {"u": "1"}, "there is none"), (SPRING, {"x": "1"}, "every input"),
                                  (SPRING, {"z": "1", "u": "1"}, "no state and no input")):
        with pytest.raises(InputError, match=words):
            attenuation_search("mine", plant, weights).report(Stated(Path("study.toml"), {}))


def test_a_plant_that_measures_part_of_its_state_is_run_with_what_was_found():
    measured = wb.Plant("spring", (x, v), (v, u - b * v - x - x**3), (u,), outputs={w: 2 * x},
                        parameters=SPRING.parameters)
    search = feedback_search("mine", measured, "0.55", {"x": "0.1", "v": "0.1"})
    report = search.report(Stated(Path("study.toml"), {}))
    assert list(report.found[0].values) == ["K_u_w"] and report.notes[1].startswith("Opened at u the linear loop of 2")
    for task in search.tasks(report):
        row, failed = search.run(None, task)
        assert failed is None and row["root_of_V_left"] < row["root_of_V_left_proved"]
