"""Section 4, the comparison: the PD law (18), the additional resistance of Figure 4, what Figures 5 to 7 show."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, differ, equal, greater, less

from ..laws import K_d, K_p, e_next, e_now, pd_step
from ..notation import T_d
from ..paper import paper
from ..plant import slope_coefficient, u_i, u_prev
from ..stated_values import LENGTH, SHORTEST, Reading, kilonewton_1s, newton, per_mass, per_mass_1s, stated
from .section_2a_train import a, b, f_a_i, f_a_prev
from .section_3a_random_lengths import length_i, sample
from .section_3c_theorem_1 import e_one, e_two

proportional, derivative, e_difference = sp.symbols("P_gain D_gain e_difference", real=True)


@paper.claim("18", "The law of the comparison", "identity",
             r"u_f(k, i) = u_f(k, i - 1) + K_p(e^*(k + 1, i - 1)) + K_d(e^*(k, i - 1))", "proved",
             reading="The law that the study runs, written by the error and its difference, is the printed line.",
             note="It is (K_p + K_d) e*(k) + K_p [e*(k+1) - e*(k)]. The claims below take (18) as printed.")
def pd_law() -> Goal:
    """(18) sorted by the error and its difference."""
    return Goal((equal(u_i, u_prev + K_p * e_next + K_d * e_now),),
                (equal(u_i, u_prev + (K_p + K_d) * e_now + K_p * e_difference), equal(e_difference, e_next - e_now)))


@paper.claim("18.name", "(18) is of PD type: K_p is the gain of the error, K_d that of its difference", "identity",
             r"\text{the improved PD-type ILC is designed as (18)}", "refuted", premises=("18",), severity="cosmetic", match="words", origin="ours",
             reading="A matter of the name alone, since (18) says what the law is: a PD law moves the input by K_p e*(k) + K_d [e*(k+1) - e*(k)].",
             correction=lambda: Goal((equal(u_i - u_prev, (K_p + K_d) * e_now + K_p * (e_next - e_now)),), paper.shown("18")),
             corrected_statement=r"u_f(k,i) - u_f(k,i-1) = (K_p + K_d)\,e^*(k,i-1) + K_p[e^*(k+1,i-1) - e^*(k,i-1)]",
             note="In the printed law the proportional gain is 1004.46 and the gain of the difference 4.46: what is called K_d "
                  "acts on a constant error, and K_p is the gain of the D part. It matters for the comparison of Figures 5 to 7, where this law is the other one.")
def pd_type() -> Goal:
    """The step of (18) against that of a PD law with the same gains."""
    return Goal((equal(u_i - u_prev, K_p * e_now + K_d * (e_next - e_now)),), paper.shown("18"))


length_prev, reached = sp.symbols("T_prev gamma_k", real=True)
KEEPS = r"\text{on } [T_i + 1, T_d] \text{ the error is } 0, \text{ hence } u_f(k, i) = u_f(k, i - 1)"


def _keeps_input(length: sp.Expr, least: int, *more: Relation) -> Goal:
    """(18) at a sample beyond `length`; trial i-1 has data up to its own length, which gamma_k = 0 or 1 says; `least`: of lengths."""
    ended = (at_least(length_prev, sample + 1), equal(reached, 1)) if length == length_i else (at_least(sample, length_prev + 1), equal(reached, 0))
    law, = paper.shown("18")
    lengths = (at_least(length, least), at_least(length_prev, least), at_least(sample, length + 1), at_most(sample, T_d), at_most(length_prev, T_d))
    return Goal((equal(law.right.xreplace({e_next: reached * e_one, e_now: reached * e_two}), u_prev),), (*dict.fromkeys((*ended, *lengths)), *more))


@paper.claim("18.missing", "On [T_i + 1, T_d] the input of trial i is kept", "implication", KEEPS, "gap", premises=("18", "18.error.ended"), severity="cosmetic", match="words",
             reading="As printed, with the length T_i of the trial whose input is set; a trial before it that was longer has data there. T_d and the lengths are those of section 4.",
             note="A slip of the index: (14) and (18) use the errors of trial i-1, so the input is kept beyond T_(i-1): 18.missing.mended.")
def pd_keeps_input_of_this_trial() -> Goal:
    """A trial that ends before the last one did."""
    return _keeps_input(length_i, SHORTEST + 1, equal(T_d, LENGTH))


@paper.claim("18.missing.mended", "On [T_(i-1) + 1, T_d] the input of trial i is kept", "implication",
             r"k \ge T_{i-1} + 1 \Rightarrow u_f(k, i) = u_f(k, i - 1)", "proved", premises=("18", "18.error.ended"), origin="ours", mends="18.missing")
def pd_keeps_input() -> Goal:
    """Both errors of (18) are missing."""
    return _keeps_input(length_prev, 1)


def _two_samples() -> tuple[sp.Expr, sp.Expr]:
    """Errors at samples 1 and 2 after a trial with errors e_1, e_2 (and none at 0) under (18)."""
    change_1 = b * pd_step(e_one, sp.Integer(0))
    change_2 = a * change_1 + b * pd_step(e_two, e_one)
    return e_one - change_1, e_two - change_2


opposite = {e_one: sp.Integer(1), e_two: sp.Integer(-1)}


@paper.claim("18.norm", "The map of (18) has a 2-norm above 1 in every unit of u", "inequality",
             r"K_d \ge 2K_p \Rightarrow \|e_i\|_2^2 > \|e_{i-1}\|_2^2\ \forall b > 0,\ a \in [0, 1]", "proved", premises=("5.trials", "18"), origin="ours",
             note="For e_(i-1) = (1, -1, ...); two samples suffice, as later ones do not act on them. K_d is 224 K_p in Table 1. So (18) as printed is never monotone, whatever u and k mean.")
def pd_norm() -> Goal:
    """The first two samples at e = (1, -1), for every b."""
    one, two = (x.xreplace(opposite) for x in _two_samples())
    return Goal((greater(one**2 + two**2, 2),), (at_least(K_d, 2 * K_p), at_least(a, 0), at_most(a, 1)))


def _pd_convergence(reading: Reading, converges: bool, note: str) -> None:
    @paper.claim(f"18.converges.{reading.suffix}", f"(18) {'converges' if converges else 'diverges'} at the first sample ({reading.title})", "condition",
                 r"|1 - bK_p| < 1" if converges else "1 - bK_p < -1", "proved", origin="ours",
                 premises=("5.trials", "18"), at={**stated(K_p), b: reading.gain}, note=note)
    def first_sample() -> Goal:
        one = sp.diff(_two_samples()[0], e_one)
        return Goal((less(one, 1), greater(one, -1)) if converges else (less(one, -1),))


_pd_convergence(newton, True, "The diagonal of the lifted map, theorem1.train's condition. The limit is far: 1 - b K_p = 1 - 1.3e-6.")
_pd_convergence(kilonewton_1s, True, "The diagonal of the lifted map.")
_pd_convergence(per_mass, True, "The diagonal is 0.554, but the entries below it are about -100.")
_pd_convergence(per_mass_1s, False, "The error of the first sample is multiplied by -3.46 in every trial.")

sine_i, sine_prev = sp.symbols("sin_i sin_prev", real=True)


@paper.claim("figure4.length", "The additional resistance changes with the length of the trial", "implication",
             r"\text{as the length of each trial changes, the train's additional resistance } f_a \text{ changes too}", "gap", premises=("2",), rests_on=("2",),
             severity="data", match="words", reading="Two trials of different lengths, from 1901 to 2000 as in section 4, that are at the same place at k, on a slope of one in a hundred, meet different resistances there.",
             note="By (2) f_a depends on the place alone, and the length of a trial enters neither (1) nor (2): two trials that have followed the same speeds up to k meet the same f_a, however "
                  "long they go on. f_a can change with the speeds of a trial, not with its length.")
def resistance_by_length() -> Goal:
    """(2) at the same place in trials of different lengths, which by Assumption 3 are above T_min."""
    stated_lengths = (x for length in (length_i, length_prev) for x in (at_least(length, SHORTEST + 1), at_most(length, LENGTH)))
    return Goal((differ(f_a_i, f_a_prev),), (equal(f_a_i, slope_coefficient * sine_i), equal(f_a_prev, slope_coefficient * sine_prev), equal(sine_i, sine_prev), equal(sine_i, sp.Rational(1, 100)), greater(f_a_i, 0), differ(length_i, length_prev), *stated_lengths))


paper.axiom("figure5", "Figure 5: the tracking of iCFDL-MFAILC gets better from trial to trial",
            r"\text{the tracking at trial 100 is better than at trial 50, that is, with the number of trials it gets better every time}",
            "read off Figure 5 by the authors", hypotheses=("16.samples", "17.units"), match="words", severity="data",
            note="A statement on simulations, which the study runs anew in every reading of the units. That each trial is better than the one before does not follow from two of them; of (18) see 18.norm.")
paper.axiom("figure6", "Figure 6: the tracking of the PD-type ILC gets better from trial to trial",
            r"\text{the tracking at trial 100 is better than at trial 50, that is, with the number of trials it gets better every time}",
            "read off Figure 6 by the authors", hypotheses=("16.samples", "17.units"), match="words", severity="data",
            note="Said of both figures in one sentence: see figure5.")
paper.definition("mse", "The mean squared error of a trial", r"MSE_i = \sum_{k=1}^{T_i}\frac{|e^*(k, i)|^2}{T_i}",
                 note="Up to T_i the improved error e* is the error e, so that a trial is measured where it ran.")
paper.axiom("figure7", "Figures 5 to 7: iCFDL-MFAILC tracks better than the PD law, and in fewer trials",
            r"\text{compared with the improved PD-type ILC the proposed iCFDL-MFAILC has better speed tracking within fewer trials}",
            "read off Figures 5 to 7 by the authors", hypotheses=("16.samples", "17.units"), match="words", severity="data",
            note="A statement on simulations, which the study runs anew in every reading of the units; the law that it is compared with is that of 18.name.")
