"""chen2019: what the auxiliary system (9) lets the saturation do to the tracking errors, and gains that let it do less.

With z = 0 the errors are those of (9): e_s = lambda_1 and e_v = lambda_1' (claim section4.converge). Their least L2
gains from Delta u are found by a semidefinite program along (9); chained with (10) and (35) they give bounds in place
of (54) and (55) that hold at the stated gains, where those of the paper are negative.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from workbench.gains.certificate import goal_certificate
from workbench.gains.exact import fraction, rational, simplest
from workbench.gains.frequency import h_infinity_norm, linear
from workbench.gains.problem import Problem
from workbench.gains.result import Condition, GainReport, GainSet, Quantity
from workbench.gains.search import Found, search
from workbench.gains.stated import Stated
from workbench.paper.gain_search import Ended, GainSearch, OwnRuns, Task, same_for_all
from workbench.paper.reproduced import RunCase
from workbench.proof.claim import D, Goal, at_least, at_most

from . import laws as law
from .laws import c_1, c_2, c_3
from .one_car import one_car
from .simulation.cars_trials import CarsRun
from .study.record import ChenStudy
from .study.runs import outcome, run_case

Values = dict[sp.Expr, sp.Expr]

P_11, P_12, P_22, GAIN = sp.symbols("p_11 p_12 p_22 gain_squared", real=True)
e_s, e_v = sp.symbols("e_s e_v", real=True)
lam_1, lam_2, delta_u, z_1, z_2 = (one_car(s) for s in (law.lambda_1, law.lambda_2, law.Delta_u, law.z_1, law.z_2))
AUXILIARY = {one_car(s): one_car(rate) for s, rate in law.auxiliary.items()}  # (9)
OUTPUTS = {"position": lam_1, "speed": AUXILIARY[lam_1]}  # e_s and e_v while z = 0
STORAGE = P_11 * lam_1**2 + 2 * P_12 * lam_1 * lam_2 + P_22 * lam_2**2


def _errors_of_z() -> dict[sp.Expr, sp.Expr]:
    """e_s and e_v by (10), (12) as functions of z and lambda."""
    put = {law.s: e_s + law.s_r, law.v: e_v + law.v_r}
    equations = [one_car(expr.xreplace(put)) - z for expr, z in (
        (law.errors[law.z_1], z_1), (law.errors[law.z_2], z_2))]
    return {s: sp.expand(value) for s, value in sp.solve(equations, (e_s, e_v)).items()}


def gain_problem(name: str, which: str, values: Values) -> Problem:
    """The least squared L2 gain from Delta u to the position or speed error, along (9)."""
    flow = {s: rate.xreplace(values) for s, rate in AUXILIARY.items()}
    one, two, three = (fraction(values[c]) for c in law.gains)
    # What the states are at the frequency of the largest gain for an error of 1: zero, or sqrt(c_1 c_2).
    if which == "position":
        sizes = {delta_u: one * two / three, lam_2: one, P_11: 1 / one, P_12: 1 / (one * two), P_22: 1 / (two * one**2)}
    else:
        slow = simplest(float(one * two) ** -0.5, 0.1)
        sizes = {delta_u: (one + two) / three, lam_1: slow, lam_2: max(Fraction(1), one * slow), P_11: one,
                 P_12: one / (one + two), P_22: 1 / (one + two)}
    return Problem(
        f"chen2019:{name}", (P_11, P_12, P_22, GAIN), {
            "storage": at_least(STORAGE, 0),
            "gain": at_most(D(STORAGE), GAIN * delta_u**2 - OUTPUTS[which].xreplace(values) ** 2)},
        flow, minimise=GAIN, scales=sizes | {GAIN: 1 / sizes[delta_u] ** 2})


def tracking_bound(name: str, which: str, found: Found, values: Values) -> dict[str, Any]:
    """The certificate of int e^2 <= 2 E_prev share + 2 gain^2 int Delta u^2 in place of (54), (55).

    From (10), (12), (9) and c_1 int z_1^2 + c_2 int z_2^2 <= E_prev (52), with a function that does not increase.
    """
    errors = {s: e.xreplace(values) for s, e in _errors_of_z().items()}
    error = errors[{"position": e_s, "speed": e_v}[which]]
    total, seen, pushed = sp.symbols("S Z Y", real=True)
    spent = sum((values[c] * z**2 for c, z in ((c_1, z_1), (c_2, z_2))), sp.Integer(0))
    flow = {s: rate.xreplace(values) for s, rate in AUXILIARY.items()}
    storage = STORAGE.xreplace(found.values)
    flow |= {total: error**2, seen: spent, pushed: delta_u**2}
    bound = at_most(total, 2 * share(which, values) * seen + 2 * found.values[GAIN] * pushed)
    return goal_certificate(f"chen2019:{name}", Goal(
        (bound,), flow=flow, initial=dict.fromkeys(flow, sp.Integer(0)), decreasing=2 * storage - bound.margin,
        lemmas=(at_least(storage, 0),), inputs=(delta_u,)))


def share(which: str, values: Values) -> sp.Expr:
    """The least factor of the energy (25) in the bound: the largest of e(z)^2 over c_1 z_1^2 + c_2 z_2^2 (Cauchy)."""
    error = _errors_of_z()[{"position": e_s, "speed": e_v}[which]].xreplace({lam_1: 0, lam_2: 0})
    return sum((sp.diff(error, z) ** 2 / c for z, c in ((z_1, c_1), (z_2, c_2))), sp.Integer(0)).xreplace(values)


def _conditions(stated: Stated, values: Values) -> list[Condition]:
    kept = [one_car(sp.sympify(c, strict=True)).xreplace(values) for c in law.c_lambda_candidates]
    high, mass = stated.number("mass_bounds.high_kg"), stated.number("train.car_mass_kg")
    room = rational(mass - high) + 1 / values[c_3]  # as in claim 16.stated
    return [
        Condition("c_lambda", "c_lambda = min(c_1 - 1/2, c_2 - 1/2 - c_3/2) > 0, below (49)", f"{float(min(kept)):.4g}",
                  bool(min(kept) > 0), "chen2019:49.stated", "(51), (54), (55) and part 3 of Theorem 1 rest on it"),
        Condition("c_z", "c_z = min(c_1, c_2) > 0, below (52)", f"{float(min(values[c_1], values[c_2])):.4g}",
                  bool(min(values[c_1], values[c_2]) > 0), "chen2019:52.stated"),
        Condition("loop", "m + 1/c_3 > the largest estimate of the mass (claim 16.unique)", f"{float(room):.4g} kg",
                  bool(room > 0), note="the mass bounds are assumed; one passenger of 80 kg more breaks it"),
    ]


def _papers_gain(values: Values) -> float | None:
    """What (51) says of either gain; None where c_lambda is not positive."""
    least = min(one_car(sp.sympify(c, strict=True)).xreplace(values) for c in law.c_lambda_candidates)
    return float(sp.sqrt(values[c_3] / (2 * least))) if least > 0 else None


def _proved(label: str, values: Values, seconds: dict[str, float],
            certificates: list[dict[str, Any]]) -> list[Quantity]:
    """Both gains with these values, and the tracking bounds that follow."""
    quantities = []
    for which, output in OUTPUTS.items():
        found = search(gain_problem(f"gain.{which}.{label}", which, values))
        seconds[found.problem.id] = found.seconds
        bound = tracking_bound(f"tracking.{which}.{label}", which, found, values)
        certificates += [found.certificate, bound]
        whole = linear(AUXILIARY, [delta_u], [output], values)
        unit = {"position": "m/N", "speed": "(m/s)/N"}[which]
        quantities += [
            Quantity(f"L2 gain from Delta u to the {which} error, {label}", unit, _papers_gain(values),
                     float(found.values[GAIN]) ** 0.5, found.problem.id, h_infinity_norm(whole),
                     "check: H-infinity norm of (9)"),
            Quantity(f"factor of E in the bound of the integral of the squared {which} error, {label}", "s",
                     2 / float(min(values[c_1], values[c_2])), 2 * float(share(which, values)), bound["claim"],
                     note="in place of 2/c_z of (54), (55)"),
        ]
    return quantities


def _least_product() -> dict[str, Any]:
    """No c_1, c_2 of the same sum has a smaller gain c_3/(c_1 c_2) than equal ones."""
    return goal_certificate("chen2019:bandwidth.best", Goal((at_least((c_1 + c_2) ** 2, 4 * c_1 * c_2),)))


def report(stated: Stated) -> GainReport:
    """Conditions, gains of (9) at the stated c_1, c_2, c_3, and the best ones of the same bandwidth."""
    values = stated.symbols("gains", law.gains)
    seconds: dict[str, float] = {}
    certificates: list[dict[str, Any]] = []
    quantities = _proved("stated", values, seconds, certificates)
    half = (values[c_1] + values[c_2]) / 2
    sets = []
    for label, own, objective in (
            ("repaired", values | {c_1: sp.Integer(1)}, "the smallest whole c_1 with c_lambda > 0"),
            ("best", values | {c_1: half, c_2: half}, "least gain to both errors with c_1 + c_2 and c_3 as stated")):
        mine = _proved(label, own, seconds, certificates)
        quantities += mine
        sets.append(GainSet(
            label, objective, {str(c): fraction(own[c]) for c in law.gains},
            "; ".join(f"{q.proved:.3g} {q.unit}" for q in mine[::2]), mine[0].certificate,
            {f"gains.{c}": float(own[c]) for c in law.gains}))
    certificates.append(_least_product())
    return GainReport("chen2019", tuple(_conditions(stated, values)), tuple(quantities), tuple(sets),
                      tuple(certificates), (
        "c_3 is no lever: by (16) Delta u grows as 1/c_3 while an input is saturated, so the least c_3/(c_1 c_2) at a "
        "given c_3 is asked for; 1/(c_1 c_2) is the gain per acceleration that is commanded and not had.",
        "No certificate beats c_3/(c_1 c_2): at rest lambda_1 = c_3/(c_1 c_2) Delta u for a constant Delta u.",
        "The bounds are of the law in continuous time with the same true parameters in every trial (claim 31.place)."),
        seconds)


# --- runs with the stated and the found gains -----------------------------------------------------------------------


def tasks(report: GainReport) -> list[Task]:
    """The stated and the found gains in the study's own run."""
    return same_for_all(report, "as stated")


