"""Intervals that cover as often as they say, Holm's published example, and rankings that say no more than the draws."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from workbench.paper.statistics import Bootstrap, holm, mean_interval, overtakes, p_values, rankings

HOW = Bootstrap(600, 1, 0.95)


def covered(draw, truth: float, count: int, trials: int = 300) -> tuple[float, float]:
    """Shares of trials whose interval holds the truth: of BCa, and of plain percentiles."""
    generator = np.random.default_rng(5)
    own = plain = 0
    for trial in range(trials):
        values = draw(generator, count)
        found = mean_interval(values, Bootstrap(400, trial, 0.95))
        own += found.low <= truth <= found.high
        low, high = np.quantile(values[generator.integers(0, count, (400, count))].mean(axis=1), [0.025, 0.975])
        plain += low <= truth <= high
    return own / trials, plain / trials


def test_intervals_of_a_normal_sample_cover_as_often_as_they_say() -> None:
    share, _ = covered(lambda g, n: g.normal(2.0, 3.0, n), 2.0, 40)
    assert share == pytest.approx(0.95, abs=0.035)  # three standard errors of 300 trials


def test_intervals_of_a_skewed_sample_cover_nearly_as_often_and_more_than_percentiles() -> None:
    """The mean of 25 from a log-normal law: percentiles cover some 89 per cent; BCa is known to be nearer."""
    share, plain = covered(lambda g, n: g.lognormal(0.0, 1.0, n), math.exp(0.5), 25)
    assert 0.86 <= share <= 0.98
    assert share >= plain


def test_p_is_that_of_scipys_randomisation_test() -> None:
    """All 2^n sign flips of few draws; as many by chance of more."""
    generator = np.random.default_rng(3)
    for count, shift in ((7, 0.4), (10, 0.8), (10, -0.1)):
        values = generator.exponential(1.0, count) - 1 + shift
        known = stats.permutation_test((values,), np.mean, permutation_type="samples", n_resamples=np.inf)
        assert mean_interval(values, Bootstrap(2000, 1, 0.95)).p == pytest.approx(known.pvalue, abs=1e-12)
    values = generator.normal(0.5, 1.0, 25)
    known = stats.permutation_test((values,), np.mean, permutation_type="samples", n_resamples=20_000, rng=generator)
    assert mean_interval(values, Bootstrap(20_000, 1, 0.95)).p == pytest.approx(known.pvalue, rel=0.2)


def test_p_of_draws_of_one_sign_is_in_closed_form_however_many_there_are() -> None:
    """As all sign flips of few say, zeros among them; a sample of flips could not say less than one of its number."""
    generator = np.random.default_rng(4)
    for zeros in (0, 3):
        values = -np.concatenate([generator.exponential(1.0, 9), np.zeros(zeros)])
        known = stats.permutation_test((values,), np.mean, permutation_type="samples", n_resamples=np.inf)
        assert p_values([values], HOW) == pytest.approx([known.pvalue], abs=1e-15)
    assert p_values([generator.exponential(1.0, 60), np.full(40, -2.0)], HOW) == [2.0**-59, 2.0**-39]
    assert p_values([np.zeros(20)], HOW) == [1.0]


@pytest.mark.parametrize("count", [8, 16])
def test_among_equals_nobody_is_called_alone_best_more_often_than_is_said(count: int) -> None:
    """Two equal controllers in 60 tables with few draws: by a bootstrap's p every third contest would name one."""
    generator, contests, wrong = np.random.default_rng(12), 60, 0
    for _ in range(contests):
        tables = {k: list(generator.normal(0, 1, (2, count))) for k in range(60)}
        wrong += any(ranking.separated for ranking in rankings(tables, HOW).values())
    assert wrong <= stats.binom.ppf(0.999, contests, 0.05)


