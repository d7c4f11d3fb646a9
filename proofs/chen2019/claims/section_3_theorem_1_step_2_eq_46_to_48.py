"""Theorem 1, step 2: z_1 and z_2 converge along the iterations, (46)-(48)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal

from ..energy_function import E_1, S_1, S_2, Z_1, Z_2, E_before, E_now, V_before
from ..goal_forms import along_iterations, i_axis, integrated
from ..laws import c_1, c_2
from ..paper import EACH_CAR, paper

SUM_1, SUM_2 = (rf"\sum_{{k=2}}^{{i}} \int_{{0}}^{{t}} \left\| z_{{{x},k}} \right\|^{{2}} d\tau" for x in (1, 2))
SUM_V = r"\sum_{k=1}^{i-1} V_k(t)"
S_V = sp.Symbol("S_V", real=True)
IN_46 = {"E_i": E_now, "E_1": E_1, SUM_1: S_1 + Z_1, SUM_2: S_2 + Z_2, SUM_V: S_V + V_before}


def _telescoped(step: str, tail: sp.Expr, last: sp.Expr) -> Goal:
    """From i - 1 to i, by the change that `step` shows; at the start the sums are empty."""
    change, *_ = paper.shown(step)
    return Goal((at_most(E_now, E_1 - c_1 * (S_1 + Z_1) - c_2 * (S_2 + Z_2) - tail - last),),
                (equal(E_now - E_before, change.left), change,
                 at_most(E_before, E_1 - c_1 * S_1 - c_2 * S_2 - tail)))


READING_46 = "The step of the induction over i: S_1, S_2 are the sums up to i - 1, empty at the start."


@paper.claim("46", "The CEF after i iterations", "implication",
             rf"E_{{i}} \leq E_{{1}} - c_{{1}} {SUM_1} - c_{{2}} {SUM_2}", "proved", premises=("35",), where=IN_46,
             reading=READING_46)
def telescoped() -> Goal:
    """(35) added up."""
    return _telescoped("35", sp.S.Zero, sp.S.Zero)


@paper.claim("46.kept", "The CEF after i iterations, with the term that (35) drops", "implication",
             rf"E_{{i}} \leq E_{{1}} - {SUM_V} - c_{{1}} {SUM_1} - c_{{2}} {SUM_2}", "proved", origin="ours",
             premises=("35.kept",), where=IN_46, reading=READING_46)
def telescoped_kept() -> Goal:
    """35.kept added up."""
    return _telescoped("35.kept", S_V, V_before)


E_limit = sp.Symbol("E_limit", real=True)
LIM_E = r"\lim_{i \to +\infty} E_i"
LIM_1, LIM_2 = (rf"\lim_{{i \to +\infty}} \sum_{{k=2}}^i \int_0^t \|z_{{{x},k}}\|^2 d\tau" for x in (1, 2))
RIGHT_47 = rf"E_1 - c_1 \cdot {LIM_1} - c_2 \cdot {LIM_2}"
IN_47 = {LIM_E: E_limit, LIM_1: S_1, LIM_2: S_2, "E_1": E_1}
right_47 = E_1 - c_1 * S_1 - c_2 * S_2


def _limit(relation: Relation) -> Goal:
    """From the limits of both sides of (46), which exist, since E_i does not increase and is not negative."""
    return Goal((relation,), (at_most(E_limit, right_47), at_least(E_limit, 0), at_least(S_1, 0), at_least(S_2, 0)))


@paper.claim("47", "The limit of (46)", "limit", rf"{LIM_E} = {RIGHT_47}", "gap", severity="cosmetic", premises=("46",),
             where=IN_47, correction=lambda: _limit(at_most(E_limit, right_47)),
             corrected_statement=rf"{LIM_E} \le {RIGHT_47}",
             note="The limit of the inequality (46) is an inequality. By 46.kept the right side exceeds the left one by at "
                  "least the sum of all V_k(t), so the printed equality is false wherever some V_k(t) is positive; harmless, since "
                  "(48) needs <= alone.")
def cef_limit() -> Goal:
    """Equality of the limits from (46)."""
    return _limit(equal(E_limit, right_47))


iteration, iterations = sp.symbols("k i", integer=True, positive=True)
large_1, rest_1, large_2, rest_2 = (sp.IndexedBase(x, real=True)[iteration] for x in ("b_1", "r_1", "b_2", "r_2"))
delta = sp.Symbol("delta", positive=True)


def over_iterations(summand: sp.Expr) -> sp.Expr:
    """Sum over the iterations."""
    return sp.Sum(summand, (iteration, 1, iterations))


# A term >= 0 is b^2 delta + r^2 with b = 1 where it is at least delta, else b = 0: the sum of b^2 counts those.
terms_1, terms_2 = (over_iterations(b_k**2 * delta + r_k**2) for b_k, r_k in ((large_1, rest_1), (large_2, rest_2)))
count_1, count_2 = over_iterations(large_1**2), over_iterations(large_2**2)


@paper.claim("48", "The integrals of the errors z converge to zero", "limit",
             r"\lim_{i \to \infty} \int_0^t \|\mathbf{z}_{1,i}\|^2 \, d\tau = 0, \lim_{i \to \infty} \int_0^t "
             r"\|\mathbf{z}_{2,i}\|^2 \, d\tau = 0", "proved",
             premises=("25", "46", "45.bounded"), rests_on=("25", "45.bounded", "46", "47"),
             reading="With the number named: for every delta > 0 at most E_1/(c_1 delta) iterations have an integral of "
                     "z_1 of at least delta, and at most E_1/(c_2 delta) one of z_2.",
             note="It does not need (47).")
def integrals_converge() -> Goal:
    """The count of iterations with a large integral, from (46) and E_i >= 0."""
    shown = (at_most(c_1 * delta * count_1, E_1), at_most(c_2 * delta * count_2, E_1))
    return Goal(shown, (at_least(E_now, 0), *paper.shown("46"), equal(S_1 + Z_1, terms_1), equal(S_2 + Z_2, terms_2)))


# Squares, and sums and integrals of squares, as the paper says of V_{i-1} before (35).
squares_given = (at_least(V_before, 0), at_least(Z_1, 0), at_least(Z_2, 0), at_least(S_1, 0), at_least(S_2, 0))


def _instants_converge() -> Goal:
    """The count of iterations with V_k(t) >= delta, from 46.kept."""
    return Goal((at_most(delta * count_1, E_1),),
                (*squares_given, at_least(E_now, 0), *paper.shown("46.kept"), equal(S_V + V_before, terms_1)))


I_z, z_end = sp.symbols("I_z z_end", real=True)  # of an iteration: the integral of |z_2|^2 on [0, 1], |z_2(1)|^2


@paper.claim("55.pointwise", "The text after (55): (48) makes z_2 converge at every instant", "limit",
             r"\text{Hence, it can conclude that ... $z_{1,i}$ and $z_{2,i}$ are convergent along the iteration axis "
             r"pointwisely.}", "gap", premises=("48",), match="words",
             reading="Of z_2: its integrals of (48) tend to zero, so z_{2,i}(t) tends to zero at every t, here |z_{2,i}(1)|^2 is at most "
                     "1/2 from some iteration on. Of z_1 it is true, see 55.z_1.",
             correction=_instants_converge,
             corrected_statement=r"\#\{k: V_k(t) \ge \delta\} \le \tfrac{E_1(t)}{\delta}\ \text{for every } t, \delta "
                                 r"> 0",
             note="Integrals do not control instants: z_2(tau) = tau^(i+1) on [0, 1] has the integral 1/(2i+3) of its "
                  "square and z_2(1) = 1 in every iteration. This is no motion of the loop, it shows what the step from "
                  "(48) lacks. The conclusion is nevertheless true, by the term V_{i-1}(t) that (35) drops (55.mended). Theorem 1.2 "
                  "does not use it.")
def pointwise_from_integrals() -> Goal:
    """|z_2(1)|^2 of iteration i from the integral of |z_2|^2, which tends to zero."""
    vanishing = 1 / (2 * i_axis + 3)
    always = (at_most(I_z, vanishing), at_least(I_z, 0), at_least(z_end, 0), at_least(i_axis, 0))
    return along_iterations(at_most(z_end, sp.S.Half), always, {I_z: vanishing, z_end: sp.Integer(1)}, {})


z_1_car, z_2_car = sp.symbols("z_1 z_2", real=True)


@paper.claim("55.z_1", "At every instant z_1 is small where the integral of z_2 is", "implication",
             r"\|z_{1,i}(t)\|^2 \le \frac{1}{2c_1}\int_0^t\|z_{2,i}\|^2d\tau", "proved", origin="ours", premises=("11",),
             scope=EACH_CAR, where={r"\|z_{1,i}(t)\|^2": z_1_car**2, r"\int_0^t\|z_{2,i}\|^2d\tau": Z_2},
             note="From z_1' = -c_1 z_1 + z_2, which (11) and (12) give, and z_1(0) = 0. So (48) does make z_1 converge at every "
                  "instant, even uniformly.")
def z_1_at_an_instant() -> Goal:
    """2 c_1 z_1^2 minus the integral of z_2^2 falls by (2 c_1 z_1 - z_2)^2."""
    return integrated({z_1_car: -c_1 * z_1_car + z_2_car, Z_2: z_2_car**2}, at_most(z_1_car**2, Z_2 / (2 * c_1)), (),
                      (c_1,), decreasing=2 * c_1 * z_1_car**2 - Z_2)


@paper.claim("55.mended", "z converges at every instant by the term that (35) drops", "limit",
             r"\#\{k: V_k(t) \ge \delta\} \le \tfrac{E_1(t)}{\delta}\ \text{for every } t, \delta > 0", "proved",
             origin="ours", mends="55.pointwise", match="words", premises=("25", "46.kept", "45.bounded"))
def instants_converge() -> Goal:
    """The count of iterations with a large V at an instant."""
    return _instants_converge()


@paper.claim("theorem1.2", "Theorem 1, part 2: for motions that exist on [0, T] and start with lambda = 0, z_1 and z_2 converge to 0 along the "
             "iteration axis in the sense of (48)", "limit",
             r"\text{$z_{1,i}$ and $z_{2,i}$ converge to 0 along the iteration axis.}", "proved", severity="result",
             match="words", premises=("25", "46", "45.bounded"), rests_on=("48",),
             reading="In the sense of (48), of integrals, for every motion that solves (16), exists on [0, T] and starts with lambda "
                     "= 0, as the paper has it before (51): for every delta > 0 at most E_1/(c_1 delta) iterations have an "
                     "integral of z_1 of at least delta, and at most E_1/(c_2 delta) one of z_2.",
             note="The parameters are the same in every iteration, as the paper has it. theorem1.2.mended says more: z_1 and z_2 "
                  "converge at every instant.")
def z_converges() -> Goal:
    """The counts of (48)."""
    return integrals_converge()


@paper.claim("theorem1.2.mended", "Part 2 at every instant, by the term that (35) drops", "implication",
             r"\lambda_{1,i}(0) = \lambda_{2,i}(0) = 0,\ \text{the same parameters in every iteration}: E_i - E_{i-1} \le "
             rf"-V_{{i-1}}(t),\ \text{{so}}\ {SUM_V} \le E_1(t)\ \text{{for every $i$ and $t$}}", "proved", origin="ours",
             mends="theorem1.2", severity="result", match="words", premises=("25", "46.kept", "45.bounded"),
             reading="The sum of all V_k(t) = (|z_1|^2 + |z_2|^2)/2 of the iterations is at most E_1(t), which is finite "
                     "(45.bounded): so V_k(t) tends to 0.")
def sum_bounded() -> Goal:
    """46.kept with E_i >= 0."""
    return Goal((at_most(S_V + V_before, E_1),), (*squares_given, at_least(E_now, 0), *paper.shown("46.kept")))
