"""Cells of result tables: numbers stay numbers until they are shown or written."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.files.numbers import NOTHING, number, typeset
from workbench.paper.cells import FORCES, Column, Phrase, Quantity, Scaled, cell_text, cell_value, is_finite, numbers_in

ENERGY, PLAIN = Column("energy", "kWh", 3.6e6), Column("trials")


def test_a_column_says_its_unit_once():
    assert ENERGY.heading == "energy (kWh)"
    assert PLAIN.heading == "trials"


@pytest.mark.parametrize(("cell", "column", "text", "value"), [
    (7.2e6, ENERGY, "2.00", 2.0), (None, ENERGY, NOTHING, None), ("failed", ENERGY, "failed", "failed"),
    (3, PLAIN, "3", 3), (Quantity(0.25, "mm", 1e-3), ENERGY, "250 mm", 0.25),
    (Quantity(None, "mm", 1e-3), ENERGY, NOTHING, None), (Quantity(5.0), ENERGY, "5.00", 5.0),
    (Phrase("{} → {}", (7.2e6, 3.6e6)), ENERGY, "2.00 → 1.00", [2.0, 1.0]),
    (Phrase("no, {} left", (Quantity(0.5, "s"),)), ENERGY, "no, 0.500 s left", [0.5]),
    (Phrase("{}", (None,)), ENERGY, NOTHING, [None]), (Phrase("never", ()), ENERGY, "never", []),
    (Phrase("{} of {}", ("1/3", 2)), PLAIN, "1/3 of 2", [2]),
    (0.00025, Column("period", "ms", 1e-3, None), "0.25", 0.25),
    (1234.5678, Column("x", digits=None), "1234.5678", 1234.5678),
    (-0.004, Column("x", decimals=2), "0.00", -0.004), (2.0, Column("x", decimals=1), "2.0", 2.0),
    (Quantity(1.51, "s", decimals=3), ENERGY, "1.510 s", 1.51),
    (Scaled(0.0), ENERGY, "0 nm", 0.0), (Scaled(4e-3), ENERGY, "4 mm", 4e-3),
    (Scaled(0.9276), ENERGY, "928 mm", 0.9276), (Scaled(3.24e-6), ENERGY, "3.2 µm", 3.24e-6),
    (Scaled(25.4), ENERGY, "25 m", 25.4),
    (Scaled(None), ENERGY, NOTHING, None),
    (Scaled(-2.165e6, FORCES), ENERGY, "−2165 kN", -2.165e6), (Scaled(1.23e7, FORCES), ENERGY, "12 MN", 1.23e7),
    (Phrase("{}, settles to {}", (Scaled(0.55), Scaled(1e-4))), PLAIN, "550 mm, settles to 100 µm", [0.55, 1e-4]),
])
def test_a_cell_is_shown_in_its_unit_and_kept_as_a_number(cell, column, text, value):
    assert cell_text(cell, column) == text
    assert cell_value(cell, column) == (pytest.approx(value) if isinstance(value, float) else value)


@given(st.floats(1e-12, 1e12), st.sampled_from([1.0, 1e-3, 3.6e6, 1000.0]), st.integers(2, 6))
def test_what_is_shown_is_the_number_in_its_unit_to_its_digits(value, si, digits):
    column = Column("c", "u", si, digits)
    assert cell_text(value, column) == number(value / si if si != 1 else value, digits)
    assert cell_value(value, column) == pytest.approx(value / si)
    assert list(numbers_in(value)) == [value]


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_what_is_not_finite_is_found_wherever_it_stands(bad):
    for cell in (bad, Quantity(bad, "m"), Phrase("{} of {}", (1.0, bad)), Phrase("{}", (Quantity(bad),))):
        assert not is_finite(cell)
    for word in ("nan", "inf", "-inf"):
        assert not is_finite(word)
    for cell in (None, "left its domain", 0.0, Quantity(None), Phrase("{}", (None, )), Phrase("{}", (2.0,))):
        assert is_finite(cell)


@pytest.mark.parametrize(("message", "shown"), [
    ("diverged at t = 105.789 s, s = 16867.337 m, v = -1.511e+06 m/s",
     "diverged at t = 105.789 s, s = 16\u202f867.337 m, v = −1.511\u202f×\u202f10⁶ m/s"),
    ("x_1 = -0.5, u = 2e-07 N", "x_1 = −0.5, u = 2\u202f×\u202f10⁻⁷ N"),
    ("law = 3rd, at 12345, file = 1.2.3", "law = 3rd, at 12345, file = 1.2.3")])
def test_a_message_has_its_numbers_as_a_page_writes_them(message, shown):
    assert typeset(message) == shown
