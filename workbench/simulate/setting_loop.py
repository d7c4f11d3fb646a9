"""The compiled closed loop made for a setting: the same numbers to the last bit, in a fifth to two thirds of the time.

A call between two kernels hands over every array by its parts, which costs more than the Runge-Kutta step it is for;
and what never happens in a setting is asked about four times a step. So the plant's functions are put into the loop,
and how many disturbances, failures and changes there are is written into it as a number.
"""

from __future__ import annotations

from types import ModuleType

from workbench.compile.kernel import Estimates, kernel_module
from workbench.compile.text import Form
from workbench.model.law import ControlLaw
from workbench.simulate import kernel_loop
from workbench.simulate.closed_loop import Setting
from workbench.trains.train import single_particle

# What the plant's four stages of a step call.
STAGES = ("plant_rates", "additional", "term", "pushed", "applied", "at_time", "rates_at")
COUNTED = ("terms", "failures", "changes")
# So many rows of one kind are written into a loop; more are counted by it.
MOST_ROWS = 2

# By the law itself, not its id: a copied folder has laws of the same names.
_made: dict[tuple[int, Estimates, Form], tuple[ControlLaw, ModuleType]] = {}


def setting_form(setting: Setting, *others: str) -> Form:
    """The form of a module of `kernel_loop` for settings with as many rows as this one has.

    others: functions that are put into the loop beside those of the plant.
    """
    rows = {name: len(getattr(setting, name)) for name in COUNTED}
    return Form((*STAGES, *others), tuple((name, count) for name, count in rows.items() if count <= MOST_ROWS))


def law_loop(law: ControlLaw, setting: Setting, estimates: Estimates = "corrected") -> ModuleType:
    """The closed loop of a law of the registry, or a paper's, with the single particle in a setting."""
    key = id(law), estimates, setting_form(setting)
    if key not in _made:
        _made[key] = law, kernel_module(single_particle(), law, kernel_loop, estimates, key[2])
    return _made[key][1]
