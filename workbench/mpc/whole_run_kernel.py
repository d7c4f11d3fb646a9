"""What `MpcController` answers at a sample, with its observer, predictor and fallback: compiled, for whole runs.

It does what the classes of this room do, number by number, so that a run has the same bits. `follow`, `shift`,
`solve_linear` and `solve_nonlinear` are those of `solver_kernel.py`; the arrays are laid out in `whole_run.py`.

kind: 0 whether the model is linearised once; 1 the last sample; 2, 3, 4 the most programs, passes and iterations;
5 whether the actuator is told; 6 whether in a tube, 1, or adaptive, 2. state: 0 sample of the tracker's plan; 1 of the
kept plan; 2 its length, 0 for none; 3 whether a speed is expected; 4 the last sample taken down. own: 0 the observer's
gain; 1 its largest disturbance; 2 disturbance; 3 force; 4 expected speed; 5 surprise; 6 period; 7 rest of the delay;
8, 9 lowest and highest command; 10 step that ends an iteration; 11, 12 disturbance and speed taken down; 13 below which
speed nothing is. counts: as `COUNTED` in `whole_run.py`. clock: seconds and nanoseconds. tube: 0 the sample before that
of its nominal state; 1 how often the train was pushed beyond its bound. nominal: 0 to 2 that state; 3, 4 the feedback
to it; 5 the bound of a push; 6 the largest push beyond it. learner, known: as in `adaptive_kernel.py`; model,
own_rest, own_limits and seen are those of the train as it is estimated, acceleration what the curve asks of any.
"""

# ruff: noqa: F821, ANN001, ANN201, PLR0912, PLR0915
# mypy: ignore-errors

# --- kernel ---


def nanoseconds_now(which, clock):
    """Of the clock that Python's perf_counter reads, whole: in seconds the digits of a short step would be lost."""
    clock_gettime(which, clock.ctypes)
    return clock[0] * 1_000_000_000 + clock[1]


def corrected(v, state, own):
    """The observer's disturbance after a measured speed."""
    own[5] = 0.0
    if state[3] == 1:
        own[5] = (v - own[4]) / own[6]
        own[2] = min(max(own[2] + own[0] * own[5], -own[1]), own[1])
    return own[2]


def when_it_acts(k, x, disturbance, share, own, told, parameters, rest, under_way):
    """The state when the command of sample k takes effect, in place; share: nominal mass over the one predicted."""
    last = told.shape[0] - 1
    x[2] = share * x[2]
    if own[7] > 0.0:
        x[0], x[1], x[2] = follow(x[0], x[1], x[2], share * under_way[0], told[min(k, last)] + disturbance, rest)
    for i in range(under_way.shape[0] - 1):
        x[0], x[1], x[2] = follow(x[0], x[1], x[2], share * under_way[i + 1], told[min(k + i, last)] + disturbance,
                                  parameters)
    x[2] = x[2] / share


def expected_next(k, v, good, before, acts, own, state, told, parameters, rest, left):
    """Let the observer follow the commands that act until the next sample."""
    push = told[k] + own[2]
    speed = v if good else 0.0
    force = own[3]
    if own[7] > 0.0:
        _, speed, force = follow(0.0, speed, force, before, push, rest)
        _, expected, force = follow(0.0, speed, force, acts, push, left)
    else:
        _, expected, force = follow(0.0, speed, force, acts, push, parameters)
    own[3] = force if math.isfinite(force) else acts
    own[4] = expected
    state[3] = 1 if good else 0


def forgotten(state, memory):
    """Drop the tracker's warm start."""
    memory[0][:] = 0
    memory[1][:] = 0
    memory[2][:] = 0.0
    state[0] = -1


def planned_along(k, x, disturbance, kind, state, ahead, along_x, along_u, along_jac, along_gap, along_h, along_g,
                  along_answer, weights, terminal, limits, rows, price, memory, work, window, gap, plan):
    """The plan of `LinearMpc`: whether it may be used, and whether it converged."""
    N = plan.shape[0]
    last = k + N
    if 0 <= state[0] < k <= state[0] + N:
        for _ in range(k - state[0]):
            shift(memory[0], memory[1], memory[2])
    state[0] = k
    for i in range(N):
        for j in range(3):
            gap[i, j] = along_gap[k + i, j]
            if disturbance != 0.0:
                gap[i, j] = along_gap[k + i, j] + disturbance * along_answer[k + i, j]
    for i in range(N + 1):
        for j in range(6):
            window[i, j] = ahead[k + i, j]
        if disturbance != 0.0:
            window[i, 2] -= disturbance
            window[i, 3] -= disturbance
    how, _ = solve_linear(x, along_x[k : last + 1], along_u[k:last], along_jac[k:last], gap, along_h[k : last + 1],
                          along_g[k : last + 1], window, weights, terminal, limits, rows, price, memory, work, plan,
                          kind[3], kind[4])
    return how != 2, True


