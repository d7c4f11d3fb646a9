"""Section 4: the output feedback controller and its laws, (28)-(35)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater, less

from ..error_dynamics import (
    W_v_star,
    eps_v,
    f_v_by_network,
    in_errors,
    one_neuron,
    theta,
    theta_tilde,
    tracking_loop,
    w_v,
)
from ..exact_motions import tracking_motion
from ..goal_forms import small_hidden, within
from ..laws import (
    D_2,
    W_v_0,
    W_v_hat,
    alpha_2,
    beta_2,
    command,
    e_v,
    f_hat,
    gamma_2,
    h_v,
    k_1,
    k_5,
    robust_2,
    s_error,
    s_hat,
    s_hat_rate,
    sigma_v,
    theta_0,
    theta_hat,
    v_hat,
)
from ..lyapunov import V_v
from ..notation import ERRORS
from ..paper import EVERY_NETWORK, paper
from ..plant import M, chi, d, u
from .section_1 import network_of, others, speed_other, speed_seen
from .section_3_eq_11_to_18 import GAUSSIAN
from .section_3_eq_19_to_21 import leakage_claim
from .section_4_eq_22_to_27 import f_v_inside, u_other

paper.axiom("28", "Universal approximation of f_v by the network",
            r"f_v = W_v^{*T}h_v(z_2) + \varepsilon_v(z_2),\quad |\varepsilon_v(z_2)| \le \varepsilon_{v,N}",
            "Park and Sandberg 1991, for a continuous function on a compact set",
            hypotheses=("28.function", "28.bounded", "15.inside"))
paper.definition("28.split", "The error of the network is what it leaves of f_v",
                 r"f_v = W_v^{*T}h_v(z_2) + \varepsilon_v(z_2)",
                 note="True of any weights, eps_v being defined by it; that it is small is the second half of (28).")


@paper.claim("28.function", "f_v is a function of z_2", "implication",
             r"z_2 = z_2' \Rightarrow f_v = f_v',\quad z_2 = [s, \dot s, \hat v, s_d, \dot s_d, \ddot s_d]", "gap",
             origin="implied", premises=("27.input",), rests_on=("26.input",),
             note="f_v depends on u, on the weights W_f_hat, on s_hat, delta_hat and d(t), none of which is in z_2. Decided "
                  "for u, with the first network at rest (W_f_hat = 0). u contains W_v_hat, so the function that the "
                  "network is to learn changes as it learns.")
def uncertainty_depends_on_z2() -> Goal:
    """f_v at two inputs, everything else the same."""
    untrained = f_v_inside.xreplace({f_hat: sp.Integer(0)})
    return Goal((equal(untrained, untrained.xreplace({u: u_other})),))


rest_of_f_v, rest_max, weight_error, weight_max, output, f_v_max = sp.symbols(
    "f_v_rest f_rest_max W_f_error W_N h_one f_v_max", real=True)


@paper.claim("28.bounded", "f_v is bounded by Assumptions 2 and 3", "implication",
             r"\text{According to Assumptions 2 and 3, the nonlinear function}\ f_v\ \text{is unknown and bounded}", "gap",
             match="words", rests_on=("26.input", "assumption2", "assumption3"), premises=("27.glyph",),
             reading="All terms of (27) but the weights' being bounded, and the hidden output, f_v is at most that bound "
                     "plus (M/chi)|W_N|, the bound of the ideal weight.",
             note="f_v contains W_f_tilde^T h_f: the estimated weights, which no assumption bounds and Theorem 1 has yet "
                  "to bound, and the input (27.input), which no assumption bounds either.")
def uncertainty_bounded() -> Goal:
    """rest - (M/chi) W_f_tilde h, one neuron."""
    return Goal((at_most(rest_of_f_v - M / chi * weight_error * output, rest_max + M / chi * weight_max),),
                (*within(rest_of_f_v, rest_max), at_least(output, 0), at_most(output, 1), at_least(weight_max, 0)))


paper.definition("29", "The hidden functions of the second network", GAUSSIAN % ("h_{v,j}", "z_2", "c_{v,j}", r"\sigma_{v,j}"),
                 note="j runs to m here, though this network has q neurons.")


@paper.claim("30.measured", "The network (30) needs no speed", "identity", r"\hat f_v = \hat W_v^Th_v(z_2)", "refuted",
             glyph="30.measured.glyph", rests_on=(),
             reading="It is introduced because 'the velocity vector is unknown': with all but the speed given, f_v_hat is "
                     "given whatever the speed is.",
             note="The z_2 of (28) has s' in it, so that the command (31) would need the speed of the train. Hats are lost in "
                  "many places of the extracted text; with the rate of s_hat in its place it would not, see 30.measured.glyph.")
def network_without_speed() -> Goal:
    """W_v_hat h_v(z_2) at two speeds, one neuron."""
    return Goal((equal(network_of(speed_seen), network_of(speed_other)),), (at_least(others, 0),))


@paper.claim("30.measured.glyph", "The network (30) with the rate of s_hat in z_2 needs no speed", "identity",
             r"z_2 = [s, \dot{\hat s}, \hat v, s_d, \dot s_d, \ddot s_d],\ \dot{\hat s} = \hat v - k_1\tilde s", "proved",
             origin="ours", glyph="30.measured", rests_on=(),
             note="Its inputs are then the measured position, the estimates and the reference.")
def network_of_estimates() -> Goal:
    """W_v_hat h_v(z_2) along the observer, by its own states and the measured position."""
    seen = v_hat - k_1 * s_error
    return Goal((equal(network_of(D(s_hat)), network_of(seen)),), (at_least(others, 0),), {s_hat: s_hat_rate})


LAW_32 = r"\dot{\hat W}_v = \Gamma_v(-h(z_2)e_v + \sigma_v(\hat W_v - W_{v0}))"
TURNED_32 = r"\dot{\hat W}_v = \Gamma_v(h_v(z_2)e_v - \sigma_v(\hat W_v - W_{v0}))"
LAW_35 = r"\dot{\hat\theta} = \alpha_2(\gamma(e_v)e_v + \beta_2(\hat\theta - \theta_0))"

paper.definition("31", "The control law", r"u(t) = \hat W_v^Th_v(z_2) + k_5e_v + D_2")
paper.definition("32", "The law of the weights of the controller", LAW_32, reading="h lacks its index v.",
                 note="What its terms do is 32.cancels and 32.leakage.")
paper.definition("34", "The robust term of the controller", r"D_2 = \gamma(e_v)\hat\theta")
paper.definition("35", "The law of the estimate of theta", LAW_35, note="What its last term does is 35.leakage.",
                 reading="The accent over the last theta is read as the index 0.")


PRINTED_33 = (r"\frac{M}{\chi}\dot e_v = -k_5e_v + \tilde W_v^Th_v(z_2) + \varepsilon_v(z_2) - \frac{M}{\chi}d(t) - D_2")
MENDED_33 = (r"\frac{M}{\chi}\dot e_v = -k_5e_v - \tilde W_v^Th_v(z_2) + \varepsilon_v(z_2) - \frac{M}{\chi}d(t) - D_2")
ESTIMATED = {r"\tilde W_v": W_v_hat - W_v_star}


def _closed_e_v(sign: int, h_limited: bool = False) -> Goal:
    """M/chi times D(e_v) along (26), (28), (31), the sign of the weights' term free."""
    stated = -k_5 * e_v + sign * over_neurons((W_v_hat - W_v_star) * h_v) + eps_v - M / chi * d - D_2
    return Goal((equal(M / chi * D(e_v), stated),), small_hidden(h_v) if h_limited else (),
                flow={e_v: chi / M * (f_v_by_network - M / chi * d - command)})


