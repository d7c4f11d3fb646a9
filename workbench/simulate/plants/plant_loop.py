"""The sampled closed loop of any plant, compiled once for all: plant and law are called by their addresses.

A call costs a few nanoseconds a step, a loop some seconds to compile. plant: `answer` of `plant_call.py`, whose
questions are joined with the loop; law: `answer` of `law_call.py`; step_with_events: of `event_loop.py`. Arrays:
x the states and what is integrated with them; u inputs as they act; s signals, four values each (value and three
rates), disturbances first, then references; p parameters.
"""

# ruff: noqa: F821, ANN001, ANN201, PLR0912
# mypy: ignore-errors

import math

from workbench.simulate.plants import event_loop

SHARES = (event_loop,)
# What Python calls; all else is called by compiled functions alone.
ENTRIES = ("signal_values", "limited", "asked", "law_answer", "advance", "add_extremes", "record", "closed_loop")
MAKES_NO_ARRAY = True
RUNNING, DIVERGED, OUTSIDE, NO_COMMAND, LAW_OUTSIDE = 0, 1, 2, 3, 4

# --- shared ---


def signal_values(t, begin, table, pieces, out):
    """Value and three rates of every signal at t; one that jumps is held from the begin of a plant step on."""
    for i in range(table.shape[0]):
        row, at = table[i], 4 * i
        kind = row[0]
        for j in range(4):
            out[at + j] = 0.0
        if kind == 0.0:
            out[at] = row[1] + row[2] * t
            out[at + 1] = row[2]
        elif kind == 1.0:
            out[at] = row[1] if begin + 1e-9 < row[3] else row[1] + row[2]
        elif kind == 2.0:
            w = row[3]
            sine, cosine = math.sin(w * t + row[4]), math.cos(w * t + row[4])
            out[at] = row[1] + row[2] * sine
            out[at + 1] = row[2] * w * cosine
            out[at + 2] = -row[2] * w * w * sine
            out[at + 3] = -row[2] * w * w * w * cosine
        else:
            low, high = int(row[5]), int(row[5] + row[6]) - 1
            if t < pieces[low, 0]:  # the straight piece before the spline begins where the spline does
                high = low
            while low < high:  # the last piece that begins at or before t
                middle = (low + high + 1) // 2
                if pieces[middle, 0] <= t:
                    low = middle
                else:
                    high = middle - 1
            ahead = t - pieces[low, 0]
            c1, c2, c3 = pieces[low, 2], pieces[low, 3], pieces[low, 4]
            out[at] = pieces[low, 1] + ahead * (c1 + ahead * (c2 + ahead * c3))
            out[at + 1] = c1 + ahead * (2.0 * c2 + 3.0 * ahead * c3)
            out[at + 2] = 2.0 * c2 + 6.0 * ahead * c3
            out[at + 3] = 6.0 * c3


def limited(command, lower, upper, out, commanded):
    """The command within its limits; whether every number of it is finite. commanded, a row each: how many commands
    there were, the sizes of their changes, summed, and how many were at a limit or beyond."""
    for i in range(command.shape[0]):
        if not math.isfinite(command[i]):
            return False
        within = min(max(command[i], lower[i]), upper[i])
        if commanded[0, i] > 0.0:
            commanded[1, i] += abs(within - out[i])
        if command[i] <= lower[i] or command[i] >= upper[i]:
            commanded[2, i] += 1.0
        commanded[0, i] += 1.0
        out[i] = within
    return True


# --- kernel ---


def asked(plant, what, t, x, u, s, p, out):
    """What else than a step a plant is asked at an instant, and its answer."""
    return plant(what, t, 0.0, x.ctypes, u.ctypes, s.ctypes, u.ctypes, s.ctypes, u.ctypes, s.ctypes, p.ctypes,
                 out.ctypes)


def moved_by(plant, t, h, x, u, s, u_middle, s_middle, u_end, s_end, p):
    """Move the states by a step; the margin of the plant's domain at its end."""
    return plant(STEP, t, h, x.ctypes, u.ctypes, s.ctypes, u_middle.ctypes, s_middle.ctypes, u_end.ctypes, s_end.ctypes,
                 p.ctypes, x.ctypes)


def law_answer(law, t, period, measured, s, states, parameters, command):
    """The margin of the law's domain, and in it its command, with its states moved."""
    return law(t, period, measured.ctypes, s.ctypes, states.ctypes, parameters.ctypes, command.ctypes)


