"""Section III: the control law (16) contains the acceleration that its own force causes.

The paper does not mention this algebraic loop; none of these claims is printed.
"""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, less

from ..goal_forms import both
from ..laws import M_hat, c_3, gamma_mass, limited, loop_force, mass_step, mu_law, mu_of, v_dot
from ..one_car import (
    a,
    b,
    g_high,
    g_low,
    kappa,
    m_before,
    mass,
    mass_hat,
    one_car,
    rest,
    room,
    u_a,
    u_b,
    u_high,
    u_low,
    z_car,
)
from ..paper import EACH_CAR, paper
from ..stated_values import limit_stated, mass_stated, stated_gains

limits = (at_most(u_low, u_high),)


@paper.claim("16.loop", "The input depends on the acceleration that it causes", "identity",
             r"\mu_{i,j} = \kappa_{i,j} + \left(\hat m_{i,j} - \tfrac{1}{c_3}\right)\dot v_{i,j}", "proved",
             scope=EACH_CAR,
             note="kappa gathers all terms of (16) without the acceleration, with the estimates given. The paper does "
                  "not mention the loop. With 1/c_3 = 25 kg it feeds nearly the whole inertia force of a car back.")
def input_needs_acceleration() -> Goal:
    """(16) is affine in the acceleration when the estimates are given."""
    law, free = one_car(mu_law), one_car(v_dot)
    stated = mu_of(law.xreplace({free: sp.S.Zero}), free, one_car(M_hat))
    return Goal((equal(law, stated),))


@paper.claim("8.slope", "The saturation does not decrease and does not expand", "inequality",
             r"(\mathrm{sat}(\mu_a) - \mathrm{sat}(\mu_b))^2 \le (\mathrm{sat}(\mu_a) - \mathrm{sat}(\mu_b))(\mu_a - "
             r"\mu_b)", "proved", scope=EACH_CAR, note="Not printed; 16.unique leans on it.")
def saturation_slope() -> Goal:
    """Case by case of the two arguments."""
    step = limited(a, u_low, u_high) - limited(b, u_low, u_high)
    return Goal((at_most(step**2, step * (a - b)),), limits)


def _one_acceleration() -> Goal:
    inputs = zip((a, b), (u_a, u_b), strict=True)
    mu_a, mu_b = (mu_of(kappa, x, mass + 1 / c_3 - room) for x in (a, b))
    slope = at_most((u_a - u_b) ** 2, (u_a - u_b) * (mu_a - mu_b))
    return Goal((at_most((a - b) ** 2, 0),), (*(equal(u, mass * x - rest) for x, u in inputs), slope))


@paper.claim("16.unique", "(7), (8), (16) determine the acceleration, for any estimate of the mass", "implication",
             r"m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "gap",
             premises=("16.loop", "8.slope"), scope=EACH_CAR, correction=_one_acceleration,
             corrected_statement=r"\hat m_{i,j} < m_j + \tfrac{1}{c_3},\ m a = \mathrm{sat}(\mu(a)) + \rho,\ "
                                 r"m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b",
             note="A step the paper takes without words: (16) must define an input. rho gathers the other forces. At "
                  "m_hat = m + 1/c_3 every acceleration within the limits solves the equations (the counterexample: "
                  "both unsaturated), above it up to three do.")
def acceleration_unique() -> Goal:
    """Two solutions of the loop of one car, both within the limits, agree."""
    within_limits = [(at_least(mu_of(kappa, x, mass_hat), u_low), at_most(mu_of(kappa, x, mass_hat), u_high),
                      equal(mass * x, mu_of(kappa, x, mass_hat) + rest)) for x in (a, b)]
    return Goal((equal(a, b),), tuple(r for group in within_limits for r in group))


@paper.claim("16.exists", "Below m + 1/c_3 the loop has a solution, in closed form", "implication",
             r"\hat m_{i,j} < m_j + \tfrac{1}{c_3},\ u = \mathrm{sat}\left(\tfrac{m(\kappa + \rho)}{m + 1/c_3 - "
             r"\hat m} - \rho, \underline u, \overline u\right),\ m\dot v = u + \rho \Rightarrow u = "
             r"\mathrm{sat}(\mu(\dot v), \underline u, \overline u)", "proved", premises=("16.loop",), scope=EACH_CAR,
             note="Not in the paper: the rule by which the loop can be solved when the estimate of the mass is given.")
