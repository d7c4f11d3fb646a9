"""yang2021, section 2: the train per unit of mass and Assumption 1."""

from __future__ import annotations

from fractions import Fraction

from workbench.proof.claim import D, Goal, equal
from workbench.trains.train import F, a_0, a_star, b_0, b_star, c_0, c_star, f, f_add, m, single_particle, u, v

from ..error_dynamics import plant
from ..laws import x_2
from ..paper import paper
from ..stated_values import stated_davis


@paper.claim("4", "The train per unit of mass", "identity",
             r"\dot x_2 = u + g + f(x),\ u = \tfrac{F}{m},\ g = -\tfrac{g(x_2)}{m},\ f(x) = -\tfrac{f(x_1,x_2,t)}{m}",
             "proved")
def newton_per_mass() -> Goal:
    """(1) with (2), divided by m, is (4)."""
    newton = single_particle().rates[v].xreplace({v: x_2})
    per_mass = plant.rates[x_2].xreplace({
        u: F / m, f: -f_add / m, a_star: a_0 / m, b_star: b_0 / m, c_star: c_0 / m})
    return Goal((equal(newton, per_mass),))


@paper.claim("A1", "Assumption 1: (4) is input-to-state stable, so the origin is an equilibrium", "condition",
             r"u = 0,\ f = 0:\quad \dot x_2 = 0\ \text{at}\ x_1 = x_2 = 0", "violated",
             at={**stated_davis, x_2: Fraction(0), u: Fraction(0), f: Fraction(0)},
             note="Input-to-state stability needs the origin to be an equilibrium without input. By (2) the "
                  "resistance does not vanish at standstill, so the train of (4) starts to roll backwards at "
                  "0.3 m/s^2. The proof of Theorem 1 does not use Assumption 1.")
def origin_is_equilibrium() -> Goal:
    """The origin is an equilibrium of (4) without input."""
    return Goal((equal(D(x_2), 0),), flow={x_2: plant.rates[x_2]})
