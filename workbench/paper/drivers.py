"""Law and MPC of a study driven alike: for tuning with one budget and optimiser, as stated and as tuned."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.files.numbers import counted
from workbench.mpc.controller import KINDS
from workbench.paper.dotted import value_at, with_value_at
from workbench.paper.mpc_comparison import MPC_KINDS
from workbench.paper.parameter_search import NONE_YET, Finished, Name, Restart, Tuned, score, search, search_all
from workbench.paper.study import Progress, Study, varied
from workbench.paper.tuning_record import Pairs, StudyTuning
from workbench.simulate.closed_loop import NOMINAL, Factors

# By which names files know the kinds of MPC.
MPC_NAMES = {kind.replace(".", "_"): kind for kind in MPC_KINDS}
MPC_TITLES = {name: KINDS[kind].title for name, kind in MPC_NAMES.items()}
WEIGHTS = ("position_weight", "speed_weight", "command_weight", "change_weight")


def _as_the_file_says(study: Any, name: str) -> Mapping[str, Any]:
    return {"": study}


@dataclass(frozen=True)
class Drivers:
    """How the controllers of a paper's study are driven one by one.

    titles: controller -> its name in tables, MPC's begin with `mpc`; places(study): what a study runs in, place ->
    words; keys(study, name): the numbers of a law that can be tuned, where each stands in the study as `value_at` reads
    it; what is no number there is none; drive(study, name, place, factors): one run of the train whose mass and
    resistance differ by the factors from what controllers know, as a row with the keys of a comparison and, of laws
    that learn, `trials`: an error of every trial, by the metric's name.
    variants(study, name): which studies drive a controller as stated, by the words that follow its title there.
    first_trial: the number of a learning law's first trial. drive_together(study, name, place, factors): the rows of
    `drive` for several trains, where making them at once takes less time.
    """

    titles: Mapping[str, str]
    places: Callable[[Any], Mapping[str, str]]
    keys: Callable[[Any, str], Mapping[str, str]]
    drive: Callable[[Any, str, str, Factors], dict[str, Any]]
    variants: Callable[[Any, str], Mapping[str, Any]] = _as_the_file_says
    first_trial: int = 1
    drive_together: Callable[[Any, str, str, Sequence[Factors]], Sequence[Mapping[str, Any]]] | None = None

    def parameters(self, study: Any, name: str) -> dict[str, float]:
        """What can be tuned of a controller, with its stated values."""
        stated = {name: value_at(study, key) for name, key in self._keys(study, name).items()}
        return {name: float(value) for name, value in stated.items() if not isinstance(value, str)}

    def with_parameters(self, study: Any, name: str, values: Mapping[str, float]) -> Any:
        """The study with other parameters of one controller."""
        keys = self._keys(study, name)
        for parameter, value in values.items():
            study = with_value_at(study, keys[parameter], value)
        return study

    def _keys(self, study: Any, name: str) -> Mapping[str, str]:
        return mpc_keys(name) if name in MPC_NAMES else self.keys(study, name)

    def tuned(self, study: Any, name: str) -> Any:
        """The study with what was found for a controller; InputError where nothing was."""
        if study.tuning is None or name not in study.tuning.found:
            raise InputError("", f"tuning.found.{name}", "is missing: run 'workbench tune' with --write")
        return self.with_parameters(study, name, study.tuning.found[name])


def mpc_keys(name: str) -> dict[str, str]:
    """The numbers of an MPC that can be tuned, where each stands in a study."""
    keys = (*WEIGHTS, "observer_gain") if "observer_gain" in KINDS[MPC_NAMES[name]].parameters else WEIGHTS
    return keys_in("mpc", keys)


def keys_in(table: str, names: Iterable[str]) -> dict[str, str]:
    """Numbers that stand in one table of a study by their own names."""
    return {name: f"{table}.{name}" for name in names}


def entries(study: Any, drivers: Drivers) -> tuple[tuple[str, bool], ...]:
    """Every controller as stated and, where anything was found for it, as tuned; none without MPC or tuning."""
    if study.mpc is None or study.tuning is None:
        return ()
    return tuple((name, tuned) for name in drivers.titles for tuned in (False, True)
                 if not tuned or name in study.tuning.found)


def tuning_words(tuning: StudyTuning) -> str:
    """For a table's note: what tuned rows were tuned for, and within which budget."""
    units = {"position_rms": "position", "speed_rms": "speed", "logged_jerk_rms": "logged jerk"}
    parts = " + ".join(f"{units[name]} RMS/{unit:g}" for name, unit in tuning.objective.units.items())
    shorter = " The tuning's runs are shorter than these, see the file." if tuning.set else ""
    runs = counted(tuning.runs, "run")
    return (f"Tuned: by 'workbench tune', {runs} with one optimiser and seed for each controller, to the "
            f"least {parts}; the paper's parameters stay as their own rows.{shorter}")


