"""What a search found as certificates of the proof checker's language: squares for an answer, points for none.

The checker derives D(...) on its own and adds the squares up again in fractions, so that neither the solver nor the
rounding has to be believed. That there is no answer is shown by points: at them the conditions, weighted with positive
numbers, add up to a negative number whatever the unknowns are.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

import sympy as sp

from workbench.errors import SolverError
from workbench.gains.exact import Matrix, rational, simplest, solve_exactly, squares_of
from workbench.gains.problem import Exponents, Family, Problem
from workbench.gains.scaled import Array, Scaled, size_of
from workbench.proof.checker import CertificateError, check
from workbench.proof.claim import Goal
from workbench.proof.document import write_folder
from workbench.proof.text import goal_text, relation_text, text
from workbench.proof.verdict import Verdict

# (number of the region's inequality or -1, positive coefficient, root as exponents -> coefficient) of a square.
Proof = list[tuple[int, Fraction, dict[Exponents, Fraction]]]
Certificate = dict[str, Any]


def proved_certificate(problem: Problem, values: Mapping[sp.Symbol, sp.Rational], states: tuple[sp.Symbol, ...],
                       proofs: list[Proof]) -> Certificate:
    """The checked certificate that the conditions hold with these values; SolverError where the checker objects."""
    from workbench.proof.decide.refute import find_example  # noqa: PLC0415 - as in `goal_certificate`

    put = dict(values)
    goal = Goal(tuple(r.subs(put) for r in problem.conditions.values()), tuple(r.subs(put) for r in problem.where),
                {s: sp.sympify(rate, strict=True).xreplace(put) for s, rate in problem.flow.items()})
    first = len(goal.signs())
    steps = [{"rule": "combination", "terms": [{
        "coefficient": str(coefficient),
        "factors": [*([{"assume": first + number}] if number >= 0 else []), {"square": _root(root, states)}],
    } for number, coefficient, root in proof]} for proof in proofs]
    example = find_example(goal) if problem.where else {str(s): "1" if s.is_positive else "0" for s in goal.symbols()}
    if example is None:
        raise SolverError(f"{problem.id}: no point is found in the region `where`: state one that is not empty")
    found = {"claim": problem.id, "version": 1, "verdict": "proved", "goal": goal_text(goal), "example": example,
             "proofs": steps, "conditions": {name: relation_text(r) for name, r in problem.conditions.items()},
             "values": {str(u): str(v) for u, v in values.items()}}
    return checked(found)


def goal_certificate(claim: str, goal: Goal) -> Certificate:
    """The certificate of a goal that the proof deciders prove; SolverError naming it where they do not."""
    from workbench.proof.decide.engine import prove_goal  # noqa: PLC0415 - who only states such goals needs no deciders

    proof = prove_goal(goal)
    if proof is None:
        raise SolverError(f"{claim}: could not be proved: state it in smaller steps")
    return {"claim": claim, **proof}


def checked(certificate: Certificate) -> Certificate:
    """The certificate when the checker accepts it, else SolverError."""
    try:
        check(certificate)
    except CertificateError as trouble:
        raise SolverError(f"{certificate.get('claim')}: the checker refuses the certificate ({trouble})") from None
    return certificate


def _root(root: Mapping[Exponents, Fraction], states: tuple[sp.Symbol, ...]) -> str:
    whole = sum((rational(c) * sp.prod([s**n for s, n in zip(states, e, strict=True)]) for e, c in root.items()),
                sp.Integer(0))
    return text(whole)


def infeasible_certificate(problem: Problem, data: Scaled, duals: list[Array],
                           scales: list[Fraction]) -> Certificate | None:
    """The checked certificate that no values meet the conditions, from the dual's matrices; None if rounding fails."""
    sized = [_in_units(dual, data.families[k], data.tops[k], scales)
             for dual, k in zip(duals, data.owners, strict=True)]
    of_family = [data.families[k] for k in data.owners]
    for power in range(2, 12):
        exact = _cancelling(of_family, [[[simplest(x, 10.0**-power) if x else Fraction(0) for x in row] for row in z]
                                        for z in sized], len(problem.unknowns))
        points = [squares_of(z) for z in exact] if exact else []
        if exact and all(p is not None for p in points):
            return _points_certificate(problem, of_family, [p for p in points if p is not None])
    return None


