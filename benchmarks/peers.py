"""Obligations of a public benchmark of another prover, decided with certificates, and z3 on the same ones.

    python benchmarks/peers.py [FILE] [--limit 10] [--jobs 2] [--without-z3] [--json FILE]

FILE is a JSON list of {problem, kind, known, assume, show}; `known` is true, false or open, by whoever stated it. Every
verdict counts only with certificates that the checker accepts and that belong to the obligation. Times are of the
processor, reading and translation included; z3 gets the same limit. Where a verdict is not what is known, or z3 says
the contrary, the exit code is 1. z3 is optional (`pip install -e ".[benchmark]"`).
"""

from __future__ import annotations

import argparse
import ast
import importlib.util
import json
import multiprocessing
import sys
import threading
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from workbench.errors import ClaimError
from workbench.files.time_limit import OutOfTime, at_most_seconds
from workbench.proof.checker import CertificateError, check
from workbench.proof.decide.obligations import belongs, decide_obligation
from workbench.tasks.processes import single_threaded

FILE = Path(__file__).parent / "peers" / "ode_invariants.json"
CONTRARY = {("proved", "sat"), ("refuted", "unsat")}
WRONG = {("proved", "false"), ("refuted", "true")}
OPERATORS = {ast.Add: lambda a, b: a + b, ast.Sub: lambda a, b: a - b, ast.Mult: lambda a, b: a * b,
             ast.Div: lambda a, b: a / b}


@dataclass(frozen=True)
class Row:
    """What was decided of one obligation, in how many seconds of the processor, and what z3 said of it."""

    number: int
    problem: str
    kind: str
    known: str
    verdict: str
    method: str
    seconds: float
    z3: str
    z3_seconds: float


def decided(task: tuple[int, dict[str, Any], float, bool]) -> Row:
    """The row of one obligation."""
    number, obligation, limit, beside = task
    started = time.process_time()
    try:
        with at_most_seconds(limit):
            outcome = decide_obligation(obligation)
        verdict, method, certificates = outcome.verdict, outcome.method, outcome.certificates
    except OutOfTime:
        verdict, method, certificates = "undecided", f"no verdict within {limit:g} s", ()
    except ClaimError as trouble:
        verdict, method, certificates = "unstatable", str(trouble), ()
    seconds = time.process_time() - started
    try:
        for certificate in certificates:
            check(certificate)
        if verdict in ("proved", "refuted") and not belongs(obligation, verdict, certificates):
            verdict, method = "undecided", "the certificates are not of this obligation"
    except CertificateError as trouble:
        verdict, method = "undecided", f"the certificate is refused: {trouble}"
    answer, taken = z3_answer(obligation, limit) if beside else ("", 0.0)
    return Row(number, obligation["problem"], obligation["kind"], obligation["known"], verdict, method, seconds,
               answer, taken)


def z3_answer(obligation: dict[str, Any], limit: float) -> tuple[str, float]:
    """unsat (it holds), sat or unknown, and the seconds that z3 took."""
    import z3  # noqa: PLC0415

    started, done = time.process_time(), threading.Event()

    def interrupt() -> None:  # its own limits are of the wall clock, or of steps
        while not done.wait(0.05):
            if time.process_time() - started > limit:
                z3.main_ctx().interrupt()

    solver = z3.Solver()
    try:
        for statement in obligation["assume"]:
            solver.add(_z3_statement(z3, statement))
        solver.add(z3.Not(_z3_statement(z3, obligation["show"])))
    except ValueError:  # functions, of which it knows nothing
        return "unknown", time.process_time() - started
    watch = threading.Thread(target=interrupt, daemon=True)
    watch.start()
    try:
        answer = str(solver.check())
    except z3.Z3Exception:
        answer = "unknown"
    done.set()
    watch.join()
    return answer, time.process_time() - started


