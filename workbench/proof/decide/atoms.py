"""The atoms of a goal: its symbols, and what stands for logarithms, exponentials, roots, absolute values, signs."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction

import sympy as sp

from workbench.errors import ClaimError
from workbench.proof.decide.vanishing import vanishes
from workbench.proof.derive import SUM, Side, Size, Summed, expand_derivatives, formal_sums, unfold
from workbench.proof.text import text
from workbench.proof.typed import as_typed

Item = dict[str, object]


@dataclass
class Atoms:
    """The generators of one goal; `positive` maps a generator to the factor items of it and of its inverse."""

    generators: list[sp.Symbol] = field(default_factory=list)
    positive: dict[sp.Symbol, tuple[Item, Item | None]] = field(default_factory=dict)
    nonnegative: dict[sp.Symbol, Item] = field(default_factory=dict)
    logs: dict[sp.Expr, sp.Symbol] = field(default_factory=dict)
    exps: dict[sp.Expr, sp.Symbol] = field(default_factory=dict)
    squares: dict[sp.Symbol, tuple[sp.Expr, Item]] = field(default_factory=dict)  # abs or root: itself, its fact
    sides: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    circles: dict[sp.Expr, tuple[sp.Symbol, sp.Symbol]] = field(default_factory=dict)  # by angle its sine and cosine
    arctans: dict[sp.Symbol, tuple[sp.Expr, sp.Expr]] = field(default_factory=dict)  # the argument, flat and as stated
    inverses: dict[sp.Symbol, sp.Expr] = field(default_factory=dict)
    strict: list[tuple[sp.Expr, int]] = field(default_factory=list)
    indexed: set[sp.Symbol] = field(default_factory=set)
    expanded: dict[sp.Symbol, dict[tuple[int, ...], Fraction]] = field(default_factory=dict)  # of inverses
    places: dict[sp.Symbol, int] = field(default_factory=dict)  # of generators
    known_meanings: tuple[tuple[int, ...], dict[sp.Symbol, sp.Expr]] = ((), {})

    def meanings(self) -> dict[sp.Symbol, sp.Expr]:
        """What the generators for functions and inverses stand for."""
        state = tuple(map(len, (self.squares, self.sides, self.circles, self.arctans, self.exps, self.logs,
                                self.inverses)))
        if self.known_meanings[0] != state:
            self.known_meanings = state, self._meanings()
        return self.known_meanings[1]

    def _meanings(self) -> dict[sp.Symbol, sp.Expr]:
        functions: dict[sp.Symbol, sp.Expr] = {s: itself for s, (itself, _) in self.squares.items()} | self.sides
        functions |= {s: sp.atan(stated, evaluate=False) for s, (_, stated) in self.arctans.items()}
        for angle, (sine, cosine) in self.circles.items():
            stated = angle.xreplace(functions)  # not evaluated: sympy knows sin(arctan x) as a root
            functions |= {sine: sp.sin(stated, evaluate=False), cosine: sp.cos(stated, evaluate=False)}
        functions |= {s: sp.exp(a.xreplace(functions)) for a, s in self.exps.items()}
        functions |= {s: sp.log(a.xreplace(functions)) for a, s in self.logs.items()}
        return functions | {s: 1 / self._put_in(known, functions) for s, known in self.inverses.items()}

    def stated(self, flat: sp.Expr) -> sp.Expr:
        """What an expression of atoms stands for. A power of an exponential stays one: to the checker exp(2 x), which
        sympy makes of it, is another function than exp(x)."""
        return self._put_in(flat, self.meanings())

    def _put_in(self, flat: sp.Expr, meanings: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
        exponentials = set(self.exps.values())
        if any(power.base in exponentials and power.exp not in (1, -1) for power in flat.atoms(sp.Pow)):
            with as_typed():
                return flat.xreplace(meanings)
        return flat.xreplace(meanings)

    def index(self, generator: sp.Symbol) -> int:
        """The generator's position, added when new."""
        if generator not in self.places:
            self.places[generator] = len(self.generators)
            self.generators.append(generator)
        return self.places[generator]


