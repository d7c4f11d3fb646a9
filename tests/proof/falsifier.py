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
    the way and after, where a shown relation fails; for flows that then run in straight lines."""
    moving = [s for s, rate in goal.flow.items() if rate != 0]
    if set(goal.initial) != set(goal.flow) or any(rate.has(*moving) for rate in goal.flow.values()) or any(
            isinstance(s, sp.Indexed) for s in goal.symbols()):
        return None
    rng, evaluated = np.random.default_rng(seed), Evaluated(goal, neurons=1)
    first, after = len(goal.assume), len(goal.assume) + len(goal.always)
    for _ in range(batches):
        free = evaluated._drawn(rng, count)
        for s in {s for e in (*goal.flow.values(), *goal.initial.values()) for s in e.free_symbols} - set(free):
            free[s] = rng.choice(np.array([0.5, 1.0, 2.0]), count)
        duration = np.abs(rng.choice(np.array([0.25, 0.5, 1.0, 2.0, 8.0]), count))

        def at_time(time, free=free):
            values = dict(free)
            for s in moving:
                with np.errstate(all="ignore"):
                    start, rate = (f(*(free[n] for n in names)) for names, f in map(
                        evaluated._compiled, (goal.initial[s], goal.flow[s])))
                    values[s] = start + rate * time
            return values

        good = np.ones(count, bool)
        for part in PARTS:
            with np.errstate(all="ignore"):
                margins = evaluated._evaluate([at_time(part * duration)[s] for s in evaluated.symbols], count)
            for (_, operator), value in list(zip(evaluated.given, margins, strict=False))[first:after]:
                good &= np.isfinite(value) & evaluated._holds(operator, value, 0.0)
        _, outcomes, assumed = evaluated._settled(at_time(duration), {}, count)
        failed = np.zeros(count, bool)
        for (_, operator), value in zip(evaluated.shown, outcomes, strict=True):
            failed |= np.isfinite(value) & ~evaluated._holds(operator, value, CLEAR[operator])
        for row in np.flatnonzero(good & assumed & failed)[:10]:
            exact = {s: sp.Rational(float(c[row])) for s, c in free.items()}
            lasting = sp.Rational(float(duration[row]))
            ends = exact | {s: (goal.initial[s] + goal.flow[s] * lasting).xreplace(exact) for s in moving}
            if evaluated.holds_at({str(s): v for s, v in ends.items()}) == (True, False):
                return {str(s): str(v) for s, v in ends.items()} | {"duration": str(lasting)}
    return None
