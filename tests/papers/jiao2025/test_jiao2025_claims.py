"""jiao2025's claims against its own loop, run trial by trial with plain numbers: what Theorem 1 and Remark 5 lack,
what mends them, and what becomes of the headline statements."""

from fractions import Fraction

import numpy as np
import pytest
from scenarios import PROOFS

from workbench.proof.decide.engine import decide
from workbench.proof.fate import judged
from workbench.proof.loading import ProofFile
from workbench.proof.paper import papers_in
from workbench.proof.premises import below
from workbench.proof.verdict import Decision


@pytest.fixture(scope="module")
def claims():
    found, = papers_in(ProofFile(PROOFS / "jiao2025"))
    return {claim.equation: claim for claim in found.claims}


def decided(claims, equation):
    """The decision on a claim, with the exact point that breaks it."""
    decision = decide(claims[equation])
    return decision, {name: Fraction(value) for name, value in (decision.counterexample or {}).items()}


class Sample:
    """One sample under (13)-(15), trial after trial, for a data model or the first sample of a train."""

    def __init__(self, rho, lamda, mu, eta, epsilon, first_estimate, first_input):
        self.rho, self.lamda, self.mu, self.eta, self.epsilon = rho, lamda, mu, eta, epsilon
        self.first, self.estimate, self.u = first_estimate, first_estimate, first_input
        self.change = self.speed_change = 0  # Delta u(k,i-1) and Delta v(k+1,i-1)
        self.trial = 0

    def learn(self, error, gamma=1):
        """The input of the next trial, from the error of this one and whether it got here."""
        if self.trial > 0:  # (15), then (13); in the first trial the estimate is the first one
            surprise = gamma * (self.speed_change - self.estimate * self.change)
            new = self.estimate + self.eta * self.change / (self.mu + self.change**2) * surprise
            fires = min(abs(new), abs(self.change)) <= self.epsilon or new * self.first <= 0
            self.estimate = self.first if fires else new
        step = self.rho * self.estimate / (self.lamda + self.estimate**2) * gamma * error  # (14)
        self.u, self.change, self.trial = self.u + step, step, self.trial + 1
        return step


def test_theorem_1_is_broken_by_a_loop_that_never_moves(claims):
    decision, at = decided(claims, "theorem1")
    assert decision.verdict == "gap"
    assert at["epsilon_bar"] < at["phi"] <= at["p"] and at["rho"] <= 1
    assert at["lamda"] > at["rho"] ** 2 * at["p"] ** 2 / 4
    assert at["phi_reset"] == at["phi_hat_1"]  # what (13) lacks breaks the theorem too
    loop = Sample(at["rho"], at["lamda"], 1, 1, at["epsilon"], at["phi_hat_1"], Fraction(0))
    error = at["e_prev"]
    for _ in range(30):
        loop.speed_change = at["phi"] * loop.learn(error)  # the data model (5)
        error -= loop.speed_change
    assert error == at["e_prev"] != 0


@pytest.mark.parametrize("seed", range(5))
def test_an_estimate_of_the_wrong_sign_lets_errors_grow_in_every_trial(seed):
    """Claim theorem1.sign, with the adaptation running and phi_c changing from trial to trial."""
    draw = np.random.default_rng(seed)
    loop = Sample(draw.uniform(0.1, 1), draw.uniform(0.5, 5), draw.uniform(0.1, 2), draw.uniform(0.1, 1), 1e-5,
                  -draw.uniform(0.01, 2), 0.0)
    errors = [draw.uniform(0.1, 3)]
    for _ in range(40):
        loop.speed_change = draw.uniform(0.1, 1) * loop.learn(errors[-1])
        errors.append(errors[-1] - loop.speed_change)
    assert (np.diff(np.abs(errors)) > 0).all()


