"""Section II: the model in compact form (7), Assumption 2 and Property 1 (6)."""

from __future__ import annotations

from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal
from workbench.trains.multi_particle import basic_resistance, c_0, c_v, coupler_pull

from ..laws import limited, v_r, v_r_dot
from ..one_car import g, g_high, g_low, h
from ..paper import paper
from ..plant import car_forces, compact_force, compact_parameters
from ..stated_values import MOTOR_CARS, cruise_stated, limit_stated, mass_stated, table_1


@paper.claim("7", "The model of six cars in compact form", "identity",
             r"(1), (2), (3) \Leftrightarrow M\dot v_i = u_i + \Theta_v v_i + \theta_a\phi(v_i) + \theta_k A s_i + "
             r"\theta_d A v_i + \eta", "proved", scope="the six cars of section IV; 7.n for every n",
             note="The definition of phi is lost in the extracted text; (2) forces phi(v) = [v_1^2, 0, ..., 0]^T.")
def compact_form() -> Goal:
    """Six rows of (7), with the matrix A, against (1)-(3)."""
    newton, compact, _ = car_forces(6)
    return Goal(tuple(equal(a, b) for a, b in zip(newton, compact, strict=True)))


@paper.claim("7.n", "The compact form of the first, an inner and the last car", "identity",
             r"(2), (3) \Leftrightarrow \text{rows } 1,\ j,\ n \text{ of (7)}", "proved",
             scope="every number of cars n >= 2")
def compact_form_of_every_train() -> Goal:
    """The three kinds of rows of (7); the mass of the whole train is one number."""
    total, mass, f_a = sp.symbols("m_total m_j f_a", real=True)
    ahead, own, behind = ((sp.Symbol(f"s_{k}", real=True), sp.Symbol(f"v_{k}", real=True)) for k in "abc")
    stated = compact_parameters(mass, total, f_a)
    front, rear = coupler_pull(ahead, own), coupler_pull(own, behind)
    first = compact_force(stated, own[1], own[1] ** 2, own[0] - behind[0], own[1] - behind[1])
    inner = compact_force(stated, own[1], sp.S.Zero, -ahead[0] + 2 * own[0] - behind[0],
                          -ahead[1] + 2 * own[1] - behind[1])
    last = compact_force(stated, own[1], sp.S.Zero, -ahead[0] + own[0], -ahead[1] + own[1])
    rolling = basic_resistance(mass, own[1]) + f_a
    return Goal((equal(basic_resistance(mass, own[1], total) + f_a - rear, first),
                 equal(rolling + front - rear, inner), equal(rolling + front, last)))


def _forces_at_reference() -> tuple[list[sp.Expr], dict[str, tuple[sp.Symbol, ...]]]:
    """The forces u that hold six cars at the reference speed v_r, car j at the place s_j, on level track."""
    newton, _, symbols = car_forces(6)
    level = dict.fromkeys(symbols["f_a"], sp.S.Zero) | dict.fromkeys(symbols["v"], v_r)
    return [m_j * v_r_dot - force.xreplace(level) for m_j, force in zip(symbols["m"], newton, strict=True)], symbols


needed, six = _forces_at_reference()
u_most = sp.Symbol("u_max", positive=True)
at_cruise = {**table_1, **dict.fromkeys(six["m"], mass_stated), v_r: cruise_stated, v_r_dot: Fraction(0),
             u_most: limit_stated}
behind_motors = dict(zip(six["s"], (Fraction(-7 * k, 10**4) for k in (0, 1, 1, 2, 2, 3)), strict=True))
trailer_force = float(mass_stated * (table_1[c_0] + table_1[c_v] * cruise_stated))


@paper.claim("A2", "Assumption 2: an input within the limits keeps six cars on the reference", "condition",
             r"s_j = s_r,\ v_j = v_r = 83.5:\quad u_r = M\dot v_r - \Theta_v v_r - \theta_a\phi(v_r) - "
             r"\theta_k A s_r - \theta_d A v_r - \eta \in [\underline u, \overline u]", "violated",
             at={**at_cruise, **dict.fromkeys(six["s"], Fraction(0))}, repair={**at_cruise, **behind_motors},
             note="With one reference for all cars A s_r = 0: no coupler pulls, and a trailer, which has no traction, "
                  f"cannot make up for its own {trailer_force:.0f} N of resistance at 83.5 m/s on level track. Exact "
                  "tracking of all cars is thus impossible at the stated numbers, whatever the law. The proof of "
                  "Theorem 1 does not use Assumption 2. The repair lets every trailer run 0.7 mm behind its motor car.")
def reference_can_be_tracked() -> Goal:
    """The six forces at cruise against the limits of motor cars (1, 3, 5) and trailers."""
    most = [u_most if j in MOTOR_CARS else sp.S.Zero for j in range(1, 7)]
    return Goal((*(at_most(u, high) for u, high in zip(needed, most, strict=True)),
                 *(at_least(u, -u_most) for u in needed)))


weight = sp.Symbol("gamma", nonnegative=True)
within = (at_most(g_low, g), at_most(g, g_high))


def _property_1(inner: sp.Expr, own: sp.Expr) -> Relation:
    left = (weight + 1) * g - (weight * own + limited(inner, g_low, g_high))
    return at_most(left * (own - limited(own, g_low, g_high)), 0)


@paper.claim("6", "Property 1, for the projection of any number", "inequality",
             r"\underline g \le g \le \overline g,\ \gamma \ge 0 \Rightarrow [(\gamma+1)g - (\gamma h + "
             r"\mathrm{sat}(h,\underline g,\overline g))][h - \mathrm{sat}(h,\underline g,\overline g)] \le 0",
             "proved", note="Read with sat(h, .) in the first bracket and any h, as (33) uses it. The extracted text "
                            "has sat(g, .) there, and h = sat(g, .), which is 6.text.")
def projection_property() -> Goal:
    """Case by case of h below, within and above the bounds."""
    return Goal((_property_1(h, h),), within)


@paper.claim("6.text", "Property 1 letter by letter", "inequality",
             r"[(\gamma+1)g - (\gamma h + \mathrm{sat}(g,\underline g,\overline g))][h - "
             r"\mathrm{sat}(h,\underline g,\overline g)] \le 0,\quad h = \mathrm{sat}(g,\underline g,\overline g)",
             "proved", note="True, and of no use: h lies within the bounds, so the second bracket vanishes.")
def projection_property_text() -> Goal:
    """With h = sat(g) put in."""
    return Goal((_property_1(g, limited(g, g_low, g_high)),), within)
