"""Section 6: the stated numbers."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal

from ..goal_forms import within
from ..paper import paper
from ..stated_values import exactly, stated

speed_estimate, position, speed = sp.symbols("vtilde_rms s_rms v_rms", real=True)
# Of Value 10, the last column of Table 3, and of Table 4 under the fast disturbance, its second column.
table_3, table_4 = ([exactly(stated[name][key][column]) for key in ("v_tilde_mps", "position_m", "speed_mps")]
                    for name, column in (("table_3", -1), ("table_4", 1)))


@paper.claim("table4", "Tables 3 and 4 agree for Value 10 under the fast disturbance", "condition",
             r"\mathrm{RMS}(\tilde v) = 0.0378,\ \mathrm{RMS}(s - s_d) = 0.0075,\ \mathrm{RMS}(v - v_d) = 0.0366\ "
             r"\text{within rounding}", "violated",
             at=dict(zip((speed_estimate, position, speed), table_4, strict=True)),
             note="Table 4 prints 378.4073, 75.4789 and 366.1317 times 10^-5, a tenth of what Table 3 prints. Gains and "
                  "energy (1.6696e11) are the same, and the fourth value, of s_tilde, agrees (5.3111e-5 and 0.00005), so the "
                  "unit of Table 4 does not explain it.")
def tables_agree() -> Goal:
    """The three values of Table 4 against those of Table 3."""
    rounding = sp.Rational(1, 20000)
    return Goal(tuple(relation for value, printed in zip((speed_estimate, position, speed), table_3, strict=True)
                      for relation in within(value - sp.Rational(printed), rounding)))
