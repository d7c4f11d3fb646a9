"""The CSV files behind the charts of a report, in a folder of their own beside the page."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from pathlib import Path

from workbench.files.own_files import read_manifest, replace_files, sha256
from workbench.report.charts.chart import Chart, chart_csv

CURVES, CURVES_FILE = "curves", re.compile(r"[0-9]{2,3}-[a-z0-9-]*\.csv")
ANOTHER_OUT = "name another folder by --out"


def csv_files(charts: Sequence[Chart]) -> list[str]:
    """What the file of each chart is called within the folder `curves`."""
    return [f"{number:02d}-{chart.csv_name}.csv" for number, chart in enumerate(charts, start=1)]


def write_curves(charts: Sequence[Chart], out: Path) -> None:
    """One CSV a chart in the folder `curves` of a report, every point as it was computed; with a manifest, by which
    those of an earlier report are known and taken away.

    Raises InputError where they cannot be written.
    """
    folder = out / CURVES
    files = dict(zip(csv_files(charts), map(chart_csv, charts), strict=True))
    found = (read_manifest(folder, ANOTHER_OUT) or {}).get("curves")
    before = {name: digest for name, digest in (found if isinstance(found, dict) else {}).items()
              if CURVES_FILE.fullmatch(name) and isinstance(digest, str)}
    manifest = {"version": 1, "curves": {name: sha256(text) for name, text in files.items()}}
    replace_files(folder, out, json.dumps(manifest, indent=1) + "\n", files, before,
                  {name: digest for name, digest in before.items() if name not in files},
                  lambda name, data: data.startswith(b"curve,"), ANOTHER_OUT)
