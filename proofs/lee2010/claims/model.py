"""lee2010: the quadrotor's equations of motion, and the thrusts of its rotors."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, equal

from ..paper import EVERY_MATRIX, paper
from ..plant import J, M, R, W, down, f, g, hat, m, positions, quadrotor, speeds

arm, drag = sp.symbols("d c_tau", positive=True)  # centre to rotor (m), a rotor's torque by its thrust (m)
rotors = sp.Matrix(sp.symbols("f_1:5", real=True))
MIXING = sp.Matrix([[1, 1, 1, 1], [0, -arm, 0, arm], [arm, 0, -arm, 0], [-drag, drag, -drag, drag]])


@paper.claim("1", "Thrust and moments by the rotors", "implication",
             r"\begin{pmatrix} f \\ M_1 \\ M_2 \\ M_3 \end{pmatrix} = \begin{pmatrix} 1 & 1 & 1 & 1 \\ 0 & -d & 0 & d \\ "
             r"d & 0 & -d & 0 \\ -c & c & -c & c \end{pmatrix} \begin{pmatrix} f_1 \\ f_2 \\ f_3 \\ f_4 \end{pmatrix}",
             "proved", reading="The conclusion is ours: each rotor's thrust by the four. c is the paper's c with index tau f.")
def mixing() -> Goal:
    """Thrust and moments may be taken as inputs, with rotors that may push either way."""
    made = tuple(equal(one, two) for one, two in zip((f, *M), MIXING * rotors, strict=True))
    signs = ((0, 1, -1), (-1, 0, 1), (0, -1, -1), (1, 0, 1))
    return Goal(tuple(equal(rotor, f / 4 + (a * M[0] + b * M[1]) / (2 * arm) + turn * M[2] / (4 * drag))
                      for rotor, (a, b, turn) in zip(rotors, signs, strict=True)), made)


@paper.claim("2", "Position", "identity", r"\dot x = v", "proved")
def position() -> Goal:
    """As simulated."""
    return Goal(tuple(equal(D(one), rate) for one, rate in zip(positions, speeds, strict=True)), flow=quadrotor.flow)


@paper.claim("3", "Gravity and thrust", "identity", r"m \dot v = m g e_3 - f R e_3", "proved")
def translation() -> Goal:
    """As simulated; the third axis points down."""
    right = m * g * down - f * R * down
    return Goal(tuple(equal(m * D(one), two) for one, two in zip(speeds, right, strict=True)), flow=quadrotor.flow)


@paper.claim("4", "Attitude", "identity", r"\dot R = R \hat\Omega", "proved")
def rotation() -> Goal:
    """As simulated, entry by entry."""
    return Goal(tuple(equal(D(one), two) for one, two in zip(R, R * hat(W), strict=True)), flow=quadrotor.flow)


@paper.claim("4.group", "The attitude stays a rotation", "identity",
             r"\frac{d}{dt} R^T R = R^T R \hat\Omega - \hat\Omega R^T R", "proved", origin="implied", premises=("4",),
             scope=EVERY_MATRIX, reading="Zero where R^T R = I, so that this stays.")
def group() -> Goal:
    """The plant has the nine entries as states; a run keeps them on the group but for the integration's error."""
    square = R.T * R
    return Goal(tuple(equal(D(one), two) for one, two in zip(square, square * hat(W) - hat(W) * square, strict=True)),
                flow=quadrotor.flow)


@paper.claim("5", "Angular velocity", "identity", r"J \dot\Omega + \Omega \times J \Omega = M", "proved",
             reading="For inertias about principal axes, as in the paper's example.")
def euler() -> Goal:
    """As simulated."""
    left = J * W.applyfunc(D) + W.cross(J * W)
    return Goal(tuple(equal(one, two) for one, two in zip(left, M, strict=True)), flow=quadrotor.flow)
