"""mao2018, section V: the speed tracks too, as the text after Theorem 3 has it."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal

from ..active_mode import delta_0, nu_failed, nu_s_sum, rho_k0
from ..error_dynamics import ALL_SIGNALS
from ..paper import paper
from .section_3_theorem_1 import SPEED, speed_tracks_mended
from .section_4_theorem_2 import ONE_MASS
from .section_4_theorem_2_speed import FOLLOWS, GROWS, PRINTED, STAYS, one, speed_stays
from .section_5 import delta, rest_bounds


@paper.claim("theorem3.speed", "Theorem 3: The speed tracks too with unparameterizable failures", "limit", PRINTED % " that", "refuted",
             match="words", severity="result", closed_loop=True, rests_on=("52", "47.signal"), scope=ALL_SIGNALS,
             reading=STAYS, note="False as printed: " + GROWS + "The bound delta_j^0 is 1, delta_j is 0. With a plus in (44) it holds "
             "as theorem3.speed.mended states.")
def speed_with_unparameterizable_failures() -> Goal:
    """With (48)-(50)."""
    return speed_stays(nu_failed + nu_s_sum, *rest_bounds, extra_force=delta,
                        constants={delta: sp.Integer(0), delta_0: one, rho_k0: sp.Integer(15)})


@paper.claim("theorem3.speed.mended", "The speed tracks too with a plus in (44), one mass in all modes, a sum that is known and bounded "
             "x_m', x_m'' and basis signals", "limit",
             r"\dot{\hat\rho}_{k\nu} = +\Gamma_{k\nu}z_2\hat\xi^T\varpi\text{, the sum in (48) over the}\ \bar n\ \text{motors with the largest}\ "
             r"\delta_j^0" + ONE_MASS + FOLLOWS, "proved", origin="ours",
             premises=("theorem3.mended", "theorem2.z2", "theorem1.bounded", "barbalat"), mends="theorem3.speed", severity="result",
             scope=ALL_SIGNALS, reading=SPEED)
def speed_with_unparameterizable_failures_mended() -> Goal:
    """x_2 - x_m' = z_2 - r_1 z_1, and both errors tend to zero, being square integrable with bounded rates."""
    return speed_tracks_mended()
