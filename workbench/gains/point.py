"""The point of rest that a paper's `gains.py` names, read before anything is searched there."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import sympy as sp

from workbench.errors import InputError
from workbench.gains.enclosure import stated_number
from workbench.gains.exact import rational
from workbench.systems.plant import Plant


def at_point(plant: Plant, at: Mapping[str, Any] | None) -> dict[str, sp.Expr]:
    """Values of states and inputs by name: a decimal or a fraction as text, a number, or a number of sympy such as pi.

    A float is the shortest decimal that is read as it. Raises InputError for a name that is neither state nor input and
    for what is no finite real number.
    """
    names = [*map(str, (*plant.states, *plant.inputs))]
    for name in at or {}:
        if name not in names:
            raise InputError(plant.id, f"at.{name}", f"is no state and no input: name one of {', '.join(names)}")
    return {name: _exact(plant, name, value) for name, value in (at or {}).items()}


def _exact(plant: Plant, name: str, value: Any) -> sp.Expr:
    if isinstance(value, sp.Expr) and value.is_number and value.is_finite and value.is_real:
        return value
    try:
        if isinstance(value, str | int | Fraction) and not isinstance(value, bool):
            return rational(Fraction(value))
        if isinstance(value, float):
            return rational(stated_number(value))
    except (ValueError, ZeroDivisionError):
        pass
    raise InputError(plant.id, f"at.{name}", f"{value!r} is no finite real number: write one such as '0.5' or '1/3'")
