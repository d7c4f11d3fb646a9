"""yang2021, section 3: the resistance and how well a network approximates it, (7), (8) and Assumption 2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import Goal, at_most, equal
from workbench.trains.train import f

from ..error_dynamics import EVERY_NETWORK, STATED_F_STAR, eps_star, epsilon, f_star, f_true, h
from ..lyapunov import W_star_square
from ..paper import paper
from ..stated_values import after_jump, before_jump, section_resistances


@paper.claim("A2", "Assumption 2: f is bounded on the line of Table 1", "condition",
             r"|f(\mathbf{x})| \leq f^*", "proved", at={f: max(section_resistances(), key=abs), f_star: STATED_F_STAR},
             where={r"f(\mathbf{x})": f, "f^*": f_star},
             reading="f is the grade and curve resistance of the section of Table 1 where it is largest, by the formula that the "
                     "simulation uses, and f* = 0.06 m/s^2.",
             note="The disturbance that the paper adds is not described.")
def resistance_bounded() -> Goal:
    """The largest resistance of all sections against f*."""
    return Goal((at_most(sp.Abs(f), f_star),))


f_before, f_after, y_f = sp.symbols("f_before f_after y_f", real=True)

paper.axiom("7", "Universal approximation by the network, with any precision",
            r"f(\mathbf{x}) = \mathbf{W}^{*T}\mathbf{h}(\mathbf{x}) + \varepsilon(\mathbf{x})",
            "Park and Sandberg 1991, for f continuous on a compact set", hypotheses=("7.continuous",),
            reading="On a compact set some weights make the error as small as one likes.",
            note="The proof of Theorem 1 needs less: that the error is bounded, see 7.bounded.")

paper.axiom("8", "The best weights exist",
            r"\mathbf{W}^* = \arg \min_{\mathbf{W} \in R^m} \left\{ \sup_{\mathbf{x} \in \Theta_x} |f(\mathbf{x}) - "
            r"\mathbf{W}^T \mathbf{h}(\mathbf{x})| \right\}",
            "existence of a best approximation in a space of finite dimension (Cheney 1966, chapter 1)", hypotheses=("A2",),
            note="For a bounded f. The best weights belong to fixed centers and widths, while (12)-(15) move them.")


@paper.claim("7.continuous", "The text before (7): f is smooth, as the approximation with any precision asks", "condition",
             r"\text{it can approximate any smooth function with any precision [...] RBFNN can approximate the unknown nonlinear "
             r"additional resistance and interference function with any precision in the compact working domain}", "violated",
             at={f_before: before_jump, f_after: after_jump}, match="words",
             reading="A smooth f has one value from both sides of every border between sections of Table 1.",
             note="At the border with the largest jump, 29,900 m, where the slope steps from 2.5 to -3 per mille. Grade and curve "
                  "change in steps in Table 1, so f is not continuous and eps* cannot be made small.")
def resistance_is_continuous() -> Goal:
    """The additional resistance on both sides of a section border agrees."""
    return Goal((equal(f_before, f_after),))


f_at_x, rest_now, rest_later = sp.symbols("f_x f_now f_later", real=True)


@paper.claim("7.time", "f is a function of the network's input", "implication",
             r"f(\mathbf{x}) = -\frac{f(x_1, x_2, t)}{m},\ \mathbf{x} = [x_1\ x_2]^T", "gap", origin="implied", severity="cosmetic",
             rests_on=(),
             reading="At two instants with the same position and speed f is the same, as (7) has it.",
             note="(1) and (4) let f depend on time, and so does Assumption 2, by which f(x) is time-varying. What the "
                  "network cannot know is left to eps, which then depends on time too; the proof needs only that it is "
                  "bounded (7.bounded).")
def resistance_without_time() -> Goal:
    """The part of f that changes with time, at two instants."""
    return Goal((equal(f_at_x + rest_now, f_at_x + rest_later),))


@paper.claim("7.error", "What a step in f costs the approximation", "inequality",
             r"|f(s^\pm) - y| \le \varepsilon^* \Rightarrow \varepsilon^* \ge \tfrac12 |f(s^+) - f(s^-)|", "proved",
             origin="ours")
def step_costs_half() -> Goal:
    """A continuous output y misses one side of a step by half of it."""
    near = tuple(rel for side in (f_before, f_after)
                 for rel in (at_most(side - y_f, eps_star), at_most(y_f - side, eps_star)))
    return Goal((at_most(f_after - f_before, 2 * eps_star), at_most(f_before - f_after, 2 * eps_star)), near)


hidden_square = sp.Symbol("H", nonnegative=True)
error_bound_of_f = f_star + (W_star_square + hidden_square) / 2


@paper.claim("7.bounded", "The approximation error is bounded", "inequality",
             r"|\varepsilon(\mathbf{x})| \leq \varepsilon^*", "proved", premises=("A2",), scope=EVERY_NETWORK,
             where={r"\varepsilon(\mathbf{x})": epsilon, r"\varepsilon^*": error_bound_of_f},
             reading="eps* is f* + (|W*|^2 + H)/2 with H the sum of the squared Gaussians, at most the number of neurons.",
             note="From Assumption 2 alone: f and the Gaussians are bounded everywhere, so the error is, inside the set of (7) "
                  "or outside. That eps* is small is another matter, see 7.continuous.")
def approximation_error_bounded() -> Goal:
    """|f - W*^T h| for any weights, with |f| <= f*."""
    given = (equal(f, f_true), at_most(sp.Abs(f), f_star), at_most(over_neurons(h**2), hidden_square))
    return Goal((at_most(sp.Abs(epsilon), error_bound_of_f),), given)
