"""How the numbers of gains are called and written: in a sentence, and above a column."""

from __future__ import annotations

import re

from workbench.files.units import KWH_J
from workbench.paper.cells import Column

KINDS = {"rms": "RMS of", "max": "largest"}
UNITS = {"m": "m", "mps": "m/s", "mps2": "m/s²", "mps3": "m/s³", "n": "N", "N": "N", "J": "J", "s": "s"}
# What a key says only to who knows the program: words, and the unit.
KNOWN: dict[str, tuple[str, str]] = {
    "trials_worse": ("number of trials with a larger error than the one before", ""),
    "bound_used": ("share of the bound that is used", ""), "reversals": ("changes of the command's sign", ""),
    "position_rms": ("RMS of the position error", "m"), "speed_rms": ("RMS of the speed error", "m/s"),
    "settled_position_rms": ("RMS of the settled position error", "m"), "energy_J": ("energy", "kWh"),
    "largest_position_error": ("largest position error", "m"), "stopping_error": ("stopping error", "m"),
    "speed_error_min": ("lowest speed error", "m/s"), "speed_error_max": ("highest speed error", "m/s"),
    "jerk_rms": ("RMS of the jerk", "m/s³"), "command_max": ("largest command", "m/s²")}
_POWER = re.compile(r"(?<![\w.])(\d(?:\.\d+)?)e([-+]?)0*(\d+)(?![\w.]\w)")
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_TRIAL = re.compile(r"mse_(\d+)")


def letter(gain: str) -> str:
    """A gain's name as its letter is called: Python leaves no name `lambda`, so that sympy's is `lamda`."""
    return re.sub(r"^lamda(?=_|$)", "lambda", gain)


def spoken(key: str) -> str:
    """A number's key in words, without its unit: `s_tilde_m_rms` is `RMS of s_tilde`."""
    if key in KNOWN:
        return KNOWN[key][0]
    if found := _TRIAL.fullmatch(key):
        return f"mean squared error of trial {found[1]}"
    parts = key.split("_")
    if all(part in KINDS or part in UNITS for part in parts):
        return key.replace("_", " ")
    kind = next((KINDS[part] for part in parts if part in KINDS), "")
    said = [part for i, part in enumerate(parts) if part not in KINDS and (i == 0 or part not in UNITS)]
    return f"{kind} {('_' if said and len(said[0]) == 1 else ' ').join(said)}".strip()


def column(key: str) -> Column:
    """The column of a number that has this key, in SI, with its unit where the key says one; energies in kWh."""
    unit = KNOWN[key][1] if key in KNOWN else next((UNITS[part] for part in key.split("_")[1:] if part in UNITS), "")
    return Column(spoken(key), "kWh", KWH_J) if unit in ("J", "kWh") else Column(spoken(key), unit)


def with_powers(text: str) -> str:
    """Numbers as a program writes them, `5e-05`, as people do: `5 × 10⁻⁵`."""
    def power(found: re.Match[str]) -> str:
        exponent = f"{found[2].replace('+', '')}{found[3]}".translate(_RAISED)
        return f"10{exponent}" if found[1] == "1" else f"{found[1]} × 10{exponent}"

    return _POWER.sub(power, text)
