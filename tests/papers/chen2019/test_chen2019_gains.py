"""chen2019's gains: against the transfer functions in closed form, and the bounds against measured trials."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from proofs.chen2019 import gains as chen2019
from proofs.chen2019.laws import c_1, c_2, c_3, gains
from proofs.chen2019.simulation.cars_runs import run_cars
from proofs.chen2019.simulation.plans import plan
from proofs.chen2019.study.record import ChenStudy
from workbench.files.toml import read_toml
from workbench.gains.search import search
from workbench.gains.stated import Stated
from workbench.paper.loading import load
from workbench.paper.study import with_values

FILE = Path(__file__).parents[3] / "proofs" / "chen2019" / "study.toml"


def least_gains(values):
    return {which: float(search(chen2019.gain_problem(f"gain.{which}.test", which, values)).objective) ** 0.5
            for which in chen2019.OUTPUTS}


def exactly(values):
    """Of c_3/((s + c_1)(s + c_2)): its value at rest, and the largest of s times it, at sqrt(c_1 c_2)."""
    one, two, three = (float(values[c]) for c in gains)
    return {"position": three / (one * two), "speed": three / (one + two)}


def test_at_the_stated_gains_the_program_finds_the_exact_norms():
    values = Stated(FILE, read_toml(FILE)).symbols("gains", gains)
    found, norms = least_gains(values), exactly(values)
    for which, norm in norms.items():
        assert norm * (1 - 1e-9) <= found[which] <= norm * 1.002


@settings(max_examples=10)
@given(st.integers(1, 400), st.integers(1, 400), st.integers(1, 100))
def test_and_at_any_others(one, two, three):
    values = {c_1: sp.Rational(one, 10), c_2: sp.Rational(two, 10), c_3: sp.Rational(three, 100)}
    found, norms = least_gains(values), exactly(values)
    for which, norm in norms.items():
        assert norm * (1 - 1e-9) <= found[which] <= norm * 1.01


@pytest.mark.parametrize("one", [0.01, 1.0])
def test_the_true_bounds_hold_in_simulated_trials(one):
    """int e^2 <= 2 share (c_1 int z_1^2 + c_2 int z_2^2) + 2 gain^2 int Delta u^2, of all cars, in every trial."""
    study = load(FILE).study
    assert isinstance(study, ChenStudy)
    short = with_values(study.model_copy(update={"changes": ()}), {
        "trials.count": 2, "trials.shown": [1], "gains.c_1": one}, "test")
    run = run_cars(replace(plan(short), kept=()))
    assert run.failed is None
    values = {c_1: sp.Rational(str(one)), c_2: sp.Integer(100), c_3: sp.Rational(1, 25)}
    spent = one * run.total("z_1_square_s") + 100 * run.total("z_2_square_s")
    pushed = run.total("difference_square_s")
    for which, norm in exactly(values).items():
        bound = 2 * float(chen2019.share(which, values)) * spent + 2 * norm**2 * pushed
        assert np.all(run.total(f"{which}_error_square_s") <= bound)
    assert 0 < chen2019.bound_used(run, short) <= 1


def test_equal_poles_have_the_least_gain_of_their_bandwidth():
    values = Stated(FILE, read_toml(FILE)).symbols("gains", gains)
    whole = float(values[c_1] + values[c_2])
    others = [0.04 / (one * (whole - one)) for one in np.linspace(0.01, whole - 0.01, 2001)]
    assert 0.04 / (whole / 2) ** 2 <= min(others)
