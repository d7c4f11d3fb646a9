"""What a line adds to a train's resistance, as sympy expressions of grade, curvature and tunnel."""

from __future__ import annotations

import sympy as sp

from workbench.trains.resistance import (
    ROECKL_KNEE_M,
    STANDARD_GRAVITY_MPS2,
    curve_n_per_kn,
    of_weight,
    roeckl_sharp_n_per_kn,
    roeckl_wide_n_per_kn,
)

grade_permille, curvature_per_m, tunnel_n_per_kn = sp.symbols("i kappa w_s", real=True)
_GRAVITY = sp.Rational(str(STANDARD_GRAVITY_MPS2))


def additional_specific_resistance() -> sp.Expr:
    """Resistance of grade, curve (600/R) and tunnel in N per kg of train, of (i, 1/R, w_s).

    The curve term 600/R N/kN with R in m is the usual empirical one; straight track is 1/R = 0.
    """
    return of_weight(_GRAVITY, grade_permille + curve_n_per_kn(curvature_per_m) + tunnel_n_per_kn)


def roeckl_specific_resistance() -> sp.Expr:
    """The same with Roeckl's resistance of curves, 650/(R - 55) N/kN from R = 300 m on and 500/(R - 30) below.

    The handbook form for standard gauge, R in m (for example D. Wende, Fahrdynamik des Schienenverkehrs, 2003).
    The two branches do not meet: at R = 300 m they give 2.65 and 1.85 N/kN.
    """
    curve = sp.Piecewise((roeckl_wide_n_per_kn(curvature_per_m), curvature_per_m <= sp.Rational(1, ROECKL_KNEE_M)),
                         (roeckl_sharp_n_per_kn(curvature_per_m), True))
    return of_weight(_GRAVITY, grade_permille + curve + tunnel_n_per_kn)
