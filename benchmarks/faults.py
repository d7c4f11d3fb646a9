"""What happens to long commands that are killed, interrupted, or find their disk full: nothing that was done is lost.

    python benchmarks/faults.py [--kills 20] [--signals 4] [--seed 1] [--job JOB]

Sweeps of trains (in processes, and on a Dask cluster that it starts) and of a plant, a contest, a proof and a search
for parameters are run whole; then again and again, killed with SIGKILL at instants spread by chance over that time, and
resumed. Demanded: the bytes of the whole run, and no process left after 10 s. Likewise after SIGINT and SIGTERM, which
end with 130, and where one of the worker processes is killed, which a command survives or says in a line. A second
writer is turned away, and on a small disk (a tmpfs, where one can be mounted) each ends with one line and goes on once
there is room. Exit code 1 when something differs.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from forked import forked
from long_jobs import Job, jobs

from workbench.files.folder_lock import FolderLock

ROOT = Path(__file__).parents[1]
LEFT_S, LONGEST_S = 10.0, 600.0


@dataclass(frozen=True)
class Bench:
    """Where jobs are run; by_fork: without a start of Python; left_s: how long what was stopped may take to end."""

    place: Path
    by_fork: bool = False
    left_s: float = LEFT_S

    def fresh(self, job: Job) -> Path:
        """A new folder with the job's inputs."""
        folder = self.place / job.name
        if folder.exists():
            shutil.rmtree(folder)
        folder.mkdir(parents=True)
        job.write(folder)
        return folder

    def start(self, job: Job, line: str, folder: Path) -> int:
        """The number of a process, the first of its session, that runs a command."""
        own = {"WORKBENCH_CACHE": str(folder / "cache")} if job.own_cache else {}
        if self.by_fork:
            return forked(line.split(), folder, self.said(job), own)
        with self.said(job).open("wb") as said:
            process = subprocess.Popen(
                [sys.executable, "-m", "workbench", *line.split()], cwd=folder, stdout=said, stderr=said,
                env={**os.environ, "PYTHONPATH": str(ROOT), **own}, start_new_session=True,
            )
        process.returncode = 0  # waited for below
        return process.pid

    def said(self, job: Job) -> Path:
        """What the last command of a job has said."""
        return self.place / f"{job.name}.txt"

    def whole(self, job: Job) -> tuple[bytes, float]:
        """What an uninterrupted run makes, and how long it takes."""
        folder, begun = self.fresh(job), time.monotonic()
        code = ended(self.start(job, job.begin, folder))
        if code:
            raise RuntimeError(f"{job.name} ends with {code}: {self.said(job).read_text()}")
        return job.result(folder), time.monotonic() - begun

    def stopped(self, job: Job, after_s: float, how: signal.Signals) -> str:
        """Run a job, stop it after so many seconds, and resume it; what is wrong, empty where nothing is."""
        folder = self.fresh(job)
        number = self.start(job, job.begin, folder)
        time.sleep(after_s)
        os.kill(number, how)
        code = ended(number, self.left_s)
        if code not in (0, 130, -how):  # by the signal itself where it comes before or after all work
            return f"ends with {code}: {self.said(job).read_text()[-300:]}"
        if left := left_after(number, self.left_s):
            return f"leaves processes {left}"
        return "" if code == 0 else self.resumed(job, folder)

    def resumed(self, job: Job, folder: Path) -> str:
        """Go on with a job; what is wrong, empty where nothing is."""
        code = ended(self.start(job, job.go_on, folder))
        return "" if code == 0 else f"resumes with {code}: {self.said(job).read_text()[-300:]}"


