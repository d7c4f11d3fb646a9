"""Who has the smallest largest position error, under which condition, and at what price: counted, nothing judged."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from workbench.files.numbers import NOTHING, counted, length, number
from workbench.files.units import KWH_J
from workbench.proof.wording import listed
from workbench.report.sources import stated
from workbench.report.tables import information, largest_error
from workbench.simulate.metrics import Metrics
from workbench.simulate.sweep import SweepRow
from workbench.trains.scenario import Scenario, Variant

DIGITS = 3  # errors that agree so far are equal: both win


@dataclass(frozen=True)
class Winner:
    """One condition: who wins in how many of its runs, what the others reach."""

    condition: str
    winner: str
    others: str


@dataclass(frozen=True)
class Price:
    """What a controller that wins somewhere needs: what it knows, how often it samples, time a step and energy."""

    controller: str
    knows: str
    period: str
    step: str
    energy: str


@dataclass(frozen=True)
class Winners:
    """The winners condition by condition, and the price of each."""

    rows: tuple[Winner, ...]
    prices: tuple[Price, ...]


def winners(scenario: Scenario, metrics: Sequence[Metrics], variants: Sequence[tuple[Variant, Sequence[Metrics]]],
            sweep: Sequence[SweepRow], names: Mapping[str, str], every: bool = True) -> Winners | None:
    """Of the nominal run, of the drawn runs and of the changes of assumed values; None with fewer than two controllers
    that end the nominal run. every: False where some changes are left out.

    A change that not all controllers drove, such as one of a single law's gains, says nothing of who wins.
    """
    nominal, everyone = _errors(metrics), {m.controller for m in metrics}
    if len(nominal) < 2:
        return None
    rows = [Winner("nominal run", *_said([nominal], names, nominal))]
    drawn: dict[int, dict[str, float]] = {}
    for row in sweep:
        if row.failed is None and row.position_error_min is not None and row.position_error_max is not None:
            drawn.setdefault(row.run, {})[row.controller] = max(abs(row.position_error_min),
                                                                abs(row.position_error_max))
    if drawn:
        rows.append(Winner(f"{len(drawn)} drawn trains and lines", *_said(list(drawn.values()), names)))
    changed = [found for _, of_it in variants
               if {m.controller for m in of_it} >= everyone and (found := _errors(of_it))]
    if changed:
        count = counted(len(changed), "change")
        rows.append(Winner(f"{count} of an assumed value{'' if every else ' in this report'}, driven by all",
                           *_said(changed, names)))
    won = {name for found in [nominal, *drawn.values(), *changed] for name in _best(found)}
    least = min((m.energy_J for m in metrics if m.failed is None), default=0.0)
    prices = tuple(Price(names[m.controller], information(scenario, m.controller),
                         f"{stated(scenario.controllers[m.controller].period_s * 1e3)} ms",
                         f"{number(m.step_us_median, 2)} µs", _energy(m, least))
                   for m in metrics if m.controller in won)
    return Winners(tuple(rows), prices)


def _errors(metrics: Sequence[Metrics]) -> dict[str, float]:
    return {m.controller: error for m in metrics if (error := largest_error(m)) is not None}


def _best(errors: Mapping[str, float]) -> list[str]:
    """Those whose error is the smallest, to the digits that are shown."""
    least = number(min(errors.values()), DIGITS)
    return [name for name, error in errors.items() if number(error, DIGITS) == least]


def _said(runs: Sequence[Mapping[str, float]], names: Mapping[str, str],
          alone: Mapping[str, float] | None = None) -> tuple[str, str]:
    """Who wins and who else does; of a run `alone` with the errors themselves."""
    if alone is not None:
        best = _best(alone)
        others = sorted((error, name) for name, error in alone.items() if name not in best)
        return (f"{listed([names[name] for name in best])}, {length(min(alone.values()))}",
                ", ".join(f"{names[name]} {length(error)}" for error, name in others) or NOTHING)
    wins = Counter(name for errors in runs for name in _best(errors))
    most = max(wins.values())
    rest = [(name, n) for name, n in wins.most_common() if n < most]
    return (f"{listed([names[name] for name, n in wins.items() if n == most])}, in {most} of {len(runs)}",
            ", ".join(f"{names[name]} in {n}" for name, n in rest) or "none")


def _energy(m: Metrics, least: float) -> str:
    if m.failed is not None:
        return NOTHING
    more = m.energy_J / least - 1.0 if least > 0 else 0.0
    return f"{number(m.energy_J / KWH_J, DIGITS + 1)} kWh" + (f" (+{number(100 * more, 2)} %)" if more > 1e-4 else "")
