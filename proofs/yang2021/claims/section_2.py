"""yang2021, section 2: the train, per unit of mass, at rest, and Assumption 1."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal, greater
from workbench.trains.line_resistance import (
    additional_specific_resistance,
    curvature_per_m,
    grade_permille,
    tunnel_n_per_kn,
)
from workbench.trains.train import F, a_0, a_star, b_0, c_0, f, f_add, m, p, single_particle, u, v

from ..error_dynamics import plant
from ..laws import x_1, x_2
from ..paper import paper
from ..stated_values import stated_davis

newton = single_particle()
davis = a_0 + b_0 * v + c_0 * v**2
forces = {"p(t)": p, r"\dot{p}(t)": D(p), "v(t)": v, r"\dot{v}(t)": D(v), "F(t)": F, "f(p(t), v(t), t)": f_add,
          "a_0": a_0, "b_0": b_0, "c_0": c_0}


@paper.claim("1", "The train in forces", "identity",
             r"\dot{p}(t) = v(t),\ m\dot{v}(t) = F(t) - g(v(t)) - f(p(t), v(t), t)", "proved",
             where=forces | {"g(v(t))": davis},
             note="The train that is simulated, in newtons, with (2) put in, is the printed one.")
def train_in_forces() -> Goal:
    """The rates of the single particle that the workbench moves, against the printed line."""
    return Goal((equal(D(p), v), equal(m * D(v), F - davis - f_add)), flow=dict(newton.rates))


@paper.claim("2", "The basic resistance", "identity", r"g(v(t)) = a_0 + b_0v(t) + c_0v^2(t)", "proved",
             where=forces | {"g(v(t))": F - f_add - m * D(v), "v^2(t)": v**2},
             reading="g is what (1) leaves when the other forces of the simulated train are taken away.")
def basic_resistance() -> Goal:
    """F - f - m v' of the simulated train is the Davis equation."""
    return Goal((equal(F - f_add - m * D(v), davis),), flow=dict(newton.rates))


line = additional_specific_resistance()
parts = {grade_permille: sp.Integer(0), curvature_per_m: sp.Integer(0), tunnel_n_per_kn: sp.Integer(0)}


def _alone(part: sp.Symbol) -> sp.Expr:
    return line.xreplace({other: zero for other, zero in parts.items() if other != part})


@paper.claim("3", "The additional resistance is the sum of curve, ramp and tunnel", "identity",
             r"f(p(t), v(t), t) = \omega_r + \omega_i + \omega_s", "proved",
             where={"f(p(t), v(t), t)": line, r"\omega_r": _alone(curvature_per_m), r"\omega_i": _alone(grade_permille),
                    r"\omega_s": _alone(tunnel_n_per_kn)},
             note="Of the formula that the simulation uses, each part being the whole on a line without the two others. The "
                  "paper prints no formula of its own for the parts. Below (1) f also holds the unknown disturbances, which "
                  "(3) leaves out.")
def additional_resistance() -> Goal:
    """Grade, curve and tunnel do not act on each other."""
    return Goal((equal(line, _alone(curvature_per_m) + _alone(grade_permille) + _alone(tunnel_n_per_kn)),))


per_mass = -(a_0 + b_0 * x_2 + c_0 * x_2**2) / m


@paper.claim("4", "The train per unit of mass", "identity", r"\dot{x}_1 = x_2,\ \dot{x}_2 = u + g + f(x)", "proved",
             premises=("1", "2"),
             where={"x_1": x_1, "x_2": x_2, "u": F / m, "g": per_mass, "f(x)": -f_add / m},
             note="With u = F/m, g = -g(x_2)/m and f(x) = -f(x_1, x_2, t)/m, as printed below it.")
def newton_per_mass() -> Goal:
    """(1) with (2), in x_1 and x_2, is (4)."""
    rates = {x_1: newton.rates[p], x_2: newton.rates[v]}
    return Goal((equal(D(x_1), x_2), equal(D(x_2), F / m + per_mass - f_add / m)),
                flow={x: rate.xreplace({v: x_2}) for x, rate in rates.items()})


@paper.claim("4.rest", "A train on which no force acts stays where it stands", "identity",
             r"v = 0,\ u = 0,\ f(x) = 0 \Rightarrow \dot{x}_2 = 0", "refuted", origin="implied", severity="cosmetic", rests_on=("2", "4"),
             reading="Resistances do not move a train: at rest on level track and without an input the train of (4) stays at rest, at the stated a* = 0.3.",
             note="(2) is the resistance of a train that runs. At v = 0, where the run of section 6.1 starts, (4) with (2) begins to roll backwards: there the resistance is whatever "
                  "holds the train, up to a_0. The proof takes (4) as it is. 0.3 m/s^2 is also some ten times what trains have at low speed, 0.01 to 0.03 m/s^2: "
                  "please print the units of a*, b* and c*.")
def resistance_at_rest() -> Goal:
    """The acceleration of (4) at rest, without input and additional resistance."""
    stated = tuple(equal(s, sp.Rational(v.numerator, v.denominator)) for s, v in stated_davis.items())
    return Goal((equal(D(x_2), 0),), (equal(x_2, 0), equal(u, 0), equal(f, 0), *stated), {x_2: plant.rates[x_2]})


rest_bound = sp.Symbol("gamma", positive=True)


@paper.claim("A1", "Assumption 1: the train of (4) is input-to-state stable", "inequality",
             r"\text{The dynamics system of train operation given in Equation (4) is an input-state stable system.}", "refuted",
             match="words", reading="A train that a bounded input holds at rest is, wherever it stands, within a bound gamma that the input alone gives, for some gamma > 0.",
             note="The position is a pure integral of the speed. What is shown for gamma = 1 holds for every gamma: held by u = a* - f the train of (4) rests at x_1 = gamma + 1 (A1.every). "
                  "As Theorem 1 supposes 'all assumptions', it speaks of no train with this one, which should be struck. No proof uses it, in the text or here: with it struck the theorem holds.")
def position_is_bounded() -> Goal:
    """The position of a train at rest in (4)."""
    return Goal((at_most(sp.Abs(x_1), rest_bound),), (equal(x_2, 0), equal(D(x_2), 0)),
                {x_1: plant.rates[x_1], x_2: plant.rates[x_2]})


@paper.claim("A1.every", "A train that rests beyond any bound", "implication",
             r"x_1 = \gamma + 1,\ x_2 = 0,\ u = a^* - f(x) \Rightarrow \dot{x}_1 = \dot{x}_2 = 0,\ |x_1| > \gamma", "proved", origin="ours",
             reading="For every gamma > 0; the input is as large for all of them.")
def rest_beyond_every_bound() -> Goal:
    """Both rates of (4) there, and how far it is."""
    return Goal((equal(D(x_1), 0), equal(D(x_2), 0), greater(sp.Abs(x_1), rest_bound)),
                (equal(x_1, rest_bound + 1), equal(x_2, 0), equal(u, a_star - f)), {x_1: plant.rates[x_1], x_2: plant.rates[x_2]})
