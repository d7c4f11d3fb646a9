"""What Coq's kernel has accepted is said of the goals that it was shown, and of no others."""

import json
from dataclasses import replace

import pytest
from command_line import run

from workbench.kernel import coqc, record
from workbench.kernel.coqc import Checked
from workbench.kernel.record import accepted_goals, exported_texts
from workbench.proof.document import places, write_certificates
from workbench.proof.kernel_record import RECORD, write_record
from workbench.proof.prove import prove
from workbench.proof.selection import targets

CLAIMS = '''
import sympy as sp

from workbench.proof.claim import Goal, at_least
from workbench.proof.paper import Paper

paper = Paper("doe2031", "nobody, nowhere")
x = sp.Symbol("x", real=True)


@paper.claim("1", "true", "inequality", "x", "proved")
def true() -> Goal:
    return Goal((at_least(x**2, 0),))


@paper.claim("2", "false", "inequality", "x", "refuted")
def false() -> Goal:
    return Goal((at_least(x**2, 1),))
'''


@pytest.fixture
def paper(tmp_path, monkeypatch):
    """A paper's folder with its certificates."""
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    folder = tmp_path / "doe2031"
    folder.mkdir()
    (folder / "paper.py").write_text(CLAIMS)
    found = decided(folder)
    write_certificates(found.decisions, places(found, None))
    return folder


def decided(folder):
    return prove(targets([str(folder)]), jobs=1)


def trusts(folder):
    return {d.claim.equation: d.trust for d in decided(folder).decisions}


def rows(folder):
    """What check-coq finds of the paper's exports where the kernel accepts the first and refuses the second."""
    digests = {d.claim.id: json.loads((folder / "certificates" / f"{d.claim.equation}.json").read_text())["goal_digest"]
               for d in decided(folder).decisions}
    texts = exported_texts(folder)
    return [Checked(claim, outcome, goal_digest=digests[claim], text=texts[claim])
            for claim, outcome in zip(sorted(texts), ("accepted", "refused"), strict=True)]


def test_only_what_was_accepted_is_noted(paper):
    found, texts = rows(paper), exported_texts(paper)
    accepted = accepted_goals(found, texts)
    assert accepted == {"1": found[0].goal_digest}
    assert accepted_goals([replace(found[0], text="0" * 64)], texts) == {}
    assert accepted_goals([replace(found[0], claim="other2031:1")], texts) == {}
    assert accepted_goals([replace(found[0], text="")], {}) == {}
    # Of what lies in the folder the rows tell, of the rest what was noted.
    before = {(row.claim, row.goal_digest) for row in found}
    assert accepted_goals(found, texts, before) == accepted
    assert accepted_goals(found[1:], texts, before) == accepted
    assert accepted_goals(found[:1], texts, before) == accepted | {"2": found[1].goal_digest}


def test_a_verdict_says_so_until_its_goal_is_another_one(paper):
    assert trusts(paper) == {"1": "exact", "2": "exact"}
    write_record(paper, "8.16.1", accepted_goals(rows(paper), exported_texts(paper)))
    assert trusts(paper) == {"1": "kernel", "2": "exact"}
    assert "Coq's kernel accepts 1 of their 2 certificates too" in " ".join(run("prove", paper).stdout.split())
    (paper / "paper.py").write_text(CLAIMS.replace("at_least(x**2, 0)", "at_least(x**4, 0)"))
    assert trusts(paper) == {"1": "exact", "2": "exact"}


def test_what_was_noted_is_not_run_again_and_stays_noted(paper, tmp_path, monkeypatch):
    found, out, ran = rows(paper), tmp_path / "coq", []
    assert run("export-coq", paper, "--out", out).returncode == 0
    monkeypatch.setattr(coqc, "missing", lambda: None)
    monkeypatch.setattr(coqc, "_coqc", lambda folder, name, seconds: (ran.append(name), coqc.Ran("", "no coqc here"))[1]
                        if name.startswith("doe2031") else coqc.Ran(""))
    write_record(paper, "8.16.1", accepted_goals(found, exported_texts(paper)))
    monkeypatch.setattr(record, "missing", lambda: None)
    for version, again in (("8.16.1", 1), ("8.17.0", 2)):
        monkeypatch.setattr(record, "version", lambda version=version: version)
        noted = record.noted_before(paper, exported_texts(paper))
        ran.clear()
        outcomes = [row.outcome for row in coqc.check_folder(out, 1, 5, noted=noted)]
        assert (len(ran), outcomes) == (again, ["noted" if again == 1 else "refused", "refused"])
        assert len(accepted_goals(coqc.check_folder(out, 1, 5, noted=noted), exported_texts(paper))) == 2 - again
        ran.clear()
        outcomes = [row.outcome for row in coqc.check_folder(out, 1, 5, only=["doe2031:2"])]
        assert (len(ran), outcomes) == (1, ["left out", "refused"])


def test_what_is_new_is_said_by_a_record(tmp_path):
    done = run("check-coq", tmp_path, "--only-new")
    assert done.returncode == 2
    assert "--record" in done.stderr


@pytest.mark.parametrize("text", ["", "{", f"{'0' * 64} 1", "accepted by Coq 8.16.1\nyes 1",
                                  f"accepted by Coq 8.16.1\n{'0' * 64} ../1", f"accepted by Coq 8.16.1\n{'0' * 64}"])
def test_what_is_no_record_is_said_in_a_line(paper, text):
    (paper / RECORD).write_text(text)
    done = run("prove", paper)
    assert done.returncode == 2
    assert RECORD in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_a_paper_without_certificates_has_nothing_to_note(tmp_path):
    done = run("check-coq", tmp_path, "--record", tmp_path)
    assert done.returncode == 2
    assert "prove --write" in done.stderr
