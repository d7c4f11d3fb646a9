"""Laws as units of FMI 3.0, called by another library's importer and held against the law's own expressions.

That library is imported by the tests, because every test process imports this module, and one of them runs it.
"""

import shutil
from dataclasses import replace
from pathlib import Path

import law_alone
import numpy as np
import pytest
from command_line import run
from scenarios import ROOT

from workbench.cli.loading import load
from workbench.compile.kernel import law_source, loop_module
from workbench.errors import InputError
from workbench.fmu.build import fmu_bytes
from workbench.fmu.slave_text import slave_text
from workbench.fmu.unit import TOLD, unit_of
from workbench.model.law import period, time
from workbench.simulate.controllers import compiled_law
from workbench.simulate.law_values import law_values


class Unit:
    """A unit that fmpy has loaded, its variables by name."""

    def __init__(self, path: Path) -> None:
        import fmpy
        from fmpy.fmi3 import FMU3Slave

        self.folder = fmpy.extract(str(path))
        self.about = fmpy.read_model_description(str(path))
        self.variables = {v.name: v for v in self.about.modelVariables}
        self.slave = FMU3Slave(guid=self.about.instantiationToken, unzipDirectory=self.folder,
                               modelIdentifier=self.about.coSimulation.modelIdentifier, instanceName="law")
        self.slave.instantiate()
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def close(self) -> None:
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder)

    def named(self, causality: str) -> list[str]:
        return [name for name, variable in self.variables.items() if variable.causality == causality]

    def put(self, values: dict[str, float]) -> None:
        self.slave.setFloat64([self.variables[name].valueReference for name in values], list(values.values()))

    def get(self, *names: str) -> list[float]:
        return list(self.slave.getFloat64([self.variables[name].valueReference for name in names]))


@pytest.fixture
def loaded_unit(tmp_path):
    from fmpy.validation import validate_fmu

    units = []

    def made(paper: str, controller: str) -> Unit:
        path = tmp_path / f"{controller}.fmu"
        path.write_bytes(fmu_bytes(unit_of(load(ROOT / "proofs" / paper), controller)))
        assert validate_fmu(str(path)) == []
        units.append(Unit(path))
        return units[-1]

    yield made
    for unit in units:
        unit.close()


def test_a_plants_law_commands_what_its_expressions_do(loaded_unit):
    unit, study = loaded_unit("slotine1987", "adaptive"), load(ROOT / "proofs" / "slotine1987").record
    entrant, plant = study.entrant("adaptive"), study.setting.plant
    law, draw = entrant.law, np.random.default_rng(1)
    values = law.values(plant, study.setting.parameters, entrant.parameters)
    fixed = {symbol: values[str(symbol)] for symbol in law.parameters} | {period: entrant.period_s}
    states = dict.fromkeys(law.state_symbols, 0.0)
    told = [*map(str, plant.outputs), *map(str, law.reference_symbols)]
    assert unit.named("input") == told and unit.named("output") == [*map(str, plant.inputs)]
    for sample in range(5):
        given = dict(zip(told, draw.uniform(-1, 1, len(told)).tolist(), strict=True))
        at = fixed | states | {time: sample * entrant.period_s} | {
            symbol: given[str(symbol)] for symbol in (*plant.outputs, *law.reference_symbols)}
        unit.put(given)
        expected = [float(law.commands[symbol].subs(at)) for symbol in plant.inputs]
        assert unit.get(*map(str, plant.inputs)) == pytest.approx(expected, rel=1e-12)
        assert unit.get(*map(str, plant.inputs)) == pytest.approx(expected, rel=1e-12)  # reading moves nothing
        unit.slave.doStep(sample * entrant.period_s, entrant.period_s)
        states = {symbol: float(e.subs(at)) for symbol, e in zip(law.state_symbols, law.next_values, strict=True)}
        assert unit.get(*map(str, states)) == pytest.approx([*states.values()], rel=1e-12)


