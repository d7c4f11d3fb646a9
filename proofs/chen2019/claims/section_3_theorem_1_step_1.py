"""Theorem 1, step 1: the composite energy function does not increase, up to (35)."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater
from workbench.trains.multi_particle import each_car, over_cars, s, v

from ..energy_function import Z_1, Z_2, V, V_before, V_now, decay, estimation_terms
from ..error_dynamics import flow, sums_named
from ..goal_forms import both, integrated
from ..laws import (
    M_tilde,
    c_1,
    c_2,
    c_3,
    errors,
    gamma_eta,
    gamma_mass,
    halved,
    lambda_1,
    lambda_2,
    learning_gains,
    learning_steps,
    limited,
    s_r,
    squares,
    tildes,
    v_dot,
    v_r,
    z_2,
)
from ..one_car import (
    estimate,
    g_high,
    g_low,
    h,
    m_before,
    mass,
    mass_bound,
    mass_change,
    mass_within,
    one_car,
    unbounded_step,
    z_car,
)
from ..paper import EACH_CAR, EVERY_TRAIN, paper

A3_known = tuple(equal(one_car(x), y) for x, y in ((s, s_r), (v, v_r)))
V_start = one_car(V.xreplace(errors))


lambda_zero = (equal(one_car(lambda_1), 0), equal(one_car(lambda_2), 0))


def _starts_at_zero(*extra: Relation) -> Goal:
    return Goal((equal(V_start, 0),), (*A3_known, *extra))


@paper.claim("A3", "Assumption 3 makes V_i start at zero", "implication",
             r"s_i(0) = s_r(0),\ v_i(0) = v_r(0) \Rightarrow V_i(t) = \int_0^t\dot V_i(\tau)\,d\tau", "gap",
             scope=EACH_CAR, correction=lambda: _starts_at_zero(*lambda_zero),
             corrected_statement=r"s_i(0) = s_r(0),\ v_i(0) = v_r(0),\ \lambda_{1,i}(0) = \lambda_{2,i}(0) = 0 "
                                 r"\Rightarrow V_i(0) = 0",
             note="z contains lambda, whose initial value Assumption 3 does not name. It must be zero in every "
                  "iteration; before (51) the paper uses just that, so this is an omission, and later claims rest on "
                  "A3.lambda.")
def starts_at_zero() -> Goal:
    """V at the initial state that Assumption 3 names."""
    return _starts_at_zero()


@paper.claim("A3.lambda", "With the auxiliary state at zero V_i starts at zero", "implication",
             r"s_i(0) = s_r(0),\ v_i(0) = v_r(0),\ \lambda_{1,i}(0) = \lambda_{2,i}(0) = 0 \Rightarrow V_i(0) = 0",
             "proved", scope=EACH_CAR)
def starts_at_zero_with_lambda() -> Goal:
    """V at the initial state, lambda included."""
    return _starts_at_zero(*lambda_zero)


left, right, tilde_before, hat_before = sp.symbols("L R tilde_prev hat_prev", real=True)
# Equations of the change over an iteration and of the first iteration; the gain's index, the squared error, what drives
# it, the squared true parameter.
LEARNED = (
    ("27", "39", "v", r"\mathrm{tr}(\tilde\Theta_{v,i}^2)", r"z_{2,i}^T\tilde\Theta_{v,i}v_{i}",
     r"\mathrm{tr}(\Theta_v^2)", EACH_CAR),
    ("28", "40", "a", r"\tilde\theta_{a,i}^2", r"z_{2,i}^T\phi(v_{i})\tilde\theta_{a,i}", r"\theta_a^2", EVERY_TRAIN),
    ("29", "41", "k", r"\tilde\theta_{k,i}^2", r"z_{2,i}^TAs_{i}\tilde\theta_{k,i}", r"\theta_k^2", EVERY_TRAIN),
    ("30", "42", "d", r"\tilde\theta_{d,i}^2", r"z_{2,i}^TAv_{i}\tilde\theta_{d,i}", r"\theta_d^2", EVERY_TRAIN),
    ("31", "43", r"\eta", r"\|\tilde\eta_{i}\|^2", r"z_{2,i}^T\tilde\eta_{i}", r"\|\eta\|^2", EACH_CAR),
)


def _learning_bound(number: int) -> None:
    """(27)-(31): the change of an integral of squared errors of one estimate over an iteration."""
    equation, _, index, square, term, _, scope = LEARNED[number]
    gain, step = learning_gains[number], one_car(learning_steps[number])
    before = square.replace("i}", "i-1}")

    @paper.claim(equation, f"Change of the squared error with gain {gain}", "inequality",
                 rf"\tfrac1{{2\gamma_{index}}}\int_0^t({square} - {before})d\tau \le c_3\int_0^t{term}\,d\tau",
                 "proved", scope=scope,
                 note="With the equalities that (27) prints on the way. What is dropped is the square of the step. It "
                      "supposes the same true parameter in both iterations; see 31.place.")
    def change() -> Goal:
        tilde, hat = tilde_before + step, hat_before + step
        true = hat_before - tilde_before
        squared = (tilde**2 - tilde_before**2) / (2 * gain)
        goal = integrated({left: squared, right: step / gain * tilde}, at_most(left, right), constant=(gain,))
        lines = (equal(squared, (hat_before - hat) * (2 * true - hat - hat_before) / (2 * gain)),
                 equal(squared, (hat - hat_before) * tilde / gain - (hat_before - hat) ** 2 / (2 * gain)))
        return replace(goal, show=(*lines, *goal.show))


for number in range(5):
    _learning_bound(number)

place, place_before, slope = sp.symbols("s s_prev f_slope", real=True)


@paper.claim("31.place", "The additional resistance is the same in two iterations", "implication",
             r"f^a_{i,j}(t) = f^a(s_{i,j}(t)) \Rightarrow \text{(31)}", "gap",
             scope=EACH_CAR,
             note="The paper ascribes f^a to slopes, tunnels and bridges and takes it for a function of time alone. "
                  "These depend on the place, and two iterations are at different places at the same time, so eta "
                  "differs between them and (31) fails; in the counterexample f^a is linear in the place. (31) itself "
                  "stands for an f^a of time alone.")
def same_place_in_every_iteration() -> Goal:
    """(31) at one instant with f^a = f_slope s."""
    hat = tilde_before + slope * place_before + gamma_eta * c_3 * z_car
    tilde = hat - slope * place
    return Goal((at_most((tilde**2 - tilde_before**2) / (2 * gamma_eta), c_3 * z_car * tilde),))


@paper.claim("32", "Change of the integral for the mass", "inequality",
             r"\tfrac{1}{2\gamma_M}\mathrm{tr}(\tilde M_i^2 - \tilde M_{i-1}^2) \le \tfrac1{\gamma_M}\mathrm{tr}((\hat "
             r"M_{i-1} - \hat M_i)(M - \hat M_i)) = \tfrac1{\gamma_M}\mathrm{tr}((\hat M_{i-1} - \gamma_Mc_3"
             r"\mathcal D(z_{2,i})\mathcal D(\dot v_i) - \hat M_i)(M - \mathrm{sat}(\dots))) - c_3\mathrm{tr}("
             r"\mathcal D(z_{2,i})\mathcal D(\dot v_i)\tilde M_i)", "proved",
             scope=f"{EACH_CAR}; at every instant, hence for the integrals")
def mass_step_limited() -> Goal:
    """The dropped square, and (22) put in."""
    middle = (m_before - estimate) * (mass - estimate) / gamma_mass
    return Goal((at_most(mass_change, middle),
                 equal(middle, (unbounded_step - estimate) * (mass - estimate) / gamma_mass + mass_bound)))


@paper.claim("33", "Property 1 applied to the estimate of the mass", "inequality",
             r"\mathrm{tr}((\hat M_{i-1} - \gamma_Mc_3\mathcal D(z_{2,i})\mathcal D(\dot v_i) - \hat M_i)(M - "
             r"\mathrm{sat}(\dots, \underline M, \overline M))) \le 0", "proved", premises=("6",), scope=EACH_CAR)
def mass_projection() -> Goal:
    """With Assumption 1."""
    return Goal((at_most((unbounded_step - estimate) * (mass - estimate), 0),), mass_within)


@paper.claim("34", "Bound of the change for the mass", "inequality",
             r"\tfrac{1}{2\gamma_M}\int_0^t\mathrm{tr}(\tilde M_i^2 - \tilde M_{i-1}^2)d\tau \le -c_3\int_0^t "
             r"z_{2,i}^T\tilde M_i\dot v_i\,d\tau", "proved", premises=("32", "33"), scope=EACH_CAR)
def mass_integral() -> Goal:
    """Between integrals, with (22) as it stands and Assumption 1 at every instant."""
    return integrated({left: mass_change, right: mass_bound}, at_most(left, right),
                      (*mass_within, greater(mass, 0)), (gamma_mass,))


@paper.claim("22.form", "The saturation of (22), without cases", "identity",
             r"\hat m = \mathrm{sat}(h,\underline m,\overline m),\ p = \max(h - \overline m, 0),\ q = "
             r"\max(\underline m - h, 0) \Rightarrow \hat m = h - p + q,\ p(\overline m - \hat m) = q(\hat m - "
             r"\underline m) = 0",
             "proved", scope=EACH_CAR,
             note="The form in which (22) enters 35.whole and 45.gain, where it stands under a sum.")
def saturation_form() -> Goal:
    """Complementarity of the projection on an interval."""
    sat, p, q_ = limited(h, g_low, g_high), sp.Max(h - g_high, 0), sp.Max(g_low - h, 0)
    return Goal((*both(sat, h - p + q_), *both(p * (g_high - sat), sp.S.Zero), *both(q_ * (sat - g_low), sp.S.Zero)),
                (at_most(g_low, g_high),))


# (22) under the sums: M_hat_i = M_hat_prev - gamma_M c_3 z_2 v_dot - P^2 + Q^2 with P^2 (M_high - M_hat_i) = 0 =
# Q^2 (M_hat_i - M_low), and Assumption 1: M_high = M + A^2, M_low = M - B^2 (22.form).
P, Q, room_above, room_below, M_step = each_car("P Q A B M_step")


def mass_rule(step: sp.Expr) -> tuple[Relation, ...]:
    """(22) times M_tilde, for a step M_hat_i - M_hat_prev, and its complementarity, which hold car by car."""
    return (equal(over_cars(M_tilde * (step + gamma_mass * c_3 * z_2 * v_dot + P**2 - Q**2)), 0),
            equal(over_cars(P**2 * (room_above**2 - M_tilde)), 0),
            equal(over_cars(Q**2 * (M_tilde + room_below**2)), 0))


def each_estimate(left_sides: tuple[sp.Expr, ...], wrong: tuple[sp.Expr, ...]) -> tuple[Relation, ...]:
    """Lemmas: Property 1 under the sum, and each left side against minus its term of `estimation_terms`."""
    terms = zip(left_sides, estimation_terms(z_2, wrong), strict=True)
    return (at_least(over_cars(M_tilde * (P**2 - Q**2)), 0), *(at_most(x, -term) for x, term in terms))


rolling_before, *scalars_before, rest_before = (x - step for x, step in zip(tildes, learning_steps, strict=False))
squares_before = (over_cars(rolling_before**2), *(x**2 for x in scalars_before), over_cars(rest_before**2),
                  over_cars((M_tilde - M_step) ** 2))


@paper.claim("35.whole", "The CEF does not increase: the whole argument in one certificate", "implication",
             r"\frac{d}{dt}(E_i - E_{i-1} + V_{i-1}) \le -c_1\|z_{1,i}\|^2 - c_2\|z_{2,i}\|^2\ \text{along (7), (9), "
             r"(16) with (17)-(22)}", "proved", premises=("22.form",), scope=EVERY_TRAIN,
             note="The checker derives V' from (23), the plant and the law by itself and puts the learning rules in, "
                  "without resting on the paper's intermediate lines. Integrated in 35 and 35.kept.")
def cef_whole() -> Goal:
    """D(V) along the closed loop, and the change of all squares by the learning rules."""
    changes = tuple(now - before for now, before in zip(halved(squares), halved(squares_before), strict=True))
    return Goal((at_most(D(V) + sp.Add(*changes), decay),), (*sums_named, *mass_rule(M_step)), flow,
                lemmas=each_estimate(changes, tildes))


changes, V_rate, C_rate = sp.symbols("C w_V w_C", real=True)
z_1_square, z_2_square = sp.symbols("z_1_square z_2_square", nonnegative=True)


def _cef_step(with_v_before: bool) -> Goal:
    """E_i - E_{i-1} = V_i - V_{i-1} + C, C being the changes of the integrals (27)-(31), (34)."""
    rates = {V_now: V_rate, changes: C_rate, Z_1: z_1_square, Z_2: z_2_square}
    bound = -c_1 * Z_1 - c_2 * Z_2 - (V_before if with_v_before else 0)
    always = (at_most(V_rate + C_rate, -c_1 * z_1_square - c_2 * z_2_square), at_least(z_1_square, 0),
              at_least(z_2_square, 0), at_least(V_before, 0))
    goal = integrated(rates, at_most(V_now - V_before + changes, bound), always, (c_1, c_2),
                      decreasing=V_now + changes + c_1 * Z_1 + c_2 * Z_2)
    return replace(goal, assume=(*goal.assume, at_least(V_before, 0)))


def _cef_claim(equation: str, title: str, term: str, note: str) -> None:
    @paper.claim(equation, title, "implication",
                 rf"\Delta E_i \le {term}-c_1\int_0^t\|z_{{1,i}}\|^2d\tau - c_2\int_0^t\|z_{{2,i}}\|^2d\tau", "proved",
                 premises=("24", "27", "28", "29", "30", "31", "34", "A3.lambda"), note=note)
    def cef_step() -> Goal:
        return _cef_step(with_v_before=bool(term))


_cef_claim("35", "The CEF does not increase", "",
           "Under A3.lambda, on which V_i(0) = 0 rests. The term -V_{i-1}(t) is dropped; see 35.kept.")
_cef_claim("35.kept", "The same with the term that (35) drops", "-V_{i-1} ",
           "What the paper's own steps give; the convergence at every instant needs this term.")
