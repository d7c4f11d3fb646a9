"""Section 4: the output feedback controller (22)-(35)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less

from ..error_dynamics import (
    W_f_star,
    W_v_star,
    W_v_tilde,
    eps_tilde,
    eps_v,
    f_v_by_network,
    in_errors,
    one_neuron,
    t,
    theta,
    theta_tilde,
    tracking_loop,
    w_v,
)
from ..goal_forms import within
from ..laws import (
    D_1,
    D_2,
    W_f_hat,
    W_v_0,
    W_v_hat,
    alpha_2,
    beta_2,
    command,
    e_s_stated,
    e_v,
    e_v_stated,
    f_hat,
    gamma_2,
    h_f,
    h_v,
    k_1,
    k_2,
    k_3,
    k_4,
    k_5,
    robust_1,
    robust_2,
    s_d,
    s_error,
    s_error_rate,
    s_hat,
    s_hat_rate,
    sddot_d,
    sdot_d,
    sigma_v,
    theta_0,
    theta_hat,
    v_hat,
    v_hat_rate,
)
from ..lyapunov import V_v
from ..paper import EVERY_NETWORK, paper
from ..plant import M, acceleration, chi, d, f_d, s, u, v
from .section_3 import leakage_claim

along_tracking = {s: v, s_d: sdot_d, sdot_d: sddot_d, s_hat: s_hat_rate, v_hat: v_hat_rate}


@paper.claim("22", "Rate of the tracking error", "identity", r"\dot e_s = \dot s_d - \hat v", "refuted",
             correction=lambda: Goal((equal(D(e_s_stated), sdot_d - v_hat + k_1 * s_error),), flow=along_tracking),
             corrected_statement=r"\dot e_s = \dot s_d - \hat v + k_1\tilde s",
             note="By (12) s_hat' is v_hat - k_1 s_tilde, not v_hat. Where (23)-(25) are taken with e_v = k_4 e_s + s_d' - "
                  "v_hat they are right, and (25) itself has the missing term; e_s then follows e_v through a filter "
                  "that s_tilde drives too, see 23.")
def tracking_error_rate() -> Goal:
    """D(s_d - s_hat) along (12)."""
    return Goal((equal(D(e_s_stated), sdot_d - v_hat),), flow=along_tracking)


e_s, e_s_0, e_s_rate, drive = sp.symbols("e_s e_s_0 edot_s drive", real=True)
drive_max = sp.Symbol("B", nonnegative=True)


@paper.claim("23", "A bounded e_v and s_tilde give a bounded tracking error", "implication",
             r"|e_v + k_1\tilde s| \le B\ \forall t \Rightarrow e_s(t) \le \tfrac{B}{k_4} + \left(e_s(0) - "
             r"\tfrac{B}{k_4}\right)e^{-k_4t}", "proved", premises=("23.filter",),
             note="V_2 does not contain e_s, so Theorem 2 needs this step, which the paper does not state. The same holds "
                  "for -e_s. The train's own error is s_d - s = e_s + s_tilde.")
def filter_bound() -> Goal:
    """exp(k_4 t)(e_s - B/k_4) does not increase."""
    level = drive_max / k_4
    return Goal((at_most(e_s, level + (e_s_0 - level) * sp.exp(-k_4 * t)),), (at_least(t, 0),),
                {t: sp.Integer(1), e_s: e_s_rate}, (equal(e_s_rate, -k_4 * e_s + drive), *within(drive, drive_max)),
                {t: sp.Integer(0), e_s: e_s_0},
                decreasing=sp.exp(k_4 * t) * (e_s - level), inputs=(e_s_rate, drive))


@paper.claim("23.filter", "The tracking error filters e_v", "identity",
             r"\dot e_s = -k_4e_s + e_v + k_1\tilde s", "proved",
             note="(23) read with the second line of (22) for e_s'; the last term is what that line misses.")
def filter_rate() -> Goal:
    """D(e_s) in terms of e_v."""
    return Goal((equal(D(e_s_stated), -k_4 * e_s_stated + e_v_stated + k_1 * s_error),), flow=along_tracking)


@paper.claim("24", "Rate of e_v", "identity",
             r"\dot e_v = k_4(\dot s_d - \dot{\hat s}) + (\ddot s_d - \dot{\hat v})", "proved", scope=EVERY_NETWORK,
             note="With e_v = k_4 e_s + s_d' - v_hat. The text says (21) where it differentiates (23), and has s_d' in the "
                  "second bracket, where (25) forces s_d''.")
def e_v_rate_open() -> Goal:
    """D(e_v) along (12)."""
    return Goal((equal(D(e_v_stated), k_4 * (sdot_d - D(s_hat)) + (sddot_d - D(v_hat))),), flow=along_tracking)


@paper.claim("25", "Rate of e_v with the observer and the plant", "identity",
             r"\tfrac{M}{\chi}\dot e_v = \tfrac{k_4M}{\chi}(\dot s_d - (\hat v - k_1\tilde s)) + \tfrac{M}{\chi}\ddot s_d - "
             r"\tfrac{M}{\chi}\left(\hat f - f - \tfrac{\chi}{M}f_d + d - k_2\tilde s - k_3\dot{\tilde s} + D_1\right) - u",
             "proved", premises=("24",), scope=EVERY_NETWORK)
def e_v_rate_plant() -> Goal:
    """M/chi D(e_v) along (12), f of (12) written out."""
    stated = (k_4 * M / chi * (sdot_d - (v_hat - k_1 * s_error)) + M / chi * sddot_d
              - M / chi * (f_hat - acceleration - chi / M * f_d + d - k_2 * s_error - k_3 * s_error_rate + D_1) - u)
    return Goal((equal(M / chi * D(e_v_stated), stated),), flow=along_tracking)


f_error = over_neurons((W_f_hat - W_f_star) * h_f) + eps_tilde  # f_hat - f by (15), (17), (18)
f_v_stated = (k_4 * M / chi * (sdot_d - v_hat + k_1 * s_error)
              - M / chi * (f_error - chi / M * f_d - k_2 * s_error - k_3 * s_error_rate + robust_1 - sddot_d))  # (27)
eps_tilde_left = over_neurons(W_f_star * h_f) - acceleration  # what (15) leaves to eps_tilde


@paper.claim("26", "Rate of e_v with f_v of (27)", "identity",
             r"\tfrac{M}{\chi}\dot e_v = f_v - \tfrac{M}{\chi}d - u", "proved", premises=("18", "25"),
             scope=EVERY_NETWORK,
             note="(27) is read with W_f_tilde^T h_f(z_1_hat), delta_hat and s_d'', which (26) and (20) force.")
def e_v_rate_uncertainty() -> Goal:
    """M/chi D(e_v) along (12) with (20), against (27)."""
    along = along_tracking | {v_hat: v_hat_rate.xreplace({D_1: robust_1})}
    stated = f_v_stated.xreplace({eps_tilde: eps_tilde_left}) - M / chi * d - u
    return Goal((equal(M / chi * D(e_v_stated), stated),), flow=along)


f_v_inside = (M / chi * (k_4 * (sdot_d - v_hat + k_1 * s_error) + sddot_d - f_hat + k_2 * s_error + k_3 * s_error_rate
                         - robust_1) + M / chi * d + u)


@paper.claim("27", "f_v contains the input", "identity",
             r"f_v = \tfrac{M}{\chi}\left(k_4(\dot s_d - \hat v + k_1\tilde s) + \ddot s_d - \hat f + k_2\tilde s + "
             r"k_3\dot{\tilde s} + \gamma(\tilde v)\hat\delta\right) + \tfrac{M}{\chi}d + u", "proved", premises=("26",),
             scope=EVERY_NETWORK,
             note="Not printed, but what (27) says: e_v is made of the observer's own states, so f_d, d and -u of (26) come "
                  "back in f_v and cancel. The input moves e_v only through f_hat = W_f_hat^T h_f(z_1_hat), whose "
                  "input contains u: while W_f_hat = 0, not at all.")
def uncertainty_contains_input() -> Goal:
    """(27) with eps_tilde written out."""
    return Goal((equal(f_v_stated.xreplace({eps_tilde: eps_tilde_left}), f_v_inside),))


paper.axiom("28", "Universal approximation of f_v by the network",
            r"f_v = W_v^{*T}h_v(z_2) + \varepsilon_v(z_2),\ |\varepsilon_v(z_2)| \le \varepsilon_{v,N}",
            "Park and Sandberg 1991, for a continuous function on a compact set",
            hypotheses=("28.function", "15.inside"))

u_other = sp.Symbol("u_other", real=True)


@paper.claim("28.function", "f_v is a function of z_2", "implication",
             r"z_2 = z_2' \Rightarrow f_v = f_v',\quad z_2 = [s, \dot s, \hat v, s_d, \dot s_d, \ddot s_d]", "gap",
             premises=("27",),
             note="f_v depends on u, on the weights W_f_hat, on s_hat, delta_hat and d(t), none of which is in z_2. Decided "
                  "for u, with the first network at rest (W_f_hat = 0). u contains W_v_hat, so the function that the "
                  "network is to learn changes as it learns. By Assumptions 2 and 3 f_v is said to be bounded, but it "
                  "contains W_f_tilde, which Theorem 1 has yet to bound. z_2 also contains s', which is not measured.")
def uncertainty_depends_on_z2() -> Goal:
    """f_v at two inputs, everything else the same."""
    untrained = f_v_inside.xreplace({f_hat: sp.Integer(0)})
    return Goal((equal(untrained, untrained.xreplace({u: u_other})),))


@paper.claim("31", "Rate of e_v with the control law", "identity",
             r"\tfrac{M}{\chi}\dot e_v = (W_v^* - \hat W_v)^Th_v(z_2) + \varepsilon_v - k_5e_v - D_2 - "
             r"\tfrac{M}{\chi}d", "proved", premises=("26", "28"), scope=EVERY_NETWORK)
def e_v_rate_command() -> Goal:
    """(28) and (31) in (26)."""
    stated = over_neurons((W_v_star - W_v_hat) * h_v) + eps_v - k_5 * e_v - D_2 - M / chi * d
    return Goal((equal(f_v_by_network - M / chi * d - command, stated),))


def _closed_e_v(sign: int) -> Goal:
    """M/chi D(e_v) along the closed loop, the sign of the weights' term free."""
    stated = -k_5 * e_v + sign * over_neurons(W_v_tilde * h_v) + eps_v - M / chi * d - in_errors(robust_2)
    along = tracking_loop(residual=eps_v - M / chi * d)
    return Goal((equal(M / chi * D(e_v), stated),), flow={e_v: along[e_v]})


