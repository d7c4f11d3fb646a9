"""jiao2025: for which step and weight a trip's errors shrink in the 2-norm, by how much, and what does better.

Two trials of (1) differ by z(k+1) = a z(k) + b Delta u(k) with a between that of the fastest and of the standing train
(claim 5.trials), so the map from trial to trial is a filter (`lifted.py`). With (14) and a fixed estimate it is one
number, g = b rho phi_hat/(lambda + phi_hat^2), that decides.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from workbench.gains.certificate import goal_certificate
from workbench.gains.exact import fraction, rational, simplest
from workbench.gains.lifted import Filter, bounded, exact_bound, fixed_gain, lanczos_norm, norm, norms
from workbench.gains.problem import Problem
from workbench.gains.result import Condition, GainReport, GainSet, Quantity
from workbench.gains.search import Found, largest, search
from workbench.gains.stated import Stated
from workbench.paper.gain_search import Ended, GainSearch, OwnRuns, Row, Task, changes_of
from workbench.paper.learning_comparison import rises
from workbench.proof.claim import Goal, at_least, at_most

from . import laws, plant
from .simulation.plans import Case
from .simulation.trials import TrialRun
from .study.record import JiaoStudy
from .study.runs import outcome, run_case

x, w = sp.symbols("x w", real=True)
p, contraction = sp.symbols("p theta_squared", real=True)
PER_SAMPLE = ("N", "kN", "mass")  # the readings in which k counts the samples of T_s
SHOWN = "kN"  # the reading that the found gains are simulated in: the one in which 1500 moves the train (claim u0.N)
CAUTION = Fraction(98, 100)  # of a border that was found, for gains given as decimals


@dataclass(frozen=True)
class Train:
    """Bounds of a of two trials at speeds from zero to the highest desired one, and b of a reading, exactly."""

    slow: Fraction
    fast: Fraction
    b: Fraction

    @property
    def range(self) -> tuple[Fraction, Fraction]:
        """The vertices of a."""
        return self.fast, self.slow


def train_of(stated: Stated, reading: str) -> Train:
    """By (1), (3), (17): 1 - a = (T_s/M)(b_1 + b_2 (v_i + v_prev)) at the ends of speed and coefficients."""
    step, mass = stated.number(f"readings.{reading}.step_s"), stated.number("train.mass_kg")
    unit = stated.number(f"readings.{reading}.unit_n")
    top = max(plant.desired_speed(at, i) for i, (low, high, _) in enumerate(plant.desired_pieces) for at in (low, high))
    numbers = {plant.T_s: rational(step), plant.M: rational(mass)}
    slope = sp.diff(plant.next_speed(plant.v_i, plant.u_i), plant.v_i).xreplace(numbers)  # at v: a for v_i = v_prev = v
    ends = []
    for sign, speed in ((1, top), (-1, sp.Integer(0))):
        at = {b: mean + sign * swing for b, (mean, swing) in plant.davis_newton.items()} | {plant.v_i: speed}
        ends.append(fraction(slope.xreplace({s: sp.sympify(v, strict=True) for s, v in at.items()})))
    b = sp.diff(plant.next_speed(plant.v_i, plant.unit * plant.u_i), plant.u_i).xreplace(numbers | {plant.unit: rational(unit)})
    return Train(ends[1], ends[0], fraction(b))


def gain(train: Train, rho: Fraction, lamda: Fraction, estimate: Fraction) -> Fraction:
    """g of (14) with a fixed estimate."""
    values = {laws.rho: rational(rho), laws.lamda: rational(lamda)}
    return train.b * fraction(laws.input_step(rational(estimate), sp.Integer(1)).xreplace(values))


# --- certificates ---------------------------------------------------------------------------------------------------


def dissipation(name: str, vertices: list[tuple[Fraction, Fraction, Fraction]], theta_squared: sp.Expr,
                size: tuple[Fraction, Fraction], minimise: sp.Expr | None = None) -> Problem:
    """One p for all samples: then the norm is at most theta for a trip of every length and every a(k) in the range.

    The condition is convex in a, so its ends suffice; a vertex is (a, b, d) of `Filter`. size: of w and p for x = 1.
    """
    conditions = {"weight": at_least(p, 0)}
    for number, (a, b, d) in enumerate(vertices):
        A, B, D_ = map(rational, (a, b, d))
        conditions[f"end {number + 1} of a"] = at_most((D_ * x - w) ** 2 + p * (A * w + B * x) ** 2,
                                                       theta_squared * x**2 + p * w**2)
    unknowns = (p, contraction) if minimise is not None else (p,)
    return Problem(f"jiao2025:{name}", unknowns, conditions, minimise=minimise, scales={w: size[0], p: size[1]})


def monotone_gain(train: Train) -> tuple[Fraction, Found]:
    """The largest g of (14) whose trips of every length are proved to get no worse."""
    def of(g: Fraction) -> Problem:
        return dissipation("monotone", [(a, a * g, 1 - g) for a in train.range], sp.Integer(1), (g, 1 / g))

    return largest(of, (1 - train.slow) / 10, 4 * (1 - train.slow), 1e-3)


def monotone_gain_at(train: Train, length: int) -> Fraction:
    """The largest g that is monotone over `length` samples, by the recursion, rounded down to three digits."""
    low, high = 0.0, 1.0
    while high - low > 1e-4 * high:
        grid = np.linspace(low, high, 34)[1:-1]
        good = bounded(np.ones_like(grid), [fixed_gain(float(a), grid) for a in train.range], length)
        first = int(np.argmin(good)) if not good.all() else len(grid)
        low, high = (float(grid[first - 1]) if first else low), (float(grid[first]) if first < len(grid) else high)
    return simplest(low * 0.999, 5e-4)


def best_contraction_at(train: Train, length: int) -> tuple[Fraction, float]:
    """The g of (14) with the least norm over `length` samples, and that norm."""
    most = float(monotone_gain_at(train, length))
    gains = np.linspace(0, most, 22)[1:]
    found = norms([fixed_gain(float(a), gains) for a in train.range], length)
    return simplest(float(gains[int(np.argmin(found))]), 1e-3), float(found.min())


def inverse_vertices(train: Train, g: Fraction) -> list[tuple[Fraction, Fraction, Fraction]]:
    """(18) with K_d on the difference, K_p + K_d = g/b and K_d = a_0 g/b: z - g e is left over where a is not a_0."""
    middle = simplest(float(train.slow + train.fast) / 2, 1e-7)
    return [(a, g * (a - middle), 1 - g) for a in train.range]


def difference_gains(train: Train, g: Fraction) -> tuple[Fraction, Fraction]:
    """K_p and K_d of (18) with K_d on the difference, see `inverse_vertices`."""
    middle = simplest(float(train.slow + train.fast) / 2, 1e-7)
    return (1 - middle) * g / train.b, middle * g / train.b


def best_difference(train: Train) -> tuple[Fraction, Found]:
    """The share g, in twentieths, with the least certified contraction per trial for every length and a(k)."""
    size = Fraction(1), 1 / (1 - train.slow)
    answers = {}
    for n in range(1, 20):
        g = Fraction(n, 20)
        answers[g] = search(dissipation("difference", inverse_vertices(train, g), contraction, size, contraction), 1e-3)
    best = min(answers, key=lambda g: float(answers[g].values[contraction]))
    return best, answers[best]


def horizon_step() -> dict[str, Any]:
    """The certificate of one step of the recursion that `lifted.exact_bound` takes in fractions, for all numbers."""
    a, b, d, later, now, square = sp.symbols("a b d p_later p_now theta_squared", real=True)
    room, of_w, cross = square - d**2 - later * b**2, now - 1 - later * a**2, d - later * a * b
    shown = room * (square * x**2 + now * w**2 - (d * x - w) ** 2 - later * (a * w + b * x) ** 2)
    return goal_certificate("jiao2025:horizon.step", Goal(
        (at_least(shown, 0),), (at_least(room, 0), at_least(room * of_w, cross**2)),
        lemmas=(at_least(shown, (room * x + cross * w) ** 2),)))


# --- the report -----------------------------------------------------------------------------------------------------


def _conditions(stated: Stated, length: int) -> tuple[list[Condition], list[Quantity]]:
    """The norm of (14) at the stated rho and lambda for every reading, estimate at dv(k+1)/du(k)."""
    conditions, quantities = [], []
    rho, lamda = stated.number("learning.rho"), stated.number("learning.lamda")
    for reading in PER_SAMPLE:
        train = train_of(stated, reading)
        g = gain(train, rho, lamda, train.b)
        of = fixed_gain(float(train.fast), float(g))
        whole = norm([of], length)
        claim = "jiao2025:intro.monotone." + reading  # states what holds: monotone, or not
        met = whole <= 1 + 1e-11
        conditions.append(Condition(
            f"monotone, u in {reading}", "2-norm of the map from trial to trial <= 1 at the stated rho, lambda",
            f"{whole:.6g} (g = {float(g):.3g})", met, claim if met else ""))
        quantities.append(Quantity(f"2-norm over {length} samples, u in {reading}", "", None, whole, claim,
                                   lanczos_norm(of, length), "check: Lanczos; a of the fastest train"))
    return conditions, quantities


def report(stated: Stated) -> GainReport:
    """Norms at the stated gains, the monotone step and weight, the largest contraction, and a law that contracts."""
    length = int(stated.number("trials.desired_length_k"))
    conditions, quantities = _conditions(stated, length)
    train, rho = train_of(stated, SHOWN), stated.number("learning.rho")
    every, found = monotone_gain(train)
    at_length = monotone_gain_at(train, length)
    vertices = [(a, a * at_length, 1 - at_length) for a in train.range]
    exact = exact_bound(vertices, Fraction(1), length)
    least, theta = best_contraction_at(train, length)
    above = Fraction(int(theta * 10**12) + 1, 10**12)
    shrinks = exact_bound([(a, a * least, 1 - least) for a in train.range], above**2, length) is not None
    share, difference = best_difference(train)
    theta_difference = float(difference.values[contraction]) ** 0.5
    quantities += [
        Quantity("largest g of (14) monotone for every length", "", None, float(every), found.problem.id,
                 2 * float(1 - train.slow), "check: 2 (1 - a) of the standing train, from the H-infinity norm at rest"),
        Quantity(f"largest g of (14) monotone over {length} samples", "", None,
                 float(at_length) if exact else float(every), "jiao2025:horizon.step",
                 note=f"{length} steps in fractions; claim intro.small has {2 / length / (length + 1):.3g}"),
        Quantity(f"least norm of (14) over {length} samples", "", None, theta, "jiao2025:horizon.step",
                 note=f"at g = {float(least):.3g}, {'in fractions' if shrinks else 'in floats'}: 1 - {1 - theta:.2g}, "
                      f"half of an error in {np.log(2) / (1 - theta):.2g} trials"),
        Quantity("contraction per trial of (18) with K_d on the difference", "", None, theta_difference,
                 difference.problem.id, norm([Filter(float(a), float(b), float(d)) for a, b, d in inverse_vertices(
                     train, share)], length), f"for every length; check: the recursion over {length} samples"),
    ]
    # (14) with whatever constant estimate: its largest g is b rho/(2 sqrt(lambda)) (claim intro.gain).
    weight = simplest(float((train.b * rho / (2 * CAUTION * every)) ** 2), 1e-3)
    at_truth = simplest(float(train.b**2 * (rho / (CAUTION * every) - 1)), 1e-3)
    K_p, K_d = difference_gains(train, share)
    estimate = {"learning.kept_estimate": "derivative"}
    sets = (
        GainSet("monotone", "largest step of (14) that never gets worse, estimate kept at dv(k+1)/du(k)",
                {"rho": rho, "lamda": at_truth}, f"g = {float(gain(train, rho, at_truth, train.b)):.3g}, norm <= 1",
                found.problem.id, {"learning.lamda": float(at_truth)} | estimate, "law jiao2025.fixed_estimate"),
        GainSet("monotone_any", "the same for every constant estimate", {"rho": rho, "lamda": weight},
                f"g <= {float(CAUTION * every):.3g}, norm <= 1", found.problem.id, {"learning.lamda": float(weight)},
                "law jiao2025.icfdl, whose estimates are not constant: not covered by the proof"),
        GainSet("difference", "least certified contraction of (18) with K_d on the difference of the errors",
                {"K_p": K_p, "K_d": K_d}, f"norm <= {theta_difference:.3g} per trial", difference.problem.id,
                {"learning.K_p": float(K_p), "learning.K_d": float(K_d)}, "law jiao2025.pd_difference"))
    return GainReport("jiao2025", tuple(conditions), tuple(quantities), sets,
                      (found.certificate, difference.certificate, horizon_step()), (
        "A fixed gain of (14) that is monotone hardly learns (claim intro.tradeoff): no rho, lambda or unit helps.",
        "The maps are those of full trials with the same f_a; trials that end early and resistances that change, which "
        "leave errors that no gains remove, are left to the simulation. The range of a is that of speeds between zero "
        "and the highest desired one, which the first trials may leave.",
    ), {found.problem.id: found.seconds, difference.problem.id: difference.seconds})


# --- the runs with found gains beside the stated ones ---------------------------------------------------------------

LAW_OF = {"monotone": "jiao2025.fixed_estimate", "monotone_any": "jiao2025.icfdl",
          "difference": "jiao2025.pd_difference"}
READING = "kN"
REPEATED = {"line.seen_by": "desired", "trials.shortest_length_k": 1999}  # what the certified maps suppose


def tasks(report: GainReport) -> list[Task]:
    """Each found set under its law; the difference law also with trials that repeat; the printed PD law beside it."""
    made = []
    for found in report.found:
        law = LAW_OF[found.name]
        setting = f"{law}, u in {READING}"
        made += [Task("stated", setting, {}, {"law": law}), Task(found.name, setting, found.changes, {"law": law})]
    difference = {"law": LAW_OF["difference"]}
    setting = f"{difference['law']}, u in {READING}, full trials with the same resistance"
    made += [Task(name, setting, {**changes, **REPEATED}, difference)
             for name, changes in (("stated", {}), ("difference", changes_of(report, "difference")))]
    return [*made, Task("stated", f"jiao2025.pd, u in {READING}", {}, {"law": "jiao2025.pd"})]


def case_of(study: JiaoStudy, task: Task) -> Case:
    """All trials of the task's law."""
    return Case(READING, task.values["law"], study.trials.seed)


def row(study: JiaoStudy, run: TrialRun) -> Ended:
    """The numbers of a run of all trials."""
    mse = run.mse
    numbers: Row = {f"mse_{n}": float(mse[n]) if n < len(mse) else None
                    for n in (0, *study.trials.compared, study.trials.count)}
    numbers |= {"trials_worse": rises(mse), "outcome": outcome(run)}
    return numbers, run.failed


RUNS = OwnRuns(case_of, run_case, row)
SEARCH = GainSearch(report, tasks, RUNS.run, had=RUNS.had)
