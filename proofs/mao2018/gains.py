"""mao2018: damping k_1, k_2 for a wanted ball, leakage that bounds what the proof leaves unbounded, and their proof.

All of it is of the laws with the signs mended (claims 45, 61, 65): as printed no gains help, since theorem5 and remark4
fail for every one of them. (65) then bounds the mean of r_1 z_1^2 + r_2 z_2^2 by K = b_0^2/(4 k_1) + c_0^2/(4 k_2), and
nothing more; leakage adds the term in the estimation errors that makes V_2 itself bounded.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from workbench.gains.exact import fraction, rational, simplest
from workbench.gains.problem import Problem
from workbench.gains.result import Condition, GainReport, GainSet, Quantity
from workbench.gains.sampling import largest_period_s, sampled_map, stability_certificate
from workbench.gains.search import search
from workbench.gains.stated import Stated
from workbench.paper.gain_search import Ended, GainSearch, Runs, Task, changes_of
from workbench.paper.loading import Loaded
from workbench.paper.study import varied
from workbench.proof.claim import at_least, at_most
from workbench.simulate.closed_loop import run_law
from workbench.simulate.metrics import measure_run

from . import active_mode as active
from . import leakage, plant
from .laws import KINDS, failure_law
from .leakage import leak
from .leakage_proof import leakage_certificates
from .simulation.trip import initial, parameters, setting_of, wrong_signs
from .study.record import MaoStudy
from .study.runs import RunCase, late_errors

Values = dict[sp.Expr, sp.Expr]
BALL_M = Fraction(1, 10)  # wanted root mean square of z_1
LEAK_SHARE = Fraction(1, 10)  # by how much of K the leakage may raise the bound of the mean
TUNING = "scaled"


# --- the study's numbers, SI ----------------------------------------------------------------------------------------


def drag_bounds(stated: Stated) -> tuple[Fraction, Fraction]:
    """b_0 and c_0 of (59), 1/s and 1/m: the amplitudes of case 5 per unit of mass."""
    per_mass = 1 if stated.entry("readings.resistance") == "per tonne" else 1 / stated.number("train.mass_t")
    found = [Fraction(0), Fraction(0)]
    for term in stated.entry("drag"):
        found[term["speed_power"] - 1] += Fraction(str(term["amplitude"])) * per_mass
    return found[0], found[1]


def top_speed(stated: Stated) -> Fraction:
    """The highest desired speed, m/s."""
    return max(stated.numbers("reference.speeds_mps"))


def adaptation_gains(stated: Stated, regressors: str) -> Values:
    """The gains of (27)-(31), divided by the squares of the regressors' largest values where these are scaled."""
    at = {plant.x_2: rational(top_speed(stated)), plant.g: rational(stated.number("train.gravity_mps2"))}
    sizes = [sp.Integer(1) if regressors == "SI" else sp.sympify(by, strict=True).xreplace(at)
             for by in active.REGRESSORS]
    return {gain: rational(stated.number("law.gain")) / size**2 for gain, size in zip(active.gains, sizes, strict=True)}


def estimates_at_zero(stated: Stated) -> Fraction:
    """E_0: what zero estimates weigh in V_2, in the worst mode, one motor failed."""
    n, unit = stated.number("train.motors"), stated.number("law.force_unit_n")
    m = unit / (1000 * stated.number("train.mass_t"))
    per_mass = 1 if stated.entry("readings.resistance") == "per tonne" else 1 / stated.number("train.mass_t")
    turned = Fraction(1) if stated.entry("readings.angle") == "radian" else Fraction(str(math.pi / 180))
    gains = [fraction(x) for x in adaptation_gains(stated, TUNING).values()]
    modes = []
    for mode in stated.entry("modes"):
        true = [Fraction(str(mode[key])) * per_mass for key in ("a_kn", "b_kn_s_per_m", "c_kn_s2_per_m2")]
        true += [Fraction(str(mode["theta_deg"])) * turned, Fraction(str(mode["curve_deg"]))]
        modes.append(sum((x**2 / (2 * gain) for x, gain in zip(true, gains, strict=True)), Fraction(0)))
    push = max(Fraction(str(part.get("offset", 0))) ** 2 + Fraction(str(part.get("amplitude", 0))) ** 2
               for part in stated.entry("failure"))
    failed = m * push / (n * unit**2) / (2 * stated.number("law.gain_xi"))
    rho_k = m * (n - 1) / (n - 1) ** 2 / (2 * stated.number("law.gain_rho_k"))
    rho = m * (n - 1) / (m * (n - 1)) ** 2 / (2 * stated.number("law.gain_rho"))
    return max(modes) + failed + rho_k + rho


# --- damping for a ball ----------------------------------------------------------------------------------------------