def _z3_statement(z3: Any, statement: Sequence[Any]) -> Any:
    name, *parts = statement
    if name in ("and", "or", "not"):
        return {"and": z3.And, "or": z3.Or, "not": z3.Not}[name](*(_z3_statement(z3, part) for part in parts))
    left, right = (_z3_term(z3, ast.parse(text, mode="eval").body) for text in parts)
    return {"=": left == right, "!=": left != right, "<": left < right, "<=": left <= right, ">": left > right,
            ">=": left >= right}[name]


def _z3_term(z3: Any, node: ast.expr) -> Any:
    match node:
        case ast.Constant(value=value):
            return z3.RealVal(str(value))
        case ast.Name(id=name):
            return z3.Real(name)
        case ast.UnaryOp(operand=inner):
            return -_z3_term(z3, inner)
        case ast.BinOp(left=base, op=ast.Pow(), right=ast.Constant(value=int(power))):
            product = z3.RealVal(1)
            for _ in range(power):
                product = product * _z3_term(z3, base)
            return product
        case ast.BinOp(left=left, op=op, right=right):
            return OPERATORS[type(op)](_z3_term(z3, left), _z3_term(z3, right))
    raise ValueError(ast.unparse(node))


def print_table(rows: list[Row], beside: bool) -> None:
    """By kind and what is known: how many, how many decided, and seconds; z3 beside."""
    print(f"{'kind':10s}{'known':8s}{'stated':>8s}{'proved':>8s}{'refuted':>8s}{'decided':>9s}{'seconds':>9s}"
          + (f"{'z3':>8s}{'seconds':>9s}" if beside else ""))
    groups = sorted({(row.kind, row.known) for row in rows})
    for kind, known in (*groups, ("all", "")):
        own = [row for row in rows if kind == "all" or (row.kind, row.known) == (kind, known)]
        proved, refuted = (sum(row.verdict == verdict for row in own) for verdict in ("proved", "refuted"))
        by_z3 = sum(row.z3 in ("sat", "unsat") for row in own)
        print(f"{kind:10s}{known:8s}{len(own):8d}{proved:8d}{refuted:8d}{(proved + refuted) / len(own):9.1%}"
              f"{sum(row.seconds for row in own):9.1f}"
              + (f"{by_z3 / len(own):8.1%}{sum(row.z3_seconds for row in own):9.1f}" if beside else ""))


def main() -> int:
    """Print the table, what is undecided and why, and every contradiction; 1 where there is one."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", type=Path, default=FILE)
    parser.add_argument("--limit", type=float, default=10.0, help="seconds of the processor for each obligation")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--without-z3", action="store_true")
    parser.add_argument("--json", type=Path)
    chosen = parser.parse_args()
    beside = not chosen.without_z3
    if beside and importlib.util.find_spec("z3") is None:
        print("z3 is not installed: pip install z3-solver, or use --without-z3", file=sys.stderr)
        return 2
    obligations = json.loads(chosen.file.read_text(encoding="utf-8"))
    tasks = [(number, obligation, chosen.limit, beside) for number, obligation in enumerate(obligations)]
    with single_threaded(), ProcessPoolExecutor(chosen.jobs, multiprocessing.get_context("spawn")) as pool:
        rows = list(pool.map(decided, tasks))
    print_table(rows, beside)
    for row in rows:
        if row.verdict not in ("proved", "refuted"):
            print(f"{row.verdict}: {row.number} {row.problem} ({row.kind}, {row.known}): {row.method[:240]}")
    contrary = [row for row in rows if (row.verdict, row.z3) in CONTRARY or (row.verdict, row.known) in WRONG]
    for row in contrary:
        print(f"CONTRADICTION: {row.number} {row.problem} ({row.kind}): {row.verdict}, known {row.known}, z3 {row.z3}")
    if chosen.json is not None:
        chosen.json.write_text(json.dumps([asdict(row) for row in rows], indent=1) + "\n", encoding="utf-8")
    return int(bool(contrary))


if __name__ == "__main__":
    sys.exit(main())
