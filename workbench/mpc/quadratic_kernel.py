"""The quadratic program of a horizon, solved along its stages; compiled together with `solver_kernel.py`.

Unknowns are the steps dx, du away from a base. Commands have bounds; a soft row h + g dx <= s costs
price s + 2nd price s^2. First a primal-dual active set, from the last one: a pass of Riccati's recursion solves the
program for a guessed set, what breaks a sign moves, until none does. Then the answer meets the conditions of
optimality, which for a convex program is a proof. Where that takes too many passes, an interior point method.
"""

# ruff: noqa: F821, ANN001, ANN201, PLR0912, PLR0915
# mypy: ignore-errors

# --- kernel ---


def riccati(cross, jac, gap, start, Q, q, R, r, fixed, bound, kept, dx, du, slope):
    """One linear-quadratic problem: dx, du, and the slope of the cost in each command.

    Q: (N+1, 6), the upper triangle; q: (N+1, 3); cross: the Hessian's entry of F and u; fixed: commands at `bound`.
    """
    N = R.shape[0]
    P00, P01, P02, P11, P12, P22 = Q[N, 0], Q[N, 1], Q[N, 2], Q[N, 3], Q[N, 4], Q[N, 5]
    p0, p1, p2 = q[N, 0], q[N, 1], q[N, 2]
    for k in range(N - 1, -1, -1):
        g0, g1, g2 = gap[k, 0], gap[k, 1], gap[k, 2]
        y0 = p0 + P00 * g0 + P01 * g1 + P02 * g2
        y1 = p1 + P01 * g0 + P11 * g1 + P12 * g2
        y2 = p2 + P02 * g0 + P12 * g1 + P22 * g2
        bb, b0, b1, b2, a00, a01, a02, a11, a12, a22, by, ay0, ay1, ay2 = backward(
            P00, P01, P02, P11, P12, P22, y0, y1, y2, jac[k, 0], jac[k, 1], jac[k, 2], jac[k, 3], jac[k, 4], jac[k, 5],
            jac[k, 6], jac[k, 7], jac[k, 8], jac[k, 9], jac[k, 10], jac[k, 11], jac[k])
        b2 = b2 + cross
        huu = R[k] + bb
        gu = r[k] + by
        kept[k, 0], kept[k, 1], kept[k, 2], kept[k, 3], kept[k, 4] = b0, b1, b2, huu, gu
        if fixed[k] == 0:
            inverse = 1.0 / huu
            w0, w1, w2 = b0 * inverse, b1 * inverse, b2 * inverse
            step = -gu * inverse
        else:
            w0, w1, w2 = 0.0, 0.0, 0.0
            step = bound[k]
        P00 = Q[k, 0] + a00 - b0 * w0
        P01 = Q[k, 1] + a01 - b0 * w1
        P02 = Q[k, 2] + a02 - b0 * w2
        P11 = Q[k, 3] + a11 - b1 * w1
        P12 = Q[k, 4] + a12 - b1 * w2
        P22 = Q[k, 5] + a22 - b2 * w2
        p0 = q[k, 0] + ay0 + b0 * step
        p1 = q[k, 1] + ay1 + b1 * step
        p2 = q[k, 2] + ay2 + b2 * step
    d0, d1, d2 = start[0], start[1], start[2]
    dx[0, 0], dx[0, 1], dx[0, 2] = d0, d1, d2
    for k in range(N):
        pull = kept[k, 0] * d0 + kept[k, 1] * d1 + kept[k, 2] * d2 + kept[k, 4]
        step = bound[k] if fixed[k] != 0 else -pull / kept[k, 3]
        du[k] = step
        slope[k] = pull + kept[k, 3] * step
        n0 = jac[k, 0] * d0 + jac[k, 1] * d1 + jac[k, 2] * d2 + jac[k, 3] * step + gap[k, 0]
        n1 = jac[k, 4] * d0 + jac[k, 5] * d1 + jac[k, 6] * d2 + jac[k, 7] * step + gap[k, 1]
        d2 = jac[k, 8] * d0 + jac[k, 9] * d1 + jac[k, 10] * d2 + jac[k, 11] * step + gap[k, 2]
        d0, d1 = n0, n1
        dx[k + 1, 0], dx[k + 1, 1], dx[k + 1, 2] = d0, d1, d2