def case_of(study: ChenStudy, task: Task) -> RunCase:
    """The study's run as stated, with whatever the task changes in the study."""
    return RunCase()


def row(changed: ChenStudy, run: CarsRun) -> Ended:
    """The numbers of a run of all trials."""
    if not len(run.totals):
        return {}, run.failed
    position, speed = run.position_error, run.speed_error
    whole = changed.reference.trip_time_s * changed.train.cars
    return {
        "position_error_first": float(position[0]), "position_error_last": float(position[-1]),
        "speed_error_first": float(speed[0]), "speed_error_last": float(speed[-1]),
        "position_rms": float(np.sqrt(run.total("position_error_square_s")[-1] / whole)),
        "speed_rms": float(np.sqrt(run.total("speed_error_square_s")[-1] / whole)),
        "bound_used": bound_used(run, changed), "outcome": outcome(run)}, run.failed


def bound_used(run: CarsRun, study: ChenStudy) -> float:
    """The largest part, over all trials, that the position errors fill of 2 int z_1^2 + 2 gain^2 int Delta u^2."""
    gains = study.gains
    gain = gains.c_3 / (gains.c_1 * gains.c_2)
    bound = 2 * run.total("z_1_square_s") + 2 * gain**2 * run.total("difference_square_s")
    return float(np.max(run.total("position_error_square_s") / bound))


RUNS = OwnRuns(case_of, run_case, row)
SEARCH = GainSearch(report, tasks, RUNS.run, had=RUNS.had, only_full=True)
