"""liu2020: Lyapunov weights for the observer of every column of Table 2, and gains between decay and noise.

The adaptation laws (19)-(21) are driven by v_tilde, so a certificate must weigh v_tilde^2 by 1/2 and not mix it with
s_tilde: V = p s_tilde^2/2 + v_tilde^2/2. The paper takes p = 1, which needs (40); here p is found.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import sympy as sp

from workbench.errors import SolverError
from workbench.gains.exact import fraction, rational, simplest
from workbench.gains.frequency import abscissa, h_infinity_norm, linear
from workbench.gains.problem import Problem
from workbench.gains.result import Condition, GainReport, GainSet, Quantity
from workbench.gains.search import Infeasible, confirm, largest, search
from workbench.gains.stated import Stated
from workbench.paper.gain_search import Ended, GainSearch, OwnRuns, Task
from workbench.proof.claim import D, at_least, at_most
from workbench.proof.derive import lie_derivative

from . import laws as law
from .laws import k_1, k_2, k_3, s_tilde, v_tilde
from .plant import s, v
from .study.record import LiuStudy
from .study.runs import BY_RATE, RMS, RunCase, RunResult, run_case

Values = dict[sp.Expr, sp.Expr]

p, p_11, p_12, p_22 = sp.symbols("p p_11 p_12 p_22", real=True)
noise, xi_tilde = sp.symbols("n xi_tilde", real=True)
GAINS = (k_1, k_2, k_3)
NO_LEARNING = {law.f_hat: sp.Integer(0), law.D_1: sp.Integer(0)}
OWN = p * s_tilde**2 / 2 + v_tilde**2 / 2  # what the update signal v_tilde allows
FREE = p_11 * s_tilde**2 + 2 * p_12 * s_tilde * v_tilde + p_22 * v_tilde**2
NEAR = Fraction(101, 100)  # found gains stay this far inside their border


def error_rates() -> dict[sp.Expr, sp.Expr]:
    """(13), (18) without networks and robust term."""
    rates = {s: v, v: sp.Integer(0), law.s_hat: law.s_hat_rate, law.v_hat: law.v_hat_rate.xreplace(NO_LEARNING)}
    in_errors = {law.s_hat: s + s_tilde, law.v_hat: v + v_tilde}
    return {error: sp.expand(lie_derivative(expr, rates).xreplace(in_errors))
            for error, expr in ((s_tilde, law.s_error), (v_tilde, law.v_error))}


def noise_rates() -> tuple[dict[sp.Expr, sp.Expr], sp.Expr]:
    """The observer as it runs (claim 12.glyph) with a position measured as s + n: rates of its errors, and v_hat - v.

    Its state is xi = v_hat + k_3 (s_hat - s - n), whose rate needs no derivative of the noise.
    """
    seen = law.s_error.xreplace({s: s + noise})
    v_hat = law.xi - k_3 * seen
    xi_rate = sp.expand(law.v_hat_rate + k_3 * law.s_error_rate).xreplace(NO_LEARNING).xreplace({s: s + noise})
    rates = {s: v, v: sp.Integer(0), law.s_hat: law.s_hat_rate.xreplace({s: s + noise}).xreplace({law.v_hat: v_hat}),
             law.xi: xi_rate}
    in_errors = {law.s_hat: s + s_tilde, law.xi: v + xi_tilde}
    flow = {error: sp.expand(lie_derivative(expr, rates).xreplace(in_errors))
            for error, expr in ((s_tilde, law.s_hat - s), (xi_tilde, law.xi - v))}
    return flow, sp.expand((v_hat - v).xreplace(in_errors))


def decay_problem(name: str, V: sp.Expr, unknowns: tuple[sp.Symbol, ...], values: Values, rate: Fraction) -> Problem:
    """V' <= -2 rate V along the observer's errors, for V that bounds them."""
    flow = {error: r.xreplace(values) for error, r in error_rates().items()}
    size = simplest(abs(float(stiffness(values))) ** 0.5, 0.1)
    squares = {OWN: s_tilde**2 * rational(size**2) / 1000 + v_tilde**2 / 2,
               FREE: s_tilde**2 * rational(size**2) + v_tilde**2}
    scales = {s_tilde: 1 / size, p: size**2, p_11: size**2, p_12: size}
    return Problem(f"liu2020:{name}", unknowns, {
        "positive": at_least(V, squares[V]), "decay": at_most(D(V), -2 * rational(rate) * V)}, flow, scales=scales)


def stiffness(values: Values) -> sp.Expr:
    """k_2 - k_1 k_3 of (18), by which s_tilde drives v_tilde."""
    return -sp.diff(error_rates()[v_tilde], s_tilde).xreplace(values)


def best_decay(column: int, values: Values) -> tuple[Fraction, dict[str, Any], float]:
    """The largest decay rate (1/s) that V = p s_tilde^2/2 + v_tilde^2/2 proves, its certificate, and seconds."""
    limit = -abscissa(linear(error_rates(), [], [], values))
    rate, found = largest(lambda a: decay_problem(f"decay.value{column}", OWN, (p,), values, a), Fraction(0),
                          simplest(limit, 1e-6), 1e-3)
    return rate, found.certificate, found.seconds


def free_decay(column: int, values: Values) -> tuple[Fraction, dict[str, Any]]:
    """The decay rate that any quadratic function proves, just below that of the slowest pole."""
    limit = -abscissa(linear(error_rates(), [], [], values))
    rate = simplest(0.999 * limit, 1e-4)
    return rate, search(decay_problem(f"decay.free{column}", FREE, (p_11, p_12, p_22), values, rate)).certificate


def papers_weight(column: int, values: Values) -> bool:
    """Whether p = 1, the paper's weight, proves that V decreases at all."""
    flow = {error: r.xreplace(values) for error, r in error_rates().items()}
    problem = Problem(f"liu2020:papers{column}", (), {"decay": at_most(D(OWN.xreplace({p: sp.Integer(1)})), 0)}, flow)
    try:
        confirm(problem)
    except SolverError:
        return False
    return True


