"""No forged certificate is accepted, and none takes long to refuse."""

import copy
import hashlib
import json
import time
from pathlib import Path

import pytest
from forged_certificates import (
    another_statement,
    bound,
    false_mathematics,
    genuine,
    hostile_expressions,
    no_certificates,
)

from workbench.proof.checker import CertificateError, Manifest, check, check_file

PROOFS = Path(__file__).parents[2] / "proofs"
FEW = genuine(PROOFS, 5)
FALSE = list(false_mathematics(FEW))
OTHERS = list(another_statement(FEW))
HOSTILE = list(hostile_expressions())
SOUND = {"claim": "doe2026:1", "version": 1, "verdict": "proved", "goal": {"assume": [], "show": ["x**2 >= 0"]},
         "example": {"x": "0"},
         "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"square": "x"}]}]}]}
FILES = list(no_certificates(bound(SOUND)))
LONGEST = 15.0  # in seconds of this process; the honest ones take milliseconds


@pytest.mark.parametrize("number", range(len(FALSE)), ids=[name for name, _ in FALSE])
def test_false_mathematics_is_refused(number):
    _, forged = FALSE[number]
    with pytest.raises(CertificateError):
        check(bound(forged))


@pytest.mark.parametrize("number", range(len(OTHERS)), ids=[name for name, *_ in OTHERS])
def test_what_is_not_the_claims_statement_is_refused_under_its_name(number, tmp_path):
    _, original, forged = OTHERS[number]
    paper, _, name = original["claim"].partition(":")
    path = tmp_path / f"{name}.json"
    path.write_text(json.dumps(bound(forged)))
    entry = {"verdict": original["verdict"], "goal_digest": bound(original)["goal_digest"],
             "certificate": hashlib.sha256(path.read_bytes()).hexdigest()}
    assert check_file(path, Manifest(paper, {name: entry}))[2]


@pytest.mark.parametrize("number", range(len(HOSTILE)), ids=[name for name, _ in HOSTILE])
def test_a_hostile_expression_is_refused_in_bounded_time(number):
    started = time.process_time()
    with pytest.raises(CertificateError):
        check(copy.deepcopy(HOSTILE[number][1]))
    assert time.process_time() - started < LONGEST


@pytest.mark.parametrize("number", range(len(FILES)), ids=[name for name, _ in FILES])
def test_a_file_that_is_no_certificate_is_refused(number, tmp_path):
    path = tmp_path / "1.json"
    path.write_text(FILES[number][1])
    digest = bound(SOUND)["goal_digest"]
    assert check_file(path, None, digest)[2]


def test_the_genuine_one_is_accepted_and_there_are_enough_forged_ones(tmp_path):
    path = tmp_path / "1.json"
    path.write_text(json.dumps(bound(SOUND)))
    assert check_file(path, None, bound(SOUND)["goal_digest"])[2] is None
    assert check_file(path, Manifest("doe2026", {}))[2]
    assert {certificate["verdict"] for certificate in FEW} >= {"proved", "refuted"}
    assert len(FALSE) + len(OTHERS) + len(HOSTILE) + len(FILES) >= 150