@pytest.mark.parametrize(("lamda", "first"), [(0.2, 0.9), (0.05, 0.1)])
def test_theorem_1_mended_bounds_the_mean_error_of_random_lengths(claims, lamda, first):
    """Claim theorem1.mended: E|e| over many draws of independent lengths stays below (1 - p M_1)^i.

    Also where the error changes its sign, lambda below rho^2 p^2/4, and with a first estimate below epsilon.
    """
    rho, p, lower, epsilon, chance = 0.8, 1.0, 0.3, 0.2, 0.4
    assert lamda > rho**2 * p**2 / 16 and first > 0
    slowest = min(rho * lower * min(epsilon, first) / (lamda + max(p, first) ** 2),
                  2 - rho * p / (2 * lamda**0.5), 0.5)
    draw, trials, runs = np.random.default_rng(3), 60, 400
    errors = np.ones((runs, trials + 1))
    for run in range(runs):
        loop = Sample(rho, lamda, 0.1, 1.0, epsilon, first, 0.0)
        for i in range(trials):
            loop.speed_change = draw.uniform(lower, p) * loop.learn(errors[run, i], int(draw.random() < chance))
            errors[run, i + 1] = errors[run, i] - loop.speed_change
    assert (errors >= 0).all() or lamda < rho**2 * p**2 / 4  # above it the contraction keeps the sign
    assert (np.abs(errors).mean(axis=0) <= (1 - chance * slowest) ** np.arange(trials + 1) + 1e-12).all()
    assert np.abs(errors[:, -1]).mean() < 0.02
    assert claims["theorem1.mended"].mends == "jiao2025:theorem1"


def test_no_smaller_lambda_than_that_of_theorem1_lambda_serves():
    """At phi_c = p and the estimate sqrt(lambda) the factor is -1 just at lambda = rho^2 p^2/16."""
    rho, p = 0.245, 0.1
    least = rho**2 * p**2 / 16

    def factor(lamda):
        estimates = np.geomspace(1e-6, 1e2, 200_001)
        return np.min(1 - rho * p * estimates / (lamda + estimates**2))

    assert factor(least) == pytest.approx(-1, abs=1e-6)
    assert factor(1.01 * least) > -1 > factor(0.99 * least)
    assert least < 5e-5 < 4 * least  # Table 1's lambda, in N/kg: it converges though the sign changes


def test_lengths_that_depend_on_each_other_leave_the_mean_error_where_it_is(claims):
    """Claim A3.independent, at its counterexample: all trials as long as the first one."""
    decision, at = decided(claims, "A3.independent")
    assert decision.verdict == "gap" and claims["A3.independent.mended"].mends == "jiao2025:A3.independent"
    p, g, start = at["p_k"], at["g"], at["e_0"]
    after = {True: (1 - g) * start, False: start}  # whether data arrived
    together = p * after[True]
    assert together != p * (p * after[True] + (1 - p) * after[False])
    errors = {True: start, False: start}
    for _ in range(200):
        errors[True] *= 1 - g
    assert p * errors[True] + (1 - p) * errors[False] > (1 - p) * start / 2 > 0


@pytest.mark.parametrize("seed", range(3))
def test_the_train_converges_without_a_bound_of_its_estimates(claims, seed):
    """Claims theorem1.train.sum and theorem1.train: two samples of a train on a slope that depends on the place."""
    draw = np.random.default_rng(seed)
    b, rho, lamda, epsilon, first, chance, length = 0.5, 0.9, 0.05, 1e-3, 0.02, 0.6, 4
    assert lamda > rho**2 * b**2 / 16
    loops = [Sample(rho, lamda, 0.1, 1.0, epsilon, first, 0.0) for _ in range(length)]
    wanted, last, sums = np.linspace(1.0, 2.0, length), None, np.zeros(length)
    for _ in range(3000):
        speeds, v, s = [], 0.0, 0.0
        for loop in loops:
            place, v = s, v + b * (loop.u - 0.1 * np.sin(s) - 0.05 * v)
            s = place + 0.1 * v
            speeds.append(v)
        reached = draw.random() < chance
        for k, loop in enumerate(loops):
            loop.speed_change = 0.0 if last is None else speeds[k] - last[k]
            sums[k] += abs(loop.speed_change)
            loop.learn(wanted[k] - speeds[k], int(reached or k < 2))
        last = speeds
    assert np.abs(wanted - last).max() < 1e-3
    assert np.isfinite(sums).all() and (sums < 1e3).all()
    assert claims["theorem1.train"].mends == "jiao2025:conclusion"