def test_claims_of_a_lone_winner_are_one_family_whoever_is_the_nearest() -> None:
    """Ten tables that one wins by far, each with another rival that is level: each rival's own family would leave
    it one comparison at the whole level, and all tables together would name somebody in most contests."""
    generator, contests, wrong = np.random.default_rng(13), 40, 0
    for _ in range(contests):
        tables = {}
        for k in range(10):
            rows = [generator.normal(0, 1, 12) + 50.0 for _ in range(11)]
            rows[0] -= 50.0
            rows[1 + k] -= 50.0
            tables[k] = rows
        wrong += any(ranking.separated for ranking in rankings(tables, Bootstrap(2000, 1, 0.95)).values())
    assert wrong <= stats.binom.ppf(0.999, contests, 0.05)


def test_p_values_agree_with_students_test_on_a_normal_sample_and_are_level_under_the_null() -> None:
    generator = np.random.default_rng(8)
    values = generator.normal(0.25, 1.0, 100)
    assert mean_interval(values, Bootstrap(20_000, 1, 0.95)).p == pytest.approx(
        stats.ttest_1samp(values, 0.0).pvalue, rel=0.35)
    p = [mean_interval(generator.normal(0.0, 1.0, 60), Bootstrap(400, trial, 0.95)).p for trial in range(300)]
    assert stats.kstest(p, "uniform").pvalue > 1e-3


def test_many_rows_have_the_p_values_that_each_has_alone() -> None:
    generator = np.random.default_rng(4)
    rows = [generator.exponential(1.0, count) - 1 + shift for count in (20, 35) for shift in (0.1, 0.3, 0.6)]
    rows += [np.full(9, 0.5), np.array([0.2]), np.zeros(5)]
    how = Bootstrap(20_000, 1, 0.95)
    for row, found in zip(rows, p_values(rows, how), strict=True):
        assert found == pytest.approx(mean_interval(row, how).p, rel=0.2, abs=5e-4)


def test_holms_adjusted_values_of_the_published_example() -> None:
    """R's p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm"), the example by which Holm's method is explained."""
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert holm([]) == []


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=12), st.randoms(use_true_random=False))
def test_holm_lies_between_the_plain_values_and_bonferronis_whatever_the_order(p: list[float], random) -> None:
    found = holm(p)
    for value, adjusted in zip(p, found, strict=True):
        assert value <= adjusted <= min(1.0, len(p) * value) + 1e-15
    mixed = list(range(len(p)))
    random.shuffle(mixed)
    assert [holm([p[i] for i in mixed])[mixed.index(i)] for i in range(len(p))] == pytest.approx(found)


def test_a_small_difference_in_one_of_many_tables_is_no_win_and_a_clear_one_is() -> None:
    """By chance alone some of 60 comparisons would be called; the correction calls none, and keeps a real one."""
    generator = np.random.default_rng(11)
    tables = {k: [generator.normal(0, 1, 50), generator.normal(0, 1, 50)] for k in range(60)}
    plain = [1 - len(rankings({0: rows}, HOW)[0].winners) + 1 for rows in tables.values()]
    assert sum(plain) >= 1, "none differs by chance: another seed shows nothing"
    together = rankings(tables, HOW)
    assert all(not ranking.separated for ranking in together.values())
    clear = tables | {"clear": [generator.normal(0, 1, 50), generator.normal(3, 1, 50)]}
    assert rankings(clear, HOW)["clear"].winners == (0,)


def test_two_draws_never_tell_anything_and_one_exact_number_does() -> None:
    pair = [np.array([1.0, 1.1]), np.array([5.0, 5.2])]
    assert rankings({0: pair}, HOW)[0].winners == (0, 1)
    assert rankings({0: [values[:1] for values in pair]}, HOW)[0].winners == (0,)
    assert rankings({0: [np.full(12, 1.0), np.full(12, 1.5), None]}, HOW)[0].winners == (0,)
    assert rankings({0: [None, None]}, HOW)[0].winners == ()
    assert overtakes(np.array([[3.0, 1.0]]), np.array([2.0]), 200, 1, 0.95) == 2


def test_the_same_seed_gives_the_same_interval() -> None:
    values = np.random.default_rng(2).exponential(1.0, 30)
    assert mean_interval(values, HOW) == mean_interval(values.copy(), HOW)
