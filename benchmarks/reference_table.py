"""Energy, bound and gap of every public track with every public train, as a table.

    python benchmarks/reference_table.py [--shared FOLDER] [--stops] [--factors 1.05,1.1,1.25] [--solver auto]

The trip time is each factor times the least feasible one; with --stops every inner stop of the track is served, in
running time alone.
"""

from __future__ import annotations

import argparse
import os
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from workbench.errors import WorkbenchError
from workbench.files.units import KWH_J
from workbench.optimal.inputs.files import load_line, load_vehicle
from workbench.optimal.inputs.line import course
from workbench.optimal.reference import find_reference, least_time

SHARED = Path(__file__).parent.parent.parent / "shared" / "ttobench"


def main() -> None:
    """Print the table row by row."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", type=Path, default=SHARED)
    parser.add_argument("--stops", action="store_true")
    parser.add_argument("--factors", default="1.05,1.1,1.25")
    parser.add_argument("--solver", default="auto", choices=("auto", "socp", "nlp"))
    asked = parser.parse_args()
    factors = [float(word) for word in asked.factors.split(",")]
    print("| track | train | stops | time s | of least | energy kWh | bound kWh | gap % | solver | solve s | total s "
          "| simulated kWh | drift m | force beyond % |")
    print("|" + "---|" * 14)
    worst = 0.0
    for track in sorted((asked.shared / "tracks").glob("*.json")):
        line, _ = load_line(track)
        for train in sorted((asked.shared / "trains").glob("*.json")):
            vehicle, _ = load_vehicle(train)
            stops = line.stops_between(0.0, line.length_m) if asked.stops else ()
            if asked.stops and not stops:
                continue
            for factor in factors:
                head = f"| {track.stem} | {vehicle.name} | {len(stops)} |"
                try:
                    run = course(line, vehicle, 0.0, line.length_m, stops)
                    least = least_time(vehicle, run).trip_time_s
                    started = time.perf_counter()
                    found = find_reference(vehicle, run, factor * least, solver=asked.solver)
                except WorkbenchError as trouble:
                    print(f"{head} | {factor:g} | refused: {trouble} |" + " |" * 8, flush=True)
                    continue
                worst = max(worst, found.gap)
                print(f"{head} {factor * least:.1f} | {factor:g} | {found.energy_j / KWH_J:.3f} | "
                      f"{found.lower_bound_j / KWH_J:.3f} | {100 * found.gap:.4f} | {found.solver} | "
                      f"{found.solve_s:.2f} | {time.perf_counter() - started:.2f} | "
                      f"{found.check.energy_j / KWH_J:.3f} | {found.check.position_drift_m:.1e} | "
                      f"{100 * found.check.force_excess:.2f} |", flush=True)
    print(f"\nlargest gap {100 * worst:.4f} %")


if __name__ == "__main__":
    main()
