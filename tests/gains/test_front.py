"""Sampled loops behind delay and lag as exact polytopes, what is proved of them, and fronts of gains."""

import copy
import json
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp
from scenarios import PROOFS
from scipy.integrate import solve_ivp

from proofs.yang2021 import gain_front as yang2021
from proofs.yang2021 import gains as whole
from workbench.cli.loading import load
from workbench.errors import InputError, SolverError
from workbench.gains.dissipation import (
    decay_certificate,
    frozen_gain,
    gain_certificate,
    least_decay,
    least_gain,
    proved_bound,
    rounded,
    upper_gains,
)
from workbench.gains.held_loop import SampledLoop, polytope
from workbench.gains.sampling import sampled_map
from workbench.gains.stated import Stated
from workbench.paper.gain_front import Tried, chosen, exact, front_search_of, not_beaten, tried_for
from workbench.paper.gain_search import FrontSearch, FrontSetting
from workbench.paper.recorded_front import recorded_fronts, shown_point
from workbench.proof.checker import check

x, v, u, w, estimate, rate = sp.symbols("x v u w estimate rate", real=True)
ONE = Fraction(1)


def first_order(gain, period="1/10", box=None, **more):
    """x' = -rate x + u + w, u = -gain x, y = x."""
    return SampledLoop({x: -rate * x + u + w}, u, {w: ONE}, -sp.Rational(gain) * x, {}, x,
                       {} if box else {rate: sp.Integer(1)}, Fraction(period), box=box or {}, **more)


def floats(matrix):
    return np.array([[float(e) for e in row] for row in matrix])


# --- the map --------------------------------------------------------------------------------------------------------


def test_one_state_is_what_the_textbook_says():
    """phi = exp(-T), held input (1 - phi): x+ = (phi - 2 (1 - phi)) x + (1 - phi) w."""
    (vertex,) = polytope(first_order(2)).vertices
    phi = np.exp(-0.1)
    assert floats(vertex) == pytest.approx(np.array([[phi - 2 * (1 - phi), 1 - phi]]), rel=1e-12)


def test_without_delay_it_is_the_map_of_the_other_module():
    plant = {x: v, v: -v / 5 + u + w}
    command, rates = -2 * x - v - estimate, {estimate: x + v / 3 - estimate / 7}
    for order in ("corrected", "explicit"):
        loop = SampledLoop(plant, u, {w: ONE}, command, rates, x, {}, Fraction(1, 50), order=order)
        (vertex,) = polytope(loop).vertices
        assert floats(vertex)[:, :3] == pytest.approx(
            sampled_map(plant, u, command, rates, {w: sp.Integer(0)}, order)(0.02), rel=1e-11, abs=1e-15)


def test_delay_and_lag_are_those_of_the_integrated_loop():
    """A delay of 2.3 samples and a lag: the matrix against an integration with the command switched within a sample."""
    period, delay, lag = 0.1, 0.23, 0.3
    loop = SampledLoop({x: v, v: u + w - v / 4}, u, {w: ONE}, -x - v, {}, x, {}, Fraction(1, 10), Fraction(23, 100),
                       Fraction(3, 10))
    (vertex,) = polytope(loop).vertices
    start = np.array([0.3, -0.2, 0.1, 0.7, -0.4, 0.9, 0.5])  # x, v, force, commands of one, two, three samples ago, w

    def rates(of_command):
        return lambda _, y: [y[1], y[2] + start[6] - y[1] / 4, (of_command - y[2]) / lag]

    state = start[:3]
    for command, seconds in ((start[5], delay % period), (start[4], period - delay % period)):
        state = solve_ivp(rates(command), (0, seconds), state, rtol=1e-12, atol=1e-14).y[:, -1]
    assert floats(vertex) @ start == pytest.approx([*state, -start[0] - start[1], *start[3:5]], rel=1e-9)


def test_every_point_of_the_box_lies_in_the_hull():
    """The exact map at a point is the vertices' combination with Bernstein's weights, within the remainder."""
    low, high = Fraction(0), Fraction(3)
    of = polytope(first_order(2, "1/2", {rate: (low, high)}))
    assert len(of.vertices) > 3
    degree = len(of.vertices) - 1
    for place in (0.0, 0.31, 0.77, 1.0):
        value = 3 * place
        phi = np.exp(-value / 2)
        held = (1 - phi) / value if value else 0.5
        weights = [float(sp.binomial(degree, i)) * place**i * (1 - place) ** (degree - i) for i in range(degree + 1)]
        mixed = sum(weight * floats(vertex) for weight, vertex in zip(weights, of.vertices, strict=True))
        assert np.abs(mixed - [[phi - 2 * held, held]]).max() <= float(max(of.remainder[0])) + 1e-15


