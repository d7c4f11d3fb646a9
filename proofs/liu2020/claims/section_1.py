"""Section 1: what the paper says that it contributes."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, equal

from ..laws import delta_hat, gamma_1, robust_1, v_hat
from ..paper import paper
from ..plant import s, v

speed_seen, speed_other, centre, weight, others, v_other = sp.symbols(
    "sdot_seen sdot_other c_speed W_hat_one distance v_other", real=True)
spread = sp.Symbol("sigma_h", positive=True)


def network_of(speed: sp.Expr) -> sp.Expr:
    """W_v_hat h_v(z_2) of (29), (30), one neuron, of its inputs the speed alone written out."""
    return weight * sp.exp(-((speed - centre) ** 2 + others) / spread**2)


@paper.claim("contribution2", "The tracking control does not require the running speed", "implication",
             r"\text{(2) The tracking control algorithm does not require the running speed of an HST}", "gap",
             severity="result", match="words", rests_on=("19.measured",),
             reading="With the position measured at the instant and the estimates given, what the observer adds by (20) is "
                     "given whatever the speed is.",
             note="D_1, and with it the observer and the command that is made of its estimates, takes v_hat - v "
                  "(19.measured): it needs the rate of the measured position. The damping of (12), read as in 12.glyph, can do "
                  "without, and so can the network (30), read as in 30.measured.glyph.")
def robust_term_without_speed() -> Goal:
    """D_1 of (20) at two speeds, all else the same."""
    return Goal((equal(robust_1, robust_1.xreplace({v: v_other})),))


@paper.claim("contribution2.mended", "The tracking control needs no measured speed where the measured position is differentiated", "identity",
             r"D_1 = -\gamma(\hat v - \tfrac{ds}{dt})\hat\delta", "proved", origin="ours", mends="contribution2",
             severity="result", rests_on=(),
             note="ds/dt, the rate of the measured position, is the running speed: it is needed, but no sensor of it.")
def robust_term_of_rate() -> Goal:
    """D_1 of (20) with the rate of the position for the speed."""
    return Goal((equal(robust_1, -gamma_1(v_hat - D(s)) * delta_hat),), flow={s: v})
