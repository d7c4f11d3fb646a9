"""What the numbers of runs with other gains are called."""

from __future__ import annotations

import pytest

from workbench.report.gain_words import heading, letter, spoken


@pytest.mark.parametrize(("key", "words", "column"), [
    ("s_tilde_m_rms", "RMS of s_tilde", "RMS of s_tilde (m)"), ("speed_mps_rms", "RMS of speed", "RMS of speed (m/s)"),
    ("mse_50", "mean squared error of trial 50", "mean squared error of trial 50 (m²/s²)"),
    ("position_rms", "RMS of the position error", "RMS of the position error (m)"),
    ("q1_error_largest", "q1 error largest", "q1 error largest")])
def test_a_number_is_called_by_words_and_its_column_by_its_unit_too(key, words, column):
    assert spoken(key) == words and heading(key) == column


def test_a_gain_is_called_by_its_letter():
    assert [letter(name) for name in ("lamda", "lamda_1", "k_2")] == ["lambda", "lambda_1", "k_2"]
