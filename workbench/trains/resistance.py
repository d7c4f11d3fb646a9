"""What resists a train, as plain formulas of numbers, arrays or expressions alike: expressions are made of these."""

from __future__ import annotations

from typing import Any

STANDARD_GRAVITY_MPS2 = 9.80665
# Roeckl's formula of curves changes at this radius, m.
ROECKL_KNEE_M = 300


def davis_resistance(speed: Any, a: Any, b: Any, c: Any) -> Any:
    """Basic resistance a + b v + c v^2, the Davis equation; unit of a, v in m/s."""
    return a + b * speed + c * speed**2


def curve_n_per_kn(curvature_per_m: Any) -> Any:
    """The usual empirical resistance of a curve, 600/R N/kN with R in m; straight track is 1/R = 0."""
    return 600 * curvature_per_m


def roeckl_wide_n_per_kn(curvature_per_m: Any) -> Any:
    """Roeckl's resistance of a curve of 300 m or more, 650/(R - 55) N/kN."""
    return 650 * curvature_per_m / (1 - 55 * curvature_per_m)


def roeckl_sharp_n_per_kn(curvature_per_m: Any) -> Any:
    """Roeckl's resistance of a sharper curve, 500/(R - 30) N/kN."""
    return 500 * curvature_per_m / (1 - 30 * curvature_per_m)


def of_weight(gravity_mps2: Any, n_per_kn: Any) -> Any:
    """N per kg of train, of a resistance in N per kN of its weight; a grade in per mille is one."""
    return gravity_mps2 * n_per_kn / 1000
