"""slotine1987: the arm against Lagrange's equations, the law against its promise, the folder against itself."""

import math

import numpy as np
import pytest
import sympy as sp
from scenarios import PROOFS

import workbench as wb
from proofs.slotine1987 import laws, plant
from workbench.paper.loading import load

FOLDER = PROOFS / "slotine1987"


def test_the_arm_obeys_lagrange_with_its_kinetic_energy():
    """The rates of the plant against Euler and Lagrange of w' H w / 2, at random angles, rates and torques."""
    w = sp.Matrix([plant.w_1, plant.w_2])
    energy = (w.T * plant.H * w)[0] / 2
    momenta = [sp.diff(energy, one) for one in w]
    accelerations = sp.symbols("acc_1 acc_2", real=True)
    rows = [sum(sp.diff(momentum, q) * rate for q, rate in zip((plant.q_1, plant.q_2), w, strict=True))
            + sum(sp.diff(momentum, rate) * acc for rate, acc in zip(w, accelerations, strict=True))
            - sp.diff(energy, q)
            for momentum, q in zip(momenta, (plant.q_1, plant.q_2), strict=True)]
    evaluate = sp.lambdify([*plant.arm.states, *accelerations, *plant.A], rows)
    generator = np.random.default_rng(1)
    values = [*plant.arm.values().values()]
    for _ in range(10):
        state, torque = generator.normal(size=4), generator.normal(size=2)
        rates = plant.arm.rates_at(state, torque)
        assert evaluate(*state, *rates[2:], *values) == pytest.approx(torque, abs=1e-12)


def test_its_parameters_are_those_of_the_stated_masses_and_lengths():
    m_1, l_1, l_c1, I_1, m_e, l_ce, I_e, angle = 1.0, 1.0, 0.5, 0.12, 2.0, 0.6, 0.25, math.radians(30)
    assert [*plant.arm.values().values()] == pytest.approx([
        I_1 + m_1 * l_c1**2 + I_e + m_e * l_ce**2 + m_e * l_1**2, I_e + m_e * l_ce**2,
        m_e * l_1 * l_ce * math.cos(angle), m_e * l_1 * l_ce * math.sin(angle)])


def test_the_folder_holds_and_V_falls_along_the_run():
    checked = wb.check_paper(FOLDER)
    assert checked.holds, checked
    assert any(check.what.startswith("V changes along the run of adaptive") for check in checked.checks)


def test_adaptation_makes_the_errors_vanish_where_the_same_gains_alone_do_not():
    study = load(FOLDER).study
    names = {name: entrant for name, entrant in study.entrants().items() if name != "mpc"}
    found = wb.compare(study.setting.varied(duration_s=8.0), [*names.values()])
    late = found["adaptive"]["t_s"] > 7.0
    worst = {run.name: np.max(np.abs(run["q_1"] - run["q_1d"])[late]) for run in found}
    assert worst["adaptive"] < 0.1 * worst["pd"]
    assert laws.adaptive.flow.keys() == set(laws.hats)