def add_row(Q, q, k, g0, g1, g2, curvature, push):
    """Add curvature/2 (g dx)^2 + push g dx to the cost of stage k."""
    Q[k, 0] += curvature * g0 * g0
    Q[k, 1] += curvature * g0 * g1
    Q[k, 2] += curvature * g0 * g2
    Q[k, 3] += curvature * g1 * g1
    Q[k, 4] += curvature * g1 * g2
    Q[k, 5] += curvature * g2 * g2
    q[k, 0] += push * g0
    q[k, 1] += push * g1
    q[k, 2] += push * g2


def copy_cost(Q0, q0, Q, q):
    """The cost without rows."""
    for k in range(Q0.shape[0]):
        for i in range(6):
            Q[k, i] = Q0[k, i]
        for i in range(3):
            q[k, i] = q0[k, i]


def active_set(cross, jac, gap, start, Q0, q0, R, r, low, high, rows, price, h, g, fixed, bound, state, pull, work, dx,
               du, slope, most_passes):
    """The program by its active set, from the one given; the number of passes, or -1 where they did not suffice.

    fixed: -1, 0, 1 for commands at `low`, free, at `high`; state: 0 for rows that hold, 1 for those at their limit,
    with the multiplier `pull`, 2 for those that are exceeded. All are left as found.
    """
    Q, q, kept = work
    N = R.shape[0]
    stiff = 1e7 * max(R[0], Q0[1, 0], Q0[1, 3])
    for passed in range(1, most_passes + 1):
        copy_cost(Q0, q0, Q, q)
        for k in range(1, N):
            for n in range(rows.shape[0]):
                i = rows[n]
                if state[k, i] == 1:
                    # At its limit: an augmented Lagrangian, whose error shrinks by some `stiff` a pass.
                    add_row(Q, q, k, g[k, i, 0], g[k, i, 1], g[k, i, 2], stiff, pull[k, i] + stiff * h[k, i])
                elif state[k, i] == 2:
                    second = 2.0 * price[i, 1]
                    add_row(Q, q, k, g[k, i, 0], g[k, i, 1], g[k, i, 2], second, price[i, 0] + second * h[k, i])
        for k in range(N):
            bound[k] = high[k] if fixed[k] > 0 else low[k]
        riccati(cross, jac, gap, start, Q, q, R, r, fixed, bound, kept, dx, du, slope)
        moved = False
        for k in range(N):
            if not abs(du[k]) < 10.0 * (high[k] - low[k]) + abs(high[k]) + abs(low[k]) + 1.0:
                return -1  # what is held contradicts itself, and the guesses after it hardly come to rest
            if fixed[k] == 0:
                if du[k] > high[k] + 1e-10:
                    fixed[k] = 1
                    moved = True
                elif du[k] < low[k] - 1e-10:
                    fixed[k] = -1
                    moved = True
            elif fixed[k] * slope[k] > 1e-10 * kept[k, 3]:
                fixed[k] = 0
                moved = True
        for k in range(1, N):
            for n in range(rows.shape[0]):
                i = rows[n]
                value = h[k, i] + g[k, i, 0] * dx[k, 0] + g[k, i, 1] * dx[k, 1] + g[k, i, 2] * dx[k, 2]
                if state[k, i] == 1:
                    pull[k, i] += stiff * value
                    if pull[k, i] < 0.0:
                        state[k, i] = 0
                        moved = True
                    elif pull[k, i] > price[i, 0]:
                        state[k, i] = 2
                        moved = True
                    elif abs(value) > 1e-9:
                        moved = True
                elif state[k, i] == 0 and value > 1e-9:
                    # The command before the row is set free to meet it: both held ask too much of the others.
                    state[k, i] = 1
                    pull[k, i] = 0.0
                    fixed[k - 1] = 0
                    moved = True
                elif state[k, i] == 2 and value < -1e-9:
                    state[k, i] = 1
                    pull[k, i] = price[i, 0]
                    fixed[k - 1] = 0
                    moved = True
        if not moved:
            return passed
    return -1


