"""What people wait for, in one table: seconds of the processor of whole commands, and what peers and C take.

    python benchmarks/waiting.py [--full] [--modules] [--repeats 2]

A command is a process of its own with all that it starts; of its repeats the least counts, since other work on the
machine only adds. `--modules` also says which imports a command waits for. `--full` adds what takes minutes: the long
line, the proofs and certificates of all papers, 64 cars, the peers' MPC, a draw of a contest. Compare ratios between
machines and versions, not seconds.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import car_speed
import mpc_speed
import numpy as np
import simulation_speed
from descendants import adopt, seconds_of_all

from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import least_time

ROOT = Path(__file__).resolve().parents[1]
HILLS, TRAIN = ROOT / "benchmarks" / "lines" / "hills.toml", ROOT / "benchmarks" / "trains" / "yang2021.toml"
TIMETABLE = ROOT / "benchmarks" / "timetables" / "hills.toml"
IMPORT = re.compile(r"import time:\s+(\d+) \|\s+(\d+) \|(\s+)(\S+)")
MOST_MODULES, LEAST_IMPORT_US = 12, 15_000
# With less than this share of the least time the smooth run's acceleration is averaged over a shorter window: near it
# a whole second is more than there is to lose, at every limit of a long line.
TIGHT, TIGHT_WINDOW_S = 1.005, 0.2


@dataclass(frozen=True)
class Ended:
    """Seconds of the processor of a command and of what it started, its exit code, and all that it has said."""

    cpu_s: float
    code: int
    said: str


@dataclass(frozen=True)
class Bench:
    """Runs commands in a folder, with the cache in it."""

    place: Path
    repeats: int

    def once(self, *arguments: object, cache: str = "cache", options: tuple[str, ...] = ()) -> Ended:
        """One command. options: of Python."""
        said = self.place / "said.txt"
        # Where modules may not be kept compiled, each command would compile all of them: nobody who works so waits so.
        kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        before = seconds_of_all()
        with said.open("wb") as out:
            process = subprocess.Popen(
                [sys.executable, *options, "-m", "workbench", *map(str, arguments)], cwd=self.place, stdout=out,
                stderr=out, env={**kept, "PYTHONPATH": str(ROOT), "WORKBENCH_CACHE": str(self.place / cache)},
            )
            process.wait()
        return Ended(seconds_of_all() - before, process.returncode, said.read_text(encoding="utf-8"))

    def row(self, what: str, *arguments: object, expected: int = 0, warm: bool = True) -> Ended:
        """The quickest of the repeats, after one that fills the caches; a line of the table. Exits where a command
        ends with another code than expected."""
        if warm:
            self.once(*arguments)
        best = min((self.once(*arguments) for _ in range(self.repeats)), key=lambda ended: ended.cpu_s)
        if best.code != expected:
            sys.exit(f"{what}: ends with {best.code}: {best.said[-500:]}")
        gap = re.search(r"gap (\d\S*) %", best.said)
        tell(what, best.cpu_s, f"gap {gap[1]} %" if gap else "")
        return best

    def cold(self, what: str, *arguments: object, than: float) -> None:
        """A line for the same command with an empty cache. than: what it takes with a full one."""
        shutil.rmtree(self.place / "empty", ignore_errors=True)
        taken = self.once(*arguments, cache="empty").cpu_s
        tell(what, taken, f"{taken / than:.1f} times as long as warm")


def tell(what: str, cpu_s: float, note: str = "") -> None:
    """A line of the table."""
    print(f"{what:58s}{cpu_s:9.3f}  {note}".rstrip(), flush=True)


def imports(said: str) -> Iterator[tuple[float, str]]:
    """Seconds, with all that they import themselves, and names of modules of other packages, from what `-X importtime`
    says; of a package the whole where that is imported."""
    found = {name: int(total) for _, total, _, name in IMPORT.findall(said)}
    for name, total in sorted(found.items(), key=lambda pair: -pair[1]):
        package = name.partition(".")[0]
        if total >= LEAST_IMPORT_US and package != "workbench" and (name == package or package not in found):
            yield total / 1e6, name


def tell_imports(bench: Bench, *arguments: object) -> None:
    """The packages that a command waits for longest."""
    for seconds, name in list(imports(bench.once(*arguments, options=("-X", "importtime")).said))[:MOST_MODULES]:
        tell(f"    import {name}", seconds)


def graded_line(path: Path, length_m: float, grades: int, seed: int = 1) -> Path:
    """A line with so many grades by chance, of up to 8 per mille, and changing speed limits; written to the path."""
    rng, ends = np.random.default_rng(seed), np.linspace(0.0, length_m, grades + 1).tolist()
    steep = rng.uniform(-8.0, 8.0, grades).round(3).tolist()
    fast = rng.choice([25.0, 30.0, 35.0], max(1, grades // 10)).tolist()
    borders = np.linspace(0.0, length_m, len(fast) + 1).tolist()
    rows = [f'name = "{grades} grades by chance"', f"length_m = {length_m}", f"stops_m = [0.0, {length_m}]"]
    rows.append(f"curve = [{{ start_m = 0.0, end_m = {length_m}, radius_m = inf }}]")
    for key, value, at, many in (("grade", "grade_permille", ends, steep), ("speed_limit", "speed_mps", borders, fast)):
        rows.append(f"{key} = [")
        rows += [f"  {{ start_m = {a}, end_m = {b}, {value} = {x} }}," for a, b, x in zip(at, at[1:], many,
                                                                                      strict=False)]
        rows.append("]")
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


def least_time_s(line: Path, train: Path) -> float:
    """The least time in which the train can run on the line."""
    vehicle, _ = load_vehicle(train)
    return least_time(vehicle, course(load_line(line)[0], vehicle)).trip_time_s


def start_up(bench: Bench, modules: bool) -> None:
    """Help, mistakes, and short commands with all caches filled."""
    bench.once("new-paper", "small2026")
    reference = ("reference", HILLS, TRAIN, "--time", 2600)
    bench.row("help", "--help")
    for verb in (("reference", "nowhere.toml", TRAIN, "--time", 1), ("compare", "nowhere.toml"), ("prove", "nowhere")):
        bench.row(f"{verb[0]}: a mistake", *verb, expected=2)
    bench.row("reference: 50 km, loose", *reference)
    compared = bench.row("compare: two laws and MPC, 3 short runs", "compare", "small2026").cpu_s
    proved = bench.row("prove: an unchanged paper", "prove", "small2026").cpu_s
    bench.cold("compare: the same, nothing compiled", "compare", "small2026", than=compared)
    bench.cold("prove: the same, nothing known", "prove", "small2026", than=proved)
    if modules:
        for command in (reference, ("compare", "small2026"), ("prove", "small2026")):
            print(f"  {command[0]} imports")
            tell_imports(bench, *command)


def references(bench: Bench, full: bool) -> None:
    """Tight and long runs, and one by a timetable."""
    graded = graded_line(bench.place / "graded.toml", 30e3, 100)
    lines = [("50 km", HILLS), ("30 km, 100 grades", graded)]
    if full:
        lines.append(("300 km, 3,000 grades", graded_line(bench.place / "long.toml", 300e3, 3000)))
    for what, line in lines:
        least = least_time_s(line, TRAIN)
        for share in (1.1, 1.01, 1.001):
            short = ("--window", TIGHT_WINDOW_S) if share < TIGHT else ()
            told = f"reference: {what} at {share} of the least time" + (f", window {TIGHT_WINDOW_S} s" if short else "")
            bench.row(told, "reference", line, TRAIN, "--time", f"{least * share:.3f}", *short,
                      warm=False)
    bench.row("reference: by a timetable", "reference", HILLS, TRAIN, "--timetable", TIMETABLE, warm=False)


def runs(bench: Bench) -> None:
    """A sweep of cheap laws, and a run beside the same loop by hand in C."""
    bench.row("sweep: 32 runs of three controllers", "sweep", "small2026", "--runs", 32, "--out", "mc")
    if shutil.which("gcc"):
        scenario = simulation_speed.load_scenario(simulation_speed.STATED)
        name = next(name for name, spec in scenario.controllers.items() if spec.law == "pid")
        ours, in_c = simulation_speed.against_c(scenario, name, simulation_speed.in_c(bench.place))
        tell("a run of PID", ours, f"{ours / in_c:.2f} times C")


def mpc(full: bool) -> None:
    """A step of MPC of one car and of several."""
    for cars in (6, 64):
        taken = car_speed.loop(cars, 20, 40).taken_us
        tell(f"MPC of {cars} cars, 20 samples ahead: median of a step", float(np.median(taken)) / 1e6)
    rows = {row["solver"]: row["median_us"] for row in mpc_speed.measured(20, "easy", full)}
    for solver, median_us in rows.items():
        tell(f"MPC of one train, {solver}: median of a step", median_us / 1e6,
             f"{median_us / rows['linear']:.0f} times the linear one" if solver != "linear" else "")


def proofs(bench: Bench, full: bool) -> None:
    """Deciding and checking the papers."""
    papers = ROOT / "proofs" if full else ROOT / "proofs" / "slotine1987"
    what = "all papers" if full else papers.name
    warm = bench.row(f"prove: {what}, unchanged", "prove", papers).cpu_s
    bench.cold(f"prove: {what}, by the certificates at hand", "prove", papers, than=warm)
    bench.row(f"check-certificates: {what}", "check-certificates", papers, warm=False)


def contest(bench: Bench) -> None:
    """A draw of yang2021's contest, its tuning left out."""
    folder = bench.place / "yang2021"
    shutil.copytree(ROOT / "proofs" / "yang2021", folder)
    text = (folder / "contest.toml").read_text(encoding="utf-8")
    taken = []
    for seeds in (2, 4):
        (folder / "contest.toml").write_text(re.sub(r"(?m)^seeds = \d+$", f"seeds = {seeds}", text), encoding="utf-8")
        taken.append(bench.once("compare", folder / "contest.toml").cpu_s)
    tell("contest: a draw", (taken[1] - taken[0]) / 2)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--full", action="store_true", help="all of it")
    parser.add_argument("--modules", action="store_true", help="imports of the short commands too")
    parser.add_argument("--repeats", type=int, default=2)
    asked = parser.parse_args()
    adopt()
    with tempfile.TemporaryDirectory(prefix="waiting-") as place:
        bench = Bench(Path(place), asked.repeats)
        print(f"{'':58s}  CPU (s)")
        start_up(bench, asked.modules)
        references(bench, asked.full)
        runs(bench)
        mpc(asked.full)
        proofs(bench, asked.full)
        if asked.full:
            contest(bench)


if __name__ == "__main__":
    main()