def advance(plant, first, count, h, states, x, wanted, u, u_middle, u_end, delays, ring, fade_half, fade_full, table,
            pieces, s, s_middle, s_end, p, extremes, values, sides, crossing, slopes, event_log, event_count, moved,
            inputs, signals, log, log_every, told):
    """Move the plant by `count` steps with the command `wanted` held; (status, steps done).

    ring: the last commands, a row a step, for delayed inputs; fade: what is left of an input's distance to its
    command after half a step and a whole one, 0 for an input without lag; told: the law's states as the command was
    taken from them, for the log.
    """
    length = ring.shape[0]
    delayed, moving = length > 1, table.shape[0] > 0
    until_log = (log_every - first % log_every) % log_every  # counted: a division a step takes as long as a sine
    held = not delayed  # every input is its command throughout, and nothing of it is computed at each step
    for i in range(u.shape[0]):
        held = held and fade_full[i] == 0.0
    for i in range(u.shape[0] if held else 0):
        u[i] = wanted[i]
        u_middle[i] = wanted[i]
        u_end[i] = wanted[i]
    for k in range(first, first + count):
        t = k * h
        if moving:
            signal_values(t, t, table, pieces, s)
            signal_values(t + 0.5 * h, t, table, pieces, s_middle)
            signal_values(t + h, t, table, pieces, s_end)
        if delayed:
            for i in range(u.shape[0]):
                ring[k % length, i] = wanted[i]
        for i in range(0 if held else u.shape[0]):
            command = ring[(k - delays[i]) % length, i] if delayed else wanted[i]
            if fade_full[i] == 0.0:  # without lag
                u[i] = command
            away = u[i] - command
            u_middle[i] = command + fade_half[i] * away
            u_end[i] = command + fade_full[i] * away
        if until_log == 0:
            record(t, states, x, u, wanted, s, told, log, k // log_every)
            until_log = log_every
        until_log -= 1
        if extremes.shape[0] > 0:
            add_extremes(plant, t, x, u, s, p, extremes, values)
        if sides.shape[0] > 0:
            status = step_with_events(plant, k, h, states, x, u, u_end, fade_full, table, pieces, p, extremes, values,
                                      sides, crossing, slopes, event_log, event_count, moved, inputs, signals)
            if status != 0:
                return status, k + 1 - first
            margin = asked(plant, MARGIN, t + h, x, u_end, s, p, x)
        else:
            margin = moved_by(plant, t, h, x, u, s, u_middle, s_middle, u_end, s_end, p)
        for i in range(0 if held else u.shape[0]):
            u[i] = u_end[i]
        for i in range(states):
            if not abs(x[i]) < 1e12:
                return 1, k + 1 - first
        if not margin > 0.0:
            return 2, k + 1 - first
    return 0, count


def add_extremes(plant, t, x, u, s, p, extremes, values):
    """Keep the largest value so far of every expression that is taken at each step."""
    asked(plant, EXTREMES, t, x, u, s, p, values)
    for i in range(extremes.shape[0]):
        # What is no number at one step stays none: an extreme of the rest would be another metric's.
        if not math.isnan(extremes[i]):
            extremes[i] = values[i] if math.isnan(values[i]) else max(extremes[i], values[i])


def record(t, states, x, u, wanted, s, law_states, log, row):
    """A row of the log: time, states, inputs as they act, commands, the signals' values, the law's states."""
    if row >= log.shape[0]:
        return
    log[row, 0] = t
    at = 1
    for i in range(states):
        log[row, at + i] = x[i]
    at += states
    for i in range(u.shape[0]):
        log[row, at + i] = u[i]
        log[row, at + u.shape[0] + i] = wanted[i]
    at += 2 * u.shape[0]
    for i in range(s.shape[0] // 4):
        log[row, at + i] = s[4 * i]
    at += s.shape[0] // 4
    for i in range(law_states.shape[0]):
        log[row, at + i] = law_states[i]


def closed_loop(plant, law, samples, every, h, states, x, wanted, u, u_middle, u_end, delays, ring, fade_half,
                fade_full, lower, upper, table, pieces, s, s_middle, s_end, p, extremes, values, sides, crossing,
                slopes, event_log, event_count, moved, inputs, signals, log, log_every, told, measured, noise, late,
                seen, law_states, law_parameters, command, commanded):
    """Samples of `every` plant steps each: measure, command, hold; (status, plant steps done)."""
    period, kept = every * h, seen.shape[0]
    for sample in range(samples):
        asked(plant, OUTPUTS, sample * period, x, x, x, p, measured)
        row = sample % kept
        for i in range(measured.shape[0]):
            seen[row, i] = measured[i] + noise[sample, i]
        for i in range(measured.shape[0]):
            back = row - min(late[i], sample)
            measured[i] = seen[back if back >= 0 else back + kept, i]
        t = sample * period
        signal_values(t, t, table, pieces, s)
        for i in range(told.shape[0]):
            told[i] = law_states[i]
        if not law_answer(law, t, period, measured, s, law_states, law_parameters, command) > 0.0:
            return 4, sample * every
        if not limited(command, lower, upper, wanted, commanded):
            return 3, sample * every
        status, done = advance(plant, sample * every, every, h, states, x, wanted, u, u_middle, u_end, delays, ring,
                               fade_half, fade_full, table, pieces, s, s_middle, s_end, p, extremes, values, sides,
                               crossing, slopes, event_log, event_count, moved, inputs, signals, log, log_every, told)
        if status != 0:
            return status, sample * every + done
    return 0, samples * every