def checked(drivers: Drivers) -> Callable[[Any, Path], Any]:
    """What `StudyKind.located` is for studies with a tuning: InputError for a name, place or value that is none."""

    def check(study: Any, path: Path) -> Any:
        parts: list[tuple[str, StudyTuning | Pairs | None]] = [("tuning", study.tuning), ("pairs", study.pairs)]
        for table, part in parts:
            if part is None:
                continue
            if not drivers.titles:
                raise InputError(path, table, "is for studies that hold laws against MPC, as this one does not: remove "
                                 "it, or give its Reproduction `beside`")
            if study.mpc is None or study.tuning is None:
                raise InputError(path, table, "needs the tables [mpc] and [tuning] beside it: add them or remove it")
            for place in part.places:
                if place not in drivers.places(study):
                    raise InputError(path, f"{table}.places", f"'{place}' is none of the study's: choose among "
                                     f"{', '.join(drivers.places(study))}")
            try:
                varied(study, part.set, f"{table}.set")
            except ValueError as trouble:
                raise InputError(path, "", str(trouble)) from None
        for name, ranges in (study.tuning.ranges if study.tuning else {}).items():
            if name not in drivers.titles:
                raise InputError(path, f"tuning.ranges.{name}", "is no controller of the study: choose one of "
                                 f"{', '.join(drivers.titles)}")
            for key in ranges:
                if key not in drivers.parameters(study, name):
                    raise InputError(path, f"tuning.ranges.{name}.{key}", "is no parameter of this controller: choose "
                                     f"among {', '.join(drivers.parameters(study, name))}")
        return study

    return check


def tune_with(drivers: Drivers) -> Callable[[Study, list[str], int, Progress, Finished], dict[Name, Tuned]]:
    """What `StudyKind.tune` is for studies with these drivers: all names in parallel processes, in their order."""

    def tune(study: Any, names: list[str], workers: int, on_progress: Progress, finished: Finished = NONE_YET
             ) -> dict[Name, Tuned]:
        return search_all(_restart, (drivers, study), names, study.tuning.restarts, workers, on_progress, finished)

    return tune


def _restart(shared: tuple[Drivers, Any], name: str, restart: int) -> Restart:
    (drivers, study), budget = shared, shared[1].tuning
    short, goal = varied(study, budget.set, "tuning.set"), budget.objective

    def cost(values: dict[str, float]) -> float:
        changed = drivers.with_parameters(short, name, values)
        return sum(score(_finished(drivers.drive(changed, name, place, NOMINAL), goal.units), goal.units, goal.failed)
                   for place in budget.places) / len(budget.places)

    return search(cost, drivers.parameters(short, name), budget.ranges[name],
                  budget.runs // len(budget.places) // budget.restarts, budget.seed, restart)


def _finished(row: Mapping[str, Any], metrics: Mapping[str, float]) -> dict[str, float | None]:
    return {name: None if row["failed"] is not None else row[name] for name in metrics}
