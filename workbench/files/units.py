"""Units that a file declares beside its numbers, as exact factors to SI."""

from __future__ import annotations

from fractions import Fraction
from typing import Annotated, Any, ClassVar

from pydantic import Field, model_validator

from workbench.files.toml import Number, Record, Text

Units = dict[str, Fraction]

_KMH = Fraction(1000, 3600)
_FORCES: Units = {"N": Fraction(1), "kN": Fraction(1000)}
_SPEEDS: Units = {"m/s": Fraction(1), "km/h": _KMH}

LENGTH: Units = {"m": Fraction(1), "km": Fraction(1000)}
SPEED: Units = _SPEEDS
ACCELERATION: Units = {"m/s^2": Fraction(1)}
MASS: Units = {"kg": Fraction(1), "t": Fraction(1000)}
FORCE: Units = _FORCES
POWER: Units = {"W": Fraction(1), "kW": Fraction(1000), "MW": Fraction(10**6)}
FRACTION: Units = {"-": Fraction(1), "%": Fraction(1, 100)}
GRADE_PERMILLE: Units = {"permil": Fraction(1), "‰": Fraction(1), "%": Fraction(10), "-": Fraction(1000)}
AREA: Units = {"m^2": Fraction(1)}

# Energies are shown in kWh.
KWH_J = 3.6e6


def _per_speed(power: int) -> Units:
    """Forces per speed or per squared speed, in every spelling: kN/(km/h)^2, N/(m/s), N s/m."""
    tail = "" if power == 1 else f"^{power}"
    found = {f"{force}/({speed}){tail}": factor / by**power
             for force, factor in _FORCES.items() for speed, by in _SPEEDS.items()}
    return found | {f"{force} s{tail}/m{tail}": factor for force, factor in _FORCES.items()}


FORCE_PER_SPEED: Units = _per_speed(1)
FORCE_PER_SQUARED_SPEED: Units = _per_speed(2)


def to_si(value: float, unit: str, known: Units) -> float:
    """A value in SI, the nearest float to the decimal number that was written.

    Raises ValueError for a unit that is not known, and for a value too large in SI.
    """
    if unit not in known:
        raise ValueError(f"unit = '{unit}' is not known: convert to one of {', '.join(known)}")
    try:
        # By the shortest decimal text, so that 140 km/h and the same speed written otherwise give the same float.
        return float(Fraction(repr(float(value))) * known[unit])
    except OverflowError:
        raise ValueError(f"{value:g} {unit} is too large a number: correct it") from None


class Quantity(Record):
    """A number with its unit, of one dimension: a subclass names the units it knows."""

    KNOWN: ClassVar[Units] = {}

    unit: Text
    value: Number

    @model_validator(mode="before")
    @classmethod
    def _a_table(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            raise ValueError('is no quantity: write {"unit": ..., "value": ...}')
        return data

    @model_validator(mode="after")
    def _known_unit(self) -> Quantity:
        to_si(self.value, self.unit, self.KNOWN)
        return self

    @property
    def si(self) -> float:
        """The value in SI (grades in per mille)."""
        return to_si(self.value, self.unit, self.KNOWN)


class Length(Quantity):
    """A length, m or km."""

    KNOWN = LENGTH


class Speed(Quantity):
    """A speed, m/s or km/h."""

    KNOWN = SPEED


class Acceleration(Quantity):
    """An acceleration, m/s^2."""

    KNOWN = ACCELERATION


class Mass(Quantity):
    """A mass, kg or t."""

    KNOWN = MASS


class Force(Quantity):
    """A force, N or kN."""

    KNOWN = FORCE


class Power(Quantity):
    """A power, W, kW or MW."""

    KNOWN = POWER


class Share(Quantity):
    """A fraction or a percentage."""

    KNOWN = FRACTION


class LinearResistance(Quantity):
    """A force per speed."""

    KNOWN = FORCE_PER_SPEED


class SquareResistance(Quantity):
    """A force per squared speed."""

    KNOWN = FORCE_PER_SQUARED_SPEED


def require_units(given: dict[str, str], columns: dict[str, Units]) -> None:
    """ValueError unless a unit is given for every column, and for nothing else."""
    for name in [*columns, *given]:
        if name not in given:
            raise ValueError(f"units.{name} is missing: add it")
        if name not in columns:
            raise ValueError(f"units.{name} is no column here: name {', '.join(columns)}")


class Columns(Record):
    """Rows of numbers with a unit for each column; a subclass names the columns and what rows are."""

    COLUMNS: ClassVar[dict[str, Units]] = {}

    units: dict[str, Text]
    values: Annotated[tuple[tuple[float, ...], ...], Field(min_length=1)]

    @model_validator(mode="after")
    def _known_units(self) -> Columns:
        require_units(self.units, self.COLUMNS)
        self.rows()
        return self

    def rows(self) -> list[tuple[float, ...]]:
        """The rows in SI (grades in per mille); infinities stay."""
        known = [(self.units[name], table) for name, table in self.COLUMNS.items()]
        return [tuple(x if abs(x) == float("inf") else to_si(x, *unit) for x, unit in zip(row, known, strict=True))
                for row in self.values]
