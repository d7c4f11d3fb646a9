"""Theorem 1, step 1: the estimate of the mass, and the composite energy function does not increase, (32) to (35)."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal
from workbench.proof.derive import lie_derivative
from workbench.trains.multi_particle import each_car, over_cars

from ..energy_function import Z_1, Z_2, V, V_before, V_now, decay, estimation_terms
from ..error_dynamics import flow, sums_named
from ..goal_forms import Integrals, both, carried, integrated
from ..laws import (
    M,
    M_hat,
    M_tilde,
    c_1,
    c_2,
    c_3,
    gains,
    gamma_mass,
    halved,
    learning_gains,
    learning_steps,
    limited,
    squares,
    tildes,
    v_dot,
    z_1,
    z_2,
)
from ..notation import ONE_CAR
from ..one_car import (
    estimate,
    g,
    g_high,
    g_low,
    h,
    mass,
    mass_bound,
    mass_change,
    mass_within,
    unbounded_step,
)
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from .section_3_theorem_1_step_1_eq_26_to_31 import CHANGE_M, M_prev

STEP_M = (r"\hat{M}_{i-1} - \gamma_{M} \cdot c_{3} \cdot \mathcal{D}(z_{2,i}) \cdot \mathcal{D}(\dot{\mathbf{v}}_{i})")
SAT_M = rf"\operatorname{{sat}}({STEP_M}, \underline{{M}}, \overline{{M}})"
PROJECTED = rf"\operatorname{{tr}} \left(({STEP_M} - \hat{{M}}_{{i}}) (M - {SAT_M}) \right)"
FIRST_32 = r"\int_{0}^{t} \operatorname{tr} \left((\hat{M}_{i-1} - \hat{M}_{i})(M - \hat{M}_{i}) \right) d\tau"
SECOND_32 = rf"\int_{{0}}^{{t}} {PROJECTED} d\tau"
LAST_32 = (r"\int_{0}^{t} \operatorname{tr} \left(\mathcal{D}(z_{2,i}) \cdot \mathcal{D}(\dot{\mathbf{v}}_{i}) \cdot "
           r"\tilde{M}_{i} \right) d\tau")
in_32 = Integrals((c_3, gamma_mass))
change_32 = in_32.over_cars((M_hat - M) ** 2 - (M_prev - M) ** 2)
first_32 = in_32.over_cars((M_prev - M_hat) * (M - M_hat))
second_32 = in_32.over_cars((M_prev - gamma_mass * c_3 * z_2 * v_dot - M_hat) * (M - M_hat))
last_32 = in_32.over_cars(z_2 * v_dot * (M_hat - M))


@paper.claim("32", "Change of the integral for the mass", "inequality",
             rf"\frac{{1}}{{2\gamma_M}} {CHANGE_M} \leq \frac{{1}}{{\gamma_{{M}}}} {FIRST_32} = \frac{{1}}{{\gamma_{{M}}}} "
             rf"{SECOND_32} - c_{{3}} {LAST_32}", "proved", scope=EVERY_TRAIN,
             where={CHANGE_M: change_32, FIRST_32: first_32, SECOND_32: second_32, LAST_32: last_32},
             reading="The saturated value is the estimate M_hat_i, by (22). Integrals are states, linear in the "
                     "integrand.",
             note="What is dropped is the square of the step. The text calls it the sixth term on the right of (26); "
                  "counted as its 'third term' is, it is the eighth.")
def mass_step_limited() -> Goal:
    """The dropped square, and (22) put in."""
    goal = integrated(in_32.rates, at_most(change_32 / (2 * gamma_mass), first_32 / gamma_mass),
                      constant=(c_3, gamma_mass))
    return replace(goal, show=(*goal.show, equal(first_32 / gamma_mass, second_32 / gamma_mass - c_3 * last_32)))


@paper.claim("33.property", "With sat(g) in the first bracket (6) at gamma = 0 has the left side of (33), for any h", "identity",
             r"[(\gamma+1)g - (\gamma h + \operatorname{sat}(g, \underline{g}, \overline{g}))][h - \operatorname{sat}(h, \underline{g}, "
             r"\overline{g})] \le 0,\ \text{Using Property 1 and letting } \gamma = 0", "refuted", match="words",
             glyph="33.property.glyph",
             scope="numbers g, h and bounds of g",
             reading="With g for M and h for the value that is saturated, the left side of (33) is that of (6) at gamma = 0. It is asked "
                     "for any h, as (33) needs it, without 'h = sat(g, ...)' behind (6).",
             note="With h = sat(g, ...), as extracted, (6) says 0 <= 0, and (33) does not follow from it; without it (6) has sat(g), "
                  "which is g, where (33) needs sat(h). (33) is true, and so is (6) with sat(h), for every h and g_low <= g <= "
                  "g_high.")
def property_used() -> Goal:
    """(6) as extracted at gamma = 0, without what is said of h, against the product of (33)."""
    rest = h - limited(h, g_low, g_high)
    return Goal((equal((g - limited(h, g_low, g_high)) * rest, (g - limited(g, g_low, g_high)) * rest),),
                (at_most(g_low, g), at_most(g, g_high)))


@paper.claim("33.property.glyph", "With sat(h) in (6) its left side at gamma = 0 is that of (33)", "identity",
             r"\gamma = 0:\ [(\gamma+1)g - (\gamma h + \operatorname{sat}(h, \underline{g}, \overline{g}))][h - \operatorname{sat}(h, "
             r"\underline{g}, \overline{g})] = [g - \operatorname{sat}(h, \underline{g}, \overline{g})][h - \operatorname{sat}(h, "
             r"\underline{g}, \overline{g})]", "proved", origin="ours", glyph="33.property", scope="numbers g, h and bounds of g")
def property_read_otherwise() -> Goal:
    """(6) with sat(h) in its first bracket, against the product of (33)."""
    gamma, inside = sp.Symbol("gamma", nonnegative=True), limited(h, g_low, g_high)
    return Goal((equal(((gamma + 1) * g - (gamma * h + inside)) * (h - inside), (g - inside) * (h - inside)),),
                (equal(gamma, 0),))


@paper.claim("33", "Property 1 applied to the estimate of the mass", "inequality",
             rf"{PROJECTED} \leq 0", "proved", premises=("6.mended",), rests_on=("33.property",), scope=EACH_CAR,
             where={**ONE_CAR, PROJECTED: (unbounded_step - estimate) * (mass - estimate)},
             note="It follows from Property 1 as [38] has it (6.mended), not from (6) as printed, which says 0 <= 0 for "
                  "gamma = 0.")
def mass_projection() -> Goal:
    """With Assumption 1."""
    return Goal((at_most((unbounded_step - estimate) * (mass - estimate), 0),), mass_within)


left, right = sp.symbols("L R", real=True)
RIGHT_34 = r"\int_0^t z_{2,i}^T \tilde{M}_i \dot{v}_i d\tau"


@paper.claim("34", "Bound of the change for the mass", "inequality",
             rf"\frac{{1}}{{2\gamma_M}} {CHANGE_M} \le -c_3 {RIGHT_34}", "proved", premises=("32", "33"), scope=EACH_CAR,
             where={CHANGE_M: left, RIGHT_34: right},
             reading="L and R are the two integrals, with (22) as it stands under them.")
def mass_integral() -> Goal:
    """Between integrals, with (22) as it stands and Assumption 1 at every instant."""
    return integrated({left: 2 * gamma_mass * mass_change, right: -mass_bound / c_3},
                      at_most(left / (2 * gamma_mass), -c_3 * right), mass_within,
                      (c_3, gamma_mass, mass, g_low, g_high))


@paper.claim("22.form", "The saturation of (22), without cases", "identity",
             r"\hat m = \mathrm{sat}(h,\underline m,\overline m),\ p = \max(h - \overline m, 0),\ q = "
             r"\max(\underline m - h, 0) \Rightarrow \hat m = h - p + q,\ p(\overline m - \hat m) = q(\hat m - "
             r"\underline m) = 0",
             "proved", origin="ours", scope=EACH_CAR,
             note="The form in which (22) enters 35.whole and 45.glyph, where it stands under a sum.")
def saturation_form() -> Goal:
    """Complementarity of the projection on an interval."""
    sat, p, q_ = limited(h, g_low, g_high), sp.Max(h - g_high, 0), sp.Max(g_low - h, 0)
    return Goal((*both(sat, h - p + q_), *both(p * (g_high - sat), sp.S.Zero), *both(q_ * (sat - g_low), sp.S.Zero)),
                (at_most(g_low, g_high),))


# (22) under the sums: M_hat_i = M_hat_prev - gamma_M c_3 z_2 v_dot - P^2 + Q^2 with P^2 (M_high - M_hat_i) = 0 =
# Q^2 (M_hat_i - M_low), and Assumption 1: M_high = M + d_high^2, M_low = M - d_low^2 (22.form).
P, Q, room_above, room_below, M_step = each_car("P Q d_high d_low M_step")


def mass_rule(step: sp.Expr) -> tuple[Relation, ...]:
    """(22) times M_tilde, for a step M_hat_i - M_hat_prev, and its complementarity, which hold car by car."""
    return (equal(over_cars(M_tilde * (step + gamma_mass * c_3 * z_2 * v_dot + P**2 - Q**2)), 0),
            equal(over_cars(P**2 * (room_above**2 - M_tilde)), 0),
            equal(over_cars(Q**2 * (M_tilde + room_below**2)), 0))


def each_estimate(left_sides: tuple[sp.Expr, ...], wrong: tuple[sp.Expr, ...]) -> tuple[Relation, ...]:
    """Lemmas: Property 1 under the sum, and each left side against minus its term of `estimation_terms`."""
    terms = zip(left_sides, estimation_terms(z_2, wrong), strict=True)
    return (at_least(over_cars(M_tilde * (P**2 - Q**2)), 0), *(at_most(x, -term) for x, term in terms))


rolling_before, *scalars_before, rest_before = (x - step for x, step in zip(tildes, learning_steps, strict=False))
squares_before = (over_cars(rolling_before**2), *(x**2 for x in scalars_before), over_cars(rest_before**2),
                  over_cars((M_tilde - M_step) ** 2))
each_change = tuple(now - before for now, before in zip(halved(squares), halved(squares_before), strict=True))
changes_by_rules = sp.Add(*each_change)


@paper.claim("35.whole", "The CEF does not increase: the whole argument in one certificate", "implication",
             r"\frac{d}{dt}(E_i - E_{i-1} + V_{i-1}) \le -c_1\|z_{1,i}\|^2 - c_2\|z_{2,i}\|^2\ \text{along (7), (9), "
             r"(16) with (17)-(22)}", "proved", origin="ours", match="words", premises=("22.form",), scope=EVERY_TRAIN,
             note="The checker derives V' from (23), the plant and the law by itself and puts the learning rules in, "
                  "without resting on the paper's intermediate lines. Integrated in 35 and 35.kept.")
def cef_whole() -> Goal:
    """D(V) along the closed loop, and the change of all squares by the learning rules."""
    return Goal((at_most(D(V) + changes_by_rules, decay),), (*sums_named, *mass_rule(M_step)), flow,
                lemmas=each_estimate(each_change, tildes))


changes = sp.Symbol("C", real=True)
INT_Z_1, INT_Z_2 = (rf"\int_0^t \left\| z_{{{k},i}} \right\|^2 d\tau" for k in (1, 2))
DELTA_E = {r"\Delta E_i": V_now - V_before + changes, INT_Z_1: Z_1, INT_Z_2: Z_2, "V_{i-1}": V_before}


def _cef_step(with_v_before: bool) -> Goal:
    """E_i - E_{i-1} = V_i - V_{i-1} + C, C being the changes of the integrals by (26); V_i, Z_1, Z_2 start at zero."""
    rates = {V_now: lie_derivative(V, flow), changes: changes_by_rules, Z_1: over_cars(z_1**2), Z_2: over_cars(z_2**2)}
    bound = -c_1 * Z_1 - c_2 * Z_2
    shown = at_most(V_now - V_before + changes, bound - V_before if with_v_before else bound)
    whole = carried(paper.shown("35.whole"), flow)
    goal = integrated(rates, shown, whole, (*gains, *learning_gains), decreasing=V_now + changes - bound)
    given = (*goal.assume, at_least(V_before, 0), at_least(Z_1, 0), at_least(Z_2, 0))  # integrals of squares
    return replace(goal, show=goal.show if with_v_before else (*goal.show, at_most(bound, 0)), assume=given)


PREMISES_35 = ("35.whole", "A3.lambda")
CHAIN_35 = ("24", "26", "27", "28", "29", "30", "31", "34")


@paper.claim("35", "The CEF does not increase", "implication",
             rf"\Delta E_{{i}} \leq -c_{{1}} {INT_Z_1} - c_{{2}} {INT_Z_2} \leq 0", "proved", premises=PREMISES_35,
             rests_on=CHAIN_35, scope=EVERY_TRAIN, where=DELTA_E,
             reading="E_i - E_{i-1} is V_i - V_{i-1} and the integrals' changes, as (26) has it; for i >= 2, since no V_0 is defined.",
             note="Under A3.lambda, on which V_i(0) = 0 rests. The term -V_{i-1}(t) is dropped; see 35.kept.")
def cef_step() -> Goal:
    """35.whole integrated."""
    return _cef_step(with_v_before=False)


@paper.claim("35.kept", "The change of the CEF with the term that (35) drops", "implication",
             rf"\Delta E_{{i}} \leq -V_{{i-1}} - c_{{1}} {INT_Z_1} - c_{{2}} {INT_Z_2}", "proved", origin="ours",
             premises=PREMISES_35, scope=EVERY_TRAIN, where=DELTA_E,
             note="What the paper's own steps give; the convergence at every instant needs this term.")
def cef_step_kept() -> Goal:
    """35.whole integrated."""
    return _cef_step(with_v_before=True)
