"""What a controller is told at a sample, and when its command gets away; laid out as in `model/sensing.py`.

Every function is compiled with the closed loop and called by it.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors

import math

# --- shared ---


def measured(sample, p, v, sensing):
    """Position and speed as the law is told them: with the noise of the sample, some samples late.

    sensing: noise, a row a sample and none for no noise; the last measurements, as many rows as they are late and one;
    the last commands, likewise.
    """
    noise, past = sensing[0], sensing[1]
    if noise.shape[0] > 0:
        p += noise[sample % noise.shape[0], 0]
        v += noise[sample % noise.shape[0], 1]
    late = past.shape[0] - 1
    if late == 0:
        return p, v
    past[sample % (late + 1), 0], past[sample % (late + 1), 1] = p, v
    told = max(sample - late, 0) % (late + 1)
    return past[told, 0], past[told, 1]


def delayed(sample, u, commands):
    """The command that reaches the motors, as many samples late as `commands` has rows beyond the first; 0 before."""
    late = commands.shape[0] - 1
    if late == 0:
        return u
    commands[sample % (late + 1)] = u
    return commands[(sample - late) % (late + 1)] if sample >= late else 0.0