@paper.claim("33", "Rate of e_v in closed loop", "identity", PRINTED_33, "refuted", premises=("26", "28.split"),
             rests_on=("26", "28.split", "31"), scope=EVERY_NETWORK, where=ESTIMATED, correction=lambda: _closed_e_v(-1),
             corrected_statement=MENDED_33,
             note="(28) and (31) leave (W_v* - W_v_hat)^T h_v, which is -W_v_tilde^T h_v by the definition W_v_tilde = "
                  "W_v_hat - W_v* in the next line. The wrong sign is used in choosing (32), see 32.cancels, so it is not "
                  "cosmetic.")
def e_v_rate_closed() -> Goal:
    """With the sign as printed."""
    return _closed_e_v(1, h_limited=True)


@paper.claim("33.mended", "Rate of e_v in closed loop, the weights' sign turned", "identity", MENDED_33, "proved",
             origin="ours", mends="33", premises=("26", "28.split"), rests_on=("26", "28.split"), scope=EVERY_NETWORK,
             where=ESTIMATED)
def e_v_rate_mended() -> Goal:
    """With the opposite sign."""
    return _closed_e_v(-1)


def _learning(learn: int, h_limited: bool = False) -> Goal:
    """The rate of V_2 without V_1, theta_tilde and leakage, along the closed loop."""
    loop = tracking_loop(learn=learn)
    along = {e_v: loop[e_v], w_v: sp.expand(loop[w_v].xreplace({sigma_v: sp.Integer(0)}))}
    stated = -k_5 * e_v**2 + e_v * (theta - in_errors(robust_2))
    return Goal((equal(D(M / (2 * chi) * e_v**2 + V_v), stated),), small_hidden(h_v) if h_limited else (), flow=along)


