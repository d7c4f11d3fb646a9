"""liu2020's laws and train typed a second time, in plain Python."""

import math

from proofs.liu2020.simulation.trip import centers, scales

G = 9.80665


class Plain:
    """(9), (12), (17)-(23), (30)-(35) typed a second time, neuron by neuron, with Euler steps of the laws."""

    def __init__(self, study, column, leak=-1, learn=1, by_rate=False, learning=True, differenced=False):
        self.k = [getattr(study.gains, f"k_{i}")[column - 1] for i in range(1, 6)]
        self.a, self.by_rate, self.leak, self.learn = study.adaptation, by_rate, leak, learn
        self.learning, self.differenced, self.T = learning, differenced, study.sampling.period_s
        self.tau, self.width, self.scale = study.sampling.speed_filter_s, study.networks.width, scales(study)
        self.c = centers(study)
        n = self.c.shape[1]
        self.Wf, self.Wv = [0.0] * n, [0.0] * n
        self.s_hat = self.v_hat = self.xi = self.delta = self.theta = self.u = self.s_before = self.v_before = 0.0

    def hidden(self, inputs, rows):
        return [math.exp(-sum((z - self.c[row][j]) ** 2 for z, row in zip(inputs, rows, strict=True)) / self.width**2)
                for j in range(self.c.shape[1])]

    def step(self, s, v, s_d, v_d, a_d):
        """The input in N at this sample; then the states move on."""
        k1, k2, k3, k4, k5 = self.k
        a, T, L, V, A, U = self.a, self.T, *(self.scale[f"{x}_scale"] for x in "svau")
        known = v
        if self.differenced:
            raw = (s - self.s_before) / T
            known = self.v_before + T / (self.tau + T) * (raw - self.v_before)
        if self.by_rate:  # of the integrated xi = v_hat + k3 s_tilde
            self.v_hat = self.xi - k3 * (self.s_hat - s)
        s_err, v_err = self.s_hat - s, self.v_hat - known
        e_v = k4 * (s_d - self.s_hat) + v_d - self.v_hat
        hf = self.hidden((self.s_hat / L, self.v_hat / V, self.u / U), (0, 1, 2))
        hv = self.hidden((s / L, known / V, self.v_hat / V, s_d / L, v_d / V, a_d / A), range(3, 9))
        f_hat, D1, u = 0.0, 0.0, k5 * e_v
        if self.learning:
            f_hat = sum(w * h for w, h in zip(self.Wf, hf, strict=True))
            D1 = -math.tanh(v_err / a.kappa_1_mps) * self.delta
            u += sum(w * h for w, h in zip(self.Wv, hv, strict=True)) + math.tanh(e_v / a.kappa_2_mps) * self.theta
        self.recorded = (s_err, self.v_hat - v)
        rate = self.leak * a.leak_rate_per_s
        self.Wf = [w + T * (-a.gamma_f_per_s2 * h * v_err + rate * w) for w, h in zip(self.Wf, hf, strict=True)]
        self.Wv = [w + T * (a.gamma_v_n_per_m * self.learn * h * e_v + rate * w)
                   for w, h in zip(self.Wv, hv, strict=True)]
        self.delta += T * (a.alpha_1_per_s2 * math.tanh(v_err / a.kappa_1_mps) * v_err + rate * self.delta)
        self.theta += T * (a.alpha_2_n_per_m * math.tanh(e_v / a.kappa_2_mps) * e_v + rate * self.theta)
        self.s_hat += T * (self.v_hat - k1 * s_err)
        self.xi += T * (f_hat - k2 * s_err + D1)
        self.v_hat += T * (f_hat - k2 * s_err - k3 * v_err + D1)
        self.u, self.s_before, self.v_before = u, s, known
        return u


def plain_acceleration(u, s, v, t):
    """(9) with (61) in N/kN and km/h, a slope of 1 % from 5 to 7 km, and (70)."""
    M, chi, kmh = 890000.0, 0.9, 3.6 * v
    resistance = M * G / 1000 * (0.53 + 0.00388 * kmh + 0.000114 * kmh**2)
    if 5000 <= s < 7000:
        resistance += M * G * math.sin(math.atan(0.01))
    return chi / M * u - chi / M * resistance + 1e5 / M * (math.sin(0.08 * t) + math.cos(0.08 * t))


def runge_kutta(f, s, v, t, h):
    a1 = f(s, v, t)
    a2 = f(s + h / 2 * v, v + h / 2 * a1, t + h / 2)
    a3 = f(s + h / 2 * (v + h / 2 * a1), v + h / 2 * a2, t + h / 2)
    a4 = f(s + h * (v + h / 2 * a2), v + h * a3, t + h)
    return (s + h / 6 * (v + 2 * (v + h / 2 * a1) + 2 * (v + h / 2 * a2) + v + h * a3),
            v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4))


PLAIN = {
    "feedback": {"learning": False},
    "feedback_rate": {"learning": False, "by_rate": True},
    "corrected": {},
    "printed": {"leak": 1, "learn": -1},
    "wrong_leakage": {"leak": 1},
    "wrong_learning": {"learn": -1},
    "corrected_rate": {"by_rate": True},
    "printed_rate": {"leak": 1, "learn": -1, "by_rate": True},
    "position_only": {"by_rate": True, "differenced": True},
    "position_only_speed": {"differenced": True},
}
