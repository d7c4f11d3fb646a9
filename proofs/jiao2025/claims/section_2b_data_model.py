"""Section 2, the data model: Assumption 2, Lemma 1, (5), (6), and Assumption 4 of section 3, for the train."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, differ, equal, greater

from ..laws import e_prev, phi
from ..notation import Delta_u_i, Delta_v_k, Delta_v_next, T_d, e_i, p, v_d, v_next, v_next_prev
from ..paper import paper
from ..plant import M, T_s, next_speed, u_i, u_prev, v_i, v_prev
from ..stated_values import LENGTH, newton
from .section_2a_train import a, b, secant, two_trials

w = sp.Symbol("w", positive=True)
sample = sp.Symbol("k", real=True)
U, d = sp.symbols("U d_u", nonnegative=True)
two_trials_after = a * Delta_v_k + b * Delta_u_i  # 5.trials with b = T_s/M
two_trials_next = equal(Delta_v_next, two_trials_after)
damped = (greater(a, 0), at_most(a, 1))
stated_gain = equal(b, sp.Rational(newton.gain.numerator, newton.gain.denominator))  # T_s/M of section 4
damped_little = equal(a, sp.Rational(9999, 10_000))  # less than (17) in N makes it at the speeds of the trip


Delta_f = sp.Symbol("Delta_f", real=True)
with_places = a * Delta_v_k + b * (Delta_u_i - Delta_f)  # 5.trials.place


def _history(resistance: sp.Expr) -> Goal:
    """|Delta v(k)| <= b U carries over to k+1 with U + |Delta u(k)| + |Delta f_a(k)|."""
    given = (at_least(a, 0), at_most(a, 1), at_most(Delta_v_k, b * U), at_least(Delta_v_k, -b * U),
             at_most(Delta_u_i, d), at_least(Delta_u_i, -d), at_most(Delta_f, resistance), at_least(Delta_f, -resistance), equal(Delta_v_next, with_places))
    return Goal((at_most(Delta_v_next, b * (U + d + resistance)), at_least(Delta_v_next, -b * (U + d + resistance))), given)


paper.axiom("A2", "Assumption 2: generalised Lipschitz condition along the trials", r"|\Delta v(k+1, i)| \leq p |\Delta u_f(k, i)|",
            "an assumption of the paper on the system (4)", hypotheses=(),
            note="For Delta u(k,i) not zero. For any two runs of the system, whatever their starts and inputs, it says with Assumption 1 that v(k+1) depends on u(k) alone, since whatever earlier inputs did Delta v(k+1,i) goes to zero with Delta u(k,i): "
                 "6.unchanged. Of the trials that are run alone it says nothing where Delta u(k,i) = 0. Whether the train meets it, as Remark 2 says, is remark2.inherent.")

different = sp.Symbol("d_f", nonnegative=True)  # |Delta f_a(k)|


@paper.claim("remark2.inherent", "Remark 2: Assumption 2 is an inherent mechanical property of the train", "inequality",
             r"\text{Assumption 2 is a mechanical property that the subway train system has inherently}", "refuted", premises=("5.trials",), rests_on=("1", "3"), match="words",
             reading="|Delta v(k+1,i)| <= p |Delta u_f(k,i)| for the train (1)-(3) with T_s/M of section 4, where earlier inputs have made two trials differ by 0.1 m/s and the input differs by 0.5 N; p, in m/s per N, is at least T_s/M, which the input's own effect needs. a is put at 0.9999, less than (3) and (17) make it at the speeds of the trip with (17) in N.",
             note="The numbers are for one p; the train breaks it for every p, A2.every: where earlier inputs have made trials i-1 and i differ by 0.1 m/s at k, an input that differs by 0.5 N, or by as little as "
                  "one likes, leaves them about 0.1 m/s apart at k + 1. For the effect of the input at k alone, at the same v(k), p = T_s/M would do; but Delta v(k+1,i) of Assumption 2 is all that the two trials differ by. True is a bound by all earlier inputs and by what f_a differs: remark2.inherent.mended. Its conditions are those of one step, from k to k + 1, of the induction over k.")
def lipschitz_along_trials() -> Goal:
    """Two trials of the train by 5.trials, with b = T_s/M."""
    return Goal((at_most(sp.Abs(two_trials_after), p * sp.Abs(Delta_u_i)),), (stated_gain, equal(Delta_v_k, sp.Rational(1, 10)), equal(Delta_u_i, sp.Rational(1, 2)), damped_little, at_least(p, b)))


@paper.claim("remark2.inherent.mended", "The speed changes from trial to trial by no more than all earlier inputs and resistances make it", "implication",
             r"0 \le a \le 1\ \text{at every}\ j \le k,\ \Delta v(0,i) = 0 \Rightarrow |\Delta v(k+1,i)| \le \tfrac{T_s}{M}\sum_{j=0}^{k}\left(|\Delta u_f(j,i)| + |\Delta f_a(j,i)|\right)", "proved",
             premises=("5.trials.place",), origin="ours", mends="remark2.inherent", reading="The step from k to k + 1 of the induction over k. Each size stands as a bound from both sides.",
             note="a is the share of Delta v(j,i) that (1) carries over to Delta v(j+1,i), as in 5.trials; the line is the step from k to k + 1, U being the sum up to k - 1.")
def change_by_all_inputs() -> Goal:
    """|Delta v(k)| <= b U carries over to k+1 with U + |Delta u(k)| + |Delta f_a(k)|."""
    return _history(different)


@paper.claim("A2.every", "No constant p serves: a counterexample to Assumption 2 for each", "inequality",
             r"\forall p\ \exists\,\Delta u_f(k-1), \Delta u_f(k) \ne 0:\ |\Delta v(k+1)| > p\,|\Delta u_f(k)|", "proved",
             premises=("5.trials",), origin="ours",
             note="Any speed difference w that an earlier input made, Delta u(k-1) = w M/T_s, and Delta u(k) = a w/(p+1). "
                  "The train is (1) with (3), nothing is linearised.")
def lipschitz_fails_for_every_p() -> Goal:
    """Witness at sample k, and the input one sample earlier that brings the speed difference about."""
    a_w = secant.xreplace({v_i: v_prev + w})
    small = a_w * w / (p + 1)
    after = two_trials.xreplace({v_i: v_prev + w, u_i: u_prev + small})
    before = next_speed(v_i, u_i + w * M / T_s) - next_speed(v_i, u_i)
    return Goal((equal(before, w), greater(small, 0), greater(after, p * small)), (greater(a_w, 0),))


speeds, places, growth = sp.symbols("V_k S_k q", positive=True)
Delta_s = sp.Symbol("Delta_s", real=True)


@paper.claim("remark2", "Remark 2: bounded changes of the input make bounded changes of the output", "implication",
             r"\text{a bounded change of the input energy should cause a bounded change of the output energy}", "proved", premises=("5.trials.place",), rests_on=(),
             match="words", reading="Decided for the changes from trial to trial, f_a being Lipschitz in the place with the constant L = M q^2/T_s^2: N(k) = |Delta v(k)| + (q/T_s)|Delta s(k)| is at most "
                                    "(1 + q) N(k-1) + (T_s/M)|Delta u(k-1)|, so that over a trip of a given length bounded changes of the inputs make bounded ones of the speeds. Each size stands as a bound from both sides.",
             note="True of the train, and weaker than Assumption 2, which bounds the change by that of the last input alone.")
def bounded_changes() -> Goal:
    """The step of the induction over k; it starts from equal initial speeds."""
    lipschitz = growth**2 / (b * T_s)
    given = (at_least(a, 0), at_most(a, 1), *_within(Delta_v_k, speeds), *_within(Delta_s, places), *_within(Delta_u_i, d), *_within(Delta_f, lipschitz * places))
    moved, gone = speeds + b * d + growth**2 / T_s * places, places + T_s * speeds
    return Goal((*_within(with_places, moved), *_within(Delta_s + T_s * Delta_v_k, gone),
                 at_most(moved + growth / T_s * gone, (1 + growth) * (speeds + growth / T_s * places) + b * d)), given)


def _within(value: sp.Expr, most: sp.Expr) -> tuple[Relation, Relation]:
    return at_most(value, most), at_least(value, -most)


quotient = Delta_v_next / Delta_u_i


@paper.claim("lemma1", "Lemma 1: phi_c exists and is bounded where Assumption 2 holds", "implication",
             r"\Delta v(k+1, i) = \phi_c(k, i) \Delta u_f(k, i) \text{, and for every } k \text{ and } i,\ \phi_c(k, i) \text{ is bounded}", "proved", rests_on=(), severity="result",
             reading="The lemma's (5), and bounded as |phi_c| <= p, under what it assumes: Assumption 2 and Delta u not zero; phi_c is the quotient.",
             note="For a system that meets Assumption 2. The bound is that assumption word for word; whether the train has it is another question: remark2.inherent.")
def quotient_exists() -> Goal:
    """phi_c = Delta v(k+1) / Delta u(k)."""
    return Goal((equal(Delta_v_next, quotient * Delta_u_i), at_most(sp.Abs(quotient), p)),
                (at_most(sp.Abs(Delta_v_next), p * sp.Abs(Delta_u_i)), differ(Delta_u_i, 0)))


phi_train = b + a * Delta_v_k / Delta_u_i


@paper.claim("5", "CFDL data model", "identity", r"\Delta v(k+1, i) = \phi_c(k, i) \Delta u_f(k, i)", "proved",
             premises=("5.trials",), rests_on=("lemma1",), where={r"\Delta v(k+1, i)": two_trials_after, r"\phi_c(k, i)": phi_train},
             note="True of the train for Delta u(k,i) not zero, with phi_c = T_s/M + a Delta v(k,i)/Delta u(k,i): a rewriting of the quotient. "
                  "All of the train's memory is in phi_c, which is neither dv(k+1)/du(k) nor bounded (A2.every).")
def data_model() -> Goal:
    """phi_c of the train."""
    return Goal((equal(two_trials_after, phi_train * Delta_u_i),), (differ(Delta_u_i, 0),))


@paper.claim("5.range", "The text after (5): The tracking error e(k+1,i) is defined at every k up to T_d", "implication", r"e(k+1, i)\ \text{is defined at all}\ k \in [0, 1, \dots, T_d]", "gap", rests_on=(), origin="implied", severity="cosmetic",
             reading="(5), Assumptions 2 and 4 and the first input are printed for k up to T_d; v_d is printed up to T_d, and e(k+1,i) takes it at k + 1.",
             note="A slip of the range. At k = T_d the laws (8), (10) to (12), (14), (15) and (18) ask for data at T_d + 1, where neither v_d nor gamma is defined; read k <= T_d - 1 there. (5) itself is Lemma 1 at every k.")
def range_of_tracking_error() -> Goal:
    """k + 1 <= T_d at the last k, T_d of section 4."""
    return Goal((at_most(sample + 1, T_d),), (at_least(sample, 0), at_most(sample, T_d), equal(T_d, LENGTH)))


@paper.claim("6", "The data model written for the speed", "identity",
             r"v(k+1, i) = v(k+1, i-1) + \phi_c(k, i) \Delta u_f(k, i)", "proved", premises=("5",), where={"v(k+1, i)": v_next_prev + two_trials_after, r"\phi_c(k, i)": phi_train})
def data_model_speed() -> Goal:
    """(5) with Delta v(k+1,i) written out."""
    changes, = paper.shown("5")
    return Goal((equal(v_next_prev + changes.left, v_next_prev + changes.right),), (differ(Delta_u_i, 0),))


named = equal(Delta_v_next, phi * Delta_u_i)  # (5)
speed_by_model = equal(v_next, v_next_prev + phi * Delta_u_i)  # (6)


@paper.claim("5.output", "The change of the speed from trial to trial", "identity",
             r"\Delta v(k+1, i) = v(k+1, i) - v(k+1, i-1)", "proved", rests_on=(),
             reading="A definition, for which (5) and (6) say the same.")
def change_of_speed() -> Goal:
    """(5) and (6) with one phi_c and one change of the input."""
    return Goal((equal(Delta_v_next, v_next - v_next_prev),), (named, speed_by_model))


@paper.claim("5.input", "The change of the input from trial to trial", "identity",
             r"\Delta u_f(k, i) = u_f(k, i) - u_f(k, i-1)", "proved", premises=("1",), rests_on=(),
             reading="A definition; decided as the change of the force that (1) answers to at the same speed and place.")
def change_of_input() -> Goal:
    """Two forces on the train of (1) at one speed."""
    answer = equal(T_s / M * Delta_u_i, next_speed(v_i, u_i) - next_speed(v_i, u_prev))
    return Goal((equal(Delta_u_i, u_i - u_prev),), (answer,))


@paper.claim("6.error", "The tracking error", "identity", r"e(k+1, i) = v_d(k+1) - v(k+1, i)", "proved", rests_on=(),
             where={"v_d(k+1)": v_d},
             reading="A definition; decided as what (6) makes of it from one trial to the next.",
             note="With e(k+1,i) = e(k+1,i-1) - phi_c Delta u(k,i), the form in which (7) is minimised.")
def tracking_error() -> Goal:
    """From trial i - 1 to trial i."""
    return Goal((equal(e_i, v_d - v_next),),
                (equal(e_prev, v_d - v_next_prev), equal(e_i, e_prev - phi * Delta_u_i), speed_by_model))


paper.definition("6.aim", "The text after (5): the aim, an error that goes to zero",
                 r"\text{the control aim is to find a suitable control input such that the tracking error } e(k+1, i) \text{ converges to 0 as the number of trials } i \text{ goes to infinity}",
                 note="Whether it is proved is asked where the introduction says so: intro.error.")


change_at_rest, slope = sp.symbols("Delta_v_0 L_u", real=True)
nearby = sp.Symbol("h", positive=True)


@paper.claim("6.unchanged", "(6) where the input is not changed: the speed is that of the last trial", "implication",
             r"\Delta u_f(k,i) = 0 \Rightarrow v(k+1,i) = v(k+1,i-1)", "proved", origin="implied", rests_on=(),
             reading="Under Assumption 1 and Assumption 2 for any two runs of the system, whatever their starts and inputs: what Delta v(k+1) is at Delta u(k) = 0 differs by at most (p + L_u) h from 0, for every small change h.",
             note="(6) is used for all k and i, Lemma 1 excludes Delta u(k,i) = 0. Exactly this case occurs wherever data are missing, by (14) with gamma = 0. It follows by continuity where Assumption 2 holds for any two "
                  "runs, whatever their starts and inputs, L_u being the bound of the derivative near by, not where it holds of the trials that are run alone. So v(k+1) depends on u(k) alone, and (4) has no memory. The train breaks it: 6.unchanged.train.")
def unchanged_input() -> Goal:
    """Assumption 2 at Delta u = h > 0, and the continuity that Assumption 1 gives."""
    near = (at_most(Delta_v_next, p * nearby), at_least(Delta_v_next, -p * nearby),
            at_most(change_at_rest - Delta_v_next, slope * nearby), at_least(change_at_rest - Delta_v_next, -slope * nearby))
    return Goal((at_most(change_at_rest, (p + slope) * nearby), at_least(change_at_rest, -(p + slope) * nearby)), near)


@paper.claim("6.unchanged.train", "The train's speed changes where its input does not", "implication",
             r"\Delta u_f(k,i) = 0 \Rightarrow \Delta v(k+1,i) = 0", "gap", premises=("5.trials",), origin="ours",
             note="The train's speed there changes with the inputs before k, so that (6) leaves it out wherever a trial had ended.")
def unchanged_input_of_the_train() -> Goal:
    """Delta v(k+1) of the train at Delta u(k) = 0."""
    return Goal((equal(two_trials_after, 0),), (equal(Delta_u_i, 0), *damped))


paper.axiom("A4", "Assumption 4: phi_c is positive", r"\phi_c(k, i) > \bar{\varepsilon} > 0", "an assumption of the paper on the system (4)", hypotheses=(),
            note="Remark 4 calls it reasonable for many practical systems. Whether the train meets it is A4.train.")


@paper.claim("A4.train", "The train (1)-(3), to which Theorem 1 is applied, meets Assumption 4", "inequality", r"\text{the train (1)-(3): } \phi_c(k, i) > \bar{\varepsilon} > 0", "refuted", origin="implied",
             premises=("5",), rests_on=(), section="3",
             reading="The title, the summary and section 5 speak of the train. Decided as the least that the assumption says, whatever the bound: phi_c is nowhere negative. T_s/M is that of section 4, in m/s per N; speeds are in m/s, inputs in N. a is put at 0.9999, less than (3) and (17) make it at the speeds of the trip with (17) in N.",
             note="Slower than in the last trial after the earlier inputs and pushed a little harder now, the train is still slower, and phi_c is negative. It takes every value (A4.every), so no bound serves. Positive is dv(k+1)/du(k) = T_s/M (A1), the known control direction of which Remark 4 speaks.")
def positive_pseudo_derivative() -> Goal:
    """phi_c of the train with T_s/M of section 4."""
    return Goal((at_least(phi_train, 0),), (stated_gain, damped_little, differ(Delta_u_i, 0)))


any_value = sp.Symbol("phi_wanted", real=True)


@paper.claim("A4.every", "phi_c of the train takes every value", "identity", r"\forall y\ \exists\,\Delta v(k,i):\ \phi_c(k,i) = y", "proved",
             premises=("5",), origin="ours", note="For Delta v(k,i) = (y - T_s/M) Delta u(k,i)/a, which the input one sample earlier brings about, as in A2.every.")
def every_value() -> Goal:
    """The speed difference that makes phi_c = y."""
    return Goal((equal(phi_train.xreplace({Delta_v_k: (any_value - b) * Delta_u_i / a}), any_value),), (differ(Delta_u_i, 0), greater(a, 0)))
