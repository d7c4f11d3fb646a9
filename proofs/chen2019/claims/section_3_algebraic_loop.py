"""Section III: the control law (16) contains the acceleration that its own force causes.

The paper does not mention this algebraic loop: none of these claims is printed. That (16) defines an input is a step
it takes without words; the others are questions of ours.
"""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, differ, equal, less

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
from ..stated_values import at_stated, limit_stated, mass_stated, stated_gains, stated_learning

limits = (at_most(u_low, u_high),)
# A car of section IV without other forces.
alone_as_stated = (equal(kappa, 0), equal(rest, 0), equal(u_low, -limit_stated), equal(u_high, limit_stated),
                   equal(mass, mass_stated), equal(c_3, at_stated[c_3]))


@paper.claim("16.loop", "The input depends on the acceleration that it causes", "identity",
             r"\mu_{i,j} = \kappa_{i,j} + \left(\hat m_{i,j} - \tfrac{1}{c_3}\right)\dot v_{i,j}", "proved",
             origin="ours", scope=EACH_CAR,
             note="kappa gathers all terms of (16) without the acceleration, with the estimates given. The paper does "
                  "not mention the loop. With 1/c_3 = 25 kg it feeds nearly the whole inertia force of a car back.")
def input_needs_acceleration() -> Goal:
    """(16) is affine in the acceleration when the estimates are given."""
    law, free = one_car(mu_law), one_car(v_dot)
    stated = mu_of(law.xreplace({free: sp.S.Zero}), free, one_car(M_hat))
    return Goal((equal(law, stated),))


@paper.claim("8.slope", "The saturation does not decrease and does not expand", "inequality",
             r"(\mathrm{sat}(\mu_a) - \mathrm{sat}(\mu_b))^2 \le (\mathrm{sat}(\mu_a) - \mathrm{sat}(\mu_b))(\mu_a - "
             r"\mu_b)", "proved", origin="ours", scope=EACH_CAR)
def saturation_slope() -> Goal:
    """Case by case of the two arguments."""
    step = limited(a, u_low, u_high) - limited(b, u_low, u_high)
    return Goal((at_most(step**2, step * (a - b)),), limits)


@paper.claim("16.unique", "(16), an equation in the acceleration that its input causes, has one solution, even where the mass is estimated "
             "1/c_3 = 25 kg too high",
             "implication",
             r"m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "gap",
             origin="implied", premises=("16.loop", "8.slope"), rests_on=(), scope=EACH_CAR,
             reading="With the estimate of the mass given, at c_3 = 0.04, for a car of 50 t with limits of 40 kN, without other forces.",
             note="A remark: the paper does not print it, but (16) must define an input, and it needs the acceleration of the "
                  "same instant. A solution there always is, since the saturated force is bounded and m a is not; which one it "
                  "is stays open. Theorem 1.2 and the inequalities of part 3 hold for each. At m_hat = m + 1/c_3 and kappa + "
                  "rho = 0 every acceleration within the limits solves the equations, above it up to three do. For an estimate that "
                  "is given, c_3 (m_high - m_low) < 1 rules it out (16.rule); for that of (22), which contains the acceleration, "
                  "2 c_3 (m_high - m_low) < 1 does (16.learning.mended). At c_3 = 0.04 the mass of a car must then be known within "
                  "25 kg, with (22) within 12.5 kg, while by Remark 1 it varies from self-weight to full load. Section IV does not "
                  "print the bounds.")
def acceleration_unique() -> Goal:
    """Two solutions of the loop of one car without other forces, that pulls and brakes, both within the limits, agree."""
    within_limits = [(at_least(mu_of(kappa, x, mass_hat), u_low), at_most(mu_of(kappa, x, mass_hat), u_high),
                      equal(mass * x, mu_of(kappa, x, mass_hat) + rest)) for x in (a, b)]
    return Goal((equal(a, b),), (*(r for group in within_limits for r in group), *alone_as_stated,
                                 equal(mass_hat, mass_stated + 1 / at_stated[c_3])))