def _in_units(dual: Array, family: Family, top: float, scales: list[Fraction]) -> list[list[float]]:
    sizes = [size_of(scales, e) for e in family.blocks[0].basis]
    return [[float(dual[i, j]) * a * b / top for j, b in enumerate(sizes)] for i, a in enumerate(sizes)]


def _gram(family: Family, number: int) -> Matrix:
    """The matrix that an unknown (the constant: 0) multiplies in a family whose Gram matrix its terms determine."""
    basis = family.blocks[0].basis
    terms = ((tuple(a + b for a, b in zip(one, two, strict=True)), one == two) for one in basis for two in basis)
    flat = [family.terms[e][number] / (1 if same else 2) if e in family.terms else Fraction(0) for e, same in terms]
    return [flat[i * len(basis):(i + 1) * len(basis)] for i in range(len(basis))]


def _inner(one: Matrix, two: Matrix) -> Fraction:
    return sum((x * y for a, b in zip(one, two, strict=True) for x, y in zip(a, b, strict=True)), Fraction(0))


def _cancelling(families: list[Family], duals: list[Matrix], unknowns: int) -> list[Matrix] | None:
    """The matrices nearest to the duals in which all unknowns cancel, entries weighed by the diagonal's sizes."""
    slopes = [[_gram(f, n + 1) for f in families] for n in range(unknowns)]

    def weighed(matrices: list[Matrix]) -> list[Matrix]:
        return [[[x * z[i][i] * z[j][j] for j, x in enumerate(row)] for i, row in enumerate(m)]
                for m, z in zip(matrices, duals, strict=True)]

    steps = [weighed(s) for s in slopes]
    total = [[sum((_inner(a, b) for a, b in zip(one, step, strict=True)), Fraction(0)) for step in steps]
             for one in slopes]
    wrong = [sum((_inner(a, z) for a, z in zip(one, duals, strict=True)), Fraction(0)) for one in slopes]
    factors = solve_exactly(total, wrong)
    if factors is None:
        return None
    return [[[x - sum((f * step[k][i][j] for f, step in zip(factors, steps, strict=True)), Fraction(0))
              for j, x in enumerate(row)] for i, row in enumerate(z)] for k, z in enumerate(duals)]


def _points_certificate(problem: Problem, families: list[Family],
                        points: list[list[tuple[Fraction, tuple[Fraction, ...]]]]) -> Certificate | None:
    """Each point's weight times the condition there, written out; their sum is a negative number."""
    parts, total, listed = [], Fraction(0), []
    for family, squares in zip(families, points, strict=True):
        constant = _gram(family, 0)
        for weight, point in squares:
            at = {n: _form(_gram(family, n), point) for n in range(len(problem.unknowns) + 1)}
            total += weight * _form(constant, point)
            inside = " + ".join(f"({value})*{name}" if n else f"({value})" for n, value in at.items()
                                for name in [str(problem.unknowns[n - 1]) if n else ""])
            parts.append(f"({weight})*({inside})")
            listed.append({"family": family.name, "weight": str(weight), "point": [str(x) for x in point],
                           "basis": [list(e) for e in family.blocks[0].basis]})
    if total >= 0:
        return None
    return checked({
        "claim": problem.id, "version": 1, "verdict": "proved",
        "goal": {"assume": [], "show": [f"{' + '.join(parts)} < 0"]},
        "example": {str(u): "0" for u in problem.unknowns},
        "proofs": [{"rule": "combination", "terms": [{"coefficient": str(-total), "factors": []}]}],
        "infeasible": {name: relation_text(r) for name, r in problem.conditions.items()}, "points": listed})


def _form(matrix: Matrix, point: tuple[Fraction, ...]) -> Fraction:
    return sum((m * a * b for row, a in zip(matrix, point, strict=True) for m, b in zip(row, point, strict=True)),
               Fraction(0))


def write_certificates(certificates: Iterable[Certificate], folder: Path, within: Path | None = None) -> None:
    """Write each as <name>.json into a folder, with a manifest; InputError where that cannot be.

    within: the folder that was asked for, which no link may lead out of; by default the folder itself.
    """
    papers: dict[str, dict[str, tuple[Verdict, Certificate | None]]] = {}
    for certificate in certificates:
        paper, _, name = str(certificate["claim"]).partition(":")
        papers.setdefault(paper, {})[name] = (certificate["verdict"], certificate)
    for paper, rows in papers.items():
        write_folder(folder, within or folder, paper, rows, True)