def interior_point(cross, jac, gap, start, Q0, q0, R0, r0, low, high, rows, price, h, g, fixed, bound, work, dx, du,
                   slope, most_iterations, state, pull):
    """The same program by a primal-dual interior point method; the number of iterations, or -1 if they ran out.

    What must stay positive, distances and multipliers alike, is moved by steps of its own, never a difference, so that
    it keeps its digits. Leaves the active set that the answer shows.
    """
    Q, q, kept = work
    N = R0.shape[0]
    m = rows.shape[0]
    R, r = R0.copy(), r0.copy()
    ddx, ddu, no_gap, nowhere = dx.copy(), du.copy(), gap * 0.0, start * 0.0
    # Of commands: distance to the bounds and multipliers; of rows: slack, room, and multipliers of both.
    above, beneath, over, under = R0 * 0.0, R0 * 0.0, R0 * 0.0, R0 * 0.0
    slack, room, force, rest = pull * 0.0, pull * 0.0, pull * 0.0, pull * 0.0
    s_step, f_step, t_step = pull * 0.0, pull * 0.0, pull * 0.0
    unit = R0[0]
    for i in range(3):
        dx[0, i] = start[i]
    for k in range(N):
        width = high[k] - low[k]
        du[k] = min(max(du[k], low[k] + 0.05 * width), high[k] - 0.05 * width)
        above[k], beneath[k] = high[k] - du[k], du[k] - low[k]
        over[k], under[k] = 0.1 * unit / above[k], 0.1 * unit / beneath[k]
        fixed[k] = 0
        for i in range(3):
            dx[k + 1, i] = (jac[k, 4 * i] * dx[k, 0] + jac[k, 4 * i + 1] * dx[k, 1] + jac[k, 4 * i + 2] * dx[k, 2]
                            + jac[k, 4 * i + 3] * du[k] + gap[k, i])
    for k in range(1, N):
        for n in range(m):
            i = rows[n]
            value = h[k, i] + g[k, i, 0] * dx[k, 0] + g[k, i, 1] * dx[k, 1] + g[k, i, 2] * dx[k, 2]
            slack[k, i] = max(value, 0.0) + 0.1
            room[k, i] = slack[k, i] - value
            force[k, i] = 0.5 * (price[i, 0] + 2.0 * price[i, 1] * slack[k, i])
            rest[k, i] = force[k, i]
    pairs = 2.0 * N + 2.0 * m * (N - 1)
    wrong, share = 1.0, 1.0
    for iteration in range(most_iterations):
        mean = 0.0
        for k in range(N):
            mean += over[k] * above[k] + under[k] * beneath[k]
        for k in range(1, N):
            for n in range(m):
                i = rows[n]
                mean += force[k, i] * room[k, i] + rest[k, i] * slack[k, i]
        mean /= pairs
        # Where rounding stops the steps before the aim, a mean product that is small enough is an answer too.
        stuck = (share < 1e-3 or iteration == most_iterations - 1) and mean < 1e-8 * unit
        if (mean < 1e-12 * unit or stuck) and wrong < 1e-10:
            for k in range(N):
                fixed[k] = 1 if over[k] > unit * above[k] else (-1 if under[k] > unit * beneath[k] else 0)
            for k in range(1, N):
                for n in range(m):
                    i = rows[n]
                    exceeded = unit * slack[k, i] > rest[k, i]
                    state[k, i] = 0 if unit * room[k, i] > force[k, i] else (2 if exceeded else 1)
                    pull[k, i] = force[k, i]
            return iteration
        # Short steps mean that some products are far below the others: then what is small is raised first.
        aim = mean * (0.05 if share > 0.9 else (0.3 if share > 0.1 else 2.0))
        copy_cost(Q0, q0, Q, q)
        for k in range(N + 1):
            d0, d1, d2 = dx[k, 0], dx[k, 1], dx[k, 2]
            q[k, 0] += Q0[k, 0] * d0 + Q0[k, 1] * d1 + Q0[k, 2] * d2
            q[k, 1] += Q0[k, 1] * d0 + Q0[k, 3] * d1 + Q0[k, 4] * d2
            q[k, 2] += Q0[k, 2] * d0 + Q0[k, 4] * d1 + Q0[k, 5] * d2
            if k < N:
                q[k, 2] += cross * du[k]
                R[k] = R0[k] + over[k] / above[k] + under[k] / beneath[k]
                r[k] = r0[k] + R0[k] * du[k] + cross * d2 + aim / above[k] - aim / beneath[k]
        for k in range(1, N):
            for n in range(m):
                i = rows[n]
                f, s, t, e = force[k, i], slack[k, i], room[k, i], rest[k, i]
                curve, per = 2.0 * price[i, 1], f / t
                D = e + s * curve + s * per
                r1 = aim / t - f
                add_row(Q, q, k, g[k, i, 0], g[k, i, 1], g[k, i, 2], per * (e + s * curve) / D,
                        f + r1 - per * (aim - e * s + s * r1) / D)
        riccati(cross, jac, no_gap, nowhere, Q, q, R, r, fixed, bound, kept, ddx, ddu, slope)
        share = 1.0
        for k in range(N):
            step = ddu[k]
            o = aim / above[k] - over[k] + over[k] * step / above[k]
            w = aim / beneath[k] - under[k] - under[k] * step / beneath[k]
            for have, change in ((above[k], -step), (beneath[k], step), (over[k], o), (under[k], w)):
                if have + share * change < 0.005 * have:
                    share = -0.995 * have / change
        for k in range(1, N):
            for n in range(m):
                i = rows[n]
                f, s, t, e = force[k, i], slack[k, i], room[k, i], rest[k, i]
                curve, per = 2.0 * price[i, 1], f / t
                r1 = aim / t - f
                move = g[k, i, 0] * ddx[k, 0] + g[k, i, 1] * ddx[k, 1] + g[k, i, 2] * ddx[k, 2]
                ds = (aim - e * s + s * r1 + s * per * move) / (e + s * curve + s * per)
                df = r1 - per * (ds - move)
                s_step[k, i], f_step[k, i], t_step[k, i] = ds, df, ds - move
                for have, change in ((t, ds - move), (s, ds), (f, df), (e, curve * ds - df)):
                    if have + share * change < 0.005 * have:
                        share = -0.995 * have / change
        wrong *= 1.0 - share
        for k in range(N):
            step = ddu[k]
            o = aim / above[k] - over[k] + over[k] * step / above[k]
            w = aim / beneath[k] - under[k] - under[k] * step / beneath[k]
            over[k] += share * o
            under[k] += share * w
            above[k] -= share * step
            beneath[k] += share * step
            du[k] += share * step
            for i in range(3):
                dx[k + 1, i] += share * ddx[k + 1, i]
        for k in range(1, N):
            for n in range(m):
                i = rows[n]
                slack[k, i] += share * s_step[k, i]
                room[k, i] += share * t_step[k, i]
                force[k, i] += share * f_step[k, i]
                rest[k, i] += share * (2.0 * price[i, 1] * s_step[k, i] - f_step[k, i])
    return -1
