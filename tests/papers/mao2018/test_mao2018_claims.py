"""mao2018's rates of V_2 in plain numbers, typed from the paper for four modes: what its claims say of them."""

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from scenarios import PROOFS

from workbench.proof.decide.engine import decide
from workbench.proof.loading import ProofFile
from workbench.proof.paper import papers_in

MODES, MOTORS, HEALTHY = 4, 16, 15


@pytest.fixture(scope="module")
def claims():
    found, = papers_in(ProofFile(PROOFS / "mao2018"))
    return {claim.equation: claim for claim in found.claims}


def instant(seed):
    """Random numbers of one instant: mode 0 is active, with ramps for its slope and its disturbance."""
    r = random.Random(seed)
    draw = lambda: r.uniform(-2, 2)  # noqa: E731
    size = lambda: r.uniform(0.5, 3)  # noqa: E731
    return {
        "m": [size() for _ in range(MODES)], "true": [[draw() for _ in range(5)] for _ in range(MODES)],
        "hat": [[draw() for _ in range(5)] for _ in range(MODES)],
        "gain": [[size() for _ in range(5)] for _ in range(MODES)],
        "rho_hat": [draw() for _ in range(MODES)], "Gamma_m": [size() for _ in range(MODES)],
        "by": [1.0, (x := draw()), x * x, 9.81, 0.004], "chi": [1.0, 1.0, 1.0, r.uniform(0, 1), 1.0],
        "chi_d": r.uniform(0, 1),
        "z": (draw(), draw()), "r": (size(), size()), "xdd": draw(), "d": draw(), "lambda": 3.0, "Gamma_k": size(),
        "Gamma_xi": size(), "rho_k_hat": draw(),
        "xi": [draw(), draw()], "xi_hat": [draw(), draw()], "varpi": [1.0, draw()],
    }


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def rate_of_v2(q, sign_44, fitting):
    """The rate of (40) along (39), (42) with (43), (27)-(31), (37), (41), (44), and -r_1 z_1^2 - r_2 z_2^2."""
    (z_1, z_2), (r_1, r_2), m = q["z"], q["r"], q["m"][0]
    carried = [chi * by for chi, by in zip(q["chi"], q["by"], strict=True)]
    zeta = dot(q["hat"][0], carried)
    eta = z_1 + r_1 * (z_2 - r_1 * z_1) - q["xdd"]
    wanted = zeta - eta - r_2 * z_2
    sign = (z_2 > 0) - (z_2 < 0)
    nu_d = -q["lambda"] / (m * HEALTHY) * sign
    push_hat = dot(q["xi_hat"], q["varpi"])
    nu_0 = -q["rho_k_hat"] * push_hat + nu_d + q["rho_hat"][0] * wanted
    force = HEALTHY * nu_0 + dot(q["xi"], q["varpi"])
    z_1_rate = z_2 - r_1 * z_1
    z_2_rate = m * force - dot(q["true"][0], carried) + q["d"] * q["chi_d"] + r_1 * z_1_rate - q["xdd"]
    errors = sum((x - hat) / gain * gain * z_2 * by for x, hat, gain, by in zip(
        q["true"][0], q["hat"][0], q["gain"][0], carried, strict=True))
    of_k, of_xi, of_rho = (m * HEALTHY, m, m * HEALTHY) if fitting else (sum(q["m"]), sum(q["m"]), m)
    errors += of_rho * (1 / (m * HEALTHY) - q["rho_hat"][0]) * z_2 * wanted
    errors -= of_k * (1 / HEALTHY - q["rho_k_hat"]) * sign_44 * z_2 * push_hat
    errors -= of_xi * z_2 * sum((x - hat) * w for x, hat, w in zip(q["xi"], q["xi_hat"], q["varpi"], strict=True))
    return z_1 * z_1_rate + z_2 * z_2_rate + errors, -r_1 * z_1**2 - r_2 * z_2**2


def test_with_the_sign_of_44_and_the_weights_mended_v2_falls_as_45_says(claims):
    assert decide(claims["45.mended"]).verdict == "proved"
    for seed in range(200):
        rate, decay = rate_of_v2(instant(seed), +1, fitting=True)
        assert rate <= decay + 1e-9