def acceleration_exists() -> Goal:
    """The force of the unsaturated equation, saturated, solves the saturated one."""
    force = loop_force(mass, kappa, rest, room, u_low, u_high)
    law = mu_of(kappa, (force + rest) / mass, mass - room + 1 / c_3)
    return Goal(both(force, limited(law, u_low, u_high)), limits)


m_high = sp.Symbol("m_high", positive=True)


@paper.claim("16.stated", "Every estimate that Assumption 1 allows leaves the loop unique", "condition",
             r"\overline m_j < m_j + \tfrac{1}{c_3}", "violated", premises=("16.unique",),
             at={mass: mass_stated, m_high: mass_stated + 80, c_3: stated_gains[c_3]},
             repair={mass: mass_stated, m_high: mass_stated + 80, c_3: Fraction(1, 100)},
             note="Not a condition of the paper, which does not mention the loop. The mass bounds are not stated "
                  "(assumed: the mass of Table 1 and one passenger of 80 kg more). 1/c_3 = 25 kg is less than a "
                  "passenger, while full load (Remark 1) is tonnes above the self-weight.")
def loop_unique_as_stated() -> Goal:
    """The upper mass bound against the singular estimate."""
    return Goal((less(m_high, mass + 1 / c_3),))


deviation_left = float(1 - 1 / (stated_gains[c_3] * mass_stated))


@paper.claim("16.sampled", "With the acceleration of the sample before, the loop settles", "condition",
             r"|\hat m_{i,j} - \tfrac{1}{c_3}| < m_j", "proved", premises=("16.loop",),
             at={mass: mass_stated, mass_hat: mass_stated, c_3: stated_gains[c_3]},
             note="Not a condition of the paper. An unsaturated car then has m a(k+1) = kappa + (m_hat - 1/c_3) a(k) "
                  f"+ rho. With the true mass a deviation shrinks to {deviation_left:.4f} of itself per sample, so a "
                  "car answers to its control law only after thousands of samples; with m_hat > m + 1/c_3 deviations "
                  "grow.")
def sampled_loop_settles() -> Goal:
    """The factor of a deviation of the acceleration from one sample to the next."""
    return Goal((less((mass_hat - 1 / c_3) ** 2, mass**2),))


@paper.claim("16.learning", "With (22) in the loop the acceleration is unique at the stated gains", "condition",
             r"\hat m = \mathrm{sat}(\hat m_{i-1} - \gamma_M c_3 z_2\dot v, \underline m, \overline m):\ "
             r"m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "violated",
             premises=("16.loop",), scope="one motor car in the first iteration",
             at={mass: mass_stated, m_before: mass_stated, g_low: mass_stated, g_high: mass_stated + 1000,
                 c_3: stated_gains[c_3], gamma_mass: Fraction(8000), z_car: Fraction(-2), u_low: -limit_stated,
                 u_high: limit_stated, kappa: Fraction(1339), rest: Fraction(-1339), a: Fraction(0),
                 b: Fraction(25, 640)},
             note="Not a condition of the paper. (22) uses the acceleration of the same instant, so (16) is quadratic "
                  "in it: a car that rolls at constant speed against 1339 N with z_2 = -2 m/s may as well accelerate "
                  "at 0.039 m/s^2 (and at 0.77 m/s^2, saturated), already from the initial estimate. With the "
                  "acceleration of the sample before in (22) the estimate is given, and 16.unique decides. The mass "
                  "bounds are not stated (assumed: the mass of Table 1 and 1 t more).")
def loop_with_learning() -> Goal:
    """Two accelerations that solve (7), (8), (16), (22) of one car."""
    def balance(x: sp.Expr) -> Relation:
        estimate = limited(m_before + mass_step(z_car, x), g_low, g_high)
        return equal(mass * x, limited(mu_of(kappa, x, estimate), u_low, u_high) + rest)

    return Goal(both(a, b), (balance(a), balance(b)))
