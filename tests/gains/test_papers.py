"""Every paper's gains: certificates hold, committed ones too; what is proved agrees with an independent number."""

import copy
import json
import re
import shutil
from functools import cache

import pytest
from command_line import run
from scenarios import PROOFS, TRAIN_PAPERS

from workbench.cli.loading import load
from workbench.gains.certificate import write_certificates
from workbench.gains.stated import Stated
from workbench.paper.gain_effects import gains_of
from workbench.paper.gain_search import gain_search_of
from workbench.proof.checker import MANIFEST, CertificateError, check, check_folder
from workbench.proof.document import certificate_text

EVERY = tuple(TRAIN_PAPERS)


def committed_folder(paper):
    return PROOFS / paper / "certificates" / "gains"


@cache
def report_of(paper):
    return gains_of(load(PROOFS / paper))


def committed(paper):
    return {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in committed_folder(paper).glob("*.json")
            if path.name != MANIFEST}


def known_claims(paper):
    claims = {path.stem for path in (PROOFS / paper / "certificates").glob("*.json")}
    return {f"{paper}:{name}" for name in claims} | {c["claim"] for c in report_of(paper).certificates}


# --- certificates -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("paper", EVERY)
def test_every_certificate_holds_and_has_its_own_name(paper):
    certificates = report_of(paper).certificates
    names = [c["claim"] for c in certificates]
    assert len(set(names)) == len(names) > 0
    for certificate in certificates:
        check(json.loads(certificate_text(certificate)))


@pytest.mark.parametrize("paper", EVERY)
def test_the_committed_certificates_are_those_of_the_command(paper):
    """Same claims and same statements with their unknowns; the numbers found may differ in the last digit elsewhere."""
    found = {c["claim"].partition(":")[2]: c for c in report_of(paper).certificates}
    kept = committed(paper)
    assert kept.keys() == found.keys()
    for name, certificate in kept.items():
        assert certificate.get("conditions") == found[name].get("conditions"), name
        assert certificate.get("infeasible") == found[name].get("infeasible"), name
        if "conditions" not in certificate and "infeasible" not in certificate and "flow" in certificate["goal"]:
            assert certificate["goal"]["flow"].keys() == found[name]["goal"]["flow"].keys(), name


def turned(certificate):
    """The same with one number of what is shown changed."""
    broken = copy.deepcopy(certificate)
    shown = broken["goal"]["show"]
    place = next(i for i in reversed(range(len(shown))) if re.search(r"\d", shown[i]))
    # The first whole number that stands alone, made seven times as large with the other sign.
    broken["goal"]["show"][place] = re.sub(r"(?<![\w/])([1-9]\d*)(?![\w/])", lambda m: f"(0-7*{m[1]})", shown[place],
                                           count=1)
    return broken


@pytest.mark.parametrize("paper", EVERY)
def test_tampered_statements_and_proofs_are_refused(paper):
    refused = 0
    for name, certificate in committed(paper).items():
        without = copy.deepcopy(certificate)
        proof = without["proofs"][-1]
        while proof["rule"] != "combination":
            proof = proof.get("then") or proof.get("nonnegative") or proof.get("zero") or next(
                v for v in proof.values() if isinstance(v, dict))
        if not proof["terms"]:
            continue
        proof["terms"].pop()
        with pytest.raises(CertificateError):
            check(without)
        if turned(certificate) != certificate:
            with pytest.raises(CertificateError):
                check(turned(certificate))
            refused += 1
        renamed = {**certificate, "claim": certificate["claim"] + "x"}
        assert renamed["claim"] != f"{paper}:{name}"
    assert refused > 0


def test_a_certificate_under_another_name_is_refused(tmp_path):
    certificate = report_of("liu2020").certificates[0]
    write_certificates([certificate], tmp_path)
    assert [reason for *_, reason in check_folder(tmp_path)] == [None]
    path = tmp_path / f"{certificate['claim'].partition(':')[2]}.json"
    path.rename(path.with_name("decay.value2.json"))
    found = {place.name: reason for place, _, reason in check_folder(tmp_path)}
    assert "missing" in found[path.name] and "names no such certificate" in found["decay.value2.json"]
    (tmp_path / "manifest.json").unlink()
    assert "bound to no claim" in check_folder(tmp_path)[0][2]


# --- what a report says -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("paper", EVERY)
def test_whatever_is_said_names_the_certificate_that_shows_it(paper):
    report, known = report_of(paper), known_claims(paper)
    assert report.paper == paper
    assert report.conditions and report.quantities and report.found
    for entry in (*report.quantities, *report.found):
        assert entry.certificate in known, entry.name
    for condition in report.conditions:
        assert not condition.certificate or condition.certificate in known, condition.name


