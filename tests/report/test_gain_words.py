"""What the numbers of runs with other gains are called."""

from __future__ import annotations

import pytest

from workbench.paper.results import ResultTable
from workbench.report.gain_words import column, letter, spoken, with_powers


@pytest.mark.parametrize(("key", "words", "heading"), [
    ("s_tilde_m_rms", "RMS of s_tilde", "RMS of s_tilde (m)"), ("speed_mps_rms", "RMS of speed", "RMS of speed (m/s)"),
    ("mse_50", "mean squared error of trial 50", "mean squared error of trial 50"),
    ("position_rms", "RMS of the position error", "RMS of the position error (m)"),
    ("q1_error_largest", "q1 error largest", "q1 error largest")])
def test_a_number_is_called_by_words_and_its_column_by_its_unit_too(key, words, heading):
    assert spoken(key) == words and column(key).heading == heading


def test_energies_stand_in_the_unit_of_the_page():
    table = ResultTable("runs", "ours", (column("energy_J"), column("braking_energy_J")), ((7.2e6, 3.6e6),))
    assert table.headings == ("energy (kWh)", "braking energy (kWh)") and table.text == (("2.00", "1.00"),)


def test_a_gain_is_called_by_its_letter():
    assert [letter(name) for name in ("lamda", "lamda_1", "k_2")] == ["lambda", "lambda_1", "k_2"]


def test_powers_of_ten_are_written_as_people_do():
    assert with_powers("mu = 5e-05 1/s, rounded to 1e-12; 2.447e+04, claim 3e and f2e1") == (
        "mu = 5 × 10⁻⁵ 1/s, rounded to 10⁻¹²; 2.447 × 10⁴, claim 3e and f2e1")
