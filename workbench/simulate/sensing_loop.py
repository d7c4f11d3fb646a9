"""What a controller is told at a sample, and when its command gets away; laid out as in `model/sensing.py`.

Every function is compiled with the closed loop and called by it.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors

import math

# --- shared ---


def counted(p, v, odometer):
    """Position and speed by an odometer, which starts from the truth and is put right by balises; see `Sensing`.

    odometer: pulse (m), scale, spacing of balises (m), period of differences (s); last place known, last count, last
    section between balises, whether it has started.
    """
    section = math.floor(p / odometer[2]) if odometer[2] > 0.0 else 0.0
    if odometer[7] == 0.0:
        odometer[4], odometer[5], odometer[6], odometer[7] = p, rolled(p, odometer), section, 1.0
    if section > odometer[6]:
        odometer[4] = section * odometer[2]
    elif section < odometer[6]:
        odometer[4] = (section + 1.0) * odometer[2]
    odometer[6] = section
    count = rolled(p, odometer)
    v = (count - odometer[5]) / odometer[3] if odometer[3] > 0.0 else odometer[1] * v
    odometer[5] = count
    return odometer[4] + count - rolled(odometer[4], odometer), v


def rolled(p, odometer):
    """The way to a place as the wheels count it, in whole pulses where there are any."""
    way = odometer[1] * p
    return odometer[0] * math.floor(way / odometer[0]) if odometer[0] > 0.0 else way


def measured(sample, p, v, sensing):
    """Position and speed as the law is told them: by its odometer, with the noise of the sample, some samples late.

    sensing: noise, a row a sample and none for no noise; the last measurements, as many rows as they are late and one;
    the last commands, likewise; the odometer, empty for none.
    """
    noise, past = sensing[0], sensing[1]
    if sensing[3].shape[0] > 0:
        p, v = counted(p, v, sensing[3])
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
