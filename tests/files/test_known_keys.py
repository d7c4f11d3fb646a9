"""A key that a record does not have is told what it may have been meant to be."""

import pytest
from pydantic import Field

from workbench.errors import InputError
from workbench.files.toml import Record, validate_record


class Sensor(Record):
    noise: dict[str, float] = Field(default_factory=dict)
    late_s: float = 0.0


class Law(Record):
    period_s: float = 1.0
    observer: dict[str, float] = Field(default_factory=dict)


class Study(Record):
    duration_s: float = 1.0
    sensing: Sensor = Sensor()
    laws: dict[str, Law] = Field(default_factory=dict)
    sensors: tuple[Sensor, ...] = ()


@pytest.mark.parametrize(("data", "told"), [
    ({"noise": {}}, "noise: unknown key: state it as sensing.noise"),
    ({"durations_s": 3.0}, "durations_s: unknown key: did you mean 'duration_s'?"),
    ({"sensing": {"noize": {}}}, "sensing.noize: unknown key: did you mean 'noise'?"),
    ({"laws": {"pid": {"obsrver": {}}}}, "laws.pid.obsrver: unknown key: did you mean 'observer'?"),
    ({"sensors": [{"lates": 1.0}]}, "sensors[0].lates: unknown key: did you mean 'late_s'?"),
    ({"foo": 1}, "foo: unknown key: remove it or correct its spelling"),
    ({"laws": {"pid": {"[red]": 1}}}, "laws.pid.[red]: unknown key: remove it or correct its spelling"),
])
def test_an_unknown_key_is_told_with_its_remedy(data, told):
    with pytest.raises(InputError) as trouble:
        validate_record(data, Study, "study.toml")
    assert str(trouble.value) == f"study.toml: {told}"
