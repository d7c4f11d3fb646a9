"""From a semidefinite program's numbers to an exact sum of squares.

A fixed ladder of denominators is climbed until the rounded Gram matrices are positive semidefinite, exactly.

Those that must be singular (equality is attained) cannot be rounded as they stand. Then the numbers are first
refined to a solution Q = L L^T of that rank, whose kernel is read off as rational vectors; the basis is replaced
by that of the kernel's complement, in which positive definite Gram matrices are sought again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import sympy as sp
from sympy.polys.matrices import DomainMatrix

from workbench.proof.decide.conic import Vector, centre, grams, lean, refined
from workbench.proof.decide.gram import Block, Program
from workbench.proof.decide.situation import Polynomial

DENOMINATORS = (1, 2, 3, 4, 6, 8, 12, 24, 60, 120, 360, 10**3, 10**4, 10**5, 10**6, 10**8, 10**10)
RANK_CUTS = (1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
INSIDE, OUTSIDE, NEEDED = 1e-9, 1e-5, 1e-5
LARGEST, SURE, GUESSED = 300_000, 1e-3, 1e-2
MOST_SOLVED, FEW, MANY = 8, 3, 400

Rows = list[list[Fraction]]


@dataclass(frozen=True)
class Square:
    """weight * coefficient * root^2, or weight * coefficient alone where the weight is strict."""

    block: Block
    coefficient: Fraction
    root: Polynomial


@dataclass(frozen=True)
class Solution:
    """The squares that add up to the target, with a factor for every multiple of an equality."""

    squares: list[Square]
    factors: list[Fraction]


def solve(program: Program, strict: bool, kernels: Callable[[Block], Rows]) -> Solution | None:
    """An exact solution of a program, with a positive strict weight if one is asked for, or None.

    kernels gives vectors that a block's Gram matrix is known to map to zero.
    """
    solution = _solve(program, strict, kernels)
    if solution is None or len(solution.squares) <= FEW or len(program.columns) > MANY:
        return solution
    smaller = _without_spare(program)
    lighter = _solve(smaller, strict, kernels) if smaller is not None else None
    return lighter if lighter is not None and len(lighter.squares) < len(solution.squares) else solution


def _solve(program: Program, strict: bool, kernels: Callable[[Block], Rows]) -> Solution | None:
    """The same, with all that the program has; programs of lower rank are tried depth first, the likeliest before."""
    open_programs, solved = [iter((program,))], 0
    while open_programs and solved < MOST_SOLVED:
        current = next(open_programs[-1], None)
        if current is None:
            open_programs.pop()
        elif not strict or any(b.weight.strict for b in current.blocks):
            solved += 1
            values, margin = centre(current)
            if values is not None and margin >= -OUTSIDE:
                solution = _rounded(current, values, margin > INSIDE, strict)
                if solution is not None:
                    return solution
                open_programs.append(_restrictions(current, values, kernels))
    return None


def _without_spare(program: Program) -> Program | None:
    """The program without the basis monomials that a solution can do without, or None where there are none."""
    values = lean(program)
    if values is None:
        return None
    found = grams(program, values)
    size = max((float(np.abs(q).max()) for q in found), default=0.0)
    blocks = [Block(block.weight, tuple(b for b, value in zip(block.basis, np.diag(gram), strict=True)
                                        if value > NEEDED * size or block.weight.strict))
              for block, gram in zip(program.blocks, found, strict=True)]
    if all(len(a.basis) == len(b.basis) for a, b in zip(blocks, program.blocks, strict=True)):
        return None
    return Program(program.target, [b for b in blocks if b.basis], program.multiples)


# --- rounding -------------------------------------------------------------------------------------------------


def _rounded(program: Program, values: Vector, definite: bool, strict: bool) -> Solution | None:
    """An exact solution near the numbers: free unknowns rounded, the others computed from them."""
    count = len(program.columns)
    if not definite and count > len(program.rows):  # some unknown is free, and there is nothing to round it by
        return None
    table: dict[int, dict[int, object]] = {}
    for column, value in enumerate([*program.columns, program.target]):
        for e, c in value.terms():
            table.setdefault(program.rows[e], {})[column] = c
    reduced, pivots = DomainMatrix(table, (len(program.rows), count + 1), sp.QQ).to_sparse().rref()
    if count in pivots:
        return None
    lines = [{c: Fraction(int(v.numerator), int(v.denominator)) for c, v in reduced.rep.to_sdm()[row].items()}
             for row in range(len(pivots))]
    free = sorted(set(range(count)) - set(pivots))
    if free and not definite:
        return None
    unit = _unit(program.target)
    for denominator in DENOMINATORS if free else (1,):
        exact = [Fraction(0)] * count
        for column in free:
            exact[column] = Fraction(_nearest(values[column] / float(unit) * denominator), denominator) * unit
        for pivot, line in zip(pivots, lines, strict=True):
            exact[pivot] = line.get(count, Fraction(0)) - sum(
                (v * exact[c] for c, v in line.items() if c not in (pivot, count)), Fraction(0))
        squares = _squares(program, exact)
        if squares is not None and (not strict or any(s.block.weight.strict for s in squares)):
            return Solution(squares, exact[:len(program.multiples)])
    return None


def _unit(target: Polynomial) -> Fraction:
    """1, or the power of two next to a target's largest coefficient where that is far from 1."""
    size = round(float(np.log2(max(abs(float(c)) for c in target.coeffs()))))
    return Fraction(1) if -7 < size < 11 else Fraction(2) ** size


