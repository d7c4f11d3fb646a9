"""The script of a law's co-simulation unit: its functions, and the class that FMI calls."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from workbench.errors import printable
from workbench.fmu.unit import LawUnit

_CLASS = '''\
class {name}(Fmi3Slave, CoSimulation):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = {about!r}
        self.now, self.given, self.values = 0.0, [0.0] * len(INPUTS), list(PARAMETERS.values())
        self.memory = started()
        self.default_experiment = DefaultExperiment(start_time=0.0, step_size=PERIOD_S)
        self.register_variable(Float64("time", causality=Fmi3Causality.independent, getter=lambda: self.now))
        self.listed(INPUTS, self.given, Fmi3Causality.input)
        self.listed(dict.fromkeys(PARAMETERS, "parameter"), self.values, Fmi3Causality.parameter,
                    Fmi3Variability.tunable)
        for place, (variable, what) in enumerate(COMMANDS.items()):
            self.register_variable(Float64(variable, causality=Fmi3Causality.output, description=what,
                                           getter=lambda place=place: self.commands()[place]))
        for place, variable in enumerate(STATES):
            self.register_variable(Float64(variable, causality=Fmi3Causality.local, description="state of the law",
                                           getter=lambda place=place: float(self.memory[0][place])))

    def listed(self, names, numbers, causality, variability=None):
        for place, (variable, what) in enumerate(names.items()):
            self.register_variable(Float64(
                variable, causality=causality, variability=variability, description=what,
                getter=lambda place=place: numbers[place],
                setter=lambda value, place=place: numbers.__setitem__(place, value)))

    def commands(self):
        """What the law commands now; it stands still. No number where it is not defined."""
        try:
            if margin(self.now, self.given, self.values, self.memory) > 0:
                return [float(value) for value in answer(self.now, self.given, self.values, deepcopy(self.memory))]
        except (ArithmeticError, ValueError):
            pass
        return [math.nan] * len(COMMANDS)

    def do_step(self, current_time, step_size):
        if abs(step_size - PERIOD_S) > 1e-6 * PERIOD_S:
            self.log(f"a step of {{step_size}} s: the law samples every {{PERIOD_S}} s", Fmi3Status.error)
            return Fmi3StepResult(status=Fmi3Status.error)
        self.now = current_time
        if not all(map(math.isfinite, self.commands())):
            self.log(f"the law is not defined at t = {{current_time}} s", Fmi3Status.error)
            return Fmi3StepResult(status=Fmi3Status.error)
        answer(self.now, self.given, self.values, self.memory)
        self.now = current_time + step_size
        return Fmi3StepResult(status=Fmi3Status.ok)
'''


def slave_text(unit: LawUnit) -> str:
    """Python source of the unit; it needs pythonfmu3, which goes into the unit, and numpy for hidden neurons alone.

    An output is the command that the law gives to the inputs as they stand at that instant; a step moves its states.
    So a sample is: set the inputs, read the commands, step.
    """
    neurons = len(unit.memory) > 1 and any(np.size(array) for array in unit.memory[1:])
    start = [repr(array.tolist()) for array in unit.memory]
    memory = [start[0], *(f"numpy.array({text})" if neurons else text for text in start[1:])]
    return "\n".join([
        f'"""{unit.name}: generated from the law\'s expressions."""', "", "import math",
        "from copy import deepcopy", "",
        *(["import numpy"] if neurons else []),
        "from pythonfmu3 import (CoSimulation, DefaultExperiment, Float64, Fmi3Causality, Fmi3Slave, Fmi3Status,",
        "                        Fmi3StepResult, Fmi3Variability)", "",
        f"PERIOD_S = {unit.period_s!r}", f"INPUTS = {_in_xml(unit.inputs)!r}", f"COMMANDS = {_in_xml(unit.commands)!r}",
        f"PARAMETERS = {dict(unit.parameters)!r}", f"STATES = {list(unit.states)!r}", "", "",
        "def started():", f"    return [{', '.join(memory)}]", "", "", unit.code, "",
        _CLASS.format(name=unit.name, about=printable(unit.about))])


def _in_xml(texts: Mapping[str, str]) -> dict[str, str]:
    """Texts for the unit's description, which is XML and has no control characters."""
    return {name: printable(text) for name, text in texts.items()}
