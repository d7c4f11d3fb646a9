"""Section 2: the model (7)-(9) and Assumptions 1 to 5 (10)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most, equal

from ..goal_forms import within
from ..paper import paper
from ..plant import M, a_0, a_1, a_2, acceleration, chi, d, davis, f_d, model, opposing, s, u, v

DISTURBED = {s: v, v: (u - f_d) / M + d}  # (1), and the disturbance that (9) adds


s_1, s_2 = sp.symbols("s_1 s_2", real=True)


@paper.claim("7", "The integral of the speed over the resistance's time is the position", "identity",
             r"f_a(v, t) = l(t)\sin\left(r\left(\int_{t_1}^{t_2}v(t)\right)\right)", "refuted", severity="cosmetic",
             rests_on=(),
             reading="Against (6), where the position s stands in the place of the integral, t_1 and t_2 being the start "
                     "and the end of the additional resistance.",
             note="Between fixed instants the integral is the length of the section, one number, and not the position, which "
                  "is s(t_1) plus the integral of v from t_1 to t. Nothing depends on it: f_a needs only to be bounded.")
def position_by_integral() -> Goal:
    """s(t_2) - s(t_1) against a position in between."""
    return Goal((equal(s_2 - s_1, s),), (at_most(s_1, s), at_most(s, s_2)))


coasting = -M / chi * model().rates[v].xreplace({u: sp.Integer(0), opposing: sp.Integer(0)})


@paper.claim("8", "The general resistance", "identity", r"f_b(v, t) = a_0(t) + a_1(t)v + a_2(t)v^2", "proved", rests_on=(),
             where={"f_b(v, t)": coasting, "a_0(t)": a_0, "a_1(t)": a_1, "a_2(t)": a_2},
             reading="f_b is what the train of the simulation loses when it coasts on a level line without disturbance, "
                     "in newtons.",
             note="In the simulation the coefficients rest, as (61) has them.")
def general_resistance() -> Goal:
    """The deceleration of the coasting train times M/chi."""
    return Goal((equal(coasting, a_0 + a_1 * v + a_2 * v**2),))


@paper.claim("9", "The model (9) from (1)", "implication",
             r"\dot v(t) = \frac{\chi}{M}u(t) - \frac{\chi}{M}f_d(v, t) + d(t)", "gap", severity="cosmetic",
             rests_on=("1",),
             reading="Of (1) with the d(t) that the text below (9) adds for what is not modelled.",
             correction=lambda: Goal((equal(D(v), acceleration.xreplace({chi: sp.Integer(1)})),), flow=DISTURBED),
             corrected_statement=r"\chi = 1:\quad \dot v = \tfrac{\chi}{M}u - \tfrac{\chi}{M}f_d + d",
             note="'Therefore', says the text, but (1) calls M the equivalent mass already, and the factor chi (0.9 in "
                  "section 6) is nowhere defined. As a model in its own right, which is what the theorems take it for, "
                  "(9) is sound, with the effective mass M/chi.")
def model_from_newton() -> Goal:
    """The acceleration of (1) with a disturbance against that of (9)."""
    return Goal((equal(D(v), acceleration),), flow=DISTURBED)


paper.axiom("assumption1", "Assumption 1: a smooth reference", r"\text{The reference trajectory}\ x_d = [s_d, v_d]\ "
            r"\text{is smooth. The first and second derivatives of}\ x_d\ \text{exist and are bounded.}",
            "assumption of the paper", hypotheses=(), severity="data", match="words")
paper.axiom("assumption2", "Assumption 2: some input tracks the reference",
            r"\text{a suitable traction/brake control input}\ u(t)\ \text{can drive the train}\ \ldots\ \text{and}\ "
            r"\dot s_d = v_d\ \text{is accurately tracked.}", "assumption of the paper", hypotheses=(),
            severity="data", match="words")
paper.axiom("assumption3", "Assumption 3: bounded parameters and disturbance",
            r"M, a_0(t), a_1(t), a_2(t)\ \text{are unknown but continuously bounded, and they are greater than zero.}\ "
            r"l(t), d(t)\ \text{are unknown and continuously bounded.}", "assumption of the paper", hypotheses=(),
            severity="data", match="words",
            note="(71) is not continuous: at t = 1000 s it jumps from 0 to (10^6/M) sin 8.")
paper.axiom("assumption4", "Assumption 4: bounded ideal weights", r"\|W^*\| \le \|W_N\|",
            "assumption of the paper", hypotheses=(), severity="data")

PRINTED_10 = r"\|f_d(v_1) - f_d(v_2)\| \le L_1\|v_1 - v_2\| + L_2\|v_1 - v_2\|^2"
paper.axiom("10", "Assumption 5: a condition of Lipschitz type", PRINTED_10, "assumption of the paper",
            hypotheses=("10.holds",), severity="data",
            note="No range of speeds is printed. The speeds of a train are bounded, and then it holds (10.holds); for all "
                 "speeds no constants do (10.everywhere). The proofs of the theorems do not use it.")

v_1, v_2 = sp.symbols("v_1 v_2", real=True)
L_1, L_2, v_max = sp.symbols("L_1 L_2 v_max", positive=True)
apart = sp.Symbol("v_12", nonnegative=True)  # |v_1 - v_2|
size_of_distance, size_of_change = sp.Abs(v_1 - v_2), sp.Abs(davis(v_1) - davis(v_2))
LETTERS_10 = {r"\|v_1 - v_2\|": size_of_distance, r"\|f_d(v_1) - f_d(v_2)\|": size_of_change, "L_1": L_1, "L_2": L_2}
GENERAL = "Of the general resistance (8), the additional one being the same at both speeds."


@paper.claim("10.holds", "Assumption 5 where one of the speeds is bounded", "inequality",
             r"|v_2| \le v_{\max},\ L_1 \ge a_1 + 2a_2v_{\max},\ L_2 \ge a_2 \Rightarrow " + PRINTED_10, "proved",
             origin="ours", reading=f"Of v_1 on either side of v_2. {GENERAL}")
def lipschitz_for_bounded_speed() -> Goal:
    """The speeds v_2 + v_12 and v_2 - v_12 against v_2."""
    bound = L_1 * apart + L_2 * apart**2
    changes = [davis(v_2 + side * apart) - davis(v_2) for side in (1, -1)]
    return Goal(tuple(at_most(sign * change, bound) for change in changes for sign in (1, -1)),
                (*within(v_2, v_max), at_least(L_1, a_1 + 2 * a_2 * v_max), at_least(L_2, a_2)))


@paper.claim("10.everywhere", "Assumption 5 for all speeds", "inequality", PRINTED_10, "refuted", origin="ours",
             where=LETTERS_10, reading=f"With constants for all speeds. {GENERAL}",
             note="Whatever L_1 and L_2 are: v_2 = (L_1 + L_2)/(2 a_2) and v_1 = v_2 + 1 break it.")
def lipschitz_for_all_speeds() -> Goal:
    """The general resistance (8) at two speeds chosen after L_1 and L_2."""
    witness = (L_1 + L_2) / (2 * a_2)
    return Goal((at_most(size_of_change, L_1 * size_of_distance + L_2 * size_of_distance**2),),
                (equal(v_2, witness), equal(v_1, witness + 1)))
