"""Section 2: Newton's law and the resistances, (1)-(6)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, differ, equal, greater

from ..paper import paper
from ..plant import (
    M,
    additional,
    centre_angle,
    chi,
    curve_force,
    curve_length,
    d,
    davis,
    g,
    model,
    opposing,
    opposing_force,
    restricted_tunnel_force,
    s,
    slope_angle,
    slope_force,
    tunnel_force,
    tunnel_length,
    u,
    v,
)
from .section_1 import v_other

paper.axiom("1", "Newton's law for the train as one mass",
            r"M\frac{dv}{dt} = M\dot{v}(t) = F,\quad F = u(t) - f_d(v, s)", "Garg 1984, the paper's [36]", hypotheses=(),
            severity="data", note="The model that is used is (9), which has a factor chi and a disturbance more, see 9.")

rates = model().rates
SPEED = {r"\frac{ds}{dt}": D(s), r"\dot{s}(t)": D(s)}


@paper.claim("1.speed", "The speed is the rate of the position", "identity", r"\frac{ds}{dt} = \dot{s}(t) = v", "proved",
             rests_on=(), where=SPEED, reading="Of the train that is simulated.")
def speed_of_train() -> Goal:
    """D(s) of the plant."""
    return Goal((equal(D(s), v),), flow=dict(rates))


resistance = u - M / chi * D(v)  # by (9) without disturbance, N
felt = resistance - davis(v)  # besides the general resistance
f_s, f_c, f_t = sp.symbols("f_s f_c f_t", real=True)


def against(force: sp.Expr) -> dict[sp.Expr, sp.Expr]:
    """The train of the simulation with a force against it, N."""
    return {state: rate.xreplace({opposing: force}) for state, rate in rates.items()}


@paper.claim("1.resistance", "The resistance is the additional and the general one", "identity", r"f_d(v, s) = f_a(s) + f_b(v)",
             "proved", rests_on=(), where={"f_d(v, s)": resistance, "f_a(s)": additional, "f_b(v)": davis(v)},
             reading="f_d is what the input of the simulated train has to spare for its acceleration, by (9) without disturbance, in "
                     "newtons.",
             note="(1) and (6) write f_a(s), (5) and (7) f_a(v, t): by the first case of (4) it depends on the speed, too.")
def resistance_of_train() -> Goal:
    """u - (M/chi) v' of the plant."""
    return Goal((equal(resistance, additional + davis(v)),), flow=against(opposing_force.xreplace({d: sp.Integer(0)})))


height = sp.Symbol("h", real=True)


@paper.claim("2", "The force of a slope", "identity", r"f_s(t) = M(t)g\sin\alpha(t)", "proved", rests_on=(),
             where={"f_s(t)": f_s, "M(t)": M, r"\alpha(t)": slope_angle},
             reading="f_s is the force whose power is the rate of the potential energy M g h, where h grows by sin(alpha) a "
                     "metre of track, while the train moves.",
             note="The letter of the angle is alpha in (2) and theta in the sentence after it.")
def slope_force_lifts() -> Goal:
    """D(M g h) = f_s v along h' = v sin(alpha)."""
    return Goal((equal(f_s, slope_force),), (equal(f_s * v, D(M * g * height)), greater(v, 0)),
                flow={height: v * sp.sin(slope_angle)})


RULE = ("Of the rule that (3) and (4) repeat without a source nothing can be derived; decided is that the train of the simulation "
        "feels just this force.")


@paper.claim("3", "The force of a curve", "identity", r"f_c(t) = 0.1029\frac{\varphi(t)}{L_r(t)}M(t)", "proved", rests_on=(),
             where={"f_c(t)": felt, r"\varphi(t)": centre_angle, "L_r(t)": curve_length, "M(t)": M},
             reading=RULE, note="The simulation takes the angle in degrees: 0.1029 is 10.5 N/kN a degree a metre times g/1000.")
def force_of_curve() -> Goal:
    """What the train of the simulation feels in a curve."""
    stated = sp.Rational("0.1029") * centre_angle / curve_length * M
    return Goal((equal(felt, stated),), flow=against(curve_force))


def _tunnel(name: str, title: str, printed: str, force: sp.Expr, stated: sp.Expr, note: str) -> None:
    @paper.claim(name, title, "identity", printed, "proved", rests_on=(), where={"f_t(v, t)": felt, "M(t)": M, "L_s": tunnel_length},
                 reading=RULE, note=note)
    def force_of_tunnel() -> Goal:
        """What the train of the simulation feels in a tunnel."""
        return Goal((equal(felt, stated),), flow=against(force))


_tunnel("4", "The force of a tunnel with restricted ramps", r"f_t(v, t) = \frac{v^2}{10^9}L_sM(t)", restricted_tunnel_force,
        v**2 / 10**9 * tunnel_length * M, "No row of Table 1 has a slope and a tunnel, so that no run has this force. The rule is usually stated for a speed "
        "in km/h; the paper's v is in m/s.")
_tunnel("4.plain", "The force of a tunnel without restricted ramps", r"f_t(v, t) = \frac{1.3}{10^6}L_sM(t)", tunnel_force,
        sp.Rational("1.3") / 10**6 * tunnel_length * M, "The case that the runs take.")


@paper.claim("5", "The additional resistance", "identity", r"f_a(v, t) = f_s(t) + f_c(t) + f_t(v, t)", "proved", rests_on=(),
             where={"f_a(v, t)": felt, "f_s(t)": f_s, "f_c(t)": f_c, "f_t(v, t)": f_t},
             reading="f_a is what the train of the simulation feels against the three forces together.")
def additional_resistance() -> Goal:
    """Their sum as the force against the train."""
    return Goal((equal(felt, f_s + f_c + f_t),), flow=against(f_s + f_c + f_t))


angle_r = sp.Symbol("r", real=True)
parameter_l = (f_s + f_c + f_t) / sp.sin(angle_r)


@paper.claim("6.parameter", "The additional resistance does not depend on the speed", "identity", r"f_a(s) = l(t)\sin(r(s))", "refuted",
             severity="cosmetic", origin="implied", premises=("4",), rests_on=(),
             reading="At one position and time the first case of (4) gives the same force at two speeds, as l(t) sin(r(s)) does.",
             note="(6) gives f_a no speed, but by the first case of (4) f_a has the square of the speed in it. (6) holds where the "
                  "tunnel term does not depend on the speed, or with an l that depends on v as well. Nothing depends on it: a "
                  "bounded f_a is all that the proofs use.")
def resistance_without_speed() -> Goal:
    """The tunnel's force at two speeds."""
    return Goal((equal(restricted_tunnel_force, restricted_tunnel_force.xreplace({v: v_other})),))


@paper.claim("6", "The additional resistance as that of an equivalent slope", "implication", r"f_a(s) = l(t)\sin(r(s))", "proved",
             premises=("5", "6.parameter"), where={"f_a(s)": f_s + f_c + f_t, "l(t)": parameter_l, "r(s)": angle_r},
             reading="There are l(t) and r(s) for which (5) is (6): witnesses are any r(s) whose sine is not zero, and l(t) = "
                     "f_a/sin(r).",
             note="Along one run, l being any function of time. As a formula it holds only where f_a does not depend on the speed, see "
                  "6.parameter.")
def equivalent_slope() -> Goal:
    """(5) with the witnesses."""
    return Goal((equal(f_s + f_c + f_t, parameter_l * sp.sin(angle_r)),), (differ(sp.sin(angle_r), 0),))
