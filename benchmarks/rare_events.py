"""How often the intervals of rare events hold the truth, where it is known in closed form.

    python benchmarks/rare_events.py [--seeds 200] [--first 0]

Each study makes as many estimates with as many points as `workbench sweep --rare` does, of functions in place of runs:
the sum of all coordinates in a corner of the cube (Irwin and Hall), one coordinate alone, the largest of some, and a
fall within a plain that nothing leads to. Printed: the truth, the mean of all estimates over it, their scatter, the
runs of a study, and of how many of the studies the 95 % interval holds the truth. Exit code 1 where that is fewer than
chance allows at 95 % (three standard deviations).
"""

from __future__ import annotations

import argparse
import math
import sys
from dataclasses import dataclass

import numpy as np

from workbench.simulate.rare import ESTIMATES, SAMPLES
from workbench.simulate.splitting import Array, Performance, Probability, splitting


@dataclass(frozen=True)
class Case:
    """A function of points, the value that is rarely passed, and how rarely."""

    name: str
    performance: Performance
    dimensions: int
    value: float
    truth: float


def total(points: Array) -> Array:
    """The sum of the coordinates."""
    found: Array = points.sum(axis=1)
    return found


def falling(points: Array) -> Array:
    """Nothing, but infinite in the corner in which the coordinates add up to more than 2.4."""
    return np.where(total(points) > 2.4, np.inf, 0.0)


def corner(dimensions: int, edge: float) -> float:
    """P(sum of the coordinates > dimensions - edge) in [-1, 1]^dimensions, for edge <= 2."""
    return edge**dimensions / (2**dimensions * math.factorial(dimensions))


LARGEST = 1.0 - 2.0 * (1.0 - (1.0 - 1e-4) ** 0.25)
CASES = (
    Case("sum of 2", total, 2, 1.2, corner(2, 0.8)),
    Case("sum of 3", total, 3, 2.7, corner(3, 0.3)),
    Case("sum of 6", total, 6, 5.5, corner(6, 0.5)),
    Case("one of 1", lambda points: points[:, 0], 1, 1 - 2e-5, 1e-5),
    Case("one of 5", lambda points: points[:, 0], 5, 1 - 2e-6, 1e-6),
    Case("largest of 4", lambda points: points.max(axis=1), 4, LARGEST, 1e-4),
    Case("fall in a plain", falling, 3, 1.0, corner(3, 0.6)),
)


def main() -> None:
    """Print a line for each case."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    asked = parser.parse_args()
    least = 0.95 - 3 * math.sqrt(0.95 * 0.05 / asked.seeds)
    print(f"{'':18}{'truth':>10}{'mean':>8}{'scatter':>9}{'runs':>9}{'hold it':>14}{'too high':>10}{'too low':>9}")
    few = False
    for case in CASES:
        means, runs, held, high, low = list[float](), 0, 0, 0, 0
        for seed in range(asked.first, asked.first + asked.seeds):
            study = [splitting(case.performance, case.dimensions, case.value, SAMPLES, np.random.default_rng((seed, i)))
                     for i in range(ESTIMATES)]
            one = Probability.of(study, SAMPLES)
            means += [each.probability / case.truth for each in study]
            runs += sum(each.runs for each in study)
            held, high, low = (held + (one.low <= case.truth <= one.high), high + (one.low > case.truth),
                               low + (one.high < case.truth))
        few |= held < least * asked.seeds
        print(f"{case.name:18}{case.truth:>10.2g}{np.mean(means):>8.3f}{np.std(means):>9.2f}{runs / asked.seeds:>9.0f}"
              f"{held:>7} of {asked.seeds}{high:>10}{low:>9}", flush=True)
    sys.exit(few)


if __name__ == "__main__":
    main()
