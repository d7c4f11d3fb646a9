"""What share of a match of the common contest is neither a compiled kernel nor a solver, for one entrant of each kind.

    python benchmarks/match_overhead.py [CONTROLLER ...]

Seconds are of the processor, of the second match of a controller, so that nothing is compiled or imported in it. What
is inside: the compiled loop with the law or MPC that it calls, the law where its step is timed, the compiled solvers
and models that Python calls, and casadi's programs. All else, the metrics of the run and the building of its controller
too, is outside. `called` is the same match with its controller called by Python at every sample, where the compiled
loop drives it by itself. Compare shares and ratios between machines and versions, not seconds.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from itertools import product
from pathlib import Path
from typing import Any
from unittest.mock import patch

from workbench.cli.loading import load
from workbench.contest.matches import Entry, one_match
from workbench.contest.record import Contest
from workbench.mpc.kernels import kernels
from workbench.mpc.model import ACTUATORS
from workbench.mpc.transcription import CasadiMpc
from workbench.simulate.law_loop import mpc_loop
from workbench.simulate.law_time import law_step_us

CONTEST = Path(__file__).with_name("common.toml")
KINDS = ("pid", "pocrac", "cascaded_pid_predicted", "mpc_linear", "mpc_linear_20ms", "mpc_offset_free", "mpc_told",
         "mpc_learning", "mpc_adaptive", "mpc_tube", "mpc_economic")
SOLVERS = ("solve_linear", "solve_nonlinear", "follow", "shift")
LOOP = "workbench.simulate.closed_loop"


class Inside:
    """Seconds of the processor within what it wraps, what is within another one counted once."""

    def __init__(self) -> None:
        self.seconds, self._depth = 0.0, 0

    def of(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function, timed."""
        def timed(*arguments: Any, **named: Any) -> Any:
            self._depth += 1
            before = time.thread_time()
            try:
                return function(*arguments, **named)
            finally:
                self._depth -= 1
                if not self._depth:
                    self.seconds += time.thread_time() - before

        return timed


@contextmanager
def counted() -> Iterator[Inside]:
    """Time what is inside while it lasts."""
    inside, module = Inside(), sys.modules[LOOP]
    for actuator in ACTUATORS:
        mpc_loop(actuator)  # made of the solvers themselves, and not of what times them
    with ExitStack() as patches:
        for name in ("_run_compiled", "_run_sampled"):
            patches.enter_context(patch.object(module, name, _driving(getattr(module, name), inside)))
        patches.enter_context(patch.object(module, "law_step_us", inside.of(law_step_us)))
        patches.enter_context(patch.object(CasadiMpc, "_solve_from", inside.of(CasadiMpc._solve_from)))
        for actuator, name in product(ACTUATORS, SOLVERS):
            compiled = kernels(actuator)
            patches.enter_context(patch.object(compiled, name, inside.of(getattr(compiled, name))))
        yield inside


def _driving(run: Callable[..., Any], inside: Inside) -> Callable[..., Any]:
    def timed(kernel: Callable[..., Any], *arguments: Any) -> Any:
        return run(inside.of(kernel), *arguments)

    return timed


def match(contest: Contest, name: str) -> tuple[float, float]:
    """Seconds of a match, and of them those inside."""
    entry = Entry(name, contest.is_tuned(name))
    condition = contest.tuning.condition
    with counted() as inside:
        one_match((contest, contest.world), (condition, 0, entry))
        inside.seconds, before = 0.0, time.thread_time()
        one_match((contest, contest.world), (condition, 1, entry))
        return time.thread_time() - before, inside.seconds


def main() -> None:
    """Print a line a controller."""
    contest = load(CONTEST).record
    assert isinstance(contest, Contest)
    print(f"{'controller':24s}{'match (s)':>11s}{'outside':>9s}{'called (s)':>12s}{'ratio':>7s}{'outside':>9s}")
    for name in sys.argv[1:] or KINDS:
        taken, inside = match(contest, name)
        line = f"{name:24s}{taken:11.3f}{1 - inside / taken:9.0%}"
        with patch.object(sys.modules[LOOP], "whole_run", lambda controller: None):
            called, within = match(contest, name) if contest.world.controllers[name].law.startswith("mpc.") else (0, 0)
        print(line + (f"{called:12.3f}{called / taken:7.1f}{1 - within / called:9.0%}" if called else ""), flush=True)


if __name__ == "__main__":
    main()
