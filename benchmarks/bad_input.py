"""Bad input for every verb and kind of file: each case ends well or is refused in one clear line.

    python benchmarks/bad_input.py [--cases 20000] [--seed 1] [--apart 200] [--verb VERB] [--only NUMBER]
                                   [--faults FOLDER]

A case is a folder of small valid inputs in which one file or argument is spoiled (`bad_files`, `bad_input_folders`),
and a command that reads it. Demanded: exit code 0, or 1 where the verb says by it what it found, or 2 with one line
that names the file or option within 5 s of processor time; no traceback; at most 1 GB; nothing written but the outputs
asked for, nothing removed. What is accepted is run, and must end within 24 s. Each case is run in a process that is
forked from one that has imported everything, `--apart` of them by a Python of their own. Interrupted it tells of the
cases so far. Exit code 1 when there is a fault.
"""

from __future__ import annotations

import argparse
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

for limit in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ.setdefault(limit, "1")

from bad_files import HOSTILE_NUMBERS, HOSTILE_TEXTS, spoil  # noqa: E402
from bad_input_folders import COMMANDS, Command, write_folders  # noqa: E402
from forked import forked, import_everything  # noqa: E402

ROOT = Path(__file__).parents[1]
SECONDS, GIGABYTE, GRACE = 5.0, 10**9, 25
LONGEST_LINE = 2000
ARGUMENT = "argument"
BOUNDS = (
    "--fleet", "--time", "--intervals", "--window", "--dwell", "--every", "--from", "--to-m", "--max-jerk", "--runs",
    "--seed", "--workers", "--limit", "--seconds", "--until-width", "--draws", "--bogus", "--json", "--out", "--csv",
    "--figure", "--controller", "--claim-digest", "--paper", "--certificates", "--solver", "--help",
    "--version", "--plant", "--record", "--rare", "--search", "--symbols", "--etcs", "--full", "--write", "--resume",
)


@dataclass(frozen=True)
class Case:
    """One bad input: `spoiled` is a file of the command's folder, or `argument`."""

    command: Command
    spoiled: str
    seed: int

    @property
    def kind(self) -> str:
        """The kind of what is spoiled."""
        return self.spoiled if self.spoiled == ARGUMENT else Path(self.spoiled).name


@dataclass(frozen=True)
class Ended:
    """How a case ended: its exit code (negative: the signal), what it said, what it cost, what it changed."""

    how: str
    line: list[str]
    code: int
    said: str
    seconds: float
    bytes: int
    changed: list[str]


def cases(count: int, seed: int, commands: Sequence[Command] = COMMANDS) -> Iterator[Case]:
    """So many cases of some commands, drawn by their weights."""
    rng = random.Random(seed)
    chosen = [(command, spoiled) for command in commands for spoiled in (*command.reads, *command.reads, ARGUMENT)]
    weights = [command.weight for command, _ in chosen]
    for command, spoiled in rng.choices(chosen, weights, k=count):
        yield Case(command, spoiled, rng.randrange(2**32))


def spoiled_arguments(rng: random.Random, command: Command) -> list[str]:
    """The command line with an argument replaced, doubled, dropped or added."""
    found = list(command.arguments)
    place = rng.randrange(1, len(found))
    value = rng.choice(
        (
            *HOSTILE_TEXTS, *map(str, HOSTILE_NUMBERS), *command.reads, "1e9", "100000", "-5", "9" * 400, "study.toml",
            ".", "/", "/proc/self/mem", "/dev/full", "nowhere", "out\nfile", "a" * 300, "-",
            "tcp://127.0.0.1:1", "position_rms>1e-300", "position_rms=1e-300",
        )
    )
    match rng.choice(("replace", "replace", "drop", "twice", "add", "add", "option")):
        case "replace":
            found[place] = value
        case "drop":
            del found[place]
        case "twice":
            found.insert(place, found[place])
        case "add":
            found += [rng.choice(BOUNDS), value]
        case _:
            found.insert(place, rng.choice(BOUNDS))
    found = [one.replace("\0", "").encode("utf-8", "replace").decode()[:100_000] for one in found]
    return [_few_runs(option, one) for option, one in pairwise(["", *found])]


def _few_runs(option: str, value: str) -> str:
    """A number of runs that may be asked for, and would take hours, as one that takes seconds."""
    try:
        return "3" if option == "--runs" and 3 < float(value) <= 10**9 else value
    except ValueError:
        return value


