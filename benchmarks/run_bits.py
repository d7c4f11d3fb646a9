"""Whether runs leave in their logs what an earlier version left, bit for bit: of every controller of the same files."""

from __future__ import annotations

import shutil
from pathlib import Path

from versions import ROOT, Bench, Version

# The files of both versions; names of laws as they were and are.
YANG = ("benchmarks/yang2021.toml", "proofs/yang2021/study.toml")
COMMON, RENAMED = "common_run.toml", {'law = "rbf_pid"': 'law = "yang2021.rbf_pid"'}
DIGESTS = """
import hashlib, json, numpy, simulation_speed as m
from pathlib import Path
scenario, found = m.load_scenario(Path({!r})), {{}}
for name in scenario.controllers:
    run = m.simulate(scenario, name)
    found[name] = hashlib.sha256(numpy.ascontiguousarray(run.log).tobytes()).hexdigest()
print(json.dumps(found))
"""


def tell_run_bits(bench: Bench) -> None:
    """A line for each file: of how many controllers the whole log is the same, and of which it is not."""
    if bench.before is None:
        return
    then = bench.before.root
    files = [(then / YANG[0], ROOT / YANG[1])]
    if (then / "benchmarks" / COMMON).is_file():
        files.append((then / "benchmarks" / COMMON, _carried(bench.now, then)))
    for earlier, now in files:
        logs, before = (version.value(DIGESTS.format(str(path))) for version, path in
                        ((bench.now, now), (bench.before, earlier)))
        if logs is None or before is None:
            print(f"bits of runs, {earlier.name}: one of the versions does not run it")
            continue
        apart = [name for name in before if logs.get(name) != before[name]]
        others = f"; not of {', '.join(apart)}" if apart else ""
        print(f"bits of runs, {earlier.name}: the same log of {len(before) - len(apart)} of {len(before)} controllers"
              f"{others}", flush=True)


def _carried(now: Version, then: Path) -> Path:
    """The earlier version's common scenario among its lines and today's papers, its laws by their names of today."""
    place = now.place / "earlier"
    shutil.copytree(then / "benchmarks", place / "benchmarks")
    (place / "proofs").symlink_to(ROOT / "proofs")
    path = place / "benchmarks" / COMMON
    text = path.read_text(encoding="utf-8")
    for old, new in RENAMED.items():
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    return path
