"""`python -m workbench.proof.latex PAPER...`: for each printed line, whether it was parsed and equals its goal."""

from __future__ import annotations

import sys
from pathlib import Path

from workbench.errors import WorkbenchError
from workbench.proof.latex.survey import survey


def main(paths: list[str]) -> int:
    """Print one line a claim and the share of each paper; 2 on bad input."""
    try:
        for found in survey([Path(path) for path in paths]):
            sys.stdout.write(found.text() + "\n")
    except WorkbenchError as trouble:
        sys.stderr.write(f"workbench: {trouble}\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