def noise_gain(values: Values) -> float:
    """The H-infinity norm from position noise (m) to v_hat (m/s), 1/s."""
    flow, output = noise_rates()
    return h_infinity_norm(linear(flow, [noise], [output], values))


def noise_problem(name: str, values: Values, gain: Fraction) -> Problem:
    """A storage function that proves the gain from noise to v_hat."""
    flow, output = noise_rates()
    flow = {error: r.xreplace(values) for error, r in flow.items()}
    V = p_11 * s_tilde**2 + 2 * p_12 * s_tilde * xi_tilde + p_22 * xi_tilde**2
    size = fraction(values[k_3])
    scales = {xi_tilde: size, p_11: size, p_12: Fraction(1), p_22: 1 / size}
    return Problem(f"liu2020:{name}", (p_11, p_12, p_22), {
        "storage": at_least(V, 0),
        "gain": at_most(D(V), rational(gain**2) * noise**2 - output.xreplace(values) ** 2)}, flow, scales=scales)


def least_noise(rate: Fraction) -> Values:
    """Gains of (nearly) the least noise gain among those that V proves to decay at a rate.

    V' <= -2 rate V needs k_1, k_3 >= rate, as its squares say, and the noise passes with k_3 at high frequency, so no
    such gains let less noise through than `rate`; equal k_1 and k_3 with a k_2 just above k_1 k_3 come next to that.
    """
    k = rational(simplest(float(rate * NEAR), 5e-4))
    return {k_1: k, k_3: k, k_2: k**2 * sp.Rational(51, 50)}


def _column(gains: dict[str, list[Fraction]], column: int) -> Values:
    return {k: rational(gains[str(k)][column - 1]) for k in GAINS}


def _found(stated: Stated, label: str, objective: str, rate: Fraction, column: int,
           certificates: list[dict[str, Any]]) -> tuple[GainSet, list[Quantity]]:
    """The gains of least noise at a decay rate, in place of those of a column."""
    values = least_noise(rate)
    decay = search(decay_problem(f"decay.{label}", OWN, (p,), values, rate))
    gain = simplest(noise_gain(values) * 1.003, 2e-3)
    proof = search(noise_problem(f"noise.{label}", values, gain))
    certificates += [decay.certificate, proof.certificate]
    lists = {k: [float(x) for x in stated.numbers(f"gains.{k}")] for k in GAINS}
    for k, value in values.items():
        lists[k][column - 1] = float(value)
    quantities = [
        Quantity(f"decay rate of the observer, {label}", "1/s", None, float(rate), decay.problem.id,
                 -abscissa(linear(error_rates(), [], [], values)), "check: the slowest pole"),
        Quantity(f"gain from position noise to v_hat, {label}", "1/s", None, float(gain), proof.problem.id,
                 noise_gain(values), f"check: H-infinity norm; no gains proved for this rate have less than "
                 f"{float(rate):.3g}"),
    ]
    return GainSet(label, objective, {str(k): fraction(x) for k, x in values.items()},
                   f"decay {float(rate):.3g} 1/s, noise gain {float(gain):.3g} 1/s", decay.problem.id,
                   {f"gains.{k}": x for k, x in lists.items()}, f"column {column}"), quantities


