"""lee2010: the thrust, and what an attitude that is off does to the position."""

from __future__ import annotations

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal

from ..laws import a_d, attitude_error, axis, force, geometric, k_v, k_x, misalignment, thrust, v_d, x_d
from ..paper import EVERY_ATTITUDE, paper
from ..plant import f, m, quadrotor, v, x
from .attitude import eps, rotation, unit

flow = {**{one: rate.xreplace({f: thrust}) for one, rate in zip(v, quadrotor.rates[3:6], strict=True)},
        **dict(zip(v_d, a_d, strict=True))}
tilted = rotation[2, 2]  # the cosine of the angle between the two thrust axes


@paper.claim("15", "The error of the speed under the thrust", "identity",
             r"f = -A \cdot R e_3 \Rightarrow m \dot e_v = -k_x e_x - k_v e_v - (A - (A \cdot R e_3) R e_3),\ "
             r"A = -k_x e_x - k_v e_v - m g e_3 + m \ddot x_d", "proved", premises=("3",),
             reading="The conclusion is ours: what is left over is the part of A across the thrust axis.")
def speed_error() -> Goal:
    """With the thrust that is simulated."""
    left = m * (v - v_d).applyfunc(D)
    right = -k_x * (x - x_d) - k_v * (v - v_d) - (force - force.dot(axis) * axis)
    return Goal((equal(geometric.commands[f], -force.dot(axis)),
                 *(equal(one, two) for one, two in zip(left, right, strict=True))), flow=flow, inputs=tuple(a_d))


def bounded(within: tuple[Relation, ...]) -> Goal:
    """The part across, |A|^2 (1 - cos^2), against |A|^2 |e_R|^2."""
    found = attitude_error(rotation)
    return Goal((at_most(1 - tilted**2, found.dot(found)),), (unit, *within))


@paper.claim("across", "What is left over is bounded by the attitude error, a quarter turn off at most", "inequality",
             r"\Psi \le 1 \Rightarrow |A - (A \cdot R e_3) R e_3| \le |A| |e_R|", "proved", origin="implied",
             scope=EVERY_ATTITUDE, reading="Squared, over |A|^2: A lies along the third column of R_d.")
def across() -> Goal:
    """With s = eps_1^2 + eps_2^2 and p = |eps|^2: s (1 - s) <= p (1 - p) for s <= p <= 1/2."""
    return bounded((at_most(2 * eps.dot(eps), 1),))


@paper.claim("across.beyond", "and beyond", "inequality",
             r"|A - (A \cdot R e_3) R e_3| \le |A| |e_R|", "refuted", origin="ours", scope=EVERY_ATTITUDE, premises=("across",),
             correction=across, corrected_statement=r"\Psi \le 1 \Rightarrow |A - (A \cdot R e_3) R e_3| \le |A| |e_R|",
             note="The paper claims nothing for this case. It is why position asks for less than a quarter turn: near half a "
                  "turn e_R vanishes and the thrust may point anywhere.")
def across_beyond() -> Goal:
    """As a question: for all attitudes?"""
    return bounded(())


def upright() -> Goal:
    """The thrust is |A| times this cosine."""
    return Goal((at_least(tilted, 0),), (unit, at_most(misalignment(rotation), 1)))


@paper.claim("upright", "The thrust does not turn round, a quarter turn off at most", "inequality",
             r"\Psi \le 1 \Rightarrow f = |A|\, R_d e_3 \cdot R e_3 \ge 0", "proved", origin="implied", premises=("15",),
             scope=EVERY_ATTITUDE, reading="The cosine between both thrust axes is an entry of R_d^T R.")
def thrust_sign() -> Goal:
    """By the cosine of the whole angle, which is no greater."""
    return upright()


@paper.claim("upright.beyond", "and beyond", "inequality", r"f = |A|\, R_d e_3 \cdot R e_3 \ge 0", "refuted", origin="ours",
             premises=("upright",), correction=upright, scope=EVERY_ATTITUDE,
             corrected_statement=r"\Psi \le 1 \Rightarrow f \ge 0",
             note="The paper claims nothing of the sign. Released almost upside down the law first asks for a thrust that "
                  "common rotors cannot give.")
def thrust_beyond() -> Goal:
    """As a question: do rotors that push one way suffice?"""
    return Goal((at_least(tilted, 0),), (unit,))
