"""Economic MPC: prices do what prices do, and every solver runs at ipopt's cost."""

import functools

import numpy as np
import pytest
from mpc_runs import problem_of

from workbench.errors import InputError, SolverError
from workbench.mpc import transcription
from workbench.mpc.economic import BLEND_MPS2, SOLVERS, Prices, economic_mpc, power
from workbench.mpc.model import model
from workbench.mpc.problem import Weights

STEPS = 220
LIGHT = Weights(position=2e-3, speed=2e-2, command=2e-1, change=0.1)


@functools.cache
def run(prices, solver="fatrop", load="power, a little"):
    """Energy drawn (J/kg), distance behind the desired run at the end of cruising (m), whether all was solved."""
    problem, ahead = problem_of(30, "lag", load, weights=LIGHT)
    mpc, step = economic_mpc(problem, ahead, prices, solver), model("lag").casadi_step()
    x, energy, late, solved = ahead[0, :3].copy(), 0.0, [], True
    for k in range(STEPS):
        solution = mpc.solve(k, x)
        solved = solved and solution.solved
        energy += problem.period_s * max(x[2], 0.0) * x[1]
        x = np.asarray(step(*x, solution.plan[0], 0.0, *problem.parameters)).ravel()
        late.append(ahead[k + 1, 0] - x[0])
    return energy, np.array(late), solved, x


@pytest.mark.parametrize("solver", [name for name in SOLVERS if name != "ipopt"])
def test_every_solver_runs_as_ipopt_does(solver):
    prices = Prices(energy=0.05, time=1.0)
    energy, late, solved, _ = run(prices, solver)
    expected, at, reference, _ = run(prices, "ipopt")
    assert solved
    assert reference
    assert energy == pytest.approx(expected, rel=1e-4)
    assert late == pytest.approx(at, abs=1e-2)


@pytest.mark.parametrize("solver", sorted({*transcription.SOLVERS, "nonsense"} - set(SOLVERS)))
def test_solvers_that_find_no_answer_here_are_refused(solver):
    with pytest.raises(SolverError, match="choose one of ipopt"):
        economic_mpc(*problem_of(), Prices(), solver)


def test_dear_energy_is_saved_and_dear_time_is_bought():
    energies = [run(Prices(energy=price, time=1.0))[0] for price in (0.0, 0.05, 0.2)]
    assert energies[0] > energies[1] > energies[2]
    behind = [run(Prices(energy=0.05, time=price))[1].mean() for price in (0.0, 3.0, 9.0)]
    assert behind[0] > behind[1] > behind[2]


def test_energy_is_saved_without_missing_the_stop():
    cheap, dear = run(Prices(energy=0.0, time=0.0)), run(Prices(energy=0.1, time=0.0))
    assert dear[0] < 0.99 * cheap[0]
    assert abs(dear[3][1]) < 1.0


@pytest.mark.parametrize("regenerated", [0.0, 0.6, 1.0])
def test_power_is_what_driving_draws_less_what_braking_returns(regenerated):
    for force in np.linspace(-1, 1, 21):
        exact = 20.0 * (max(force, 0.0) + regenerated * min(force, 0.0))
        assert float(power(force, 20.0, regenerated)) == pytest.approx(exact, abs=20.0 * BLEND_MPS2)


@pytest.mark.parametrize("values", [{"energy": -1.0}, {"time": -1.0}, {"regenerated": 1.5}, {"time": float("nan")}])
def test_prices_that_cannot_be_are_refused(values):
    with pytest.raises(InputError, match="prices"):
        Prices(**values)