CANCELLED = (r"\Rightarrow \frac{d}{dt}\left(\tfrac{M}{2\chi}e_v^2 + \tfrac12\tilde W_v^T\Gamma_v^{-1}\tilde W_v\right) = "
             r"-k_5e_v^2 + e_v(\theta - D_2)")
CANCELS = ERRORS | {"D_2": in_errors(robust_2)}


@paper.claim("32.cancels", "The first term of (32) cancels the weights in the rate of V_2", "identity", LAW_32, "refuted",
             premises=("33.mended",), rests_on=(), scope=EVERY_NETWORK,
             where=CANCELS, correction=lambda: _learning(1),
             corrected_statement=TURNED_32 + r",\quad \sigma_v = 0 " + CANCELLED,
             reading="What (53) needs of it, along the loop itself and without the leakage: the rate of the squares of e_v and "
                     "W_v_tilde in V_2 is then -k_5 e_v^2 + e_v (theta - D_2).",
             note="The conditions are those of the corrected law without the leakage; the values of the finding are along the printed "
                  "one, w_v' = -e_v g_v h_v, and (33) corrected: the rate of (M/(2 chi)) e_v^2 + W_v_tilde^T Gamma_v^-1 W_v_tilde/2 "
                  "against -k_5 e_v^2 + e_v (theta - D_2). With (33) as printed the terms cancel on paper; in the loop the law doubles the cross term, and the weights "
                  "diverge: a saddle, see 32.loop. For its last term, and (32) with both signs turned, see 32.leakage.")
def tracking_weights_cancel() -> Goal:
    """With the law as printed."""
    return _learning(-1, h_limited=True)


@paper.claim("32.turned", "The first term of (32), its sign turned, cancels the weights", "identity",
             r"\dot{\hat W}_v = +\Gamma_vh_v(z_2)e_v " + CANCELLED, "proved", origin="ours", mends="32.cancels",
             premises=("33.mended",), rests_on=(), scope=EVERY_NETWORK, where=CANCELS)
def turned_weights_cancel() -> Goal:
    """With plus before h_v e_v."""
    return _learning(1)


def _jacobian(leak: int, learn: int) -> sp.Matrix:
    """Of (33), (32) in (e_v, W_v_tilde) for one neuron, without the robust term."""
    loop = {state: one_neuron(rate) for state, rate in tracking_loop(leak, learn).items()}
    e_v_rate = loop[e_v].xreplace({theta_tilde: -theta})  # theta_hat = 0
    states, rates = (e_v, one_neuron(w_v)), (e_v_rate, loop[w_v])
    return sp.Matrix([[sp.expand(sp.diff(rate, state)) for state in states] for rate in rates])


