"""Tables 2 to 4 as study.toml states them, exactly."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from workbench.files.toml import read_toml

stated = read_toml(Path(__file__).with_name("study.toml"))  # Tables 2 to 4


def exactly(value: float) -> Fraction:
    """A stated value as the decimal that it is written as."""
    return Fraction(str(value))
