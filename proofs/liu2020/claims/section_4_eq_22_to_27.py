"""Section 4: the tracking errors and their rates, (22)-(27)."""

from __future__ import annotations

import sympy as sp

from workbench.model.law import over_neurons
from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..error_dynamics import W_f_star, eps_tilde, t
from ..goal_forms import within
from ..laws import (
    D_1,
    W_f_hat,
    delta_hat,
    e_s_stated,
    e_v_stated,
    f_hat,
    gamma_1,
    h_f,
    k_1,
    k_2,
    k_3,
    k_4,
    robust_1,
    s_d,
    s_error,
    s_error_rate,
    s_hat,
    s_hat_rate,
    sddot_d,
    sdot_d,
    speed_estimate_rate,
    v_error,
    v_hat,
    v_hat_rate,
)
from ..notation import OBSERVED
from ..paper import EVERY_NETWORK, paper
from ..plant import M, acceleration, chi, d, f_d, s, u, v
from .section_3_eq_11_to_18 import DAMPING

# Along (12) with k_3 s_tilde', as (25) has it, and with k_3 v_tilde, as the extracted text prints (12).
along_tracking = {s: v, s_d: sdot_d, sdot_d: sddot_d, s_hat: s_hat_rate, v_hat: v_hat_rate}
along_printed = along_tracking | {v_hat: speed_estimate_rate(v_error)}
TRACKED = OBSERVED | {r"\tilde\varepsilon_f(z_1)": eps_tilde, "e_s": e_s_stated, "e_v": e_v_stated, r"\dot s_d": sdot_d,
                      r"\ddot s_d": sddot_d, r"\dot{\tilde s}": s_error_rate}


paper.definition("22.position", "The tracking error of the estimate", r"e_s = s_d - \hat{s}",
                 note="Of the estimated position, although the position itself is measured.")


@paper.claim("22", "Rate of the tracking error", "identity", r"\dot e_s = \dot s_d - \hat v", "refuted",
             severity="cosmetic", where=TRACKED,
             correction=lambda: Goal((equal(D(e_s_stated), sdot_d - v_hat + k_1 * s_error),), flow=along_tracking),
             corrected_statement=r"\dot e_s = \dot s_d - \hat v + k_1\tilde s",
             note="By (12) s_hat' is v_hat - k_1 s_tilde, not v_hat. Where (23) to (25) are taken with e_v = k_4 e_s + s_d' "
                  "- v_hat they are right, and (25) itself has the missing term; e_s then follows e_v through a filter "
                  "that s_tilde drives too, see 23.filter.")
def tracking_error_rate() -> Goal:
    """D(s_d - s_hat) along (12)."""
    return Goal((equal(D(e_s_stated), sdot_d - v_hat),), flow=along_tracking)


e_s, e_s_0, e_s_rate, drive = sp.symbols("e_s e_s_0 edot_s drive", real=True)
drive_max = sp.Symbol("B", nonnegative=True)


paper.definition("23", "The filtered error", r"e_v = k_4 e_s + \dot{e}_s",
                 note="The laws take the second line of (22) for the rate of e_s, see 22 and 23.filter.")


@paper.claim("23.filter", "The tracking error filters e_v", "identity",
             r"\dot e_s = -k_4e_s + e_v + k_1\tilde s", "proved", origin="ours", where=TRACKED,
             note="(23) read with the second line of (22) for e_s'; the last term is what that line misses.")
def filter_rate() -> Goal:
    """D(e_s) in terms of e_v."""
    return Goal((equal(D(e_s_stated), -k_4 * e_s_stated + e_v_stated + k_1 * s_error),), flow=along_tracking)


@paper.claim("23.bounded", "A bounded e_v and s_tilde give a bounded tracking error", "implication",
             r"|e_v + k_1\tilde s| \le B\ \forall t \Rightarrow e_s(t) \le \tfrac{B}{k_4} + \left(e_s(0) - "
             r"\tfrac{B}{k_4}\right)e^{-k_4t}", "proved", origin="implied", premises=("23.filter",), rests_on=(),
             note="V_2 does not contain e_s, so Theorem 2 needs this step, which the paper does not state. The same holds "
                  "for -e_s. The train's own error is s_d - s = e_s + s_tilde.")
