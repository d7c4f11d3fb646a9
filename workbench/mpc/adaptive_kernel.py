"""What `adaptive.py` learns from a sample, number by number; Python calls it as it stands, and whole runs compile it.

known: 0 what a second's forgetting divides the covariance by, to the power of the span; 1 the span in seconds; 2 how
far the push wanders in it, squared; 3 what an equation misses, squared; 4, 5 least and largest gain; 6 power, W/kg;
7 what a lag leaves of a force after a sample. learner: 0 how many samples of the past there are; 1 the last of them;
2 the span in samples; 3 whether a force is there at once.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors

import math

# --- kernel ---


def take_in(estimate, covariance, widest, learning, known, acceleration, command, speed, speed_square):
    """Take in one equation: means over the span of acceleration, command, speed and its square."""
    row, pulled, shrink = learning[0], learning[1], learning[2]
    row[0], row[1], row[2], row[3], row[4] = command, -1.0, -speed, -speed_square, 1.0
    for i in range(5):
        for j in range(5):
            covariance[i, j] /= known[0]
    covariance[4, 4] += known[2]
    for i in range(5):
        shrink[i] = min(1.0, math.sqrt(widest[i] / max(covariance[i, i], 1e-300)))
    for i in range(5):
        for j in range(5):
            covariance[i, j] *= shrink[i] * shrink[j]
    scale, error = known[3], acceleration
    for i in range(5):
        pulled[i] = 0.0
        for j in range(5):
            pulled[i] += covariance[i, j] * row[j]
        scale += row[i] * pulled[i]
        error -= row[i] * estimate[i]
    for i in range(5):
        estimate[i] += pulled[i] / scale * error
        for j in range(5):
            covariance[i, j] -= pulled[i] * pulled[j] / scale
    estimate[0] = min(max(estimate[0], known[4]), known[5])
    for i in range(1, 4):
        estimate[i] = max(estimate[i], 0.0)


def noticed(k, speed, force, learner, known, past, estimate, covariance, widest, learning):
    """Take in a sample; whether it made an equation that moved the estimate."""
    if k != learner[1] + 1:
        learner[0] = 0
    if k != learner[1]:
        past[learner[0], 0] = speed
        past[learner[0], 1] = min(force, known[6] / max(speed, 1e-3))
        learner[0] += 1
    learner[1] = k
    span = learner[2]
    if learner[0] <= span:
        return False
    acting, speeds, squares, slowest = 0.0, 0.0, 0.0, math.inf
    for i in range(span):
        # The force of a sample acted until its speed was measured; where it lags, between two of them.
        acting += past[i + 1, 1] if learner[3] == 1 else (past[i + 1, 1] + past[i, 1]) / 2
        middle = (past[i + 1, 0] + past[i, 0]) / 2
        speeds += middle
        squares += middle * middle
        slowest = min(slowest, middle)
    moving = slowest > 0.0  # at a standstill the brakes hold whatever they are asked
    if moving:
        take_in(estimate, covariance, widest, learning, known, (past[span, 0] - past[0, 0]) / known[1], acting / span,
                speeds / span, squares / span)
    past[0, 0], past[0, 1] = past[span, 0], past[span, 1]
    learner[0] = 1
    return moving