def _settles(leak: int, learn: int) -> Goal:
    matrix = _jacobian(leak, learn)
    gaussian = (greater(one_neuron(h_v), 0), at_most(one_neuron(h_v), 1))
    return Goal((greater(matrix.det(), 0), less(matrix.trace(), 0)), gaussian)


@paper.claim("32.loop", "e_v and the weights settle", "inequality",
             r"\det J > 0,\ \mathrm{tr}\,J < 0,\quad J = \partial(\dot e_v, \dot w)/\partial(e_v, w)", "refuted",
             origin="ours", premises=("33.mended",), rests_on=(), scope="one neuron, without the robust term",
             correction=lambda: _settles(-1, 1),
             corrected_statement=r"\dot{\hat W}_v = \Gamma_v(+h_ve_v - \sigma_v(\hat W_v - W_{v0})): \det J > 0,\ "
                                 r"\mathrm{tr}\,J < 0",
             note="What convergence of (e_v, W_v_tilde) needs. With (32) as printed the determinant is negative for all "
                  "gains and hidden functions: a saddle.")
def tracking_pair_settles() -> Goal:
    """With the laws as printed."""
    return _settles(1, -1)


leakage_claim("32", "the weights of the tracking network", LAW_32, TURNED_32,
              r"e_v = 0 \Rightarrow \frac{d}{dt}(\hat W_v - W_{v0})_i^2 \le 0", W_v_hat, W_v_0, "4")


@paper.claim("34.cancels", "(34) and the first term of (35) cancel the estimate of theta in the rate of V_2", "identity",
             r"-e_vD_2 + \tfrac1{\alpha_2}\tilde\theta\cdot\alpha_2\gamma(e_v)e_v = -e_v\gamma(e_v)\theta", "proved",
             origin="implied", where={"D_2": in_errors(robust_2)},
             note="Without the leakage, for which see 35.leakage, and for a constant theta, see 52.theta.")
def tracking_robust_term_cancels() -> Goal:
    """D of the part of V_2 with theta_tilde, without leakage."""
    rate = tracking_loop()[theta_tilde].xreplace({beta_2: sp.Integer(0)})
    return Goal((equal(-e_v * in_errors(robust_2) + D(theta_tilde**2 / (2 * alpha_2)), -e_v * gamma_2(e_v) * theta),),
                flow={theta_tilde: rate})


leakage_claim("35", "the estimate of theta", LAW_35,
              r"\dot{\hat\theta} = \alpha_2(\gamma(e_v)e_v - \beta_2(\hat\theta - \theta_0))",
              r"e_v = 0 \Rightarrow \frac{d}{dt}(\hat\theta - \theta_0)^2 \le 0", theta_hat, theta_0, "4")


@paper.claim("remark3", "Remark 3: the tracking errors can be set to approximately zero", "limit",
             r"\text{the estimation error}\ (e_s, e_v)\ \text{can be set to approximately zero}", "gap",
             severity="result", match="words", rests_on=("theorem2",), scope="one neuron in each network",
             reading="The remark names no gains. Decided is whether its laws alone give a small error: along them as printed "
                     "e_v is in the end at most 30 m/s.",
             note="e_v stays at 30 log(3) = 33 m/s for ever, though both networks are exact and the priors are right, "
                  "while W_v_hat and theta_hat grow against each other. As with Remark 2 this does not refute the remark: "
                  "e_v there is kappa_2 log(3)/2, and kappa_2 is 60 m/s. Whether some gains do for all starts is open; "
                  "theta_hat can diverge for all gains (60.zero).")
def tracking_errors_settle() -> Goal:
    """A motion with a constant e_v."""
    return tracking_motion(at_most(e_v, 30))