def ended(number: int, within_s: float = LONGEST_S) -> int:
    """The exit code of a process, or minus the signal that ended it; it is killed where it takes longer."""
    until = time.monotonic() + within_s
    while True:
        done, status = os.waitpid(number, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        if time.monotonic() > until:
            os.killpg(number, signal.SIGKILL)
            os.waitpid(number, 0)
            return -999
        time.sleep(0.01)


def left_after(session: int, within_s: float) -> list[int]:
    """Processes of a session that are there after so many seconds."""
    until = time.monotonic() + within_s
    while (left := list(of_session(session))) and time.monotonic() < until:
        time.sleep(0.05)
    return left


def of_session(session: int) -> Iterator[int]:
    """The processes of a session that have not ended."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                state, _, _, of = (entry / "stat").read_text().rpartition(") ")[2].split()[:4]
            except OSError:
                continue
            if int(of) == session and state != "Z":
                yield int(entry.name)


def trouble_of(bench: Bench, job: Job, whole: bytes, after_s: float, how: signal.Signals) -> str:
    """What is wrong after a job was stopped and resumed, empty where nothing is."""
    return bench.stopped(job, after_s, how) or ("" if job.result(bench.place / job.name) == whole else "other bytes")


def instants(rng: random.Random, count: int, seconds: float) -> list[float]:
    """One instant by chance in each of so many equal parts of a duration."""
    return [seconds * (part + rng.random()) / count for part in range(count)]


def worker_lost(bench: Bench, job: Job, whole: bytes, after_s: float) -> str:
    """What is wrong after the busiest of a job's worker processes was killed: it goes on, or says so in a line and goes
    on when it is asked to."""
    folder = bench.fresh(job)
    number = bench.start(job, job.begin, folder)
    until = time.monotonic() + after_s
    while time.monotonic() < until or not (busy := [one for one in of_session(number) if one != number]):
        if time.monotonic() > until + LEFT_S:
            break
        time.sleep(0.02)
    if busy:
        with suppress(ProcessLookupError):
            os.kill(max(busy, key=_ticks), signal.SIGKILL)
    code = ended(number)
    said = [line for line in bench.said(job).read_text().splitlines() if line.startswith("workbench: ")]
    if code not in (0, 2) or (code == 2 and sum(": note: " not in line for line in said) != 1):
        return f"ends with {code}: {bench.said(job).read_text()[-300:]}"
    if left := left_after(number, bench.left_s):
        return f"leaves processes {left}"
    trouble = bench.resumed(job, folder) if code else ""
    return trouble or ("" if job.result(folder) == whole else "other bytes")


def _ticks(number: int) -> int:
    """The processor time of a process; none of one that has ended."""
    try:
        fields = Path(f"/proc/{number}/stat").read_text().rpartition(") ")[2].split()
    except OSError:
        return 0
    return int(fields[11]) + int(fields[12])


def second_writer(bench: Bench, job: Job) -> str:
    """What is wrong when a job's results are being written by another process, which holds the lock of their folder."""
    folder = bench.fresh(job)
    (folder / job.keeps).mkdir()
    other = _holder(folder / job.keeps)
    code = ended(bench.start(job, job.begin, folder))
    os.kill(other, signal.SIGKILL)
    os.waitpid(other, 0)
    said = bench.said(job).read_text()
    if code != 2 or "another command writes its results here" not in said:
        return f"ends with {code}: {said[-300:]}"
    return bench.resumed(job, folder)


def _holder(folder: Path) -> int:
    """A process that holds the lock of a folder until it is killed."""
    told, tells = os.pipe()
    number = os.fork()
    if not number:
        lock = FolderLock(folder)
        os.write(tells, b"held")
        while lock:
            signal.pause()
    os.read(told, 4)
    os.close(told)
    os.close(tells)
    return number


# What a job finds free beside its inputs, in KiB: for what it writes is small, less than all of it needs.
ROOM = {"sweep": 28, "plant": 28, "contest": 28, "tune": 4, "dask": 28}


def full_disk(bench: Bench, job: Job, whole: bytes) -> str | None:
    """What is wrong when a job's disk becomes full and has room again; None where none can be mounted."""
    folder = bench.place / job.name
    if folder.exists():
        shutil.rmtree(folder)
    folder.mkdir(parents=True)
    mount = ["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", str(folder)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        return None
    try:
        job.write(folder)
        space = os.statvfs(folder)
        size = (space.f_blocks - space.f_bfree) * space.f_frsize + ROOM[job.name] * 1024
        subprocess.run(["mount", "-o", f"remount,size={size}", str(folder)], check=True)
        code = ended(bench.start(job, job.begin, folder))
        lines = [
            line
            for line in bench.said(job).read_text().splitlines()
            if line.startswith("workbench: ") and "note" not in line
        ]
        if code == 0:
            return "the disk was not full"
        if code != 2 or len(lines) != 1:
            return f"ends with {code}: {bench.said(job).read_text()[-300:]}"
        subprocess.run(["mount", "-o", "remount,size=64m", str(folder)], check=True)
        return bench.resumed(job, folder) or ("" if job.result(folder) == whole else "other bytes")
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=False)


def main() -> None:
    """Run all of it and print a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--signals", type=int, default=4, help="of SIGINT and SIGTERM each")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=20)
    parser.add_argument("--job")
    asked = parser.parse_args()
    # A shell's background job is started with SIGINT ignored, and so would be what is started from here.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    rng, wrong = random.Random(asked.seed), 0
    with tempfile.TemporaryDirectory(prefix="faults-") as place:
        bench = Bench(Path(place))
        for job in jobs(asked.size).values():
            if asked.job not in (None, job.name):
                continue
            whole, _ = bench.whole(job)
            again, seconds = bench.whole(job)
            print(
                f"{job.name}: {seconds:.1f} s uninterrupted{'' if whole == again else ', and other bytes each time'}",
                flush=True,
            )
            for how, count in (
                (signal.SIGKILL, asked.kills),
                (signal.SIGINT, asked.signals),
                (signal.SIGTERM, asked.signals),
            ):
                found = {after: trouble_of(bench, job, whole, after, how) for after in instants(rng, count, seconds)}
                bad = {after: trouble for after, trouble in found.items() if trouble}
                wrong += len(bad)
                print(f"  {how.name:10}{len(found) - len(bad)} of {len(found)} end in the same bytes", flush=True)
                for after, trouble in bad.items():
                    print(f"    after {after:.2f} s: {trouble}", flush=True)
            if "--workers 1" not in job.begin and "--dask" not in job.begin:
                lost = {after: worker_lost(bench, job, whole, after) for after in instants(rng, asked.signals, seconds)}
                bad = {after: trouble for after, trouble in lost.items() if trouble}
                wrong += len(bad)
                print(f"  worker lost {len(lost) - len(bad)} of {len(lost)} end in the same bytes", flush=True)
                for after, trouble in bad.items():
                    print(f"    after {after:.2f} s: {trouble}", flush=True)
            others = (
                {}
                if job.own_cache
                else {"second writer": second_writer(bench, job), "full disk": full_disk(bench, job, whole)}
            )
            for what, trouble in others.items():
                wrong += bool(trouble)
                words = "skipped: no tmpfs can be mounted here" if trouble is None else trouble or "as it should be"
                print(f"  {what:20}{words}", flush=True)
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
