"""How long `workbench prove` takes: searched anew, cold with the certificates at hand, and when the cache knows the
claims; exit 1 where the search finds other certificates than those that lie with the papers.

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

from workbench.files.folders import CERTIFICATES, is_paper, papers_in
from workbench.tasks.processes import cores

REPEATS_WARM = 5


def seconds(paths: list[str], jobs: int, folder: Path, *options: str) -> float:
    """Seconds of one `workbench prove`, whatever the verdicts; its cache and its output stay in the folder."""
    command = [sys.executable, "-m", "workbench", "prove", *paths, "--workers", str(jobs),
               "--certificates", str(folder / "certificates"), "--json", str(folder / "claims.json"), *options]
    before = time.perf_counter()
    done = subprocess.run(command, env=os.environ | {"WORKBENCH_CACHE": str(folder / "cache")}, capture_output=True,
                          text=True, check=False)
    taken = time.perf_counter() - before
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr)
    return taken


def differing(paths: list[str], folder: Path) -> list[str]:
    """The certificates of papers' folders that are other than those found now, as <paper>/<file>."""
    found = []
    for paper in (paper for path in map(Path, paths) for paper in ([path] if is_paper(path) else papers_in(path))):
        at_hand, found_now = ({path.relative_to(place).as_posix(): path.read_bytes() for path in place.rglob("*.json")}
                              for place in (paper / CERTIFICATES, folder / CERTIFICATES / paper.name))
        # What a search of gains has written is no claim of the paper's own, and not searched for here.
        found += [f"{paper.name}/{name}" for name in sorted(found_now) if at_hand.get(name) != found_now[name]]
    return found


def main() -> int:
    """Print one line a case, each with its ratio to the first; 1 where committed certificates are other ones."""
    paths, many = sys.argv[1:] or ["proofs"], cores()
    times: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for jobs in sorted({1, many}):
            times[f"searched anew, {jobs} worker{'s' if jobs > 1 else ''}"] = seconds(
                paths, jobs, folder, "--no-cache")
        others = differing(paths, folder)
        times[f"cold, {many} workers"] = seconds(paths, many, folder)
        claims = len(json.loads((folder / "claims.json").read_text(encoding="utf-8"))["claims"])
        shutil.rmtree(folder / "cache" / "decided-claims" / "files")
        times[f"goals made again, {many} workers"] = seconds(paths, many, folder)
        times["nothing changed"] = statistics.median(seconds(paths, many, folder) for _ in range(REPEATS_WARM))
    slowest = next(iter(times.values()))
    print(f"{claims} claims                     seconds      ratio")
    for what, taken in times.items():
        print(f"{what:30s} {taken:9.2f} {slowest / taken:9.1f}x")
    print(f"committed certificates that a search finds otherwise: {', '.join(others) or 'none'}")
    return int(bool(others))


if __name__ == "__main__":
    sys.exit(main())