@paper.claim("16.unique.mended", "For a given estimate below m + 1/c_3 the acceleration is unique", "implication",
             r"\hat m_{i,j} < m_j + \tfrac{1}{c_3},\ m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + "
             r"\rho \Rightarrow a = b", "proved", origin="ours", mends="16.unique", premises=("16.loop", "8.slope"),
             scope=EACH_CAR)
def acceleration_unique_below() -> Goal:
    """With 8.slope for the two inputs."""
    inputs = zip((a, b), (u_a, u_b), strict=True)
    mu_a, mu_b = (mu_of(kappa, x, mass_hat) for x in (a, b))
    slope = at_most((u_a - u_b) ** 2, (u_a - u_b) * (mu_a - mu_b))
    return Goal((at_most((a - b) ** 2, 0),),
                (less(mass_hat, mass + 1 / c_3), *(equal(u, mass * x - rest) for x, u in inputs), slope))


@paper.claim("16.rule", "A c_3 for which the acceleration is unique whatever estimate is given", "implication",
             r"c_3(\overline m_j - \underline m_j) < 1,\ \underline m_j \le m_j,\ \hat m_{i,j} \le \overline m_j \Rightarrow "
             r"\hat m_{i,j} < m_j + \tfrac{1}{c_3}", "proved", origin="ours", scope=EACH_CAR,
             note="With Assumption 1, for an estimate within its bounds that is given; for that of (22) see 16.learning.mended. At c_3 = "
                  "0.04 the mass of a car would have to be known within 25 kg; the stated c_3 is too large for any load that "
                  "changes by more.")
def rule_for_c_3() -> Goal:
    """The room m + 1/c_3 - m_hat is positive."""
    return Goal((less(mass_hat, mass + 1 / c_3),),
                (less(c_3 * (g_high - g_low), 1), at_most(g_low, mass), at_most(mass_hat, g_high)))


@paper.claim("16.exists", "Below m + 1/c_3 the loop has a solution, in closed form", "implication",
             r"\hat m_{i,j} < m_j + \tfrac{1}{c_3},\ u = \mathrm{sat}\left(\tfrac{m(\kappa + \rho)}{m + 1/c_3 - "
             r"\hat m} - \rho, \underline u, \overline u\right),\ m\dot v = u + \rho \Rightarrow u = "
             r"\mathrm{sat}(\mu(\dot v), \underline u, \overline u)", "proved", origin="ours", premises=("16.loop",),
             scope=EACH_CAR,
             note="The rule by which the loop can be solved when the estimate of the mass is given.")
def acceleration_exists() -> Goal:
    """The force of the unsaturated equation, saturated, solves the saturated one."""
    force = loop_force(mass, kappa, rest, room, u_low, u_high)
    law = mu_of(kappa, (force + rest) / mass, mass - room + 1 / c_3)
    return Goal(both(force, limited(law, u_low, u_high)), limits)


@paper.claim("16.stated", "An estimate of the mass 25 kg above the mass makes every acceleration a solution",
             "implication",
             r"c_3 = 0.04,\ \hat m_{i,j} = m_j + 25,\ \kappa_{i,j} = -\rho_j \Rightarrow m_j\dot v = \mu(\dot v) + "
             r"\rho_j\ \text{for every } \dot v", "proved", origin="ours", premises=("16.loop",), scope=EACH_CAR,
             note="Assumption 1 and (22) let the estimate lie anywhere between the mass bounds, which the paper does "
                  "not state; by Remark 1 they are tonnes apart, self-weight and full load. With 1/c_3 = 25 kg less "
                  "than a passenger is enough.")
def loop_singular_as_stated() -> Goal:
    """The unsaturated equation of one car at the singular estimate of the stated c_3."""
    at_c_3 = {c_3: at_stated[c_3]}
    estimate = mass + (1 / c_3).xreplace(at_c_3)
    return Goal((equal(mass * a, mu_of(kappa, a, mass_hat).xreplace(at_c_3) + rest),),
                (equal(mass_hat, estimate), equal(kappa, -rest)))


