"""Theorem 1, step 1: the change of the composite energy function over an iteration, (26) to (31)."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from workbench.proof.claim import Goal, at_most, equal
from workbench.trains.multi_particle import each_car, s, v

from ..energy_function import V, V_before, V_now
from ..goal_forms import Integrals, integrated
from ..laws import (
    M,
    M_hat,
    c_3,
    driven_by,
    errors,
    gamma_eta,
    halved,
    lambda_1,
    lambda_2,
    learning_gains,
    learning_steps,
    s_r,
    true_parameters,
    v_r,
)
from ..one_car import one_car, z_car
from ..paper import EACH_CAR, EVERY_TRAIN, paper

A3_known = tuple(equal(one_car(x), y) for x, y in ((s, s_r), (v, v_r)))
V_start = one_car(V.xreplace(errors))


lambda_zero = (equal(one_car(lambda_1), 0), equal(one_car(lambda_2), 0))


def _starts_at_zero() -> Goal:
    return Goal((equal(V_start, 0),), (*A3_known, *lambda_zero))


@paper.claim("A3", "Assumption 3: with lambda(0) = 0, as before (51), V_i starts at zero", "implication",
             r"V_i(t) = \int_0^t \dot{V}_i(\tau) d\tau\ \text{indicated by Assumption 3}", "proved", match="words",
             severity="cosmetic", scope=EACH_CAR,
             reading="With s_i(0) = s_r(0) and v_i(0) = v_r(0) of Assumption 3, and lambda(0) = 0, which the paper calls a fact "
                     "before (51), V_i(0) = 0.",
             note="lambda(0) = 0 is used from (35) on, is stated only before (51), and does not come from Assumption 3: it "
                  "belongs into (9).")
def starts_at_zero() -> Goal:
    """V at the initial state, lambda included."""
    return _starts_at_zero()


@paper.claim("A3.lambda", "With the auxiliary state at zero V_i starts at zero", "implication",
             r"s_i(0) = s_r(0),\ v_i(0) = v_r(0),\ \lambda_{1,i}(0) = \lambda_{2,i}(0) = 0 \Rightarrow V_i(0) = 0",
             "proved", origin="ours", scope=EACH_CAR)
def starts_at_zero_with_lambda() -> Goal:
    """V at the initial state, lambda included."""
    return _starts_at_zero()


Theta_prev, eta_prev, M_prev = each_car("Theta_v_hat_prev eta_hat_prev M_hat_prev")
theta_prev = sp.symbols("theta_a_hat_prev theta_k_hat_prev theta_d_hat_prev", real=True)
hats_before = (Theta_prev, *theta_prev, eta_prev)
hats_now = tuple(hat + step for hat, step in zip(hats_before, learning_steps, strict=True))  # (17)-(21)
wrong_now = tuple(hat - true for hat, true in zip(hats_now, true_parameters, strict=True))
wrong_before = tuple(hat - true for hat, true in zip(hats_before, true_parameters, strict=True))
OF_CARS = (True, False, False, False, True)  # whether an estimate has one value per car


def tilde_i(x: str, i: str = "i") -> str:
    """The error of an estimate as a printed letter."""
    if x == "v":
        return rf"\tilde\Theta_{{\nu,{i}}}"
    if x == "eta":
        return rf"\tilde{{\boldsymbol{{\eta}}}}_{i if len(i) == 1 else '{' + i + '}'}"
    return rf"\tilde\theta_{{{x},{i}}}"


def squares_of(x: str, i: str) -> str:
    """The squared error of an estimate as it is printed under the integrals."""
    return rf"\left\|{tilde_i(x, i)}\right\|^2" if x == "eta" else rf"{tilde_i(x, i)}^2"


UPPER = {"k": r"{\tau}"}  # the extracted text of (29) has tau as the upper limit


def change_of(x: str, upper: str | None = None) -> str:
    """The integral of the change of a squared error, as (26)-(31) print it."""
    inside = rf"\left({squares_of(x, 'i')} - {squares_of(x, 'i-1')}\right)"
    return rf"\int_0^{upper or UPPER.get(x, 't')} {chr(92) + 'operatorname{tr}' if x == 'v' else ''}{inside} d\tau"


# The letter in the indices of the estimate; numbers of the lines on the change over an iteration and on the first
# iteration; what stands under the integral on the right of the former.
LEARNED = (("v", "27", "39", r"z_{2,i}^T\tilde{\Theta}_{\nu,i} \nu_{i}"),
           ("a", "28", "40", r"z_{2,i}^T \phi(\mathbf{v}_i) \tilde{\theta}_{a,i}"),
           ("k", "29", "41", r"z_{2,i}^T A s_i \tilde{\theta}_{k,i}"),
           ("d", "30", "42", r"z_{2,i}^T A \mathbf{v}_i \tilde{\theta}_{d,i}"),
           ("eta", "31", "43", r"\boldsymbol{z}_{2,i}^T \tilde{\boldsymbol{\eta}}_i"))
GAIN_LETTERS = {"v": r"\nu", "a": "a", "k": "k", "d": "d", "eta": r"\eta"}
MIDDLE_OF_27 = (r"\int_{0}^{t} \operatorname{tr} \left((\hat{\Theta}_{\nu,i-1} - \hat{\Theta}_{\nu,i})(2\Theta_{\nu} - "
                r"\hat{\Theta}_{\nu,i} - \hat{\Theta}_{\nu,i-1}) \right) d\tau",
                r"\int_{0}^{t} \operatorname{tr} \left((\hat{\Theta}_{\nu,i} - \hat{\Theta}_{\nu,i-1}) "
                r"\tilde{\Theta}_{\nu,i} \right) d\tau",
                r"\int_{0}^{t} \operatorname{tr} \left((\hat{\Theta}_{\nu,i-1} - \hat{\Theta}_{\nu,i})^{2} \right) "
                r"d\tau")


CHANGE_M = r"\int_0^t \operatorname{tr} \left(\tilde{M}_i^2 - \tilde{M}_{i-1}^2\right) d\tau"
in_26 = Integrals((c_3, *learning_gains))
pairs = (*zip(wrong_now, wrong_before, strict=True), (M_hat - M, M_prev - M))  # errors now and an iteration before
parts = tuple(in_26.over_cars if of_cars else in_26.of for of_cars in (*OF_CARS, True))
changes_26 = tuple(integral(now**2 - before**2) for integral, (now, before) in zip(parts, pairs, strict=True))
E_i, E_prev = (V_at + sp.Add(*halved(tuple(integral(pair[k] ** 2) for integral, pair in zip(parts, pairs, strict=True))))
               for V_at, k in ((V_now, 0), (V_before, 1)))  # (25)


@paper.claim("26", "The change of the CEF over an iteration", "identity",
             r"\Delta E_{i} = E_{i} - E_{i-1} = V_{i} - V_{i-1}"
             + "".join(rf" + \frac{{1}}{{2\gamma_{{{GAIN_LETTERS[x]}}}}} {change_of(x, 't')}" for x, *_ in LEARNED)
             + rf" + \frac{{1}}{{2\gamma_{{M}}}} {CHANGE_M}", "proved", scope=EVERY_TRAIN,
             where={r"\Delta E_i": E_i - E_prev, "E_i": E_i, "E_{i-1}": E_prev, "V_i": V_now, "V_{i-1}": V_before,
                    CHANGE_M: changes_26[-1],
                    **{change_of(x, "t"): change for (x, *_), change in zip(LEARNED, changes_26, strict=False)}},
             reading="E by (25) with the rules (17)-(21) put in; integrals are states, linear in the integrand.")
def change_of_the_cef() -> Goal:
    """E_i - E_{i-1} by (25), against V and integrals of changes."""
    return Goal((equal(E_i - E_prev, V_now - V_before + sp.Add(*halved(changes_26))),))


def _learning_bound(number: int) -> None:
    """(27)-(31): the change of an integral of squared errors of one estimate over an iteration."""
    x, equation, _, term = LEARNED[number]
    gain, now, before, true = (group[number] for group in (learning_gains, hats_now, hats_before, true_parameters))
    integrals = Integrals((c_3, gain))
    integral = integrals.over_cars if OF_CARS[number] else integrals.of
    change = integral((now - true) ** 2 - (before - true) ** 2)
    driven = integral((now - true) * driven_by[number])
    middle = (integral((before - now) * (2 * true - now - before)), integral((now - before) * (now - true)),
              integral((before - now) ** 2))
    index, driving = GAIN_LETTERS[x], rf"\int_0^{UPPER.get(x, 't')} {term} d\tau"
    left, right = rf"\frac{{1}}{{2\gamma_{{{index}}}}} {change_of(x)}", rf"c_3 {driving}"
    lines = "" if x != "v" else (
        rf"= \frac{{1}}{{2\gamma_{{\nu}}}} {MIDDLE_OF_27[0]} = \frac{{1}}{{\gamma_{{\nu}}}} {MIDDLE_OF_27[1]} - "
        rf"\frac{{1}}{{2\gamma_{{\nu}}}} {MIDDLE_OF_27[2]} ")
    keys = {change_of(x): change, driving: driven} | dict(zip(MIDDLE_OF_27, middle, strict=True))

    @paper.claim(equation, f"Change of the squared error with gain {gain}", "inequality", rf"{left} {lines}\le {right}",
                 "proved", scope=EVERY_TRAIN, where=keys, rests_on=(),
                 reading="Integrals are states that start at zero; that they are linear in the integrand is used.",
                 note="What is dropped is the square of the step. It supposes the same true parameter in both "
                      "iterations" + ("; see 31.place." if x == "eta" else "."))
    def bound() -> Goal:
        shown = at_most(change / (2 * gain), c_3 * driven)
        goal = integrated(integrals.rates, shown, constant=(c_3, gain))
        equalities = () if x != "v" else (
            equal(change / (2 * gain), middle[0] / (2 * gain)),
            equal(middle[0] / (2 * gain), middle[1] / gain - middle[2] / (2 * gain)))
        return replace(goal, show=(*equalities, *goal.show))


place, place_before, slope, tilde_eta = sp.symbols("s s_prev f_slope eta_tilde_prev", real=True)


@paper.claim("31.place", "(31) for an additional resistance that depends on the place", "implication",
             r"f^a_{i,j}(t) = f^a(s_{i,j}(t)) \Rightarrow \frac{1}{2\gamma_\eta}\left(\|\tilde\eta_i\|^2 - "
             r"\|\tilde\eta_{i-1}\|^2\right) \le c_3 z_{2,i}^T\tilde\eta_i", "gap", origin="ours", scope=EACH_CAR,
             rests_on=(), severity="data",
             reading="Below (3) the paper says that slopes, tunnels and bridges cause f^a, and takes it for a function of "
                     "time that no state enters; here it is one of the place, as these are.",
             note="For an f^a of time alone, as the paper assumes it, (31) and Theorem 1 stand as they are. Two iterations "
                  "are at different places at the same time, so that with slopes eta differs between them and (31) fails; "
                  "in the counterexample f^a is linear in the place. It limits what the theorem is about, not its proof.")
def same_place_in_every_iteration() -> Goal:
    """(31) at one instant with f^a = f_slope s."""
    hat = tilde_eta + slope * place_before + gamma_eta * c_3 * z_car
    tilde = hat - slope * place
    return Goal((at_most((tilde**2 - tilde_eta**2) / (2 * gamma_eta), c_3 * z_car * tilde),))


for number in range(5):
    _learning_bound(number)