def flatten(expr: sp.Expr, atoms: Atoms, flow: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    """The expression as a rational function of plain symbols; functions become atoms."""
    flat = formal_sums(unfold(expand_derivatives(expr, flow)))
    names = {i: sp.Symbol(str(i.base.label), real=True) for i in flat.atoms(sp.Indexed)}
    atoms.indexed |= set(names.values())
    flat = flat.xreplace(names)
    flat = flat.replace(lambda e: isinstance(e, (Size, Side)) or (e.is_Pow and not e.exp.is_Integer),
                        lambda e: square_atom(e, atoms))
    flat = flat.xreplace({sp.pi: 4 * sp.atan(1, evaluate=False)})
    flat = flat.replace(lambda e: isinstance(e, (sp.sin, sp.cos, sp.atan)), lambda e: angle_atom(e, atoms))
    flat = flat.xreplace({sp.E: sp.exp(1, evaluate=False)}).replace(sp.exp, lambda inner: exp_atom(inner, atoms))
    if flat.has(sp.exp):  # sympy makes a product of exp(x - log(1 + exp(x))) as its inside is replaced
        flat = flat.replace(sp.exp, lambda inner: exp_atom(inner, atoms))
    return flat.replace(sp.log, lambda inner: log_atom(inner, atoms))


def square_atom(itself: sp.Expr, atoms: Atoms) -> sp.Expr:
    """abs, sign or a half power as an atom; what the squares of abs and sqrt are is a fact of the checker."""
    itself = formal_sums(itself.xreplace(atoms.meanings()))
    inner = itself.args[0]
    if isinstance(itself, Side):
        for symbol, known in atoms.sides.items():
            for turn in (1, -1):
                if vanishes(known.args[0] - turn * inner):
                    return turn * symbol
        symbol = sp.Dummy(f"S{len(atoms.sides)}", real=True)
        atoms.sides[symbol] = itself
        return symbol
    size = isinstance(itself, Size)
    power = 1 if size else 2 * itself.exp
    for symbol, (known, _) in atoms.squares.items():
        turns = (1, -1) if size else (1,)
        before = formal_sums(known.args[0])
        if isinstance(known, Size) == size and any(vanishes(before - t * inner) for t in turns):
            return symbol**power
    symbol = sp.Dummy(f"R{len(atoms.squares)}", nonnegative=True)
    name, argument = "abs" if size else "sqrt", text(_with_sums(inner))
    meaning = itself if size else sp.sqrt(_with_sums(inner))
    atoms.squares[symbol] = (meaning, {"fact": f"{name}_square", "of": argument})
    atoms.nonnegative[symbol] = {"fact": f"{name}_nonnegative", "of": argument}
    if not size and inner.is_Add and _plainly_positive(inner, atoms):
        atoms.positive[symbol] = {"fact": "sqrt_positive", "of": argument}, {"positive": text(1 / meaning)}
    return symbol**power


def _plainly_positive(inner: sp.Expr, atoms: Atoms) -> bool:
    """Whether an expression is a positive number, or symbol, plus even powers and products of what has its sign."""
    strict = False
    for term in sp.Add.make_args(sp.expand(inner)):
        number, powers = term.as_coeff_Mul()
        bases = [(base, power) for base, power in powers.as_powers_dict().items() if base != 1]
        if number < 0 or not all(base.is_Symbol and base != SUM and power.is_Integer and power > 0 and (
                power % 2 == 0 or base in atoms.positive or base in atoms.nonnegative) for base, power in bases):
            return False
        strict |= all(base in atoms.positive for base, _ in bases)
    return strict


def _with_sums(flat: sp.Expr) -> sp.Expr:
    """The expression with its SUM * term as a sum that certificates can state."""
    if not flat.has(SUM):
        return flat
    term = sp.expand(flat).coeff(SUM)
    return sp.expand(flat - SUM * term) + Summed(term)


def angle_atom(itself: sp.Expr, atoms: Atoms) -> sp.Expr:
    """sin, cos or arctan of an argument as an atom: cos is even, the others are odd; ClaimError where exp or log stands
    in it."""
    angle, sine = itself.args[0], isinstance(itself, sp.sin)
    if angle.has(sp.exp, sp.log):
        raise ClaimError(f"{itself} cannot be decided here: give the argument a letter of its own")
    if isinstance(itself, sp.atan):
        for symbol, (known, _) in atoms.arctans.items():
            for turn in (1, -1):
                if vanishes(known - turn * angle):
                    return turn * symbol
        symbol = sp.Dummy(f"A{len(atoms.arctans)}", real=True)
        atoms.arctans[symbol] = angle, angle.xreplace(atoms.meanings())
        return symbol
    for known, (s, c) in atoms.circles.items():
        for turn in (1, -1):
            if vanishes(known - turn * angle):
                return turn * s if sine else c
    place = len(atoms.circles)
    atoms.circles[angle] = sp.Dummy(f"s{place}", real=True), sp.Dummy(f"c{place}", real=True)
    return atoms.circles[angle][0 if sine else 1]


def log_atom(argument: sp.Expr, atoms: Atoms) -> sp.Expr:
    """log(argument) as an atom, up to sign: log(1/A) = -log(A)."""
    for known, symbol in atoms.logs.items():
        if vanishes(known - argument):
            return symbol
        if vanishes(known * argument - 1):
            return -symbol
    symbol = sp.Dummy(f"L{len(atoms.logs)}", real=True)
    atoms.logs[argument] = symbol
    return symbol


def exp_atom(argument: sp.Expr, atoms: Atoms) -> sp.Expr:
    """exp(argument) with whole multiples of logarithms pulled out: exp(x + c log A) = exp(x) A**c."""
    factor, rest = sp.Integer(1), sp.Integer(0)
    for term in sp.Add.make_args(sp.expand(argument, log=False)):
        coefficient, inner = term.as_independent(sp.log, as_Add=False)
        if isinstance(inner, sp.log) and coefficient.is_Integer:
            factor *= inner.args[0] ** coefficient
        else:
            rest += term
    if rest == 0:
        return factor
    shift, moving = rest.as_independent(*rest.free_symbols, as_Add=True)
    if moving != 0 and shift.is_Rational and shift != 0:
        return factor * exp_atom(shift, atoms) * exp_atom(moving, atoms)
    for known, symbol in atoms.exps.items():
        if vanishes(known - rest):
            return factor * symbol
        if vanishes(known + rest):
            return factor / symbol
    symbol = sp.Dummy(f"E{len(atoms.exps)}", positive=True)
    atoms.exps[rest] = symbol
    plain = rest.xreplace(atoms.meanings())
    atoms.positive[symbol] = ({"fact": "exp_positive", "of": text(plain)},
                              {"fact": "exp_positive", "of": text(-plain)})
    return factor * symbol
