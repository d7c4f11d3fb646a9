"""Section 4: the desired curve (16), the stated numbers, and the PD law (18)."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import sympy as sp

from workbench.proof.claim import Goal, Verdict, at_least, at_most, equal, greater, less
from workbench.proof.derive import lie_derivative

from ..laws import K_d, K_p, e_next, e_now, pd_step
from ..paper import paper
from ..plant import T_s, b_0k, desired_pieces, desired_speed, k, u_prev
from ..stated_values import FIRST_INPUT, LENGTH, SAMPLE_S, Reading, kilonewton_1s, newton, per_mass, per_mass_1s, stated
from .section_2a_train import SPEED_MAX, a, b, secant_loss
from .section_3a_random_lengths import T_d
from .section_3b_theorem_1 import e_one, e_two


def _junction(at: int, piece: int, value: int) -> None:
    @paper.claim(f"16.{at}", f"The desired speed is continuous at {at}", "identity",
                 rf"v_d({at}^-) = v_d({at}^+) = {value}", "proved", note="So that it does no harm that (16) gives both pieces at the border.")
    def junction() -> Goal:
        return Goal((equal(desired_speed(at, piece), value), equal(desired_speed(at, piece + 1), value)))


@paper.claim("16.0", "The desired curve starts at rest", "identity", r"v_d(0) = 0", "proved")
def starts_at_rest() -> Goal:
    """The first piece at 0."""
    return Goal((equal(desired_speed(0, 0), 0),))


for border, before, speed in ((338, 0, 70), (700, 1, 72), (1000, 2, 69), (1600, 3, 70)):
    _junction(border, before, speed)


@paper.claim("16.2000", "The desired curve ends at rest", "identity", r"v_d(2000) = 0", "proved")
def ends_at_rest() -> Goal:
    """The last piece at 2000."""
    return Goal((equal(desired_speed(2000, 4), 0),))


@paper.claim("16.acceleration", "The desired acceleration jumps at all four borders", "identity",
             r"\dot v_d(k^+) - \dot v_d(k^-) = \tfrac{1}{181}, -\tfrac{1}{181} - \tfrac{1}{100}, \tfrac{7}{600}, -\tfrac{1}{600}\ "
             r"\text{at}\ k = 338, 700, 1000, 1600", "proved",
             note="Not printed; per unit of k. An input that tracks (16) exactly jumps there too.")
def acceleration_jumps() -> Goal:
    """Slopes on both sides of the borders."""
    jumps = (sp.Rational(1, 181), -sp.Rational(1, 181) - sp.Rational(1, 100), sp.Rational(7, 600), -sp.Rational(1, 600))
    return Goal(tuple(
        equal(lie_derivative(right[2] - left[2], {k: sp.Integer(1)}).subs(k, left[1]), jump)
        for (left, right), jump in zip(pairwise(desired_pieces), jumps, strict=True)))


bound = sp.Symbol("a_max", positive=True)


@paper.claim("16.force", "A train can follow the first step of (16)", "condition",
             r"\frac{v_d(1) - v_d(0)}{T_s} \le 2\ \tfrac{m}{s^2}", "violated", premises=("16.0",),
             at={**stated(T_s), bound: Fraction(2)}, repair={T_s: Fraction(1), bound: Fraction(2)},
             note="Not printed; 2 m/s^2 is generous for a train. With k counting samples of 0.1 s, as (1) has it, (16) asks for 4.1 m/s^2, 1.4 MN for this train. "
                  "With k in seconds it is 0.41 m/s^2, over a trip of 123 km between two stops.")
def first_step_feasible() -> Goal:
    """The speed gained in the first sample over its duration."""
    return Goal((at_most((desired_speed(1, 0) - desired_speed(0, 0)) / T_s, bound),))


@paper.claim("16.samples", "2000 steps of T_s make the trip of T_d = 2000 s", "condition", r"2000\,T_s = T_d", "violated",
             at={**stated(T_s), T_d: Fraction(2000)}, repair={T_s: Fraction(1), T_d: Fraction(2000)},
             note="k in {0, ..., T_d} counts steps of (1), each T_s = 0.1 s long, and (16), T_d and T_i take it for seconds. Over 2000 steps of 0.1 s the trip takes 200 s.")
def steps_make_the_trip() -> Goal:
    """Steps times their length."""
    return Goal((equal(LENGTH * T_s, T_d),))


@paper.claim("16.end", "A trial of the shortest length ends at more than 30 m/s", "inequality", r"v_d(1901) > 30\ \tfrac{m}{s}", "proved",
             note="Not printed. A trial cut at T_i leaves the train in motion: what varies in the simulation is the length of the data, not "
                  "the time that the train takes for its trip, with which the introduction motivates it.")
def trial_ends_in_motion() -> Goal:
    """The last piece of (16) at T_min + 1."""
    return Goal((greater(desired_speed(1901, 4), 30),))


first = sp.Symbol("u_0", positive=True)


@paper.claim("u0.N", "u(k,0) = 1500 N moves a train with the resistance (17) in N", "condition", r"u_f(k,0) > b_0", "violated",
             at={first: Fraction(FIRST_INPUT), b_0k: Fraction(2977)}, repair={first: Fraction(3500), b_0k: Fraction(2977)},
             note="Not printed. If u is in N and (17) in N too (its M dropped), 1500 N does not even overcome the resistance of 2977 N at standstill.")
def first_input_moves() -> Goal:
    """Net force at standstill in the first trial."""
    return Goal((greater(first, b_0k),))


@paper.claim("u0.mass", "u(k,0) = 1500 N/kg keeps the first speed within that of (16)", "condition", r"T_s\,u_f(0,0) \le 72\ \tfrac{m}{s}", "violated",
             at={first: Fraction(FIRST_INPUT), **stated(T_s)}, repair={first: Fraction(1), **stated(T_s)},
             note="Not printed. If u is in N/kg, as (17) suggests, the first trial reaches 150 m/s within the first sample of 0.1 s.")
def first_input_plausible() -> Goal:
    """Speed after the first sample, resistance left out."""
    return Goal((at_most(T_s * first, SPEED_MAX),))


# --- section 4: the PD law ------------------------------------------------------------------------------------

@paper.claim("18", "The PD law", "identity",
             r"u_f(k,i) = u_f(k,i-1) + K_pe^*(k+1,i-1) + K_de^*(k,i-1)", "proved",
             note="Decided: this is (K_p + K_d) e(k) + K_p [e(k+1) - e(k)]. Its proportional gain is 1004.46 and the gain of its difference 4.46: what is called K_d "
                  "acts on a constant error, and K_p is the gain of the D part. The claims below take (18) as printed.")
def pd_law() -> Goal:
    """(18) sorted by the error and its difference."""
    return Goal((equal(pd_step(e_next, e_now), (K_p + K_d) * e_now + K_p * (e_next - e_now)),))


@paper.claim("18.missing", "On [T_i + 1, T_d] the input is kept", "implication",
             r"e^*(k+1,i-1) = e^*(k,i-1) = 0 \Rightarrow u_f(k,i) = u_f(k,i-1)", "proved")
def pd_keeps_input() -> Goal:
    """(18) where both errors are missing."""
    return Goal((equal(u_prev + pd_step(e_next, e_now), u_prev),), (equal(e_next, 0), equal(e_now, 0)))


def _two_samples() -> tuple[sp.Expr, sp.Expr]:
    """Errors at samples 1 and 2 after a trial with errors e_1, e_2 (and none at 0) under (18)."""
    change_1 = b * pd_step(e_one, sp.Integer(0))
    change_2 = a * change_1 + b * pd_step(e_two, e_one)
    return e_one - change_1, e_two - change_2


opposite = {e_one: sp.Integer(1), e_two: sp.Integer(-1)}


@paper.claim("18.monotone", "(18) gets better from trial to trial (u in N, as printed)", "condition",
             r"\|e_i\|_2 \le \|e_{i-1}\|_2\ \text{for}\ e_{i-1} = (1, -1, \ldots)", "violated", premises=("5.trials",),
             at={**stated(K_p, K_d), b: newton.gain, a: 1 - secant_loss(SAMPLE_S), e_one: Fraction(1), e_two: Fraction(-1)},
             note="The text reads off Figures 5 and 6 that tracking gets better every time. Two samples suffice, as later ones do not act on them.")
def pd_monotone() -> Goal:
    """The first two samples."""
    one, two = _two_samples()
    return Goal((at_most(one**2 + two**2, e_one**2 + e_two**2),))


@paper.claim("18.norm", "The map of (18) has a 2-norm above 1 in every unit of u", "inequality",
             r"K_d \ge 2K_p \Rightarrow \|e_i\|_2^2 > \|e_{i-1}\|_2^2\ \forall b > 0,\ a \in [0, 1]", "proved", premises=("5.trials",),
             note="Not printed. For e_(i-1) = (1, -1); K_d is 224 K_p in Table 1. So (18) as printed is never monotone, whatever u and k mean.")
def pd_norm() -> Goal:
    """The first two samples at e = (1, -1), for every b."""
    one, two = (x.xreplace(opposite) for x in _two_samples())
    return Goal((greater(one**2 + two**2, 2),), (at_least(K_d, 2 * K_p), at_least(a, 0), at_most(a, 1)))


def _pd_convergence(reading: Reading, recorded: Verdict, note: str, repair: dict[sp.Expr, Fraction] | None = None) -> None:
    @paper.claim(f"18.converges.{reading.suffix}", f"(18) converges at each sample in the limit ({reading.title})", "condition",
                 r"|1 - bK_p| < 1", recorded,
                 premises=("5.trials",), at={**stated(K_p), b: reading.gain},
                 repair=None if repair is None else {b: reading.gain, **repair}, note=note)
    def converges() -> Goal:
        one = sp.diff(_two_samples()[0], e_one)
        return Goal((less(one, 1), greater(one, -1)))


_pd_convergence(newton, "proved", "Not printed: the diagonal of the lifted map, theorem1.train's condition. The limit is far: 1 - b K_p = 1 - 1.3e-6.")
_pd_convergence(kilonewton_1s, "proved", "Not printed: the diagonal of the lifted map.")
_pd_convergence(per_mass, "proved", "Not printed. The diagonal is 0.554, but the entries below it are about -100.")
_pd_convergence(per_mass_1s, "violated", "Not printed. The error of the first sample is multiplied by -3.46 in every trial.", {K_p: Fraction(1)})