def test_what_cannot_be_is_refused():
    with pytest.raises(InputError, match="a period is positive"):
        polytope(first_order(2, "0"))
    with pytest.raises(InputError, match="at most 100 periods"):
        polytope(first_order(2, delay_s=Fraction(100)))
    with pytest.raises(InputError, match="no polynomial"):
        polytope(SampledLoop({x: u - x}, u, {}, -sp.sin(rate) * x, {}, x, {}, Fraction(1, 10)))


# --- what is proved -------------------------------------------------------------------------------------------------


def test_the_decay_of_a_known_loop_is_proved_up_to_its_rate_and_not_beyond():
    of = polytope(first_order(2))
    rate_known = np.exp(-0.1) - 2 * (1 - np.exp(-0.1))
    rho, P = least_decay(of)
    assert rate_known <= rho <= rate_known * 1.001
    certificate = decay_certificate("test:decay", of, rounded(P), Fraction(f"{rho * 1.0005:.6g}"))
    check(json.loads(json.dumps(certificate)))
    assert proved_bound(certificate, "test:decay", of) == pytest.approx(rho, rel=1e-3)
    with pytest.raises(SolverError, match="not positive"):
        decay_certificate("test:decay", of, rounded(P), Fraction(f"{rate_known * 0.99:.6g}"))


def test_the_gain_of_a_known_loop_is_its_largest_frequency_response():
    """x+ = a x + b w: largest at zero frequency, b / (1 - a); over a box of rates at the slowest."""
    phi = np.exp(-0.1)
    assert least_gain(polytope(first_order(2)))[0] == pytest.approx(1 / 3, rel=1e-4)
    of = polytope(first_order(2, "1/10", {rate: (ONE, Fraction(4))}))
    bound, gains, P = least_gain(of, interior=True)
    assert frozen_gain(of) == pytest.approx((1 - phi) / (1 - phi + 2 * (1 - phi)), rel=1e-3)
    certificate = gain_certificate("test:gain", of, rounded(P), upper_gains(gains))
    assert frozen_gain(of) <= proved_bound(certificate, "test:gain", of) <= bound * 1.001


def test_a_loop_that_its_delay_makes_unstable_is_not_proved():
    """Integrator, gain 5: stable up to a delay of pi / 2 / 5 s but for the sampling."""
    def loop(delay):
        return SampledLoop({x: u + w}, u, {w: ONE}, -5 * x, {}, x, {}, Fraction(1, 100), Fraction(delay))

    assert least_gain(polytope(loop("3/20")))[0] > 0.2
    for delay in ("31/100", "32/100"):
        with pytest.raises(SolverError, match="not stable"):
            least_gain(polytope(loop(delay)))


@pytest.fixture(scope="module")
def gain_and_loop():
    of = polytope(first_order(2, "1/10", {rate: (ONE, Fraction(4))}))
    _, gains, P = least_gain(of, interior=True)
    return gain_certificate("test:gain", of, rounded(P), upper_gains(gains)), of


def test_forged_certificates_are_refused(gain_and_loop):
    certificate, of = gain_and_loop
    better = copy.deepcopy(certificate)
    better["values"]["g_1"] = "1/1000"  # a smaller bound by the same proof
    other = polytope(first_order(1, "1/10", {rate: (ONE, Fraction(4))}))  # of a loop with another gain
    shown = copy.deepcopy(certificate)
    shown["values"]["g_1"] = "1/1000"
    was = certificate["values"]["g_1"]
    shown["goal"]["show"] = [part.replace(was, "1/1000") for part in shown["goal"]["show"]]
    trivial = {**certificate, "goal": {"assume": [], "show": ["1 > 0"]}}
    empty = {**certificate, "proofs": [{**proof, "terms": []} for proof in certificate["proofs"]]}
    for forged, loop in ((better, of), (certificate, other), (shown, of), (trivial, of), (empty, of),
                         ({**certificate, "values": {}}, of), ({"claim": "test:gain"}, of)):
        with pytest.raises(SolverError):
            proved_bound(forged, "test:gain", loop)
    with pytest.raises(SolverError, match="something else"):
        proved_bound(certificate, "test:other", of)


def test_what_the_map_leaves_out_widens_the_bound():
    exact = polytope(first_order(2))
    blurred = replace(exact, remainder=[[Fraction(1, 1000)] * 2])
    _, gains, P = least_gain(exact, interior=True)
    with pytest.raises(SolverError, match="not positive"):
        gain_certificate("test:gain", blurred, rounded(P), upper_gains(gains))


