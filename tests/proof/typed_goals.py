"""Goals kept as they are typed, as those of claims are: proved with a certificate that holds, or broken."""

from collections.abc import Callable
from typing import Any

from workbench.proof.checker import check
from workbench.proof.claim import Goal
from workbench.proof.decide.engine import prove_goal
from workbench.proof.decide.refute import find_counterexample
from workbench.proof.typed import as_typed


def proved(goal: Callable[[], Goal]) -> dict[str, Any]:
    """The certificate, which the checker accepts."""
    with as_typed():
        stated = goal()
    certificate = prove_goal(stated)
    assert certificate is not None
    check(certificate)
    return certificate


def require_broken(goal: Callable[[], Goal]) -> None:
    """It is not proved, and a counterexample is found."""
    with as_typed():
        stated = goal()
    assert prove_goal(stated) is None and find_counterexample(stated, "refuted") is not None
