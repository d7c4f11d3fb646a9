"""What can be checked of any folder with a plant: shapes, values, derivatives along runs, commands, certificates."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from workbench.compile.vector_code import numeric_vector
from workbench.errors import InputError
from workbench.files.folders import CERTIFICATES, STUDY_FILE, held_in
from workbench.model.law import period
from workbench.paper.loading import load
from workbench.paper.plants.problem import LocatedPlantStudy
from workbench.proof.at_hand import papers_at_hand
from workbench.proof.binding import check_claims
from workbench.proof.checker import check_folder
from workbench.simulate.plants.arrays import compiled
from workbench.simulate.plants.run import Entrant, PlantRun
from workbench.simulate.plants.run import run as run_plant
from workbench.systems.law import StateLaw
from workbench.systems.lyapunov import Lyapunov
from workbench.systems.signals import signals_at

POINTS = 50
SAME = 1e-9  # relative difference of a compiled and an interpreted command
STEPS = 200  # of a plant in discrete time along which V is followed
EXACT = 1e-6  # of V's change in a step and the derived one, which differ by rounding alone
CLOSE = 1e-3  # of V's rate along a run and the derived one, relative to the largest rate


@dataclass(frozen=True)
class Check:
    """One thing that was checked: what, whether it holds, and the number or message that says so."""

    what: str
    holds: bool
    found: str


@dataclass(frozen=True)
class Checked:
    """All checks of a folder; `assert checked.holds, checked` tells in a test what does not."""

    folder: Path
    checks: tuple[Check, ...]

    @property
    def holds(self) -> bool:
        """Whether everything does."""
        return all(check.holds for check in self.checks)

    def __str__(self) -> str:
        return "\n".join(f"{'holds' if check.holds else 'FAILS'}: {check.what}: {check.found}" for check in self.checks)


def check_paper(folder: Path) -> Checked:
    """Check a folder: its study fits its plant and laws, every controller's run stays in its domain, compiled and
    interpreted commands agree, every `Lyapunov` function changes along its law's run as derived, certificates hold.

    Raises InputError where the folder cannot be read at all, or has nothing to check.
    """
    found: list[Check] = []
    if (folder / STUDY_FILE).is_file():
        study = load(folder).study
        if isinstance(study, LocatedPlantStudy):
            found += _study(study)
    found += _certificates(folder)
    if not found:
        raise InputError(folder, "", "has nothing to check: name a paper's folder with a plant's study or certificates")
    return Checked(folder, tuple(found))


def _study(study: LocatedPlantStudy) -> Iterator[Check]:
    names = ", ".join(study.entrants())
    yield Check("shapes and values", True, f"plant {study.the_plant.id} with {names}")
    for name, entrant in study.entrants().items():
        done = run_plant(study.setting, entrant, study.setting.parameters)
        yield Check(f"{name} runs to the end within its domain", done.failed is None, done.failed or "yes")
        if entrant.law is not None:
            yield _commands(study, entrant, entrant.law)
    stated = [one for module in ("laws", "lyapunov") for one in held_in(study.folder, module, Lyapunov).values()]
    for lyapunov in {one.id: one for one in stated}.values():
        yield from _rates(study, lyapunov)


def _commands(study: LocatedPlantStudy, entrant: Entrant, law: StateLaw) -> Check:
    """The compiled law at random outputs, references and states against the interpreted expressions."""
    plant, setting = study.the_plant, study.setting
    found = compiled(setting, law)
    outputs, signals, states = [*plant.outputs], setting.signal_symbols, law.state_symbols
    values = law.values(plant, setting.parameters, entrant.parameters)
    usable = [s for s in signals if s in law.reference_symbols]
    exprs = [*law.next_values, *(law.commands[symbol] for symbol in plant.inputs)]
    interpreted = numeric_vector((period, *outputs, *usable, *states, *law.parameters), exprs)
    generator, worst, compared = np.random.default_rng(1), 0.0, 0
    for _ in range(POINTS):
        y, s, q = (generator.normal(size=len(group)) for group in (outputs, signals, states))
        out, moved = np.zeros(len(plant.inputs)), q.copy()
        c = np.array([*values.values()])
        if not found.loop.law_answer(found.law, 1.0, entrant.period_s, y, s, moved, c, out) > 0:
            continue
        given = [value for symbol, value in zip(signals, s, strict=True) if symbol in usable]
        want = np.array(interpreted(1.0, entrant.period_s, *y, *given, *q, *c), dtype=float)
        worst = max(worst, float(np.max(np.abs(np.concatenate([moved, out]) - want) / (1.0 + np.abs(want)))))
        compared += 1
    return Check(f"compiled and interpreted commands of {entrant.name} agree", worst <= SAME and compared > 0,
                 f"largest difference {worst:.2g} at {compared} points")


def _rates(study: LocatedPlantStudy, lyapunov: Lyapunov) -> Iterator[Check]:
    """V along a run of its law, sampled at every plant step without noise, against V' derived from plant and law."""
    for name, entrant in study.entrants().items():
        if entrant.law is None or entrant.law.id != lyapunov.law.id:
            continue
        what = f"{lyapunov.id} changes along the run of {name} as derived"
        in_steps = study.the_plant.step_s is not None
        worst = [_mismatch(study, lyapunov, entrant, share) for share in ((1.0,) if in_steps else (1.0, 0.5))]
        if math.isnan(worst[0]):
            yield Check(what, False, "at no step did the plant get what the law asked for: nothing was compared")
        elif in_steps:
            yield Check(what, worst[0] <= EXACT, f"off by {worst[0]:.2g} of the largest change")
        else:
            # The command is held for a step, so that both differ by something in proportion to it.
            yield Check(what, worst[0] <= CLOSE or worst[1] <= 0.7 * worst[0],
                        f"off by {worst[0]:.2g} of the largest rate, {worst[1]:.2g} at half the step")


