"""Section 6 as study.toml states it."""

from __future__ import annotations

from pathlib import Path

from workbench.files.toml import read_toml
from workbench.proof.printed_values import exact_decimal as exactly

__all__ = ["exactly", "stated"]

stated = read_toml(Path(__file__).with_name("study.toml"))