def _nearest(value: float) -> int:
    """The whole number next to a value; the tie is put where no simple fraction lies, so that noise cannot turn it."""
    return int(np.floor(value + 0.4619))


def _squares(program: Program, exact: list[Fraction]) -> list[Square] | None:
    """The squares of Gram matrices, or None when one is not positive semidefinite."""
    floats = grams(program, np.array([float(x) for x in exact]))
    if any(q.size and np.linalg.eigvalsh(q)[0] < -1e-9 * max(1.0, np.abs(q).max()) for q in floats):
        return None
    tables: list[Rows] = [[[Fraction(0)] * len(b.basis) for _ in b.basis] for b in program.blocks]
    for (k, i, j), value in zip(program.places, exact, strict=True):
        if k >= 0:
            tables[k][i][j] = tables[k][j][i] = value
    squares = []
    for block, gram in zip(program.blocks, tables, strict=True):
        parts = weighted_squares(gram)
        if parts is None:
            return None
        for coefficient, root in parts:
            value = sum((b * sp.QQ(*x.as_integer_ratio()) for b, x in zip(block.basis, root, strict=True) if x),
                        program.target.ring.zero)
            squares.append(Square(block, coefficient, value))
    return squares


def weighted_squares(gram: Rows) -> list[tuple[Fraction, list[Fraction]]] | None:
    """(d, l) with gram = sum of d l l^T and every d > 0, exactly; None when gram is not positive semidefinite."""
    rest, parts = [list(row) for row in gram], []
    for k in range(len(rest)):
        pivot = rest[k][k]
        if pivot < 0 or (pivot == 0 and any(rest[k])):
            return None
        if pivot == 0:
            continue
        line = [x / pivot for x in rest[k]]
        parts.append((pivot, line))
        for i in range(k, len(rest)):
            if line[i]:
                rest[i] = [x - pivot * line[i] * y for x, y in zip(rest[i], line, strict=True)]
    return parts


# --- facial reduction ------------------------------------------------------------------------------------------


