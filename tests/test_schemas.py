"""JSON Schemas: made from the types that read and write files, and met by every file that comes with the workbench."""

import ast
import json
import tomllib
from pathlib import Path

import pytest
from command_line import one_line, run
from jsonschema import Draft202012Validator

import workbench as wb
from workbench.api.schemas import FORMATS, schemas

ROOT = Path(__file__).resolve().parent.parent
TABLES = sorted([*ROOT.glob("proofs/*/*.toml"), *ROOT.glob("benchmarks/**/*.toml")])
# A key that stands in no other kind of file.
TELLING = {"controllers": "scenario", "grade": "line", "davis_a_mps2": "train", "trips": "fleet", "point": "timetable",
           "trip_time_s": "reference-rule", "found": "front"}
# Files of TTOBench, which that project describes.
ELSEWHERE = {"TrackFile", "Journey", "_TrainBlock", "_TrackBlock"}


@pytest.fixture(scope="module")
def validators():
    found = schemas()
    for document in found.values():
        Draft202012Validator.check_schema(document)
    return {name: Draft202012Validator(document) for name, document in found.items()}


def format_of(path, table):
    """The format of a table by its `kind`, or by the key that tells it."""
    named = {"contest": "contest", "plant": "plant-study", "study": str(path.parent)}
    return named[table["kind"]] if "kind" in table else next(TELLING[key] for key in TELLING if key in table)


def troubles(validator, document):
    return [f"{'.'.join(map(str, e.absolute_path))}: {e.message[:80]}" for e in validator.iter_errors(document)]


def test_every_table_that_comes_with_the_workbench_meets_its_schema(validators):
    wrong = {}
    for path in TABLES:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        name = format_of(path, table)
        validator = validators.get(name) or Draft202012Validator(wb.schema(name))
        if found := troubles(validator, table):
            wrong[str(path)] = found
    assert len(TABLES) > 30
    assert not wrong


def test_every_certificate_and_manifest_meets_its_schema(validators):
    paths = sorted(ROOT.glob("proofs/*/certificates/**/*.json"))
    wrong = {}
    for path in paths:
        name = "certificates-manifest" if path.name == "manifest.json" else "certificate"
        if found := troubles(validators[name], json.loads(path.read_text(encoding="utf-8"))):
            wrong[str(path)] = found
    assert len(paths) > 700
    assert not wrong


def test_what_the_commands_write_meets_its_schema(validators, tmp_path):
    (tmp_path / "letters.toml").write_text('[symbols]\nx = "real"\n', encoding="utf-8")
    line, train = ROOT / "benchmarks/lines/hills.toml", ROOT / "benchmarks/trains/yang2021.toml"
    paper = ROOT / "proofs/goodwin1980"
    run("prove", paper, "--json", "claims.json", folder=tmp_path)
    run("errata", paper, "--out", "errata", folder=tmp_path)
    run("diff", "claims.json", "claims.json", "--json", "changes.json", folder=tmp_path)
    run("check", "x^2 \\ge 1", "--symbols", "letters.toml", "--json", "answer.json", folder=tmp_path)
    run("reference", line, train, "--time", "2600", "--intervals", "20", "--json", "reference.json", folder=tmp_path)
    (tmp_path / "errata/findings.json").rename(tmp_path / "findings.json")
    for name in ("claims", "findings", "changes", "answer", "reference"):
        written = json.loads((tmp_path / f"{name}.json").read_text(encoding="utf-8"))
        assert not troubles(validators[name], written), name


@pytest.mark.parametrize(("before", "after"), [
    ("mass_kg", "mass_t"), ("runs = 100", "runs = 10.5"), ("version = 1", 'version = "1"'),
    ("period_s = 0.001\n", "\n"), ("period_s = 0.001", "period_s = 0.001\nperiods_s = [0.01]")])
def test_what_the_reader_refuses_the_schema_refuses(validators, before, after):
    text = (ROOT / "proofs/yang2021/study.toml").read_text(encoding="utf-8")
    assert before in text
    assert troubles(validators["scenario"], tomllib.loads(text.replace(before, after, 1)))


def test_several_periods_meet_the_schema(validators):
    text = (ROOT / "proofs/yang2021/study.toml").read_text(encoding="utf-8")
    several = tomllib.loads(text.replace("period_s = 0.001", "periods_s = [0.01, 0.02]", 1))
    assert not troubles(validators["scenario"], several)


def test_every_type_that_reads_a_file_has_a_schema():
    read = set()
    for path in (ROOT / "workbench").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("load_record", "validate_record"):
                read |= {node.args[1].id} if isinstance(node.args[1], ast.Name) else set()
    assert read - ELSEWHERE - {"model"} <= {one.type for one in FORMATS}


def test_the_published_schemas_are_those_of_the_types():
    published = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in ROOT.glob("docs/schemas/*.json")}
    assert published == schemas(), "write them anew: workbench schema --out docs/schemas"


def test_the_command_names_formats_and_prints_one():
    assert [line.split()[0] for line in run("schema").stdout.splitlines()] == [one.name for one in FORMATS]
    assert json.loads(run("schema", "line").stdout) == wb.schema("line")
    assert "is no format" in one_line(run("schema", "lines"))