deviation_left = float(1 - 1 / (stated_gains[c_3] * mass_stated))


@paper.claim("16.sampled", "With the acceleration of the sample before, the loop settles", "condition",
             r"|\hat m_{i,j} - \tfrac{1}{c_3}| < m_j", "proved", origin="ours",
             premises=("16.loop",), at={mass: mass_stated, mass_hat: mass_stated, c_3: stated_gains[c_3]},
             note="An unsaturated car then has m a(k+1) = kappa + (m_hat - 1/c_3) a(k) "
                  f"+ rho. With the true mass a deviation shrinks to {deviation_left:.4f} of itself per sample, so a "
                  "car answers to its control law only after thousands of samples; with m_hat > m + 1/c_3 deviations "
                  "grow.")
def sampled_loop_settles() -> Goal:
    """The factor of a deviation of the acceleration from one sample to the next."""
    return Goal((less((mass_hat - 1 / c_3) ** 2, mass**2),))


@paper.claim("16.learning", "(16), an equation in the acceleration that its input causes, has one solution, with (22) for the estimate of the mass",
             "implication",
             r"\hat m = \mathrm{sat}(\hat m_{i-1} - \gamma_M c_3 z_2\dot v, \underline m, \overline m):\ "
             r"m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "gap",
             origin="implied", premises=("16.loop",), rests_on=(), scope="one motor car in one iteration",
             reading="At the gains of section IV, for a car of 50 t with limits of 40 kN, without other forces, whose estimate of "
                     "the iteration before is the mass, with 49 t and 51 t as the bounds of the mass, at z_2 = -0.15625 m/s.",
             note="A remark, as the last one: the paper does not print it. (22) uses the acceleration of the same instant, so "
                  "(16) is quadratic in it and several accelerations can solve the loop, even where the estimate of the iteration "
                  "before is the mass. 2 c_3 (m_high - m_low) < 1 rules it out (16.learning.mended; where z_2 = 0 the estimate is given). "
                  "Without the factor 2 it does not: with 50 t and 50.02 t as the bounds, 50 t as the mass and as its estimate before, "
                  "and kappa = 3 N, 0.2 and 0.3 m/s^2 both solve the loop at the same gains and z_2. With the acceleration of the sample before in (22) the estimate would be "
                  "given and 16.unique.mended decide, but then (34) no longer cancels c_3 z_2^T M_tilde v', and the proof is lost.")
def loop_with_learning() -> Goal:
    """Two accelerations that solve (7), (8), (16), (22) of one car, none of them saturated; the estimate before is true."""
    def solved(x: sp.Expr) -> tuple[Relation, ...]:
        estimate = mass + mass_step(z_car, x)
        command = mu_of(kappa, x, estimate)
        return (at_least(estimate, g_low), at_most(estimate, g_high), at_least(command, u_low),
                at_most(command, u_high), equal(mass * x, command + rest))

    bounds = (equal(g_low, 49000), equal(g_high, 51000), *alone_as_stated,
              equal(gamma_mass, stated_learning[gamma_mass]), equal(z_car, Fraction(-5, 32)))
    return Goal((equal(a, b),), (*bounds, *solved(a), *solved(b)))


x_a, x_b = sp.symbols("x_a x_b", real=True)  # what (22) adds to the estimate before, by the one and the other acceleration
hat_a, hat_b = sp.symbols("M_hat_a M_hat_b", real=True)  # the estimates that it makes of them
per_acceleration = sp.Symbol("d", real=True)  # -gamma_M c_3 z_2


def _learned(hat_1: sp.Expr, one: sp.Expr, hat_2: sp.Expr, other: sp.Expr) -> tuple[Relation, ...]:
    """Of two estimates of one iteration, the one with the greater step named first."""
    step = hat_1 - hat_2
    return at_least(step, 0), at_most(step, one - other), at_most(step * other, (g_high - g_low) * step)


