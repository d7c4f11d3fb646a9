"""What people wait for, in one table: seconds of the processor of whole commands, and what peers and C take.

    python benchmarks/waiting.py [--full] [--before CHECKOUT] [--modules] [--repeats 2] [--only PART ...]

A command is a process of its own with all that it starts; of its repeats the least counts, since other work on the
machine only adds. `--modules` also says which imports a command waits for. `--full` adds what takes minutes: the long
line, the proofs and certificates of all papers, reports, 64 cars, the peers' MPC, a draw of a contest. `--before` puts
an earlier version beside it in the same run, checked out in a folder: each command is run by both in turn. What that
version could not be asked yet has no figure of it. Compare ratios between machines and versions, not seconds.
"""

from __future__ import annotations

import argparse
import re
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from descendants import adopt
from run_bits import tell_run_bits
from versions import ROOT, Bench, Version, tell

from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import least_time

HILLS, TRAIN = ROOT / "benchmarks" / "lines" / "hills.toml", ROOT / "benchmarks" / "trains" / "yang2021.toml"
TIMETABLE = ROOT / "benchmarks" / "timetables" / "hills.toml"
YANG, EARLIER = ROOT / "proofs" / "yang2021" / "study.toml", ROOT / "benchmarks"
PAPERS = ("yang2021", "jiao2025", "mao2018", "liu2020", "chen2019")
PARTS = ("start-up", "references", "runs", "mpc", "proofs", "reports", "contest")
IMPORT = re.compile(r"import time:\s+(\d+) \|\s+(\d+) \|(\s+)(\S+)")
MOST_MODULES, LEAST_IMPORT_US = 12, 15_000
# With less than this share of the least time the smooth run's acceleration is averaged over a shorter window: near it
# a whole second is more than there is to lose, at every limit of a long line.
TIGHT, TIGHT_WINDOW_S = 1.005, 0.2

# What is measured within a process, as texts for one: seconds of a run and of the same in C (0 without gcc);
# microseconds of a step. `EARLIER_` as a version asks that lacks the benchmark of today.
RUN_OF_PID = """
import json, shutil, tempfile, simulation_speed as m
from pathlib import Path
scenario = m.load_scenario(m.STATED)
name = next(name for name, spec in scenario.controllers.items() if spec.law == "pid")
with tempfile.TemporaryDirectory() as place:
    if shutil.which("gcc"):
        print(json.dumps(m.against_c(scenario, name, m.in_c(Path(place)))))
    else:
        print(json.dumps([m.shortest(lambda: m.simulate(scenario, name))[0], 0]))
"""
EARLIER_RUN_OF_PID = """
import json, simulation_speed as m
m.time.perf_counter = m.time.process_time
print(json.dumps(m.seconds_per_step(m.load_scenario(m.Path(m.__file__).parent / "yang2021.toml"), "pid")[0]))
"""
MPC = """
import importlib.util, json, mpc_speed
peers = {} and importlib.util.find_spec("do_mpc") is not None
print(json.dumps(mpc_speed.measured({}, {!r}, peers)))
"""
CARS = """
import json, numpy, car_speed
print(json.dumps({cars: float(numpy.median(car_speed.loop(cars, 20, 40).taken_us)) for cars in (6, 32, 64)}))
"""
EARLIER_CARS = """
import json, mpc_speed
print(json.dumps({row["cars"]: row["median_us_20"] for row in mpc_speed.car_growth()}))
"""


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
    said = bench.now.once(*arguments, options=("-X", "importtime")).said
    for seconds, name in list(imports(said))[:MOST_MODULES]:
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
    """Help, mistakes, and short commands with all caches filled, and with none."""
    bench.now.once("new-paper", "small2026")
    reference = ("reference", HILLS, TRAIN, "--time", 2600)
    bench.row("help", "--help")
    for verb in (("reference", "nowhere.toml", TRAIN, "--time", 1), ("compare", "nowhere.toml"), ("prove", "nowhere")):
        bench.row(f"{verb[0]}: a mistake", *verb, expected=2)
    bench.row("reference: 50 km, loose", *reference)
    for cold, told in ((False, ""), (True, ", nothing compiled or known")):
        bench.row(f"compare: two laws and MPC, 3 short runs{told}", "compare", "small2026", earlier=(), cold=cold)
        bench.row(f"prove: the same paper, unchanged{told}", "prove", "small2026", earlier=(), cold=cold)
    if modules:
        for command in (reference, ("compare", "small2026"), ("prove", "small2026")):
            print(f"  {command[0]} imports")
            tell_imports(bench, *command)


def references(bench: Bench, full: bool) -> None:
    """Tight and long runs, and one by a timetable."""
    graded = graded_line(bench.now.place / "graded.toml", 30e3, 100)
    lines = [("50 km", HILLS), ("30 km, 100 grades", graded)]
    if full:
        lines.append(("300 km, 3,000 grades", graded_line(bench.now.place / "long.toml", 300e3, 3000)))
    for what, line in lines:
        least = least_time_s(line, TRAIN)
        for share in (1.1, 1.01, 1.001):
            short = ("--window", TIGHT_WINDOW_S) if share < TIGHT else ()
            told = f"reference: {what} at {share} of the least time" + (f", window {TIGHT_WINDOW_S} s" if short else "")
            bench.row(told, "reference", line, TRAIN, "--time", f"{least * share:.3f}", *short,
                      warm=False)
    bench.row("reference: by a timetable", "reference", HILLS, TRAIN, "--timetable", TIMETABLE, warm=False)


