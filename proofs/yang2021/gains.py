"""yang2021: what (49)-(57) prove at the stated gains, a better bound of the same loop, and gains that are proved.

The network is taken as absent from the proof, W* = 0: then (7) holds everywhere with eps* = f*, the largest resistance
of the line (claim A2), and nothing rests on the approximation. All bounds are of the continuous loop; the sampled one
is looked at linearised at cruise speed.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp

from workbench.gains.certificate import goal_certificate
from workbench.gains.exact import fraction, rational, simplest
from workbench.gains.frequency import Linear, margins
from workbench.gains.problem import Problem
from workbench.gains.result import Condition, GainReport, GainSet, Quantity
from workbench.gains.sampling import Array, largest_period_s, sampled_map, stability_certificate
from workbench.gains.search import search
from workbench.gains.stated import Stated
from workbench.model.desired_curve import davis_cruise_speed
from workbench.model.law import desired_acceleration, desired_position, desired_speed
from workbench.paper.gain_search import GainSearch, Row, Task, same_for_all
from workbench.paper.loading import Loaded
from workbench.proof.claim import D, Goal, at_least, at_most
from workbench.simulate.closed_loop import simulate
from workbench.simulate.metrics import measure
from workbench.trains.scenario import Variant, changed_scenario
from workbench.trains.train import a_star, b_star, c_star, f, single_particle_per_mass, u

from . import laws as law
from . import lyapunov
from .error_dynamics import STATED_F_STAR, e_1, e_2, eps_star, epsilon, flow
from .gain_front import FRONT

Values = dict[sp.Expr, sp.Expr]
POSITION_M, SPEED_MPS = Fraction(1, 5), Fraction(3, 10)
LEVEL = Fraction(36, 1000)  # of V: sqrt(2 V) + alpha |e_1| below 0.3 m/s, see `wanted_bounds`
LAMBDAS, SIGMAS, STARS = (law.lambda_1, law.lambda_2, law.lambda_3), (law.sigma_1, law.sigma_2, law.sigma_3), (
    a_star, b_star, c_star)
GAINS = (law.alpha, law.beta, law.chi, law.k, *LAMBDAS, *SIGMAS)
CONTROLLER = "controllers.rbfnn_pocrac"


def stated_values(stated: Stated) -> Values:
    """Gains and Davis coefficients as stated."""
    davis = [stated.number(f"train.{name}") for name in ("davis_a_mps2", "davis_b_per_s", "davis_c_per_m")]
    return stated.symbols(f"{CONTROLLER}.parameters", GAINS) | {
        s: rational(x) for s, x in zip(STARS, davis, strict=True)}


def mu_of(values: Values) -> sp.Expr:
    """The decay rate (49)."""
    return min(r.right.xreplace(values) for r in lyapunov.slowest)


def offset(values: Values, f_star: sp.Expr) -> sp.Expr:
    """l of (50) without network: W* = 0, eps* = f*."""
    return lyapunov.l_stated.xreplace({lyapunov.W_star_square: sp.Integer(0), eps_star: f_star}).xreplace(values)


def start_level(stated: Stated, values: Values) -> sp.Expr:
    """V at the start: the errors are zero, the estimates are not right."""
    wrong = [rational(stated.number(f"{CONTROLLER}.initial.{hat}")) - values[star]
             for hat, star in zip(("a_hat", "b_hat", "c_hat"), STARS, strict=True)]
    return sum((w**2 / (2 * values[lam]) for w, lam in zip(wrong, LAMBDAS, strict=True)), sp.Integer(0))


def mean_square(values: Values, f_star: sp.Expr, share: Fraction, label: str) -> tuple[Quantity, Any]:
    """The best bound of the mean of e_2^2 along the loop itself: V' <= -q e_2^2 + l, q = (1 - share) beta.

    Unlike (51) it asks nothing of the estimates' decay, which at the stated gains is what makes (53) useless.
    """
    spent = rational(share) * values[law.beta]
    q = values[law.beta] - spent
    gains = {s: values[s] for s in GAINS}  # the train's coefficients stay symbols: the certificate holds for any
    of_leak = sum((gains[s] * x**2 / 4 for s, x in zip(SIGMAS, STARS, strict=True)), sp.Integer(0))
    l_mean = eps_star**2 / (4 * spent) + lyapunov.W_star_square / 4 + of_leak
    along = {s: rate.xreplace(gains) for s, rate in flow.items()}
    rate = D(lyapunov.V.xreplace(gains))
    barrier = values[law.alpha] * e_1**2 / (values[law.k] ** 2 - e_1**2)
    inside = lyapunov.inside.subs(values)
    claim = f"yang2021:mean_square.{label}"
    certificate = goal_certificate(claim, Goal(
        (at_most(rate, -q * e_2**2 + l_mean),), (inside, *lyapunov.error_bound), along, lemmas=(
            at_most(epsilon**2, eps_star**2), at_most(rate, -barrier - q * e_2**2 + l_mean))))
    bound = l_mean.xreplace({lyapunov.W_star_square: sp.Integer(0), eps_star: f_star}).xreplace(values) / q
    ultimate = sp.sqrt(2 * offset(values, f_star) / mu_of(values))
    return Quantity(f"root mean square of e_2 in the long run, {label}", "m/s", float(ultimate), float(sp.sqrt(bound)),
                    claim, note="the paper's: its ultimate bound sqrt(2 l/mu) of (53)"), certificate


def best_share(values: Values, f_star: sp.Expr) -> Fraction:
    """The part of beta spent on the disturbance that makes the bound of `mean_square` least, in hundredths."""
    beta = float(values[law.beta])
    leak = float(sum(values[s] * values[x] ** 2 / 4 for s, x in zip(SIGMAS, STARS, strict=True)))

    def bound(hundredths: int) -> float:
        part = hundredths / 100
        return (float(f_star) ** 2 / (4 * part * beta) + leak) / ((1 - part) * beta)

    return Fraction(min(range(1, 100), key=bound), 100)


def adaptation_problem(values: Values, f_star: sp.Expr, speed: Fraction) -> Problem:
    """The slowest adaptation whose level l/mu is low enough: least (rad/s)^2 of the loop through the estimates.

    That loop turns at sqrt(lambda_1 + lambda_2 v^2 + lambda_3 v^4), which the sampling must bear (claim 36.sampling).
    Each theta*^2/lambda <= t is a matrix inequality.
    """
    room = sp.symbols("t_a t_b t_c", real=True)
    x, y = sp.symbols("x y", real=True)
    conditions = {f"room of {star}": at_least(t * x**2 + 2 * values[star] * x * y + lam * y**2, 0)
                  for t, star, lam in zip(room, STARS, LAMBDAS, strict=True)}
    budget = rational(LEVEL) - f_star**2 / 2  # with mu = 1
    conditions["level"] = at_most(sum(room, sp.Integer(0)) / 2, budget)
    weights = [rational(speed) ** (2 * n) for n in range(3)]
    sizes = {star: fraction(values[star]) for star in STARS}
    scales = {lam: sizes[star] / (2 * fraction(budget)) * Fraction(6, 10) / speed**n
              for n, (lam, star) in enumerate(zip(LAMBDAS, STARS, strict=True))}
    scales |= {t: fraction(budget) for t in room}
    return Problem("yang2021:adaptation", (*room, *LAMBDAS), conditions, minimise=sum(
        (w * lam for w, lam in zip(weights, LAMBDAS, strict=True)), sp.Integer(0)), scales=scales)


def proved_gains(found: dict[Any, sp.Rational], values: Values) -> Values:
    """mu = 1 with alpha as stated: beta = chi = 1 and sigma_i = 1/lambda_i."""
    lambdas = {lam: rational(simplest(float(found[lam]) * 1.002, 1e-3)) for lam in LAMBDAS}
    return values | {law.alpha: sp.Rational(1, 2), law.beta: sp.Integer(1), law.chi: sp.Integer(1)} | lambdas | {
        s: 1 / lambdas[lam] for s, lam in zip(SIGMAS, LAMBDAS, strict=True)}


def reached(values: Values) -> tuple[sp.Rational, sp.Rational]:
    """What |e_1| (m) and |e_2| (m/s) are at most while V is at most LEVEL, rounded upwards."""
    return (rational(simplest(float(values[law.k]) * (1 - np.exp(-2 * float(LEVEL))) ** 0.5 * 1.001, 5e-4)),
            rational(simplest((2 * float(LEVEL)) ** 0.5 * 1.001, 5e-4)))


def wanted_bounds(stated: Stated, values: Values, f_star: sp.Expr) -> dict[str, Any]:
    """The certificate that these gains keep |e_1| and |e_1'| within what is `reached`, and so within 0.2 m and 0.3 m/s,
    at all times, from the stated start.

    V(0) and l/mu are at most LEVEL, so V is (theorem1.zeta); then e_2^2 <= 2 V and e_1^2 <= k^2 (1 - exp(-2 V))
    (theorem1.barrier), and e_1' = e_2 - alpha e_1.
    """
    level = rational(LEVEL)
    reach, fast = reached(values)
    slowest = tuple(r.subs(values | {lyapunov.mu: mu_of(values)}) for r in lyapunov.slowest)
    shown = (*slowest, at_most(offset(values, f_star), mu_of(values) * level),
             at_most(start_level(stated, values), level),
             at_most(values[law.k] ** 2 * (1 - sp.exp(-2 * level)), reach**2), at_most(2 * level, fast**2),
             at_most(reach, rational(POSITION_M)), at_most(fast + values[law.alpha] * reach, rational(SPEED_MPS)))
    return goal_certificate("yang2021:bounds.found", Goal(shown))


def _loop(values: Values, speed: Fraction) -> Any:
    """The sampled loop linearised at a constant speed on level track; one neuron that answers with 1."""
    weight = sp.Symbol("W", real=True)
    alone = {law.f_hat: weight, law.W_hat: weight, law.h: sp.Integer(1)}
    states = (*law.adaptation, law.weight_adaptation)
    estimates = {alone.get(s.symbol, s.symbol): sp.sympify(s.rate, strict=True).xreplace(alone) for s in states}
    plant = {s: rate.xreplace({f: sp.Integer(0)}) for s, rate in single_particle_per_mass().rates.items()}
    rest, fast = sp.Integer(0), rational(speed)
    at = values | {law.x_1: rest, law.x_2: fast, desired_position: rest, desired_speed: fast,
                   desired_acceleration: rest, weight: rest, law.a_hat: values[a_star], law.b_hat: values[b_star],
                   law.c_hat: values[c_star]}
    command = law.rbfnn_pocrac.command.xreplace(alone)
    return plant, command, estimates, at


def periods(values: Values, speed: Fraction) -> tuple[float, float, Any]:
    """Largest stable sampling periods (s) with corrected and explicit estimates, and the map of the former."""
    plant, command, estimates, at = _loop(values, speed)
    corrected, explicit = (sampled_map(plant, u, command, estimates, at, order) for order in ("corrected", "explicit"))
    return largest_period_s(corrected), largest_period_s(explicit), corrected


def delay_margin_s(values: Values, speed: Fraction) -> float:
    """How much delay of the command the continuous loop bears, by its phase margin (python-control)."""
    plant, command, estimates, at = _loop(values, speed)
    rates, states = [*plant.values(), *estimates.values()], [*plant, *estimates]

    def slopes(exprs: list[sp.Expr], by: list[sp.Expr]) -> Array:
        return np.array([[float(sp.diff(e, s).xreplace(at)) for s in by] for e in exprs]).reshape(len(exprs), len(by))

    loop = Linear(slopes(rates, states), slopes(rates, [u]), -slopes([command], states), np.zeros((1, 1)))
    _, phase_deg, crossover = margins(loop)
    return float(np.radians(phase_deg) / crossover)


def _conditions(values: Values, f_star: sp.Expr) -> list[Condition]:
    mu = mu_of(values)
    level = offset(values, f_star) / mu
    most = values[law.k] * sp.sqrt(1 - sp.exp(-2 * level))
    speed = sp.sqrt(2 * level) + values[law.alpha] * most
    return [
        Condition("mu", "mu = min(2 alpha, 2 beta - 1, chi, lambda_i sigma_i) > 0 (49)", f"{float(mu):.3g} 1/s",
                  bool(mu > 0), "yang2021:49.stated"),
        Condition("position", "k sqrt(1 - exp(-2 l/mu)) <= 0.2 m, the ultimate bound", f"{float(most):.4g} m",
                  bool(float(most) <= float(POSITION_M)), "yang2021:theorem1.stated"),
        Condition("speed", "sqrt(2 l/mu) + alpha |e_1| <= 0.3 m/s, the ultimate bound", f"{float(speed):.4g} m/s",
                  bool(float(speed) <= float(SPEED_MPS)), "yang2021:53.stated"),
    ]


def report(stated: Stated) -> GainReport:
    """Conditions and bounds at the stated gains, and gains whose certified bounds meet 0.2 m and 0.3 m/s."""
    values = stated_values(stated)
    f_star = rational(STATED_F_STAR)
    cruise = davis_cruise_speed(float(stated.number("reference.cruise_mps2")), *(float(values[s]) for s in STARS))
    speed = simplest(cruise, 1e-4)
    found = search(adaptation_problem(values, f_star, speed), backoff=1e-3)
    gains = proved_gains(found.values, values)
    reach, fast = reached(gains)
    certificates = [found.certificate, wanted_bounds(stated, gains, f_star)]
    quantities = []
    for label, own in (("stated", values), ("found", gains)):
        quantity, certificate = mean_square(own, f_star, best_share(own, f_star), label)
        corrected, explicit, matrix = periods(own, speed)
        certified = float(simplest(0.95 * corrected, 0.02))
        certificates += [certificate, stability_certificate(f"yang2021:sampling.{label}", matrix(certified))]
        level = offset(own, f_star) / mu_of(own)
        quantities += [
            quantity,
            Quantity(f"invariant level zeta of V, {label}", "", None, float(max(level, start_level(stated, own))),
                     "yang2021:51.zeta.glyph" if label == "stated" else "yang2021:bounds.found",
                     note="the larger of l/mu and V(0)"),
            Quantity(f"sampling period with corrected estimates, {label}", "s", None, certified,
                     f"yang2021:sampling.{label}", corrected,
                     f"check: where the loop linearised at {cruise:.1f} m/s loses stability; {1e3 * explicit:.3g} ms "
                     f"with explicit estimates; delay margin {1e3 * delay_margin_s(own, speed):.3g} ms by "
                     "python-control"),
        ]
    return GainReport(
        "yang2021", tuple(_conditions(values, f_star)), tuple(quantities),
        (GainSet("found", "slowest loop through the estimates with |e_1| <= 0.2 m and |e_1'| <= 0.3 m/s at all times",
                 {str(s): fraction(gains[s]) for s in GAINS},
                 f"|e_1| <= {float(reach):.3g} m, |e_1'| <= {float(fast + gains[law.alpha] * reach):.3g} m/s, t >= 0",
                 "yang2021:bounds.found", {f"{CONTROLLER}.parameters.{s}": float(gains[s]) for s in GAINS}),),
        tuple(certificates), (
            f"The bounds take W* = 0 and eps* = f* = {float(f_star):g} m/s², which holds on the whole line of "
            "Table 1 (claim A2) without the approximation property; an added disturbance must fit into f*.",
            "The sampling period is that of the loop linearised at cruise speed, its entries rounded to 1e-12; near "
            "the barrier the loop is stiffer.",
        ), {found.problem.id: found.seconds})


# --- the runs with found gains beside the stated ones ---------------------------------------------------------------


def tasks(report: GainReport) -> list[Task]:
    """The stated and the found gains at three sampling periods."""
    found = []
    for period_s in (0.001, 0.02, 0.1):
        sampled = {f"{CONTROLLER}.period_s": period_s}
        setting = f"sampled at {1e3 * period_s:g} ms"
        found += [replace(t, changes={**t.changes, **sampled}) for t in same_for_all(report, setting)]
    return found


def run(loaded: Loaded, task: Task) -> tuple[Row, str | None]:
    """The scenario's own run with the task's changes."""
    variant = Variant(title=task.gains, set=dict(task.changes))
    scenario = changed_scenario(loaded.path, dict(loaded.data), variant, loaded.scenario)
    found = measure(simulate(scenario, CONTROLLER.removeprefix("controllers.")), scenario)
    return {name: getattr(found, name) for name in (
        "largest_position_error", "speed_error_min", "speed_error_max", "position_rms", "speed_rms", "stopping_error",
        "energy_J", "jerk_rms", "command_max")}, found.failed


SEARCH = GainSearch(report, tasks, run, FRONT)
