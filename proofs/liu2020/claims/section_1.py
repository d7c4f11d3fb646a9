"""Section 1: what the paper says that it contributes."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, at_least, equal

from ..laws import k_5
from ..paper import paper

speed_seen, speed_other, centre, weight, others, error_seen, robust_seen = sp.symbols(
    "sdot_seen sdot_other c_speed W_hat_one distance e_v_seen D_2_seen", real=True)
spread = sp.Symbol("sigma_h", positive=True)


def network_of(speed: sp.Expr) -> sp.Expr:
    """W_v_hat h_v(z_2) of (29), (30), one neuron, of its inputs the speed alone written out."""
    return weight * sp.exp(-((speed - centre) ** 2 + others) / spread**2)


@paper.claim("contribution2", "The tracking control does not require the running speed", "identity",
             r"\text{(2) The tracking control algorithm does not require the running speed of an HST}", "refuted",
             severity="result", match="words", rests_on=("12", "19.measured", "30.measured"),
             reading="With the position, the estimates and the reference given, the command (31) is given whatever the "
                     "speed is.",
             note="The command takes h_v(z_2), and z_2 contains s', the train's own speed; the update laws (19) to (21) "
                  "take v_hat - v (19.measured). Only the damping of (12), read as in 12.glyph, can do without.")
def command_without_speed() -> Goal:
    """The command (31) at two speeds, all else the same."""
    return Goal((equal(network_of(speed_seen) + k_5 * error_seen + robust_seen,
                       network_of(speed_other) + k_5 * error_seen + robust_seen),), (at_least(others, 0),))
