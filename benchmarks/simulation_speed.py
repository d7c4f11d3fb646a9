"""How long a whole run takes per controller, and how the compiled loop compares with the same loop by hand in C.

    python benchmarks/simulation_speed.py [SCENARIO]

A controller with the PID law is run by `pid_loop.c` too, where gcc is there: built with -O2, in the same process,
turn by turn with the compiled loop. It must leave the same bits in the log; the ratio is of the shortest of five runs.
"""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from workbench.simulate.closed_loop import _arrays, run_law, simulate
from workbench.simulate.controllers import compiled_law
from workbench.simulate.law_values import controller_spec, law_values
from workbench.simulate.setting import setting_of
from workbench.trains.scenario import Scenario, load_scenario

STATED = Path(__file__).resolve().parent.parent / "proofs" / "yang2021" / "study.toml"
SOURCE = Path(__file__).with_name("pid_loop.c")
REPEATS = 5


def shortest(*runs: Callable[[], Any]) -> list[float]:
    """CPU seconds of the shortest of REPEATS calls of each, in turn."""
    taken = [float("inf")] * len(runs)
    for _ in range(REPEATS):
        for i, run in enumerate(runs):
            before = time.process_time()
            run()
            taken[i] = min(taken[i], time.process_time() - before)
    return taken


def in_c(folder: Path) -> Any:
    """The loop of pid_loop.c."""
    library = folder / "pid_loop.so"
    subprocess.run(["gcc", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-o", library, SOURCE, "-lm"], check=True)
    return ctypes.CDLL(str(library)).closed_loop


def against_c(scenario: Scenario, name: str, loop: Any) -> tuple[float, float]:
    """Shortest seconds of the compiled loop and of C, both with what a run prepares. The logs must be the same."""
    spec, setting = controller_spec(scenario, name), setting_of(scenario)
    law = compiled_law(scenario, spec)
    assert law is not None
    values = law_values(law, spec, name)

    def ours() -> Any:
        return run_law(law, values, setting, spec.period_s, spec.estimates).log

    def theirs() -> Any:
        arrays, (steps, per_sample, dt, every) = _arrays(setting, spec.period_s, law), setting.plan(spec.period_s)
        ride, integral = arrays.ride.arrays()[0], values[1].copy()
        given = [steps, per_sample, dt, arrays.state, arrays.breaks, arrays.coefficients, *arrays.coefficients.shape,
                 arrays.edges, arrays.values, len(arrays.edges), arrays.terms, len(arrays.terms), arrays.plant,
                 arrays.drive, setting.position_band_m, setting.nominal_mass_kg, values[0], integral, arrays.acc, ride,
                 len(ride), arrays.log, arrays.log.shape[1], len(arrays.log), every]
        loop(*(x.ctypes if isinstance(x, np.ndarray) else ctypes.c_double(x) if isinstance(x, float)
               else ctypes.c_long(x) for x in given))
        return arrays.log

    log = ours()
    if log.tobytes() != theirs()[:len(log)].tobytes():
        raise SystemExit(f"{name}: C leaves another log: it does not do the same")
    one, other = shortest(ours, theirs)
    return one, other


def main() -> None:
    """Print one line a controller."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else STATED
    scenario = load_scenario(path)
    print("controller           steps   run (s)   µs/step   times C")
    with tempfile.TemporaryDirectory() as folder:
        loop = in_c(Path(folder)) if shutil.which("gcc") else None
        for name, spec in scenario.controllers.items():
            run = simulate(scenario, name)  # compiles, or finds the compiled kernel
            steps, ratio = int(run.totals["samples"]), "–"
            if spec.law == "pid" and loop is not None:
                run_s, c_s = against_c(scenario, name, loop)
                ratio = f"{run_s / c_s:.2f}"
            else:
                run_s, = shortest(lambda name=name: simulate(scenario, name))
            print(f"{name:16s} {steps:9d} {run_s:9.2f} {run_s / steps * 1e6:9.3f} {ratio:>9s}", flush=True)


if __name__ == "__main__":
    main()
