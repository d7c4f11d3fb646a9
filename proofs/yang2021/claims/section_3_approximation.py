"""yang2021, section 3: the resistance and how well a network approximates it, (7), (8) and Assumption 2."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import Goal, at_most, equal
from workbench.trains.train import f

from ..error_dynamics import EVERY_NETWORK, STATED_F_STAR, eps_star, epsilon, f_star, f_true, h
from ..lyapunov import W_star_square
from ..paper import paper
from ..stated_values import grade_after, grade_before, section_resistances


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
slope_before, slope_after = sp.symbols("i_before i_after", real=True)

paper.definition("7", "The approximation error", r"f(\mathbf{x}) = \mathbf{W}^{*T}\mathbf{h}(\mathbf{x}) + \varepsilon(\mathbf{x})",
                 note="With (8) it says what eps is, whatever f is. That eps is bounded is 7.bounded; how small it can be, 7.continuous.")

paper.axiom("8", "The best weights exist",
            r"\mathbf{W}^* = \arg \min_{\mathbf{W} \in R^m} \left\{ \sup_{\mathbf{x} \in \Theta_x} |f(\mathbf{x}) - "
            r"\mathbf{W}^T \mathbf{h}(\mathbf{x})| \right\}",
            "existence of a best approximation in a space of finite dimension (Cheney 1966, chapter 1)", hypotheses=("A2",),
            note="For a bounded f, and for fixed centers and widths: 8.fixed.")


@paper.claim("7.continuous", "The text before (7): the network approximates the f of Table 1 with any precision", "condition",
             r"\text{RBFNN can approximate the unknown nonlinear additional resistance and interference function with any precision in the "
             r"compact working domain}", "violated",
             at={slope_before: grade_before, slope_after: grade_after}, match="words",
             reading="What continuous functions approximate with any precision is continuous, and so is the slope, in per mille, where the curve stays as it is, at 29,900 m of Table 1: "
                     "what stands before that border stands behind it.",
             note="It holds for continuous f; the slope of Table 1 jumps, so that f is not continuous and no network is nearer than half a jump. f steps there as the slope does, by 9.81 times 5.5/1000 or some 0.054 m/s^2, so that eps* is at least 0.027 m/s^2 whatever the network is (7.error). What falls is 'any "
                  "precision' and that eps* is small; (7) is not touched, it says what eps is, nor is Theorem 1, for which any bound will do (7.bounded). Section 3 says it itself at "
                  "first: 'any smooth function'.")
def resistance_is_continuous() -> Goal:
    """The slope on both sides of the border with the largest step of f."""
    return Goal((equal(slope_before, slope_after),))


one_hidden, other_hidden, one_best, other_best = sp.symbols("h_narrow h_wide W_narrow W_wide", positive=True)


@paper.claim("8.fixed", "W* is one and the same while (12)-(15) move centers and widths", "implication",
             r"W_1h_1 = f = W_2h_2 \Rightarrow W_1 = W_2", "gap", origin="ours", rests_on=(),
             reading="One neuron and one input: h_1 and h_2 are its outputs (5) with two widths, W_1 and W_2 the weights that fit f there.",
             note="(39) to (41) take the rate of W-tilde for that of W-hat, which needs fixed hidden functions.")
def best_weight_is_constant() -> Goal:
    """The fitting weight before and after a step of the width."""
    return Goal((equal(one_best, other_best),),
                (at_most(one_hidden, 1), at_most(other_hidden, 1), equal(one_best * one_hidden, other_best * other_hidden)))


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
             origin="ours", note="At 29,900 m, with 9.81 m/s^2, that is 0.027 m/s^2 at least.")
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
                  "or outside. This eps* contains f*. The smaller one of (8) is of Theta_x alone, and that x stays there is nowhere shown. That eps* is small is "
                  "another matter, see 7.continuous.")
def approximation_error_bounded() -> Goal:
    """|f - W*^T h| for any weights, with |f| <= f*."""
    given = (equal(f, f_true), at_most(sp.Abs(f), f_star), at_most(over_neurons(h**2), hidden_square))
    return Goal((at_most(sp.Abs(epsilon), error_bound_of_f),), given)