def prepared(case: Case, folders: Path, place: Path) -> tuple[str, list[str]]:
    """A folder for the case, what was done to it, and the arguments."""
    if place.exists():
        shutil.rmtree(place)
    shutil.copytree(folders / case.command.folder, place, symlinks=True)
    rng = random.Random(case.seed)
    if case.spoiled == ARGUMENT:
        return ARGUMENT, spoiled_arguments(rng, case.command)
    return spoil(rng, place / case.spoiled), list(case.command.arguments)


def pictures(folder: Path) -> dict[str, tuple[int, int, int]]:
    """Every file and folder below a folder, by what a change to it would change."""
    return {str(path.relative_to(folder)): _picture(path) for path in folder.rglob("*")}


def _picture(path: Path) -> tuple[int, int, int]:
    status = path.lstat()
    return (status.st_mode, 0, 0) if path.is_dir() else (status.st_mode, status.st_size, status.st_mtime_ns)


def run(case: Case, folders: Path, place: Path, apart: bool = False) -> Ended:
    """Run a case: by a fork of this process, or by a Python of its own."""
    how, arguments = prepared(case, folders, place)
    before, outside = pictures(place), pictures_outside(place)
    said = place.parent / "said"
    begun = time.monotonic()
    number = _by_python(arguments, place, said) if apart else forked(arguments, place, said, first=_limited)
    status, used = _ended(number, begun)
    text = said.read_bytes().decode(errors="replace")
    after = pictures(place)
    changed = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
    wanted = (*case.command.outputs, *_outputs_of(arguments))
    beyond = [
        name
        for name in changed
        if not any(
            one in (".", name) or name.startswith((f"{one}/", f"{one}.before")) or one.startswith(f"{name}/")
            for one in wanted
        )
        and not name.startswith("__pycache__")
    ]
    if ".." not in wanted:
        beyond += [f"outside: {name}" for name in sorted(pictures_outside(place).items() ^ outside.items())]
    base = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss if not apart else 0
    code = os.waitstatus_to_exitcode(status)
    return Ended(
        how, arguments, code, text, used.ru_utime + used.ru_stime, max(0, used.ru_maxrss - base) * 1024, beyond
    )


def _outputs_of(arguments: list[str]) -> list[str]:
    """What options of the command line name as outputs."""
    options = ("--json", "--out", "--csv", "--figure", "--certificate", "--certificates")
    named = [os.path.normpath(value) for option, value in pairwise(arguments) if option in options]
    named += map(os.path.normpath, arguments[1:2] if arguments[0] == "examples" else ())
    # A reference writes its curves beside the file that is named, under the same stem.
    return [*named, *(str(Path(one).with_suffix("")) + end for one in named
                      if Path(one).name for end in (".csv", "_certified.csv"))]


def pictures_outside(place: Path) -> dict[str, tuple[int, int]]:
    """What stands beside the case's folder, where `../escaped` would lie."""
    return {
        one.name: (one.lstat().st_size, one.lstat().st_mtime_ns)
        for one in place.parent.iterdir()
        if one != place and one.name != "said"
    }


def _limited() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (8 * GIGABYTE, 8 * GIGABYTE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (GRACE, GRACE))


def _by_python(arguments: list[str], place: Path, said: Path) -> int:
    with said.open("wb") as stream:
        process = subprocess.Popen(
            [sys.executable, "-m", "workbench", *arguments], cwd=place, stdout=stream, stderr=stream,
            stdin=subprocess.DEVNULL, preexec_fn=_limited,  # noqa: PLW1509 - there are no threads here
 start_new_session=True,
            env=os.environ | {"PYTHONPATH": str(ROOT)},
        )
    process.returncode = 0  # waited for by its number
    return process.pid


def _ended(number: int, begun: float) -> tuple[int, resource.struct_rusage]:
    """Wait for a process, and end it with its children where it takes too long."""
    while True:
        done, status, used = os.wait4(number, os.WNOHANG)
        if done:
            return status, used
        if time.monotonic() - begun > 40 * GRACE:  # of a machine that others use: its processor time is limited
            os.killpg(number, signal.SIGKILL)
        time.sleep(0.002)