@pytest.mark.parametrize("paper", EVERY)
def test_a_condition_that_a_claim_decides_has_that_claims_verdict(paper):
    for condition in report_of(paper).conditions:
        path = PROOFS / paper / "certificates" / f"{condition.certificate.partition(':')[2]}.json"
        if condition.certificate and path.exists():
            verdict = json.loads(path.read_text(encoding="utf-8"))["verdict"]
            assert condition.met == (verdict == "proved"), condition.name


@pytest.mark.parametrize("paper", EVERY)
def test_found_gains_are_exact_and_their_changes_are_keys_of_the_file(paper):
    loaded = load(PROOFS / paper)
    stated = Stated(loaded.path, loaded.data)
    for found in report_of(paper).found:
        for key, value in found.changes.items():
            assert type(stated.entry(key)) is type(value) or isinstance(value, str), key
            name = key.rpartition(".")[2]
            if name in found.values and isinstance(value, float):
                assert value == float(found.values[name])


@pytest.mark.parametrize("paper", EVERY)
def test_every_found_set_is_simulated_beside_the_stated_gains(paper):
    report = report_of(paper)
    tasks = gain_search_of(load(PROOFS / paper)).tasks(report)
    assert {found.name for found in report.found} <= {task.gains for task in tasks}
    for task in tasks:
        assert any(other.gains == "stated" and other.setting == task.setting for other in tasks), task.setting


# --- mistakes -----------------------------------------------------------------------------------------------------


def test_the_command_writes_its_document(tmp_path):
    done = run("gains", "chen2019", "--no-runs", "--json", tmp_path / "g.json", "--certificates", tmp_path / "c")
    assert done.returncode == 0, done.stderr
    document = json.loads((tmp_path / "g.json").read_text(encoding="utf-8"))
    assert document["version"] == 1
    assert document["paper"] == "chen2019"
    assert not next(c for c in document["conditions"] if c["name"] == "c_lambda")["met"]
    assert {s["name"] for s in document["found"]} == {"repaired", "best"}
    written = [path for path in (tmp_path / "c").rglob("*.json") if path.name != "manifest.json"]
    assert len(written) == len(document["certificates"])
    assert "c_λ" in done.stdout


def test_an_unknown_paper_is_one_line_and_exit_code_2():
    done = run("gains", "nobody2020")
    assert done.returncode == 2
    assert done.stderr.strip().count("\n") == 0
    assert "nobody2020: is no file, folder or paper here" in done.stderr


def own_copy(paper, place, old="", new=""):
    """A copy of a paper's folder under another name, with a mistake in its study.toml."""
    folder = place / "mine"
    shutil.copytree(PROOFS / paper, folder, ignore=shutil.ignore_patterns("certificates"))
    text = (folder / "study.toml").read_text(encoding="utf-8")
    assert old in text
    (folder / "study.toml").write_text(text.replace(old, new, 1), encoding="utf-8")
    return folder


MISTAKES = [
    ('c_1 = 0.01', 'c_0 = 0.01', "gains.c_0: unknown key"),
    ('c_1 = 0.01', 'c_1 = "much"', "gains.c_1: "),
    ('c_1 = 0.01', 'c_1 = nan', "gains.c_1: nan is not a finite number"),
    ('c_1 = 0.01', 'c_1 = -0.01', "gains.c_1: "),
    ('paper = "chen2019"', 'paper = ["a"]', "paper: "),
    ('kind = "study"', 'kind = "tale"', "kind: "),
]


@pytest.mark.parametrize(("old", "new", "message"), MISTAKES)
def test_a_mistake_in_the_file_is_one_line_that_names_the_key(tmp_path, old, new, message):
    done = run("gains", str(own_copy("chen2019", tmp_path, old, new)), "--no-runs")
    assert done.returncode == 2, done.stdout + done.stderr
    assert message in done.stderr
    assert done.stderr.strip().count("\n") == 0


def test_numbers_that_the_search_is_not_made_for_are_one_line(tmp_path):
    done = run("gains", str(own_copy("mao2018", tmp_path, "amplitude = 0.001", "amplitude = 0.0")), "--no-runs")
    assert done.returncode == 2
    assert "mao2018:damping" in done.stderr or "the search of gains fails on its numbers" in done.stderr
    assert done.stderr.strip().count("\n") == 0


@pytest.mark.parametrize(("file", "words"), [
    ("gains.py", "gains.py: is missing, or holds no GainSearch"), ("lyapunov.py", "gains.py: cannot be imported: ")])
def test_a_missing_file_of_the_folder_is_said(tmp_path, file, words):
    folder = own_copy("yang2021", tmp_path)
    (folder / file).unlink()
    done = run("gains", str(folder), "--no-runs")
    assert done.returncode == 2
    assert done.stderr.strip().count("\n") == 0
    assert words in done.stderr
