"""chen2019's rows: every number of the paper has one, and its learning rules have the printed factors."""

import json

import numpy as np
import sympy as sp
from papers_import import PROOFS
from scipy.integrate import solve_ivp

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


def test_the_garbled_letters_of_the_rule_of_theta_a_are_not_charged_to_the_paper():
    assert CLAIMS["18"].recorded == "proved" and CLAIMS["18"].build().show == CLAIMS["18.glyph"].build().show


def test_a_mass_estimated_25_kg_too_high_leaves_the_acceleration_open():
    """(16) without other forces at c_3 = 0.04 for a car of 50 t, typed from the paper."""
    for acceleration in (0.0, 0.25, 0.5):
        assert (50025 - 1 / 0.04) * acceleration == 50000 * acceleration <= 40000


def test_two_accelerations_solve_the_law_and_the_learning_rule_of_the_mass_at_the_printed_gains():
    """(16), (22) at z_2 = -5/32 m/s: M_hat = m - 320 z_2 a, m a = (M_hat - 25) a."""
    for acceleration in (0.0, 0.5):
        estimate = 50000 - 320 * -0.15625 * acceleration
        assert 50000 * acceleration == (estimate - 25) * acceleration <= 40000


def test_with_the_learning_rule_of_the_mass_the_rule_for_c_3_needs_its_factor_2():
    """(16), (22) of a car of 50 t at c_3 = 0.04 with m_low = M_hat_{i-1} = m: two for m_high = m + 20 kg."""
    for acceleration in (0.2, 0.3):
        estimate = min(50000 + 50 * acceleration, 50020)
        assert abs(50000 * acceleration - (3 + (estimate - 25) * acceleration)) < 1e-9
    rng = np.random.default_rng(3)
    tried = np.linspace(-1.2, 1.2, 2001)
    for _ in range(3000):
        low, room = 50000, 12.4
        mass, before = low + room * rng.integers(0, 2, 2) * rng.uniform(0, 1, 2)
        estimates = np.clip(before + rng.uniform(-300, 300) * tried, low, low + room)
        command = rng.uniform(-60, 60) + (estimates - 25) * tried
        assert np.all(np.diff(mass * tried - np.clip(command, -4e4, 4e4)) > 0)


def test_a_trailer_that_lacks_traction_has_the_errors_that_the_claim_says():
    """The floors of A2 in mm: at 83.5 m/s, and where the train gains speed at 0.3 m/s^2 from rest."""
    mass, friction, stiffness, damping = 5e4, 5e4 * 2.28e-4, 2e6, 1e5
    cruise = mass * (7.75e-3 + 2.28e-4 * 83.5)
    assert round(cruise) == 1339
    for lacking, floor, behind in ((cruise, 0.16, 0.67), (mass * (0.3 + 7.75e-3), 1.83, 7.69)):
        assert round(1e3 * lacking / (friction + 4 * stiffness + 4 * damping), 2) == floor
        assert round(1e3 * lacking / stiffness, 2) == behind
        after_ten_seconds = 10 * lacking / (2 * mass + 10 * (friction + 4 * stiffness + 4 * damping))
        assert after_ten_seconds > {0.16: 0.159e-3, 1.83: 1.82e-3}[floor]


def test_brakes_drive_the_train_of_table_1_to_any_speed_backwards():
    """(1), (2), all cars at one speed, from rest, braked by 4e4 N each: the time to any speed is finite."""
    brake, c_0, c_v, c_a = 4e4 / 5e4, 7.75e-3, 2.28e-4, 1.66e-5
    speeds = np.concatenate([np.linspace(0, 1e5, 1_000_001), np.geomspace(1e5, 1e9, 100_001)[1:]])
    backwards = brake + c_0 - c_v * speeds + c_a * speeds**2
    assert backwards.min() > 0 and 430 < np.trapezoid(1 / backwards, speeds) < 440


def first_iteration_on_a_hill(c_2: float, gamma: dict[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Times and v_1 by (1)-(3), (8)-(12), (16), (17)-(21) typed from the paper; a motor car needs 39.9 kN."""
    mass, c_0, c_v, c_a, c_k, c_d = 5e4, 7.75e-3, 2.28e-4, 1.66e-5, 2e6, 1e5
    c_1, c_3 = 0.01, 0.04
    chain = np.diag([1.0, 2, 2, 2, 2, 1]) - np.eye(6, k=1) - np.eye(6, k=-1)
    high, low = np.array([4e4, 0] * 3), np.full(6, -4e4)
    needed = np.array([3.99e4, 0] * 3)
    assert np.all((low <= needed) & (needed <= high))  # Assumption 2: u_r lies within the limits
    hill = mass * c_0 - needed  # f^a

    def rates(_: float, state: np.ndarray) -> np.ndarray:
        s, v, lambda_1, lambda_2 = state.reshape(4, 6)
        z_1, z_2 = s - lambda_1, v + c_1 * s - lambda_2
        phi = np.append(v[0] ** 2, np.zeros(5))
        rest = -mass * (c_0 + c_v * v) - 6 * mass * c_a * phi - c_k * chain @ s - c_d * chain @ v + hill
        learned = c_3 * (gamma["v"] * z_2 * v**2 + gamma["a"] * (z_2 @ phi) * phi + gamma["eta"] * z_2
                         + gamma["k"] * (z_2 @ chain @ s) * (chain @ s) + gamma["d"] * (z_2 @ chain @ v) * (chain @ v))
        kappa = -(c_2 * (v + c_1 * s) + c_1 * v + z_1) / c_3 - learned
        u = np.clip(mass * c_3 * (kappa + rest) - rest, low, high)  # solves (16): the estimate of the mass is the mass
        acceleration = (u + rest) / mass
        mu = kappa + (mass - 1 / c_3) * acceleration
        assert np.allclose(np.clip(mu, low, high), u, atol=1e-3 * max(1.0, np.abs(acceleration).max()))
        return np.concatenate([v, acceleration, -c_1 * lambda_1 + lambda_2, -c_2 * lambda_2 + c_3 * (u - mu)])

    def fast(_: float, state: np.ndarray) -> float:
        return float(state[6] + 1e4)

    fast.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(rates, (0, 3700), np.zeros(24), method="Radau", events=fast, rtol=1e-6, atol=1e-6)
    assert run.success
    return run.t, run.y[6]


def test_the_loop_itself_runs_away_backwards_in_its_first_iteration():
    times, speeds = first_iteration_on_a_hill(10, {"v": 0.125, "a": 2.5e-4, "k": 100, "d": 100, "eta": 100})
    assert 3616 < times[-1] < 3617 and -26 < speeds[times.searchsorted(60)] < -25


def test_at_the_gains_of_section_4_it_does_not():
    times, speeds = first_iteration_on_a_hill(100, {"v": 10, "a": 0.02, "k": 8000, "d": 8000, "eta": 8000})
    assert times[-1] == 3700 and -10.1 < speeds.min() < -9.5 and speeds[-1] > speeds.min() + 1


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


def test_the_motion_that_breaks_the_printed_53_is_the_one_that_its_note_tells():
    """A constant relative acceleration of 0.015 m/s^2 for 237.5 s, at c_1 = 3/4."""
    found = json.loads((PROOFS / "chen2019" / "certificates" / "53.json").read_text())
    assert (found["point"]["e_a"], found["duration"], found["point"]["c_1"]) == ("-3/200", "475/2", "3/4")
