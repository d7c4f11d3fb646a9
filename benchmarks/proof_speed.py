"""How long `workbench prove` takes: cold with one worker and with one a core, and when the cache knows the claims.

    python benchmarks/proof_speed.py [PATH ...]        default: proofs

Every line is the whole command in a process of its own, from its start to its end. "goals made again" is what a run
costs after an edit that touches no claim: every proof file is imported and every goal made, then found in the cache.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from workbench.simulate.process_pool import cores

REPEATS_WARM = 5


def seconds(paths: list[str], jobs: int, folder: Path) -> float:
    """Seconds of one `workbench prove`, whatever the verdicts; its cache and its output stay in the folder."""
    command = [sys.executable, "-m", "workbench", "prove", *paths, "--workers", str(jobs),
               "--certificates", str(folder / "certificates"), "--json", str(folder / "claims.json")]
    before = time.perf_counter()
    done = subprocess.run(command, env=os.environ | {"WORKBENCH_CACHE": str(folder / "cache")}, capture_output=True,
                          text=True, check=False)
    taken = time.perf_counter() - before
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr)
    return taken


def main() -> None:
    """Print one line a case, each with its ratio to the first."""
    paths, many = sys.argv[1:] or ["proofs"], cores()
    times: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for jobs in sorted({1, many}):
            shutil.rmtree(folder / "cache", ignore_errors=True)
            times[f"cold, {jobs} worker{'s' if jobs > 1 else ''}"] = seconds(paths, jobs, folder)
        claims = len(json.loads((folder / "claims.json").read_text(encoding="utf-8"))["claims"])
        shutil.rmtree(folder / "cache" / "decided-claims" / "files")
        times[f"goals made again, {many} workers"] = seconds(paths, many, folder)
        times["nothing changed"] = statistics.median(seconds(paths, many, folder) for _ in range(REPEATS_WARM))
    cold = next(iter(times.values()))
    print(f"{claims} claims                     seconds      ratio")
    for what, taken in times.items():
        print(f"{what:30s} {taken:9.2f} {cold / taken:9.1f}x")


if __name__ == "__main__":
    main()
