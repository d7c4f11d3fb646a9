"""The certificate of a whole theorem: composed of what its proof uses, checked alone, void where a link is cut."""

import copy
import hashlib
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.proof import checker
from workbench.proof.checker import CertificateError, check, check_folder, goal_digest
from workbench.proof.document import bound, places, write_certificates
from workbench.proof.prove import prove
from workbench.proof.selection import targets

TEXT = '''
import sympy as sp

from workbench.proof.claim import D, Goal, at_least, at_most
from workbench.proof.paper import Paper

paper = Paper("doe2026", "nobody, nowhere")
x, y, W = sp.symbols("x y W", real=True)
k, V = sp.symbols("k V", positive=True)


@paper.claim("1", "a square", "inequality", "x", "proved")
def square() -> Goal:
    """Of every number."""
    return Goal((at_least(x**2, 0),))


@paper.claim("2", "a level", "inequality", "x", "proved", premises=("1",))
def level() -> Goal:
    """By the square."""
    return Goal((at_most(V, x**2 + k),), (*paper.shown("1"), at_most(V, k)))


@paper.claim("3", "its rate", "inequality", "x", "proved")
def rate() -> Goal:
    """Along the flow."""
    return Goal((at_most(D(y**2), 0),), flow={y: -k * y})


paper.axiom("4", "a cited lemma", "w", "somebody's lemma", hypotheses=("3",))


@paper.claim("5", "beside it", "inequality", "x", "proved")
def beside() -> Goal:
    """No part of the theorem."""
    return Goal((at_least(x**2 + 1, 0),))


@paper.claim("theorem1", "the theorem", "inequality", "x", "proved", premises=("2", "4"), severity="result")
def theorem() -> Goal:
    """By the level, where there is one."""
    return Goal((at_most(V, x**2 + y**2 + k),), (at_least(k, 1), *paper.shown("2"), at_least(W, 0)))
'''


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The paper's folder of certificates, and the certificate of its theorem as a whole."""
    folder = tmp_path_factory.mktemp("whole") / "doe2026"
    (folder / "claims").mkdir(parents=True)
    (folder / "paper.py").write_text('"""A paper."""\n' + TEXT)
    proof = prove(targets([str(folder)]), jobs=1, use_cache=False)
    assert {d.verdict for d in proof.decisions} == {"proved", "assumed"}
    write_certificates(proof.decisions, places(proof, None))
    return folder, json.loads((folder / "certificates" / "theorems" / "theorem1.json").read_text())


def test_it_holds_all_that_the_proof_uses_and_says_what_it_assumes(written):
    _, whole = written
    parts = whole["composition"]
    assert set(parts["certificates"]) == {"1", "2", "3"} and set(parts["cited"]) == {"4"}
    assert [(link["of"], link["by"]) for link in parts["links"]] == [("2", "1"), ("theorem1", "2")]
    goals = {**{name: part["goal"] for name, part in parts["certificates"].items()}, "theorem1": whole["goal"]}
    assert all(goals[link["of"]]["assume"][link["assume"]] == goals[link["by"]]["show"][link["show"]]
               for link in parts["links"])
    assert "V <= k" in parts["assumes"]["2"] and "x**2 >= 0" not in parts["assumes"]["2"]
    shown = parts["certificates"]["2"]["goal"]["show"]
    assert parts["assumes"]["theorem1"] == [text for text in whole["goal"]["assume"] if text not in shown]


def test_one_command_of_the_checker_alone_re_checks_it(written):
    folder, whole = written
    path = folder / "certificates" / "theorems" / "theorem1.json"
    done = subprocess.run([sys.executable, "-I", checker.__file__, str(path), "--claim-digest", goal_digest(whole)],
                          capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.split()[:2]) == (0, ["ok", "proved"])


def change(*way, value):
    def changed(whole):
        part = whole
        for key in way[:-1]:
            part = part[key]
        if value is None:
            del part[way[-1]]
        else:
            part[way[-1]] = value(part[way[-1]]) if callable(value) else value
    return changed


