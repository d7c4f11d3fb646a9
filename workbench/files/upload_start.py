"""Runs on a worker, from the archive that it lies in, when it is imported there: unpacks it and makes it importable.

Standard library only: the worker need not have the workbench.
"""

import os
import sys
import zipfile
from pathlib import Path

ARCHIVE = Path(__file__).parents[1]
ROOT = ARCHIVE.with_suffix(".unpacked")
CODE, TREE = ROOT / "code", ROOT / "tree"

if not ROOT.exists():
    aside = ROOT.with_suffix(f".{os.getpid()}")
    with zipfile.ZipFile(ARCHIVE) as held:
        held.extractall(aside)
    try:
        aside.rename(ROOT)
    except OSError:  # another process of this machine was faster
        if not ROOT.exists():
            raise
if str(CODE) not in sys.path:
    sys.path.insert(0, str(CODE))
    # What this process has imported of another workbench, or of the folders of another job, is not this one's.
    for name in list(sys.modules):
        if name.partition(".")[0] == "workbench" or name.startswith("workbench_folder_"):
            del sys.modules[name]
