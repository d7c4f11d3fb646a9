"""Certificates that lie with a paper spare the search and nothing else: whatever they say is checked again."""

import json
import os
import shutil
from pathlib import Path

import pytest
from small_papers import IDS, TEXT, document, proved, write_paper
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.proof.document import places, write_certificates

SHOWN = set(IDS[:4])  # the fifth is assumed: nothing shows it


@pytest.fixture(scope="module")
def certified(tmp_path_factory):
    """The folder of a paper with its certificates beside it, decided once for all tests."""
    path = write_paper(tmp_path_factory.mktemp("certified") / "paper")
    found = proved(path, use_cache=False)
    write_certificates(found.decisions, places(found, None))
    return path.parent


@pytest.fixture
def paper(certified, tmp_path, monkeypatch):
    """A copy of the paper and its certificates, and an empty cache."""
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    return shutil.copytree(certified, tmp_path / "paper", ignore=shutil.ignore_patterns("__pycache__")) / "small2020.py"


def certificate(paper: Path, equation: str) -> Path:
    return paper.parent / "certificates" / "small2020" / f"{equation}.json"


def change(path: Path, **parts: object) -> None:
    path.write_text(json.dumps(json.loads(path.read_text()) | parts))


def test_what_they_show_is_what_a_search_finds(paper):
    shown = proved(paper)
    assert shown.certified == SHOWN
    assert document(shown, seconds=False) == document(proved(paper, use_cache=False), seconds=False)
    assert proved(paper).now == frozenset()
    assert proved(paper, use_cache=False).certified == frozenset()


def test_the_command_says_so_and_searches_anew_when_asked(paper):
    said = CliRunner().invoke(app, ["prove", str(paper), "--workers", "1"]).output
    assert "5 decided now (4 by the certificates at hand, checked again), 0 from the cache" in " ".join(said.split())
    said = CliRunner().invoke(app, ["prove", str(paper), "--no-cache", "--workers", "1"]).output
    assert "5 decided now, 0 from the cache" in " ".join(said.split())


def test_one_of_another_goal_is_passed_over(paper):
    """The printed line was changed after its certificate was written: what was true of x is not of this."""
    write_paper(paper.parent, TEXT.replace("x**2 + 2*x*y + y**2", "x**2 + 3*x*y + y**2"))
    found = proved(paper)
    assert found.certified == SHOWN - {IDS[0]}
    assert found.decisions[0].verdict == "refuted"


def nothing(path):
    path.unlink()


def no_json(path):
    path.write_text("{" * 50_000)


def no_text(path):
    path.write_bytes(b"\xff\x00")


def a_pipe(path):
    path.unlink()
    os.mkfifo(path)


def of_another_claim(path):
    path.write_text(certificate_of_four(path))


def renamed(path):
    path.write_text(certificate_of_four(path).replace("small2020:4", "small2020:1"))


def certificate_of_four(path):
    return path.with_name("4.json").read_text()


def with_another_verdict(path):
    change(path, verdict="refuted", point={"x": "1", "y": "1"})


def with_no_proof(path):
    change(path, proofs=[])


def with_a_false_proof(path):
    change(path, proofs=[{"rule": "combination", "terms": [{"coefficient": "1", "factors": []}]}])


def of_other_shapes(path):
    change(path, proofs={"rule": 3}, goal=["x"], example=None)


@pytest.mark.parametrize("spoil", [nothing, no_json, no_text, a_pipe, of_another_claim, renamed, with_another_verdict,
                                   with_no_proof, with_a_false_proof, of_other_shapes])
def test_one_that_shows_nothing_leads_to_a_search(paper, spoil):
    spoil(certificate(paper, "1"))
    found = proved(paper)
    assert found.certified == SHOWN - {IDS[0]}
    assert [d.verdict for d in found.decisions] == ["proved", "proved", "refuted", "proved", "assumed"]


def test_one_of_a_false_claim_cannot_make_it_true(paper):
    """A proof of the correction, put in the place of the claim's own."""
    path = certificate(paper, "3")
    of_correction = json.loads(path.read_text())["correction"]
    path.write_text(json.dumps({"claim": IDS[2], "version": 2, "verdict": "proved", **of_correction}))
    found = proved(paper)
    assert IDS[2] not in found.certified
    assert found.decisions[2].verdict == "refuted"


def test_what_else_a_file_says_is_not_taken_over(paper):
    change(certificate(paper, "1"), remark="forged", premises={"9": "0" * 64})
    found = proved(paper)
    assert found.certified == SHOWN
    assert not {"remark", "premises", "goal_digest"} & found.decisions[0].certificate.keys()