def filter_bound() -> Goal:
    """exp(k_4 t)(e_s - B/k_4) does not increase."""
    level = drive_max / k_4
    return Goal((at_most(e_s, level + (e_s_0 - level) * sp.exp(-k_4 * t)),), (at_least(t, 0),),
                {t: sp.Integer(1), e_s: e_s_rate}, (equal(e_s_rate, -k_4 * e_s + drive), *within(drive, drive_max)),
                {t: sp.Integer(0), e_s: e_s_0},
                decreasing=sp.exp(k_4 * t) * (e_s - level), inputs=(e_s_rate, drive))


@paper.claim("24", "Rate of e_v", "identity",
             r"\dot e_v = k_4(\dot s_d - \dot{\hat s}) + (\dot s_d - \dot{\hat v})", "refuted", glyph="24.glyph",
             rests_on=(), scope=EVERY_NETWORK, where=TRACKED,
             note="With e_v = k_4 e_s + s_d' - v_hat. The extracted text has one dot over s_d in the second bracket, (25) "
                  "has two, see 24.glyph. The text says (21) where it differentiates (23).")
def e_v_rate_one_dot() -> Goal:
    """D(e_v) along (12)."""
    return Goal((equal(D(e_v_stated), k_4 * (sdot_d - D(s_hat)) + (sdot_d - D(v_hat))),), flow=along_tracking)


@paper.claim("24.glyph", "Rate of e_v, with two dots", "identity",
             r"\dot e_v = k_4(\dot s_d - \dot{\hat s}) + (\ddot s_d - \dot{\hat v})", "proved", origin="ours", glyph="24",
             rests_on=(), scope=EVERY_NETWORK, where=TRACKED)
def e_v_rate_open() -> Goal:
    """D(e_v) along (12)."""
    return Goal((equal(D(e_v_stated), k_4 * (sdot_d - D(s_hat)) + (sddot_d - D(v_hat))),), flow=along_tracking)


PRINTED_25 = (r"\frac{M}{\chi}\dot e_v = \frac{k_4M}{\chi}(\dot s_d - (\hat v - k_1\tilde s)) + \frac{M}{\chi}\ddot s_d - "
              r"\frac{M}{\chi}\left(\hat f - f - \frac{\chi}{M}f_d(v) + d(t) - k_2\tilde s - k_3\dot{\tilde s} + D_1\right)"
              r" - u(t)")
rate_25 = (k_4 * M / chi * (sdot_d - (v_hat - k_1 * s_error)) + M / chi * sddot_d
           - M / chi * (f_hat - acceleration - chi / M * f_d + d - k_2 * s_error - k_3 * s_error_rate + D_1) - u)


@paper.claim("25", "Rate of e_v with the observer and the plant", "identity", PRINTED_25, "refuted", glyph="25.glyph",
             premises=("24.glyph",), rests_on=("12", "24.glyph"), scope=EVERY_NETWORK, where=TRACKED,
             note="With (12) as extracted. " + DAMPING + " With k_3 s_tilde' it holds, see 25.glyph.")
def e_v_rate_plant() -> Goal:
    """M/chi times D(e_v) along (12) as printed, f of (12) written out."""
    return Goal((equal(M / chi * D(e_v_stated), rate_25),), flow=along_printed)


@paper.claim("25.glyph", "The same from (12) with k_3 s_tilde'", "identity", PRINTED_25, "proved", origin="ours",
             glyph="25", premises=("12.glyph", "24.glyph"), scope=EVERY_NETWORK, where=TRACKED)
def e_v_rate_plant_by_rate() -> Goal:
    """M/chi times D(e_v) along (12) as (18) and (25) have it."""
    return Goal((equal(M / chi * D(e_v_stated), rate_25),), flow=along_tracking)


f_error = over_neurons((W_f_hat - W_f_star) * h_f) + eps_tilde  # f_hat - f by (15), (17), (18)
eps_tilde_left = over_neurons(W_f_star * h_f) - acceleration  # what (15) leaves to eps_tilde
signal = s_error_rate + k_1 * s_error


def _with_networks(expr: sp.Expr) -> sp.Expr:
    return expr.xreplace({eps_tilde: eps_tilde_left})


