"""Theorem 1, step 2: the energy function of the first iteration is bounded, (36)-(45)."""

from __future__ import annotations

import sympy as sp

from workbench.proof.claim import D, Goal, at_most, equal, greater
from workbench.trains.multi_particle import over_cars, v

from ..energy_function import E_1, E, cef_flow, decay, estimation_terms
from ..error_dynamics import sums_named
from ..goal_forms import integrated
from ..laws import (
    M,
    M_tilde,
    Theta,
    Theta_tilde,
    c_3,
    driven_by,
    eta,
    gamma_mass,
    gamma_v,
    halved,
    learning_gains,
    learning_steps,
    squares,
    theta,
    tildes,
    true_parameters,
    v_dot,
    z_2,
)
from ..notation import ONE_CAR
from ..one_car import estimate, g_low, m_before, mass, mass_bound, mass_within, one_car
from ..paper import EACH_CAR, EVERY_TRAIN, paper
from .section_3_theorem_1_step_1_eq_26_to_31 import GAIN_LETTERS, LEARNED, OF_CARS, squares_of, tilde_i
from .section_3_theorem_1_step_1_eq_32_to_35 import each_estimate, mass_rule, room_below

TERMS_36 = (r"-c_{3}z_{2,i}^{T}\tilde{\Theta}_{\nu,1}\mathbf{v}_{1} + "
            r"\frac{1}{2\gamma_{\nu}}\operatorname{tr}\left(\tilde{\Theta}_{\nu,1}^{2}\right) - "
            r"c_{3}z_{2,1}^{T}\tilde{\theta}_{a,1}\phi(\mathbf{v}_{1}) + GAIN_A\tilde{\theta}_{a,1}^{2} - "
            r"c_{3}z_{2,1}^{T}\tilde{\theta}_{k,1}As_{1} + \frac{1}{2\gamma_{k}}\tilde{\theta}_{k,1}^{2} - "
            r"c_{3}z_{2,1}^{T}\tilde{\theta}_{d,1}A\mathbf{v}_{1} + \frac{1}{2\gamma_{d}}\tilde{\theta}_{d,1}^{2} - "
            r"c_{3}z_{2,1}^{T}\tilde{\eta}_{1} + \frac{1}{2\gamma_{\eta}}\left\|\tilde{\eta}_{1}\right\|^{2} + "
            r"c_{3}z_{2,1}\tilde{M}_{1}\dot{\mathbf{v}}_{1} + "
            r"\frac{1}{2\gamma_{M}}\operatorname{tr}\left(\tilde{M}_{1}^{2}\right)")
LINE_36 = r"\dot{E}_{1} = " + TERMS_36.replace("GAIN_A", r"\frac{1}{\gamma_{a}}")
TRUE_36 = (r"\dot{E}_{1} = -c_1\|z_{1,1}\|^2 - c_2\|z_{2,1}\|^2 "
           + TERMS_36.replace("GAIN_A", r"\frac{1}{2\gamma_{a}}").replace(r"z_{2,i}^{T}", r"z_{2,1}^{T}")
           .replace(r"z_{2,1}\tilde{M}", r"z_{2,1}^{T}\tilde{M}"))
FIRST = {"E_1": E, r"z_{2,1}\tilde{M}_{1}\dot{\mathbf{v}}_{1}": over_cars(z_2 * M_tilde * v_dot)}


def _first_rate(printed: bool) -> Goal:
    terms = sum((x / (2 * gain) for x, gain in zip(squares, learning_gains, strict=True)), sp.S.Zero)
    stated = sp.Add(*estimation_terms(z_2, tildes)) + terms + (0 if printed else decay)
    return Goal((equal(D(E), stated),), flow=cef_flow)


@paper.claim("36", "Rate of the CEF in the first iteration", "identity", LINE_36, "refuted", severity="cosmetic",
             premises=("24",), scope=EVERY_TRAIN, where=FIRST,
             reading="The index i of the first term is read as 1, z without its transpose as transposed, and 1/gamma_a, where a 2 "
                     "may be lost on the way from the page, as 1/(2 gamma_a), which (25) and (40) have.",
             note="The two squares of (24) are missing; with <= instead of = they may be left out, and (45) follows.")