def in_part(name, *way, value):
    """A change of one of the certificates, with the digest that its forger writes, where others name it too."""
    def changed(whole):
        parts = {**whole["composition"]["certificates"], "theorem1": whole}
        before = parts[name]["goal_digest"]
        change(*way, value=value)(parts[name])
        parts[name]["goal_digest"] = after = goal_digest(parts[name])
        for part in parts.values():
            part["premises"] = {other: after if digest == before else digest
                                for other, digest in part.get("premises", {}).items()}
    return changed


P = "composition"
CUT = {
    "a premise left out": change(P, "certificates", "1", value=None),
    "a premise of another goal": in_part("1", "goal", "show", value=["x**2 + 1 >= 0"]),
    "a premise that is false": in_part("1", "goal", "show", value=["x**2 < 0"]),
    "a premise with another proof": change(P, "certificates", "1", "proofs", value=[{"rule": "identity"}]),
    "a premise under another name": change(P, "certificates", "1", "claim", value="doe2026:9"),
    "a premise of another paper": change(P, "certificates", "1", "claim", value="else:1"),
    "a premise that is refuted": change(P, "certificates", "1", "verdict", value="refuted"),
    "a premise that assumes more": in_part("1", "goal", "assume", value=["x >= 0"]),
    "another digest of a premise": change("premises", "2", value="0" * 64),
    "no digest of a premise": change("premises", "2", value=lambda _: False),
    "a premise not named": change("premises", "2", value=None),
    "a premise not named below": change(P, "certificates", "2", "premises", "1", value=None),
    "something that nobody uses": change(P, "certificates", value=lambda parts: {**parts, "8": {
        **copy.deepcopy(parts["1"]), "claim": "doe2026:8"}}),
    "a circle": lambda whole: whole["composition"]["certificates"]["1"].update(
        premises={"2": whole["composition"]["certificates"]["2"]["goal_digest"]}),
    "the theorem as a part of itself": lambda whole: whole["composition"]["certificates"].update(
        theorem1={k: v for k, v in whole.items() if k != "composition"}),
    "a composition in a part": lambda whole: whole["composition"]["certificates"]["1"].update(
        composition={"certificates": {}, "cited": {}, "links": [], "assumes": {}}),
    "a cited result not named": change(P, "cited", "4", value=None),
    "a cited result without its hypotheses": change(P, "cited", "4", value=lambda _: {}),
    "another hypothesis of a cited result": change(P, "cited", "4", "3", value="0" * 64),
    "a cited result more": change(P, "cited", value=lambda cited: {**cited, "7": {}}),
    "a proved claim that is cited too": change(P, "cited", value=lambda cited: {**cited, "1": {}}),
    "a link to another assumption": change(P, "links", 0, "assume", value=0),
    "a link beyond the assumptions": change(P, "links", 0, "assume", value=99),
    "a link to another relation": change(P, "links", 0, "show", value=3),
    "a link from another premise": change(P, "links", 0, "by", value="3"),
    "a link from what is no premise": change(P, "links", 1, "by", value="1"),
    "a link twice": change(P, "links", value=lambda links: [*links, links[0]]),
    "a link left out": change(P, "links", value=lambda links: links[1:]),
    "an assumption left out": change(P, "assumes", "2", value=lambda texts: texts[1:]),
    "another assumption": change(P, "assumes", "2", value=lambda texts: ["1 <= 2", *texts[1:]]),
    "assumptions of a part left out": change(P, "assumes", "1", value=None),
    "no links": change(P, "links", value=None), "no assumptions": change(P, "assumes", value=None),
    "a word more": change(P, value=lambda parts: {**parts, "trust": "me"}),
    "links that are none": change(P, "links", value={"of": "2"}), "parts that are none": change(
        P, "certificates", value=lambda _: []), "a composition that is none": change(P, value=lambda _: "all of it"),
    "the theorem's goal": in_part("theorem1", "goal", "show", value=["V <= k"]),
    "the theorem's verdict": change("verdict", value="gap"),
}


@pytest.mark.parametrize("name", CUT)
def test_a_cut_link_voids_it(name, written):
    whole = copy.deepcopy(written[1])
    check(whole)
    CUT[name](whole)
    assert whole != written[1]
    with pytest.raises(CertificateError):
        check(bound(whole))


