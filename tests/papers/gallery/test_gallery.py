"""Papers that bring a plant of their own: what their laws promise, by runs and by an independent calculation."""

import numpy as np
import pytest
import sympy as sp
from scenarios import PAPERS, PROOFS, TRAIN_PAPERS

from proofs.goodwin1980 import laws as goodwin
from proofs.krstic1992 import laws as krstic
from proofs.moreno2012.claims import perturbed
from workbench.paper.loading import load
from workbench.simulate.plants.run import run as run_plant

GALLERY = [paper for paper in PAPERS if paper not in TRAIN_PAPERS]


def study_of(paper):
    return load(PROOFS / paper).study


@pytest.fixture(scope="module")
def runs():
    """Each controller that is a law, as stated, by paper and name; a run is made once."""
    made = {}

    def run_of(paper, name):
        if (paper, name) not in made:
            study = study_of(paper)
            made[paper, name] = run_plant(study.setting, study.entrants()[name], study.setting.parameters)
        return made[paper, name]

    return run_of


@pytest.mark.parametrize("paper", GALLERY)
def test_a_paper_has_a_plant_a_law_a_result_and_mpc_beside_it(paper):
    study = study_of(paper)
    laws = [entrant for entrant in study.entrants().values() if entrant.law is not None]
    assert laws and any(entrant.build is not None for entrant in study.entrants().values())
    assert (PROOFS / paper / "certificates" / "manifest.json").is_file()


def test_tuning_functions_bring_the_state_to_zero_and_without_adaptation_it_does_not_come(runs):
    adaptive, frozen = runs("krstic1992", "tuning_functions"), runs("krstic1992", "frozen")
    assert adaptive.failed is None and abs(adaptive.metrics["x_1_error_final"]) < 0.02
    assert frozen.failed is not None or abs(frozen.metrics["x_1_error_final"]) > 5 * abs(
        adaptive.metrics["x_1_error_final"])


def test_the_law_of_three_steps_is_a_backstepping_law_for_a_known_parameter():
    """With the true parameter and no adaptation the errors obey the linear chain, at random points."""
    points = np.random.default_rng(1).normal(size=(5, 3))
    names = (krstic.x_1, krstic.x_2, krstic.x_3, krstic.theta_hat, krstic.theta, krstic.u, *krstic.GAINS)
    z = [krstic.of_square(one) for one in krstic.z]
    rates = (krstic.x_2 + krstic.theta * krstic.x_1**2, krstic.x_3, krstic.u)
    z_rates = [sum(sp.diff(one, x) * rate for x, rate in zip((krstic.x_1, krstic.x_2, krstic.x_3), rates, strict=True))
               for one in z]
    evaluate = sp.lambdify(names, [*z, *z_rates])
    command = sp.lambdify(names[:4] + names[6:], krstic.of_square(krstic.command))
    gains = (1.0, 2.0, 3.0, 1e-12)  # so slow an adaptation that its terms are gone
    for x in points:
        z_1, z_2, z_3, *found = evaluate(*x, 0.7, 0.7, command(*x, 0.7, *gains), *gains)
        assert found == pytest.approx([-z_1 + z_2, -z_1 - 2 * z_2 + z_3, -z_2 - 3 * z_3], abs=1e-6)


def test_super_twisting_holds_the_sliding_variable_where_the_linear_law_lets_it_swing(runs):
    late = runs("moreno2012", "super_twisting").column("t_s") > 3.0
    twisting, linear = (np.max(np.abs(runs("moreno2012", name).column("x_1")[late]))
                        for name in ("super_twisting", "linear"))
    assert twisting < 1e-3 and linear > 1e-2


def test_the_signed_bound_of_super_twisting_fails_where_the_components_differ_in_sign_only():
    """V' by numbers against both: the signed form fails on one side alone, the one by absolute values nowhere."""
    r, y, rho = perturbed.r, perturbed.y, perturbed.rho_1
    symbols = (r, y, rho, perturbed.delta, perturbed.k_1, perturbed.k_2)
    rate = sum(sp.diff(perturbed.V, one) * value for one, value in perturbed.FLOW_1.items())
    evaluate = sp.lambdify(symbols, [rate, -perturbed.form(perturbed.signed_1) / r, -perturbed.absolute_1 / r])
    generator = np.random.default_rng(2)
    fails = {1: 0, -1: 0}
    for _ in range(500):
        size, other, delta = generator.uniform(0.1, 2), generator.normal(), generator.uniform(0.1, 1)
        values = evaluate(size, other, generator.uniform(-1, 1) * delta * size, delta, *generator.uniform(0.5, 5, 2))
        fails[int(np.sign(other))] += values[0] > values[1] + 1e-9
        assert values[0] <= values[2] + 1e-9
    assert fails[1] == 0 < fails[-1]


def test_the_error_stays_within_its_funnel_and_leaves_it_under_the_constant_gain(runs):
    values = study_of("ilchmann2002").entrants()["funnel"].parameters
    outside = {}
    for name in ("funnel", "constant"):
        found = runs("ilchmann2002", name)
        t = found.column("t_s")
        width = (values["psi_0"] - values["psi_inf"]) * np.exp(-values["kappa"] * t) + values["psi_inf"]
        outside[name] = np.max(np.abs(found.column("y") - found.column("y_d")) / width)
    assert outside["funnel"] < 1 < outside["constant"]


def test_the_projection_algorithm_follows_better_than_its_first_estimates(runs):
    better, worse = runs("goodwin1980", "projection"), runs("goodwin1980", "frozen")
    assert better.failed is None and better.metrics["y_error_rms"] < 0.5 * worse.metrics["y_error_rms"]


def test_the_projection_algorithm_never_moves_away_from_the_true_parameters():
    """Steps of the law's own update on the sampled tank, parameters by its exact solution."""
    a, b, period = 0.5, 1.0, 0.1
    true = np.array([np.exp(-a * period), b / a * (1 - np.exp(-a * period))])
    update = sp.lambdify((goodwin.y, goodwin.y_1, goodwin.u_1, *goodwin.hats, goodwin.gain, goodwin.guard), goodwin.new)
    generator, hat = np.random.default_rng(3), np.array([0.0, 1.0])
    for _ in range(50):
        phi = generator.normal(size=2)
        before, hat = hat, np.array(update(true @ phi, *phi, *hat, 1.0, 0.01))
        assert np.linalg.norm(hat - true) <= np.linalg.norm(before - true) + 1e-12
    assert np.linalg.norm(hat - true) < 0.05
