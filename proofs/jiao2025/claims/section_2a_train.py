"""Section 2, the train: (1)-(3), Remark 1, the unknown system (4), and two trials of the train."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater
from workbench.trains.train import F, a_0, b_0, c_0, f_add, m, single_particle, v

from ..paper import paper
from ..plant import (
    M,
    T_s,
    b_0k,
    b_1k,
    b_2k,
    basic_resistance,
    f_a,
    next_speed,
    slope_coefficient,
    u_i,
    u_prev,
    v_i,
    v_prev,
)

a = sp.Symbol("a", real=True)
b = sp.Symbol("b", positive=True)
newton_force = {F: u_i, m: M, a_0: b_0k, b_0: b_1k, c_0: b_2k, f_add: f_a, v: v_i}
newton_step = v_i + T_s * single_particle().rates[v].xreplace(newton_force)  # Euler's step of Newton's law


@paper.claim("1", "The train: an Euler step of Newton's law", "identity",
             r"v(k+1) = v(k) + \frac{T_s}{M} (u_f(k) - f_a(s) - f_b(v))", "proved",
             where={"v(k+1)": newton_step, "f_b(v)": basic_resistance(v_i)},
             note="With forces in N. The left side is an Euler step of Newton's law for the single-particle train with the Davis equation.")
def train_step() -> Goal:
    """One step of the train."""
    return Goal((equal(newton_step, v_i + T_s / M * (u_i - f_a - basic_resistance(v_i))),))


coasting_resistance = M / T_s * (v_i - newton_step.xreplace({u_i: sp.Integer(0), f_a: sp.Integer(0)}))
slope_sine, slope_cosine, weight = sp.symbols("sin_s cos_s W", real=True)
curve_force, tunnel_force = sp.symbols("f_curve f_tunnel", nonnegative=True)


@paper.claim("2", "Additional resistance of a slope", "identity", r"f_a(s) = x \cdot \sin(\%o(s))", "proved",
             where={r"\sin(\%o(s))": slope_sine, "x": slope_coefficient},
             reading="The letter before (s) is garbled; the text calls it the slope angle at s. x is read as the train's weight, for which the line is the part of the weight along the track.")
def slope_resistance() -> Goal:
    """The weight (0, -W) against the direction of travel (cos, sin)."""
    along_track = 0 * slope_cosine + (-weight) * slope_sine
    return Goal((equal(f_a, slope_coefficient * slope_sine),), (equal(f_a, -along_track), equal(slope_coefficient, weight)))


@paper.claim("2.curves", "f_a is the resistance of slopes, curves and tunnels, and (2) is all of it", "implication",
             r"f_a(s) \text{ is the additional resistance that slopes, curves and tunnels cause}", "gap", origin="ours",
             premises=("2",), severity="cosmetic", match="words",
             reading="The text below Figure 1 and (2) taken together.",
             note="By (2) a level curve or tunnel has no resistance. Harmless where curves and tunnels are counted as a slope, which the text does not say; f_a is taken as unknown later on.")
def slope_alone() -> Goal:
    """Slope, curve and tunnel against the slope alone."""
    return Goal((equal(f_a, slope_coefficient * slope_sine),), (equal(f_a, slope_coefficient * slope_sine + curve_force + tunnel_force),))


@paper.claim("3", "Basic resistance: the Davis equation", "identity",
             r"f_b(v) = b_0(k) + b_1(k)v(k) + b_2(k)v^2(k)", "proved", premises=("1",), where={"v^2(k)": v_i**2, "f_b(v)": coasting_resistance},
             note="What the Euler step of (1) takes from the speed of a train that coasts on a level line is the Davis equation.")
def davis_equation() -> Goal:
    """The step without force and slope."""
    coasted = v_i + T_s * single_particle().rates[v].xreplace({**newton_force, F: sp.Integer(0), f_add: sp.Integer(0)})
    return Goal((equal(M / T_s * (v_i - coasted), b_0k + b_1k * v_i + b_2k * v_i**2),))


paper.axiom("remark1", "Remark 1: time-varying resistance coefficients",
            r"\text{time-varying coefficients } b_0(k), b_1(k), b_2(k)\ \text{describe the real train more reasonably than constants}",
            "the paper's choice of a model", hypotheses=("3",), severity="cosmetic", match="words",
            note="A choice of a model, nothing to decide. By (17) they vary with k alone, so that every trial meets the same ones.")

f_a_i, f_a_prev = sp.symbols("f_a_i f_a_prev", real=True)


place_i, place_prev, start, steepness, run_so_far = sp.symbols("s_i s_prev s_0 L S", real=True)


@paper.claim("4", "The next speed is a function of the last n_v + 1 speeds and n_u + 1 inputs", "implication",
             r"v(k+1, i) = f(v(k, i), \dots, v(k-n_v, i)), u_f(k, i), \dots, u_f(k-n_u, i)", "proved", premises=("1",), rests_on=("1", "2", "3"),
             reading="The bracket of f closes at the end of the line. n_v is unknown in the paper and taken as large as it may be, back to the departure, and f knows k, as b_0(k) to b_2(k) do: two runs with "
                     "the same start, the same speeds since then, whose sum is S, and the same input go on alike.",
             note="f_a is a function of the place, taken as Lipschitz with the constant L, and the place is the start and T_s times the sum of all speeds since the departure. A window that does not reach back so "
                  "far is not enough: 4.window.")
def whole_window() -> Goal:
    """The same place, hence the same f_a, hence the same next speed."""
    steep = (at_least(steepness, 0), at_most(sp.Abs(f_a_i - f_a_prev), steepness * sp.Abs(place_i - place_prev)))
    places = (equal(place_i, start + T_s * run_so_far), equal(place_prev, start + T_s * run_so_far))
    return Goal((equal(next_speed(v_i, u_i, f_a_i), next_speed(v_i, u_i, f_a_prev)),), (*steep, *places),
                lemmas=(equal(place_i - place_prev, 0), equal(f_a_i - f_a_prev, 0)))


@paper.claim("4.window", "A window of a few samples gives the next speed", "implication",
             r"v(k+1, i) = f(v(k, i), \dots, v(k-n_v, i), u_f(k, i), \dots, u_f(k-n_u, i)),\ n_v < k", "gap", premises=("1",), origin="ours",
             reading="Two runs with the same last speeds and inputs are at places with other f_a.",
             note="f_a depends on the position, which is the sum of all speeds since departure: two runs with the same "
                  "last speeds and inputs at different positions go on differently.")
def finite_window() -> Goal:
    """The same speed and input with two values of f_a."""
    return Goal((equal(next_speed(v_i, u_i, f_a_i), next_speed(v_i, u_i, f_a_prev)),))


@paper.claim("A1", "Assumption 1, by Remark 2 easily verified from (1)-(3): the derivative by the input is continuous", "identity",
             r"\text{the partial derivative of f with respect to } u_f(k, i) \text{ is continuous}", "proved", premises=("1",), rests_on=("1", "3"),
             match="words", reading="Decided for the train: the derivative is T_s/M, a constant.",
             note="This is also what Remark 4 wants of Assumption 4, but phi_c of (5) is another quantity, see 5.")
def input_derivative() -> Goal:
    """D of (1) by u."""
    return Goal((equal(D(next_speed(v_i, u_i)), T_s / M),), flow={u_i: sp.Integer(1)})


two_trials = next_speed(v_i, u_i) - next_speed(v_prev, u_prev)
secant = 1 - T_s / M * (b_1k + b_2k * (v_i + v_prev))


@paper.claim("5.trials", "Difference of two trials of the train, without linearisation", "identity",
             r"\Delta v(k+1,i) = a\,\Delta v(k,i) + \frac{T_s}{M}\Delta u_f(k,i),\ "
             r"a = 1 - \tfrac{T_s}{M}(b_1 + b_2(v(k,i) + v(k,i-1)))", "proved", premises=("1",), origin="ours",
             note="(1)-(3) for two trials, with the same f_a. The term in Delta v(k), which comes from "
                  "the inputs before k, is the one that (5) does not have.")
def trial_difference() -> Goal:
    """(1) for trials i and i-1."""
    return Goal((equal(two_trials, secant * (v_i - v_prev) + T_s / M * (u_i - u_prev)),))


@paper.claim("5.trials.place", "The same where the trials meet other resistances", "identity",
             r"\Delta v(k+1,i) = a\,\Delta v(k,i) + \frac{T_s}{M}(\Delta u_f(k,i) - \Delta f_a(k,i))", "proved", premises=("1",), origin="ours",
             note="By (2) f_a differs where the trials are at other places at k, which earlier inputs have brought about; and where the line itself has changed.")
def trial_difference_with_places() -> Goal:
    """(1) for trials i and i-1, each with its own f_a."""
    there = next_speed(v_i, u_i, f_a_i) - next_speed(v_prev, u_prev, f_a_prev)
    return Goal((equal(there, secant * (v_i - v_prev) + T_s / M * (u_i - u_prev - (f_a_i - f_a_prev))),))


@paper.claim("remark4", "Remark 4: the output does not fall when the input at k alone rises", "inequality",
             r"\text{the system's output does not decrease when the control input increases}", "proved", premises=("A1",), match="words", section="3",
             reading="Decided for the train: v(k+1) has a positive derivative by u(k), at the same v(k).",
             note="True of the train, whose control direction is known. It is not Assumption 4, which Remark 4 reads it off and calls reasonable for many practical systems: "
                  "phi_c of (5) is not this derivative, see A4.train.")
def control_direction() -> Goal:
    """The derivative of A1 is positive."""
    return Goal((greater(D(next_speed(v_i, u_i)), 0),), flow={u_i: sp.Integer(1)})


@paper.claim("5.loss", "A train at the speeds of the trip is damped", "inequality", r"\tfrac{T_s}{M}(b_1 + 2\cdot 72\,b_2) < 1 \Rightarrow 0 < a \le 1", "proved",
             premises=("5.trials",), origin="ours", note="For speeds of both trials between 0 and 72 m/s; the claims on the train take 0 < a <= 1 from here.")
def damped() -> Goal:
    """The secant of 5.trials between standstill and 72 m/s."""
    slow = (at_least(v_i, 0), at_least(v_prev, 0), at_least(72, v_i), at_least(72, v_prev))
    return Goal((greater(secant, 0), at_least(1, secant)), (*slow, greater(1, T_s / M * (b_1k + 144 * b_2k))))