@paper.claim("33", "Rate of e_v in closed loop", "identity",
             r"\tfrac{M}{\chi}\dot e_v = -k_5e_v + \tilde W_v^Th_v(z_2) + \varepsilon_v - \tfrac{M}{\chi}d - D_2,\quad "
             r"\tilde W_v = \hat W_v - W_v^*", "refuted", premises=("31",), scope=EVERY_NETWORK,
             correction=lambda: _closed_e_v(-1),
             corrected_statement=r"\tfrac{M}{\chi}\dot e_v = -k_5e_v - \tilde W_v^Th_v(z_2) + \varepsilon_v - "
                                 r"\tfrac{M}{\chi}d - D_2",
             note="W_v* - W_v_hat is -W_v_tilde by the paper's definition. The wrong sign is used in choosing (32), see "
                  "32, so it is not cosmetic.")
def e_v_rate_closed() -> Goal:
    """With the sign as printed."""
    return _closed_e_v(1)


def _learning(learn: int) -> Goal:
    """The rate of V_2 without V_1, theta_tilde and leakage, along the closed loop."""
    loop = tracking_loop(learn=learn)
    along = {e_v: loop[e_v], w_v: sp.expand(loop[w_v].xreplace({sigma_v: sp.Integer(0)}))}
    stated = -k_5 * e_v**2 + e_v * (theta - in_errors(robust_2))
    return Goal((equal(D(M / (2 * chi) * e_v**2 + V_v), stated),), flow=along)


