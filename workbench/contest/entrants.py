"""Everyone who may take part in a contest: a scenario's controllers, and laws that need a run of their own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from workbench.contest import chen2019, jiao2025, liu2020
from workbench.contest.entrant import Entrant, Played
from workbench.contest.record import Contest
from workbench.controllers.registry import LAWS, SAMPLED, held_command
from workbench.controllers.values import check_controllers, law_values
from workbench.errors import InputError
from workbench.mpc.controller import KINDS
from workbench.scenario import Scenario, load_scenario
from workbench.simulate.closed_loop import Setting, run_law, simulate_in
from workbench.simulate.setting_loop import law_loop

ENTRANTS: dict[str, Entrant] = {**liu2020.ENTRANTS, **jiao2025.ENTRANTS, **chen2019.ENTRANTS}


def entered(contest: Contest) -> Scenario:
    """The contest's scenario with the contest's own entrants among its controllers."""
    scenario = load_scenario(Path(contest.scenario))
    return scenario.model_copy(update={"controllers": scenario.controllers | contest.entrants})


def check_entrants(contest: Contest, scenario: Scenario, path: Path) -> None:
    """Raise InputError for a controller or entrant that cannot be used, naming the file it stands in."""
    check_controllers(scenario, contest.scenario)
    ordinary = {}
    for name, spec in contest.entrants.items():
        ratio = spec.period_s / scenario.simulation.plant_step_s
        if round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
            raise InputError(path, f"entrants.{name}.period_s", f"{spec.period_s:g} is not a whole number of plant "
                             f"steps of {scenario.simulation.plant_step_s:g} s: choose a multiple")
        if name in scenario.controllers:
            raise InputError(path, f"entrants.{name}", "is a controller of the scenario already: name it otherwise")
        if spec.law in ENTRANTS:
            try:
                ENTRANTS[spec.law].check(spec, f"entrants.{name}")
            except InputError as trouble:
                raise trouble.within(path) from None
        elif spec.law in LAWS or spec.law in SAMPLED:
            ordinary[name] = spec
        else:
            raise InputError(path, f"entrants.{name}.law", f"unknown '{spec.law}': choose one of "
                             f"{', '.join((*LAWS, *SAMPLED, *ENTRANTS))}")
    try:
        check_controllers(scenario.model_copy(update={"controllers": ordinary}), path)
    except InputError as trouble:  # in a contest's file the table is called otherwise
        raise InputError(path, trouble.key.replace("controllers.", "entrants.", 1), trouble.problem) from None


def play(scenario: Scenario, name: str, setting: Setting) -> Played:
    """Run a contestant in a setting that may differ from what the scenario states, which is what it knows."""
    spec = scenario.controllers[name]
    if spec.law in LAWS:
        law = LAWS[spec.law]
        return Played(run_law(law, law_values(law, spec, name), setting, spec.period_s, spec.estimates, name,
                              spec.title or law.title, module=law_loop(law, setting, spec.estimates)))
    if spec.law not in ENTRANTS:
        held = law_loop(held_command, setting, spec.estimates)
        return Played(simulate_in(scenario, name, setting, held=held))
    found = ENTRANTS[spec.law].play(scenario, spec, setting)
    return replace(found, run=replace(found.run, controller=name))


def information(scenario: Scenario, name: str) -> str:
    """What a contestant may know."""
    law = scenario.controllers[name].law
    if law in ENTRANTS:
        return ENTRANTS[law].information
    if law in LAWS:
        return LAWS[law].information
    return KINDS[law].information if law in KINDS else "full state, nominal model"


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
    law = scenario.controllers[name].law
    return law in ENTRANTS and ENTRANTS[law].learns