@paper.claim("26", "Rate of e_v with the networks", "identity",
             r"\frac{M}{\chi}\dot e_v = \frac{k_4M}{\chi}(\dot s_d - \hat v + k_1\tilde s) - \frac{M}{\chi}d(t) - u(t) - "
             r"\frac{M}{\chi}\left(-\ddot s_d + \tilde W_f^Th_f(\hat z_1) + \tilde\varepsilon_f(z_1) - \frac{\chi}{M}f_d(v)"
             r" - k_2\tilde s - k_3\dot{\tilde s} - \gamma(\dot{\tilde s} + k_1\tilde s)\hat\delta\right)",
             "proved", premises=("18.glyph", "25.glyph"), rests_on=("18.glyph", "20.cancels", "25.glyph"), scope=EVERY_NETWORK,
             where=TRACKED | {r"\tilde\varepsilon_f(z_1)": eps_tilde_left,
                              r"\gamma(\dot{\tilde s} + k_1\tilde s)": gamma_1(signal)},
             reading="The first two lines of (26), from (25) with k_3 s_tilde' in (12); the third line names f_v, see 27.")
def e_v_rate_networks() -> Goal:
    """M/chi times D(e_v) along (12) with (20), f_hat - f by (15), (17)."""
    along = along_tracking | {v_hat: v_hat_rate.xreplace({D_1: robust_1})}
    stated = (k_4 * M / chi * (sdot_d - v_hat + k_1 * s_error) - M / chi * d - u
              - M / chi * (-sddot_d + f_error - chi / M * f_d - k_2 * s_error - k_3 * s_error_rate
                           - gamma_1(signal) * delta_hat))
    return Goal((equal(M / chi * D(e_v_stated), _with_networks(stated)),), flow=along)


def _f_v(robust: sp.Expr, last: sp.Expr) -> sp.Expr:
    """(27) with its robust term and its last term."""
    return (k_4 * M / chi * (sdot_d - v_hat + k_1 * s_error)
            - M / chi * (f_error - chi / M * f_d - k_2 * s_error - k_3 * s_error_rate + robust - last))


f_v_stated = _f_v(robust_1, sddot_d)
f_v_of_25 = rate_25.xreplace({D_1: robust_1}) + M / chi * d + u  # what (26) calls f_v, from (25)
f_v = {"f_v": f_v_of_25}


@paper.claim("27", "f_v as (26) needs it", "identity",
             r"f_v = \frac{k_4M}{\chi}(\dot s_d - \hat v + k_1\tilde s) - \frac{M}{\chi}\left(\tilde W_f^Th_f(\hat z_1) + "
             r"\tilde\varepsilon_f(z_1) - \frac{\chi}{M}f_d(v) - k_2\tilde s - k_3\dot{\tilde s} - "
             r"\gamma(\dot{\tilde s} + k_1\tilde s)\hat\delta - \dot{\tilde s}\right)", "refuted", glyph="27.glyph",
             rests_on=("25.glyph", "26"), premises=("25.glyph",), scope=EVERY_NETWORK,
             where=TRACKED | f_v | {r"\tilde\varepsilon_f(z_1)": eps_tilde_left,
                                    r"\gamma(\dot{\tilde s} + k_1\tilde s)": gamma_1(signal)},
             reading="f_v is what the third line of (26) says; accents are read as (26) has them.",
             note="The last term of the extracted text is s_tilde' where (26) has s_d'' with the same sign, see 27.glyph.")
def uncertainty_extracted() -> Goal:
    """(27) letter by letter against (25)."""
    stated = _f_v(-gamma_1(signal) * delta_hat, s_error_rate)
    return Goal((equal(f_v_of_25, _with_networks(stated)),))


@paper.claim("27.glyph", "f_v with s_d'' for its last term", "identity",
             r"f_v = \frac{k_4M}{\chi}(\dot s_d - \hat v + k_1\tilde s) - \frac{M}{\chi}\left(\tilde W_f^Th_f(\hat z_1) + "
             r"\tilde\varepsilon_f(z_1) - \frac{\chi}{M}f_d(v) - k_2\tilde s - k_3\dot{\tilde s} - "
             r"\gamma(\dot{\tilde s} + k_1\tilde s)\hat\delta - \ddot s_d\right)", "proved", origin="ours", glyph="27",
             premises=("25.glyph",), scope=EVERY_NETWORK,
             where=TRACKED | f_v | {r"\tilde\varepsilon_f(z_1)": eps_tilde_left,
                                    r"\gamma(\dot{\tilde s} + k_1\tilde s)": gamma_1(signal)})
def uncertainty_read() -> Goal:
    """(27) with the term of (26) against (25)."""
    return Goal((equal(f_v_of_25, _with_networks(_f_v(-gamma_1(signal) * delta_hat, sddot_d))),))


