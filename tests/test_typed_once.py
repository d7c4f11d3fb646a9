"""What numba remembers of numbers and arrays while it compiles is what it finds anew at every sign and index."""

import numpy as np
import pytest
from numba import boolean, float64, int64, njit
from numba.core.compiler import Flags
from numba.core.targetconfig import TargetConfig
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


def indices(row, table, i):
    row[i] = row[0] + 1
    row[-1] = table[1, i] * 2
    table[i, 0] += row[i]
    table[0] = row[1] / 3
    row[:2] = table[i, 1:]
    return table[i], table[:, 1], table[0][i], row[1:], row.shape[0], len(table), row[i] == table[(1, 1)]


@pytest.mark.parametrize("types", [(float64[::1], float64[:, ::1], int64), (float64[:], float64[:, :], int64),
                                   (int64[::1], float64[:, ::1], int64), (float64[::1], int64[::1, :], int64)], ids=str)
def test_so_are_those_of_indices_whatever_an_array_holds_and_however_it_lies(types):
    def given():
        row, table = np.arange(3)[::-1] + 1, np.arange(9).reshape(3, 3)[:2] + 2
        return row.astype(types[0].dtype.name), np.array(table, types[1].dtype.name, order=types[1].layout), 1

    alone = njit(error_model="numpy")(indices)
    alone.compile(types)
    wanted = given()
    shown = repr(alone(*wanted)), repr(wanted)
    with typed_once():
        for _ in range(2):
            found, taken = njit(error_model="numpy")(indices), given()
            found.compile(types)
            assert found.nopython_signatures[0] == alone.nopython_signatures[0]
            assert (repr(found(*taken)), repr(taken)) == shown


def test_options_are_the_same_where_numba_says_so():
    plain, stated, other = Flags(), Flags(), Flags()
    stated.nrt, other.nrt = Flags.options["nrt"].default, not Flags.options["nrt"].default
    before = [hash(one) for one in (plain, stated, other)], [plain == one for one in (stated, other, 1)]
    with typed_once():
        assert ([hash(one) for one in (plain, stated, other)], [plain == one for one in (stated, other, 1)]) == before
        assert plain == Flags() and other == other.copy()
    assert before[1] == [True, False, False], "a value that is stated is the same as one that is not"


def test_numba_is_as_it_was_afterwards_whatever_happens():
    before = BaseFunction.get_call_type, TargetConfig.__hash__, TargetConfig.__eq__
    with pytest.raises(ZeroDivisionError), typed_once(), typed_once():
        assert BaseFunction.get_call_type is not before[0] and TargetConfig.__eq__ is not before[2]
        raise ZeroDivisionError
    assert (BaseFunction.get_call_type, TargetConfig.__hash__, TargetConfig.__eq__) == before