def test_a_trial_0_that_is_as_long_as_the_next_one_breaks_the_bound_of_theorem_1_mended():
    """Why claim theorem1.mended asks that T_0 is independent too: trials 1, 2, ... are, and T_0 = T_1."""
    rho, lamda, epsilon, phi, chance = 1.0, 1e-4, 0.0099, 0.01, 0.5
    slowest = min(rho * epsilon * epsilon / (lamda + phi**2), 2 - rho * phi / (2 * lamda**0.5), 0.5)

    def left(*reached):
        loop, error = Sample(rho, lamda, 0.1, 1.0, epsilon, phi, 0.0), 1.0
        for gamma in reached:
            loop.speed_change = phi * loop.learn(error, gamma)
            error -= loop.speed_change
        return error

    dependent = chance * left(1, 1) + (1 - chance) * left(0, 0)
    independent = sum(left(first, second) for first in (0, 1) for second in (0, 1)) / 4
    assert independent <= (1 - chance * slowest) ** 2 < dependent


def test_remark_5_does_not_carry_over_to_a_train_whose_starts_alternate(claims):
    """Claims remark5, remark5.always: one of two successive errors of the first sample is at least |w|/(2 + G)."""
    decision, at = decided(claims, "remark5")
    assert decision.verdict == "gap" and at["e_prev"] == 0 and at["w_even"] != at["w_odd"]
    rho, lamda, epsilon, gain, wanted = 0.9, 0.4, 1e-5, 0.5, 3.0
    most, starts = gain * rho / (2 * lamda**0.5), (0.5, 1.2)
    for first in (0.05, 0.6, 2.0):
        loop, errors, speed = Sample(rho, lamda, 0.1, 1.0, epsilon, first, 0.0), [], None
        for trial in range(80):
            before, speed = speed, starts[trial % 2] + gain * loop.u
            loop.speed_change = 0.0 if before is None else speed - before
            errors.append(wanted - speed)
            loop.learn(errors[-1])
        sizes = np.abs(errors)
        assert (np.maximum(sizes[1:], sizes[:-1]) >= (starts[1] - starts[0]) / (2 + most) - 1e-9).all()


def test_the_train_breaks_what_the_conclusion_rests_on(claims):
    """Claim conclusion: earlier inputs make an error grow, where phi_c of the train is negative."""
    decision, at = decided(claims, "conclusion")
    assert decision.verdict == "gap"
    quotient = at["b"] + at["a"] * at["Delta_v_k"] / at["Delta_u_i"]
    assert quotient < 0 < at["e_prev"] < at["e_prev"] - quotient * at["Delta_u_i"]
    # The same by the law itself: trials 0 and 1 start alike, and both samples use the first estimate.
    b, first = at["b"], at["phi_hat_1"]
    loops = [Sample(at["rho"], at["lamda"], 1, 1, at["epsilon"], first, Fraction(0)) for _ in range(2)]
    assert b == Fraction(1, 3_500_000) and at["lamda"] > at["rho"] ** 2 * b**2 / 4
    difference, errors = 0, []
    for loop, error in zip(loops, (at["e_2"], at["e_prev"]), strict=True):
        difference = at["a"] * difference + b * loop.learn(error)
        errors.append(error - difference)
    assert abs(errors[0]) < abs(at["e_2"]) and errors[1] == Fraction("0.17499") > at["e_prev"]


def test_a_random_first_estimate_leaves_no_power_of_a_number():
    """Why claim theorem1.mended asks for a first estimate that is not random: E|e| falls like 1/i."""
    first = 2.0 ** -np.arange(1, 60)  # each with the chance of its own size; v(k+1) = u(k), and so small an error
    taken = 0.5 * first / (1 + first**2)  # that (13) puts the first estimate back in every trial
    left = [float(np.sum(first * (1 - taken) ** i)) * i for i in (1_000, 10_000, 100_000)]
    assert min(left) > 0.95 * max(left) > 1