def runs(bench: Bench) -> None:
    """A sweep of cheap laws, a run beside the same loop by hand in C, and whether runs are the same as before."""
    named = [word for name in ("pid", "rbf_pid", "pocrac") for word in ("--controller", name)]
    for cold, told in ((False, ""), (True, ", nothing compiled")):
        swept = (*named, "--runs", 32, "--out")
        bench.row(f"sweep: 32 runs of three laws of yang2021{told}", "sweep", YANG, *swept, "mc", cold=cold,
                  earlier=("sweep", EARLIER / "yang2021.toml", *swept, "mc"))
    now, before = bench.values(RUN_OF_PID, EARLIER_RUN_OF_PID)
    if now is not None:
        tell("a run of PID", now[0], before, f"{now[0] / now[1]:.2f} times C" if now[1] else "no gcc: C is left out")
    tell_run_bits(bench)


def mpc(bench: Bench, full: bool) -> None:
    """A step of MPC of one train, easy and at a limit all the way, and of several cars."""
    for horizon, load, peers in ((20, "easy", full), (50, "hard", False)):
        code = MPC.format(peers, horizon, load)
        now, before = ({row["solver"]: row for row in rows or ()} for rows in bench.values(code))
        for solver, row in now.items():
            for key, told in (("median_us", "median"), ("p99_us", "99th percentile")):
                ratio = row[key] / now["linear"][key]
                tell(f"MPC, {horizon} samples, {load}, {solver}: {told}", row[key] / 1e6,
                     before[solver][key] / 1e6 if solver in before else None,
                     f"{ratio:.0f} times the linear one" if solver != "linear" else "")
    now, before = bench.values(CARS, EARLIER_CARS if full else "raise SystemExit(1)")
    for cars, median_us in (now or {}).items():
        earlier = (before or {}).get(cars)
        tell(f"MPC of {cars} cars, 20 samples ahead: median of a step", median_us / 1e6, earlier and earlier / 1e6)


def proofs(bench: Bench, full: bool) -> None:
    """Deciding and checking the papers."""
    here = [ROOT / "proofs" / name for name in (PAPERS if full else ("yang2021",))]
    then = [ROOT / "proofs" / f"{path.name}.py" for path in here]
    what = "the five papers" if full else "yang2021"
    bench.row(f"prove: {what}, unchanged", "prove", *here, earlier=("prove", *then))
    bench.row(f"prove: {what}, nothing known but certificates", "prove", *here, earlier=("prove", *then), cold=True)
    if full:
        bench.row("check-certificates: all papers", "check-certificates", ROOT / "proofs", warm=False,
                  earlier=("check-certificates", ROOT / "proofs" / "certificates"))


def reports(bench: Bench) -> None:
    """Each paper's page as it is made by default, nothing compiled or known."""
    for name in PAPERS:
        bench.row(f"report: {name}, cold", "report", ROOT / "proofs" / name, "--out", "page", cold=True, earlier=(
            "report", EARLIER / f"{name}.toml", ROOT / "proofs" / f"{name}.py", "--out", "page"))


def contest(bench: Bench) -> None:
    """A draw of yang2021's contest, its tuning left out."""
    folder = bench.now.place / "yang2021"
    shutil.copytree(ROOT / "proofs" / "yang2021", folder)
    text = (folder / "contest.toml").read_text(encoding="utf-8")
    taken = []
    for seeds in (2, 4):
        (folder / "contest.toml").write_text(re.sub(r"(?m)^seeds = \d+$", f"seeds = {seeds}", text), encoding="utf-8")
        taken.append(bench.now.once("compare", folder / "contest.toml").cpu_s)
    tell("contest: a draw", (taken[1] - taken[0]) / 2)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--full", action="store_true", help="all of it")
    parser.add_argument("--before", type=Path, metavar="CHECKOUT", help="an earlier version, run beside this one")
    parser.add_argument("--modules", action="store_true", help="imports of the short commands too")
    parser.add_argument("--repeats", type=int, default=2)
    parser.add_argument("--only", nargs="+", metavar="PART", help="of " + ", ".join(PARTS), choices=PARTS)
    asked = parser.parse_args()
    if asked.before is not None and not (asked.before / "workbench").is_dir():
        parser.error(f"--before: {asked.before} is no checkout of the workbench")
    adopt()
    with tempfile.TemporaryDirectory(prefix="waiting-") as place:
        bench = Bench(_version(ROOT, Path(place) / "now"),
                      _version(asked.before.resolve(), Path(place) / "before") if asked.before else None, asked.repeats)
        print(f"{'CPU (s)':62s}{'before':>11s}{'now':>11s}{'ratio':>7s}")
        for part in asked.only or PARTS:
            if part == "start-up":
                start_up(bench, asked.modules)
            elif part == "references":
                references(bench, asked.full)
            elif part == "runs":
                runs(bench)
            elif part == "mpc":
                mpc(bench, asked.full)
            elif part == "proofs":
                proofs(bench, asked.full)
            elif asked.full:
                (reports if part == "reports" else contest)(bench)


def _version(root: Path, place: Path) -> Version:
    place.mkdir()
    return Version(root, place)


if __name__ == "__main__":
    main()
