"""Section 4, the numbers: the desired curve (16), the coefficients (17), Table 1, the lengths, the first input."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_least, at_most, equal, greater, less
from workbench.proof.derive import lie_derivative
from workbench.proof.printed_values import as_printed

from ..laws import epsilon, eta, lamda, mu, rho
from ..notation import T_d, T_min
from ..paper import paper
from ..plant import M, T_s, b_0k, b_1k, b_2k, basic_resistance, davis_newton, desired_pieces, desired_speed, k, v_i
from ..stated_values import FIRST_INPUT, LENGTH, MASS, SPEED_MAX, learning, stated, study, trials

speed = sp.Symbol("v_dk", real=True)
# (16): number of the line, borders, the line, its reading, what is printed, and what its values at the borders make of it
LINES: tuple[tuple[int, int, int, str, str, sp.Expr, Relation], ...] = (
    (1, 0, 338, r"-\frac{35}{57122}(k-338)^2 + 70", "A parabola from 0 at k = 0 to its top 70 at 338.",
     -sp.Rational(35, 57122) * (k - 338) ** 2 + 70, equal(70 - speed, 70 * ((338 - k) / 338) ** 2)),
    (2, 338, 700, r"\frac{1}{181}k + \frac{12332}{181}", "Straight from 70 at k = 338 to 72 at 700.",
     k / 181 + sp.Rational(12332, 181), equal((speed - 70) * (700 - 338), (72 - 70) * (k - 338))),
    (3, 700, 1000, r"-0.01k + 79", "Straight from 72 at k = 700 to 69 at 1000.",
     -sp.Rational(1, 100) * k + 79, equal((speed - 72) * (1000 - 700), (69 - 72) * (k - 700))),
    (4, 1000, 1600, r"\frac{1}{600}k + \frac{202}{3}", "Straight from 69 at k = 1000 to 70 at 1600.",
     k / 600 + sp.Rational(202, 3), equal((speed - 69) * (1600 - 1000), (70 - 69) * (k - 1000))),
    (5, 1600, 2000, r"-\frac{7}{16000}(k-1600)^2 + 70", "A parabola from its top 70 at k = 1600 to 0 at 2000.",
     -sp.Rational(7, 16000) * (k - 1600) ** 2 + 70, equal(70 - speed, 70 * ((k - 1600) / 400) ** 2)),
)


def _line(number: int, low: int, high: int, latex: str, reading: str, printed: sp.Expr, by_values: Relation) -> None:
    @paper.claim(f"16.{number}", f"The desired speed, line {number} of (16)", "identity", rf"v_d(k) = {latex}, \quad \text{{if }} k \in [{low}, {high}]", "proved",
                 severity="data", where={"v_d(k)": speed}, reading=reading,
                 note="The text states no unit; (1) with forces in N, M in kg and T_s in s makes the speeds m/s. Where two lines give a value at their common border they agree: 16.continuous.")
    def desired() -> Goal:
        return Goal((equal(speed, printed),), (by_values, at_least(k, low), at_most(k, high)))


for line in LINES:
    _line(*line)


BORDERS = (338, 700, 1000, 1600)
INSTANTS = sp.symbols("k_start k_1:5 k_end", real=True)


@paper.claim("16.continuous", "The desired speed starts and ends at rest and is continuous", "identity",
             r"v_d(0) = v_d(2000) = 0,\ v_d(338) = 70,\ v_d(700) = 72,\ v_d(1000) = 69,\ v_d(1600) = 70", "proved", origin="implied", severity="data",
             note="One finding with six places; at the four borders both pieces have the value.")
def continuous() -> Goal:
    """The pieces that are simulated, on both sides of each border."""
    heights = (0, 70, 72, 69, 70, 0)
    sides = [(None, desired_pieces[0]), *pairwise(desired_pieces), (desired_pieces[-1], None)]
    shown = [equal(piece[2].xreplace({k: at}), height) for at, height, both in zip(INSTANTS, heights, sides, strict=True) for piece in both if piece]
    return Goal(tuple(shown), tuple(equal(at, border) for at, border in zip(INSTANTS, (0, *BORDERS, 2000), strict=True)))


@paper.claim("16.acceleration", "The desired acceleration jumps at all four borders", "identity",
             r"\dot v_d(k^+) - \dot v_d(k^-) = \tfrac{1}{181}, -\tfrac{1}{181} - \tfrac{1}{100}, \tfrac{7}{600}, -\tfrac{1}{600}\ "
             r"\text{at}\ k = 338, 700, 1000, 1600", "proved", origin="ours", premises=("16.continuous",),
             note="Per unit of k. An input that tracks (16) exactly jumps there too.")
def acceleration_jumps() -> Goal:
    """Slopes on both sides of the borders."""
    jumps = (sp.Rational(1, 181), -sp.Rational(1, 181) - sp.Rational(1, 100), sp.Rational(7, 600), -sp.Rational(1, 600))
    slopes = [lie_derivative(piece, {k: sp.Integer(1)}) for _, _, piece in desired_pieces]
    found = [(right - left).xreplace({k: at}) for (left, right), at in zip(pairwise(slopes), INSTANTS[1:-1], strict=True)]
    return Goal(tuple(equal(change, jump) for change, jump in zip(found, jumps, strict=True)),
                tuple(equal(at, border) for at, border in zip(INSTANTS[1:-1], BORDERS, strict=True)))


@paper.claim("16.force", "With k counting samples and speeds in m/s no train can follow the first step of (16)", "condition",
             r"\frac{v_d(1) - v_d(0)}{T_s} > 2\ \tfrac{m}{s^2}", "proved", premises=("16.1",), at=stated(T_s), origin="ours",
             note="2 m/s^2 is generous for a train. In km/h it would be 1.15 m/s^2, which a train can. With k counting samples of 0.1 s, as (1) has it, (16) asks for 4.1 m/s^2, 1.4 MN for this train. "
                  "With k in seconds it is 0.41 m/s^2, over a trip of 123 km between two stops.")
def first_step_infeasible() -> Goal:
    """The speed gained in the first sample over its duration."""
    return Goal((greater((desired_speed(1, 0) - desired_speed(0, 0)) / T_s, 2),))


@paper.claim("16.samples", "2000 steps of T_s make the trip of T_d = 2000 s", "condition",
             r"k \in \{0, 1, \dots, T_d\},\ T_s = 0.1\,\text{s},\ T_d = 2000\,\text{s}", "violated",
             at={**stated(T_s), T_d: Fraction(2000)},
             reading="The steps of (1), each of the length T_s, make the duration T_d of the trip; both are in seconds.",
             note="k in {0, ..., T_d} counts steps of (1), each T_s = 0.1 s long, and T_d, T_i and (16) take it for seconds: 2000 steps of 0.1 s are 200 s, and (16), read in m/s, begins with 0.41 m/s in one step "
                  "(16.force). Either T_s is 1 s, or the trip has 20,000 steps, with k/10 in (16) and (17). For u in N/kg, where (1) has no M and p is T_s, and T_s = 1 s the bound rho^2 p^2/16 of the Conclusion, mended, is 0.00375, above Table 1's lambda (theorem1.stated.mass.1s.contracts): "
                  "not every positive estimate makes the error of the first sample smaller, those between 0.00041 and 0.122 do not. For 20,000 steps the bound is 0.0000375, and Table 1 meets it (theorem1.stated.mass.contracts).")
def steps_make_the_trip() -> Goal:
    """Steps times their length."""
    return Goal((equal(LENGTH * T_s, T_d),))


@paper.claim("16.end", "A trial of the shortest length ends at more than 30 m/s", "inequality", r"v_d(1901) > 30\ \tfrac{m}{s}", "proved",
             premises=("16.continuous",), origin="ours",
             note="A trial cut at T_i leaves the train in motion: what varies in the simulation is the length of the data, not "
                  "the time that the train takes for its trip, with which the introduction motivates it.")
def trial_ends_in_motion() -> Goal:
    """The last piece of (16) at T_min + 1."""
    return Goal((greater(desired_speed(1901, 4), 30),))


swing = sp.Symbol("sin_k", real=True)


@paper.claim("17", "The resistance coefficients", "identity",
             r"b_0(k) = \frac{2977 + 275 \sin(0.0037k)}{M}, \quad b_1(k) = \frac{25.17 + 2.5 \sin(0.0037k)}{M}, \quad b_2(k) = \frac{0.2864 + 0.04 \sin(0.0037k)}{M}", "proved",
             severity="data", where={r"\sin(0.0037k)": swing}, reading="The coefficients that the study runs, mean and swing over M, are those of the printed line.")
def coefficients_as_run() -> Goal:
    """Mean and swing of the plant against the printed numbers."""
    run = tuple(equal(M * s - mean, part * swing) for s, (mean, part) in davis_newton.items())
    return Goal((equal(b_0k, (2977 + 275 * swing) / M), equal(b_1k, (sp.Rational("25.17") + sp.Rational("2.5") * swing) / M),
                 equal(b_2k, (sp.Rational("0.2864") + sp.Rational("0.04") * swing) / M)), run)


@paper.claim("17.positive", "The resistance coefficients are positive at all times", "inequality",
             r"b_0(k), b_1(k), b_2(k) > 0", "proved", premises=("17",), origin="ours",
             note="Needed for a damping train, a <= 1 in 5.trials. Decided for every value of the sine.")
def coefficients_positive() -> Goal:
    """Mean and swing of (17), over the stated M."""
    return Goal(tuple(greater((mean + part * swing) / MASS.numerator, 0) for mean, part in davis_newton.values()),
                (at_most(swing, 1), at_least(swing, -1)))


@paper.claim("17.units", "(17) put into (1) gives the train its resistance", "condition",
             r"\frac{1}{M}f_b = \frac{2977 + 25.17 v + 0.2864 v^2}{M}\ \text{with (17)}", "violated", rests_on=("1", "3", "17"),
             at={**stated(M), v_i: Fraction(70), swing: Fraction(0)},
             origin="implied",
             reading="By (1) f_b is a force, and by its numbers (17) is one in newtons over M. Speeds are read in m/s, in which (1) gives them for N, kg and s; the text prints no unit. Both sides are in m/s^2.",
             note="(17) is divided by M, and (1) divides by M once more, so that the train runs with a resistance 350,000 "
                  "times too small. Either (17) is in N without its M, or u and, as Figure 4 has it, f_a are forces per unit of mass and "
                  "(1) has no M. The text does not say which, and what u(k,0) = 1500, lambda and the gains do depends on it: if (17) is in N, 1500 N does not move the train on a level line (u0.N); in N/kg the first trial is "
                  "faster than (16) after one sample (u0.mass). The units of u and of the speeds, and phi_hat(k,1), should be stated.")
def resistance_of_both() -> Goal:
    """Deceleration by (1) with (17) against the resistance in N over M, at 70 m/s."""
    per_kg = {s: (mean + part * swing) / M for s, (mean, part) in davis_newton.items()}
    in_newton = {s: mean + part * swing for s, (mean, part) in davis_newton.items()}
    both = basic_resistance(v_i)
    return Goal((equal(both.xreplace(per_kg) / M, both.xreplace(in_newton) / M),))


TABLE_1 = as_printed({name: (learning[name], text) for name, text in (
    ("eta", "1"), ("rho", "0.245"), ("lamda", "0.00005"), ("mu", "0.1"), ("epsilon", "0.00001"), ("K_p", "4.46"), ("K_d", "1000"))})
TRAIN = as_printed({
    "M": (study["train"]["mass_kg"], "350000"), "T_s": (study["readings"]["N"]["step_s"], "0.1"), "T_d": (trials["desired_length_k"], "2000"),
    "T_min": (trials["shortest_length_k"], "1900"), "i_last": (trials["count"], "150"), "u_0": (learning["first_input"], "1500")})
STUDY = "The values that the simulation takes for them, from the study's file."


@paper.claim("table1.values", "The parameters of Table 1", "condition",
             r"\eta = 1, \rho = 0.245, \lambda = 0.00005, \mu = 0.1, \varepsilon = 10^{-5}, K_p = 4.46, K_d = 1000", "proved", match="words",
             severity="data", at=TABLE_1.at, rests_on=(), reading=STUDY)
def parameters_as_printed() -> Goal:
    """Seven numbers of Table 1."""
    return TABLE_1.goal()


@paper.claim("section4.values", "Train, sampling, lengths, trials and the first input", "condition",
             r"T_s = 0.1\ \text{s}, M = 350\,000\ \text{kg}, T_d = 2000\ \text{s}, T_d - T_{\min} = 100, i = 150, u_f(k, 0) = 1500", "proved",
             match="words", severity="data", at=TRAIN.at, rests_on=(), reading=STUDY + " T_d = 2000 is taken as samples, see 16.samples.")
def setting_as_printed() -> Goal:
    """Six numbers of section 4."""
    return TRAIN.goal()


@paper.claim("table1", "Table 1 meets what section 2 asks of the parameters", "condition",
             r"\rho \in (0, 1],\ \eta \in (0, 1],\ \lambda > 0,\ \mu > 0,\ \varepsilon > 0", "proved", at=stated(rho, eta, lamda, mu, epsilon),
             reading="With eta = 1, rho = 0.245, lambda = 0.00005, mu = 0.1, epsilon = 10^-5; the bounds stand below (7) to (10) and, that epsilon is positive, in words below (13).")
def table_1() -> Goal:
    """The five parameters."""
    return Goal((greater(rho, 0), at_most(rho, 1), greater(eta, 0), at_most(eta, 1), greater(lamda, 0), greater(mu, 0), greater(epsilon, 0)))


chance = sp.Symbol("p_l", real=True)


@paper.claim("A3", "Assumption 3: the length of a trial has a known distribution", "condition",
             r"P[T_i = T_{\min} + l] = 1/100,\ l \in [1, \dots, 100],\ 0 \leq p_l < 1", "proved",
             at={chance: Fraction(1, 100), T_d: Fraction(2000), T_min: Fraction(1900)},
             reading="Decided for the distribution of section 4: each probability lies in [0, 1), and those of the T_d - T_min lengths sum to one.",
             note="T_i = 1900 = T_min, the end of the printed range [1900, 2000], does not occur.")
def simulated_distribution() -> Goal:
    """A hundred lengths with a probability of 1/100."""
    return Goal((at_least(chance, 0), less(chance, 1), equal((T_d - T_min) * chance, 1)))


first = sp.Symbol("u_0", positive=True)


@paper.claim("u0.N", "u(k,0) = 1500 N does not move a train on a level line with the resistance (17) in N", "condition", r"u_f(k,0) < b_0", "proved",
             at={first: Fraction(FIRST_INPUT), b_0k: Fraction(2977)}, origin="ours",
             note="If u is in N and (17) in N too (its M dropped), 1500 N does not even overcome the resistance of 2977 N at standstill, unless f_a helps, down a slope.")
def first_input_too_small() -> Goal:
    """Net force at standstill in the first trial."""
    return Goal((less(first, b_0k),))


@paper.claim("u0.mass", "u(k,0) = 1500 N/kg makes the train faster than (16) in one sample", "condition", r"T_s\,u_f(0,0) > 72\ \tfrac{m}{s}", "proved",
             at={first: Fraction(FIRST_INPUT), **stated(T_s)}, origin="ours",
             note="If u is in N/kg, as (17) suggests, the first trial reaches 150 m/s within the first sample of 0.1 s.")
def first_input_too_large() -> Goal:
    """Speed after the first sample, resistance left out."""
    return Goal((greater(T_s * first, SPEED_MAX),))
