"""What changed between two documents, and what the command line says of it."""

import json

import pytest
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.errors import InputError
from workbench.report.changes import changes, read_claims


def row(name, **more):
    return {"id": name, "verdict": "proved", "statement": "x", "tainted_by": [], "seconds": 1.0, **more}


def test_new_gone_and_changed_claims_are_told_and_seconds_are_not():
    before = {"a:1": row("a:1"), "a:2": row("a:2"), "a:3": row("a:3", seconds=2.0)}
    after = {"a:1": row("a:1", verdict="refuted", tainted_by=["a:4"]), "a:3": row("a:3"), "a:4": row("a:4")}
    found = changes(before, after)
    assert [(c.id, c.what) for c in found] == [("a:1", "changed"), ("a:4", "new"), ("a:2", "gone")]
    assert found[0].sentence() == "a:1: verdict proved -> refuted, rests on failed a:4"
    assert changes(after, after) == []


def test_fields_that_an_earlier_document_lacks_are_not_compared():
    assert changes({"a:1": row("a:1")}, {"a:1": row("a:1", goal_digest="x")}) == []


def test_the_command_says_what_changed_and_ends_with_1(tmp_path):
    paths = [tmp_path / "a.json", tmp_path / "b.json"]
    for path, verdict in zip(paths, ("proved", "gap"), strict=True):
        path.write_text(json.dumps({"version": 2, "claims": [row("a:1", verdict=verdict)]}))
    done = CliRunner().invoke(app, ["diff", *map(str, paths)])
    assert done.exit_code == 1 and "a:1: verdict proved -> gap" in done.stdout
    assert CliRunner().invoke(app, ["diff", str(paths[0]), str(paths[0])]).exit_code == 0
    done = CliRunner().invoke(app, ["diff", *map(str, paths), "--json", "-"])
    assert json.loads(done.stdout)["changes"][0]["id"] == "a:1"


def test_what_is_no_such_document_is_refused(tmp_path):
    (tmp_path / "a.json").write_text('{"claims": [1]}')
    with pytest.raises(InputError, match="prove --json"):
        read_claims(tmp_path / "a.json")