def test_as_printed_it_does_not_nor_with_the_sign_alone(claims):
    assert decide(claims["45"]).verdict == "refuted"
    for sign in (-1, +1):
        found = [rate_of_v2(instant(seed), sign, fitting=False) for seed in range(200)]
        assert any(rate > decay + 1 for rate, decay in found)


def test_what_is_left_over_of_41_is_the_idle_masses_times_the_failures_error():
    for seed in range(20):
        q = instant(seed)
        idle_only = {**q, "rho_hat": [1 / (m * HEALTHY) for m in q["m"]], "rho_k_hat": 1 / HEALTHY}
        with_all, _ = rate_of_v2(idle_only, +1, fitting=False)
        with_one, _ = rate_of_v2(idle_only, +1, fitting=True)
        error = sum((x - hat) * w for x, hat, w in zip(q["xi"], q["xi_hat"], q["varpi"], strict=True))
        assert with_all - with_one == pytest.approx(-sum(q["m"][1:]) * q["z"][1] * error)


def test_the_product_of_two_sums_over_modes_keeps_the_active_one_alone(claims):
    assert decide(claims["35.modes"]).verdict == "proved"
    q = instant(1)
    for active in range(MODES):
        chi = [float(i == active) for i in range(MODES)]
        assert dot(q["m"], chi) * dot(chi, q["rho_hat"]) == pytest.approx(
            sum(m * c * part for m, c, part in zip(q["m"], chi, q["rho_hat"], strict=True)))


def test_the_printed_signal_is_that_of_the_modes_only_while_one_is_active(claims):
    """-rho_k xi_hat^T varpi stands before the sum in (42) and within it in the simulation."""
    assert all(decide(claims[f"{law}.law"]).verdict == "proved" for law in (35, 42, 48, 55, 60))
    goal = claims["42.law"].build()
    free = replace(goal, assume=goal.assume[:1])  # without sum chi_mi = 1
    assert decide(replace(claims["42.law"], build=lambda: free)).verdict == "refuted"


def test_every_number_has_a_row(claims):
    numbers = {int(equation.split(".")[0]) for equation in claims if equation.split(".")[0].isdigit()}
    assert set(range(1, 68)) <= numbers


@pytest.mark.parametrize("law, other", [("54", "54.glyph"), ("61", "61.glyph"), ("44", "44.mended")])
def test_a_law_fails_with_its_printed_sign_and_holds_with_the_other(claims, law, other):
    assert decide(claims[law]).verdict == "refuted"
    assert decide(claims[other]).verdict == "proved"


@pytest.mark.parametrize("theorem", ["theorem2", "theorem3", "theorem4", "theorem5", "remark4"])
def test_the_printed_loop_has_an_exact_motion_that_breaks_the_theorem(claims, theorem):
    decision = decide(claims[theorem])
    assert decision.verdict == "refuted"
    assert decision.certificate["functions"]["z_1"] == "1" or theorem == "theorem5"


@pytest.mark.parametrize("line", ["45", "51", "57", "63.bound", "65"])
def test_the_bounds_fail_where_the_weights_of_40_fit_and_44_alone_is_at_fault(claims, line):
    point = decide(claims[line]).certificate["point"]
    assert point["k_v"] == "1" and point["m_idle"] == "0" and point["rho_hat"] == "1" == point["m_i"]
    assert line != "57" or point["lambda_hat"] == point["lambda_0"]


@pytest.mark.parametrize("line", ["theorem1", "theorem1.F", "theorem1.z2", "theorem1.speed", "47.signal"])
def test_what_takes_a_bound_of_the_desired_curve_or_of_the_failures_does_not_follow(claims, line):
    assert decide(claims[line]).verdict == "gap"
    assert decide(claims[f"{line}.mended"]).verdict == "proved"


@pytest.mark.parametrize("line", ["theorem1.alpha", "theorem1.z2", "theorem1.speed"])
def test_what_takes_a_bounded_x_m_dot_dot_follows_where_the_sentence_after_theorem_1_has_two_dots(claims, line):
    assert decide(claims[line]).verdict == "gap"
    assert claims[line].glyph == f"mao2018:{line}.dots"
    assert decide(claims[f"{line}.dots"]).verdict == "proved"