@paper.claim("22.two", "Two estimates that (22) makes of one estimate before", "inequality",
             r"\underline m \le \hat m_{i-1} \le \overline m,\ \hat m(x) = \mathrm{sat}(\hat m_{i-1} + x, \underline m, \overline m),\ x "
             r"\ge y \Rightarrow 0 \le \hat m(x) - \hat m(y) \le x - y,\ (\hat m(x) - \hat m(y))y \le (\overline m - \underline m)"
             r"(\hat m(x) - \hat m(y))", "proved", origin="ours", scope=EACH_CAR,
             reading="x and y are what (22) adds to the estimate before, two multiples of an acceleration.")
def two_learned_estimates() -> Goal:
    """Case by case of the two saturations."""
    one, other = (limited(m_before + x, g_low, g_high) for x in (x_a, x_b))
    return Goal(_learned(one, x_a, other, x_b), (at_most(g_low, m_before), at_most(m_before, g_high), at_most(x_b, x_a)))


apart = per_acceleration * a - per_acceleration * b


@paper.claim("16.learning.slope", "What two accelerations that solve the loop with (22) leave of each other", "implication",
             r"\hat m_a = \mathrm{sat}(\hat m_{i-1} + da, \underline m, \overline m),\ \hat m_b = \mathrm{sat}(\hat m_{i-1} + db, "
             r"\underline m, \overline m),\ d = -\gamma_M c_3 z_2,\ m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho "
             r"\Rightarrow (m + \tfrac{1}{c_3} - 2\overline m + \underline m)(da - db)^2 \le 0", "proved", origin="ours",
             premises=("16.loop", "8.slope", "22.two"), scope=EACH_CAR, reading="a is the one with da >= db.")
def loop_with_two_estimates() -> Goal:
    """With 8.slope for the two inputs and 22.two for the two estimates."""
    mu_a, mu_b = (mu_of(kappa, x, hat) for x, hat in ((a, hat_a), (b, hat_b)))
    slope = at_most((u_a - u_b) ** 2, (u_a - u_b) * (mu_a - mu_b))
    inputs = (equal(u_a, mass * a - rest), equal(u_b, mass * b - rest))
    fed_back = hat_a * per_acceleration * a - hat_b * per_acceleration * b
    lemmas = (at_most(fed_back, (2 * g_high - g_low) * apart), at_most(mass * apart**2, apart * (fed_back - apart / c_3)))
    return Goal((at_most((mass + 1 / c_3 - 2 * g_high + g_low) * apart**2, 0),),
                (at_least(apart, 0), at_most(g_low, g_high), at_most(hat_a, g_high), *inputs, slope,
                 *_learned(hat_a, per_acceleration * a, hat_b, per_acceleration * b)), lemmas=lemmas)


@paper.claim("16.learning.mended", "With (22) the acceleration is unique for 2 c_3 (m_high - m_low) < 1", "implication",
             r"z_2 \ne 0,\ 2c_3(\overline m - \underline m) < 1,\ \hat m = \mathrm{sat}(\hat m_{i-1} - \gamma_M c_3 z_2\dot v, \underline m, "
             r"\overline m):\ m a = \mathrm{sat}(\mu(a)) + \rho,\ m b = \mathrm{sat}(\mu(b)) + \rho \Rightarrow a = b", "proved",
             origin="ours", mends="16.learning", premises=("16.learning.slope",), scope=EACH_CAR,
             reading="With Assumption 1, for z_2 != 0; where z_2 = 0 the estimate is given, and 16.rule decides.")
def acceleration_unique_with_learning() -> Goal:
    """m + 1/c_3 - 2 m_high + m_low is positive."""
    return Goal((at_most((a - b) ** 2, 0),), (differ(per_acceleration, 0), less(2 * c_3 * (g_high - g_low), 1), at_most(g_low, mass),
                                              *paper.shown("16.learning.slope")))
