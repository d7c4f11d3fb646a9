"""A plant's study with what its folder holds: the setting of its runs and the controllers that enter them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp

from workbench.compile.literals import require_short
from workbench.errors import CompileError, InputError, WorkbenchError
from workbench.files.folders import held_in
from workbench.model.laws import named, names_near
from workbench.mpc.plant_tracking import PlantMpc
from workbench.paper.plants.record import LawEntry, MpcEntry, PlantStudy
from workbench.simulate.plants.run import Entrant
from workbench.systems.law import StateLaw
from workbench.systems.metric import Metric
from workbench.systems.plant import Plant
from workbench.systems.setting import UNSTATED, Setting
from workbench.systems.signals import read_signal

TUNED = " (tuned)"
# What a setting of Python calls otherwise than a study's file does.
KEYS = {"references": "reference", "disturbances": "disturbance", "noise": "sensing.noise", "late_s": "sensing.late_s",
        "seed": "sensing.seed", "lag_s": "actuators.lag_s", "delay_s": "actuators.delay_s", "step_s": "plant_step_s"}
AS_KEY = re.compile(rf"(?<![\w.])({'|'.join(KEYS)})(?=\.\w| = )")


def _as_in_file(trouble: ValueError) -> str:
    """What does not fit, by the keys of a file: a setting's `references.x` is no key there."""
    return AS_KEY.sub(lambda found: KEYS[found[0]], str(trouble))


class LocatedPlantStudy(PlantStudy):
    """A plant's study that knows its file, and so its folder's plant, laws and metrics."""

    file: Path

    @cached_property
    def the_plant(self) -> Plant:
        """The plant of the folder; InputError where there is none, or several and none is named."""
        found = {plant.id: plant for plant in held_in(self.folder, "plant", Plant).values()}
        if not found:
            raise InputError(self.folder / "plant.py", "", "is missing, or holds no Plant: define one at its top level")
        if self.plant is None and len(found) > 1:
            raise InputError(self.file, "plant", "is missing, and plant.py has several: name one of "
                             f"{', '.join(found)}")
        if self.plant is not None and self.plant not in found:
            raise InputError(self.file, "plant", f"'{self.plant}' is not in plant.py: name one of {', '.join(found)}")
        return found[self.plant] if self.plant is not None else next(iter(found.values()))

    @cached_property
    def setting(self) -> Setting:
        """What all controllers run in; InputError naming the key that does not fit."""
        metrics = (*held_in(self.folder, "plant", Metric).values(), *held_in(self.folder, "metrics", Metric).values())
        references = {name: read_signal(signal, self.folder) for name, signal in self.reference.items()}
        disturbances = {name: read_signal(signal, self.folder) for name, signal in self.disturbance.items()}
        if self.plant_step_s is None and self.the_plant.step_s is None:
            raise InputError(self.file, "plant_step_s", "is missing: give the seconds of an integration step")
        try:
            return Setting(
                self.the_plant, self.duration_s, self.plant_step_s or UNSTATED, self.log_every_s, self.parameters,
                self.initial, references, disturbances, self.tracks, self.sensing.noise, self.sensing.late_s,
                self.actuators.lag_s, self.actuators.delay_s, tuple({m.id: m for m in metrics}.values()),
                self.sensing.seed, self.integrator)
        except ValueError as trouble:
            raise InputError(self.file, "", _as_in_file(trouble)) from None

    def law(self, name: str) -> StateLaw:
        """A law by the name that the file gives it; InputError with the names there are."""
        own = {key.rpartition(".")[2]: law for key, law in held_in(self.folder, "laws", StateLaw).items()}
        try:
            found = own.get(name) or named(name, self.folder, "laws", StateLaw)
        except InputError as trouble:
            raise trouble if trouble.where else trouble.within(self.file, "controllers") from None
        if found is None:
            known = [*own, *names_near(self.folder, "laws", StateLaw)]
            raise InputError(self.file, "controllers", f"law '{name}' is not known: name one of "
                             f"{', '.join(dict.fromkeys(known)) or 'laws.py, which is missing or has none,'} "
                             "or mpc.tracking, mpc.economic")
        return found

    def entrant(self, name: str, changed: Mapping[str, float] | None = None, shown: str = "") -> Entrant:
        """A controller as it enters the runs; changed: tuned values, of tables by dotted keys.

        Raises InputError where it does not fit the plant.
        """
        entry = self.controllers[name]
        try:
            if isinstance(entry, LawEntry):
                made = Entrant(shown or name, entry.period_s, self.law(entry.law),
                               entry.parameters | dict(changed or {}), entry.initial)
            else:
                how = _mpc(entry, changed or {})
                how.check(self.setting, entry.period_s)
                made = Entrant(shown or name, entry.period_s, build=how.build)
            made.check(self.setting)
        except ValueError as trouble:
            raise InputError(self.file, f"controllers.{name}", _as_in_file(trouble)) from None
        return made

    def entrants(self) -> dict[str, Entrant]:
        """All controllers as stated, and those that were tuned with what was found."""
        found = {name: self.entrant(name) for name in self.controllers}
        for name, values in (self.tuning.found if self.tuning else {}).items():
            found[name + TUNED] = self.entrant(name, values, name + TUNED)
        return found

    def tunable(self, name: str) -> dict[str, float]:
        """What of a controller can be tuned: the numbers that it states, those of tables by dotted keys."""
        entry = self.controllers[name]
        if isinstance(entry, LawEntry):
            return dict(entry.parameters)
        tables = ("weights", "input_weights", "change_weights", "objective", "observer")
        return {"terminal_weight": entry.terminal_weight,
                **{f"{table}.{key}": value for table in tables for key, value in getattr(entry, table).items()}}

    def drawn(self, number: int, seed: int) -> Setting:
        """The setting of a draw of the Monte Carlo; every parameter is drawn, so that one factor changes no other."""
        stated = self.uncertainty
        if stated is None:
            raise InputError(self.file, "uncertainty", "is missing: state runs, seed, factors and spread in this table")
        parameters = {str(one.symbol): one for one in self.the_plant.parameters}
        for name in stated.factors:
            if name not in parameters:
                raise InputError(self.file, "uncertainty.factors", f"'{name}' is no parameter of the plant: name "
                                 f"one of {', '.join(parameters)}")
            if stated.spread is None and parameters[name].known is None:
                raise InputError(self.file, "uncertainty.spread", f"is missing, and plant.py does not say in which "
                                 f"interval '{name}' is known to lie: give one of the two")
        generator = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
        values = dict(self.setting.parameters)
        for (name, one), share in zip(parameters.items(), generator.uniform(0.0, 1.0, len(parameters)), strict=True):
            if name in stated.factors and stated.spread is not None:
                values[name] *= 1 + stated.spread * (2 * float(share) - 1)
            elif name in stated.factors and one.known is not None:
                values[name] = one.known[0] + float(share) * (one.known[1] - one.known[0])
        return self.setting.varied(parameters=values, seed=self.sensing.seed + 1 + number)