def faults(case: Case, ended: Ended) -> list[str]:
    """What is wrong with how a case ended; empty where nothing is."""
    lines = [line for line in ended.said.splitlines() if line.strip()]
    found = []
    if "Traceback (most recent call last)" in ended.said:
        found.append(f"traceback: {lines[-1][:200]}")
    elif ended.code not in (0, 1, 2) or (ended.code == 1 and not case.command.one_is_fine):
        found.append(f"exit code {ended.code}")
    refusals = [line for line in lines if line.startswith("workbench: ") and not line.startswith("workbench: note:")]
    misstated = [line for line in lines if line.startswith("misstated: ")]
    if ended.code == 2 and not found:
        if len(refusals) != 1 and not misstated:
            found.append(f"{len(refusals)} lines of refusal")
        for line in refusals + misstated:
            if len(line) > LONGEST_LINE:
                found.append(f"a line of {len(line)} characters")
            if not line.isprintable():
                found.append("a line that cannot be printed")
            if line.count(": ") < 2:
                found.append("a line without place or remedy")
            if case.spoiled != ARGUMENT and not any(name in line for name in _names(case)):
                found.append("a line that names no file")
    if ended.seconds > (SECONDS if ended.code == 2 else GRACE - 1):
        found.append(f"more than {SECONDS if ended.code == 2 else GRACE - 1:g} s")
    if ended.bytes > GIGABYTE:
        found.append("more than 1 GB")
    if ended.changed:
        found.append(f"changed {', '.join(ended.changed[:3])}")
    return found


def _names(case: Case) -> set[str]:
    """What a refusal may name: any file of the command, since what is spoiled in one may show in another."""
    named = {Path(name).name for name in case.command.reads} | {f"{one}: " for one in case.command.arguments}
    return named | {"claim small2030:", "claims/rows.py"}


@dataclass
class Row:
    """A line of the table."""

    cases: int = 0
    accepted: int = 0
    refused: int = 0
    faults: int = 0
    slowest_s: float = 0.0
    seconds: float = 0.0

    def add(self, ended: Ended, wrong: bool) -> None:
        """Count a case."""
        self.cases += 1
        self.accepted += ended.code in (0, 1)
        self.refused += ended.code == 2
        self.faults += wrong
        self.slowest_s = max(self.slowest_s, ended.seconds)
        self.seconds += ended.seconds


def main() -> None:
    """Run the cases and print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--cases", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--apart", type=int, default=200, help="of them by a process of their own")
    parser.add_argument("--verb", help="only of this one")
    parser.add_argument("--only", type=int, help="of all these the one case whose line begins with this number")
    parser.add_argument("--faults", type=Path, help="a folder for the folders of cases with faults")
    parser.add_argument("--folders", type=Path, help="a folder for the valid inputs, made where it is missing")
    asked = parser.parse_args()
    # A shell's background job is started with SIGINT ignored, which ends this with its table.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    import_everything()
    commands = [command for command in COMMANDS if asked.verb in (None, command.verb)]
    table: dict[tuple[str, str], Row] = defaultdict(Row)
    kinds: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="bad-input-") as work:
        folders = asked.folders or Path(work) / "valid"
        if not folders.exists():
            folders.mkdir(parents=True)
            write_folders(folders)
        place = Path(work) / "case" / "here"
        place.parent.mkdir()
        with suppress(KeyboardInterrupt):
            for number, case in enumerate(cases(asked.cases, asked.seed, commands)):
                if asked.only not in (None, case.seed):
                    continue
                if number % 500 == 499:
                    print(f"{number + 1} of {asked.cases}", file=sys.stderr, flush=True)
                apart = asked.apart > 0 and number % max(1, asked.cases // asked.apart) == 0
                ended = run(case, folders, place, apart)
                wrong = faults(case, ended)
                table[case.command.verb, case.kind].add(ended, bool(wrong))
                if wrong:
                    kinds.update(one.split(":")[0] for one in wrong)
                    print(
                        f"{case.seed} {' '.join(ended.line)[:150]!r} {case.spoiled} ({ended.how}): {'; '.join(wrong)} "
                        f"[{ended.code}, {ended.seconds:.1f} s] {ended.said.strip()[-200:]!r}",
                        flush=True,
                    )
                    if asked.faults:
                        shutil.copytree(place, asked.faults / f"{number}", symlinks=True, dirs_exist_ok=True)
    print(
        f"\n{'verb':20}{'spoiled':28}{'cases':>7}{'accepted':>10}{'refused':>9}{'faults':>8}{'slowest':>9}{'in all':>9}"
    )
    for (verb, kind), row in sorted(table.items()):
        print(
            f"{verb:20}{kind:28}{row.cases:>7}{row.accepted:>10}{row.refused:>9}{row.faults:>8}"
            f"{row.slowest_s:>7.1f} s{row.seconds:>7.0f} s"
        )
    total = sum((row.faults for row in table.values()), 0)
    print(f"{sum(row.cases for row in table.values())} cases, {total} with faults: {dict(kinds)}")
    sys.exit(total > 0)


if __name__ == "__main__":
    main()
