"""What is known of a paper's gains: conditions at the stated ones, what is proved of them, gains that were found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any


@dataclass(frozen=True)
class Condition:
    """A condition at the stated gains: what it says, the values on its sides, whether it is met.

    certificate: the claim id of the certificate that shows it, met or not; empty where it is a comparison of decimals.
    """

    name: str
    statement: str
    computed: str
    met: bool
    certificate: str = ""
    note: str = ""


@dataclass(frozen=True)
class Quantity:
    """A number that is proved: by the paper's way, by the best certificate found, and a check in the frequency domain.

    papers: None where the paper's proof gives nothing; certificate: the claim id of the proof of `proved`.
    """

    name: str
    unit: str
    papers: float | None
    proved: float
    certificate: str
    check: float | None = None
    note: str = ""


@dataclass(frozen=True)
class GainSet:
    """Gains that were found: exact values by name, what is proved of them, and the dotted keys that set them.

    objective: in words what they optimise; changes: of the paper's file, for the simulation beside the stated gains.
    """

    name: str
    objective: str
    values: Mapping[str, Fraction]
    proved: str
    certificate: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    note: str = ""


@dataclass(frozen=True)
class GainReport:
    """All of it for one paper; certificates by claim id are what is written and checked again.

    notes: what could not be had, in a sentence each; seconds: of every search by its name.
    """

    paper: str
    conditions: tuple[Condition, ...]
    quantities: tuple[Quantity, ...]
    found: tuple[GainSet, ...]
    certificates: tuple[dict[str, Any], ...]
    notes: tuple[str, ...] = ()
    seconds: Mapping[str, float] = field(default_factory=dict)
