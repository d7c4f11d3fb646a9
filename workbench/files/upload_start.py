"""Runs on a worker, from the archive that it lies in, when it is imported there: unpacks it.

Standard library only: the worker need not have the workbench.
"""

import os
import zipfile
from pathlib import Path

ARCHIVE = Path(__file__).resolve().parents[1]
ROOT = ARCHIVE.with_suffix(".unpacked")
CODE, TREE = ROOT / "code", ROOT / "tree"

if ARCHIVE.suffix == ".zip" and not ROOT.exists():
    aside = ROOT.with_suffix(f".{os.getpid()}")
    with zipfile.ZipFile(ARCHIVE) as held:
        held.extractall(aside)
    try:
        aside.rename(ROOT)
    except OSError:  # another process of this machine was faster
        if not ROOT.exists():
            raise
