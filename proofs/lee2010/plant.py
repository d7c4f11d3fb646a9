"""lee2010: a quadrotor as a rigid body with thrust along its third axis, attitude as a rotation matrix, z downwards."""

from __future__ import annotations

import sympy as sp

from workbench.systems.plant import Parameter, Plant

positions = sp.symbols("x_1:4", real=True)  # m, of the centre of mass; the third points down
speeds = sp.symbols("v_1:4", real=True)  # m/s
attitude = sp.symbols("R_11 R_12 R_13 R_21 R_22 R_23 R_31 R_32 R_33", real=True)
turns = sp.symbols("W_1:4", real=True)  # rad/s, angular velocity in body axes
f, *moments = sp.symbols("f M_1:4", real=True)  # total thrust (N) and moments about the body axes (N m)
m, g, *inertias = sp.symbols("m g J_1:4", positive=True)

x, v, R, W, M = sp.Matrix(positions), sp.Matrix(speeds), sp.Matrix(3, 3, attitude), sp.Matrix(turns), sp.Matrix(moments)
J, down = sp.diag(*inertias), sp.Matrix([0, 0, 1])


def hat(of: sp.Matrix) -> sp.Matrix:
    """The skew matrix of the cross product with a vector."""
    return sp.Matrix([[0, -of[2], of[1]], [of[2], 0, -of[0]], [-of[1], of[0], 0]])


def vee(of: sp.Matrix) -> sp.Matrix:
    """The vector of a skew matrix."""
    return sp.Matrix([of[2, 1], of[0, 2], of[1, 0]])


accelerations = g * down - f / m * R * down
turning = R * hat(W)
angular_accelerations = J.inv() * (M - W.cross(J * W))

quadrotor = Plant(
    "lee2010.quadrotor", states=(*positions, *speeds, *attitude, *turns),
    rates=(*v, *accelerations, *turning, *angular_accelerations), inputs=(f, *moments), title="a quadrotor on SE(3)",
    parameters=(Parameter(m, 4.34, "kg"), Parameter(g, 9.81, "m/s^2"), *(
        Parameter(symbol, value, "kg m^2") for symbol, value in zip(inertias, (0.0820, 0.0845, 0.1377), strict=True))),
    units={**dict.fromkeys(positions, "m"), **dict.fromkeys(speeds, "m/s"), **dict.fromkeys(turns, "rad/s"), f: "N",
           **dict.fromkeys(moments, "N m")})
