"""A sampled closed loop in plain Python, written without the workbench's compiler: slow, and easy to check.

Every sum over neurons is a Python loop, every expression is evaluated alone (no common subexpressions), and
the train is Newton's law with the Davis equation typed out.
"""

import math
from dataclasses import dataclass

import sympy as sp
from numpy.polynomial import polynomial as poly

from workbench.model.law import MEASUREMENTS, ControlLaw, neuron


def _plain(expr: sp.Expr) -> sp.Expr:
    return expr.xreplace({i: sp.Symbol(str(i.base.label)) for i in expr.atoms(sp.Indexed)})


class _Expression:
    """One expression of a law, evaluated with numbers by name; neurons by name as lists."""

    def __init__(self, expr: sp.Expr) -> None:
        sums = list(expr.atoms(sp.Sum))
        marks = [sp.Symbol(f"sum_{i}") for i in range(len(sums))]
        self.summands = [(str(mark), _Expression(s.function)) for mark, s in zip(marks, sums, strict=True)]
        rest = _plain(expr.xreplace(dict(zip(sums, marks, strict=True))))
        self.names = sorted(str(s) for s in rest.free_symbols if s != neuron)
        self.function = sp.lambdify([sp.Symbol(n) for n in self.names], _rename(rest), modules="math")

    def __call__(self, numbers: dict, neurons: dict, j: int | None = None) -> float:
        here = dict(numbers)
        if j is not None:
            here |= {name: values[j] for name, values in neurons.items()}
        for mark, summand in self.summands:
            count = len(next(iter(neurons.values())))
            here[mark] = math.fsum(summand(numbers, neurons, i) for i in range(count))
        return self.function(*(here[name] for name in self.names))


def _rename(expr: sp.Expr) -> sp.Expr:
    """Symbols without assumptions, so that a name is all that identifies them."""
    return expr.xreplace({s: sp.Symbol(str(s)) for s in expr.free_symbols})


class PlainLaw:
    """A law with its numbers; `step` answers a sample."""

    def __init__(self, law: ControlLaw, values: dict, estimates: str) -> None:
        self.corrected = estimates == "corrected"
        self.parameters = values["parameters"]
        self.scalars = {str(s.symbol): values["initial"][str(s.symbol)] for s in law.scalar_states}
        self.updates = {str(s.symbol): _Expression(self._next(law, s)) for s in law.scalar_states}
        self.neuron_updates = {str(s.symbol.base.label): _Expression(self._next(law, s))
                               for s in law.neuron_states}
        self.command = _Expression(law.command)
        self.neurons, self.data = self._place(law, values)

    @staticmethod
    def _next(law: ControlLaw, state) -> sp.Expr:
        T = MEASUREMENTS[-1]
        return state.update if state.rate is None else state.symbol + T * state.rate

    def _place(self, law: ControlLaw, values: dict) -> tuple[dict, dict]:
        grid = values.get("neurons")
        if not grid:
            return {}, {}
        n, first, last = grid["count"], grid["first_center"], grid["last_center"]
        even = [first + i * (last - first) / (n - 1) for i in range(n)]
        placed = {"c_1": even, "b_h": [grid["width"]] * n}
        others = enumerate(grid["other_centers"], start=2)
        placed |= {f"c_{i}": [center] * n for i, center in others}
        placed |= {name.replace("c_", "c_before_"): v for name, v in placed.items() if name != "b_h"}
        placed["b_before"] = placed["b_h"]
        placed |= {name: [values["initial"][name]] * n for name in self.neuron_updates if name not in placed}
        data = {str(s.base.label) for s in law.neuron_data}
        return ({name: list(placed[name]) for name in self.neuron_updates},
                {name: list(placed[name]) for name in data})

    def step(self, measured: dict) -> float:
        """All next values from the current ones; the command from the next ones, or from the current ones."""
        numbers = self.parameters | self.scalars | measured
        neurons = self.neurons | self.data
        scalars = {name: update(numbers, neurons) for name, update in self.updates.items()}
        moved = {name: [update(numbers, neurons, j) for j in range(len(self.neurons[name]))]
                 for name, update in self.neuron_updates.items()}
        before = self.command(numbers, neurons)
        self.scalars, self.neurons = scalars, moved
        if not self.corrected:
            return before
        return self.command(self.parameters | scalars | measured, moved | self.data)


