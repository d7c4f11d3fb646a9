"""What a symbol is declared is kept by a run: sympy simplifies by it, |h| to h where h is positive."""

import numpy as np
import pytest
import sympy as sp

import workbench as wb
from workbench.model.law import LawState

x, u = sp.symbols("x u", real=True)
h, p, q = sp.symbols("h p q", positive=True)
n = sp.Symbol("n", negative=True)
whole = sp.Symbol("N", integer=True)
FREE = wb.Plant("free", (x,), (u,), (u,))
FALLING = wb.Plant("falling", (h,), (-sp.Abs(h) - 1,))
PUSHED = wb.Plant("pushed", (x,), (sp.Abs(p),), (p,), input_limits={p: (0, 2)})
DRAWN = wb.Plant("drawn", (x,), (sp.Abs(q),), disturbances=(q,))


def ran(plant, law=None, duration_s=1.0, **more):
    return wb.simulate(plant, law, period_s=0.1, duration_s=duration_s, step_s=0.01, **more)


@pytest.mark.parametrize(("made", "told"), [
    (lambda: wb.Parameter(n, 5.0), "parameter 'n' = 5, but the symbol is declared negative"),
    (lambda: wb.Parameter(whole, 2.5), "'N' = 2.5, but the symbol is declared integer"),
    (lambda: ran(FALLING, initial={"h": -1}), "initial.h = -1, but the symbol is declared positive"),
    (lambda: wb.Plant("p", (x,), (p,), (p,)), "input 'p' is declared positive or zero, which its limits do not keep"),
    (lambda: wb.Plant("p", (x,), (n,), (n,), input_limits={n: (-1, 1)}), "input 'n' is declared negative or zero"),
    (lambda: wb.Plant("p", (x,), (u,), (u,), outputs={p: x}), "output 'p' is declared to be nonnegative, and x is not"),
    (lambda: wb.Plant("p", (x,), (whole,), (whole,)), "'N' is declared integer, and nothing keeps it whole"),
    (lambda: wb.Plant("p", (whole,), (-whole,)), "'N' is declared integer"),
    (lambda: ran(DRAWN, disturbances={"q": wb.Sine(offset=1, amplitude=2, period_s=1)}),
     "disturbances.q takes the value -1, but the symbol is declared positive"),
    (lambda: ran(FREE, wb.Law("l", {u: sp.Abs(p)}, states=(LawState(p, rate=0),)), law_initial={"p": -1}),
     "initial value of 'p' = -1, but the symbol is declared positive")])
def test_a_value_that_its_symbol_is_declared_not_to_have_is_refused(made, told):
    with pytest.raises(ValueError, match=told):
        made()


def test_a_run_ends_where_a_state_leaves_the_sign_it_is_declared_to_have():
    """h' = -|h| - 1 from 1 is 2 exp(-t) - 1, zero at log 2; beyond it the simplified rate would be another one."""
    found = ran(FALLING, initial={"h": 1})
    assert found.found.reached_s == pytest.approx(0.70)  # the first plant step after log 2 = 0.693 s
    assert "left the plant's domain (h >= 0, as its symbol is declared) at t = 0.7 s" in str(found.failed)
    counts = wb.Law("counts", {u: sp.Abs(p)}, states=(LawState(p, rate=-1),), initial={p: sp.Rational(1, 4)})
    told = str(ran(FREE, counts).failed)
    assert "left its domain (p >= 0, as its symbol is declared) at t = 0.3 s" in told


def test_signs_that_are_kept_run():
    """An input within its limits, a mode that is whole, a disturbance that is not stated, a state that begins at zero.
    """
    assert ran(PUSHED, wb.Law("l", {p: -1})).metrics["p_rms"] == 0.0
    assert np.ptp(ran(DRAWN)["x"]) == 0.0
    assert ran(wb.Plant("mode", (x, whole), (whole, 0)), initial={"N": 2})["x"][-1] == pytest.approx(2.0)
    assert ran(wb.Plant("squared", (x,), (1,), outputs={p: 1 + x**2})).failed is None
    rises = ran(wb.Plant("rises", (h,), (1 - h,)))
    assert rises.failed is None
    assert rises["h"][-1] == pytest.approx(1 - np.exp(-1), rel=1e-8)
