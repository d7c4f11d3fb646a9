"""The trains, lines and wheels of a Monte Carlo: by chance, or spread evenly by a scrambled Sobol' sequence.

Each run's factors depend on the scenario, the seed and the run's number alone, and are the same for every controller
(common random numbers): differences between controllers are taken on the same trains.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import fields
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from workbench.simulate.setting import Factors
from workbench.trains.scenario import Scenario

Draws = Literal["random", "sobol"]
_NAMES = tuple(f.name for f in fields(Factors))


def draw_factors(scenario: Scenario, run: int, seed: int | None = None) -> Factors:
    """The factors of one run, drawn by chance; the seed is the scenario's unless given."""
    return next(factors_of(scenario, run, 1, seed))


def factors_of(scenario: Scenario, first: int, count: int, seed: int | None = None,
               draws: Draws = "random") -> Iterator[Factors]:
    """The factors of so many runs, from number `first` on.

    Each factor is drawn whether or not the scenario names it, so that naming one more changes no other.
    """
    seed = scenario.uncertainty.seed if seed is None else seed
    spread = spreads(scenario)
    for drawn in _sobol(first, count, seed) if draws == "sobol" else _random(first, count, seed):
        yield Factors(*(1.0 + spread[name] * x if name in spread else 1.0
                        for name, x in zip(_NAMES, drawn.tolist(), strict=True)))


def spreads(scenario: Scenario) -> dict[str, float]:
    """By the name of each factor that is drawn, how far it may lie from 1, in the order of `Factors`."""
    uncertainty = scenario.uncertainty
    stated = dict.fromkeys(uncertainty.factors, uncertainty.spread) | {"odometer_scale": uncertainty.odometer_spread}
    return {name: stated[name] for name in _NAMES if stated.get(name)}


def _random(first: int, count: int, seed: int) -> Iterator[NDArray[np.float64]]:
    for run in range(first, first + count):
        sequence = np.random.SeedSequence(seed, spawn_key=(run,))
        yield np.random.default_rng(sequence).uniform(-1.0, 1.0, len(_NAMES))


def _sobol(first: int, count: int, seed: int) -> NDArray[np.float64]:
    """Points of one sequence in [-1, 1), shape (count, factors); powers of two of them fill the space evenly."""
    from scipy.stats.qmc import Sobol  # noqa: PLC0415 - takes a second, which draws by chance have no use for

    sequence = Sobol(len(_NAMES), scramble=True, rng=np.random.default_rng(seed))
    if first:
        sequence.fast_forward(first)
    with warnings.catch_warnings():  # a part of a sequence need not be a power of two long
        warnings.simplefilter("ignore", UserWarning)
        found: NDArray[np.float64] = 2.0 * sequence.random(count) - 1.0
    return found
