"""liu2020's observer: decay and noise against poles and transfer functions; what no gains can do."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from proofs.liu2020 import gains as liu2020
from proofs.liu2020.laws import k_1, k_2, k_3
from workbench.errors import SolverError
from workbench.files.toml import read_toml
from workbench.gains.frequency import abscissa, linear
from workbench.gains.search import Infeasible, search
from workbench.gains.stated import Stated
from workbench.proof.checker import check

FILE = Path(__file__).parents[3] / "proofs" / "liu2020" / "study.toml"
COLUMNS = range(1, 11)


@pytest.fixture(scope="module")
def table():
    stated = Stated(FILE, read_toml(FILE))
    return {str(k): stated.numbers(f"gains.{k}") for k in liu2020.GAINS}


@pytest.mark.parametrize("column", COLUMNS)
def test_every_column_is_certified_with_the_signal_that_the_adaptation_uses(table, column):
    values = liu2020._column(table, column)
    rate, certificate, _ = liu2020.best_decay(column, values)
    check(certificate)
    V = sp.sympify(liu2020.OWN.xreplace({liu2020.p: sp.Rational(certificate["values"]["p"])}))
    assert sp.diff(V, liu2020.v_tilde) == liu2020.v_tilde  # dV/dv_tilde is the update signal
    slowest = np.roots([1, float(values[k_1] + values[k_3]), float(values[k_2])]).real.max()
    assert 0 < float(rate) <= -slowest + 1e-9
    # No p proves a rate at which a square alone has the wrong sign.
    assert rate <= min(Fraction(str(values[k])) for k in (k_1, k_3))


def test_no_weight_proves_more_and_the_refusal_is_exact(table):
    values = liu2020._column(table, 4)
    rate, _, _ = liu2020.best_decay(4, values)
    check(liu2020.refusal(4, values, rate * Fraction(101, 100)))
    with pytest.raises(SolverError, match="not refused"):
        liu2020.refusal(4, values, rate * Fraction(9, 10))


def test_the_papers_weight_certifies_two_columns_only(table):
    assert [c for c in COLUMNS if liu2020.papers_weight(c, liu2020._column(table, c))] == [5, 6]


@pytest.mark.parametrize("column", COLUMNS)
def test_noise_passes_as_the_transfer_function_says(table, column):
    values = liu2020._column(table, column)
    one, two, three = (float(values[k]) for k in (k_1, k_2, k_3))
    s = 1j * np.geomspace(1e-5, 1e6, 200_001)
    answer = np.abs((three * s**2 + two * s) / (s**2 + (one + three) * s + two))
    assert liu2020.noise_gain(values) == pytest.approx(answer.max(), rel=1e-4)


@pytest.mark.parametrize("rate", [Fraction(1, 10), Fraction(5)])
def test_the_found_gains_decay_as_wanted_and_come_next_to_the_floor(rate):
    values = liu2020.least_noise(rate)
    search(liu2020.decay_problem("decay.test", liu2020.OWN, (liu2020.p,), values, rate))
    assert -abscissa(linear(liu2020.error_rates(), [], [], values)) >= float(rate)
    assert float(rate) <= liu2020.noise_gain(values) <= 1.03 * float(rate)
    check(liu2020.noise_floor(rate))


def test_below_the_floor_there_are_no_gains_on_a_grid_either():
    """Damping below the rate, whatever k_1, k_2 and p: V' + 2 rate V has a positive square."""
    rate = Fraction(1, 2)
    for one in ("1/2", "1", "10"):
        for two in ("1/10", "1", "100"):
            values = {k_1: sp.Rational(one), k_2: sp.Rational(two), k_3: sp.Rational(49, 100)}
            with pytest.raises((Infeasible, SolverError)):
                search(liu2020.decay_problem("decay.test", liu2020.OWN, (liu2020.p,), values, rate))
