"""The process that z3 runs in: a certificate a line in, an opinion a line out. It ends when nobody asks any more."""

from __future__ import annotations

import json
import sys
from dataclasses import asdict

import z3

from workbench.proof.oracle.question import opinion_on

MEMORY_MB = 2000


def main() -> None:
    """Answer every line of the input."""
    z3.set_param("memory_max_size", MEMORY_MB)
    for line in sys.stdin:
        asked = json.loads(line)
        opinion = opinion_on(asked["certificate"], asked["seconds"])
        sys.stdout.write(json.dumps(asdict(opinion)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
