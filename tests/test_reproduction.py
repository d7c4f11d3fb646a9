"""Where a value comes from must be said where a paper is reproduced; elsewhere it may be."""

import tomllib

import pytest
from refusals import changed, refusal
from scenarios import PROOFS, TRAIN_PAPERS
from test_cli import GAINS as GAIN_TEXT
from test_cli import LINE, LINE_SOURCE, SHORT, short_toml

from workbench.cli.loading import load
from workbench.report.sources import sourced_values

PLAIN = SHORT.replace("PERIOD", "0.01").replace("GAINS", GAIN_TEXT)
REPRODUCED = ('name = "short"', 'reproduction = true\nname = "short"')


@pytest.fixture
def path(tmp_path):
    (tmp_path / "line.toml").write_text(LINE)
    return tmp_path / "s.toml"


def test_nobodys_file_needs_a_source(path):
    path.write_text(PLAIN)
    assert sourced_values(load(path).scenario) == []


def test_a_source_may_stand_and_may_say_anything(path):
    path.write_text(PLAIN.replace("mass_kg = 200000.0", 'mass_kg = 200000.0\nsource.mass_kg = "our scales"'))
    value, = sourced_values(load(path).scenario)
    assert (value.key, value.words) == ("train.mass_kg", "our scales")


def test_a_source_of_what_is_not_stated_is_always_a_mistake(path):
    path.write_text(PLAIN.replace("mass_kg = 200000.0", 'mass_kg = 200000.0\nsource.mass_t = "our scales"'))
    assert "train: source.mass_t explains a value that is not stated" in refusal(load, path)


def test_one_source_may_stand_for_all_values_of_a_table(path):
    (path.parent / "line.toml").write_text(LINE + LINE_SOURCE)
    whole = 'mass_kg = 200000.0\nsource = "{}"'
    path.write_text(PLAIN.replace("mass_kg = 200000.0", whole.format("our scales")))
    values = sourced_values(load(path).scenario)
    assert {value.key for value in values} >= {"train.mass_kg", "train.davis_a_mps2", "train.max_braking_n"}
    assert {value.words for value in values if value.key.startswith("train.")} == {"our scales"}
    path.write_text(changed(PLAIN.replace("mass_kg = 200000.0", whole.format("our scales")), *REPRODUCED))
    assert "train: source." in (said := refusal(load, path)) and "'our scales' must start with 'paper'" in said
    path.write_text(PLAIN.replace("mass_kg = 200000.0", whole.format("")))
    assert "train.source." in refusal(load, path)


def test_where_a_paper_is_reproduced_every_value_needs_its_source_in_the_line_too(path):
    path.write_text(changed(PLAIN, *REPRODUCED))
    assert "line.toml: source.curve is missing: say where" in refusal(load, path)
    (path.parent / "line.toml").write_text(LINE + LINE_SOURCE)
    assert "train: source.davis_a_mps2 is missing" in refusal(load, path)
    path.write_text(changed(short_toml(), *REPRODUCED))
    assert {value.kind for value in sourced_values(load(path).scenario)} == {"assumed"}


def test_where_a_paper_is_reproduced_a_source_begins_with_its_kind(path):
    (path.parent / "line.toml").write_text(LINE + LINE_SOURCE)
    text = changed(short_toml(), *REPRODUCED)
    path.write_text(changed(text, 'mass_kg = "assumed: a test"', 'mass_kg = "our scales"'))
    assert "must start with 'paper', 'assumed:' or 'convention:'" in refusal(load, path)


@pytest.mark.parametrize("value", ["1", '"true"', "[]"])
def test_reproduction_is_true_or_false(path, value):
    path.write_text(changed(PLAIN, 'name = "short"', f'name = "short"\nreproduction = {value}'))
    assert f"{path}: reproduction: " in refusal(load, path)


@pytest.mark.parametrize("paper", TRAIN_PAPERS)
def test_the_papers_that_ship_are_reproductions_and_say_where_everything_comes_from(paper):
    path = PROOFS / paper / "study.toml"
    assert tomllib.loads(path.read_text(encoding="utf-8"))["reproduction"] is True
    values = sourced_values(load(path).record)
    assert {value.kind for value in values} >= {"paper", "assumed"}
    assert all(value.words or value.kind == "paper" for value in values)