@dataclass
class PlainTrain:
    """Newton's law with Davis resistance and piecewise-constant line resistance, by classical Runge-Kutta."""

    mass: float
    davis: tuple[float, float, float]  # per unit of mass
    line: list[tuple[float, float]]  # (from position, N per kg)

    def acceleration(self, p: float, v: float, force: float) -> float:
        line = [value for start, value in self.line if p >= start][-1] if p >= 0 else self.line[0][1]
        a, b, c = self.davis
        return force / self.mass - (a + b * v + c * v * v) - line

    def advance(self, p: float, v: float, force: float, h: float) -> tuple[float, float]:
        a1 = self.acceleration(p, v, force)
        v2 = v + h / 2 * a1
        a2 = self.acceleration(p + h / 2 * v, v2, force)
        v3 = v + h / 2 * a2
        a3 = self.acceleration(p + h / 2 * v2, v3, force)
        v4 = v + h * a3
        a4 = self.acceleration(p + h * v3, v4, force)
        return p + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def plain_line(track) -> list[tuple[float, float]]:
    """Resistance by position, from the sections themselves."""
    starts = sorted({s.start_m for layer in (track.grade, track.curve, track.tunnel) for s in layer}
                    | {s.end_m for s in track.tunnel})

    def total(x: float) -> float:
        value = sum(s.grade_permille for s in track.grade if s.start_m <= x < s.end_m)
        value += sum(600 / s.radius_m for s in track.curve if s.start_m <= x < s.end_m)
        return value + sum(s.resistance_n_per_kn for s in track.tunnel if s.start_m <= x < s.end_m)

    return [(x, 9.80665 * total(x) / 1000) for x in starts]


def plain_desired(curve, t: float) -> tuple[float, float, float]:
    """Position, speed and acceleration of a desired curve before its end."""
    k = max(i for i, start in enumerate(curve.breaks_s[:-1]) if t >= start)
    row = curve.coefficients[k]
    return tuple(float(poly.polyval(t - curve.breaks_s[k], poly.polyder(row, n) if n else row))
                 for n in range(3))


def plain_run(scenario, law: ControlLaw, values: dict, estimates: str, period_s: float, steps: int) -> dict:
    """The first `steps` plant steps of a run: columns t, p, v, u, force and each scalar state."""
    dt, train = scenario.simulation.plant_step_s, scenario.train
    curve, per_sample = scenario.desired_curve(), round(period_s / dt)
    plant = PlainTrain(train.mass_kg, (train.davis_a_mps2, train.davis_b_per_s, train.davis_c_per_m),
                       plain_line(scenario.track))
    controller = PlainLaw(law, values, estimates)
    p = v = u = force = 0.0
    columns: dict = {name: [] for name in ("t_s", "s_m", "v_mps", "u_mps2", "force", *controller.scalars)}
    for n in range(steps):
        x_d, v_d, a_d = plain_desired(curve, n * dt)
        if n % per_sample == 0:
            u = controller.step(dict(zip((str(s) for s in MEASUREMENTS), (n * dt, p, v, x_d, v_d, a_d, period_s),
                                         strict=True)))
            force = max(-train.max_braking_n, min(train.max_traction_n, train.mass_kg * u))
        for name, value in ({"t_s": n * dt, "s_m": p, "v_mps": v, "u_mps2": u, "force": force}
                            | controller.scalars).items():
            columns[name].append(value)
        p, v = plant.advance(p, v, force, dt)
    return columns
