"""slotine1987: the adaptive law and what follows from it."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal, greater
from workbench.systems.lyapunov import closed_loop

from ..laws import K_D, Lambda, Y, adaptive, errors, gammas, hats, reference_accelerations, s
from ..paper import EVERY_ARM, paper
from ..plant import A, C, H, arm, d_1, d_2, determinant, q_1, q_2, tau_1, tau_2, w, w_1, w_2
from .properties import coriolis, elbow, inertia, turning

flow = closed_loop(arm, adaptive)
defined = greater(elbow.put(determinant), 0)

# The loop in s and the errors of the estimates: H s' = Y (a_hat - a) - (K_D + C) s, which the row `loop` shows of plant
# and law. Y enters as numbers that may vary as they like, so what follows holds for every desired motion.
s_1, s_2 = sp.symbols("s_1 s_2", real=True)
s_now, d = sp.Matrix([s_1, s_2]), sp.Matrix([d_1, d_2])
tildes = sp.Matrix(sp.symbols("e_1:5", real=True))
y = sp.Matrix(2, 4, sp.symbols("y_1:9", real=True))
inverse = sp.Matrix([[inertia[1, 1], -inertia[0, 1]], [-inertia[0, 1], inertia[0, 0]]]) / elbow.put(determinant)
estimates = sum((e**2 / (2 * gamma) for e, gamma in zip(tildes, gammas, strict=True)), sp.Integer(0))
energy = (s_now.T * inertia * s_now)[0] / 2
damping = (s_now.T * K_D * s_now)[0]
inputs = (w_1, w_2, *y)


def loop_flow(disturbance: sp.Matrix) -> dict[sp.Expr, sp.Expr]:
    """Rates of s, the elbow and the errors of the estimates."""
    s_rates = inverse * (y * tildes - (K_D + coriolis) * s_now + disturbance)
    return {**turning, **dict(zip(s_now, s_rates, strict=True)),
            **dict(zip(tildes, -sp.diag(*gammas) * y.T * s_now, strict=True))}


@paper.claim("plant", "The simulated arm", "identity", r"H(q) \ddot q + C(q, \dot q) \dot q = \tau + d", "proved")
def simulated_arm() -> Goal:
    """The rates that the simulation integrates solve the arm's equation."""
    left = inertia * accelerations_of_plant + coriolis * w
    return Goal(tuple(equal(one, other) for one, other in zip(left, sp.Matrix([tau_1 + d_1, tau_2 + d_2]), strict=True)),
                (defined,))


accelerations_of_plant = sp.Matrix([elbow.put(arm.flow[w_1]), elbow.put(arm.flow[w_2])])


@paper.claim("loop", "The closed loop", "identity", r"H \dot s = Y \tilde a - (K_D + C) s", "proved",
             premises=("plant", "linear"),
             reading="Its right side is tau - C q' - H q_r'', from the arm and the law.")
def loop() -> Goal:
    """From the arm and the law's own torques, for every desired motion."""
    torque = sp.Matrix([adaptive.commands[tau_1], adaptive.commands[tau_2]])
    left = (torque - C * w - H * reference_accelerations).applyfunc(elbow.put)
    right = (Y * (sp.Matrix(hats) - sp.Matrix(A)) - (K_D + C) * s).applyfunc(elbow.put)
    return Goal(tuple(equal(one, other) for one, other in zip(left, right, strict=True)))


@paper.claim("surface", "Errors and s", "identity", r"\dot{\tilde q} + \Lambda \tilde q = s", "proved",
             reading="In both joints.")
def surface() -> Goal:
    """Where s vanishes, the errors decay with the rates Lambda."""
    rows = zip(errors, Lambda * errors, s, strict=True)
    kinematic = {symbol: rate for symbol, rate in flow.items() if symbol in (q_1, q_2, *desired_symbols)}
    return Goal(tuple(equal(D(e) + slope, one) for e, slope, one in rows), flow=kinematic)


desired_symbols = tuple(symbol for reference in adaptive.references for symbol in reference.symbols[:3])
H_11, H_12, H_22 = sp.symbols("H_11 H_12 H_22", real=True)


@paper.claim("V", "V is not negative", "inequality", r"V = \frac12 s^T H s + \frac12 \tilde a^T \Gamma^{-1} \tilde a \ge 0",
             "proved", premises=("positive",), scope=EVERY_ARM,
             reading="For every positive definite H, by its minors; multiplied by H_22 > 0.")
def not_negative() -> Goal:
    """A square and the determinant times a square."""
    form = (H_11 * s_1**2 + 2 * H_12 * s_1 * s_2 + H_22 * s_2**2) / 2 + estimates
    return Goal((at_least(H_22 * form, 0),), (greater(H_22, 0), greater(H_11 * H_22 - H_12**2, 0)))


@paper.claim("decrease", "V decreases by the damping alone", "identity", r"\dot V = -s^T K_D s \le 0", "proved",
             premises=("skew", "loop"), severity="result", scope=EVERY_ARM)
def decrease() -> Goal:
    """The adaptation cancels the errors of the estimates, the skew symmetry the rates of H."""
    return Goal((equal(D(energy + estimates), -damping), at_most(-damping, 0)), (defined,),
                flow=loop_flow(sp.zeros(2, 1)), inputs=inputs)


def with_torque() -> Goal:
    """V's rate with disturbing torques."""
    return Goal((equal(D(energy + estimates), -damping + (s_now.T * d)[0]),), (defined,),
                flow=loop_flow(d), inputs=(*inputs, d_1, d_2))


@paper.claim("disturbed", "Under a disturbing torque V may grow", "inequality", r"\dot V = -s^T K_D s + s^T d \le 0",
             "refuted", origin="ours", premises=("decrease",), correction=with_torque,
             corrected_statement=r"\dot V = -s^T K_D s + s^T d",
             note="The paper claims nothing for this case. V's rate has no term in the errors of the estimates, so nothing "
                  "pulls them back: a disturbance may move them ever further.")
def drift() -> Goal:
    """As a question: is V still decreasing?"""
    return Goal((at_most(-damping + (s_now.T * d)[0], 0),))


paper.axiom("convergence", "The tracking errors vanish",
            r"\lim_{t \to \infty} \tilde q(t) = 0,\ \lim_{t \to \infty} \dot{\tilde q}(t) = 0",
            "Barbalat's lemma, for bounded desired motions with bounded first and second rates",
            hypotheses=("V", "decrease", "surface"), severity="result")
