"""Obligations of a public benchmark of another prover, decided with certificates, and z3 on the same ones.

    python benchmarks/peers.py [FILE] [--limit 10] [--jobs 2] [--without-z3] [--json FILE]

FILE is a JSON list of {problem, kind, known, assume, show}; `known` is true, false or open, by whoever stated it. Every
verdict counts only with certificates that the checker accepts and that belong to the obligation. Times are of the
processor, reading and translation included; z3 gets the same limit. Where a verdict is not what is known, or z3 says
the contrary, the exit code is 1. z3 is optional (`pip install -e ".[benchmark]"`).
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import multiprocessing
import sys
import time
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
    from workbench.proof.oracle.question import implied  # noqa: PLC0415 - z3 is optional

    started = time.process_time()
    answer = implied(obligation["assume"], obligation["show"], limit)
    return answer, time.process_time() - started


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
