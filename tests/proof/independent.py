"""Goals evaluated without the package's checker, printer or derivatives: what the proofs are tested against.

Deciders never see this file, and it takes nothing from them: sampling, tight points, local search and exact
evaluation are its own.
"""

import math
from functools import cached_property, reduce

import mpmath
import numpy as np
import sympy as sp

from workbench.proof.claim import D, Goal, Relation

SHARE_OF_SPECIAL = 0.3
CLEAR = {"==": 1e-9, "<=": 1e-9, ">=": 1e-9, "<": -1e-12, ">": -1e-12, "!=": 1e-12}  # a failure not of rounding alone
SPECIAL = np.array([0.0, 1.0, -1.0, 0.5, 2.0])
ROUNDING = 1e-7
ENOUGH_DIGITS, MOST_DIGITS = 400, 4_000  # what is still zero then is zero
DECIDING, SOME = 500, 4


def rebuilt(expr):
    """A term kept as typed, as sympy builds it: lambdify writes the power -1 of 1/100 as 1/1/100, which is 1/100."""
    return expr.func(*map(rebuilt, expr.args)) if expr.args else expr


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
        # What stands under D must be defined too: D(log(-x)) says nothing, though its derivative is a number.
        logs = {self._plain(log.args[0]) for r in (*goal.show, *goal.assume, *goal.always)
                for side in (r.left, r.right) for d in side.atoms(D) for log in d.atoms(sp.log)}
        self.given = [margin(r) for r in (*goal.assume, *goal.always)] + [(a, ">") for a in sorted(logs, key=str)]
        self.equations = {self._plain(s): self._plain(v) for s, v in goal.initial.items()}
        self.equations |= {r.left: self._plain(r.right) for r in goal.assume
                           if r.operator == "==" and r.left.is_Symbol and not r.right.has(r.left)}
        found = {s for e, _ in (*self.shown, *self.given) for s in e.free_symbols}
        found |= {s for pair in self.equations.items() for e in pair for s in e.free_symbols}
        self.symbols = sorted(found, key=str)
        self.given += [(s, ">") for s in self.symbols if s.is_positive]
        self.given += [(s, ">=") for s in self.symbols if s.is_nonnegative and not s.is_positive]
        self._tight, self._functions = None, {}

    @cached_property
    def fast(self):
        """The differences of all relations as numpy computes them."""
        return sp.lambdify(self.symbols, [e for e, _ in (*self.given, *self.shown)], modules="numpy", cse=True)

    @cached_property
    def exact(self):
        """The difference of each relation as mpmath computes it, to the digits in force."""
        return [sp.lambdify(self.symbols, e, modules="mpmath", cse=True) for e, _ in (*self.given, *self.shown)]

    def _plain(self, expr):
        def written_out(term, limits):
            return sp.Add(*(term.xreplace({limits[0]: sp.Integer(i)}) for i in range(1, self.neurons + 1)))

        expr = rebuilt(sp.sympify(expr)).replace(sp.Sum, written_out)
        suffix = (lambda i: "") if self.neurons == 1 else (lambda i: f"__{i}")
        return expr.xreplace({w: sp.Symbol(f"{w.base.label}{suffix(w.indices[0])}", real=True)
                              for w in expr.atoms(sp.Indexed)})

    @staticmethod
    def _differentiated(expr, flow):
        return expr.replace(D, lambda inner: sp.Add(*(sp.diff(inner, s) * rate for s, rate in flow.items())))

    def points(self, rng, count):
        """Random points as columns by symbol, of several magnitudes, that meet every assumption."""
        columns, outcomes, good = self._settled(self._drawn(rng, count), self.equations, count)
        return [c[good] for c in columns], [o[good] for o in outcomes]

    def _drawn(self, rng, count):
        values = {}
        for symbol in self.symbols:
            drawn = rng.normal(size=count) * 10.0 ** rng.uniform(-1.5, 1.5, size=count)
            drawn = np.where(rng.random(count) < SHARE_OF_SPECIAL, rng.choice(SPECIAL, count), drawn)
            values[symbol] = np.abs(drawn) if symbol.is_nonnegative else drawn
        return values

    def _settled(self, values, equations, count):
        """(columns, values of what is shown, where all assumptions hold), after the equations are put in."""
        for _ in equations:  # one may stand in the other
            for symbol, expr in equations.items():
                names, function = self._compiled(expr)
                with np.errstate(all="ignore"):
                    values[symbol] = np.broadcast_to(function(*(values[n] for n in names)), count).astype(float)
        columns = [values[s] for s in self.symbols]
        outcomes = self._evaluate(columns, count)
        good = np.ones(count, bool)
        for (_, operator), value in zip(self.given, outcomes, strict=False):
            scale = ROUNDING if operator in ("==",) else 1e-12 if equations is not self.equations else 0.0
            good &= np.isfinite(value) & self._holds(operator, value, scale)
        return columns, outcomes[len(self.given):], good

    def _compiled(self, expr):
        if expr not in self._functions:
            names = sorted(expr.free_symbols, key=str)
            self._functions[expr] = names, sp.lambdify(names, expr, modules="numpy")
        return self._functions[expr]

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
        return self._assumed_at(point), self._shown_at(point)

    def _assumed_at(self, point):
        return self._all_hold(point, range(len(self.given)))

    def _shown_at(self, point, most=math.inf):
        return self._all_hold(point, range(len(self.given), len(self.given) + len(self.shown)), most)

    def _all_hold(self, point, places, most=math.inf):
        """Whether the relations of these places hold; those that few digits settle first, and the rest only where none
        of them has failed, for digits are what takes time. None where `most` digits do not tell."""
        numbers = [sp.Rational(str(point.get(str(s), 1))) for s in self.symbols]
        digits, open_ones = 50, list(places)
        while open_ones:
            if digits > most:
                return None
            verdicts = [self._at_digits(place, numbers, digits) for place in open_ones]
            if False in verdicts:
                return False
            open_ones = [place for place, verdict in zip(open_ones, verdicts, strict=True) if verdict is None]
            digits *= 10
        return True

    def _at_digits(self, place, numbers, digits):
        """Whether one relation holds, as so many digits tell; None where they do not."""
        operator = (*self.given, *self.shown)[place][1]

        def value_with(digits):
            with mpmath.workdps(digits):
                return self.exact[place](*(mpmath.mpf(v.numerator) / v.denominator for v in numbers))

        value, zero = value_with(digits), mpmath.mpf(10) ** (-digits // 2)
        with mpmath.workdps(digits + 60):  # what is only rounding, however large, is another number here
            settled = abs(value) >= zero and abs(value - value_with(digits + 60)) <= abs(value) / 1000
            if settled or (value == 0 and digits > ENOUGH_DIGITS):
                return bool(self._holds(operator, value, 0))
            return bool(self._holds(operator, mpmath.mpf(0), 0)) if digits > MOST_DIGITS else None

    def falsifying_point(self, seed, batches=6, count=8_000, tight=0):
        """A point that meets the assumptions, where a shown relation is false to 50 digits; or None.

        `tight` more batches put points where two symbols agree, or a relation of the goal is an equality,
        and go downhill from there.
        """
        rng = np.random.default_rng(seed)
        for batch in range(batches + tight):
            equations, size = self.equations, count
            if batch >= batches:
                size = max(count // 8, 200)
                equations = self._tied(rng)
            values = self._drawn(rng, size)
            if batch >= batches and batch % 2:
                values = self._downhill(values, equations, size, rng)
            columns, outcomes, good = self._settled(values, equations, size)
            found = self._confirmed(columns, outcomes, good, equations, 40 if batch < batches else 8)
            if found is not None:
                return found
        return None

    def doubtful(self, outcomes):
        """The rows where the values of what is shown do not clearly hold as floats, as rounding alone may do, the
        farthest off first."""
        suspects, worst = self._suspects(outcomes)
        rows = np.flatnonzero(suspects)
        return rows[np.argsort(-worst[rows], kind="stable")]

    def _suspects(self, outcomes):
        """(where a shown relation fails as a float, by how much the worst one does)."""
        suspects, worst = np.zeros(len(outcomes[0]), bool), np.full(len(outcomes[0]), -np.inf)
        for (_, operator), value in zip(self.shown, outcomes, strict=True):
            with np.errstate(invalid="ignore"):
                suspects |= np.isfinite(value) & ~self._holds(operator, value, CLEAR[operator])
                worst = np.maximum(worst, np.nan_to_num(self._excess(operator, value), nan=-np.inf))
        return suspects, worst

    def _confirmed(self, columns, outcomes, good, equations, most):
        """The first of so many rows, the farthest off first, that is false to any digits. What is an identity is zero
        at each of them: after SOME of these, a row counts only if it fails within DECIDING digits."""
        suspects, worst = self._suspects(outcomes)
        rows, undecided = np.flatnonzero(suspects & good), 0
        for row in rows[np.argsort(-worst[rows], kind="stable")][:most]:
            point = {str(s): sp.Rational(float(c[row])) for s, c in zip(self.symbols, columns, strict=True)}
            try:
                for _ in equations:
                    for symbol, expr in equations.items():
                        point[str(symbol)] = expr.xreplace({s: point[str(s)] for s in expr.free_symbols})
                if not self._assumed_at(point):
                    continue
                shown = self._shown_at(point, DECIDING)
                if shown is None and undecided < SOME:
                    shown, undecided = self._shown_at(point), undecided + 1
            except (ZeroDivisionError, TypeError, ValueError):
                continue
            if shown is False:
                return point
        return None

    @staticmethod
    def _excess(operator, value):
        """By how much a relation fails (negative: holds)."""
        return {"==": abs(value), "!=": -abs(value)}.get(operator, value if operator in ("<", "<=") else -value)

    def _tied(self, rng):
        """The goal's equations, and one or two more that hold on a border or where symbols agree."""
        if self._tight is None:
            self._tight = list(self._borders())
        fixed = dict(self.equations)
        for _ in range(int(rng.integers(1, 4))):
            if self._tight:
                symbol, expr = self._tight[int(rng.integers(len(self._tight)))]
                used = {s for e in fixed.values() for s in e.free_symbols} | fixed.keys()
                if symbol not in used and not expr.free_symbols & fixed.keys():
                    fixed[symbol] = expr
        return fixed

    def _borders(self):
        """(symbol, expression) that make a relation an equality, where it is linear in the symbol; x = y; x = 0."""
        for expr, operator in (*self.given, *self.shown):
            for symbol in sorted(expr.free_symbols, key=str):
                slope = sp.diff(expr, symbol)
                if operator != "!=" and not slope.has(symbol) and slope != 0:
                    yield symbol, -expr.xreplace({symbol: sp.Integer(0)}) / slope
        for one in self.symbols:
            for other in self.symbols:
                if one != other:
                    yield from ((one, other), (one, -other))
            yield from ((one, sp.Integer(0)), (one, sp.Integer(1)))

    def _downhill(self, values, equations, count, rng, steps=25):
        """Random steps that are kept where they bring a shown relation nearer to failing."""
        def height(trial):
            _, outcomes, good = self._settled(dict(trial), equations, count)
            excess = [np.nan_to_num(self._excess(o, v), nan=-np.inf) for (_, o), v in zip(
                self.shown, outcomes, strict=True)]
            return np.where(good, reduce(np.maximum, excess), -np.inf)

        best = height(values)
        for _ in range(steps):
            moved = {}
            for symbol, column in values.items():
                step = 1 + rng.normal(size=count) * 10.0 ** rng.uniform(-3, 0, size=count)
                moved[symbol] = np.where(rng.random(count) < 0.5, column * step, column)
                if symbol.is_nonnegative:
                    moved[symbol] = np.abs(moved[symbol])
            reached = height(moved)
            better = reached > best
            best = np.where(better, reached, best)
            values = {s: np.where(better, moved[s], c) for s, c in values.items()}
        return values


def model_breaks(goal, functions, point):
    """Whether functions of time meet what always holds, start where they must and break what is shown, on a grid."""
    time = goal.eventually
    words = {str(s): s for s in (*goal.symbols(), time)}
    values = {s: sp.sympify(functions[str(s)], locals=words) for s in goal.flow if s != time}
    values |= {goal.flow[s]: sp.diff(f, time) for s, f in list(values.items())}
    constants = {s: sp.Rational(str(point.get(str(s), 1))) for s in goal.symbols() if s not in (*values, time)}

    def holds(relation, at):
        value = (relation.left - relation.right).xreplace(values).xreplace(constants).xreplace({time: sp.Rational(at)})
        value = sp.N(value, 50)
        return {"<=": value <= 0, "<": value < 0, ">=": value >= 0, ">": value > 0, "==": abs(value) < 1e-30,
                "!=": abs(value) > 1e-30}[relation.operator]  # log 3 and the like have no end

    starts = all((values.get(s, s).xreplace(constants).xreplace({time: sp.Integer(0)}) - start.xreplace(constants)
                  ).equals(0) for s, start in goal.initial.items())
    grid = ("0", "1/3", "2", "17", "40")
    signs = all(constants[s] > 0 if s.is_positive else constants[s] >= 0 for s in constants if s.is_nonnegative)
    return bool(starts and signs and all(holds(r, "0") for r in goal.assume)
                and all(holds(r, at) for at in grid for r in goal.always)
                and all(not all(holds(r, at) for r in goal.show) for at in grid))


def path_obeys(goal, certificate):
    """Whether the path of a certificate obeys the flow from its initial values, meets its point, and keeps what always
    holds on a grid of times."""
    time = sp.Symbol(certificate["time"], real=True)
    values = {s: sp.Rational(str(certificate["point"].get(str(s), 1))) for s in (*goal.symbols(), *goal.flow)}
    ends = {s: sp.sympify(certificate["path"][str(s)], locals={str(time): time}) for s in values
            if str(s) in certificate["path"]}
    on_path = values | ends
    duration = sp.Rational(certificate["duration"])
    obeys = all(sp.expand(sp.diff(on_path[s], time) - rate.xreplace(on_path)) == 0
                and on_path[s].xreplace({time: sp.Integer(0)}) == goal.initial[s].xreplace(values)
                for s, rate in goal.flow.items())
    meets = all(f.xreplace({time: duration}) == values[s] for s, f in ends.items())
    nothing = Relation(sp.Integer(0), "==", sp.Integer(0))
    evaluated = Evaluated(Goal(goal.always or (nothing,), flow=goal.flow), neurons=1)
    return bool(obeys and meets and duration >= 0 and all(
        evaluated.holds_at({str(s): sp.sympify(f).xreplace({time: at}) for s, f in on_path.items()})[1]
        for at in (sp.Integer(0), duration / 3, duration, 7 * duration, sp.Integer(1000))))
