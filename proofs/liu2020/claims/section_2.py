"""Section 2: the model (9) and Assumption 5 (10)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal

from ..goal_forms import within
from ..paper import paper
from ..plant import M, a_1, a_2, acceleration, chi, d, davis, f_d, u


@paper.claim("9", "The model (9) is (1) rewritten", "implication",
             r"M\dot v = u - f_d \Rightarrow \dot v = \tfrac{\chi}{M}u - \tfrac{\chi}{M}f_d + d", "gap",
             correction=lambda: Goal((equal((u - f_d) / M, acceleration.xreplace({
                 chi: sp.Integer(1), d: sp.Integer(0)})),)),
             corrected_statement=r"\chi = 1,\ d = 0:\quad \frac{u - f_d}{M} = \tfrac{\chi}{M}u - \tfrac{\chi}{M}f_d + d",
             note="(1) calls M the equivalent mass already; the factor chi (0.9 in section 6) and the disturbance come in "
                  "without a word. As a model in its own right (9) is sound, with the effective mass M/chi.")
def model_from_newton() -> Goal:
    """The acceleration of (1) against that of (9)."""
    return Goal((equal((u - f_d) / M, acceleration),))


v_1, v_2 = sp.symbols("v_1 v_2", real=True)
L_1, L_2, v_max = sp.symbols("L_1 L_2 v_max", positive=True)


def _lipschitz(*given: Relation) -> Goal:
    """(10) for the general resistance (8); v_1 >= v_2 without loss."""
    distance, change = v_1 - v_2, davis(v_1) - davis(v_2)
    bound = L_1 * distance + L_2 * distance**2
    return Goal((at_most(change, bound), at_most(-change, bound)), (at_least(distance, 0), *given))


def _bounded_speeds() -> Goal:
    """With |v| <= v_max, for every L_1 of at least a_1 + 2 a_2 v_max."""
    return _lipschitz(*(relation for speed in (v_1, v_2) for relation in within(speed, v_max)),
                      at_least(L_1, a_1 + 2 * a_2 * v_max))


@paper.claim("10", "Assumption 5 for all speeds", "inequality",
             r"|f_d(v_1) - f_d(v_2)| \le L_1|v_1 - v_2| + L_2|v_1 - v_2|^2\ \text{with constants}\ L_1, L_2", "refuted",
             correction=_bounded_speeds,
             corrected_statement=r"|v_i| \le v_{\max},\ L_1 \ge a_1 + 2a_2v_{\max} \Rightarrow |f_d(v_1) - f_d(v_2)| \le "
                                 r"L_1|v_1 - v_2| + L_2|v_1 - v_2|^2",
             note="Whatever L_1 and L_2 are: the speeds named in the goal, v_2 = (L_1 + L_2)/(2 a_2) and v_1 = v_2 + 1, "
                  "break it. For the speeds of a train it holds. The proofs of the theorems do not use it.")
def lipschitz_for_all_speeds() -> Goal:
    """The general resistance (8) at two speeds chosen after L_1 and L_2."""
    witness = (L_1 + L_2) / (2 * a_2)
    return _lipschitz(equal(v_2, witness), equal(v_1, witness + 1))
