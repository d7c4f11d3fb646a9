"""mao2018 once more in plain Python: its train and its laws typed from the paper, without the workbench's expressions.

`run` is the sampled loop, `rates` the continuous closed loop in the first mode for an adaptive integrator.
"""

import math
from dataclasses import dataclass, field

NAMES = ("a", "b", "c", "vartheta", "D")


@dataclass
class Law:
    """A law of sections III to VII; `mended` names the equations whose printed sign is turned."""

    kind: str
    mended: tuple
    p: dict
    state: dict

    def sign(self, z):
        layer = self.p["layer"]
        if layer:
            return z / (abs(z) + layer)
        return 1.0 if z > 0 else -1.0 if z < 0 else 0.0

    def mode(self, t):
        return 1 + sum(t >= self.p[f"T_{k}"] for k in (2, 3, 4))

    def regressors(self, t, v):
        """What multiplies a, b, c, vartheta, D in the mode at t, indicators included."""
        ramp = min(1.0, self.p["psi_rate"] * (t - self.p["T_3"])) if self.mode(t) == 3 else 1.0
        return (1.0, v, v * v, self.p["g"] * ramp, 0.004)

    def errors(self, x, v, desired):
        z_1 = x - desired[0]
        return z_1, v - desired[1] + self.p["r_1"] * z_1

    def slopes(self, t, x, v, desired):
        """Rates of all states, and what the command is made of."""
        p, s, i = self.p, self.state, self.mode(t)
        z_1, z_2 = self.errors(x, v, desired)
        phi = self.regressors(t, v)
        rates = dict.fromkeys(s, 0.0)
        for name, by in zip(NAMES, phi, strict=True):
            rates[f"{name}_hat_{i}"] = -p[f"Gamma_{name}"] * z_2 * by
        zeta = sum(s[f"{name}_hat_{i}"] * by for name, by in zip(NAMES, phi, strict=True))
        eta = z_1 + p["r_1"] * (v - desired[1]) - desired[2]
        wanted = zeta - eta - p["r_2"] * z_2
        damping = -p["k_1"] * z_2 * v**2 - p["k_2"] * z_2 * v**4 if self.kind == "damped" else 0.0
        rates[f"rho_hat_{i}"] = -p["Gamma_m"] * z_2 * (wanted + (damping if "61" in self.mended else -damping))
        if self.kind != "healthy":
            basis = (1.0, math.sin(p["omega"] * t + p["phase"]))
            xi = p["n"] * (s["xi_hat_0"] * basis[0] + s["xi_hat_1"] * basis[1])
            rates["rho_k_hat"] = (1 if "44" in self.mended else -1) * p["Gamma_k"] * z_2 * xi
            rates["xi_hat_0"], rates["xi_hat_1"] = (p["Gamma_xi"] * z_2 * f for f in basis)
        if self.kind == "unknown_bound":
            rates[f"lambda_hat_{i}"] = (1 if "54" in self.mended else -1) * p["Gamma_d"] * z_2 * self.sign(z_2)
        return rates

    def command(self, t, x, v, desired):
        """nu_0, or F of the healthy law, times the motors, per unit of nominal mass."""
        p, s, i = self.p, self.state, self.mode(t)
        z_1, z_2 = self.errors(x, v, desired)
        zeta = sum(s[f"{name}_hat_{i}"] * by for name, by in zip(NAMES, self.regressors(t, v), strict=True))
        eta = z_1 + p["r_1"] * (v - desired[1]) - desired[2]
        bound = s[f"lambda_hat_{i}"] if self.kind == "unknown_bound" else p[f"lambda_0_{i}"]
        force = -bound / p["rho_0"] * self.sign(z_2) + s[f"rho_hat_{i}"] * (zeta - eta - p["r_2"] * z_2)
        if self.kind == "unparameterized":
            force -= p["delta_0"] / p["rho_k0"] * self.sign(z_2)
        if self.kind == "damped":
            force += s[f"rho_hat_{i}"] * (-p["k_1"] * z_2 * v**2 - p["k_2"] * z_2 * v**4)
        if self.kind != "healthy":
            xi = p["n"] * (s["xi_hat_0"] + s["xi_hat_1"] * math.sin(p["omega"] * t + p["phase"]))
            force = p["n"] * (force - s["rho_k_hat"] * xi)
        return force * p["F_unit"] / p["M_0"]

    def step(self, t, x, v, desired, period):
        rates = self.slopes(t, x, v, desired)
        self.state = {name: value + period * rates[name] for name, value in self.state.items()}
        return self.command(t, x, v, desired)


@dataclass
class Train:
    """(1)-(3) with a mode table in SI units, one failed motor of n, a disturbance in N, and uncertain b and c."""

    mass: float
    modes: list  # start, a, b, c, vartheta, D
    motors: int = 16
    ramp_s: float = 4.0
    disturbance: list = field(default_factory=list)  # from, to, offset, amplitude, omega, phase, all in N
    failure: list = field(default_factory=list)
    rest: list = field(default_factory=list)
    drag: tuple = (0.0, 0.0, 0.0)  # amplitudes of Delta b and Delta c, omega

    @staticmethod
    def total(terms, t):
        return sum(c + a * math.sin(w * t + f) for begin, end, c, a, w, f in terms if begin <= t < end)

    def acceleration(self, t, v, u):
        start, a, b, c, vartheta, curve = next(mode for mode in reversed(self.modes) if mode[0] <= t)
        if vartheta:
            vartheta *= min(1.0, (t - start) / self.ramp_s)
        failed = any(begin <= t < end for begin, end, *_ in self.failure)
        force = self.mass * u * (1 - failed / self.motors) + self.total(self.failure, t) + self.total(self.rest, t)
        wave = math.sin(self.drag[2] * t)
        resistance = a + (b + self.drag[0] * wave) * v + (c + self.drag[1] * wave) * v**2
        return (force + self.total(self.disturbance, t)) / self.mass - resistance - 9.81 * vartheta - 0.004 * curve

    def advance(self, t, x, v, u, h):
        """Classical Runge-Kutta; what begins at the end of the step is not seen by it."""
        last = t + h * (1 - 1e-9)
        a1 = self.acceleration(t, v, u)
        a2 = self.acceleration(t + h / 2, v + h / 2 * a1, u)
        a3 = self.acceleration(t + h / 2, v + h / 2 * a2, u)
        a4 = self.acceleration(last, v + h * a3, u)
        return x + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def run(train, law, curve, x, period, steps, every):
    """Columns of every `every`-th sample: t, x, v, u and the law's states."""
    v, columns = 0.0, {}
    for n in range(steps):
        t = n * period
        u = law.step(t, x, v, curve(t), period)
        if n % every == 0:
            for name, value in ({"t_s": t, "s_m": x, "v_mps": v, "u_mps2": u} | law.state).items():
                columns.setdefault(name, []).append(value)
        x, v = train.advance(t, x, v, u, period)
    return columns


def rates(train, law, curve):
    """The closed loop as an ordinary differential equation of x, v and the law's states, in the order of the latter."""
    names = list(law.state)

    def f(t, y):
        law.state = dict(zip(names, y[2:], strict=True))
        desired = curve(t)
        slopes = law.slopes(t, y[0], y[1], desired)
        u = law.command(t, y[0], y[1], desired)
        return [y[1], train.acceleration(t, y[1], u), *(slopes[name] for name in names)]

    return f
