"""mao2018, section III: the controller (35)-(37) and the rate (38) of V_2."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, differ, equal

from ..active_mode import F_35, chi_d, d, eta, lambda_0, m, nu_healthy, rho_0, rho_hat, wanted, zeta
from ..error_dynamics import ACTIVE_MODE, disturbed, filippov, healthy_loop, of_mode, over_modes
from ..felt_force import driven_by, felt_force, m_t, of_every_mode, summed
from ..lyapunov import V_healthy, decay
from ..modes import (
    EVERY_MODE,
    V_25,
    chi_di,
    chi_mi,
    d_i,
    estimates,
    idle,
    lambda_i,
    m_i,
    one_region,
    rho_hat_i,
    rho_i,
    rho_law_i,
    size,
    train,
    wanted_i,
    zeta_i,
)
from ..paper import paper
from ..plant import r_2, s, z_2


@paper.claim("35", "What the controller leaves of (34)", "identity",
             r"z_2m_i(F - \rho_i\zeta_i + \rho_i\bar d_i\chi_{\bar di} + \rho_i\eta + \rho_ir_2z_2) = -z_2m_i\tilde\rho_i"
             r"(\zeta_i - \eta - r_2z_2) + z_2m_i\nu_{di}\chi_{\bar di} + z_2\bar d_i\chi_{\bar di}", "proved",
             premises=("34",), origin="implied", scope=ACTIVE_MODE,
             reading="(35) put into (34): an estimation error and the disturbance remain.")
def controller_in_rate() -> Goal:
    """(35) in the bracket of (34)."""
    inner = F_35 - zeta / m + d * chi_d / m + eta / m + r_2 * z_2 / m
    left = -z_2 * m * (1 / m - rho_hat) * wanted + z_2 * m * nu_healthy * chi_d + z_2 * d * chi_d
    return Goal((equal(z_2 * m * inner, left),), (at_most(chi_d, 1),))


chi_one_mode, F_one_mode, F_others = sp.symbols("chi_m F_i F_others", real=True)
F_i = of_mode("F")
F_whole = sp.Symbol("F_sum", real=True)


@paper.claim("35.mode", "While a mode lasts the controller is that mode's part", "identity",
             r"\chi_{mi}(t)F(t) = \chi_{mi}(t)F_i(t)\ \text{for}\ F(t) = \sum_{i=1}^{l}\chi_{mi}(t)F_i(t)", "proved",
             origin="implied", scope="any one of every number of modes",
             reading="F is the part of mode i with its indicator and the parts of all others with theirs; chi_mi is 0 or 1, and "
                     "where it is 1 the others' are 0.")
def part_of_mode() -> Goal:
    """chi^2 = chi, and chi times the others' parts is zero."""
    whole = chi_one_mode * F_one_mode + F_others
    return Goal((equal(chi_one_mode * whole, chi_one_mode * F_one_mode),),
                (equal(chi_one_mode**2, chi_one_mode), equal(chi_one_mode * F_others, 0)))


@paper.claim("35.modes", "Each mode sees its own part of the controller", "identity",
             r"m(t)F(t) = \sum_{i=1}^{l}m_i\chi_{mi}(t)F_i(t)\ \text{for}\ F(t) = \sum_{i=1}^{l}\chi_{mi}(t)F_i(t)", "proved",
             origin="implied", premises=("35.mode",), scope=EVERY_MODE,
             reading="m(t) is (9). In m F two sums over the modes are multiplied; 35.mode, times m_i, is summed over the modes.")
def own_controller() -> Goal:
    """Sum of m_i times (chi_mi F - chi_mi F_i), which is zero in every mode."""
    return Goal((equal(over_modes(m_i * chi_mi) * F_whole, over_modes(m_i * chi_mi * F_i)),),
                (equal(over_modes(m_i * (chi_mi * F_whole - chi_mi * F_i)), 0),))


@paper.claim("35.law", "The controller for healthy motors", "identity",
             r"F(t) = \sum_{i=1}^{l}\chi_{mi}(t)\bigg(\nu_{di}(t)\chi_{\bar{d}i}(t) + \hat{\rho}_i(t)\zeta_i(t) - \hat{\rho}_i(t)"
             r"\eta(t) - \hat{\rho}_i(t)r_2z_2(t)\bigg)", "proved", rests_on=(), scope=EVERY_MODE,
             where={"F(t)": felt_force, r"\nu_{di}(t)": of_every_mode(nu_healthy)},
             reading="F is the force of the simulated train, read back from its acceleration by (8).")
def healthy_law() -> Goal:
    """D(x_2) of (8) with the law that is simulated."""
    stated = over_modes(chi_mi * (of_every_mode(nu_healthy) * chi_di + rho_hat_i * zeta_i - rho_hat_i * eta - rho_hat_i * r_2 * z_2))
    return Goal((equal(felt_force, stated),), (differ(m_t, 0),), driven_by(summed(F_35)))


epsilon_0 = sp.Symbol("epsilon_0", real=True)


def _outweighed(nu: sp.Expr, *assume: Relation) -> Goal:
    return Goal((at_most(z_2 * (m * nu + d) * chi_d, 0),),
                (*filippov, *disturbed, at_least(m, rho_0), at_most(chi_d, 1), *assume))