# --- the search -----------------------------------------------------------------------------------------------------


def toy(evaluations=12):
    """Gains of the first-order loop: a larger one is proved better and costs more."""
    held = FrontSetting("held", "held", lambda stated, gains: first_order(gains["k"]),
                        lambda loaded, gains: {"cost": gains["k"] ** 2})
    return FrontSearch("test", {"k": (0.5, 8.0)}, lambda stated: {"k": 1.0}, "root mean square of x", "m", (held,),
                       weights=3, evaluations=evaluations, points=3)


def test_a_search_finds_what_nothing_beats_with_a_certificate_each():
    loaded = SimpleNamespace(path=None, data={})
    asked = toy()
    tried = [one for weight in range(3) for one in tried_for(loaded, asked, "held", weight)]
    assert {"k": 1.0} in [one.gains for one in tried]  # the stated gains are tried
    certificates = {}
    found = chosen(loaded, asked, asked.settings[0], tried, certificates)
    assert 2 <= len(found) <= 3
    points = [shown_point(loaded, asked, certificates, "held", name, gains) for name, gains in (
        ("stated", {"k": 1.0}), *((p.name, p.gains) for p in found))]
    for point in points:
        assert point.bound == pytest.approx(1 / (1 + point.gains["k"]), rel=0.02) and point.bound >= point.frozen
    by_cost = sorted(points, key=lambda p: p.cost)
    assert all(one.bound > two.bound for one, two in pairwise(by_cost))


def test_not_beaten_are_those_that_nothing_is_better_than_in_both():
    rng = np.random.default_rng(5)
    points = [Tried({"n": float(i)}, *row) for i, row in enumerate(rng.uniform(1, 2, (60, 2)).tolist())]
    front = not_beaten(points)
    for one in points:
        beaten = any(o.cost <= one.cost and o.bound <= one.bound and o is not one for o in points)
        assert (one in front) != beaten


# --- yang2021 -------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def kept():
    loaded = load(PROOFS / "yang2021")
    asked = front_search_of(loaded)
    return loaded, asked, recorded_fronts(loaded, asked)


def test_yangs_one_estimate_moves_as_its_three_do():
    """Its loop of one estimate has the eigenvalues of that of three, whose other two only leak."""
    stated = Stated((loaded := load(PROOFS / "yang2021")).path, loaded.data)
    gains = exact(yang2021.stated_gains(stated))
    one = yang2021.loop(stated, gains, Fraction(1, 100), Fraction(0), Fraction(0))
    at_speed = replace(one, box={yang2021.speed: (Fraction(20),) * 2, yang2021.share: (ONE, ONE)})
    (vertex,) = polytope(at_speed).vertices
    _, _, matrix = whole.periods(whole.stated_values(stated), Fraction(20))
    reduced = np.sort_complex(np.linalg.eigvals(floats(vertex)[:, :4]))
    full = list(np.linalg.eigvals(matrix(0.01)))
    for value in reduced:
        place = int(np.argmin([abs(value - other) for other in full]))
        assert abs(full.pop(place) - value) < 1e-9
    assert np.array(full) == pytest.approx([1 - 0.01 * 5e-5] * 2, abs=1e-10)


def test_what_is_kept_of_yang2021_is_proved_and_runs_better_than_stated(kept):
    loaded, asked, front = kept
    assert {s.id for s in asked.settings} == set(front.record.found) and all(front.record.found.values())
    setting = next(s for s in asked.settings if s.id == "at_once")
    stated = shown_point(loaded, asked, front.certificates, setting.id, "stated", asked.stated(
        Stated(loaded.path, loaded.data)))
    found = [shown_point(loaded, asked, front.certificates, setting.id, p.name, p.gains)
             for p in front.record.found[setting.id]]
    assert stated.cost is not None and stated.frozen is not None
    for point in found:
        assert point.bound is not None and point.frozen is not None and point.bound >= point.frozen
        assert point.cost is not None and point.cost < stated.cost and point.bound < stated.frozen
    assert all(one.cost < two.cost and one.bound > two.bound for one, two in pairwise(found))


def test_gains_that_are_changed_lose_their_certificate(kept):
    loaded, asked, front = kept
    point = front.record.found["at_once"][0]
    with pytest.raises(SolverError, match="not one of this loop"):
        shown_point(loaded, asked, front.certificates, "at_once", point.name, {**point.gains, "alpha": 4.2})