@paper.claim("32", "(32) cancels the weights in the rate of V_2", "identity",
             r"\dot{\hat W}_v = -\Gamma_vh_v(z_2)e_v \Rightarrow \frac{d}{dt}\left(\tfrac{M}{2\chi}e_v^2 + "
             r"\tfrac12\tilde W_v^T\Gamma_v^{-1}\tilde W_v\right) = -k_5e_v^2 + e_v(\theta - D_2)", "refuted",
             premises=("33",), scope=EVERY_NETWORK, correction=lambda: _learning(1),
             corrected_statement=r"\dot{\hat W}_v = +\Gamma_vh_v(z_2)e_v \Rightarrow \frac{d}{dt}(\ldots) = "
                                 r"-k_5e_v^2 + e_v(\theta - D_2)",
             note="What (53) needs, along the loop itself, without the leakage. With (33) as printed the terms cancel on "
                  "paper; in the loop the law doubles the cross term: it learns -f_v instead of f_v, see 32.loop.")
def tracking_weights_cancel() -> Goal:
    """With the law as printed."""
    return _learning(-1)


def _jacobian(leak: int, learn: int) -> sp.Matrix:
    """Of (33), (32) in (e_v, W_v_tilde) for one neuron, without the robust term."""
    loop = {state: one_neuron(rate) for state, rate in tracking_loop(leak, learn).items()}
    e_v_rate = loop[e_v].xreplace({theta_tilde: -theta})  # theta_hat = 0
    states, rates = (e_v, one_neuron(w_v)), (e_v_rate, loop[w_v])
    return sp.Matrix([[sp.expand(sp.diff(rate, state)) for state in states] for rate in rates])