f_v_inside = (M / chi * (k_4 * (sdot_d - v_hat + k_1 * s_error) + sddot_d - f_hat + k_2 * s_error + k_3 * s_error_rate
                         - robust_1) + M / chi * d + u)


@paper.claim("27.input", "f_v contains the input", "identity",
             r"f_v = \tfrac{M}{\chi}\left(k_4(\dot s_d - \hat v + k_1\tilde s) + \ddot s_d - \hat f + k_2\tilde s + "
             r"k_3\dot{\tilde s} + \gamma(\tilde v)\hat\delta\right) + \tfrac{M}{\chi}d + u", "proved", origin="ours",
             premises=("27.glyph",), scope=EVERY_NETWORK,
             note="What (27) says: e_v is made of the observer's own states, so f_d, d and -u of (26) come back in f_v and "
                  "cancel. The input moves e_v only through f_hat = W_f_hat^T h_f(z_1_hat), whose input contains u: while "
                  "W_f_hat = 0, not at all.")
def uncertainty_contains_input() -> Goal:
    """(27) with eps_tilde written out."""
    return Goal((equal(_with_networks(f_v_stated), f_v_inside),))


u_other = sp.Symbol("u_other", real=True)
feed_through = v_hat_rate + chi / M * u  # an observer that is told the input, f_hat for the rest of (9)
weight, centre, others = sp.symbols("W_hat_one c_input distance", real=True)
spread = sp.Symbol("sigma_h", positive=True)
network_with_input = weight * sp.exp(-((u - centre) ** 2 + others) / spread**2)  # f_hat of (16), (17), one neuron
MOVED = r"\frac{M}{\chi}(\dot e_v|_u - \dot e_v|_{u'}) = -(u - u')"


def _input_drives(estimate_rate: sp.Expr, *given: Relation) -> Goal:
    """The rates of e_v at two inputs, all else the same, by the observer's rate of v_hat."""
    rate = k_4 * (sdot_d - s_hat_rate) + sddot_d - estimate_rate  # 24.glyph
    driven = M / chi * (rate - rate.xreplace({u: u_other}))
    return Goal((equal(driven, -(u - u_other)),), given)


@paper.claim("26.input", "The input drives e_v", "identity",
             r"\text{at one position, speed, reference, estimates and weights}:\ " + MOVED, "refuted", origin="implied",
             premises=("24.glyph",), rests_on=(), scope="one neuron", correction=lambda: _input_drives(feed_through),
             reading="(28) makes f_v a function of z_2, which u is not in, so that by the last line of (26) e_v falls with u: "
                     "what (31) is designed for. Of f_hat (17) one neuron is written out.",
             corrected_statement=r"\dot{\hat v} = \frac{\chi}{M}u + \hat f - k_2\tilde s - k_3\dot{\tilde s} + D_1,\ "
                                 r"\hat f = \widehat W_f^Th_f(\hat s, \hat v) \Rightarrow " + MOVED,
             note="The last line of (26) is an identity, but its -u is taken back by the +u in f_v (27.input): e_v is made of "
                  "the observer's own states, and (12) has u in f_hat alone. So u moves e_v through the inputs of h_f, times "
                  "learnt weights whose sign and size nothing ensures; while W_f_hat = 0, not at all. |eps_v| <= theta then "
                  "presupposes a bounded u. Remedy: tell the observer the input, f_hat being the estimate of the rest of (9) "
                  "and u no input of it. That needs chi/M, which Assumption 3 takes for unknown.")
def input_drives() -> Goal:
    """By (12) with k_3 s_tilde', as (25) has it, u among the inputs of f_hat."""
    return _input_drives(v_hat_rate.xreplace({f_hat: network_with_input}), at_least(others, 0))


@paper.claim("26.input.mended", "The input drives e_v where the observer is told it", "identity",
             r"\dot{\hat v} = \frac{\chi}{M}u + \hat f - k_2\tilde s - k_3\dot{\tilde s} + D_1,\ "
             r"\hat f = \widehat W_f^Th_f(\hat s, \hat v) \Rightarrow " + MOVED, "proved", origin="ours",
             mends="26.input", premises=("24.glyph",), scope=EVERY_NETWORK,
             reading="u is no input of h_f, so that f_hat is the same at both.")
def input_drives_mended() -> Goal:
    """With (chi/M) u in the rate of v_hat."""
    return _input_drives(feed_through)
