"""What breaks a goal, found without the deciders: stated values, a point, a path or functions of time.

Like `independent.py`, on which it stands, this takes nothing from the deciders and is never shown to them.
"""

import numpy as np
import sympy as sp
from independent import CLEAR, Evaluated, model_breaks

PARTS = (0.0, 0.1, 0.5, 0.9, 1.0, 3.0, 30.0)  # of the duration, at which `always` is looked at



def falsified(goal, at, seed, effort=1):
    """What breaks a goal: stated values, a point, or functions of time; None when nothing was found."""
    if goal.eventually is not None:
        return falsifying_functions(goal, seed)
    if at is None:
        found = Evaluated(goal).falsifying_point(seed, batches=3 * effort, count=4_000, tight=30 * effort)
        return falsifying_path(goal, seed) if found is None and goal.initial else found
    stated = {str(s): value for s, value in at.items()}
    try:
        return stated if Evaluated(goal, neurons=1).holds_at(stated) == (True, False) else None
    except (ZeroDivisionError, TypeError, ValueError):
        return None


def falsifying_functions(goal, seed, tries=60):
    """Functions of a small family that meet what always holds and never do as shown, on a grid of times."""
    rng, time = np.random.default_rng(seed), goal.eventually
    moving = [s for s in goal.flow if s != time]
    shapes = (sp.Integer(0), sp.exp(-time), 1 / (1 + time), time, -sp.exp(-time), sp.exp(-2 * time))
    for attempt in range(tries):
        constants = {s: sp.Integer(1) if attempt < 20 or rng.random() < 0.5 else sp.Rational(int(rng.integers(0, 5)), 2)
                     for s in goal.symbols() if s not in goal.flow and s not in goal.flow.values()}
        functions = {s: sp.Rational(int(rng.integers(0, 5)), 2) + shapes[int(rng.integers(len(shapes)))]
                     for s in moving}
        for s, start in goal.initial.items():  # a constant that is an initial value follows the function
            if start in constants and s in functions:
                constants[start] = functions[s].xreplace({time: sp.Integer(0)})
        try:
            if model_breaks(goal, {str(s): str(f) for s, f in functions.items()},
                            {str(s): v for s, v in constants.items()}):
                return {str(s): str(v) for s, v in (constants | functions).items()}
        except (TypeError, ZeroDivisionError):
            continue
    return None


def falsifying_path(goal, seed, batches=8, count=3_000):
    """A point that the flow reaches from its initial values under constant inputs, all that always holds holding on
    the way and after, where a shown relation fails.

    Exact for flows that then run in straight lines; other flows are integrated, twice, and must fail clearly.
    """
    moving = [s for s, rate in goal.flow.items() if rate != 0]
    if set(goal.initial) != set(goal.flow) or any(isinstance(s, sp.Indexed) for s in goal.symbols()):
        return None
    straight = not any(rate.has(*moving) for rate in goal.flow.values())
    rng, evaluated = np.random.default_rng(seed), Evaluated(goal, neurons=1)
    first, after = len(goal.assume), len(goal.assume) + len(goal.always)
    for _ in range(batches if straight else 2):
        free = evaluated._drawn(rng, count)
        for s in {s for e in (*goal.flow.values(), *goal.initial.values()) for s in e.free_symbols} - set(free):
            free[s] = rng.choice(np.array([0.5, 1.0, 2.0]), count)
        duration = np.abs(rng.choice(np.array([0.25, 0.5, 1.0, 2.0, 8.0]), count))
        at_times = (_on_lines if straight else _integrated)(evaluated, goal, moving, free, duration)
        good = np.ones(count, bool)
        for values in at_times.values():
            margins = evaluated._evaluate([values[s] for s in evaluated.symbols], count)
            for (_, operator), value in list(zip(evaluated.given, margins, strict=False))[first:after]:
                good &= np.isfinite(value) & evaluated._holds(operator, value, 0.0)
        columns, outcomes, assumed = evaluated._settled(dict(at_times[1.0]), {}, count)
        failed = np.zeros(count, bool)
        for (_, operator), value in zip(evaluated.shown, outcomes, strict=True):
            failed |= np.isfinite(value) & ~evaluated._holds(operator, value, CLEAR[operator] if straight else 1e-4)
        for row in np.flatnonzero(good & assumed & failed)[:10]:
            lasting = sp.Rational(float(duration[row]))
            if not straight:
                ends = {str(s): float(c[row]) for s, c in zip(evaluated.symbols, columns, strict=True)}
                return ends | {"duration": str(lasting)}
            exact = {s: sp.Rational(float(c[row])) for s, c in free.items()}
            ends = exact | {s: (goal.initial[s] + goal.flow[s] * lasting).xreplace(exact) for s in moving}
            if evaluated.holds_at({str(s): v for s, v in ends.items()}) == (True, False):
                return {str(s): str(v) for s, v in ends.items()} | {"duration": str(lasting)}
    return None


def _value(evaluated, expr, values, count):
    names, function = evaluated._compiled(expr)
    with np.errstate(all="ignore"):
        return np.broadcast_to(np.asarray(function(*(values[n] for n in names)), float), count)


def _on_lines(evaluated, goal, moving, free, duration):
    """Values of all symbols at parts of the duration, where all rates are constant."""
    count = len(duration)
    starts = {s: _value(evaluated, goal.initial[s], free, count) for s in moving}
    rates = {s: _value(evaluated, goal.flow[s], free, count) for s in moving}
    with np.errstate(all="ignore"):
        return {part: free | {s: starts[s] + rates[s] * part * duration for s in moving} for part in PARTS}


def _integrated(evaluated, goal, moving, free, duration, steps=200):
    """The same by the classical Runge-Kutta scheme, up to the end; NaN where half the step says otherwise."""
    coarse, fine = (_runge_kutta(evaluated, goal, moving, free, duration, n) for n in (steps, 2 * steps))
    for part, values in fine.items():
        for s in moving:
            with np.errstate(all="ignore"):
                unsure = ~(np.abs(values[s] - coarse[part][s]) <= 1e-7 * (1 + np.abs(values[s])))
            values[s] = np.where(unsure, np.nan, values[s])
    return fine


def _runge_kutta(evaluated, goal, moving, free, duration, steps):
    count, step = len(duration), duration / steps
    values = free | {s: _value(evaluated, goal.initial[s], free, count) for s in moving}
    kept = {0.0: values}

    def moved(values, rates, by):
        with np.errstate(all="ignore"):
            return values | {s: values[s] + rates[s] * by for s in moving}

    def rates_at(values):
        return {s: _value(evaluated, goal.flow[s], values, count) for s in moving}

    for number in range(1, steps + 1):
        one = rates_at(values)
        two = rates_at(moved(values, one, step / 2))
        three = rates_at(moved(values, two, step / 2))
        four = rates_at(moved(values, three, step))
        with np.errstate(all="ignore"):
            mean = {s: (one[s] + 2 * two[s] + 2 * three[s] + four[s]) / 6 for s in moving}
        values = moved(values, mean, step)
        if number / steps in PARTS:
            kept[number / steps] = values
    return kept