def damping_problem(b_0: Fraction, c_0: Fraction, speed: Fraction, K: Fraction) -> Problem:
    """The least feedback k_1 v^2 + k_2 v^4 (1/s) of (62) at the top speed with b_0^2/(4 k_1) + c_0^2/(4 k_2) <= K."""
    t_1, t_2, x, y = sp.symbols("t_1 t_2 x y", real=True)
    k_1, k_2 = active.k_1, active.k_2
    v = rational(speed)
    scales = {k: b / (2 * K) * (b_0 + c_0 * speed) / speed**n for k, b, n in ((k_1, b_0, 1), (k_2, c_0, 2))}
    return Problem("mao2018:damping", (t_1, t_2, k_1, k_2), {
        "first bound": at_least(t_1 * x**2 + 2 * rational(b_0) * x * y + k_1 * y**2, 0),
        "second bound": at_least(t_2 * x**2 + 2 * rational(c_0) * x * y + k_2 * y**2, 0),
        "ball": at_most((t_1 + t_2) / 4, rational(K))},
        minimise=k_1 * v**2 + k_2 * v**4, scales=scales | {t_1: K, t_2: K})


def constant_of(b_0: Fraction, c_0: Fraction, k_1: Fraction, k_2: Fraction) -> Fraction:
    """K of (65)."""
    return b_0**2 / (4 * k_1) + c_0**2 / (4 * k_2)


def _loop(stated: Stated, regressors: str, k_1: Fraction, k_2: Fraction) -> Any:
    """The healthy train under (35), (62) at the top speed, without sign terms, and the sum zeta of its estimates.

    At a constant speed the estimates move as one; what they differ in has no effect, and rho_hat none to first order.
    """
    speed = rational(top_speed(stated))
    m = rational(stated.number("law.force_unit_n") / (1000 * stated.number("train.mass_t")))
    errors = {plant.z_1: plant.x_1 - plant.x_m, plant.z_2: plant.x_2 - active.alpha_1}
    true = active.zeta.xreplace(dict(zip(active.hats, active.trues, strict=True)))
    zero = dict.fromkeys((*active.hats, *active.trues, plant.x_1, plant.x_m, plant.xddot_m), sp.Integer(0))
    at = zero | adaptation_gains(stated, regressors) | dict.fromkeys(active.chis, sp.Integer(1)) | {
        plant.x_2: speed, plant.xdot_m: speed, active.m: m, active.rho_hat: 1 / m,
        active.k_1: rational(k_1), active.k_2: rational(k_2),
        plant.g: rational(stated.number("train.gravity_mps2")),
        plant.r_1: rational(stated.number(f"tunings.{regressors}.r_1_per_s")),
        plant.r_2: rational(stated.number(f"tunings.{regressors}.r_2_per_s"))}
    damped = active.nu_damp if k_1 else sp.Integer(0)
    together = sum((sp.diff(active.zeta, hat) * rate for hat, rate in active.estimate_laws.items()), sp.Integer(0))
    one = active.hats[0]  # in place of zeta, its regressor being 1
    command = (active.rho_hat * (damped + active.wanted)).xreplace({active.zeta: one}).xreplace(errors)
    return sampled_map({plant.x_1: plant.x_2, plant.x_2: active.m * plant.F - true}, plant.F, command,
                       {one: together.xreplace(errors)}, at, "corrected")