def _restrictions(program: Program, values: Vector, kernels: Callable[[Block], Rows]) -> Iterator[Program]:
    """Programs in the complement of what may be the Gram matrices' kernels, likeliest first; each is smaller."""
    known = [_on_complement(block, kernels(block)) for block in program.blocks]
    if any(len(a.basis) < len(b.basis) for a, b in zip(known, program.blocks, strict=True)):
        yield Program(program.target, [block for block in known if block.basis], program.multiples)
    parts = [np.linalg.eigh(gram) for gram in grams(program, values)]
    size = max((float(eigenvalues[-1]) for eigenvalues, _ in parts), default=0.0)
    seen = {tuple(len(b.basis) for b in program.blocks)}
    for cut in RANK_CUTS:
        ranks = tuple(int(np.sum(eigenvalues > cut * size)) for eigenvalues, _ in parts)
        if ranks in seen:
            continue
        seen.add(ranks)
        factors = [vectors[:, len(own) - rank:] * np.sqrt(np.maximum(own[len(own) - rank:], 0.0))
                   for (own, vectors), rank in zip(parts, ranks, strict=True)]
        better = refined(program, values[:len(program.multiples)], factors)
        # Where equality is attained to higher order the refinement fails, but simple kernels can be guessed.
        blocks = [_complement(block, factor, SURE if better else GUESSED)
                  for block, factor in zip(program.blocks, better or factors, strict=True)]
        if all(b is not None for b in blocks):
            yield Program(program.target, [b for b in blocks if b is not None and b.basis], program.multiples)


def _complement(block: Block, factor: Vector, surety: float) -> Block | None:
    """The block on the complement of the kernel of L L^T; None when that kernel is not rational."""
    size, rank = factor.shape
    vectors = np.linalg.svd(factor, full_matrices=True)[0] if rank else np.eye(size)
    kernel, pivots = _echelon(vectors[:, rank:].T, surety / 10)
    if len(pivots) != size - rank:
        return None
    rows = [[simplest(float(x), surety) for x in row] for row in kernel]
    if any(x is None for row in rows for x in row):
        return None
    return _without(block, [[x for x in row if x is not None] for row in rows], pivots)


def _on_complement(block: Block, vectors: Rows) -> Block:
    """The block on the complement of exact vectors."""
    if not any(map(any, vectors)):
        return block
    table = [[sp.QQ(*x.as_integer_ratio()) for x in row] for row in vectors]
    reduced, pivots = DomainMatrix(table, (len(table), len(block.basis)), sp.QQ).rref()
    rows = [[Fraction(int(x.numerator), int(x.denominator)) for x in row]
            for row in reduced.to_list()[:len(pivots)]]
    return _without(block, rows, list(pivots))


def _without(block: Block, rows: Rows, pivots: list[int]) -> Block:
    """The block on the complement of the rows of a reduced echelon form."""
    basis = []
    for j in (j for j in range(len(block.basis)) if j not in pivots):
        value = block.basis[j]
        for pivot, row in zip(pivots, rows, strict=True):
            if row[j]:
                value = value - block.basis[pivot] * sp.QQ(*row[j].as_integer_ratio())
        basis.append(value)
    return Block(block.weight, tuple(basis))


def _echelon(rows: Vector, nothing: float) -> tuple[Vector, list[int]]:
    """The reduced row echelon form of rows of full rank, and its pivot columns; smaller pivots count as nothing."""
    table, pivots = rows.copy(), list[int]()
    for column in range(table.shape[1]):
        done = len(pivots)
        if done == len(table):
            break
        best = done + int(np.argmax(np.abs(table[done:, column])))
        if abs(table[best, column]) < nothing:
            continue
        table[[done, best]] = table[[best, done]]
        table[done] /= table[done, column]
        for row in range(len(table)):
            if row != done:
                table[row] -= table[row, column] * table[done]
        pivots.append(column)
    return table, pivots


def simplest(value: float, surety: float) -> Fraction | None:
    """The fraction that a computed number most likely stands for, or None.

    Any number has fractions p/q nearer than 1/q^2, so one that is `surety` times nearer is unlikely by chance.
    """
    for convergent in _convergents(value):
        if max(convergent.denominator, abs(convergent.numerator)) > LARGEST:
            return None
        if abs(float(convergent) - value) <= min(surety / 10, surety / convergent.denominator**2):
            return convergent
    return None


def _convergents(value: float) -> Iterator[Fraction]:
    """Continued fraction convergents of a number."""
    p, q, before_p, before_q, x = int(np.floor(value)), 1, 1, 0, value
    for _ in range(40):
        yield Fraction(p, q)
        rest = x - np.floor(x)
        if rest < 1e-12:
            return
        x = 1.0 / rest
        a = int(np.floor(x))
        p, q, before_p, before_q = a * p + before_p, a * q + before_q, p, q