def first_rate() -> Goal:
    """D(E_1) of (25) along the closed loop."""
    return _first_rate(printed=True)


@paper.claim("36.mended", "(36) with the squares of (24) and 1/(2 gamma_a)", "identity", TRUE_36, "proved",
             origin="ours", mends="36", premises=("24",), scope=EVERY_TRAIN, where=FIRST)
def first_rate_mended() -> Goal:
    """D(E_1) of (25) along the closed loop."""
    return _first_rate(printed=False)


first_errors = tuple(step - true for step, true in zip(learning_steps, true_parameters, strict=True))  # from hat_0 = 0
Theta_1 = first_errors[0]
ADDED_V = (r"-c_{3}z_{2,1}^{T}\tilde{\Theta}_{\nu,1}\boldsymbol{\nu}_{1} + "
           r"\frac{1}{2\gamma_{\nu}}\operatorname{tr}\left(\tilde{\Theta}_{\nu,1}^{2}\right)")
CHANGE_V = r"\frac{1}{2\gamma_{\nu}}\operatorname{tr}\left(\tilde{\Theta}_{\nu,1}^{2} - \tilde{\Theta}_{\nu,0}^{2}\right)"
DRIVEN_V = r"c_{3}z_{2,1}^{T}\tilde{\Theta}_{\nu,1}\boldsymbol{\nu}_{1}"
TRUE_V = r"\frac{1}{2\gamma_{\nu}}\operatorname{tr}\left(\Theta_{\nu}^{2}\right)"


@paper.claim("37", "The first estimate against the initial one", "identity",
             rf"{ADDED_V} = -{DRIVEN_V} + {CHANGE_V} + {TRUE_V}", "proved", scope=EVERY_TRAIN,
             where={r"\tilde\Theta_{\nu,0}": -Theta}, rests_on=("36",))
def first_estimate() -> Goal:
    """With the initial estimate 0 of (17)."""
    driven, now, before = -c_3 * over_cars(z_2 * Theta_tilde * v), Theta_tilde**2, (0 - Theta)**2
    return Goal((equal(driven + over_cars(now) / (2 * gamma_v),
                       driven + over_cars(now - before) / (2 * gamma_v) + over_cars(Theta**2) / (2 * gamma_v)),))


@paper.claim("38", "(27) without the integrals, in the first iteration", "inequality",
             rf"{CHANGE_V} \leq {DRIVEN_V}", "proved", premises=("27",), scope=EVERY_TRAIN,
             where={r"\tilde\Theta_{\nu,1}": Theta_1, r"\tilde\Theta_{\nu,0}": -Theta},
             note="(27) compares integrals; its proof holds at every instant, which is used here.")
def first_change() -> Goal:
    """With (17) from the initial estimate 0."""
    change = over_cars(Theta_1**2 - Theta**2) / (2 * gamma_v)
    return Goal((at_most(change, c_3 * over_cars(z_2 * Theta_1 * v)),))


DRIVEN_1 = {"v": r"z_{2,1}^{T}\tilde{\Theta}_{\nu,1}\boldsymbol{\nu}_{1}",
            "a": r"z_{2,1}^{T}\tilde{\theta}_{a,1}\phi(\mathbf{v}_{1})",
            "k": r"z_{2,1}^{T}\tilde{\theta}_{k,1}As_{1}", "d": r"z_{2,1}^{T}\tilde{\theta}_{d,1}A\boldsymbol{\nu}_{1}",
            "eta": r"\boldsymbol{z}_{2,1}^{T}\tilde{\boldsymbol{\eta}}_{1}"}
