"""Questions of ours: whether the train under the laws of section 3 converges monotonically in the 2-norm, as the introduction
says of the method."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal, greater, less

from ..laws import input_step, lamda, rho
from ..paper import paper
from ..plant import M, T_s, u_i, u_prev, v_i, v_prev
from ..stated_values import (
    EVERY_LENGTH,
    LENGTH,
    SAMPLE_S,
    TRIALS,
    Reading,
    kilonewton,
    kilonewton_1s,
    newton,
    newton_1s,
    per_mass,
    per_mass_1s,
    secant_loss,
    stated,
)
from .section_2a_train import a, b, secant, two_trials
from .section_3c_theorem_1 import g, phi_hat

x_in, z_k, z_old = sp.symbols("x z_next z_k", real=True)
y_old, slope = sp.symbols("y Delta_y", real=True)


@paper.claim("intro.lift", "The train under (14) with a fixed estimate, lifted", "identity",
             r"e_i = e_{i-1} - z,\ z(k+1) = a z(k) + g\,e_{i-1}(k+1),\ g = \frac{T_s}{M}\frac{\rho\hat\phi}{\lambda + \hat\phi^2}",
             "proved", origin="ours", premises=("5.trials", "14"), scope=EVERY_LENGTH,
             note="A trial of full length, z = Delta v(.,i), z(0) = 0. e_i = (I - G L) e_(i-1) with G the train's lower triangular map. For the data model "
                  "theorem1.step makes the 2-norm fall from trial to trial; here the train is asked.")
def lifted_step() -> Goal:
    """Two trials of (1) that differ by (14)."""
    step = input_step(phi_hat, x_in)
    z_next = two_trials.xreplace({u_i: u_prev + step})
    return Goal((equal(z_next, secant * (v_i - v_prev) + T_s / M * rho * phi_hat / (lamda + phi_hat**2) * x_in),))


@paper.claim("intro.energy", "What one sample takes from the squared error", "identity",
             r"e_{i-1}^2 - e_i^2 = \tfrac1g\left[z(k+1)^2 - a^2z(k)^2 + g^2e_{i-1}^2\right] - z(k+1)^2", "proved", origin="ours", premises=("intro.lift",),
             scope=EVERY_LENGTH, note="Summed over the samples the first two terms leave z(N)^2 + sum (1-a^2) z^2 >= 0 when |a| <= 1.")
def energy_per_sample() -> Goal:
    """With z(k+1) = a z(k) + g e."""
    return Goal((equal(x_in**2 - (x_in - z_k)**2, (z_k**2 - a**2 * z_old**2 + g**2 * x_in**2) / g - z_k**2),),
                (equal(z_k, a * z_old + g * x_in),))


k_count, Q, squares = sp.symbols("k Q S", positive=True)


@paper.claim("intro.reach", "How far the speed change can build up", "implication",
             r"z(k)^2 \le k\,g^2\sum_{j \le k}e_{i-1}(j)^2 \Rightarrow z(k+1)^2 \le (k+1)\,g^2\sum_{j \le k+1}e_{i-1}(j)^2", "proved", origin="ours",
             premises=("intro.lift",), scope=EVERY_LENGTH, note="For every |a(k)| <= 1; in units of g, y = z/g, with Q the sum up to k.")
def builds_up() -> Goal:
    """The step of the induction, by a completed square."""
    return Goal((at_most((a * y_old + x_in) ** 2, (k_count + 1) * (Q + x_in**2)),),
                (at_most(y_old**2, k_count * Q), at_most(a**2, 1)))


N = sp.Symbol("N", positive=True)


@paper.claim("intro.small", "A gain that is small for the length is monotone in the 2-norm", "implication",
             r"g\,\tfrac{N(N+1)}{2} \le 1 \Rightarrow \|e_i\|_2 \le \|e_{i-1}\|_2", "proved", origin="ours", premises=("intro.energy", "intro.reach"), scope=EVERY_LENGTH,
             note="Q = |e_(i-1)|^2, S = |z|^2/g^2 <= N(N+1)/2 Q by intro.reach, summed over k = 1..N.")
def small_gain_monotone() -> Goal:
    """g Q - g^2 S, the least that intro.energy leaves."""
    return Goal((at_least(g * Q - g**2 * squares, 0),),
                (at_most(squares, N * (N + 1) / 2 * Q), at_most(g * N * (N + 1), 2)),
                lemmas=(at_most(g * squares, g * N * (N + 1) / 2 * Q),))


GAIN_AT_TRUTH = rho * b**2 / (lamda + b**2)


def _monotone(reading: Reading) -> None:
    @paper.claim(f"intro.monotone.{reading.suffix}", f"Monotone in the 2-norm at the stated parameters ({reading.title})", "condition",
                 r"\|e_i\|_2 \le \|e_{i-1}\|_2:\quad g\,\tfrac{N(N+1)}{2} \le 1,\ g = \frac{\rho b^2}{\lambda + b^2},\ N = 2000", "proved", origin="ours",
                 premises=("intro.small",), at={**stated(rho, lamda), b: reading.gain, N: Fraction(LENGTH)},
                 note="Monotone, because next to nothing is learned: see intro.slow.N. The estimate is at phi_hat = b = dv(k+1)/du(k).")
    def monotone() -> Goal:
        return Goal((at_most(GAIN_AT_TRUTH * N * (N + 1), 2),))


_monotone(newton)
_monotone(newton_1s)


@paper.claim("intro.slow", "What is left after one trial", "implication",
             r"\|e_i\|_2 \ge (1 - gN)\|e_{i-1}\|_2", "proved", origin="ours", premises=("intro.lift", "intro.reach"), scope=EVERY_LENGTH,
             note="By the triangle inequality and |z| <= g N |e_(i-1)| (intro.reach summed, N >= 1).")
def little_learned() -> Goal:
    """Norms n_i and n_prev, and that of z."""
    n_i, n_prev, n_z = sp.symbols("n_i n_prev n_z", nonnegative=True)
    return Goal((at_least(n_i, (1 - g * N) * n_prev),), (at_least(n_i, n_prev - n_z), at_most(n_z, g * N * n_prev)))


@paper.claim("intro.slow.N", "150 trials leave 99.9 per cent of the error (u in N, estimate at dv(k+1)/du(k))", "condition",
             r"(1 - gN)^{150} \ge 1 - 150gN \ge \tfrac{999}{1000}", "proved", origin="ours", premises=("intro.slow",),
             at={**stated(rho, lamda), b: newton.gain, N: Fraction(LENGTH)},
             note="With u in N and (1) as printed the stated lambda is so large against (T_s/M)^2 that the input hardly moves at the estimate that the "
                  "theory aims at, which (13) would not keep either (13.keeps.N).")
def nothing_learned() -> Goal:
    """(1 - gN)^150 >= 1 - 150 g N (Bernoulli), at the stated values."""
    return Goal((at_least(1 - TRIALS * GAIN_AT_TRUTH * N, sp.Rational(999, 1000)),))


@paper.claim("intro.slow.any", "The first sample learns nothing in 150 trials, whatever the estimates (u in N)", "condition",
             r"\left(150\max_{\hat\phi}\tfrac{T_s}{M}\tfrac{\rho\hat\phi}{\lambda + \hat\phi^2}\right)^2 = \frac{150^2\rho^2}{4\lambda}\tfrac{T_s^2}{M^2} \le 10^{-6}",
             "proved", origin="ours", premises=("intro.lift", "intro.gain"), at={**stated(rho, lamda), b: newton.gain},
             note="e(1,i) = (1-g) e(1,i-1) exactly; no sequence of estimates changes e(1) by more than 0.1 per cent in all trials.")
def first_sample_stays() -> Goal:
    """150 times the largest gain, squared."""
    return Goal((at_most(TRIALS**2 * rho**2 * b**2 / (4 * lamda), sp.Rational(1, 10**6)),))


@paper.claim("intro.gain", "The largest gain of (14) over all estimates", "inequality",
             r"\left(\frac{\rho\hat\phi}{\lambda + \hat\phi^2}\right)^2 \le \frac{\rho^2}{4\lambda}", "proved", origin="ours")
def largest_gain() -> Goal:
    """Reached at phi_hat = sqrt(lambda)."""
    return Goal((at_most((rho * phi_hat / (lamda + phi_hat**2)) ** 2, rho**2 / (4 * lamda)),))


m_peak = sp.Symbol("m", positive=True)
loss = sp.Symbol("c", nonnegative=True)
hat_squares = m_peak * (2 * m_peak**2 + 1) / 3


@paper.claim("intro.hat", "Sums for the error that is positive in the first half and negative in the second", "identity",
             r"y = 1, 2, \ldots, m, \ldots, 2, 1:\ \sum_k y_k^2 = \frac{m(2m^2+1)}{3},\quad (y + \Delta y - ay)^2 = \Delta y^2 + "
             r"c\left[(y+\Delta y)^2 - y^2 - \Delta y^2\right] + c^2y^2,\ a = 1 - c", "proved", origin="ours",
             scope="every length, by induction over m",
             note="y = z/g is the speed change and e(k+1) = y(k+1) - a y(k) the error that makes it, +1 and then -1 up to the small c. Base case, step, and what "
                  "one sample adds to |e|^2, in a form that telescopes.")
def hat_sums() -> Goal:
    """m = 1, m to m+1, and the square of one error."""
    following = hat_squares.xreplace({m_peak: m_peak + 1})
    error = y_old + slope - (1 - loss) * y_old
    return Goal((equal(hat_squares.xreplace({m_peak: sp.Integer(1)}), 1),
                 equal(following - hat_squares, m_peak**2 + (m_peak + 1) ** 2),
                 equal(error**2, slope**2 + loss * ((y_old + slope) ** 2 - y_old**2 - slope**2) + loss**2 * y_old**2)))


def hat_gain(gain: sp.Expr) -> sp.Expr:
    """(|e_(i-1)|^2 - |e_i|^2)/g for that error, 2m - 1 samples, a = 1 - c: intro.energy summed with intro.hat."""
    error_squares = (2 * m_peak - 1) + loss * (1 - (2 * m_peak - 1)) + loss**2 * (hat_squares - 1)
    return 1 + (2 * loss - loss**2) * (hat_squares - 1) + error_squares - gain * hat_squares


def trial_of(errors: list[sp.Expr], gain: sp.Expr) -> list[sp.Expr]:
    """The errors of the next trial by intro.lift, sample by sample."""
    change, after = sp.Integer(0), []
    for error in errors:
        change = a * change + gain * error
        after.append(error - change)
    return after


@paper.claim("intro.hat.written", "The same sums against trials of 1, 3, 5 and 7 samples written out", "identity",
             r"\sum_k e_{i-1}(k)^2 - e_i(k)^2 = g\left[1 + (1-a^2)(Y-1) + X - gY\right]", "proved", origin="ours", premises=("intro.energy", "intro.hat"),
             scope="m = 1, 2, 3, 4, every gain and damping",
             note="Y = sum y^2, X = sum e_(i-1)^2. A test of the closed form that the claims on monotony evaluate.")
def hat_written_out() -> Goal:
    """intro.lift step by step for the error that makes the hat."""
    relations = []
    for peak in (1, 2, 3, 4):
        hat = [sp.Integer(min(j, 2 * peak - j)) for j in range(2 * peak)]
        errors = [y - (1 - loss) * before for before, y in pairwise(hat)]
        after = [e.xreplace({a: 1 - loss}) for e in trial_of(errors, g)]
        drop = sp.Add(*(x**2 - y**2 for x, y in zip(errors, after, strict=True)))
        relations.append(equal(drop, g * hat_gain(g).xreplace({m_peak: sp.Integer(peak)})))
    return Goal(tuple(relations))


def _not_monotone(reading: Reading) -> None:
    values = {**stated(rho, lamda), b: reading.gain, loss: secant_loss(reading.step_s), m_peak: Fraction(LENGTH // 2)}
    gain = GAIN_AT_TRUTH.subs({s: sp.Rational(x.numerator, x.denominator) for s, x in values.items()})

    @paper.claim(f"intro.monotone.{reading.suffix}", f"Not monotone in the 2-norm at the stated parameters ({reading.title})", "condition",
                 r"\tfrac1g\left(\|e_{i-1}\|_2^2 - \|e_i\|_2^2\right) < 0\ \text{for}\ e_{i-1}(k+1) = y(k+1) - ay(k),\ y = 1, \ldots, 1000, \ldots, 1",
                 "proved", origin="ours", premises=("intro.energy", "intro.hat", "intro.hat.written"), at=values,
                 note=f"Estimate at phi_hat = b, so g = {float(gain):.2g}; a is that of the train at 72 m/s with "
                      "the largest coefficients of (17). An error of about +1 in the first half and -1 in the second grows.")
    def monotone() -> Goal:
        return Goal((less(hat_gain(GAIN_AT_TRUTH), 0),))


for reading in (kilonewton, kilonewton_1s, per_mass, per_mass_1s):
    _not_monotone(reading)


@paper.claim("intro.monotone.seven", "The same, on seven samples written out (u in N/kg)", "condition",
             r"\|e_i\|_2 > \|e_{i-1}\|_2\ \text{for}\ e_{i-1} = (1, 1, 1, 1, -1, -1, -1)", "proved", origin="ours", premises=("intro.lift",),
             at={**stated(rho, lamda), b: per_mass.gain, a: 1 - secant_loss(SAMPLE_S)},
             note="The first samples of a longer trial are not touched by later ones, so that the 2-norm of the whole map is above 1 for every trial of at "
                  "least seven samples, 0.7 s.")
def seven_samples() -> Goal:
    """The lifted map written out, no closed forms."""
    errors = [sp.Integer(1)] * 4 + [sp.Integer(-1)] * 3
    after = trial_of(errors, GAIN_AT_TRUTH)
    return Goal((greater(sp.Add(*(e**2 for e in after)), sp.Add(*(e**2 for e in errors))),))


alpha = sp.Symbol("alpha", positive=True)


@paper.claim("intro.impulse", "An error at the first sample alone, for any estimates at the other samples", "implication",
             r"(N-1)\,\alpha\,g \ge 2,\ a^{2n} \ge \alpha \Rightarrow (1-g)^2 + g^2\sum_{n=1}^{N-1}a^{2n} > 1", "proved", origin="ours", premises=("intro.lift",),
             note="Only the gain at the first sample enters, so the adaptation of the other estimates cannot help: one trial spreads the "
                  "error over the whole trip.")
def impulse_grows() -> Goal:
    """The sum is at least (N-1) alpha."""
    return Goal((greater((1 - g) ** 2 + g**2 * squares, 1),), (at_least(squares, (N - 1) * alpha), at_least((N - 1) * alpha * g, 2)),
                lemmas=(at_least(g * squares, 2),))


n_count, power_of_a = sp.symbols("n theta_a", nonnegative=True)


@paper.claim("intro.bernoulli", "How little the train forgets", "implication",
             r"a = 1 - c,\ a^{2n} \ge 1 - 2nc \Rightarrow a^{2(n+1)} \ge 1 - 2(n+1)c", "proved", origin="ours",
             note="Bernoulli's inequality, its step; theta_a is a^(2n).")
def bernoulli() -> Goal:
    """From n to n + 1."""
    return Goal((at_least(power_of_a * (1 - loss) ** 2, 1 - 2 * (n_count + 1) * loss),), (at_least(power_of_a, 1 - 2 * n_count * loss), at_most(loss, 1)))


@paper.claim("intro.growth", "One trial can multiply the error norm by ten (u in N/kg)", "condition",
             r"\|e_i\|_2^2 \ge (1-g)^2 + (N-1)(1 - 2Nc)\,g^2 \ge 100\,\|e_{i-1}\|_2^2,\ e_{i-1} = (1, 0, \ldots, 0),\ N = 2000,\ c = 1 - a", "proved", origin="ours",
             premises=("intro.lift", "intro.bernoulli"),
             at={**stated(rho, lamda), b: per_mass.gain, loss: secant_loss(SAMPLE_S), N: Fraction(LENGTH)},
             note="c = 1 - a is 2.1e-5 at 72 m/s with the largest coefficients of (17), g is that at phi_hat = dv(k+1)/du(k), which is T_s = 0.1 for u in N/kg. The errors converge in the end (theorem1.train).")
def growth_in_one_trial() -> Goal:
    """The error at the first sample alone, with what is left of its effect after N samples."""
    return Goal((at_least((1 - GAIN_AT_TRUTH) ** 2 + (N - 1) * (1 - 2 * N * loss) * GAIN_AT_TRUTH**2, 100),))


@paper.claim("intro.tradeoff", "A fixed gain that is monotone over 1999 samples hardly moves the first sample in 150 trials", "implication",
             r"\|e_i\|_2 \le \|e_{i-1}\|_2\ \forall e_{i-1} \Rightarrow 150\,g \le \tfrac{1}{100}", "proved", origin="ours",
             premises=("intro.energy", "intro.hat", "intro.hat.written"), scope="1999 samples of 0.1 s, train at 72 m/s",
             note="(1-g)^150 >= 1 - 150 g, so monotone convergence and a first sample learned within 150 trials "
                  "exclude each other, whatever lambda, rho and the unit of u.")
def monotone_or_learning() -> Goal:
    """The witness must not grow, so g is small."""
    numbers = {m_peak: sp.Integer(LENGTH // 2),
               loss: sp.Rational(secant_loss(SAMPLE_S).numerator, secant_loss(SAMPLE_S).denominator)}
    return Goal((at_most(TRIALS * g, sp.Rational(1, 100)),), (at_least(hat_gain(g).xreplace(numbers), 0),))
