"""What happens when something beside a long command fails: a worker of a cluster, its scheduler, a file, a folder.

    python benchmarks/faults_elsewhere.py [--times 4] [--seed 1] [--size 20]

A real scheduler with two worker processes on loopback runs a sweep; at instants drawn by chance a worker, or the
scheduler, is killed. Demanded: the bytes of the sweep that ran here, or, without a scheduler, one line, exit code 2, no
process left after 10 s and the same bytes once resumed. Then what a sweep, a contest and a search keep is damaged in
each way that is named, and resumed: the same bytes, or one line. Last, a folder on a disk that cannot be written.
Exit code 1 when something differs.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pyarrow.parquet

sys.path.insert(0, str(Path(__file__).parent))
from faults import Bench, ended, instants, left_after
from long_jobs import Job, jobs

START_S = 60.0


@contextmanager
def loopback(place: Path, workers: int = 2) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """The address of a scheduler, and its process with those of its workers, which know nothing of the package."""
    place.mkdir(exist_ok=True)
    told = place / "scheduler.json"
    told.unlink(missing_ok=True)
    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

    def started(what: str, *arguments: str) -> subprocess.Popen[bytes]:
        return subprocess.Popen([sys.executable, "-m", f"distributed.cli.dask_{what}", *arguments, "--no-dashboard"],
                                cwd=place, env=bare, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    here = ("--scheduler-file", str(told))
    processes = [started("scheduler", "--host", "127.0.0.1", "--port", "0", *here)]
    processes += [started("worker", *here, "--nthreads", "1", "--no-nanny", "--local-directory", str(place))
                  for _ in range(workers)]
    try:
        until = time.monotonic() + START_S
        while not (told.exists() and told.read_text().strip()):
            if time.monotonic() > until or processes[0].poll() is not None:
                raise RuntimeError("the scheduler does not start")
            time.sleep(0.05)
        yield json.loads(told.read_text())["address"], processes
    finally:
        for process in processes:
            process.kill()
            process.wait()


def refusals(said: str) -> list[str]:
    """The lines by which a command has refused to go on."""
    return [line for line in said.splitlines() if line.startswith("workbench: ") and ": note: " not in line]


def refused_well(bench: Bench, job: Job, code: int) -> str:
    """What is wrong with how a command has refused; empty where it is one line, with exit code 2."""
    said = bench.said(job).read_text()
    return "" if code == 2 and len(refusals(said)) == 1 else f"ends with {code}: {said[-300:]}"


def lost(bench: Bench, job: Job, whole: bytes, which: str, after: float) -> str:
    """What is wrong when the scheduler, or a worker, is killed so many seconds after the sweep began."""
    with loopback(bench.place / "cluster") as (address, processes):
        folder = bench.fresh(job)
        line = " ".join(job.begin.split(" --workers")[:1]) + f" --dask {address}"
        number = bench.start(job, line, folder)
        time.sleep(after)
        processes[which == "worker"].send_signal(signal.SIGKILL)
        code = ended(number, 120.0)
        if left := left_after(number, bench.left_s):
            return f"leaves processes {left}"
        if code and which == "worker":
            return f"ends with {code}: {bench.said(job).read_text()[-300:]}"
        if code and (trouble := refused_well(bench, job, code)):
            return trouble
    trouble = bench.resumed(job, folder) if code else ""
    return trouble or ("" if job.result(folder) == whole else "other bytes")


def _digit(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)


def _cut(path: Path) -> None:
    data = path.read_bytes()
    path.write_bytes(data[:len(data) * 2 // 3])


def _twice(path: Path) -> None:
    if path.suffix == ".parquet":
        shutil.copy(path, path.with_name(f"{int(path.stem) + 7:05d}.parquet"))
    else:
        lines = path.read_bytes().splitlines(keepends=True)
        path.write_bytes(b"".join([*lines, lines[-1]]))


def _nan(path: Path) -> None:
    if path.suffix == ".parquet":
        table = pyarrow.parquet.read_table(path)
        place = table.schema.get_field_index("position_rms")
        column = pyarrow.array([float("nan")] * len(table))
        pyarrow.parquet.write_table(table.set_column(place, "position_rms", column), path)
    else:
        lines = path.read_text().splitlines(keepends=True)
        head, _, tail = lines[-1].rpartition(":")
        lines[-1] = f"{head}: NaN, \"more\":{tail}"
        path.write_text("".join(lines))


DAMAGES: dict[str, Callable[[Path], None]] = {
    "a changed digit": _digit, "truncated": _cut, "twice": _twice, "a NaN": _nan, "removed": Path.unlink,
}
# The files that a job goes on with.
KEPT = {"sweep": "mc/sweep/*.parquet", "contest": "kept/matches.journal.jsonl", "tune": "tuned/tuning.journal.jsonl"}


def damaged(bench: Bench, job: Job, whole: bytes, damage: str) -> str:
    """What is wrong when one of a job's files is damaged after it has ended, and it goes on."""
    folder = bench.fresh(job)
    if code := ended(bench.start(job, job.begin, folder)):
        return f"ends with {code}: {bench.said(job).read_text()[-300:]}"
    DAMAGES[damage](min(folder.glob(KEPT[job.name])))
    job.write(folder)
    code = ended(bench.start(job, job.go_on, folder))
    if code:
        return refused_well(bench, job, code)
    return "" if job.result(folder) == whole else "other bytes"


def read_only(bench: Bench, job: Job) -> str | None:
    """What is wrong when the job's disk cannot be written; None where none can be mounted."""
    folder = bench.place / job.name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(folder)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        return None
    try:
        job.write(folder)
        subprocess.run(["mount", "-o", "remount,ro", str(folder)], check=True)
        return refused_well(bench, job, ended(bench.start(job, job.begin, folder)))
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=False)


def main() -> None:
    """Run all of it and print a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--times", type=int, default=4, help="that a worker, and the scheduler, are killed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=20)
    parser.add_argument("--job", choices=KEPT)
    asked = parser.parse_args()
    rng, wrong = random.Random(asked.seed), 0
    with tempfile.TemporaryDirectory(prefix="faults-") as place:
        bench = Bench(Path(place))
        for job in [job for name, job in jobs(asked.size).items() if name in KEPT and asked.job in (None, name)]:
            whole, seconds = bench.whole(job)
            found: dict[str, str | None] = {}
            if job.name == "sweep":
                for which in ("worker", "scheduler"):
                    found |= {f"{which} killed after {after:.1f} s": lost(bench, job, whole, which, after)
                              for after in instants(rng, asked.times, seconds + 3)}
            found |= {damage: damaged(bench, job, whole, damage) for damage in DAMAGES}
            found["a disk that cannot be written"] = read_only(bench, job)
            for what, trouble in found.items():
                words = "skipped: no tmpfs can be mounted here" if trouble is None else trouble or "as it should be"
                print(f"{job.name:10}{what:34}{words}", flush=True)
                wrong += bool(trouble)
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
