"""yang2021's gains: the level that is proved against V along a run, the sampling limit against runs on both sides."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import sympy as sp
from scenarios import variant_of

from proofs.yang2021 import gains as yang2021
from workbench.files.toml import read_toml
from workbench.gains.search import search
from workbench.gains.stated import Stated
from workbench.paper.gain_effects import gains_of
from workbench.paper.loading import load
from workbench.simulate.closed_loop import simulate
from workbench.trains.scenario import Variant

FILE = Path(__file__).parents[3] / "proofs" / "yang2021" / "study.toml"


@pytest.fixture(scope="module")
def report():
    return gains_of(load(FILE))


def run_with(changes, period_s):
    key = f"{yang2021.CONTROLLER}.period_s"
    return simulate(variant_of(FILE, Variant(title="test", set={**changes, key: period_s})), "rbfnn_pocrac")


def proved(report, name):
    return next(q for q in report.quantities if q.name == name)


@pytest.mark.parametrize("period_s", [0.001, 0.1])
def test_the_found_gains_keep_the_proved_bounds_and_the_level_of_v_along_the_whole_run(report, period_s):
    gains = {name: float(value) for name, value in report.found[0].values.items()}
    run = run_with(report.found[0].changes, period_s)
    assert run.failed is None
    assert max(abs(run.totals[f"position_error_{end}"]) for end in ("min", "max")) <= 0.2
    assert max(abs(run.totals[f"speed_error_{end}"]) for end in ("min", "max")) <= 0.3
    e_1 = run.column("s_m") - run.column("s_desired_m")
    e_2 = run.column("v_mps") - run.column("v_desired_mps") + gains["alpha"] * e_1
    true = {"a_hat": 0.3, "b_hat": 4e-3, "c_hat": 1.6e-4}
    V = np.log(gains["k"] ** 2 / (gains["k"] ** 2 - e_1**2)) / 2 + e_2**2 / 2  # (38), the weights left out
    for number, (name, value) in enumerate(true.items(), start=1):
        V += (run.column(name) - value) ** 2 / (2 * gains[f"lambda_{number}"])
    assert V.max() <= proved(report, "invariant level zeta of V, found").proved
    assert np.sqrt(np.mean(e_2**2)) <= proved(report, "root mean square of e_2 in the long run, found").proved


def test_the_stated_gains_fail_beyond_their_sampling_limit(report):
    limit = proved(report, "sampling period with corrected estimates, stated")
    assert limit.proved < limit.check < 0.02
    run = run_with({}, 0.02)
    assert run.failed is not None
    assert "left its domain" in run.failed


def test_no_other_adaptation_of_that_level_is_slower():
    """By Cauchy the least sum of lambda_n v^2n for sum theta_n^2/(2 lambda_n) <= B is (sum theta_n v^n)^2/(2 B)."""
    values = {star: sp.Rational(x) for star, x in zip(yang2021.STARS, ("3/10", "1/250", "1/6250"), strict=True)}
    f_star, speed = sp.Rational(6, 100), Fraction(326, 10)
    found = search(yang2021.adaptation_problem(values, f_star, speed), 1e-3)
    room = float(yang2021.LEVEL) - 0.06**2 / 2
    theory = float(sum(values[s] * sp.Rational(326, 10) ** n for n, s in enumerate(yang2021.STARS))) ** 2 / (2 * room)
    assert theory * (1 - 1e-9) <= float(found.objective) <= theory * 1.005


def test_the_best_share_is_the_best_of_a_finer_grid(report):
    values = yang2021.stated_values(Stated(FILE, read_toml(FILE)))
    share = float(yang2021.best_share(values, sp.Rational(6, 100)))
    beta, leak = 0.51, 0.005 * (0.3**2 + 4e-3**2 + 1.6e-4**2) / 4

    def bound(part):
        return (0.06**2 / (4 * part * beta) + leak) / ((1 - part) * beta)

    assert bound(share) <= bound(np.linspace(0.001, 0.999, 5001)).min() * 1.001
    stated = proved(report, "root mean square of e_2 in the long run, stated")
    assert stated.proved == pytest.approx(bound(share) ** 0.5, rel=1e-9)
    assert stated.papers == pytest.approx(9.0, rel=1e-3)