@pytest.mark.parametrize("line, slope", [("theorem2.speed", "t"), ("theorem3.speed", "t"), ("65.errors", "1 + t")])
def test_the_printed_loop_has_an_exact_motion_along_which_the_position_error_grows(claims, line, slope):
    decision = decide(claims[line])
    assert decision.verdict == "refuted" and decision.certificate["functions"]["z_1"] == slope
    assert decision.certificate["point"]["xdot_m"] == "0" == decision.certificate["point"]["d_i"]


@pytest.mark.parametrize("section", ["IV", "VII"])
def test_that_motion_typed_anew_obeys_every_printed_law(section):
    """Section IV: (27)-(31), (37), (41), (42)-(44); section VII: (60)-(62) besides, (61) instead of (37)."""
    kappa, begins, b, p = (0, 1, Fraction(2, 3), 2) if section == "IV" else (
        Fraction(14, 25), 2, Fraction(16, 25), Fraction(36, 25))
    for t in (Fraction(0), Fraction(1, 3), Fraction(7, 2)):
        u = t + begins  # z_2; its rate and that of z_1 = u - 1 are 1, so that x_2 = 1
        f = 2 + b / u
        push_hat = 8 * u**2 - b**2 + (u**2 + b * u) * f
        rho, rho_k = p * u**3 / 3 + Fraction(5, 2) * u**4, -b * u**3 - Fraction(5, 2) * u**4
        zeta = -10 * u**2  # 16 + 1 + 1 + 1 + 1 times -u^2/2
        wanted, damping = zeta - ((u - 1) + 1) - u, -kappa * u
        signal = -rho_k * push_hat - Fraction(1, 15) + rho * (wanted + damping)  # (42), (60)
        assert 15 * signal + 1 + 1 == 1  # (39): z_2' = k_nu nu_0 + xi^T varpi + r_1 z_1'
        assert p * u**2 + 10 * u**3 == -u * (wanted - damping)  # (37), (61)
        assert -3 * b * u**2 - 10 * u**3 == -u * push_hat  # (44)
        assert 2 * u + b == u * f  # (41), of f; of the 16 ones 16 u = 16 z_2
        assert push_hat == 3 * b * u + 10 * u**2


def test_theorems_2_and_3_do_not_let_the_speed_track_as_printed_and_do_as_mended(claims):
    for line in ("theorem2.speed", "theorem3.speed"):
        assert decide(claims[f"{line}.mended"]).verdict == "proved"
    assert decide(claims["theorem2.z2.loop"]).verdict == decide(claims["theorem2.z2"]).verdict == "proved"


@pytest.mark.parametrize("line", ["theorem4.reading", "theorem5.reading", "remark4.reading"])
def test_the_theorems_fall_with_the_other_signs_of_54_and_61_too(claims, line):
    assert decide(claims[line]).verdict == "refuted"


def test_whole_theorems_are_proved_where_they_stand(claims):
    for theorem in ("theorem1", "theorem1.speed", *(f"theorem{number}" for number in range(2, 6))):
        assert decide(claims[f"{theorem}.mended"]).verdict == "proved"


def test_a_weight_of_lambda_tilde_makes_its_estimate_drop_out_whatever_its_sign():
    """The terms of lambda_hat in the rate of V_2 by (54) with a plus and (56), at random instants."""
    r = random.Random(11)
    for _ in range(200):
        m, healthy, bound = r.uniform(0.5, 3), r.uniform(1, 16), r.uniform(1, 3)
        z_2, estimate = r.uniform(-2, 2), r.uniform(-5, 5)
        rho = m * healthy * r.uniform(0.2, 1)
        weight = m * healthy / rho
        left = m * healthy * z_2 * (-estimate / rho * ((z_2 > 0) - (z_2 < 0))) - weight * (bound - estimate) * abs(z_2)
        assert left == pytest.approx(-weight * bound * abs(z_2)) and left <= -bound * abs(z_2) + 1e-9
