"""The papers' energy-optimal references: writes their tables by the rules beside them, and runs each main controller.

python benchmarks/paper_references.py [--write] [PAPER ...]
"""

from __future__ import annotations

import sys
from pathlib import Path

from workbench.cli.loading import load
from workbench.files.folders import papers_in
from workbench.files.units import KWH_J
from workbench.model.curve_table import read_rows
from workbench.optimal.curve_request import requested_curve
from workbench.optimal.export import write_csv
from workbench.paper.tracked import Tracked
from workbench.paper.tracking import track

PROOFS = Path(__file__).resolve().parent.parent / "proofs"


def line(found: Tracked, which: str) -> str:
    """A row of the table."""
    position = [" " * 8 if x is None else f"{x:8.3g}" for x in (found.largest_position_m, found.position_rms_m)]
    return (f"{found.paper:9} {which:8} {found.trip_time_s:7.1f} s {found.length_m / 1e3:8.3f} km  "
            f"{' '.join(position)} m  "
            f"{found.largest_speed_mps:8.3g} {found.speed_rms_mps:8.3g} m/s {found.energy_j / KWH_J:9.2f} kWh  "
            f"{found.controller}{': ' + found.failed if found.failed else ''}")


def main(arguments: list[str]) -> None:
    """Write the tables where asked, then print errors and energy on the own and on the optimal reference."""
    papers = [a for a in arguments if not a.startswith("-")] or [folder.name for folder in papers_in(PROOFS)]
    if "--write" in arguments:
        for paper in papers:
            made = requested_curve(PROOFS / paper / "reference.toml")
            write_csv(PROOFS / paper / "reference.csv", made.rows)
            best = made.reference.optimal
            print(f"{paper:9} {made.reference.energy_j / KWH_J:.3f} kWh at the supply, the run below it "
                  f"{best.energy_j / KWH_J:.3f}, at least {best.lower_bound_j / KWH_J:.3f}: gap {100 * best.gap:.3f} %")
    print("paper     reference  time    distance  position largest, rms    speed largest, rms      traction work")
    for paper in papers:
        rows = read_rows(PROOFS / paper / "reference.csv")
        loaded = load(PROOFS / paper)
        print(line(track(loaded), "own"), flush=True)
        print(line(track(loaded, rows), "optimal"), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
