"""Lyapunov functions, barriers and feedbacks for public problems of the literature, each with an exact certificate.

    python benchmarks/gains.py [FILE] [--only NAME ...] [--limit 60] [--json FILE]

FILE is a JSON list of problems by kind. Lyapunov: `rates` by state, `within` (polynomials that are not negative in the
region; none: everywhere), `attempts` of [degree, decay rate]. barrier: also `initial` and `unsafe`. feedback: matrices
`A` and `B`, the decay `rate` that u = K x is asked for, in 1/s, and the `radius` of each state within which commands
count. `source` and `peer` say where it comes from and what
is reported there. A row counts as found only with certificates that the checker accepts. Times are of the processor.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from scipy.linalg import solve_continuous_are

from workbench.errors import WorkbenchError
from workbench.files.time_limit import OutOfTime, at_most_seconds
from workbench.gains.feedback import decaying, proved_decay
from workbench.gains.linearised import LinearPlants
from workbench.gains.lyapunov import Certified, barrier_function, lyapunov_function
from workbench.proof.checker import check
from workbench.proof.obligation import expression
from workbench.proof.typed import evaluated

FILE = Path(__file__).parent / "gains_problems" / "problems.json"
PARTS = (0.9, 0.5, 0.1)  # of a loop's spectral abscissa, asked for as proved decay


@dataclass(frozen=True)
class Row:
    """What was found of a problem: what is proved and the function or gain, or why nothing was; seconds; the peer."""

    name: str
    kind: str
    found: bool
    proved: str
    function: str
    certificates: int
    seconds: float
    peer: str
    source: str


def found(problem: dict[str, Any], limit: float) -> Row:
    """The row of one problem; the first attempt that succeeds counts."""
    started, proved, function, reason, certificates = time.process_time(), "", "", "", 0
    try:
        with at_most_seconds(limit):
            for shown, said, own in _attempts(problem):
                for certificate in own:
                    check(certificate)
                if own:
                    proved, function, certificates = shown, said, len(own)
                    break
                reason = said
    except OutOfTime:
        certificates, reason = 0, f"nothing within {limit:g} s"
    seconds = time.process_time() - started
    return Row(problem["name"], problem["kind"], certificates > 0, proved, function or reason, certificates, seconds,
               problem["peer"], problem["source"])


def _attempts(problem: dict[str, Any]) -> Iterator[tuple[str, str, list[dict[str, Any]]]]:
    """(what is proved, the function or why there is none, certificates) of each attempt."""
    if problem["kind"] == "feedback":
        yield from _feedback(problem)
        return
    flow = {sp.Symbol(state, real=True): evaluated(expression(rate)) for state, rate in problem["rates"].items()}
    regions = {part: [evaluated(expression(text)) for text in problem.get(part, [])]
               for part in ("within", "initial", "unsafe")}
    where = "in the region" if regions["within"] else "everywhere"
    for degree, stated in problem["attempts"]:
        rate = Fraction(stated)
        try:
            if problem["kind"] == "Lyapunov":
                one: Certified = lyapunov_function(f"benchmark:{len(flow)}", flow, degree, rate, regions["within"])
                proved = f"V' <= {'0' if not rate else f'-{rate} V'} {where}"
            else:
                one = barrier_function(f"benchmark:{len(flow)}", flow, regions["initial"], regions["unsafe"], degree,
                                       rate, regions["within"])
                proved = f"unsafe set not reached, B' <= {rate} B {where}"
        except WorkbenchError as trouble:
            yield "", str(trouble), []
            continue
        yield proved, str(one.function), list(one.certificates.values())


def _feedback(problem: dict[str, Any]) -> Iterator[tuple[str, str, list[dict[str, Any]]]]:
    """u = K x with the least command for an ellipsoid of states; else an LQR's, with the decay that is proved of it."""
    A, B = (sp.Matrix([[sp.Rational(entry) for entry in row] for row in problem[name]]) for name in "AB")
    states = tuple(f"x{place + 1}" for place in range(A.rows))
    plants = LinearPlants(states, tuple(f"u{place + 1}" for place in range(B.cols)), ((A, B),))
    radius = dict(zip(states, map(Fraction, problem["radius"]), strict=True))
    a, b = (np.array(matrix.tolist(), dtype=float) for matrix in (A, B))
    alone = f"plant alone {-_abscissa(a):.3g}"
    try:
        one = decaying("benchmark:feedback", plants, Fraction(problem["rate"]), radius)
    except WorkbenchError as trouble:
        yield "", str(trouble), []
    else:
        yield (f"decay {problem['rate']} 1/s ({alone}), |u| <= {one.bound:.4g}", _listed(one.K),
               [one.found.certificate])
    size = np.diag([1 / float(r) ** 2 for r in radius.values()])
    K = np.round(-b.T @ solve_continuous_are(a, b, size, np.eye(b.shape[1])), 3)
    for part in PARTS:
        rate = Fraction(f"{-part * _abscissa(a + b @ K):.3g}")
        try:
            held = proved_decay("benchmark:feedback", plants, [[Fraction(str(k)) for k in row] for row in K], rate,
                                radius)
        except WorkbenchError as trouble:
            yield "", str(trouble), []
        else:
            yield f"decay {float(rate):.3g} 1/s of an LQR ({alone})", _listed(K.ravel()), [held.certificate]


def _abscissa(matrix: np.ndarray) -> float:
    return float(np.linalg.eigvals(matrix).real.max())


def _listed(gains: Any) -> str:
    return f"K = [{', '.join(f'{float(entry):.4g}' for entry in gains)}]"


def main() -> int:
    """Print a row for every problem, and how many were found; 2 for a name that is none."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", type=Path, default=FILE)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--limit", type=float, default=60.0, help="seconds of the processor for each problem")
    parser.add_argument("--json", type=Path)
    chosen = parser.parse_args()
    problems = json.loads(chosen.file.read_text(encoding="utf-8"))
    unknown = set(chosen.only) - {problem["name"] for problem in problems}
    if unknown:
        print(f"no problem is named {', '.join(sorted(unknown))}", file=sys.stderr)
        return 2
    rows = []
    for problem in problems:
        if not chosen.only or problem["name"] in chosen.only:
            row = found(problem, chosen.limit)
            rows.append(row)
            print(f"{row.name:34s}{row.kind:10s}{row.seconds:7.1f} s  {row.proved or 'not found'}\n"
                  f"    {row.function[:150]}\n    peer: {row.peer}", flush=True)
    print(f"{sum(row.found for row in rows)} of {len(rows)} found, each with exact certificates, in "
          f"{sum(row.seconds for row in rows):.0f} s")
    if chosen.json is not None:
        chosen.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
