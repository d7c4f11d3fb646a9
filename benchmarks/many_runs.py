"""A large Monte Carlo of one paper's law: how many drawn trains leave its barrier, what a run costs beside its kernel,
and how much memory the processes take from beginning to end.

    python benchmarks/many_runs.py [--runs 1000000] [--workers 2] [--cruise 9.85] [--out FOLDER]

POCRAC of yang2021 as printed, its estimates advanced after the command (explicit Euler) and sampled every 10 ms, from
stop to stop on 600 m of level line; train and resistance are drawn as the paper states, within 10 %. At that sampling
the adaptation is unstable above some speed, and cruising just below it only some trains leave the barrier: `--cruise`
says how many. Printed: the share with Wilson's interval, processor time a run, that of the kernel alone in this
process, and what the parent and the largest worker have in memory over time.
"""

from __future__ import annotations

import argparse
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pyarrow.parquet
from descendants import adopt, seconds_of_all

from workbench.simulate.closed_loop import prepared
from workbench.simulate.draws import factors_of
from workbench.simulate.setting import setting_of
from workbench.trains.scenario import load_scenario

ROOT = Path(__file__).resolve().parents[1]
PAPER = ROOT / "proofs" / "yang2021"
NAME = "pocrac"
LINE = """\
name = "600 m"
length_m = 600.0
grade = [{ start_m = 0.0, end_m = 600.0, grade_permille = 0.0 }]
curve = [{ start_m = 0.0, end_m = 600.0, radius_m = inf }]
"""
REFERENCE = """\
[reference]
kind = "cruise_speed"
cruise_mps = {cruise}
acceleration_mps2 = 0.48
braking_mps2 = 0.5
ramp_s = 8.0

"""
KERNEL_RUNS, SAMPLES, NORMAL_95 = 2000, 20, 1.959963984540054


def write_scenario(folder: Path, cruise: float) -> Path:
    """A copy of the paper's folder whose study has this line, speed, law and sampling."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("laws.py", "network.py", "rbf_pid.py"):
        shutil.copy(PAPER / name, folder)
    text = (PAPER / "study.toml").read_text(encoding="utf-8")
    tables = re.split(r"^(?=\[)", text, flags=re.MULTILINE)
    wanted = [
        table for table in tables if table.startswith(("version", "[train", "[simulation", "[disturbance",
                                                       f"[controllers.{NAME}", "[uncertainty"))
    ]
    text = "".join([*wanted, REFERENCE.format(cruise=cruise)])
    for old, new in (("reproduction = true\n", ""), ('"line.toml"', '"short.toml"'), ("plant_step_s = 0.001",
                     "plant_step_s = 0.01"), ("period_s = 0.001", "period_s = 0.01"), ('"corrected"', '"explicit"')):
        text = text.replace(old, new)
    (folder / "short.toml").write_text(LINE, encoding="utf-8")
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def kernel_seconds(path: Path) -> float:
    """Processor time of a run's kernel alone: the setting is made before, and nothing is measured of the run."""
    scenario = load_scenario(path)
    drive, nominal = prepared(scenario, NAME), setting_of(scenario)
    settings = [setting_of(scenario, factors, nominal) for factors in factors_of(scenario, 0, KERNEL_RUNS)]
    drive(nominal)
    begun = time.process_time()
    for setting in settings:
        drive(setting)
    return (time.process_time() - begun) / KERNEL_RUNS


def mebibytes(number: int) -> float | None:
    """What a process has in memory; None where it is gone."""
    try:
        text = Path(f"/proc/{number}/status").read_text(encoding="utf-8")
    except OSError:
        return None
    found = re.search(r"VmRSS:\s+(\d+) kB", text)
    return int(found[1]) / 1024 if found else None


def below(number: int) -> list[int]:
    """The processes that a process has started, and those that they have."""
    try:
        lists = [path.read_text().split() for path in Path(f"/proc/{number}/task").glob("*/children")]
    except OSError:  # it has ended
        return []
    found = [int(one) for numbers in lists for one in numbers]
    return [*found, *(further for one in found for further in below(one))]


def watched(command: list[str], every_s: float) -> tuple[float, list[tuple[float, float, float]]]:
    """Processor seconds of a command with its processes, and (seconds, parent, largest worker) over time, in MiB."""
    adopt()
    process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": str(ROOT)}, stderr=subprocess.DEVNULL)
    begun, seen = time.monotonic(), list[tuple[float, float, float]]()
    while process.poll() is None:
        time.sleep(every_s)
        parent = mebibytes(process.pid)
        if parent is not None:
            workers = [size for child in below(process.pid) if (size := mebibytes(child)) is not None]
            seen.append((time.monotonic() - begun, parent, max(workers, default=0.0)))
            every_s = max(every_s, seen[-1][0] / 60)
    if process.returncode:
        raise RuntimeError(f"{' '.join(command)} ends with {process.returncode}")
    return seconds_of_all(), seen


def wilson(count: int, runs: int) -> tuple[float, float]:
    """The 95 % interval of a share (Wilson 1927)."""
    z2 = NORMAL_95**2
    middle = (count + z2 / 2) / (runs + z2)
    half = NORMAL_95 / (runs + z2) * math.sqrt(count * (runs - count) / runs + z2 / 4)
    return middle - half, middle + half


def failed_in(folder: Path) -> tuple[int, int]:
    """How many of the rows in a sweep's chunks failed, and how many there are."""
    failed = rows = 0
    for chunk in sorted((folder / "sweep").glob("*.parquet")):
        column = pyarrow.parquet.read_table(chunk, columns=["failed"])["failed"]
        failed, rows = failed + len(column) - column.null_count, rows + len(column)
    return failed, rows


def main() -> None:
    """Run it and print what it took and says."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--runs", type=int, default=1_000_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--cruise", type=float, default=9.85)
    parser.add_argument("--out", type=Path, help="a folder for the rows; default: one that is removed")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="many-runs-") as place:
        path = write_scenario(Path(place) / "yang2021", asked.cruise)
        out = asked.out or Path(place) / "out"
        kernel = kernel_seconds(path)
        begun = time.monotonic()
        command = [sys.executable, "-m", "workbench", "sweep", str(path), "--runs", str(asked.runs), "--workers",
                   str(asked.workers), "--out", str(out)]
        used, seen = watched(command, 0.5)
        wall = time.monotonic() - begun
        failed, rows = failed_in(out)
        low, high = wilson(failed, rows)
        print(f"{failed} of {rows} runs leave the barrier: {failed / rows:.6f}, 95 % interval {low:.6f} to {high:.6f}")
        each = used / rows
        print(f"processor time {used:.0f} s in {wall:.0f} s, {1e3 * each:.3f} ms a run, of which the kernel takes "
              f"{1e3 * kernel:.3f} ms: {1e3 * (each - kernel):.3f} ms beside it")
        print(f"{'after':>8}{'parent':>12}{'worker':>12}")
        for after, parent, worker in seen[:: max(1, len(seen) // SAMPLES)]:
            print(f"{after:>6.0f} s{parent:>8.0f} MiB{worker:>8.0f} MiB")
        print(f"at most {max(row[1] for row in seen):.0f} and {max(row[2] for row in seen):.0f} MiB")


if __name__ == "__main__":
    main()