@pytest.mark.parametrize(("phi", "estimate", "slow"), [(0.1, 0.1, True), (0.01, 0.01, True), (0.1, 0.007, False)])
def test_a_true_estimate_leaves_much_of_the_error_where_few_trials_arrive(phi, estimate, slow):
    """Claims remark5.end and remark5.end.number; another estimate may leave less."""
    rho, lamda, chance, trials = 0.245, 5e-5, 0.01, 150
    left = (1 - chance * rho * phi * estimate / (lamda + estimate**2)) ** trials
    assert (left >= 1 - trials * rho * chance >= 0.63) is slow


def test_the_law_named_pd_acts_on_a_constant_error_with_both_gains(claims):
    decision, at = decided(claims, "18.name")
    assert decision.verdict == "refuted" and decision.correction is not None
    moved = at["K_p"] * at["e_next"] + at["K_d"] * at["e_now"]
    assert at["u_i"] - at["u_prev"] == moved != at["K_p"] * at["e_now"] + at["K_d"] * (at["e_next"] - at["e_now"])


def test_a_sample_that_no_trial_reaches_is_allowed_by_assumption_3(claims):
    decision, at = decided(claims, "A3.last")
    assert decision.verdict == "refuted" and claims["A3.last"].origin == "ours"  # the definition of gamma excludes it
    distribution = [at["p_short"], at["p_other_reaching"], at["p_last"]]
    assert sum(distribution) == 1 and min(distribution) >= 0 and at["p_last"] == at["p_k"] == 0


def test_the_chance_to_reach_a_sample_is_that_of_counted_lengths():
    """Claims gamma.p and gamma.p.step, for the lengths of section 4."""
    lengths = range(1901, 2001)
    for k in (1, 1900, 1901, 1950, 2000):
        counted = Fraction(sum(length >= k for length in lengths), len(lengths))
        assert counted == (1 if k <= 1900 else Fraction(2000 - k + 1, 100))


def test_two_trials_of_the_train_break_assumption_2_for_every_p():
    """Claim A2.every with the numbers of section 4, u in N."""
    step, mass = Fraction(1, 10), 350_000

    def after(v, u):
        return v + step / mass * (u - (2977 + Fraction("25.17") * v + Fraction("0.2864") * v**2))

    for p in (1, 1000, 10**9):
        v, w = Fraction(20), Fraction(1, 2)
        a = 1 - step / mass * (Fraction("25.17") + Fraction("0.2864") * (2 * v + w))
        small = a * w / (p + 1)
        assert after(v, w * mass / step) - after(v, 0) == w
        assert abs(after(v + w, small) - after(v, 0)) > p * small > 0


def test_the_other_lines_of_a_row_are_not_the_paper_s(claims):
    """Conditions with numbers of ours are questions; the paper is charged with its own lines alone."""
    for equation, claim in claims.items():
        asked = equation.startswith(("intro.", "theorem1.", "18.converges", "16.force", "u0."))
        if asked and equation != "intro.error":  # a sentence of the introduction
            assert claim.origin == "ours"
        if claim.recorded == "violated":
            assert claim.origin != "ours"


def test_what_becomes_of_the_headline_statements(claims):
    """Computed from the verdicts on record, which `prove` holds against the decided ones."""
    every = {claim.id: claim for claim in claims.values()}
    headlines = [claim.id for claim in claims.values() if claim.severity == "result" and claim.origin == "printed"]
    wanted = below(headlines, every)
    fates = {d.claim.equation: d.fate for d in judged([
        Decision(claim, claim.recorded, "on record", None, 0.0) for claim in every.values() if claim.id in wanted])}
    assert {equation: fate.word for equation, fate in fates.items() if fate} == {
        "lemma1": "stands", "theorem1": "stands with corrections", "remark5": "stands with corrections",
        "remark5.distribution": "stands with corrections", "conclusion": "stands with corrections"}
    assert fates["theorem1"].by == ("jiao2025:theorem1.mended",) and "jiao2025:theorem1.train" in fates["conclusion"].by
