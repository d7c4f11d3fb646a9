"""lee2010: the tracking law, the same without what is fed forward, and the law of the attitude alone.

The desired attitude follows from the force that the position asks for, so its angular velocity and acceleration are
derivatives of that force along the loop. A law is given three rates of a reference: the fourth of the desired position
is taken as zero, which is exact at rest and for cubics. The desired heading is the first axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from workbench.systems.law import Reference, StateLaw
from workbench.systems.lyapunov import Lyapunov

from .plant import J, M, R, W, down, f, g, hat, inertias, m, v, vee, x

desired = tuple(Reference(f"x_{i}d") for i in (1, 2, 3))
k_x, k_v, k_r, k_w = sp.symbols("k_x k_v k_R k_Omega", positive=True)
c = sp.Symbol("c", positive=True)  # of the cross term in V, of no law
GAINS, MODEL = (k_x, k_v, k_r, k_w), (m, g, *inertias)

x_d, v_d, a_d, j_d = (sp.Matrix([reference.symbols[order] for reference in desired]) for order in range(4))


@dataclass(frozen=True)
class Moving:
    """A vector with its first and second rate."""

    value: sp.Matrix
    rate: sp.Matrix
    second: sp.Matrix

    def direction(self) -> Moving:
        """The unit vector along it; the vector must not vanish."""
        length = sp.sqrt(self.value.dot(self.value))
        unit = self.value / length
        grows = unit.dot(self.rate)
        turns = (self.rate - grows * unit) / length
        grows_more = turns.dot(self.rate) + unit.dot(self.second)
        return Moving(unit, turns, (self.second - 2 * grows * turns - grows_more * unit) / length)

    def cross(self, other: Moving) -> Moving:
        """The cross product of two."""
        return Moving(self.value.cross(other.value), self.rate.cross(other.value) + self.value.cross(other.rate),
                      self.second.cross(other.value) + 2 * self.rate.cross(other.rate) + self.value.cross(other.second))


def still(of: sp.Matrix) -> Moving:
    """A vector that does not move."""
    return Moving(of, sp.zeros(3, 1), sp.zeros(3, 1))


axis = R * down  # the third body axis, against which the rotors push
axis_rate = R * W.cross(down)
force = -k_x * (x - x_d) - k_v * (v - v_d) - m * g * down + m * a_d
thrust = -force.dot(axis)
acceleration_error = g * down - thrust / m * axis - a_d
force_rate = -k_x * (v - v_d) - k_v * acceleration_error + m * j_d
thrust_rate = -force_rate.dot(axis) - force.dot(axis_rate)
jerk_error = -(thrust_rate * axis + thrust * axis_rate) / m - j_d
force_second = -k_x * acceleration_error - k_v * jerk_error

downward = Moving(-force, -force_rate, -force_second)
across = downward.cross(still(sp.Matrix([1, 0, 0])))  # whose direction is that of b_3d x b_1d, in fewer terms
third = downward.direction()
second = across.direction()
first = second.cross(third)
R_d = sp.Matrix.hstack(first.value, second.value, third.value)
W_d = sp.Matrix([third.value.dot(second.rate), first.value.dot(third.rate), second.value.dot(first.rate)])
W_d_rate = sp.Matrix([third.rate.dot(second.rate) + third.value.dot(second.second),
                      first.rate.dot(third.rate) + first.value.dot(third.second),
                      second.rate.dot(first.rate) + second.value.dot(first.second)])


def attitude_error(relative: sp.Matrix) -> sp.Matrix:
    """e_R of relative = R_d^T R."""
    return vee(relative - relative.T) / 2


def misalignment(relative: sp.Matrix) -> sp.Expr:
    """Psi of relative = R_d^T R: one less the cosine of the angle between the attitudes."""
    return (3 - relative.trace()) / 2


def moment(relative: sp.Matrix, wanted: sp.Matrix, wanted_rate: sp.Matrix) -> sp.Matrix:
    """M for a relative attitude, a desired angular velocity in desired axes, and its rate."""
    seen = relative.T * wanted
    return (-k_r * attitude_error(relative) - k_w * (W - seen) + W.cross(J * W)
            - J * (hat(W) * seen - relative.T * wanted_rate))


def commands(of_thrust: sp.Expr, of_moment: sp.Matrix) -> dict[sp.Symbol, sp.Expr]:
    """Thrust and moments by the plant's inputs."""
    return {f: of_thrust, **dict(zip(M, of_moment, strict=True))}


at_rest = sp.zeros(3, 1)
# Where the force has a part across the heading, it does not vanish.
DOMAIN = (across.value.dot(across.value),)

geometric = StateLaw(
    "lee2010.geometric", title="geometric tracking", information="full state, model known", references=desired,
    source="equations (12), (15) and (16)", commands=commands(thrust, moment(R_d.T * R, W_d, W_d_rate)),
    parameters=(*GAINS, *MODEL), domain=DOMAIN)

no_feedforward = StateLaw(
    "lee2010.no_feedforward", title="geometric, desired rates left out", information="full state, model known",
    references=desired, source="the same with a desired attitude taken as one that does not turn",
    commands=commands(thrust, moment(R_d.T * R, at_rest, at_rest)), parameters=(*GAINS, *MODEL), domain=DOMAIN)

level = StateLaw(
    "lee2010.level", title="levelling alone", information="full state, model known",
    source="the law of the attitude with a desired attitude at rest, under the thrust of hovering",
    commands=commands(m * g, moment(R, at_rest, at_rest)), parameters=(k_r, k_w, *MODEL))

V = (W.T * J * W)[0] / 2 + k_r * misalignment(R)
lyapunov = Lyapunov("V", V, level)