def _settles(leak: int, learn: int) -> Goal:
    matrix = _jacobian(leak, learn)
    return Goal((greater(matrix.det(), 0), less(matrix.trace(), 0)))


@paper.claim("32.loop", "e_v and the weights settle", "inequality",
             r"\det J > 0,\ \mathrm{tr}\,J < 0,\quad J = \partial(\dot e_v, \dot w)/\partial(e_v, w)", "refuted",
             premises=("31",), scope="one neuron, without the robust term", correction=lambda: _settles(-1, 1),
             corrected_statement=r"\dot{\hat W}_v = \Gamma_v(+h_ve_v - \sigma_v(\hat W_v - W_{v0})): \det J > 0,\ "
                                 r"\mathrm{tr}\,J < 0",
             note="The paper prints no such condition; it is what convergence of (e_v, W_v_tilde) needs. With (32) as "
                  "printed the determinant is negative for all gains and hidden functions: a saddle.")
def tracking_pair_settles() -> Goal:
    """With the laws as printed."""
    return _settles(1, -1)


leakage_claim("32.leakage", "the weights of the tracking network", over_neurons((W_v_hat - W_v_0) ** 2),
              r"e_v = 0,\ \dot{\hat W}_v = \Gamma_v\sigma_v(\hat W_v - W_{v0}) \Rightarrow "
              r"\frac{d}{dt}\|\hat W_v - W_{v0}\|^2 \le 0",
              r"\dot{\hat W}_v = \Gamma_v(h_v(z_2)e_v - \sigma_v(\hat W_v - W_{v0}))")


@paper.claim("34", "(34) and (35) cancel the estimate of theta in the rate of V_2", "identity",
             r"-e_vD_2 + \tfrac1{\alpha_2}\tilde\theta\cdot\alpha_2\gamma(e_v)e_v = -e_v\gamma(e_v)\theta", "proved",
             note="Without the leakage, for which see 35, and for a constant theta, see 52.theta.")
def tracking_robust_term_cancels() -> Goal:
    """D of the part of V_2 with theta_tilde, without leakage."""
    rate = tracking_loop()[theta_tilde].xreplace({beta_2: sp.Integer(0)})
    return Goal((equal(-e_v * in_errors(robust_2) + D(theta_tilde**2 / (2 * alpha_2)), -e_v * gamma_2(e_v) * theta),),
                flow={theta_tilde: rate})


leakage_claim("35", "the estimate of theta", (theta_hat - theta_0) ** 2,
              r"e_v = 0,\ \dot{\hat\theta} = \alpha_2\beta_2(\hat\theta - \theta_0) \Rightarrow "
              r"\frac{d}{dt}(\hat\theta - \theta_0)^2 \le 0",
              r"\dot{\hat\theta} = \alpha_2(\gamma(e_v)e_v - \beta_2(\hat\theta - \theta_0))")
