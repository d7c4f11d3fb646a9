"""Section 1: what the introduction says of the method."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, at_most, equal

from ..paper import paper

paper.axiom("intro", "MFAILC converges monotonically in the 2-norm",
            r"\text{MFAILC can control repetitive unknown nonlinear systems, needs no model, and guarantees monotone convergence in the 2-norm}",
            "the introduction's summary of the literature on MFAILC, without a source of its own", hypotheses=(), severity="cosmetic", match="words",
            note="Said of MFAILC for systems that repeat strictly; nothing in the paper is derived from it. What the train does under these laws is asked in intro.lift to "
                 "intro.tradeoff, which are questions of ours.")

one_outcome, other_outcome = sp.symbols("e_a e_b", real=True)
tail, chance, mean_size, above = sp.symbols("delta P_x m_e x", positive=True)


@paper.claim("intro.error", "The analysis proves that the tracking error converges", "implication",
             r"\text{it is analysed in theory, and it is proved that the tracking error of the system converges}", "gap", match="words", rests_on=(), section="1",
             reading="What is proved is Theorem 1, that E{e(k,i)} goes to zero. Asked of an error with two equally likely values, whose expectation is zero.",
             note="An error of 1 in half of all runs and of -1 in the others has the expectation zero. E|e| is what should be said to converge, as theorem1.mended does: then the error converges "
                  "in probability, intro.error.mended.")
def mean_is_not_all() -> Goal:
    """Two outcomes of the same chance."""
    return Goal((equal(one_outcome, 0),), (equal((one_outcome + other_outcome) / 2, 0),))


@paper.claim("intro.error.mended", "Where E|e| goes to zero the error converges in probability", "inequality",
             r"E|e(k,i)| \to 0 \Rightarrow P[|e(k,i)| \ge \delta] \le \tfrac{1}{\delta}E|e(k,i)| \to 0", "proved", origin="ours", mends="intro.error",
             reading="Markov's inequality: E|e| is at least the chance P_x that |e| is at least x, times x, for x = delta and above.")
def markov() -> Goal:
    """The chance of a large error against its mean size."""
    return Goal((at_most(chance, mean_size / tail),), (at_least(above, tail), at_least(mean_size, chance * above)))
