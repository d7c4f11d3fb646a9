"""The trials of jiao2025 written again from its text with plain Python numbers, one sample after the other."""

import math


def v_desired(k):
    """(16)."""
    if k <= 338:
        return -35 / 57122 * (k - 338) ** 2 + 70
    if k <= 700:
        return k / 181 + 12332 / 181
    if k <= 1000:
        return -0.01 * k + 79
    if k <= 1600:
        return k / 600 + 202 / 3
    return -7 / 16000 * (k - 1600) ** 2 + 70


def resistance(k, v, divisor, opposed):
    """(3) with (17) times M over the divisor, in N."""
    s = math.sin(0.0037 * k)
    b0, b1, b2 = 2977 + 275 * s, 25.17 + 2.5 * s, 0.2864 + 0.04 * s
    if opposed:
        return math.copysign((b0 + b1 * abs(v) + b2 * v * v) / divisor, v) if v else 0.0
    return (b0 + b1 * v + b2 * v * v) / divisor


def run(plan):
    """Mean squared errors, speeds and estimates of the last trial of a plan, by the equations of the paper."""
    whole, p = len(plan.desired) - 1, plan.parameters
    lengths = [int(length) for length in plan.lengths]
    desired = [v_desired(j * plan.k_per_sample) for j in range(whole + 1)]
    u = [plan.first_input] * whole
    phi = [plan.first_estimate] * whole
    history = []  # of every trial: inputs, speeds, errors; None where there are no data
    squares = []
    for i, length in enumerate(lengths):
        if i > 0:
            u, phi = learn(plan.law.removeprefix("jiao2025."), p, plan.first_estimate, u, phi, history)
        v = [0.0] + [None] * whole
        position = 0.0
        for j in range(length):
            place = {"train": position, "desired": plan.desired_positions[j],
                     "stretched": plan.desired_positions[min(whole, int(j * whole / length))]}[plan.seen_by]
            section = sum(place >= edge for edge in plan.edges[1:-1])
            net = plan.unit_n * u[j] - plan.additional_n[section] - resistance(
                j * plan.k_per_sample, v[j], plan.divisor, plan.opposed)
            position += plan.step_s * v[j]
            v[j + 1] = v[j] + plan.step_s / plan.mass_kg * net
        e = [None if speed is None else wanted - speed for wanted, speed in zip(desired, v, strict=True)]
        squares.append(sum(error**2 for error in e[1 : length + 1]) / length)
        history.append((list(u), v, e))
    return squares, history[-1][1], phi


def learn(law, p, first, u, phi, history):
    """Inputs and estimates of the next trial."""
    e = history[-1][2]
    new_u, new_phi = [], []
    for j in range(len(u)):
        estimate, error = phi[j], 0.0 if e[j + 1] is None else e[j + 1]
        if law in ("pd", "pd_difference"):
            now = 0.0 if e[j] is None else e[j]
            step = p["K_p"] * error + p["K_d"] * (now if law == "pd" else error - now)
        elif law == "fixed_estimate":
            step = p["rho"] * first / (p["lamda"] + first**2) * error
        else:
            estimate = adapt(law, p, first, estimate, j, history)
            step = p["rho"] * estimate / (p["lamda"] + abs(estimate) ** 2) * error
        new_u.append(u[j] + step)
        new_phi.append(estimate)
    return new_u, new_phi


def adapt(law, p, first, estimate, j, history):
    """(15), then (13); nothing to adapt to in trial 1."""
    if len(history) < 2:
        return first
    (u_before, v_before, _), (u, v, _) = history[-2:]
    change = u[j] - u_before[j]
    if v[j + 1] is not None and v_before[j + 1] is not None:
        surprise = v[j + 1] - v_before[j + 1] - estimate * change
        estimate += p["eta"] * change / (p["mu"] + abs(change) ** 2) * surprise
    elif v[j + 1] is not None:
        # The speed that is missing stands before a change of zero.
        assert change == 0 or law == "icfdl_remembering"
    if law == "icfdl_remembering" and (v[j + 1] is None or v_before[j + 1] is None):
        return estimate
    small = abs(estimate) <= p["epsilon"] or abs(change) <= p["epsilon"]
    return first if small or math.copysign(1, estimate) != math.copysign(1, first) else estimate
