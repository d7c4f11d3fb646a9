"""Section 3: the observer and its errors, (11)-(18)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater

from ..error_dynamics import W_f_star, eps_f, h_z
from ..goal_forms import within
from ..laws import (
    D_1,
    W_f_hat,
    f_hat,
    h_f,
    indexed,
    k_1,
    k_2,
    k_3,
    s_error,
    s_hat,
    s_hat_rate,
    speed_estimate_rate,
    v_error,
    v_hat,
    v_hat_rate,
)
from ..notation import OBSERVED
from ..paper import EVERY_NETWORK, paper
from ..plant import M, acceleration, chi, d, f_d, s, u, v

# (12) with k_3 v_tilde, as the extracted text prints it, and with k_3 s_tilde', as (18) and (25) have it.
along_printed = {s: v, v: acceleration, s_hat: s_hat_rate, v_hat: speed_estimate_rate(v_error)}
along_plant = along_printed | {v_hat: v_hat_rate}
v_other = sp.Symbol("v_other", real=True)
DAMPING = ("The extracted text of (12) and (14) has k_3 v_tilde where (18), (25), (26) and (27) have or need k_3 s_tilde'; "
           "both readings are decided.")


paper.definition("11", "The estimation errors", r"\tilde{s} = \hat{s} - s,\ \tilde{v} = \hat{v} - v")


LAW_12 = r"\dot{\hat{s}} = \hat{v} - k_1\tilde{s}"
paper.definition("12.position", "The observer's estimate of the position", LAW_12)


u_rate, resistance_rate, d_rate = sp.symbols("udot f_d_dot ddot_ext", real=True)
stated_f = chi / M * u - chi / M * f_d + d
RATE_OF_F = r"\frac{\chi}{M}u(t) - \frac{\chi}{M}f_d(v, t) + d(t)"


@paper.claim("12.function", "What f stands for, with the dot of the extracted text", "identity", rf"\dot{{f}} = {RATE_OF_F}",
             "refuted", severity="cosmetic", rests_on=(), glyph="12.function.glyph", where={"f": acceleration},
             reading="f is the right side of (9), as (14) and (15) take it.",
             note="The rate of f would need the rates of u, f_d and d. The text goes on with f, not with its rate.")
def rate_of_function() -> Goal:
    """D(f) with free rates of input, resistance and disturbance."""
    return Goal((equal(D(acceleration), stated_f),), flow={u: u_rate, f_d: resistance_rate, d: d_rate})


@paper.claim("12.function.glyph", "What f stands for, without the dot", "identity", rf"f = {RATE_OF_F}", "proved", origin="ours",
             glyph="12.function", rests_on=("9",), where={"f": D(v)})
def function_of_observer() -> Goal:
    """D(v) along (9)."""
    return Goal((equal(D(v), stated_f),), flow=along_printed)


@paper.claim("12", "The observer takes the measured position alone", "identity",
             r"\dot{\hat v} = \hat f - k_2\tilde s - k_3\tilde v + D_1", "refuted", glyph="12.glyph",
             reading="The section is to estimate the speed 'in accordance with the position information': with position "
                     "and estimates given, the right side is given whatever the speed is. The third line of (12) is "
                     "12.function.",
             note="With k_3 v_tilde = k_3 (v_hat - v) the observer needs the speed that it estimates. " + DAMPING +
                  " Table 3 speaks for k_3 v_tilde in the runs, and so for runs that had the speed. Where the errors "
                  "rest, f_hat - f + D_1 is k_2 s_tilde + k_3 v_tilde then, and k_2 RMS(s_tilde) + k_3 RMS(v_tilde) is 0.66 to 0.84 m/s^2 "
                  "in all ten columns, with Table 4's v_tilde for Value 10. With k_3 s_tilde' it is k_2 s_tilde alone, and k_2 "
                  "RMS(s_tilde) falls from 0.62 to 0.002 m/s^2.")
def observer_from_position() -> Goal:
    """The rate of v_hat at two speeds."""
    rate = speed_estimate_rate(v_error)
    return Goal((equal(rate, rate.xreplace({v: v_other})),))


@paper.claim("12.glyph", "The term -k_3 s_tilde' of the observer needs no differentiation", "identity",
             r"\frac{d}{dt}(\hat v + k_3\tilde s) = \hat f - k_2\tilde s + D_1", "proved", origin="ours", glyph="12",
             scope=EVERY_NETWORK, where=OBSERVED,
             note="(12) read as v_hat' = f_hat - k_2 s_tilde - k_3 s_tilde' + D_1: the term can be had by integration, "
                  "though v is not measured.")
def observer_without_derivative() -> Goal:
    """D(v_hat + k_3 s_tilde) along (12)."""
    return Goal((equal(D(v_hat + k_3 * s_error), f_hat - k_2 * s_error + D_1),), flow=along_plant)


@paper.claim("13", "Rate of the position estimate's error", "identity",
             r"\dot{\tilde s} = \tilde v - k_1\tilde s", "proved", where=OBSERVED)
def position_estimate_rate() -> Goal:
    """D(s_hat - s) along (9), (12)."""
    return Goal((equal(D(s_error), v_error - k_1 * s_error),), flow=along_printed)


@paper.claim("14", "Rate of the speed estimate's error", "identity",
             r"\dot{\tilde v} = \hat f(z_1) - f(z_1) - k_2\tilde s - k_3\tilde v + D_1", "proved", premises=("12",),
             rests_on=(), glyph="14.glyph", scope=EVERY_NETWORK, where=OBSERVED, note=DAMPING)
def speed_error_rate() -> Goal:
    """D(v_hat - v) along (9), (12) as printed."""
    return Goal((equal(D(v_error), f_hat - acceleration - k_2 * s_error - k_3 * v_error + D_1),), flow=along_printed)


@paper.claim("14.glyph", "The same with k_3 s_tilde'", "identity",
             r"\dot{\tilde v} = \hat f(z_1) - f(z_1) - k_2\tilde s - k_3\dot{\tilde s} + D_1", "proved", origin="ours",
             glyph="14", scope=EVERY_NETWORK, where=OBSERVED)
def speed_error_rate_by_rate() -> Goal:
    """D(v_hat - v) along (9), (12) as (18) and (25) have it."""
    return Goal((equal(D(v_error), f_hat - acceleration - k_2 * s_error - k_3 * D(s_error) + D_1),), flow=along_plant)


d_now, d_later = sp.symbols("d_now d_later", real=True)

paper.definition("15.split", "The error of the network is what it leaves of f",
                 r"f = W_f^{*T}h_f(z_1) + \varepsilon_f(z_1)",
                 note="True of any weights, eps_f being defined by it; that it is small is the second half of (15).")
paper.axiom("15", "Universal approximation of f by the network",
            r"f = W_f^{*T}h_f(z_1) + \varepsilon_f(z_1),\quad |\varepsilon_f(z_1)| \le \varepsilon_{f,N}", "Park and Sandberg 1991, for f continuous on a compact set",
            hypotheses=("15.function.mended", "15.inside"),
            reading="The function f of the third line of (12), on a compact set Omega, its error with what depends on the "
                    "time in it, see 15.function.mended.")


GAUSSIAN = r"%s = \exp\left(\frac{-\|%s^T - %s\|^2}{%s^2}\right)"
paper.definition("16", "The hidden functions of the first network", GAUSSIAN % ("h_{f,j}", "z_1", "c_{f,j}", r"\sigma_{f,j}"),
                 note="Its width sigma_{f,j} is called 'the i th hidden layer node'. Proofs use that it lies between 0 and 1.")
paper.definition("17", "The network in the place of f", r"\hat{f} = \widehat{W}_f^T h_f(\widehat{z}_1)")


f_of_input, change, change_max, eps_z = sp.symbols("f_z r_t r_max epsilon_z", real=True)
eps_limit = sp.Symbol("epsilon_N", real=True)


def _with_what_changes() -> Goal:
    """f = f_z + r_t, of which the network leaves eps_z of f_z."""
    network = f_of_input - eps_z
    return Goal(within(f_of_input + change - network, eps_limit + change_max),
                (*within(eps_z, eps_limit), *within(change, change_max)))


@paper.claim("15.function", "f is a function of z_1 = [s, v, u]", "implication",
             r"\text{the function}\ f(z_1): \Omega \rightarrow \mathfrak{R}\ \text{is bounded}", "gap", match="words",
             severity="cosmetic", rests_on=("assumption3",), correction=_with_what_changes,
             reading="That it is a function: at two instants with the same z_1 f is the same.",
             corrected_statement=r"f = f_z(z_1) + r(t),\ |f_z - W_f^{*T}h_f(z_1)| \le \varepsilon_N,\ |r(t)| \le r_{\max} "
                                 r"\Rightarrow |f - W_f^{*T}h_f(z_1)| \le \varepsilon_N + r_{\max}",
             note="f contains d(t), and a_i(t), l(t), so eps_f depends on the time too. Assumption 3 bounds what they do: with "
                  "eps_f(z_1, t) and a larger bound (15) serves as it is used, see 15.function.mended. How small "
                  "that bound can be is then no question of the network's size: no less than half of what f changes at the "
                  "same z_1.")
def f_depends_on_z1() -> Goal:
    """f of (9) at two instants with the same position, speed and input."""
    return Goal((equal(acceleration.xreplace({d: d_now}), acceleration.xreplace({d: d_later})),))


@paper.claim("15.function.mended", "(15) with an error that depends on the time as well", "implication",
             r"f = f_z(z_1) + r(t),\ |f_z - W_f^{*T}h_f(z_1)| \le \varepsilon_N,\ |r(t)| \le r_{\max} \Rightarrow "
             r"|f - W_f^{*T}h_f(z_1)| \le \varepsilon_N + r_{\max}", "proved", origin="ours", mends="15.function",
             note="r is what d(t), a_i(t) and l(t) change f by at the same z_1, bounded by Assumption 3 while z_1 stays in "
                  "Omega (15.inside).")
def f_with_what_changes() -> Goal:
    """The two errors add up."""
    return _with_what_changes()


size, theta_z = sp.symbols("z theta_z", real=True)


@paper.claim("15.inside", "The input of the network stays in the set on which (15) holds", "implication",
             r"|\varepsilon_f(z)| \le \varepsilon_{f,N}\ \text{for}\ z \in \Omega \Rightarrow |\varepsilon_f(z(t))| \le "
             r"\varepsilon_{f,N}\ \text{for all}\ t", "gap", origin="implied",
             note="A bound of delta and theta for all t is needed: the mended forms of Theorem 1, (48) and Remark 2 have it as a "
                  "condition. The printed proofs take eps_tilde_f itself for delta. That z stays in Omega is not shown, and cannot "
                  "be concluded afterwards from bounds that use it. In the model: Omega = [-theta_z, theta_z], eps_f(z) = eps_N "
                  "z^2/theta_z^2.")
def input_stays_inside() -> Goal:
    """An error that is bounded inside a set may be larger outside."""
    grows = equal(eps_f, eps_limit * size**2 / theta_z**2)
    return Goal((at_most(eps_f, eps_limit),), (greater(theta_z, 0), at_least(eps_limit, 0), grows))


eps_tilde_stated = over_neurons(W_f_star * (h_f - h_z)) - eps_f
NETWORK_ERROR = OBSERVED | {r"\tilde\varepsilon_f(z_1)": eps_tilde_stated}
by_networks = {v: over_neurons(W_f_star * h_z) + eps_f}  # (15)


def _error_rate(damping: sp.Expr) -> sp.Expr:
    """The right side of (18), `damping` its terms with k_i."""
    return damping + over_neurons((W_f_hat - W_f_star) * h_f) + D_1 + eps_tilde_stated


@paper.claim("18", "Rate of the speed estimate's error with the networks", "identity",
             r"\dot{\tilde v} = -k_3\tilde v - (k_2 - k_1k_3)\tilde s + \tilde W_f^Th_f(\hat z_1) + D_1 + "
             r"\tilde\varepsilon_f(z_1)", "refuted", glyph="18.glyph", premises=("13", "14", "15.split"), scope=EVERY_NETWORK,
             where=NETWORK_ERROR,
             reading="Hats over v, s and W_f are read as tildes, as the text before and after has them; eps_tilde_f is "
                     "W_f*^T (h_f(z_1_hat) - h_f(z_1)) - eps_f.",
             correction=lambda: Goal((equal(D(v_error), _error_rate(-k_3 * v_error - k_2 * s_error)),),
                                     flow=along_printed | by_networks),
             corrected_statement=r"\dot{\tilde v} = -k_3\tilde v - k_2\tilde s + \tilde W_f^Th_f(\hat z_1) + D_1 + "
                                 r"\tilde\varepsilon_f",
             note="From (14) as extracted. " + DAMPING + " With k_3 s_tilde' it holds, see 18.glyph.")
def speed_error_rate_networks() -> Goal:
    """D(v_hat - v) with (15) and (17), along (12) as printed."""
    return Goal((equal(D(v_error), _error_rate(-k_3 * v_error - (k_2 - k_1 * k_3) * s_error)),),
                flow=along_printed | by_networks)


@paper.claim("18.glyph", "The same from (12) with k_3 s_tilde'", "identity",
             r"\dot{\tilde v} = -k_3\tilde v - (k_2 - k_1k_3)\tilde s + \tilde W_f^Th_f(\hat z_1) + D_1 + "
             r"\tilde\varepsilon_f(z_1)", "proved", origin="ours", glyph="18", premises=("13", "14.glyph", "15.split"),
             rests_on=("15.split",), scope=EVERY_NETWORK, where=NETWORK_ERROR)
def speed_error_rate_networks_by_rate() -> Goal:
    """D(v_hat - v) with (15) and (17), along (12) as (18) and (25) have it."""
    return Goal((equal(D(v_error), _error_rate(-k_3 * v_error - (k_2 - k_1 * k_3) * s_error)),),
                flow=along_plant | by_networks)


W_N, root_of_m = sp.symbols("W_N root_m", positive=True)
h_change = indexed("h_change")


def _bounded_error() -> Goal:
    given = (at_most(over_neurons(W_f_star**2), W_N**2), at_most(over_neurons(h_change**2), root_of_m**2),
             *within(eps_f, eps_limit))
    product, largest = over_neurons(W_f_star * h_change), W_N * root_of_m
    young = tuple(at_most(sign * product * largest, largest**2) for sign in (1, -1))
    return Goal(within(product - eps_f, largest + eps_limit), given, lemmas=(*young, *within(product, largest)))


paper.axiom("18.lipschitz", "The hidden functions are Lipschitz",
            r"\|h_f(\hat z_1) - h_f(z_1)\| \le L_\phi\|\hat z_1 - z_1\|", "the paper's [34]; true of Gaussians",
            hypotheses=(), severity="cosmetic",
            note="Not needed: that hidden outputs lie between 0 and 1 bounds eps_tilde_f already, see 18.bounded.")


@paper.claim("18.bounded", "The error of the networks is bounded", "inequality",
             r"\text{A bounded function}\ \delta = \tilde\varepsilon_f(z_1)\ \text{exists}", "proved", match="words",
             premises=("15", "18.bound"), rests_on=("15", "18.lipschitz"), scope=EVERY_NETWORK,
             reading="By 18.bound, while z_1 stays in Omega.")
def network_error_bounded() -> Goal:
    """W*^T h_change - eps_f with h_change = h_f(z_1_hat) - h_f(z_1)."""
    return _bounded_error()


@paper.claim("18.bound", "A constant that bounds the error of the networks", "inequality",
             r"z_1 \in \Omega:\ |\tilde\varepsilon_f| \le \|W_{f,N}\|\sqrt{m} + \varepsilon_{f,N}", "proved", origin="ours",
             scope=EVERY_NETWORK,
             reading="The m hidden outputs lie between 0 and 1, so that the squares of their differences add up to m at most.")
def network_error_bound() -> Goal:
    """By the inequality of Cauchy and Schwarz."""
    return _bounded_error()
