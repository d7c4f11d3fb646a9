"""Why a run ended early: one line with controller, time, states and, where there is one, a remedy."""

from __future__ import annotations

import math

from workbench.simulate.plants.arrays import Arrays
from workbench.simulate.plants.event_loop import MOST_IN_A_RUN, MOST_IN_A_STEP, PILED_UP, TOO_MANY
from workbench.simulate.plants.plant_loop import DIVERGED, LAW_OUTSIDE, NO_COMMAND, OUTSIDE, RUNNING
from workbench.simulate.plants.solver import MOST_CALLS, SOLVER_FAILED
from workbench.systems.declared import signs_told
from workbench.systems.law import StateLaw
from workbench.systems.setting import Setting

STEP = "step_s (in a study's file plant_step_s)"
STIFF = f": where the plant itself is stable, its fastest pole wants a shorter {STEP}, or the integrator 'radau'"

UNDEFINED = ("the rates are no finite numbers there: a root, logarithm or quotient left its domain (state it as the "
             f"plant's domain), or {STEP} is too long for its fastest pole (shorten it, or take the integrator "
             "'radau')")


def why(setting: Setting, name: str, law: StateLaw | None, status: int, t: float, a: Arrays) -> str | None:
    """The line for a status of the loop or the solver; None for a run that came to its end."""
    if status == RUNNING:
        return None
    plant = setting.plant
    if status == DIVERGED and any(not math.isfinite(value) for value in a.x[:len(plant.states)]):
        return f"{name} diverged at t = {t:.4g} s, {_last_logged(setting, t, a)}: {UNDEFINED}"
    where = ", ".join(f"{symbol} = {value:.4g}" if math.isfinite(value) else f"{symbol} beyond all numbers"
                      for symbol, value in zip(plant.states, a.x, strict=False))
    outside, signed = (plant.domain, plant.states) if status == OUTSIDE else (
        (law.domain, law.state_symbols) if law else ((), ()))
    domain = ", ".join([*(f"{e} > 0" for e in outside), *signs_told(signed)]).replace("**", "^")
    last = plant.events[int(a.event_log[a.event_count[0] - 1, 1])].id if a.event_count[0] else ""
    what = {PILED_UP: f"met event '{last}' more than {MOST_IN_A_STEP} times in a plant step, or too fast to tell apart "
            "(state a mode in which the plant rests), which was",
            TOO_MANY: f"met more than {MOST_IN_A_RUN} events, '{last}' last, which was",
            SOLVER_FAILED: "was given up by the solver (its rates are no finite numbers, it grows beyond every bound, "
            f"or {STEP} is too long: a step takes {MOST_CALLS} calls of the rates at most)", DIVERGED: "diverged",
            OUTSIDE: f"left the plant's domain ({domain})",
            NO_COMMAND: "gave a command that is no number", LAW_OUTSIDE: f"left its domain ({domain})"}
    remedy = STIFF if status == DIVERGED and setting.integrator == "rk4" else ""
    return f"{name} {what[status]} at t = {t:.4g} s, {where}{remedy}"


def _last_logged(setting: Setting, t: float, a: Arrays) -> str:
    """The last row of the log before t."""
    row = a.log[max(0, round(t / setting.step_s) - 1) // a.log_every]
    states = ", ".join(f"{symbol} = {value:.4g}" for symbol, value in zip(setting.plant.states, row[1:], strict=False))
    return f"after {states} at t = {row[0]:.4g} s"