@pytest.mark.parametrize("controller", ["pid", "rbfnn_pocrac"])
def test_a_trains_law_commands_what_the_compiled_one_does(loaded_unit, controller):
    unit, scenario = loaded_unit("yang2021", controller), load(ROOT / "proofs" / "yang2021").record
    spec, samples = scenario.controllers[controller], 50
    law, draw = compiled_law(scenario, spec), np.random.default_rng(2)
    rows = np.column_stack([spec.period_s * np.arange(samples), draw.uniform(-0.01, 0.01, (samples, len(TOLD))),
                            np.full(samples, spec.period_s)])
    values, scalars, neurons, data = law_values(law, spec, controller)
    expected, states = np.zeros(samples), np.zeros((samples, len(scalars)))
    kernel = loop_module(law.source, [law_source(law, spec.estimates)], law_alone)
    kernel.answers(rows, values, scalars, neurons, data, expected, states)
    found = []
    for row in rows:
        unit.put(dict(zip(TOLD, row[1:-1].tolist(), strict=True)))
        found += unit.get("command_mps2")
        unit.slave.doStep(float(row[0]), spec.period_s)
    assert found == pytest.approx(expected.tolist(), rel=1e-9)
    assert unit.get(*(str(state.symbol) for state in law.scalar_states)) == pytest.approx(states[-1].tolist(), rel=1e-9)


def test_outside_of_its_domain_and_at_another_period_a_law_gives_no_command(loaded_unit):
    from fmpy.fmi1 import FMICallException

    unit = loaded_unit("yang2021", "rbfnn_pocrac")
    with pytest.raises(FMICallException):
        unit.slave.doStep(0.0, 0.5)
    unit.put({"position_m": 1e6})
    assert np.isnan(unit.get("command_mps2")).all()
    with pytest.raises(FMICallException):
        unit.slave.doStep(0.0, 0.005)


def test_parameters_can_be_set_and_the_script_is_the_same_each_time(loaded_unit):
    unit = loaded_unit("yang2021", "pid")
    unit.put({"position_m": 1.0})
    before = unit.get("command_mps2")[0]
    unit.put({"K_p": 0.0})
    assert unit.get("command_mps2")[0] != before
    once, again = (slave_text(unit_of(load(ROOT / "proofs" / "yang2021"), "pid")) for _ in range(2))
    assert once == again


def test_a_title_with_control_characters_makes_a_unit_all_the_same(tmp_path):
    """A unit's description is XML, which has none."""
    import fmpy
    from fmpy.validation import validate_fmu

    unit = unit_of(load(ROOT / "proofs" / "yang2021"), "pid")
    path = tmp_path / "law.fmu"
    path.write_bytes(fmu_bytes(replace(unit, about="a\x1b[31m<b>\x00&", inputs=dict.fromkeys(unit.inputs, "\x07 m"))))
    assert validate_fmu(str(path)) == []
    assert fmpy.read_model_description(str(path)).description == "a [31m<b> &"


@pytest.mark.parametrize(("paper", "controller", "why"), [
    ("yang2021", "nobody", "there is no 'nobody'"), ("slotine1987", "nobody", "there is no 'nobody'"),
    ("slotine1987", "mpc", "is no law of expressions"), ("chen2019", "pid", "states no controllers of one train"),
])
def test_what_is_no_law_is_refused_in_a_line(paper, controller, why):
    with pytest.raises(InputError, match=why) as refused:
        unit_of(load(ROOT / "proofs" / paper), controller)
    assert refused.value.where and "\n" not in str(refused.value)


def test_the_command_writes_the_unit_and_never_over_its_input(tmp_path):
    out = tmp_path / "law.fmu"
    done = run("export-fmu", "krstic1992", "frozen", "--out", str(out))
    assert (done.returncode, out.exists()) == (0, True) and "every 0.002 s" in done.stdout
    study = ROOT / "proofs" / "krstic1992" / "study.toml"
    before = study.read_bytes()
    assert run("export-fmu", "krstic1992", "frozen", "--out", str(study)).returncode == 2
    assert study.read_bytes() == before