AT_TRUE = {"v": r"\operatorname{tr}\left(\Theta_{\nu}^{2}\right)", "a": r"\theta_{a}^{2}", "k": r"\theta_{k}^{2}",
           "d": r"\theta_{d}^{2}", "eta": r"\left\|\boldsymbol{\eta}\right\|^{2}"}


def _first_bound(number: int) -> None:
    """(39)-(43): what one estimate adds to the rate of E_1, against its true parameter."""
    x, change, equation, _ = LEARNED[number]
    gain, error, true = learning_gains[number], first_errors[number], true_parameters[number]
    summed = over_cars if OF_CARS[number] else sp.S
    half = rf"\frac{{1}}{{2\gamma_{{{GAIN_LETTERS[x]}}}}}"
    squared = rf"{chr(92) + 'operatorname{tr}(' if x == 'v' else ''}{squares_of(x, '1')}{')' if x == 'v' else ''}"
    driven = summed(driven_by[number] * error)
    where = {tilde_i(x, "1"): error, DRIVEN_1[x]: driven}

    @paper.claim(equation, f"The estimate with gain {gain} in the rate of the first CEF", "inequality",
                 rf"-c_{{3}}{DRIVEN_1[x]} + {half}{squared} \leq {half}{AT_TRUE[x]}", "proved",
                 premises=("37", "38") if x == "v" else (change,), scope=EVERY_TRAIN, where=where)
    def first_bound() -> Goal:
        return Goal((at_most(summed(error**2) / (2 * gain) - c_3 * driven, summed(true**2) / (2 * gain)),))


for number in range(5):
    _first_bound(number)

from_lowest = {m_before: g_low}  # M_hat_0 is the lower bound
DRIVEN_44 = r"z_{2,1}^{T}\tilde{M}_{1}\dot{\nu}_{1}"
SQUARE_44, TRUE_44 = (r"\operatorname{tr}\left(\tilde{M}_{1}^{2}\right)",
                      r"\operatorname{tr}\left((\underline{M}-M)^{2}\right)")
driven_44, square_44 = ((-mass_bound / c_3).xreplace(from_lowest), ((estimate - mass) ** 2).xreplace(from_lowest))


@paper.claim("44", "The estimate of the mass in the rate of the first CEF", "inequality",
             rf"c_{{3}}{DRIVEN_44} + \frac{{1}}{{2\gamma_{{M}}}}{SQUARE_44} \leq \frac{{1}}{{2\gamma_{{M}}}}{TRUE_44}",
             "proved", premises=("32", "33"), scope=EACH_CAR,
             where={**ONE_CAR, DRIVEN_44: driven_44, SQUARE_44: square_44, TRUE_44: (g_low - mass) ** 2})
def first_mass_bound() -> Goal:
    """With (22) from the lower bound, and Assumption 1."""
    return Goal((at_most(c_3 * driven_44 + square_44 / (2 * gamma_mass), (g_low - mass) ** 2 / (2 * gamma_mass)),),
                mass_within)


at_true = (over_cars(Theta**2), *(x**2 for x in theta), over_cars(eta**2), over_cars(room_below**4))


def _first_energy(bound: sp.Expr) -> Goal:
    """A bound of the rate of E_1 for every train; the first step of the mass starts from M_low = M - B^2."""
    wrong = (*first_errors, M_tilde)
    first = dict(zip(tildes, wrong, strict=True))
    added = tuple(now.xreplace(first) - true for now, true in zip(halved(squares), halved(at_true), strict=True))
    return Goal((at_most(D(E), bound),), (*sums_named, *mass_rule(M_tilde + room_below**2)),
                {x: rate.xreplace(first) for x, rate in cef_flow.items()}, lemmas=each_estimate(added, wrong))


REST_OF_45 = (r"\frac{1}{2\gamma_{a}} \theta_{a}^{2} + \frac{1}{2\gamma_{k}} \theta_{k}^{2} + \frac{1}{2\gamma_{d}} "
              r"\theta_{d}^{2} + \frac{1}{2\gamma_{\eta}} \left\|\boldsymbol{\eta}\right\|^{2} + "
              r"\frac{1}{2\gamma_{M}} \operatorname{tr}\left((\underline{M} - M)^{2}\right)")
