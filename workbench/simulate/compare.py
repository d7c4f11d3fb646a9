"""Every controller of a scenario on the same train and line, and again under each change of assumed values."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.simulate.closed_loop import Run, check_controllers, simulate
from workbench.simulate.controllers import SAMPLED, compiled
from workbench.simulate.metrics import Metrics, measure
from workbench.tasks.handing_out import places, run_tasks
from workbench.trains.scenario import Scenario, Variant, changed_scenario

Case = tuple[int, str]  # 0 is the scenario as stated, i > 0 its i-th variant
Progress = Callable[[int, int, str], None]
Result = tuple[Case, Run | None, Metrics]

HERE_S = 1.0  # seconds of the processor that a process more takes to start, about


@dataclass(frozen=True)
class Comparison:
    """Runs and metrics of the scenario as stated, in its order, and the metrics of every variant."""

    scenario: Scenario
    runs: tuple[Run, ...]
    metrics: tuple[Metrics, ...]
    variants: tuple[tuple[Variant, tuple[Metrics, ...]], ...]


def compare(path: Path, data: Mapping[str, Any], scenario: Scenario, with_variants: bool = True,
            workers: int | None = None, on_progress: Progress | None = None) -> Comparison:
    """Simulate all controllers of a scenario in parallel processes; path, data: its file, and the table in it.

    on_progress(finished, total, what) is called after each run. A run that fails is a row that says so. Variants are
    driven by the compiled form of a controller that has one.
    Raises InputError or WorkbenchError for a scenario or variant that cannot be used.
    """
    variants = scenario.all_variants if with_variants else ()
    scenarios = [scenario, *map(compiled, checked_variants(path, data, scenario, with_variants))]
    cases = [(0, name) for name in scenario.controllers]
    cases += [(i, name) for i, variant in enumerate(variants, start=1)
              for name in scenario.controllers if name in (variant.controllers or scenario.controllers)]
    found: dict[Case, tuple[Run | None, Metrics]] = {}

    def record(result: Result) -> None:
        case, run, metrics = result
        found[case] = run, metrics
        if on_progress:
            title = scenarios[0].title if case[0] == 0 else variants[case[0] - 1].title
            on_progress(len(found), len(cases), f"{case[1]}: {title}")

    rest = _quick_ones_here(scenarios, cases, record)
    run_tasks(_run_case, scenarios, rest, places(workers), record)
    nominal = [found[0, name] for name in scenario.controllers]
    return Comparison(
        scenario, tuple(run for run, _ in nominal if run is not None), tuple(metrics for _, metrics in nominal),
        tuple((variant, tuple(found[i, name][1] for j, name in cases if j == i))
              for i, variant in enumerate(variants, start=1)))


def _quick_ones_here(scenarios: list[Scenario], cases: list[Case], record: Callable[[Result], None]) -> list[Case]:
    """Run compiled laws in this process, for HERE_S of the processor, and say which cases are left: a small scenario's
    are not worth what starting processes costs."""
    left, until = list(cases), time.process_time() + HERE_S
    for case in cases:
        if time.process_time() > until:
            break
        if scenarios[case[0]].controllers[case[1]].law not in SAMPLED:
            left.remove(case)
            record(_run_case(scenarios, case))
    return left


def checked_variants(path: Path, data: Mapping[str, Any], scenario: Scenario, with_variants: bool) -> list[Scenario]:
    """The scenario's variants; InputError for a controller, of the scenario or of one of them, that cannot be used."""
    check_controllers(scenario, path)
    variants = scenario.all_variants if with_variants else ()
    scenarios = [changed_scenario(path, dict(data), variant, scenario) for variant in variants]
    for variant, changed in zip(variants, scenarios, strict=True):
        check_controllers(changed, f"{path}: variant '{variant.title}'")
    return scenarios


def _run_case(scenarios: list[Scenario], case: Case) -> Result:
    """The run and its metrics; the log of a variant's run stays in the worker."""
    scenario = scenarios[case[0]]
    run = simulate(scenario, case[1])
    return case, run if case[0] == 0 else None, measure(run, scenario)