def report(stated: Stated) -> GainReport:
    """K and its ball for the study's k_1, k_2, the ones for a wanted ball, leakage with its proof, sampling periods."""
    b_0, c_0 = drag_bounds(stated)
    speed, r_1 = top_speed(stated), stated.number(f"tunings.{TUNING}.r_1_per_s")
    k = stated.number("law.k_1"), stated.number("law.k_2")
    wanted = r_1 * BALL_M**2
    found = search(damping_problem(b_0, c_0, speed, wanted), backoff=1e-3)
    mine = fraction(found.values[active.k_1]), fraction(found.values[active.k_2])
    E_0 = estimates_at_zero(stated)
    K_mine = constant_of(b_0, c_0, *mine)
    forget = simplest(float(LEAK_SHARE * K_mine / E_0), 0.05)
    slowest = min(2 * r_1, 2 * stated.number(f"tunings.{TUNING}.r_2_per_s"), forget)
    level = (K_mine + forget * E_0) / slowest
    certificates = [found.certificate, *leakage_certificates()]
    quantities, sampled = [], []
    for own in (k, mine):
        K = constant_of(b_0, c_0, *own)
        quantities.append(Quantity(
            f"root mean square of z_1 in the long run, k_1 = {float(own[0]):.3g}, k_2 = {float(own[1]):.3g}", "m", None,
            float(K / r_1) ** 0.5, "mao2018:remark4.mean", note=f"sqrt(K/r_1), K = {float(K):.3g} m^2/s^3; the paper's "
            f"remark 4 fails; feedback {float(own[0] * speed**2 + own[1] * speed**4):.3g} 1/s at {float(speed):g} m/s"))
    quantities.append(Quantity("ultimate bound of V_2 with leakage", "m^2/s^2", None, float(level),
                               "mao2018:leakage.rate", note=f"(K + leak E_0)/mu, E_0 = {float(E_0):.3g}; the paper's "
                               "proof has none (65.bounded)"))
    none = Fraction(0), Fraction(0)
    for label, words, regressors, own in (
            ("scaled", "(35), scaled regressors", "scaled", none), ("SI", "(35), regressors in SI units", "SI", none),
            ("damped", "with (62), the study's k_1, k_2", "scaled", k), ("found", "with (62), found k_1, k_2", "scaled",
                                                                         mine)):
        matrix = _loop(stated, regressors, *own)
        limit = largest_period_s(matrix)
        certified = float(simplest(0.95 * limit, 0.02))
        sampled.append(stability_certificate(f"mao2018:sampling.{label}", matrix(certified)))
        quantities.append(Quantity(f"sampling period, {words}", "s", None, certified, f"mao2018:sampling.{label}",
                                   limit, f"check: where the loop linearised at {float(speed):g} m/s loses stability"))
    gains = {str(active.k_1): mine[0], str(active.k_2): mine[1]}
    changes = {f"law.{name}": float(x) for name, x in gains.items()}
    conditions = (
        Condition("theorem 5", "V_2 bounded by (65)", "V_2 = 1 + 2 t obeys (65)", False, "mao2018:65.bounded"),
        Condition("remark 4", "large k_1, k_2 make z_1^2 small at every late instant", "false as printed", False,
                  "mao2018:remark4"),
        Condition("ball", f"sqrt(K/r_1) <= {float(BALL_M):g} m for the study's k_1, k_2",
                  f"{float(constant_of(b_0, c_0, *k) / r_1) ** 0.5:.3g} m", constant_of(b_0, c_0, *k) <= wanted),
    )
    return GainReport("mao2018", conditions, tuple(quantities), (
        GainSet("damping", f"least feedback (62) for a root mean square of z_1 of {float(BALL_M):g} m", gains,
                f"sqrt(K/r_1) = {float(K_mine / r_1) ** 0.5:.3g} m in the mean", found.problem.id, changes),
        GainSet("leakage", f"leakage that raises the bound of the mean by {float(LEAK_SHARE):.0%}, the same damping",
                gains | {str(leak): forget}, f"V_2 <= {float(level):.3g} m^2/s^2 in the long run",
                "mao2018:leakage.rate", changes),
    ), (*certificates, *sampled), (
        "k_1 and k_2 are not stated in the paper; those of the study's file stand for them.",
        "No best adaptation gains are offered: the bound of the mean is free of them, V_2(0) and E_0 fall as they "
        "grow, and what limits them, the sign terms and rho_hat when sampled, is not in the linearised loop.",
        "The bounds are between switches of modes and failures, each of which adds a finite amount to V_2 (46); "
        "estimates of failures shared by all modes need one mass in all of them (claim 45).",
        "The sign terms of (43) are left out of the linearised loop: sampled, they chatter at any period.",
    ), {found.problem.id: found.seconds})


# --- the runs with found gains beside the stated ones ---------------------------------------------------------------

CASE = 5


def tasks(report: GainReport) -> list[Task]:
    """The stated gains, the found damping, and leakage with and without it."""
    leak = float(next(s.values["leak"] for s in report.found if s.name == "leakage"))
    setting = f"case {CASE}, signs corrected"
    return [Task("stated", setting), Task("damping", setting, changes_of(report, "damping")),
            Task("leakage", setting, changes_of(report, "leakage"), {"leak": leak}),
            Task("leakage alone", setting, {}, {"leak": leak})]


def run(loaded: Loaded, task: Task) -> Ended:
    """The case under its law with signs corrected, with the task's changes and leakage."""
    study = loaded.study
    assert isinstance(study, MaoStudy)
    changed = varied(study, task.changes, "set")
    case, tuning = changed.cases[CASE - 1], changed.tunings[TUNING]
    law = failure_law("damped", KINDS["damped"][-1])
    named, start = parameters(changed, case, tuning), initial(changed, case)
    if "leak" in task.values:
        law, named = leakage.leaky(law), named | {"leak": task.values["leak"]}
    values = (np.array([named[str(s)] for s in law.parameters]),
              np.array([start[str(s.symbol)] for s in law.scalar_states]), np.zeros((0, 0)), np.zeros((0, 0)))
    run = run_law(law, values, setting_of(changed, case, tuning), tuning.period_s, changed.law.estimates,
                  plant=plant.train)
    return row(measure_run(run, float(changed.reference.curve().length_m)).row(), late_errors(run))


def had(loaded: Loaded, task: Task, runs: Runs) -> Ended | None:
    """The same from the study's own run with the stated gains."""
    study = loaded.study
    assert isinstance(study, MaoStudy)
    if task.changes or task.values:
        return None
    found = runs[RunCase(CASE, TUNING, wrong_signs(study.cases[CASE - 1]))]
    return row(found.row, found.late)


def row(of_run: Mapping[str, Any], late: tuple[float, float] | None) -> Ended:
    """The numbers of a run, by its metrics and its errors once the start is over."""
    rms, largest = late or (None, None)
    return {"position_rms": of_run["position_rms"], "speed_rms": of_run["speed_rms"], "settled_position_rms": rms,
            "settled_position_error": largest, "stopping_error": of_run["stopping_error"],
            "jerk_rms": of_run["jerk_rms"]}, of_run["failed"]


SEARCH = GainSearch(report, tasks, run, had=had)
