"""Section 1: what the paper says that it contributes."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, equal

from ..laws import robust_1
from ..paper import paper
from ..plant import v

speed_seen, speed_other, centre, weight, others, v_other = sp.symbols(
    "sdot_seen sdot_other c_speed W_hat_one distance v_other", real=True)
spread = sp.Symbol("sigma_h", positive=True)


def network_of(speed: sp.Expr) -> sp.Expr:
    """W_v_hat h_v(z_2) of (29), (30), one neuron, of its inputs the speed alone written out."""
    return weight * sp.exp(-((speed - centre) ** 2 + others) / spread**2)


@paper.claim("contribution2", "The tracking control does not require the running speed", "identity",
             r"\text{(2) The tracking control algorithm does not require the running speed of an HST}", "refuted",
             severity="result", match="words", rests_on=("19.measured",),
             reading="With the measured position and the estimates given, what the observer adds by (20) is given whatever "
                     "the speed is.",
             note="D_1, and with it the observer and the command that is made of its estimates, takes v_hat - v "
                  "(19.measured). The damping of (12), read as in 12.glyph, can do without, and so can the network (30), "
                  "read as in 30.measured.glyph.")
def robust_term_without_speed() -> Goal:
    """D_1 of (20) at two speeds, all else the same."""
    return Goal((equal(robust_1, robust_1.xreplace({v: v_other})),))
