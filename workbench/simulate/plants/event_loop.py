"""A plant step in which events happen; joined with the loop, which asks the plant for its events' expressions, their
rates and what they reset.

`sides`, a row an event: on which side of zero its expression is (-1, 1, or 0 where not known), whether it acts as it
falls, and as it rises, and whether it stands at zero because it has just acted.
"""

# ruff: noqa: F821, ANN001, ANN201, PLR0912
# mypy: ignore-errors

MOST_IN_A_RUN = 100_000

# --- shared ---


def inputs_between(t, h, begin, end, u, u_end, fade_full, table, pieces, inputs, signals):
    """Inputs and signals at the begin, middle and end of a part of a plant step, in rows; times from the step's t."""
    for place in range(3):
        at = begin + 0.5 * place * (end - begin)
        for i in range(u.shape[0]):
            away = (u[i] - u_end[i]) / (1.0 - fade_full[i])
            command = u[i] - away
            inputs[place, i] = command if fade_full[i] == 0.0 else command + fade_full[i] ** (at / h) * away
        if table.shape[0] > 0:
            signal_values(t + at, t, table, pieces, signals[place])


def crossed(sides, crossing, standing):
    """The first event whose expression has crossed zero as it shall; -1 for none.

    standing: those that stand at zero because they have just acted have not.
    """
    for i in range(sides.shape[0]):
        acts = (sides[i, 1] if sides[i, 0] > 0.0 else sides[i, 2]) > 0.0
        if acts and sides[i, 0] * crossing[i] < 0.0 and not (standing and sides[i, 3] > 0.0):
            return i
    return -1


def settle(sides, crossing, moved):
    """Take the sides as they are, but of events that are about to act and, unless the plant has moved, of those that
    have just acted."""
    for i in range(sides.shape[0]):
        acts = sides[i, 0] * crossing[i] < 0.0 and (sides[i, 1] if sides[i, 0] > 0.0 else sides[i, 2]) > 0.0
        if crossing[i] != 0.0 and not acts and (moved or sides[i, 3] == 0.0):
            sides[i, 0] = 1.0 if crossing[i] > 0.0 else -1.0
        if moved:
            sides[i, 3] = 0.0


# --- kernel ---

PILED_UP, TOO_MANY = 6, 7
MOST_IN_A_STEP = 100
LOCATED = 1e-13  # of a plant step


def act(plant, which, located, t, states, x, u, s, p, extremes, values, sides, crossing, slopes, event_log,
        event_count):
    """Reset the states by an event; whether there is room for it in the log. located: its expression is at zero."""
    if event_count[0] >= event_log.shape[0]:
        return False
    if extremes.shape[0] > 0:
        add_extremes(plant, t, x, u, s, p, extremes, values)
    before = abs(crossing[which]) if located else 0.0
    asked(plant, RESET + which, t, x, u, s, p, x)
    if extremes.shape[0] > 0:
        add_extremes(plant, t, x, u, s, p, extremes, values)
    asked(plant, EVENTS, t, x, u, s, p, crossing)
    sides[which, 3] = 1.0 if abs(crossing[which]) <= before else 0.0
    leaving = crossing[which]
    if sides[which, 3] > 0.0:  # it stands at zero, whatever rounding says: its rate tells the side that it goes to
        asked(plant, EVENT_RATES, t, x, u, s, p, slopes)
        leaving = slopes[which]
    sides[which, 0] = 1.0 if leaving > 0.0 else (-1.0 if leaving < 0.0 else 0.0)
    row = event_count[0]
    event_log[row, 0], event_log[row, 1] = t, which
    for i in range(states):
        event_log[row, 2 + i] = x[i]
    event_count[0] = row + 1
    return True


def step_with_events(plant, k, h, states, x, u, u_end, fade_full, table, pieces, p, extremes, values, sides, crossing,
                     slopes, event_log, event_count, moved, inputs, signals):
    """One plant step with all events in it, each located by bisection; 0, or the status that ends the run.

    What has crossed zero by a jump of an input or by another event's reset acts at once, in the order of the events.
    """
    t, done, count = k * h, 0.0, 0
    while True:
        inputs_between(t, h, done, h, u, u_end, fade_full, table, pieces, inputs, signals)
        asked(plant, EVENTS, t + done, x, inputs[0], signals[0], p, crossing)
        which, low = crossed(sides, crossing, True), done
        located = which < 0
        if located:
            settle(sides, crossing, False)
            for i in range(sides.shape[0]):
                if sides[i, 3] > 0.0:  # it begins at zero: where has it left it?
                    low = -1.0
            at, high = h, h
            while True:
                inputs_between(t, h, done, at, u, u_end, fade_full, table, pieces, inputs, signals)
                for i in range(x.shape[0]):
                    moved[i] = x[i]
                moved_by(plant, t + done, at - done, moved, inputs[0], signals[0], inputs[1], signals[1], inputs[2],
                         signals[2], p)
                asked(plant, EVENTS, t + at, moved, inputs[2], signals[2], p, crossing)
                which = crossed(sides, crossing, False)
                if which < 0 and at == h:
                    break
                if which < 0:
                    low = at
                else:
                    high = at
                near = high - max(low, done) <= LOCATED * h
                if near and low < 0.0:
                    return PILED_UP
                if near and at == high:
                    break
                at = high if near else 0.5 * (max(low, done) + high)
            settle(sides, crossing, True)
            for i in range(x.shape[0]):
                x[i] = moved[i]
            if which < 0:
                return 0
            done = at
        count += 1
        if count > MOST_IN_A_STEP:
            return PILED_UP
        place = 2 if located else 0  # where the inputs and signals of this instant are
        if not act(plant, which, located, t + done, states, x, inputs[place], signals[place], p, extremes, values,
                   sides, crossing, slopes, event_log, event_count):
            return TOO_MANY
