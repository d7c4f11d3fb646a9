"""Everyone who may take part in a contest: a scenario's controllers, and laws that need a run of their own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from workbench.contest.entrant import Entrant, Played
from workbench.contest.learning_mpc import ENTRANTS
from workbench.contest.record import Contest
from workbench.errors import InputError, WorkbenchError
from workbench.model.law import ControlLaw
from workbench.model.laws import law_named, named, names_near
from workbench.mpc.controller import KINDS
from workbench.simulate.closed_loop import Setting, run_law, simulate_in
from workbench.simulate.controllers import SAMPLED, TOLD_THE_LINE, compiled_law, known_laws
from workbench.simulate.law_values import check_controllers, law_values
from workbench.trains.periods import period_name
from workbench.trains.scenario import Scenario

# What a predictor is told of an actuator, by whether it stands before MPC.
PREDICTS = {False: "the nominal train over the actuator's delay", True: "the actuator's delay and lag"}


def entered(contest: Contest, scenario: Scenario) -> Scenario:
    """The contest's scenario with the contest's own entrants among its controllers, and who samples otherwise too."""
    entrants = {name: spec.model_copy(update={"law": _from(contest.folder, spec.law)})
                for name, spec in contest.entrants.items()}
    all_of = scenario.controllers | entrants
    others = {period_name(name, period): all_of[name].model_copy(update={"period_s": period})
              for name, periods in contest.periods_s.items() if name in all_of for period in periods}
    return scenario.model_copy(update={"controllers": all_of | others})


def _from(folder: Path, law: str) -> str:
    """A law's name as a file in another folder would write it."""
    file, separator, name = law.partition("::")
    return f"{(folder / file).resolve()}::{name}" if separator else law


def entrant_named(law: str, folder: Path) -> Entrant | None:
    """The law that needs a run of its own, from a paper's contest.py or this room; None where none has that name."""
    if law in ENTRANTS:
        return ENTRANTS[law]
    if law.partition("::")[1]:
        return None
    return named(law, folder, "contest", Entrant)


def check_entrants(contest: Contest, scenario: Scenario, path: Path, scenario_path: Path) -> None:
    """Raise InputError for a controller or entrant that cannot be used, naming the file it stands in."""
    check_controllers(scenario, scenario_path)
    ordinary = {}
    for name, spec in contest.entrants.items():
        ratio = spec.period_s / scenario.simulation.plant_step_s
        if round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
            raise InputError(path, f"entrants.{name}.period_s", f"{spec.period_s:g} is not a whole number of plant "
                             f"steps of {scenario.simulation.plant_step_s:g} s: choose a multiple")
        if name in scenario.controllers:
            raise InputError(path, f"entrants.{name}", "is a controller of the scenario already: name it otherwise")
        entrant = entrant_named(spec.law, contest.folder)
        if entrant is not None:
            try:
                entrant.check(spec, f"entrants.{name}")
            except InputError as trouble:
                raise trouble.within(path) from None
        elif spec.law in (*SAMPLED, *TOLD_THE_LINE) or _law(contest, name, path):
            ordinary[name] = spec.model_copy(update={"law": _from(contest.folder, spec.law)})
        else:
            others = ", ".join((*ENTRANTS, *names_near(contest.folder, "contest", Entrant)))
            raise InputError(path, f"entrants.{name}.law", f"unknown '{spec.law}': choose one of "
                             f"{known_laws(scenario)}{', ' if others else ''}{others}")
    try:
        check_controllers(scenario.model_copy(update={"controllers": ordinary}), path)
    except InputError as trouble:  # in a contest's file the table is called otherwise
        raise InputError(path, trouble.key.replace("controllers.", "entrants.", 1), trouble.problem) from None


def _law(contest: Contest, name: str, path: Path) -> ControlLaw | None:
    try:
        return law_named(contest.entrants[name].law, contest.folder)
    except InputError as trouble:
        raise trouble if trouble.where else trouble.within(path, f"entrants.{name}.law") from None


def check_names(contest: Contest, stated: Scenario, path: Path) -> None:
    """Raise InputError where a table of the contest names nobody who takes part, or a period that is none."""
    names = {**stated.controllers, **contest.entrants}
    copies = [period_name(name, period) for name, periods in contest.periods_s.items() for period in periods]
    everyone = (*names, *copies)
    for key, given, known in (("periods_s", tuple(contest.periods_s), tuple(names)),
                              ("as_stated", contest.as_stated or (), everyone),
                              ("tuning.evaluations_of", tuple(contest.tuning.evaluations_of), everyone)):
        for name in given:
            if name not in known:
                raise InputError(path, key, f"'{name}' does not take part: choose among {', '.join(known)}")
    step = stated.simulation.plant_step_s
    for name, periods in contest.periods_s.items():
        for period in periods:
            if round(period / step) < 1 or abs(period / step - round(period / step)) > 1e-6:
                raise InputError(path, f"periods_s.{name}", f"{period:g} is not a whole number of plant steps of "
                                 f"{step:g} s: choose a multiple")
    for copy in copies:
        if everyone.count(copy) > 1:
            raise InputError(path, "periods_s", f"'{copy}' takes part already: leave its period out")


def play(scenario: Scenario, name: str, setting: Setting) -> Played:
    """Run a contestant in a setting that may differ from what the scenario states, which is what it knows.

    Raises InputError where the code of an entrant of one's own raises: that is no run that failed, but none at all.
    """
    spec = scenario.controllers[name]
    entrant = entrant_named(spec.law, scenario.folder)
    law = None if entrant else compiled_law(scenario, spec)
    if law is not None:
        return Played(run_law(law, law_values(law, spec, name), setting, spec.period_s, spec.estimates, name,
                              spec.title or law.title, predictor=spec.predictor))
    if entrant is None:
        return Played(simulate_in(scenario, name, setting))
    try:
        found = entrant.play(scenario, spec, setting)
    except WorkbenchError:
        raise
    except Exception as trouble:  # whatever a user's entrant does
        raise InputError("", f"{name}: {spec.law}", f"play() raised {type(trouble).__name__}: {trouble}: let it answer "
                         "with a run, which may have failed") from trouble
    return replace(found, run=replace(found.run, controller=name))


def information(scenario: Scenario, name: str) -> str:
    """What a contestant may know."""
    spec = scenario.controllers[name]
    law = spec.law
    known = entrant_named(law, scenario.folder) or compiled_law(scenario, spec)
    told = known.information if known else KINDS[law].information if law in KINDS else "full state, nominal model"
    return f"{told}; {PREDICTS[law in KINDS or law in ENTRANTS]}" if spec.predictor else told


def follows_curve(scenario: Scenario, name: str) -> bool:
    """Whether a contestant tracks the desired curve; if not, errors from it say nothing about it."""
    law = scenario.controllers[name].law
    return KINDS[law].follows_curve if law in KINDS else True


def held_samples(scenario: Scenario, name: str) -> int:
    """How many samples of its loop a contestant's command is held for: only the first of them is a control step."""
    spec = scenario.controllers[name]
    return int(spec.parameters.get("held_samples", 1)) if spec.law in KINDS else 1


def learns(scenario: Scenario, name: str) -> bool:
    """Whether a contestant learns from trial to trial."""
    entrant = entrant_named(scenario.controllers[name].law, scenario.folder)
    return entrant is not None and entrant.learns
