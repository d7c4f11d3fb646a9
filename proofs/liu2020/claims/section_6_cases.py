"""Section 6: what the text says of Table 2's columns, the figures it repeats from Table 3, and the figures' ranges."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import sympy as sp

from workbench.proof.claim import Goal, Relation, at_most, equal, less

from ..paper import paper
from ..stated_values import exactly, stated
from .section_6 import Printed, falling, printed

OBSERVER, CONTROL = ("k_1", "k_2", "k_3"), ("k_4", "k_5")


def gains(names: Sequence[str], columns: Sequence[int]) -> tuple[list[list[sp.Symbol]], Printed]:
    """Symbols for the gains of some columns of Table 2, a list a gain, and the values printed for them."""
    symbols = [[sp.Symbol(f"{name}_{column}", positive=True) for column in columns] for name in names]
    return symbols, {symbol: exactly(stated["gains"][name][column - 1]) for name, line in zip(names, symbols, strict=True)
                     for symbol, column in zip(line, columns, strict=True)}


def alike(*lines: Sequence[sp.Symbol]) -> tuple[Relation, ...]:
    """All values of a line are equal."""
    return tuple(equal(line[0], other) for line in lines for other in line[1:])


observer_1_5, observer_values = gains(OBSERVER, range(1, 6))
control_1_5, control_values = gains(CONTROL, range(1, 6))


@paper.claim("table2.case1", "Case 1 changes the gains of the observer alone", "condition",
             r"\text{Case 1: the control parameters are unchanged; the value of estimated parameters is increased}", "proved",
             match="words", at=observer_values | control_values,
             reading="Values 1 to 5 of Table 2: k_4 and k_5 are the same, k_1, k_2 and k_3 grow.")
def case_1_changes_the_observer() -> Goal:
    """Twenty-five gains of Table 2."""
    return Goal((*alike(*control_1_5), *falling(*(line[::-1] for line in observer_1_5))))


observer_5_9, observer_values_5_9 = gains(OBSERVER, range(5, 10))
control_5_9, control_values_5_9 = gains(CONTROL, range(5, 10))


@paper.claim("table2.case2", "Case 2 compares gains of which one group is the same", "condition",
             r"\text{Values 5 and 6, which have the same estimated parameters and different tracking control parameters. We "
             r"also consider Values 7 and 8 for comparison. Values 6, 8, and 9 have the same control parameters and different "
             r"estimated parameters}", "proved", match="words", at=observer_values_5_9 | control_values_5_9,
             reading="In Table 2 k_1, k_2, k_3 agree in 5 and 6 and in 7 and 8, while k_4 and k_5 grow; 6, 8 and 9 agree "
                     "in k_4 and k_5, while k_1, k_2 and k_3 grow.")
def case_2_compares_pairs() -> Goal:
    """Columns 5 to 9 of Table 2."""
    pairs = [line[i:i + 2] for line in observer_5_9 for i in (0, 2)]
    control = [line[i:i + 2][::-1] for line in control_5_9 for i in (0, 2)]
    same = [[line[i] for i in (1, 3, 4)] for line in control_5_9]
    growing = [[line[i] for i in (4, 3, 1)] for line in observer_5_9]
    return Goal((*alike(*pairs, *same), *falling(*control, *growing)))


ROWS_5_6 = ("s_tilde_m", "v_tilde_mps", "position_m")
lines_5_6, table_5_6 = printed("table_3", ROWS_5_6, (5, 6))
TEXT_5_6 = (("0.6257", "0.6022"), ("0.5132", "0.4957"), ("89.1299", "0.4084"))
case_3, values_10 = gains((*OBSERVER, *CONTROL), (10,))
TEXT_10 = ("140", "35", "175", "28", "3115000")


@paper.claim("text.values", "What else the text repeats from Tables 2 and 3 stands there", "condition",
             r"\bar s: 0.6257, 0.6022,\quad \bar v: 0.5132, 0.4957,\quad s - s_d: 89.1299, 0.4084;\quad k_1 = 140, k_2 = 35, "
             r"k_3 = 175, k_4 = 28, k_5 = 3115000", "proved", match="words", at=table_5_6 | values_10,
             reading="The figures of the text on Cases 1 and 2, for Values 5 and 6 in this order, against Table 3, and the "
                     "gains of Case 3 against Value 10 of Table 2; for v - v_d see text.value5.")
def values_of_the_text() -> Goal:
    """Eleven figures of the text against the tables."""
    of_values = [(symbol, text) for line, texts in zip(lines_5_6, TEXT_5_6, strict=True)
                 for symbol, text in zip(line, texts, strict=True)]
    of_gains = [(line[0], text) for line, text in zip(case_3, TEXT_10, strict=True)]
    return Goal(tuple(equal(symbol - sp.Rational(text), 0) for symbol, text in (*of_values, *of_gains)))


position_5_9, positions = printed("table_3", ("position_m",), range(5, 10))


@paper.claim("table3.much", "Case 2: the position errors of Values 6, 8 and 9 are much smaller than those of 5 and 7", "condition",
             r"\text{However, it is also much smaller than Values 5 and 7}", "proved", match="words", at=positions,
             reading="Much smaller is read as less than a tenth.")
def position_errors_much_smaller() -> Goal:
    """Five RMS values of Table 3."""
    five, six, seven, eight, nine = position_5_9[0]
    return Goal(tuple(less(10 * small, large) for small in (six, eight, nine) for large in (five, seven)))


every_column, table_3_rms = printed("table_3", ("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps"), range(1, 11))


@paper.claim("table3.value10", "Value 10 has the smallest errors of Table 3", "condition",
             r"\text{The RMS values of}\ \bar s, \bar v, s - s_d,\ \text{and}\ v - v_d\ \text{in Table 3 are greatly reduced}", "proved",
             match="words", at=table_3_rms,
             reading="Each of the four RMS values of Value 10 is below those of all other columns.",
             note="'Greatly' fits s_tilde and s - s_d, which fall to a hundredth of Value 9 and less; v_tilde and v - v_d fall "
                  "to about 60 %.")
def value_10_is_best() -> Goal:
    """Forty RMS values of Table 3."""
    return Goal(tuple(less(line[-1], other) for line in every_column for other in line[:-1]))


FIGURES = ("s_tilde_m", "v_tilde_mps", "position_m", "speed_mps")
rms_4, table_4_rms = printed("table_4", FIGURES, (1, 2, 3))
largest = [sp.Symbol(f"{row}_largest", real=True) for row in ("s_tilde", "v_tilde", "s_error", "v_error")]
figure_values: dict[sp.Expr, Fraction] = {
    symbol: max(abs(exactly(end)) for end in stated["figure_ranges"][row]) for symbol, row in zip(largest, FIGURES, strict=True)}


@paper.claim("figures.ranges", "Table 4 fits the ranges of Figures 14 to 17", "condition",
             r"\text{[...] in the range of } [-4 \times 10^{-4}, 1 \times 10^{-4}] \text{ (m) [...] } [-0.03, 0.01] \text{ (m/s) [...] } [-0.03, 0.01] \text{ (m/s) [...] }"
             r"[-0.06, 0.04] \text{ (m/s)}", "proved", match="words", at=table_4_rms | figure_values,
             reading="An RMS value is no larger than the largest size; of s_tilde, v_tilde, s - s_d and v - v_d under the three "
                     "disturbances of Case 3. The unit m/s of Figure 16, a position error, is read as m.",
             note="The captions of Figures 14 and 15 are the same, while the text says that Figure 14 shows the position. "
                  "Table 3 does not fit Figure 15, see figure15.")
def rms_within_ranges() -> Goal:
    """Twelve RMS values of Table 4 against the largest sizes in the figures."""
    return Goal(tuple(at_most(rms, most) for line, most in zip(rms_4, largest, strict=True) for rms in line))


paper.axiom("figures", "Figures 5 to 18: the errors of the runs and how they depend on the gains",
            r"\text{The results show that the system can also obtain good tracking performance under large disturbance.}",
            "read off the figures by the authors", hypotheses=(), match="words", severity="data",
            note="A statement on simulations; the study runs them anew. What the text says of Tables 2 to 4 has rows of its own.")