def planned_anew(k, x, disturbance, kind, state, own, ahead, parameters, weights, terminal, limits, rows, price,
                 memory, work, base, window, plan, unconverged):
    """The plan of `NonlinearMpc`: whether it may be used, and whether it converged."""
    N = plan.shape[0]
    for i in range(N + 1):
        for j in range(6):
            window[i, j] = ahead[k + i, j]
        if disturbance != 0.0:
            window[i, 5] += disturbance
            window[i, 2] -= disturbance
            window[i, 3] -= disturbance
    if 0 <= state[0] < k <= state[0] + N:
        for _ in range(k - state[0]):
            for i in range(N - 1):
                plan[i] = plan[i + 1]
            shift(memory[0], memory[1], memory[2])
    elif k != state[0]:
        for i in range(N):
            plan[i] = window[i, 3]
    state[0] = k
    status, programs, _, _, cost = solve_nonlinear(x, window, parameters, weights, terminal, limits, rows, price,
                                                   memory, work, base, plan, kind[2], kind[3], kind[4], own[10])
    good = math.isfinite(cost) and status != 2
    if good and status != 0 and kind[2] != 1:
        unconverged[programs] += 1
        return True, False
    return good, True


def planned_in_tube(k, x, kind, state, own, tube, nominal, ahead, along_x, along_u, along_jac, along_gap, along_h,
                    along_g, along_answer, parameters, weights, terminal, limits, rows, price, memory, work, window,
                    gap, plan):
    """The plan of `TubeMpc`: whether it may be used, and its first command, which the feedback is in."""
    if k != tube[0] + 1:
        forgotten(state, memory)
        for i in range(3):
            nominal[i] = x[i]
    good, _ = planned_along(k, nominal[:3], 0.0, kind, state, ahead, along_x, along_u, along_jac, along_gap, along_h,
                            along_g, along_answer, weights, terminal, limits, rows, price, memory, work, window, gap,
                            plan)
    first = plan[0] - (nominal[3] * (x[0] - nominal[0]) + nominal[4] * (x[1] - nominal[1]))
    nominal[0], nominal[1], nominal[2] = follow(nominal[0], nominal[1], nominal[2], plan[0], 0.0, parameters)
    tube[0] = k
    if not math.isfinite(nominal[0] + nominal[1] + nominal[2] + first):
        tube[0] = -2
        return False, 0.0
    return good, min(max(first, own[8]), own[9])


def as_estimated(estimate, learner, known, limits, acceleration, model, own_rest, own_limits, seen):
    """Give the tracker the train as it is estimated: its resistance, its limits and what the curve needs of it."""
    for i in range(3):
        model[i] = own_rest[i] = estimate[1 + i]
    # Commands and power are per unit of mass; the band, between them, is not.
    own_limits[0], own_limits[1] = estimate[0] * limits[0], estimate[0] * limits[1]
    own_limits[3] = estimate[0] * limits[3]
    last = seen.shape[0] - 1
    before = needed = acceleration[0] + resistance_at(seen[0, 1], model)
    for i in range(last + 1):
        after = min(i + 1, last)
        then = acceleration[after] + resistance_at(seen[after, 1], model)
        if learner[3] == 1:
            seen[i, 3], seen[i, 2] = needed, before
        else:
            seen[i, 3], seen[i, 2] = (then - known[7] * needed) / (1 - known[7]), needed
        before, needed = needed, then


def within(command, own):
    """Within the limits."""
    if not math.isfinite(command):
        command = 0.0
    return min(max(command, own[8]), own[9])