def test_no_relation_of_a_rate_is_linked():
    """The same text speaks of another rate under another flow."""
    part = bound({"claim": "doe2026:1", "verdict": "proved", "goal": {
        "assume": [], "show": ["D(x) <= 0"], "flow": {"x": "-1"}}, "example": {"x": "0"},
        "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": []}]}]})
    check(part)
    goal = {"assume": ["D(x) <= 0"], "show": ["D(x) <= 1"], "flow": {"x": "v"}}
    proofs = [{"rule": "combination", "terms": [{"coefficient": "1", "factors": [{"assume": 0}]},
                                                {"coefficient": "1", "factors": []}]}]
    whole = {"claim": "doe2026:2", "verdict": "proved", "goal": goal, "example": {"x": "0", "v": "0"},
             "proofs": proofs, "premises": {"1": part["goal_digest"]}, "composition": {
                 "certificates": {"1": part}, "cited": {}, "assumes": {"1": [], "2": []},
                 "links": [{"of": "2", "assume": 0, "by": "1", "show": 0}]}}
    with pytest.raises(CertificateError, match="is not shown by 1"):
        check(bound(whole))
    whole["composition"] |= {"links": [], "assumes": {"1": [], "2": ["D(x) <= 0"]}}
    check(bound(whole))


def checked(folder):
    done = CliRunner().invoke(app, ["check-certificates", str(folder)])
    return done.exit_code, " ".join(done.output.split())


def test_the_folder_s_check_covers_it(written):
    folder, _ = written
    code, said = checked(folder)
    assert code == 0, said
    assert "held against the goals of their papers' claims: 6" in said


@pytest.mark.parametrize(("forge", "says"), [
    (lambda place: (place / "theorem1.json").unlink(), "missing"),
    (lambda place: [path.unlink() for path in place.iterdir()], "its certificate as a whole is missing"),
    (lambda place: (place / "5.json").write_text((place.parent / "5.json").read_text()), "stands by it"),
    (lambda place: rewrite(place, lambda whole: whole.pop("composition")), "is not composed of the claims"),
    (lambda place: rewrite(place, lambda whole: whole["composition"]["cited"].update({"4": {}})
                           or (whole["composition"]["certificates"].pop("3")
                           and whole["composition"]["assumes"].pop("3"))), "with other hypotheses"),
])
def test_a_theorem_without_its_whole_certificate_is_told(forge, says, written, tmp_path):
    folder = Path(shutil.copytree(written[0], tmp_path / "doe2026"))
    forge(folder / "certificates" / "theorems")
    code, said = checked(folder)
    assert code == 1
    assert says in said, said


def rewrite(place, forge):
    """A forged theorem, with a manifest that names it."""
    whole = json.loads((place / "theorem1.json").read_text())
    forge(whole)
    (place / "theorem1.json").write_text(json.dumps(bound(whole)))
    manifest = json.loads((place / "manifest.json").read_text())
    manifest["claims"]["theorem1"]["certificate"] = hashlib.sha256((place / "theorem1.json").read_bytes()).hexdigest()
    (place / "manifest.json").write_text(json.dumps(manifest))


def test_it_is_of_the_certificates_beside_it(written, tmp_path):
    folder = Path(shutil.copytree(written[0] / "certificates", tmp_path / "certificates"))
    rewrite(folder / "theorems",
            lambda whole: whole["composition"]["certificates"]["3"].update(goal_digest="0" * 64))
    assert any(reason for path, _, reason in check_folder(folder) if path.parent.name == "theorems")


def test_no_composition_stands_for_the_premises_of_a_paper_s_certificate(written, tmp_path):
    """Outside of its folder it could bring premises of its own instead of those that the manifest names."""
    folder = Path(shutil.copytree(written[0] / "certificates", tmp_path / "certificates"))
    whole = (folder / "theorems" / "theorem1.json").read_bytes()
    (folder / "theorem1.json").write_bytes(whole)
    manifest = json.loads((folder / "manifest.json").read_text())
    manifest["claims"]["theorem1"]["certificate"] = hashlib.sha256(whole).hexdigest()
    (folder / "manifest.json").write_text(json.dumps(manifest))
    reasons = {path: reason for path, _, reason in check_folder(folder)}
    assert "lies in the folder theorems" in str(reasons[folder / "theorem1.json"])