NEEDED = (r"\Rightarrow z_2(m_i\nu_{di} + \bar{d}_i)\chi_{\bar{d}i} \le 0\ \text{for}\ m_i \ge \rho_m^0,\ "
          r"\lambda_i^0 \ge d_i^0 \ge |\bar{d}_i|")


@paper.claim("36", "nu_d outweighs the disturbance, as the extracted text has it", "inequality",
             r"\nu_{di}(t) = -\frac{1}{\lambda_i^0}\epsilon_i^0\operatorname{sgn}[z_2(t)]", "refuted", premises=("10",),
             glyph="36.glyph", scope=ACTIVE_MODE,
             reading="Decided as what nu_di is designed for: that z_2 (m_i nu_di + d_i) is never positive.",
             note="epsilon_i^0 is defined nowhere, so that nothing makes it large enough. The text below (36) defines "
                  "rho_m^0 and lambda_i^0 instead, the first of which (36) lacks: the extracted line is garbled.")
def disturbance_garbled() -> Goal:
    """For an epsilon of which nothing is known."""
    return _outweighed(-epsilon_0 * s / lambda_0)


@paper.claim("36.glyph", "nu_d outweighs the disturbance, read as (38), (43) and (50) have it", "inequality",
             r"\nu_{di} = -\frac{1}{\rho_m^0}\lambda_i^0\operatorname{sgn}[z_2] " + NEEDED, "proved", premises=("10",),
             origin="ours", glyph="36", scope=ACTIVE_MODE)
def disturbance_outweighed() -> Goal:
    """For every value of Filippov's sign at z_2 = 0."""
    return _outweighed(nu_healthy)


rate_37 = sp.Symbol("rho_hat_rate", real=True)
Gamma_one = sp.Symbol("Gamma", positive=True)
chi_one, zeta_one = sp.Symbol("chi", nonnegative=True), sp.Symbol("zeta", real=True)


@paper.claim("37", "The law of rho_hat cancels its error in the rate of V_2", "identity",
             r"\dot{\hat{\rho}}_i(t) = -\Gamma_{mi}z_2(t)(\zeta_i(t) - \eta(t) - r_2z_2(t))\chi_{mi}(t)", "proved",
             premises=("34", "35"), scope="each mode, healthy motors",
             where={r"\dot{\hat{\rho}}_i(t)": rate_37, r"\Gamma_{mi}": Gamma_one, r"\zeta_i(t)": zeta_one,
                    r"\chi_{mi}(t)": chi_one},
             note="Decided as what the paper chooses it for: the rate for which the coefficient of the estimation error "
                  "in the rate of V_2 is zero, and no other. With failures rho_i is 1/(m_i k_nu) and the weight in V_2 "
                  "no longer fits: see 37.failures.")
def rho_law() -> Goal:
    """The coefficient of rho_tilde: -z_2 m_i chi_mi (zeta_i - eta - r_2 z_2) from (35), and that of its square in V_2."""
    inner = zeta_one - eta - r_2 * z_2
    return Goal((equal(rate_37, -Gamma_one * z_2 * inner * chi_one),),
                (equal(-z_2 * m * chi_one * inner - m / Gamma_one * rate_37, 0),))


weights = sp.exp(sp.Symbol("log_rho_m", real=True))  # rho_m^0 > 0
closed_loop = {**train(m_i * chi_mi * (-lambda_i * s / weights * chi_di + rho_hat_i * wanted_i)), **estimates,
               rho_hat_i: rho_law_i}


@paper.claim("38.a", "Rate of V_2 in closed loop", "identity",
             r"\dot{V}_2 = -r_1z_1^2(t) - r_2z_2^2(t) + \sum_{i=1}^{l}\left(-\frac{m_i}{\rho_m^0}\lambda_i^0|z_2(t)|"
             r"\chi_{\bar{d}i}(t) + z_2(t)\bar{d}_i(t)\chi_{\bar{d}i}(t)\right)", "proved", premises=("34", "35.modes"),
             rests_on=("34", "35", "36", "37"), scope=EVERY_MODE, where={"V_2": V_25(rho_i), r"\rho_m^0": weights},
             reading="(36) is taken as in 36.glyph, which (38) forces.")
def v2_rate_closed() -> Goal:
    """D(V_2) along (7)-(10), (27)-(31), (35)-(37)."""
    stated = decay + over_modes(-m_i / weights * lambda_i * size * chi_di + z_2 * d_i * chi_di)
    return Goal((equal(D(V_25(rho_i)), stated),), (*one_region, idle(m_i * lambda_i * chi_di)), closed_loop)


@paper.claim("38", "V_2 does not increase: the whole argument in one certificate", "inequality",
             r"\dot{V}_2 \leq -r_1z_1^2(t) - r_2z_2^2(t)", "proved", premises=("8.modes", "25.idle"),
             rests_on=("38.a", "10"), scope=ACTIVE_MODE, where={"V_2": V_healthy},
             note="The last line of (38), for m_i >= rho_m^0 and lambda_i^0 >= d_i^0 >= |d_i|. The checker derives V_2' "
                  "from (25), the plant and the laws by itself, and re-checks the bound for every value that Filippov's "
                  "sign may take at z_2 = 0.")
def v2_bound() -> Goal:
    """D(V_2) along the closed loop against -r_1 z_1^2 - r_2 z_2^2."""
    return Goal((at_most(D(V_healthy), decay),), (*filippov, *disturbed, at_least(m, rho_0)), healthy_loop)
