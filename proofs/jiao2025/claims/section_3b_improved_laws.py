"""Section 3, iCFDL-MFAILC: the laws (14) and (15), and what they do where data are missing."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal

from ..laws import (
    Delta_u,
    Delta_v,
    e_next,
    e_prev,
    e_prev2,
    epsilon,
    estimate_step,
    gamma,
    gamma_prev2,
    input_step,
    phi_prev,
)
from ..notation import xi_star
from ..paper import paper
from ..plant import u_prev
from .section_2c_algorithm import estimation_law, input_law

with_gamma = {e_next: gamma * e_prev}  # e*(k+1,i-1)


@paper.claim("14", "The input law with the modified error", "identity",
             r"u_f(k, i) = u_f(k, i - 1) + \frac{\rho \hat{\phi}_c(k, i)}{\lambda + |\hat{\phi}_c(k, i)|^2} e^*(k + 1, i - 1)", "proved",
             premises=("8.minimum",), rests_on=("11", "14.error"),
             reading="The law is rho times the step to the minimiser of (7) with the estimate for phi_c and the modified error for the error.")
def improved_input() -> Goal:
    """(8) with e* for e."""
    return input_law(e_next)


@paper.claim("14.kept", "Where data are missing the input is kept", "implication",
             r"\gamma(k+1,i-1) = 0 \Rightarrow u_f(k,i) = u_f(k,i-1)", "proved", premises=("14",), origin="implied",
             note="The text says so below (18), of both laws, with another index: 18.missing.")
def kept_input() -> Goal:
    """(14) at gamma = 0."""
    law, = paper.shown("14")
    return Goal((equal(law.right.xreplace(with_gamma), u_prev),), (equal(gamma, 0),))


@paper.claim("15", "The estimation law with the modified innovation", "identity",
             r"\hat{\phi}_c(k, i) = \hat{\phi}_c(k, i - 1) + \frac{\eta \Delta u_f(k, i - 1)}{\mu + |\Delta u_f(k, i - 1)|^2} \times \xi^*(k + 1, i - 1)", "proved",
             premises=("9.minimum",), rests_on=("12", "15.innovation"),
             reading="The step is eta times that to the minimiser of (9) with the modified innovation for the innovation.")
def improved_estimate() -> Goal:
    """(12) with xi* for xi."""
    return estimation_law(xi_star, ())


with_missing = {xi_star: gamma * (Delta_v - phi_prev * Delta_u)}


@paper.claim("15.kept", "Where data are missing the estimate is kept", "implication",
             r"\gamma(k+1,i-1) = 0 \Rightarrow \hat\phi_c(k,i) = \hat\phi_c(k,i-1)", "proved", premises=("15",), origin="implied",
             note="Before the reset (13), which puts phi_hat(k,1) in its place one trial later: 15.reset.")
def kept_estimate() -> Goal:
    """(15) at gamma = 0."""
    law, = paper.shown("15")
    return Goal((equal(law.right.xreplace(with_missing), phi_prev),), (equal(gamma, 0),))


step_before = input_step(phi_prev, gamma_prev2 * e_prev2)  # Delta u(k, i-1) by (14)


@paper.claim("15.data", "The laws use measured inputs and outputs alone", "implication",
             r"\gamma(k+1,i-2) = 0 \Rightarrow \frac{\partial\hat\phi_c(k,i)}{\partial v(k+1,i-2)} = 0", "proved",
             premises=("14",), origin="implied",
             reading="The abstract: only the input and output data of the train are used. Decided where it is in doubt: a speed of a trial that had ended does not enter (15).",
             note="xi(k+1,i-1) contains v(k+1,i-2), and the gamma before it is that of trial i-1. Where trial i-2 "
                  "had ended, (14) has kept the input, and the missing speed is multiplied by zero.")
def no_missing_speed() -> Goal:
    """D of (15) by the speed of trial i-2."""
    now, missing = sp.symbols("v_now v_missing", real=True)
    new = phi_prev + estimate_step(step_before, gamma * (now - missing - phi_prev * step_before))
    return Goal((equal(D(new), 0),), (equal(gamma_prev2, 0),), {missing: sp.Integer(1)})


@paper.claim("15.reset", "A trial that ends early makes (13) forget the estimate", "implication",
             r"\gamma(k+1,i-2) = 0 \Rightarrow |\Delta u_f(k,i-1)| \le \varepsilon\ \text{and (13) sets}\ "
             r"\hat\phi_c(k,i) = \hat\phi_c(k,1)", "proved", premises=("14",), origin="ours",
             note="Near the end of the trip, where a trial rarely gets to (1 in 100 at k = 2000), an estimate is learned only when "
                  "two trials running reach k + 1, and is forgotten after the next that does not: the adaptation is out of work there.")
def early_end_resets() -> Goal:
    """Delta u(k,i-1) of (14) at gamma(k+1,i-2) = 0."""
    return Goal((at_most(step_before**2, epsilon**2),), (equal(gamma_prev2, 0),))
