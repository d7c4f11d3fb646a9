"""The `%%sh` of cells while pages are built: what a command said, in one piece; one that fails ends the build."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

STARTUP = """from shell_cells import sh
from IPython import get_ipython
get_ipython().register_magic_function(sh, "cell", "sh")
"""


def ipython_folder() -> str:
    """A fresh folder for IPython's own files, in which each kernel is told of `sh` when it starts."""
    folder = Path(tempfile.mkdtemp(prefix="workbench-docs-"))
    startup = folder / "profile_default" / "startup"
    startup.mkdir(parents=True)
    (startup / "00-sh.py").write_text(f"import sys\nsys.path.insert(0, {str(Path(__file__).parent)!r})\n{STARTUP}",
                                      encoding="utf-8")
    return str(folder)


def sh(_line: str, cell: str) -> None:
    """Run a cell by the shell and print its output; RuntimeError with its errors where a command fails."""
    done = subprocess.run(["sh", "-e"], input=cell, text=True, capture_output=True, check=False)
    print(done.stdout, end="")  # noqa: T201
    if done.returncode:
        raise RuntimeError(f"exit code {done.returncode}: {done.stderr}")
