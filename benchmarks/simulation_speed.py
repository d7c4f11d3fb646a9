"""How long a whole run takes per controller, and how much the compiled loop gains on the same source interpreted.

    python benchmarks/simulation_speed.py [SCENARIO]

The baseline is the very module that is compiled, run by the Python interpreter (NUMBA_DISABLE_JIT=1) over the first
seconds of the same run, in the same call. Both are medians of three; the ratio is per control step.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

from workbench.model.desired_curve import CruiseSpeed
from workbench.simulate.closed_loop import simulate
from workbench.simulate.controllers import SAMPLED
from workbench.trains.scenario import Scenario, load_scenario

STATED = Path(__file__).resolve().parent.parent / "proofs" / "yang2021" / "study.toml"
INTERPRETED_M = 60.0
REPEATS = 3


def shortened(scenario: Scenario, length_m: float) -> Scenario:
    """The scenario on the first metres of its line, at low speed, so that an interpreter gets through."""
    section = [s.model_copy(update={"end_m": length_m}) for s in (scenario.track.grade[0], scenario.track.curve[0])]
    track = scenario.track.model_copy(update={
        "length_m": length_m, "grade": (section[0],), "curve": (section[1],), "tunnel": ()})
    values = {"kind": "cruise_speed", "cruise_mps": 4.0, "acceleration_mps2": 0.5, "braking_mps2": 0.5, "ramp_s": 1.0}
    reference = CruiseSpeed(**values, source=dict.fromkeys(values, "convention: short"))
    return scenario.model_copy(update={"track": track, "reference": reference})


def seconds_per_step(scenario: Scenario, name: str) -> tuple[float, float, int]:
    """Median seconds of a run, the same per control step, and the number of steps."""
    simulate(scenario, name)  # compiles, or finds the compiled kernel
    taken, steps = [], 1
    for _ in range(REPEATS):
        before = time.perf_counter()
        run = simulate(scenario, name)
        taken.append(time.perf_counter() - before)
        steps = int(run.totals["commands"])
    median = statistics.median(taken)
    return median, median / steps, steps


def interpreted(path: Path, names: list[str]) -> dict[str, float]:
    """Seconds per step of the same source without compilation, from a process of its own."""
    code = ("import json, sys; from pathlib import Path; sys.path.insert(0, str(Path(sys.argv[1]).parent)); "
            "import simulation_speed as s; from workbench.trains.scenario import load_scenario; "
            "sc = s.shortened(load_scenario(Path(sys.argv[2])), s.INTERPRETED_M); "
            "print(json.dumps({n: s.seconds_per_step(sc, n)[1] for n in json.loads(sys.argv[3])}))")
    answer = subprocess.run([sys.executable, "-c", code, __file__, str(path), json.dumps(names)], check=True,
                            capture_output=True, text=True, env=os.environ | {"NUMBA_DISABLE_JIT": "1"})
    return json.loads(answer.stdout)


def main() -> None:
    """Print one line a controller."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else STATED
    scenario = load_scenario(path)
    names = list(scenario.controllers)
    baseline = interpreted(path, [n for n in names if scenario.controllers[n].law not in SAMPLED])
    print("controller           steps   run (s)   µs/step  interpreted µs/step   ratio")
    for name in names:
        run_s, step_s, steps = seconds_per_step(scenario, name)
        other = baseline.get(name)
        shown = f"{other * 1e6:20.1f} {other / step_s:7.0f}" if other else f"{'–':>20s} {'–':>7s}"
        print(f"{name:16s} {steps:9d} {run_s:9.2f} {step_s * 1e6:9.3f} {shown}")


if __name__ == "__main__":
    main()