def report(stated: Stated) -> GainReport:
    """Certificates and decay rates for all columns, and gains that do better than columns 5 and 10."""
    gains = {str(k): stated.numbers(f"gains.{k}") for k in GAINS}
    conditions, quantities, certificates, seconds = [], [], [], {}
    rates: list[Fraction] = []
    columns = range(1, len(gains["k_1"]) + 1)
    for column in columns:
        values = _column(gains, column)
        left = (1 + values[k_1] * values[k_3] - values[k_2])
        conditions.append(Condition(
            f"(40), Value {column}", "1 - k_2 + k_1 k_3 = 0", f"{float(left):.4g}", bool(left == 0),
            "liu2020:40",
            "V_1 decreases all the same" if papers_weight(column, values) else "V_1 with p = 1 does not decrease"))
        rate, certificate, took = best_decay(column, values)
        free, other = free_decay(column, values)
        rates.append(rate)
        seconds[f"liu2020:decay.value{column}"] = took
        certificates += [certificate, other]
        weight = certificate["values"]["p"]
        quantities.append(Quantity(
            f"decay rate of the observer, Value {column}", "1/s", None, float(rate), f"liu2020:decay.value{column}",
            -abscissa(linear(error_rates(), [], [], values)),
            f"p = {float(Fraction(weight)):.4g}; any V proves {float(free):.3g}; check: the slowest pole; noise gain "
            f"{noise_gain(values):.3g} 1/s"))
    certificates += [refusal(columns[-1], _column(gains, columns[-1]), rates[-1] * Fraction(101, 100)),
                     noise_floor(rates[-1])]
    sets = []
    for label, objective, rate, column in (
            ("same_decay", "least noise at the decay rate proved for the last column", rates[-1], columns[-1]),
            *((f"same_noise_{column}", f"largest decay rate at the noise gain of Value {column}",
               simplest(noise_gain(_column(gains, column)) / float(NEAR) / 1.03, 1e-2), column)
              for column in (5, columns[-1]))):
        found, more = _found(stated, label, objective, rate, column, certificates)
        sets.append(found)
        quantities += more
    return GainReport("liu2020", tuple(conditions), tuple(quantities), tuple(sets), tuple(certificates), (
        "The certificates are for the damping k_3 s_tilde' of (18), (25); networks and leakage enter by the corrected "
        "laws of claim theorem1.decay, whose terms V leaves as they are, since it keeps the weight 1/2 of v_tilde^2.",
        "A slow observer, however well proved, breaks the loop of fast tracking gains: see the run with the decay rate "
        "of Value 10 in its place; what is proved is of the observer's errors alone.",
        "That the update signal v_tilde needs the speed, which is not measured (claim 19.measured), no gain can mend.",
    ), seconds)


def refusal(column: int, values: Values, rate: Fraction) -> dict[str, Any]:
    """The exact certificate that no p proves a decay rate; SolverError where there is none."""
    return _refused(decay_problem(f"no_decay.value{column}", OWN, (p,), values, rate))


def noise_floor(rate: Fraction) -> dict[str, Any]:
    """The exact certificate that no gains whose decay rate V proves have k_3 below 99/100 of it.

    The unknowns are p, q = p k_1, the stiffness a = k_2 - k_1 k_3 and k_3, in which V' + 2 rate V is linear.
    """
    q, a = sp.symbols("q a", real=True)
    flow = {error: r.xreplace({k_2: a + k_1 * k_3}) for error, r in error_rates().items()}
    decrease = sp.expand(sp.expand(-lie_derivative(OWN, flow) - 2 * rational(rate) * OWN).xreplace({k_1: q / p}))
    return _refused(Problem("liu2020:noise.least", (p, q, a, k_3), {
        "decay": at_least(decrease, 0), "noise": at_most(k_3, rational(rate) * sp.Rational(99, 100)),
        "weight": at_least(p, rational(rate**2) / 1000)}))


def _refused(problem: Problem) -> dict[str, Any]:
    try:
        search(problem)
    except Infeasible as answer:
        if answer.certificate is not None:
            return answer.certificate
    raise SolverError(f"{problem.id}: is not refused by an exact certificate: loosen it less")


# --- runs with the stated and the found gains -----------------------------------------------------------------------


def tasks(report: GainReport) -> list[Task]:
    """Each found set in place of the column of Table 2 that it is for."""
    made = []
    for found in report.found:
        column = int(found.note.removeprefix("column "))
        made += [Task(name, f"in place of Value {column}", changes, {"column": column})
                 for name, changes in (("stated", {}), (found.name, found.changes))]
    return made


def case_of(study: LiuStudy, task: Task) -> RunCase:
    """A column of Table 3 under the observer that the certificates are of."""
    return RunCase(task.values["column"], BY_RATE, study.runs.table_3_disturbance)


def row(study: LiuStudy, found: RunResult) -> Ended:
    """The numbers of a run."""
    names = {f"{name}_rms": in_row for name, in_row in RMS.items()} | {"energy_J": "energy_J", "reversals": "reversals"}
    return {name: found.row[in_row] for name, in_row in names.items()}, found.failed


RUNS = OwnRuns(case_of, run_case, row)
SEARCH = GainSearch(report, tasks, RUNS.run, had=RUNS.had)