def _mismatch(study: LocatedPlantStudy, lyapunov: Lyapunov, entrant: Entrant, share: float) -> float:
    """How far V's change is off the derived one, relative to the largest; NaN where none can be compared."""
    in_steps = study.the_plant.step_s is not None
    step = study.setting.step_s * share
    duration = step * max(1, round(min(study.duration_s / step, STEPS if in_steps else 2.0 / step)))
    setting = study.setting.varied(step_s=step, duration_s=duration, log_every_s=step, noise={}, late_s={}, lag_s={},
                                   delay_s={}, integrator="rk4")
    law = Entrant(entrant.name, step, entrant.law, entrant.parameters, entrant.initial)
    run = run_plant(setting, law, setting.parameters)
    t = run.column("t_s")
    signals = signals_at(setting.signals, t)
    plant, states = setting.plant, (*setting.plant.states, *lyapunov.law.state_symbols)
    known: dict[sp.Symbol, object] = {symbol: run.column(str(symbol)) for symbol in states}
    for channel in setting.channels:
        known |= dict(zip(channel.symbols, signals[channel.name], strict=True))
    known |= {symbol: signals[str(symbol)][0] for symbol in plant.disturbances}
    known |= {symbol: np.full(len(t), setting.parameters[str(symbol)]) for symbol in plant.parameter_symbols}
    values = lyapunov.law.values(plant, setting.parameters, entrant.parameters)
    known |= {symbol: np.full(len(t), values[str(symbol)]) for symbol in lyapunov.law.parameters}
    evaluate = numeric_vector([*known], [lyapunov.value, lyapunov.rate(plant)])
    columns = np.array([*known.values()], dtype=float)
    V, rate = np.array([evaluate(at, *row) for at, row in zip(t, columns.T, strict=True)], dtype=float).T
    # At the begin: a signal that jumps does so at a step.
    seen, derived = np.diff(V) / (1.0 if in_steps else step), rate[:-1]
    free = _smooth(run, plant.inputs)
    if not free.any():
        return math.nan
    return float(np.max(np.abs(seen - derived)[free]) / max(np.max(np.abs(rate)), 1e-12))


def _smooth(run: PlantRun, inputs: Sequence[sp.Symbol]) -> NDArray[np.bool_]:
    """Between which rows every input was what the law asked for and no event happened: neither is part of the derived
    rate."""
    free = np.ones(len(run.log), dtype=bool)
    for symbol in inputs:
        free &= np.abs(run.column(f"{symbol}") - run.column(f"{symbol}_wanted")) <= 1e-12
    t = run.column("t_s")
    for event in run.events:
        free[np.searchsorted(t, event.t_s):][:2] = False  # the row after it, and that at it where rounding hides which
    return free[1:]


def _certificates(folder: Path) -> Iterator[Check]:
    """Those in the folder's own `certificates`, each by the checker and against its claim's goal."""
    if not (folder / CERTIFICATES).is_dir():
        return
    rows = check_folder(folder / CERTIFICATES)
    for place, path in papers_at_hand(folder).items():
        rows = rows + check_claims(place, path)[0]
    wrong = [f"{path.name}: {reason}" for path, _, reason in rows if reason is not None]
    yield Check("certificates hold", not wrong, wrong[0] if wrong else f"{len({path for path, _, _ in rows})} of them")
