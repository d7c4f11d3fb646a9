"""Section 2, the train: (1)-(6), Assumptions 1, 2 and 4, Lemma 1, and the coefficients (17) that (3) gets in section 4."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, differ, equal, greater, less
from workbench.trains.train import F, a_0, b_0, c_0, f_add, m, single_particle, v

from ..laws import Delta_u, Delta_v
from ..paper import paper
from ..plant import M, T_s, b_0k, b_1k, b_2k, basic_resistance, davis_newton, f_a, next_speed, u_i, u_prev, v_i, v_prev
from ..stated_values import MASS, stated

a = sp.Symbol("a", real=True)
b = sp.Symbol("b", positive=True)
newton_force = {F: u_i, m: M, a_0: b_0k, b_0: b_1k, c_0: b_2k, f_add: f_a, v: v_i}


@paper.claim("1", "The train: an Euler step of Newton's law", "identity",
             r"v(k+1) = v(k) + \frac{T_s}{M}(u_f(k) - f_a(s) - f_b(v))", "proved",
             note="With forces in N. By (2) f_a vanishes on a level line, although the text lets it contain curves and "
                  "tunnels too; the sign that stands before the slope angle in (2) is garbled in the text.")
def newton_step() -> Goal:
    """v + T_s times the acceleration of the single-particle train."""
    rate = single_particle().rates[v].xreplace(newton_force)
    return Goal((equal(v_i + T_s * rate, next_speed(v_i, u_i)),))


f_a_i, f_a_prev = sp.symbols("f_a_i f_a_prev", real=True)


@paper.claim("4", "The next speed is a function of the last n_v + 1 speeds and n_u + 1 inputs", "implication",
             r"v(k+1,i) = f(v(k,i), \ldots, v(k-n_v,i), u_f(k,i), \ldots, u_f(k-n_u,i))", "gap",
             note="f_a depends on the position, which is the sum of all speeds since departure: two runs with the same "
                  "last speeds and inputs at different positions go on differently. It holds only when n_v reaches "
                  "back to the departure (and with an f that knows k, as b_0(k) to b_2(k) do); such a model "
                  "is what Assumption 2 then cannot hold for.")
def finite_window() -> Goal:
    """The same speed and input with two values of f_a."""
    return Goal((equal(next_speed(v_i, u_i, f_a_i), next_speed(v_i, u_i, f_a_prev)),))


@paper.claim("A1", "Assumption 1: the partial derivative by the input is continuous", "identity",
             r"\frac{\partial f}{\partial u_f(k,i)} = \frac{T_s}{M}", "proved", premises=("1",),
             note="A positive constant, hence continuous, as Remark 2 says. This is also what Remark 4 wants of "
                  "Assumption 4, but phi_c of (5) is another quantity, see 5.")
def input_derivative() -> Goal:
    """D of (1) by u."""
    return Goal((equal(D(next_speed(v_i, u_i)), T_s / M),), flow={u_i: sp.Integer(1)})


two_trials = next_speed(v_i, u_i) - next_speed(v_prev, u_prev)
secant = 1 - T_s / M * (b_1k + b_2k * (v_i + v_prev))


@paper.claim("5.trials", "Difference of two trials of the train, without linearisation", "identity",
             r"\Delta v(k+1,i) = a\,\Delta v(k,i) + \frac{T_s}{M}\Delta u_f(k,i),\ "
             r"a = 1 - \tfrac{T_s}{M}(b_1 + b_2(v(k,i) + v(k,i-1)))", "proved", premises=("1",),
             note="Not printed: (1)-(3) for two trials, with the same f_a. The term in Delta v(k), which comes from "
                  "the inputs before k, is the one that (5) does not have.")
def trial_difference() -> Goal:
    """(1) for trials i and i-1."""
    return Goal((equal(two_trials, secant * (v_i - v_prev) + T_s / M * (u_i - u_prev)),))


swing = sp.Symbol("sin_k", real=True)


@paper.claim("17", "The resistance coefficients are positive at all times", "inequality",
             r"b_0(k), b_1(k), b_2(k) > 0", "proved",
             note="Needed for a damping train, a <= 1 in 5.trials. Decided for every value of the sine.")
def coefficients_positive() -> Goal:
    """Mean and swing of (17), over the stated M."""
    return Goal(tuple(greater((mean + part * swing) / MASS.numerator, 0) for mean, part in davis_newton.values()),
                (at_most(swing, 1), at_least(swing, -1)))


SPEED_MAX = 72
damping_newton = sum(davis_newton[b_1k]) + 2 * SPEED_MAX * sum(davis_newton[b_2k])  # d f_b/dv at most, in N s/m


def secant_loss(step_s: Fraction) -> Fraction:
    """1 - a of 5.trials over one step, at the largest desired speed and the largest coefficients of (17)."""
    return step_s * Fraction(int(damping_newton.p), int(damping_newton.q)) / MASS


@paper.claim("17.units", "(17) put into (1) gives the train its resistance", "condition",
             r"\frac{1}{M}f_b = \frac{2977 + 25.17 v + 0.2864 v^2}{M}\ \text{with (17)}", "violated",
             at={**stated(M), v_i: Fraction(70), swing: Fraction(0)},
             repair={M: Fraction(1), v_i: Fraction(70), swing: Fraction(0)},
             note="(17) is divided by M, and (1) divides by M once more, so that the train runs with a resistance 350,000 "
                  "times too small. Either (17) is in N without its M, or u is a force per unit of mass and "
                  "(1) has no M (the repair M = 1); the paper does not say which, and u(k,0), lambda and the gains depend on it.")
def resistance_of_both() -> Goal:
    """Deceleration by (1) with (17) against the resistance in N over M, at 70 m/s."""
    per_kg = {s: (mean + part * swing) / M for s, (mean, part) in davis_newton.items()}
    in_newton = {s: mean + part * swing for s, (mean, part) in davis_newton.items()}
    both = basic_resistance(v_i)
    return Goal((equal(both.xreplace(per_kg) / M, both.xreplace(in_newton) / M),))


p = sp.Symbol("p", positive=True)
w = sp.Symbol("w", positive=True)
U, d = sp.symbols("U d", nonnegative=True)


def _input_history() -> Goal:
    """|Delta v(k)| <= b U carries over to k+1 with U + |Delta u(k)|."""
    given = (at_least(a, 0), at_most(a, 1), at_most(Delta_v, b * U), at_least(Delta_v, -b * U),
             at_most(Delta_u, d), at_least(Delta_u, -d))
    after = a * Delta_v + b * Delta_u
    return Goal((at_most(after, b * (U + d)), at_least(after, -b * (U + d))), given)


@paper.claim("A2", "Assumption 2: generalised Lipschitz condition along the trials", "inequality",
             r"\Delta u_f(k,i) \ne 0 \Rightarrow |\Delta v(k+1,i)| \le p\,|\Delta u_f(k,i)|", "refuted",
             premises=("5.trials",),
             correction=_input_history,
             corrected_statement=r"|\Delta v(k+1,i)| \le \tfrac{T_s}{M}\sum_{j=0}^{k}|\Delta u_f(j,i)|\ "
                                 r"(0 \le a \le 1,\ \Delta v(0,i) = 0)",
             note="Remark 2 calls this a mechanical property of trains. The train breaks it for every p (A2.every): its "
                  "speed also differs because earlier inputs differed, however small Delta u(k) is. Here p is taken "
                  "at least T_s/M, which the input's own effect needs. True is the bound by all earlier inputs, proved as its step from k to k+1. "
                  "Lemma 1's bounded phi_c, and with it Theorem 1, rest on the false form.")
def lipschitz_along_trials() -> Goal:
    """Two trials of the train by 5.trials, with b = T_s/M, for Delta u(k) > 0."""
    after = a * Delta_v + b * Delta_u
    return Goal((at_most(after, p * Delta_u), at_least(after, -p * Delta_u)),
                (greater(Delta_u, 0), at_least(p, b), greater(a, 0), less(a, 1)))


@paper.claim("A2.every", "No constant p serves: a counterexample to Assumption 2 for each", "inequality",
             r"\forall p\ \exists\,\Delta u_f(k-1), \Delta u_f(k) \ne 0:\ |\Delta v(k+1)| > p\,|\Delta u_f(k)|", "proved",
             premises=("5.trials",),
             note="Any speed difference w that an earlier input made, Delta u(k-1) = w M/T_s, and Delta u(k) = a w/(p+1). "
                  "The train is (1) with (3), nothing is linearised.")
def lipschitz_fails_for_every_p() -> Goal:
    """Witness at sample k, and the input one sample earlier that brings the speed difference about."""
    a_w = secant.xreplace({v_i: v_prev + w})
    small = a_w * w / (p + 1)
    after = two_trials.xreplace({v_i: v_prev + w, u_i: u_prev + small})
    before = next_speed(v_i, u_i + w * M / T_s) - next_speed(v_i, u_i)
    return Goal((equal(before, w), greater(small, 0), greater(after, p * small)), (greater(a_w, 0),))


phi_train = b + a * Delta_v / Delta_u


@paper.claim("5", "CFDL data model", "identity", r"\Delta v(k+1,i) = \phi_c(k,i)\,\Delta u_f(k,i)", "proved",
             premises=("5.trials",),
             note="True for Delta u(k,i) not zero, with phi_c = T_s/M + a Delta v(k,i)/Delta u(k,i): a rewriting of the quotient. "
                  "All of the train's memory is in phi_c, which is neither dv(k+1)/du(k) nor bounded (A2.every).")
def data_model() -> Goal:
    """phi_c of the train."""
    return Goal((equal(a * Delta_v + b * Delta_u, phi_train * Delta_u),), (differ(Delta_u, 0),))


v_gain = sp.Symbol("Delta_v_next", real=True)


@paper.claim("lemma1", "Lemma 1: phi_c exists and is bounded", "implication",
             r"|\Delta v(k+1,i)| \le p|\Delta u_f(k,i)|,\ \Delta u_f(k,i) \ne 0 \Rightarrow \exists\,\phi_c: "
             r"\Delta v(k+1,i) = \phi_c\Delta u_f(k,i),\ |\phi_c| \le p", "proved", premises=("A2",),
             note="The quotient itself. The bound is Assumption 2 word for word, so it stands and falls with it.")
def quotient_exists() -> Goal:
    """phi_c = Delta v(k+1) / Delta u(k), in squares."""
    quotient = v_gain / Delta_u
    return Goal((equal(v_gain, quotient * Delta_u), at_most(quotient**2, p**2)),
                (at_most(v_gain**2, p**2 * Delta_u**2), differ(Delta_u, 0)))


@paper.claim("6", "The data model written for the speed", "identity",
             r"v(k+1,i) = v(k+1,i-1) + \phi_c(k,i)\Delta u_f(k,i)", "proved", premises=("5",))
def data_model_speed() -> Goal:
    """(5) with Delta v(k+1,i) written out, for the train."""
    now, before = sp.symbols("v_next_i v_next_prev", real=True)
    return Goal((equal(now, before + phi_train * Delta_u),),
                (differ(Delta_u, 0), equal(now, before + a * Delta_v + b * Delta_u)))


@paper.claim("6.unchanged", "(6) where the input is not changed: the speed is that of the last trial", "implication",
             r"\Delta u_f(k,i) = 0 \Rightarrow v(k+1,i) = v(k+1,i-1)", "gap", premises=("6",),
             note="(6) is used for all k and i, Lemma 1 excludes Delta u(k,i) = 0. Exactly this case occurs wherever data are "
                  "missing, by (14) with gamma = 0. The train's speed there changes with the inputs before k.")
def unchanged_input() -> Goal:
    """Delta v(k+1) of the train at Delta u(k) = 0."""
    return Goal((equal(a * Delta_v + b * Delta_u, 0),), (equal(Delta_u, 0), greater(a, 0), at_most(a, 1)))


@paper.claim("A4", "Assumption 4: phi_c is positive", "inequality", r"\phi_c(k,i) > \bar\varepsilon > 0", "refuted",
             premises=("5",),
             note="For the train: slower after the earlier inputs and pushed a little harder now, it is still slower, and phi_c is "
                  "negative. Positive is dv(k+1)/du(k) = T_s/M (A1), which is what Remark 4 argues with.")
def positive_pseudo_derivative() -> Goal:
    """phi_c of the train for any 0 < a <= 1."""
    return Goal((greater(phi_train, 0),), (differ(Delta_u, 0), greater(a, 0), at_most(a, 1)))