LINE_45 = rf"\dot{{E}}_{{1}} \leq \frac{{1}}{{2}} \operatorname{{tr}}\left(\Theta_{{\nu}}^{{2}}\right) + {REST_OF_45}"
GAIN_45 = rf"\dot{{E}}_{{1}} \leq \frac{{1}}{{2\gamma_\nu}} \operatorname{{tr}}\left(\Theta_{{\nu}}^{{2}}\right) + {REST_OF_45}"
IN_45 = {"E_1": E, TRUE_44: at_true[-1]}
CAR_IN_45 = {**ONE_CAR, "E_1": one_car(E), TRUE_44: (g_low - one_car(M)) ** 2, AT_TRUE["v"]: one_car(Theta) ** 2,
             AT_TRUE["eta"]: one_car(eta) ** 2}


@paper.claim("45", "The rate of the first CEF is bounded", "inequality", LINE_45, "refuted",
             premises=("36.mended",), rests_on=("36", "39", "40", "41", "42", "43", "44"), glyph="45.glyph", where=CAR_IN_45,
             scope="one car at an instant with z_2 = 0",
             reading="Along the closed loop with the first estimates, which are the initial ones where z_2 = 0.",
             note="As the extracted text has it, without 1/gamma_v before tr(Theta_v^2), which (39) has. For gamma_v < 1 "
                  "this bound is false; at the stated gamma_v = 10 it holds. That E_1 is bounded follows either way, "
                  "see 45.bounded.")
def first_energy() -> Goal:
    """D(E_1) along the closed loop where z_2 = 0, so that all first estimates are the initial ones."""
    car_M, car_tilde = one_car(M), one_car(M_tilde)
    initial = {one_car(x): -one_car(true) for x, true in zip(tildes, true_parameters, strict=False)}
    rates = {one_car(x): one_car(rate).xreplace(initial | {car_tilde: g_low - car_M}) for x, rate in cef_flow.items()}
    bound = one_car(over_cars(Theta**2) / 2 + sp.Add(*halved(at_true)[1:5])) + (g_low - car_M) ** 2 / (2 * gamma_mass)
    domain = (greater(g_low, 0), at_most(g_low, car_M), *(at_most(one_car(x), 0) for x in (Theta, *theta)))
    return Goal((at_most(D(one_car(E)), bound),), (equal(one_car(z_2), 0), *domain), rates)


@paper.claim("45.glyph", "(45) with 1/gamma_v", "inequality", GAIN_45, "proved", origin="ours", glyph="45",
             premises=("22.form",), scope=EVERY_TRAIN, where=IN_45,
             note="From (25), the plant and the laws in one certificate; later claims rest on this one.")
def first_energy_with_gain() -> Goal:
    """D(E_1) along the closed loop with the first estimates."""
    return _first_energy(sp.Add(*halved(at_true)))


bound_rate, E_rate, clock = sp.symbols("beta w_E t", real=True)


@paper.claim("45.bounded", "E_1 is bounded on [0, T]", "implication",
             r"\text{It can draw conclusion from (45) that $E_1$ is bounded in the finite interval [0, T] since the right "
             r"side of (45) is a continuous iteration-independent function.}", "proved", match="words",
             premises=("45.glyph", "A3.lambda"), rests_on=("45",),
             reading="With beta the largest value of the right side of (45) on [0, T], E_1' <= beta and E_1(0) = 0 give "
                     "E_1(t) <= beta t.",
             note="It rests on solutions that exist on [0, T]; bounded parameters suffice, the paper asks for continuous "
                  "ones.")
def first_energy_bounded() -> Goal:
    """(45) integrated."""
    return integrated({clock: sp.Integer(1), E_1: E_rate}, at_most(E_1, bound_rate * clock),
                      (at_most(E_rate, bound_rate),), (bound_rate,))
