"""What numba remembers of numbers while it compiles is what it finds anew at every sign."""

import pytest
from numba import boolean, float64, int64, njit
from numba.core.types.functions import BaseFunction

from workbench.compile.typed_once import typed_once


def signs(a, b):
    return a + b, a - b, a * b, a / b, a // b, a % b, a < b, a == b, abs(a), min(a, b), max(b, 2), -a, a**2, b**0.5


VALUES = {int64: 7, float64: -2.5, boolean: True}


@pytest.mark.parametrize("types", [(int64, int64), (int64, float64), (float64, int64), (float64, boolean),
                                   (float64, float64)], ids=str)
def test_types_and_values_are_those_that_numba_finds_anew(types):
    alone = njit(error_model="numpy")(signs)
    alone.compile(types)
    given = [VALUES[one] for one in types]
    with typed_once():
        for _ in range(2):  # the second finds all of it remembered
            found = njit(error_model="numpy")(signs)
            found.compile(types)
            assert found.nopython_signatures == alone.nopython_signatures
            assert repr(found(*given)) == repr(alone(*given))


def test_numba_is_as_it_was_afterwards_whatever_happens():
    before = BaseFunction.get_call_type
    with pytest.raises(ZeroDivisionError), typed_once(), typed_once():
        assert BaseFunction.get_call_type is not before
        raise ZeroDivisionError
    assert BaseFunction.get_call_type is before
