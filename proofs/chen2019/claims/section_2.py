"""Section II: the model in compact form (7), the limits (4), (5), Property 1 (6), Remark 1 and Assumption 2."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, greater
from workbench.trains.multi_particle import basic_resistance, c_0, c_v, coupler_pull

from ..goal_forms import both, integrated
from ..laws import limited, v_r, v_r_dot
from ..one_car import g, g_high, g_low, h, u_high, u_low
from ..paper import paper
from ..plant import car_forces, compact_force, compact_parameters
from ..stated_values import MOTOR_CARS, cruise_stated, limit_stated, mass_stated, table_1

mu_car = sp.Symbol("mu", real=True)


def _three_cases(low: sp.Expr, high: sp.Expr) -> tuple[Relation, ...]:
    """What the three cases say of u: each product vanishes, so u is the value of the case that mu lies in."""
    u = limited(mu_car, low, high)
    above, inside = sp.Max(mu_car - high, 0), sp.Max(mu_car - low, 0) * sp.Max(high - mu_car, 0)
    below = sp.Max(low - mu_car, 0)
    return (*both(above * (u - high), sp.S.Zero), *both(inside * (u - mu_car), sp.S.Zero),
            *both(below * (u - low), sp.S.Zero))


paper.axiom("1", "Newton's law for each car",
            r"\dot{s}_{j}(t) = v_{j}(t),\ m_{j}(t)\dot{v}_{j}(t) = u_{j}(t) + f_{j}^{b}(t, v_{j}(t)) + f_{j}^{c}(t, s(t), v(t)) + "
            r"f_{j}^{a}(t)", "the paper's [11]", hypotheses=(), severity="data")
paper.definition("2", "The basic resistance",
                 r"f_{j}^{b}(t, v_{j}(t)) = \begin{cases} -m_{j}(t)[c_{0}(t) + c_{v}(t)v_{j}(t)] - \sum_{k=1}^{n}m_{k}(t)c_{a}(t)"
                 r"v_{1}^{2}(t), & j = 1, \\ -m_{j}(t)[c_{0}(t) + c_{v}(t)v_{j}(t)], & j = 2, \dots, n \end{cases}")
paper.definition("3", "The coupler forces",
                 r"f_{j}^{c}(t, s(t), v(t)) = c_{k}(t)[s_{j-1}(t) - s_{j}(t)] + c_{d}(t)[v_{j-1}(t) - v_{j}(t)] - c_{k}(t)[s_{j}(t) - "
                 r"s_{j+1}(t)] - c_{d}(t)[v_{j}(t) - v_{j+1}(t)],\ j = 2, \dots, n - 1",
                 note="At the ends of the train the half that has no neighbour is left out.")


@paper.claim("4", "The saturation of a motor car, case by case", "identity",
             r"u_{j} = \operatorname{sat}(\mu_{j}, u_{j}^{-}, u_{j}^{+}) = \begin{cases} u_{j}^{+}, & \mu_{j} > "
             r"u_{j}^{+}, \\ \mu_{j}, & u_{j}^{-} \le \mu_{j} \le u_{j}^{+}, \\ u_{j}^{-}, & \mu_{j} < u_{j}^{-}. "
             r"\end{cases}", "proved",
             reading="sat is written min(max(mu, u^-), u^+) in all goals; this row shows that it takes the value of "
                     "each of the three cases. (8) is this line for a car with u^+ or 0 as its upper limit.")
def saturation_of_a_motor_car() -> Goal:
    """min(max(.)) against the three cases, for u^- <= u^+."""
    return Goal(_three_cases(u_low, u_high), (at_most(u_low, u_high),))


@paper.claim("5", "The saturation of a trailer, case by case", "identity",
             r"u_{j} = \operatorname{sat}(\mu_{j}, u_{j}^{-}, 0) = \begin{cases} 0, & \mu_{j} > 0, \\ \mu_{j}, & "
             r"u_{j}^{-} \le \mu_{j} \le 0, \\ u_{j}^{-}, & \mu_{j} < u_{j}^{-}. \end{cases}", "proved",
             reading="As (4), with the upper limit 0 and u^- <= 0, the largest braking force.")
def saturation_of_a_trailer() -> Goal:
    """min(max(.)) against the three cases, for u^- <= 0."""
    return Goal(_three_cases(u_low, sp.S.Zero), (at_most(u_low, 0),))


weight = sp.Symbol("gamma", nonnegative=True)
within = (at_most(g_low, g), at_most(g, g_high))


def _property_1(first: sp.Expr, own: sp.Expr) -> Relation:
    left = (weight + 1) * g - (weight * own + limited(first, g_low, g_high))
    return at_most(left * (own - limited(own, g_low, g_high)), 0)


@paper.claim("6", "Property 1", "inequality",
             r"[(\gamma+1)g - (\gamma h + \operatorname{sat}(g, \underline{g}, \overline{g}))][h - "
             r"\operatorname{sat}(h, \underline{g}, \overline{g})] \le 0", "proved",
             reading="With h = sat(g, g_low, g_high), g_low <= g <= g_high and gamma >= 0, as the lines around it say.",
             note="True letter by letter, and of no use: h lies within the bounds, so the second bracket vanishes. "
                  "See 33.property.")
def projection_property() -> Goal:
    """h is a name for sat(g)."""
    return Goal((_property_1(g, h),), (*within, equal(h, limited(g, g_low, g_high))))


@paper.claim("6.mended", "Property 1 for the projection of any number h", "inequality",
             r"[(\gamma+1)g - (\gamma h + \operatorname{sat}(h, \underline{g}, \overline{g}))][h - "
             r"\operatorname{sat}(h, \underline{g}, \overline{g})] \le 0", "proved", origin="ours", mends="6",
             reading="For any h, and with sat(h) in the first bracket, as (33) uses it with gamma = 0.")
def projection_property_of_any_number() -> Goal:
    """Case by case of h below, within and above the bounds."""
    return Goal((_property_1(h, h),), within)


paper.axiom("A1", "Assumption 1: the masses have known bounds",
            r"\text{The unknown time-varying parameter } m_j(t) \text{ has the known lower bound } \underline{m}_j \text{ and upper bound } "
            r"\overline{m}_j, \text{ i.e., } \underline{m}_j \leq m_j(t) \leq \overline{m}_j, \text{ where } \underline{m}_j, \overline{m}_j "
            r"\text{ are constants, and } \underline{m}_j > 0", "assumption of the paper", hypotheses=(), severity="data", match="words",
            note="Used in (33) and (44), as an assumption of their goals. Section IV states no bounds.")

self_weight, load, full_load = sp.symbols("m_self load load_full", real=True)


@paper.claim("remark1", "Remark 1: self-weight and full load are bounds as Assumption 1 asks for", "implication",
             r"\underline{m}_j represents the self-weight of jth car, and \overline{m}_j denotes the mass of jth car "
             r"with full load", "proved", severity="cosmetic", match="words",
             reading="A car's mass is its self-weight and a load between nothing and the full load; then 0 < m_low <= "
                     "m <= m_high.")
def mass_bounds_exist() -> Goal:
    """Self-weight positive, load between 0 and the full load."""
    given = (greater(self_weight, 0), at_least(load, 0), at_most(load, full_load))
    return Goal((greater(self_weight, 0), at_most(self_weight, self_weight + load),
                 at_most(self_weight + load, self_weight + full_load)), given)


LINE_7 = (r"\begin{cases} \dot{s}_i = v_i, \\ M \dot{v}_i = u_i + \Theta_v v_i + \theta_a \phi(v_i) + \theta_k A s_i + "
          r"\theta_d A v_i + \eta, \end{cases}")


@paper.claim("7", "The compact form of the first, an inner and the last car", "identity", LINE_7, "proved",
             scope="every number of cars n >= 2",
             reading="The forces besides u of (7) in its first row, an inner one and the last one, against (1), (2), "
                     "(3); the definition of phi is lost in the extracted text, and (2) forces phi(v) = [v_1^2, 0, "
                     "..., 0]^T. The mass of the whole train is one number.")
def compact_form_of_every_train() -> Goal:
    """The three kinds of rows of (7)."""
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


@paper.claim("7.six", "The compact form of the six cars of section IV, with the matrix A written out", "identity",
             LINE_7, "proved", origin="ours", scope="the six cars of section IV")
def compact_form() -> Goal:
    """Six rows of (7), with the matrix A, against (1)-(3)."""
    newton, compact, _ = car_forces(6)
    return Goal(tuple(equal(a, b) for a, b in zip(newton, compact, strict=True)))


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


@paper.claim("A2", "Assumption 2: on level track an input within the limits keeps six cars on the reference", "condition",
             r"\text{There is always an appropriate control input $u_r(t)$ to drive the high-speed train to track the "
             r"reference trajectories $s_r$ and $v_r$ over the finite time interval $[0, T]$.}", "violated", match="words",
             reading="At the cruising speed of 83.5 m/s, with the one reference that the paper gives to all cars, the "
                     "forces u_r that (7) asks for lie within the limits of section IV, on level track: section IV prints "
                     "no additional resistance f^a.",
             at={**at_cruise, **dict.fromkeys(six["s"], Fraction(0))},
             note="One reference for all cars leaves the couplers without force, and a trailer has no traction. So it lacks "
                  f"{trailer_force:.0f} N at 83.5 m/s, and 15.4 kN where the train gains speed at 0.3 m/s^2 from low speed: "
                  "no law tracks exactly, unless a downhill grade supplies this force to each trailer (A2.trailer). Section "
                  "IV says itself that couplers drag the trailers; then their places differ. What is missed is small: for ten "
                  "seconds of cruise the errors of place of a trailer and its neighbours cannot stay below 0.159 mm while their errors "
                  "of speed stay below 0.159 mm/s, nor for ten seconds at 0.3 m/s^2 below 1.82 mm and 1.82 mm/s (A2.floor). With every trailer 0.7 mm behind its motor car an input "
                  "exists at cruise (A2.behind), 7.7 mm where the train gains speed from low speed; that is another reference. The "
                  "proof of Theorem 1 does not use Assumption 2.")
def reference_can_be_tracked() -> Goal:
    """The six forces at cruise against the limits of motor cars (1, 3, 5) and trailers."""
    return _within_limits()


def _within_limits() -> Goal:
    most = [u_most if j in MOTOR_CARS else sp.S.Zero for j in range(1, 7)]
    return Goal((*(at_most(u, high) for u, high in zip(needed, most, strict=True)),
                 *(at_least(u, -u_most) for u in needed)))


@paper.claim("A2.behind", "With every trailer 0.7 mm behind its motor car the forces at cruise lie within the limits", "condition",
             r"s_r - (0, 0.7, 0.7, 1.4, 1.4, 2.1)^T\ \mathrm{mm}: \underline u \le u_r \le \overline u", "proved", match="words",
             origin="ours", at={**at_cruise, **behind_motors}, scope="the six cars of section IV at 83.5 m/s on level track")
def train_with_stretched_couplers() -> Goal:
    """The same six forces, at other places of the cars."""
    return _within_limits()


paper.axiom("remark3", "Remark 3: the same initial state in every iteration",
            r"\text{The identical initialization condition or its modifications are essential for the stability analysis of control system, "
            r"which can be easily satisfied in the repetitive operation environment of high-speed trains.}",
            "the paper's choice", hypotheses=(), severity="cosmetic", match="words",
            note="What Assumption 3 gives, and what it leaves out, is row A3.")

trailer_mass, rolling_0, rolling_v = sp.symbols("m c_0 c_v", positive=True)
speed_r, acceleration_r, falling = sp.symbols("v_r v_r_dot f_least", nonnegative=True)  # f^a = -f_least <= 0


@paper.claim("A2.trailer", "No trailer follows a reference that does not slow down, on a line that resists",
             "inequality",
             r"\dot v_r \ge 0,\ v_r \ge 0,\ f^a_j \le 0 \Rightarrow m_j\dot v_r + m_j(c_0 + c_v v_r) - f^a_j > 0",
             "proved", origin="ours", scope="every trailer of every train",
             note="The force that a trailer needs to stay on the common reference is a traction force, which (5) rules "
                  "out. So Assumption 2 fails for every train with a trailer, not at the stated numbers alone.")
def trailer_needs_traction() -> Goal:
    """The force that (1), (2) ask of a trailer whose couplers do not pull."""
    resistance = -basic_resistance(trailer_mass, speed_r).xreplace({c_0: rolling_0, c_v: rolling_v})
    return Goal((greater(trailer_mass * acceleration_r + resistance + falling, 0),))


e_speed, e_start, stretch, stretching, brake, lasting = sp.symbols("e_v e_0 d_s d_v u t", real=True)
drag, friction, stiffness, damping = sp.symbols("R k_v c_k c_d", positive=True)
most_s, most_v = sp.symbols("epsilon_s epsilon_v", positive=True)  # m, m/s


@paper.claim("A2.floor", "Whatever the law, the errors of a trailer and its neighbours cannot all be small where it needs traction",
             "implication",
             r"|e_s| \le \varepsilon_s, |e_v| \le \varepsilon_v\ \text{for } t \text{ seconds} \Rightarrow 2m\varepsilon_v \ge "
             r"t[R - 4c_k\varepsilon_s - (k_v + 4c_d)\varepsilon_v],\ 0 < R \le m(\dot v_r + c_0 + c_vv_r) - f^a,\ k_v = mc_v",
             "proved", origin="ours", scope="an inner trailer, with coefficients that are constant for these t seconds",
             note="So no law makes the tracking errors of such a train converge to zero. At the stated numbers, on level "
                  "track, R = 1339 N at cruise: after ten seconds of it the errors of place or those of speed have reached 0.159 "
                  "mm or 0.159 mm/s, one of the two is enough. What is impossible is zero, not good tracking.")
def errors_have_a_floor() -> Goal:
    """m e_v + t times what is left of R does not increase while the errors are small; d = e_{j-1} - 2 e_j + e_{j+1}; u is the
    braking force less what the resistance is above R."""
    left_over = drag - 4 * stiffness * most_s - (friction + 4 * damping) * most_v
    rate = brake - drag - friction * e_speed + stiffness * stretch + damping * stretching
    always = (at_most(e_speed, most_v), at_least(e_speed, -most_v), at_most(stretch, 4 * most_s),
              at_most(stretching, 4 * most_v), at_most(brake, 0))
    goal = integrated({e_speed: rate / trailer_mass, lasting: sp.S.One},
                      at_least(2 * trailer_mass * most_v, lasting * left_over), always,
                      (trailer_mass, drag, friction, stiffness, damping, most_s, most_v, e_start),
                      start={e_speed: e_start}, decreasing=trailer_mass * e_speed + lasting * left_over)
    return replace(goal, assume=(*goal.assume, at_least(e_speed, -most_v), at_most(e_start, most_v)))