def located(study: PlantStudy, path: Path) -> LocatedPlantStudy:
    """The study with everything that it names found and held against the plant; InputError for what does not fit."""
    found = LocatedPlantStudy(**study.model_dump(exclude_unset=True), file=path).in_folder(path.parent)
    plant = found.the_plant
    _require_numbers(path.with_name("plant.py"), f"plant '{plant.id}'",
                     (*plant.moves, *plant.outputs.values(), *plant.domain))
    try:
        entrants = found.entrants()
    except WorkbenchError as trouble:
        raise trouble if isinstance(trouble, InputError) else InputError(path, "", str(trouble)) from None
    for name, entry in found.controllers.items():
        if (law := entrants[name].law) is not None:
            moves = [part for state in law.states for part in (state.rate, state.update) if part is not None]
            _require_numbers(_file_of(law, entry.law, path), f"law '{law.id}'",
                             (*law.commands.values(), *moves, *law.domain))
    return found


def _file_of(law: StateLaw, named_as: str, path: Path) -> Path:
    """The file that holds a law: the one that its name gives, the folder's own, or else the study that names it."""
    file, of_a_file, _ = named_as.partition("::")
    if of_a_file:
        return path.parent / file
    return path.with_name("laws.py") if law in held_in(path.parent, "laws", StateLaw).values() else path


def _require_numbers(file: Path, what: str, exprs: Iterable[sp.Expr]) -> None:
    """InputError for a number that no run can calculate with, before one is waited for."""
    try:
        require_short(exprs)
    except CompileError as trouble:
        raise InputError(file, what, str(trouble)) from None


def _mpc(entry: MpcEntry, changed: Mapping[str, float]) -> PlantMpc:
    values: dict[str, Any] = entry.model_dump(exclude={"law", "period_s", "source"})
    for key, value in changed.items():
        table, dot, name = key.partition(".")
        if dot:
            values[table] = {**values[table], name: value}
        else:
            values[table] = value
    return PlantMpc(**values)
