"""Goals evaluated without the package's checker, printer or derivatives: what the proofs are tested against."""

import mpmath
import numpy as np
import sympy as sp

from workbench.proof.claim import D

SHARE_OF_SPECIAL = 0.3
SPECIAL = np.array([0.0, 1.0, -1.0, 0.5, 2.0])
ROUNDING = 1e-7
ENOUGH_DIGITS, MOST_DIGITS = 400, 4_000  # what is still zero then is zero


class Evaluated:
    """A goal's assumptions and relations as functions of numbers, with every sum written out for n neurons."""

    def __init__(self, goal, neurons=2):
        self.neurons = neurons
        flow = {}
        for moving, rate in goal.flow.items():
            for place in range(1, neurons + 1) if isinstance(moving, sp.Indexed) else (None,):
                at = {moving.indices[0]: sp.Integer(place)} if place else {}
                flow[self._plain(moving.xreplace(at))] = self._plain(rate.xreplace(at))

        def margin(relation):
            difference = self._plain(relation.left - relation.right)
            return self._differentiated(difference, flow), relation.operator

        self.shown = [margin(r) for r in goal.show]
        self.given = [margin(r) for r in (*goal.assume, *goal.always)]
        self.equations = {self._plain(s): self._plain(v) for s, v in goal.initial.items()}
        self.equations |= {r.left: self._plain(r.right) for r in goal.assume
                           if r.operator == "==" and r.left.is_Symbol and not r.right.has(r.left)}
        found = {s for e, _ in (*self.shown, *self.given) for s in e.free_symbols}
        found |= {s for pair in self.equations.items() for e in pair for s in e.free_symbols}
        self.symbols = sorted(found, key=str)
        self.given += [(s, ">") for s in self.symbols if s.is_positive]
        self.given += [(s, ">=") for s in self.symbols if s.is_nonnegative and not s.is_positive]
        self.fast = sp.lambdify(self.symbols, [e for e, _ in (*self.given, *self.shown)], modules="numpy", cse=True)
        self.exact = sp.lambdify(self.symbols, [e for e, _ in (*self.given, *self.shown)], modules="mpmath")

    def _plain(self, expr):
        def written_out(term, limits):
            return sp.Add(*(term.xreplace({limits[0]: sp.Integer(i)}) for i in range(1, self.neurons + 1)))

        expr = sp.sympify(expr).replace(sp.Sum, written_out)
        suffix = (lambda i: "") if self.neurons == 1 else (lambda i: f"__{i}")
        return expr.xreplace({w: sp.Symbol(f"{w.base.label}{suffix(w.indices[0])}", real=True)
                              for w in expr.atoms(sp.Indexed)})

    @staticmethod
    def _differentiated(expr, flow):
        return expr.replace(D, lambda inner: sp.Add(*(sp.diff(inner, s) * rate for s, rate in flow.items())))

    def points(self, rng, count):
        """Random points as columns by symbol, of several magnitudes, that meet every assumption."""
        values = {}
        for symbol in self.symbols:
            drawn = rng.normal(size=count) * 10.0 ** rng.uniform(-1.5, 1.5, size=count)
            drawn = np.where(rng.random(count) < SHARE_OF_SPECIAL, rng.choice(SPECIAL, count), drawn)
            values[symbol] = np.abs(drawn) if symbol.is_nonnegative else drawn
        for _ in self.equations:  # one may stand in the other
            for symbol, expr in self.equations.items():
                names = sorted(expr.free_symbols, key=str)
                with np.errstate(all="ignore"):
                    values[symbol] = np.broadcast_to(sp.lambdify(names, expr, modules="numpy")(
                        *(values[n] for n in names)), count).astype(float)
        columns = [values[s] for s in self.symbols]
        outcomes = self._evaluate(columns, count)
        good = np.ones(count, bool)
        for (_, operator), value in zip(self.given, outcomes, strict=False):
            scale = ROUNDING if operator in ("==",) else 0.0
            good &= np.isfinite(value) & self._holds(operator, value, scale)
        return [c[good] for c in columns], [o[good] for o in outcomes[len(self.given):]]

    def _evaluate(self, columns, count):
        with np.errstate(all="ignore"):
            return [np.broadcast_to(np.asarray(o, float), count) for o in self.fast(*columns)]

    @staticmethod
    def _holds(operator, value, slack):
        return {"==": abs(value) <= slack, "!=": abs(value) > slack, "<=": value <= slack, "<": value < slack,
                ">=": value >= -slack, ">": value > -slack}[operator]

    def holds_at(self, point):
        """(whether all assumptions hold, whether all shown relations hold) at a point, whatever digits that takes.

        A symbol without a value counts as 1: it must not matter.
        """
        given, digits = (*self.given, *self.shown), 50
        numbers = [sp.Rational(str(point.get(str(s), 1))) for s in self.symbols]
        verdicts = [None] * len(given)
        while None in verdicts:
            with mpmath.workdps(digits):
                values = self.exact(*(mpmath.mpf(v.numerator) / v.denominator for v in numbers))
                zero = mpmath.mpf(10) ** (-digits // 2)
                for place, ((_, operator), value) in enumerate(zip(given, values, strict=True)):
                    if abs(value) >= zero or (value == 0 and digits > ENOUGH_DIGITS):
                        verdicts[place] = self._holds(operator, value, 0)
                    elif digits > MOST_DIGITS:
                        verdicts[place] = self._holds(operator, mpmath.mpf(0), 0)
            digits *= 10
        return all(verdicts[:len(self.given)]), all(verdicts[len(self.given):])

    def falsifying_point(self, seed, batches=6, count=8_000):
        """A point that meets the assumptions, where a shown relation is false to 50 digits; or None."""
        rng = np.random.default_rng(seed)
        for _ in range(batches):
            columns, outcomes = self.points(rng, count)
            suspects = np.zeros(len(outcomes[0]), bool)
            for (_, operator), value in zip(self.shown, outcomes, strict=True):
                with np.errstate(invalid="ignore"):
                    suspects |= np.isfinite(value) & ~self._holds(operator, value, 0.0)
            for row in np.flatnonzero(suspects)[:40]:
                point = {str(s): sp.Rational(float(c[row])) for s, c in zip(self.symbols, columns, strict=True)}
                try:
                    for symbol, expr in self.equations.items():
                        point[str(symbol)] = expr.xreplace({s: point[str(s)] for s in expr.free_symbols})
                    assumed, shown = self.holds_at(point)
                except (ZeroDivisionError, TypeError, ValueError):
                    continue
                if assumed and not shown:
                    return point
        return None


def model_breaks(goal, functions, point):
    """Whether functions of time meet what always holds, start where they must and break what is shown, on a grid."""
    time = goal.eventually
    values = {s: sp.sympify(functions[str(s)], locals={str(time): time}) for s in goal.flow if s != time}
    values |= {goal.flow[s]: sp.diff(f, time) for s, f in list(values.items())}
    constants = {s: sp.Rational(str(point.get(str(s), 1))) for s in goal.symbols() if s not in (*values, time)}

    def holds(relation, at):
        value = (relation.left - relation.right).xreplace(values).xreplace(constants).xreplace({time: sp.Rational(at)})
        value = sp.N(value, 50)
        return {"<=": value <= 0, "<": value < 0, ">=": value >= 0, ">": value > 0, "==": value == 0,
                "!=": value != 0}[relation.operator]

    starts = all((values.get(s, s).xreplace(constants).xreplace({time: sp.Integer(0)}) - start.xreplace(constants)
                  ).equals(0) for s, start in goal.initial.items())
    grid = ("0", "1/3", "2", "17", "40")
    signs = all(constants[s] > 0 if s.is_positive else constants[s] >= 0 for s in constants if s.is_nonnegative)
    return bool(starts and signs and all(holds(r, "0") for r in goal.assume)
                and all(holds(r, at) for at in grid for r in goal.always)
                and all(not all(holds(r, at) for r in goal.show) for at in grid))
