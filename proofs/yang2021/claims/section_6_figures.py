"""yang2021, section 6: the figures and sentences on the runs, held against each other."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import sympy as sp

from workbench.proof.claim import D, Goal, Relation, at_least, at_most, equal, greater, less
from workbench.trains.train import a_star, b_star, c_star, f, u

from ..error_dynamics import plant
from ..laws import x_2
from ..paper import paper
from ..stated_values import cruise, scenario, stated_davis, stated_k

paper.axiom("figure8.input", "Figure 8: the largest acceleration at the start, and the input on the common section",
            r"\text{When the train started, it needed to overcome its own gravity and other unknown disturbances, and the maximum acceleration value was "
            r"0.48 m/s². [...] When the train was operating in the common route section, [...] it was basically kept at about 0.6 m/s²}",
            "read off Figure 8 by the authors", hypotheses=(), match="words", severity="data",
            note="Two moments of a run: 0.48 m/s^2 is said of the start, 0.6 m/s^2 of the rest. For what 0.6 m/s^2 is, see figure8.acceleration.")


@paper.claim("figure8.acceleration", "The control input is the acceleration", "identity",
             r"\text{the train control input curve of the RBFNN-POCRAC algorithm, i.e., the acceleration curve of train operation}",
             "refuted", severity="cosmetic", match="words", reading="u of (4) is the rate of x_2.", correction=lambda: _input(1),
             corrected_statement=r"u = \frac{F}{m} = \dot{x}_2 + a^* + b^*x_2 + c^*x_2^2 - f(x)",
             note="The input is the specific force F/m; by (4) it and the acceleration differ by the resistances. The 0.6 m/s^2 that Figure 8 is said to be "
                  f"kept at is no acceleration: it is what holds {cruise:.1f} m/s against a* + b* v + c* v^2 on the level.")
def input_is_acceleration() -> Goal:
    """u against the rate of the speed by (4), on a train with the stated coefficients."""
    return _input(0)


def _input(resisted: int) -> Goal:
    """The input against the acceleration, and against what the resistances leave of it to be made good."""
    stated = tuple(equal(s, sp.Rational(v.numerator, v.denominator)) for s, v in stated_davis.items())
    return Goal((equal(u, D(x_2) + resisted * (a_star + b_star * x_2 + c_star * x_2**2 - f)),),
                (at_least(x_2, 0), *stated), {x_2: plant.rates[x_2]})


mean_speed = sp.Symbol("v_mean", nonnegative=True)


def _as_far_as_the_small_radii(shown: Relation, speed: Relation) -> Goal:
    """Where the train is 158 s after it started at 0, against the beginning of the small radii of Table 1."""
    return Goal((shown,), (speed,))


@paper.claim("table1.place", "The largest position error, at 158 s, is where Table 1 has its small radii or large slopes", "implication",
             r"\text{the error grows 'on a route with a large slope and complex curve', is largest at 158 s and 'at other times almost zero'} \Rightarrow x_1(158\,\mathrm{s}) \ge 18000\,\mathrm{m}",
             "gap", origin="implied", severity="data", section="6.2", rests_on=(),
             correction=lambda: _as_far_as_the_small_radii(less(158 * mean_speed, 18000), at_most(mean_speed, 110)),
             corrected_statement=r"v_{\mathrm{mean}} \le 110\,\tfrac{m}{s} \Rightarrow 158\,\mathrm{s} \cdot v_{\mathrm{mean}} < 18000\,\mathrm{m}",
             reading="The error and the hard section are the text's, sections 6.1 and 6.2; that they meet is implied. Table 1 gives its ranges no unit; they are read in metres here, as everywhere in these corrections. Its radii of 800 m and 700 m begin at 18,000, its slopes of 5, 2.5 and -3 per mille at "
                     f"21,400. The train starts at 0, and its mean speed is at most {cruise:.1f} m/s, rounded up to {ceil(cruise)}, at which a* + b* v + c* v^2 is 0.6 m/s^2, the input of the common section.",
             note=f"At {cruise:.1f} m/s the train has come some {158 * cruise / 1000:.1f} km at 158 s, where Table 1 has -1.5 per mille and 1200 m, and {248 * cruise / 1000:.1f} km at 248 s, when the time ends in which the "
                  "text has slope and curve overcome; all that is steeper than 2 per mille comes later, where the error is told to be almost zero. To be at 18 km by 158 s it would have run at 410 km/h. So the ranges are not "
                  "in metres, or the error at 158 s has another cause: please print the unit, and the disturbance that was added. Tenths of a metre, a line of 5.4 km, would fit the times.")
def error_is_where_the_line_is_hard() -> Goal:
    """158 s at the speed of the common section, rounded up to whole m/s."""
    return _as_far_as_the_small_radii(at_least(158 * mean_speed, 18000), equal(mean_speed, ceil(cruise)))


assert scenario.printed_table is not None
TABLE_2 = scenario.printed_table.rows
OF_RUNS = ("33.figures", "37.weights")  # what is told of runs is told of the loop that section 6.1 states
LETTERS = ("e_low", "e_high", "v_low", "v_high")
NAMES = ("rbfnn_pocrac", "pocrac", "rbf_pid", "pid")


def _columns(name: str) -> dict[str, sp.Symbol]:
    return {letter: sp.Symbol(f"{letter}_{name}", real=True) for letter in (*LETTERS, "stop")}


def _printed(name: str) -> dict[sp.Expr, Fraction]:
    row = next(r for r in TABLE_2 if r.controller == name)
    values = (*row.position_error_m, *row.speed_error_mps, row.stopping_accuracy_m)
    return {symbol: Fraction(str(value)) for symbol, value in zip(_columns(name).values(), values, strict=True)}


table_values = {symbol: value for name in NAMES for symbol, value in _printed(name).items()}


@paper.claim("table2", "By its printed entries RBFNN-POCRAC is the best of Table 2 in every column", "condition",
             r"\text{the RBFNN-POCRAC controller had the best position and speed tracking performance and the highest parking "
             r"accuracy}", "proved", rests_on=(), match="words", at=table_values,
             reading="Its ranges of position and speed error lie within those of each of the three others, and its stopping "
                     "accuracy is the smallest.",
             note="Of the printed numbers alone; whether they come from the printed loop is open (33.figures, 37.weights).")
def best_of_the_table() -> Goal:
    """The four ranges within each other and the stopping accuracies in order."""
    best, shown = _columns(NAMES[0]), list[Relation]()
    for name in NAMES[1:]:
        other = _columns(name)
        shown += [at_least(best["e_low"], other["e_low"]), at_most(best["e_high"], other["e_high"]),
                  at_least(best["v_low"], other["v_low"]), at_most(best["v_high"], other["v_high"]),
                  less(best["stop"], other["stop"])]
    return Goal(tuple(shown))


@paper.claim("table2.band", "The printed position errors of RBFNN-POCRAC and POCRAC in Table 2 keep the constraint of 0.2 m", "condition",
             r"\text{the maximum position error is constrained as } e_1(t) = 0.2", "proved", rests_on=(), match="words",
             at={symbol: value for name in NAMES[:2] for symbol, value in _printed(name).items()} | {
                 sp.Symbol("k_stated", positive=True): stated_k},
             reading="The errors of RBFNN-POCRAC and POCRAC over 100 runs are at most 0.2 m in size, and below k.")
def table_keeps_the_band() -> Goal:
    """Both constrained controllers."""
    band, k_stated = sp.Rational(2, 10), sp.Symbol("k_stated", positive=True)
    ends = [_columns(name)[letter] for name in NAMES[:2] for letter in LETTERS[:2]]
    return Goal(tuple(relation(sp.Abs(end), limit) for end in ends for relation, limit in ((at_most, band), (less, k_stated))))


def _width(name: str) -> sp.Expr:
    return _columns(name)["v_high"] - _columns(name)["v_low"]


@paper.claim("table2.speed", "The printed speed errors of the four controllers are in the order that the text tells", "condition",
             r"\text{the train running speed error of the RBFNN-POCRAC controller was the smallest, and the train running speed "
             r"error and fluctuation of the PID controller were the largest. [...] RBFNN-PID control obviously alleviated the speed "
             r"error, but it was still greater than the speed tracking error of the POCRAC controller and RBFNN-POCRAC controller}",
             "proved", rests_on=(), match="words", at=table_values,
             reading="Said of Figure 10; by the widths of the speed errors' ranges in Table 2.")
def speed_errors_in_order() -> Goal:
    """RBFNN-POCRAC below POCRAC below RBFNN-PID below PID."""
    first, second, third, last = map(_width, NAMES)
    return Goal((less(first, second), less(second, third), less(third, last)))


@paper.claim("table2.position", "The printed position errors of PID and RBFNN-PID are far above 0.2 m", "condition",
             r"\text{PID control and RBFNN-PID control exhibited a large position error [...], being far greater than the 0.2 m "
             r"position error defined in this article}", "proved", rests_on=(), match="words",
             at={symbol: value for name in NAMES[2:] for symbol, value in _printed(name).items()},
             reading="Said of Figure 9; in Table 2 both ends of their ranges are more than twice as large.")
def position_errors_of_pid() -> Goal:
    """Both controllers without the constraint."""
    return Goal(tuple(greater(sp.Abs(_columns(name)[letter]), 2 * sp.Rational(2, 10)) for name in NAMES[2:] for letter in LETTERS[:2]))


paper.axiom("figures", "Figures 4 to 10: the curve is tracked with high precision, and the errors are the smallest of the four",
            r"\text{the RBFNN-POCRAC controller had the fastest convergence speed and the smallest overall position error and speed "
            r"error}", "read off the figures by the authors", hypotheses=OF_RUNS, match="words", severity="data",
            note="A statement on simulations, which the study runs anew; for its numbers see 33.figures and table2.")