def command_of(sample, p, v, kind, state, own, counts, ahead, told, along_x, along_u, along_jac, along_gap, along_h,
               along_g, along_answer, parameters, rest, left, weights, terminal, limits, rows, price, gain, fixed,
               soft, pull, Q0, q0, R, r, low, high, bound, slope, Q, q, kept, dx, du, base_x, tried_x, tried, jac,
               base_gap, h, g, window, gap, plan, kept_plan, under_way, unconverged, foreseen, pushed, x, tube,
               nominal, learner, known, past, estimate, covariance, widest, learning, acceleration, model, own_rest,
               own_limits, seen):
    """The command of a sample, from a measured position and speed."""
    memory = (fixed, soft, pull)
    work = (Q0, q0, R, r, low, high, bound, slope, Q, q, kept, dx, du)
    k = min(sample, kind[1])
    good = abs(p) < 1e9 and abs(v) < 1e4
    solved = False
    disturbance = own[2]
    if good:
        disturbance = corrected(v, state, own)
        x[0], x[1], x[2] = p, v, own[3]
        if abs(own[5]) > nominal[5]:
            tube[1] += 1
            nominal[6] = max(nominal[6], abs(own[5]))
        converged, first, share = True, 0.0, 1.0
        if kind[6] == 2:
            if noticed(k, v, own[3], learner, known, past, estimate, covariance, widest, learning):
                as_estimated(estimate, learner, known, limits, acceleration, model, own_rest, own_limits, seen)
            share = estimate[0]
        if kind[5] == 1:
            if kind[6] == 2:
                when_it_acts(k, x, disturbance + estimate[4], share, own, told, model, own_rest, under_way)
            else:
                when_it_acts(k, x, disturbance, 1.0, own, told, parameters, rest, under_way)
        counts[0] += 1
        if kind[6] == 1:
            solved, first = planned_in_tube(
                k, x, kind, state, own, tube, nominal, ahead, along_x, along_u, along_jac, along_gap, along_h, along_g,
                along_answer, parameters, weights, terminal, limits, rows, price, memory, work, window, gap, plan)
        elif kind[6] == 2:
            nominal[0], nominal[1], nominal[2] = x[0], x[1], share * x[2]
            solved, converged = planned_anew(
                k, nominal[:3], disturbance + estimate[4], kind, state, own, seen, model, weights, terminal, own_limits,
                rows, price, memory, work, (base_x, tried_x, tried, jac, base_gap, h, g), window, plan, unconverged)
        elif kind[0] == 1:
            solved, converged = planned_along(
                k, x, disturbance, kind, state, ahead, along_x, along_u, along_jac, along_gap, along_h, along_g,
                along_answer, weights, terminal, limits, rows, price, memory, work, window, gap, plan)
        else:
            solved, converged = planned_anew(
                k, x, disturbance, kind, state, own, ahead, parameters, weights, terminal, limits, rows, price, memory,
                work, (base_x, tried_x, tried, jac, base_gap, h, g), window, plan, unconverged)
        for i in range(plan.shape[0]):
            solved = solved and math.isfinite(plan[i] / share)
        if solved:
            if not converged:
                counts[2] += 1
            for i in range(plan.shape[0]):
                kept_plan[i] = plan[i] / share
            if kind[6] == 1:
                kept_plan[0] = first
            state[1], state[2] = k, plan.shape[0]
        else:
            counts[1] += 1
            forgotten(state, memory)
    else:
        counts[6] += 1
    age = k - state[1]
    if solved:
        answer = kept_plan[0]
    elif 0 <= age < state[2]:
        counts[3] += 1
        answer = kept_plan[age]
    else:
        answer = ahead[k, 3] - disturbance
        if good:
            counts[4] += 1
            off = (x[0] - ahead[k, 0], x[1] - ahead[k, 1], x[2] - ahead[k, 2] + disturbance)
            answer -= gain[0] * off[0] + gain[1] * off[1] + gain[2] * off[2]
        else:
            counts[5] += 1
    answer = within(answer, own)
    before, acts = answer, answer
    if kind[5] == 1:
        before = under_way[0]
        for i in range(under_way.shape[0] - 1):
            under_way[i] = under_way[i + 1]
        under_way[under_way.shape[0] - 1] = answer
        acts = under_way[0]
    expected_next(k, v, good, before, acts, own, state, told, parameters, rest, left)
    taken_down = state[4]
    if pushed.shape[0] > 0:
        if taken_down == k - 1 and 0 <= taken_down < pushed.shape[0] and min(own[12], v) > own[13]:
            pushed[taken_down] = foreseen[taken_down] + own[11] + own[5]
        if taken_down != k:
            state[4], own[11], own[12] = k, own[2], v
    return answer
