"""The trips of chen2019 written again from its text with numpy vectors: (7)-(22) as they stand, A and phi as matrices.

The loop through the acceleration is solved by bisection, and the train is integrated in several steps a sample.
"""

import math

import numpy as np
from scipy.optimize import brentq

STEPS = 3  # of RK4 in a sample


def sat(x, low, high):
    return np.minimum(np.maximum(x, low), high)


def coupled(n):
    """A of (7)."""
    matrix = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    matrix[0, 0] = matrix[-1, -1] = 1
    return matrix


def phi(v):
    return np.concatenate([[v[0] ** 2], np.zeros(len(v) - 1)])


def run(plan):  # noqa: PLR0915 - one trial after the other, from top to bottom
    """Positions, speeds, inputs, Delta u at all samples of the last trial, and the estimates before and after it."""
    g, (m, _, low, high, m_low, m_high) = plan.values, plan.cars
    n, dt, samples = len(m), plan.period_s, len(plan.reference)
    A, one = coupled(n), np.ones(n)
    c1, c2, c3 = g["c_1"], g["c_2"], g["c_3"]
    theta_v, eta, mass = np.zeros((samples, n)), np.zeros((samples, n)), np.tile(m_low, (samples, 1))
    theta_a, theta_k, theta_d = np.zeros(samples), np.zeros(samples), np.zeros(samples)
    for _ in range(plan.trials):
        s, v = plan.reference[0, 0] * one, plan.reference[0, 1] * one
        l1, l2 = plan.start[0] * one, plan.start[1] * one
        a = np.zeros(n)
        history = []
        old = [x.copy() for x in (theta_v, eta, mass, theta_a, theta_k, theta_d)]
        for k in range(samples):
            t, (s_r, v_r, a_r) = k * dt, plan.reference[k]
            factor = 1 + plan.variation["swing"] * math.sin(2 * math.pi * t / plan.variation["beat"])
            c_0, c_v, c_a, c_k, c_d = (g[name] * factor for name in ("c_0", "c_v", "c_a", "c_k", "c_d"))
            where = {"nowhere": 0 * s, "reference": s_r * one, "train": s}[plan.slope]
            slope = plan.slope_values
            f_a = -m * slope["g"] * slope["grade"] * np.sin(2 * math.pi * where / slope["wave"])

            def forces(s, v, f_a=f_a, c_0=c_0, c_v=c_v, c_a=c_a, c_k=c_k, c_d=c_d):  # (7) but for u
                return -c_v * m * v - c_a * m.sum() * phi(v) - c_k * A @ s - c_d * A @ v + f_a - c_0 * m

            alpha = -c1 * (s - s_r)
            alpha_dot = -c1 * (v - v_r)
            z1, z2 = s - s_r - l1, v - v_r - alpha - l2
            steps = (g["gamma_v"] * c3 * z2 * v, g["gamma_eta"] * c3 * z2, None, g["gamma_a"] * c3 * z2 @ phi(v),
                     g["gamma_k"] * c3 * z2 @ A @ s, g["gamma_d"] * c3 * z2 @ A @ v)
            now = [x[k] + step for x, step in zip(old, steps, strict=True) if step is not None]
            def command(a, mass_hat, z1=z1, s=s, v=v, alpha=alpha, alpha_dot=alpha_dot, v_r=v_r, a_r=a_r, hat=now):
                return (-(c2 * (v - v_r - alpha) + a - a_r - alpha_dot + z1) / c3
                        - (hat[0] * v + hat[2] * phi(v) + hat[3] * A @ s + hat[4] * A @ v + hat[1] - mass_hat * a))

            if plan.acceleration == "exact":
                hat_m, used = old[2][k], np.empty(n)
                for j in range(n):
                    def loop(x, j=j, hat_m=hat_m, command=command, forces=forces, s=s, v=v):
                        trial = np.zeros(n)
                        trial[j] = x
                        return m[j] * x - sat(command(trial, hat_m)[j], low[j], high[j]) - forces(s, v)[j]
                    used[j] = brentq(loop, -1e4, 1e4, xtol=1e-15, rtol=1e-15)
                mu = command(used, hat_m)
            else:
                used = a
                hat_m = sat(old[2][k] - g["gamma_M"] * c3 * z2 * used, m_low, m_high)
                mu = command(used, hat_m)
            u = sat(mu, low, high)
            caused = (u + forces(s, v)) / m
            a = a + (1 - math.exp(-dt / g["tau"])) * (caused - a) if plan.acceleration == "filtered" else caused
            row = k - 1 if plan.memory == "next_sample" else k
            if row >= 0:
                theta_v[row], eta[row] = old[0][row] + steps[0], old[1][row] + steps[1]
                mass[row] = sat(old[2][row] - g["gamma_M"] * c3 * z2 * used, m_low, m_high)
                theta_a[row], theta_k[row], theta_d[row] = (old[3][row] + steps[3], old[4][row] + steps[4],
                                                            old[5][row] + steps[5])
            history.append((s, v, u, u - mu))

            def rates(x, u=u, mu=mu, forces=forces):  # (7) and (9)
                s, v, l1, l2 = x
                return np.array([v, (u + forces(s, v)) / m, -c1 * l1 + l2, -c2 * l2 + c3 * (u - mu)])

            x = np.array([s, v, l1, l2])
            h = dt / STEPS
            for _ in range(STEPS):
                k1 = rates(x)
                k2 = rates(x + h / 2 * k1)
                k3 = rates(x + h / 2 * k2)
                x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + rates(x + h * k3))
            s, v, l1, l2 = x
    return *(np.array(x) for x in zip(*history, strict=True)), old, (theta_v, eta, mass, theta_a, theta_k, theta_d)


def energy(plan, estimates):
    """The integrals of (25) over the trip, for constant coefficients and no additional resistance."""
    g, m = plan.values, plan.cars[0]
    theta_v, eta, mass, theta_a, theta_k, theta_d = estimates
    total = (np.sum((theta_v + g["c_v"] * m) ** 2) / g["gamma_v"] + np.sum((theta_a + g["c_a"] * m.sum()) ** 2)
             / g["gamma_a"] + np.sum((theta_k + g["c_k"]) ** 2) / g["gamma_k"]
             + np.sum((theta_d + g["c_d"]) ** 2) / g["gamma_d"] + np.sum((eta + g["c_0"] * m) ** 2) / g["gamma_eta"]
             + np.sum((mass - m) ** 2) / g["gamma_M"])
    return plan.period_s * total / 2
