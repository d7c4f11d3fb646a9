"""A force table is read in compiled code as numpy reads it, to the bit."""

import numpy as np
import pytest

from workbench.optimal.force_limits import force_in


@pytest.mark.parametrize("rows", [1, 2, 3, 40])
def test_a_table_has_the_bits_of_numpys_interpolation(rows):
    draw = np.random.default_rng(rows)
    table = np.column_stack([np.cumsum(draw.uniform(0.1, 9.0, rows)), draw.uniform(1e4, 4e5, rows)])
    speeds = [0.0, 500.0, *table[:, 0], *np.nextafter(table[:, 0], 0.0), *np.nextafter(table[:, 0], 1e3),
              *draw.uniform(0.0, table[-1, 0] + 2.0, 200)]
    for v in map(float, speeds):
        assert force_in(table, v) == np.interp(v, table[:, 0], table[:, 1])
