"""Certificates and curves: nothing outside the folder asked for, nothing of someone else's overwritten or deleted."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import refusal

from workbench.errors import ClaimError
from workbench.gains.certificate import write_certificates as write_gains
from workbench.paper.results import Curve
from workbench.proof.checker import check_folder
from workbench.proof.document import Places, check_places, write_certificates, write_folder
from workbench.proof.verdict import Decision, Stated, is_equation, is_paper_name
from workbench.report.charts.chart import Chart, Panel
from workbench.report.charts.files import write_curves

MINE = '{"mine": 1}\n'


def decision(equation: str, paper: str = "doe2026", proved: bool = True) -> Decision:
    claim = Stated(id=f"{paper}:{equation}", title="t", kind="identity", printed="x", recorded="proved")
    certificate = {"claim": claim.id, "version": 1, "verdict": "proved",
                   "goal": {"assume": [], "show": ["0 < 1"]}, "example": {},
                   "proofs": [{"rule": "combination", "terms": [{"coefficient": "1", "factors": []}]}]}
    return Decision(claim, "proved" if proved else "undecided", "m", "exact", 0.0, certificate if proved else None)


def tree(folder: Path) -> dict[str, str]:
    """All files below a folder and what they hold."""
    return {path.relative_to(folder).as_posix(): path.read_text() for path in sorted(folder.rglob("*"))
            if path.is_file() and not path.is_symlink()}


@pytest.mark.parametrize("paper", ["..", ".", "", "a/b", "a\\b", "a b", "a\0", "é", "/etc", "~", "C:", "x" * 101, "1a"])
def test_a_name_that_would_be_a_path_names_no_paper(paper):
    assert not is_paper_name(paper)
    with pytest.raises(ClaimError):
        decision("1", paper)


@pytest.mark.parametrize("equation", ["../x", "..", ".", "a/b", "", "manifest", "MANIFEST", "-x", ".hidden", "x" * 101,
                                      "a\0", "a\n", "a b", "é"])
def test_a_number_that_would_be_a_path_names_no_claim(equation):
    assert not is_equation(equation)
    with pytest.raises(ClaimError):
        decision(equation)


@given(paper=st.text(max_size=8), equation=st.text(max_size=8))
def test_whatever_is_accepted_is_one_plain_name(paper, equation):
    for text, accepted in ((paper, is_paper_name(paper)), (equation, is_equation(equation))):
        if accepted:
            assert Path(text).name == text and text.isascii() and text.isprintable() and not text.startswith((".", "-"))


def test_certificates_of_gains_are_named_as_safely(tmp_path):
    for claim in ("../a:b", "a:../b", "a:manifest", "a:", "nothing"):
        made = [{"claim": claim, "verdict": "proved"}]
        assert "cannot name a certificate" in refusal(write_gains, made, tmp_path / "c")
    assert not any(tmp_path.iterdir())
    refusal(write_gains, [{"claim": "a:b", "verdict": "proved", "goal": {}}], tmp_path / "c" / "..", tmp_path / "c")
    refusal(write_gains, [{"claim": "a:b", "verdict": "proved", "goal": {}}], Path("/tmp/elsewhere"), tmp_path / "c")


def test_what_a_paper_no_longer_states_is_dropped_and_nothing_else(tmp_path):
    where = Places(tmp_path)
    write_certificates([decision("1"), decision("2")], where)
    assert [reason for *_, reason in check_folder(tmp_path)] == [None, None]
    folder = tmp_path / "doe2026"
    (folder / "package.json").write_text(MINE)
    (tmp_path / "notes.json").write_text(MINE)
    write_certificates([decision("2"), decision("3")], where)
    assert set(tree(tmp_path)) == {"notes.json", "doe2026/package.json", "doe2026/manifest.json", "doe2026/2.json",
                                   "doe2026/3.json"}
    assert (folder / "package.json").read_text() == MINE


def test_a_single_claim_drops_no_other(tmp_path):
    where = Places(tmp_path)
    write_certificates([decision("1"), decision("2")], where)
    write_certificates([decision("1", proved=False)], where, whole_papers=False)
    assert set(tree(tmp_path)) == {"doe2026/2.json", "doe2026/manifest.json"}


def manifest(folder: Path, text: str) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "manifest.json").write_text(text)


FORGED = {
    "paths": {"../mine": "0", "/etc/passwd": "0", "a/../../mine": "0", "manifest": "0"},
    "no texts": {"mine": 1, "1": None},
    "a name that is not ours": {"mine": "0" * 64},
}


@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize("certificates", FORGED.values(), ids=FORGED)
def test_a_forged_manifest_deletes_nothing(certificates, version, tmp_path):
    folder = tmp_path / "doe2026"
    listed = {name: {"verdict": "proved", "certificate": digest} for name, digest in certificates.items()}
    manifest(folder, json.dumps({"version": 1, "paper": "doe2026", "certificates": certificates} if version == 1 else
                                {"version": 2, "paper": "doe2026", "claims": listed}))
    for place in (tmp_path, folder):
        (place / "mine.json").write_text(MINE)
    write_certificates([decision("1")], Places(tmp_path))
    assert (tmp_path / "mine.json").read_text() == (folder / "mine.json").read_text() == MINE


@pytest.mark.parametrize("text", ["", "no JSON", "[]", "{}", '{"version": 2}', '{"name": "an app", "icons": []}',
                                  '{"version": 1, "paper": "doe2026", "certificates": []}', "[" * 100_000,
                                  '{"version": 2, "paper": "doe2026", "claims": []}',
                                  '{"version": 1, "paper": "other2020", "certificates": {}}'])
def test_a_manifest_that_is_not_ours_is_kept(text, tmp_path):
    manifest(tmp_path / "doe2026", text)
    assert "manifest" in refusal(write_certificates, [decision("1")], Places(tmp_path))
    assert tree(tmp_path) == {"doe2026/manifest.json": text}


@pytest.mark.parametrize("name", ["manifest.json", "1.json"])
@pytest.mark.parametrize("make", [lambda p: p.mkdir(), os.mkfifo, lambda p: p.symlink_to("/dev/zero"),
                                  lambda p: p.symlink_to(p), lambda p: p.symlink_to(p.parent / "mine.json")],
                         ids=["folder", "pipe", "device", "loop", "link"])
def test_what_is_no_file_in_a_certificates_place_is_kept(name, make, tmp_path):
    folder = tmp_path / "doe2026"
    folder.mkdir()
    (folder / "mine.json").write_text(MINE)
    make(folder / name)
    assert str(folder / name) in refusal(write_certificates, [decision("1")], Places(tmp_path))
    assert (folder / "mine.json").read_text() == MINE


def test_a_file_of_someone_elses_in_a_certificates_place_is_kept(tmp_path):
    folder = tmp_path / "doe2026"
    folder.mkdir()
    (folder / "1.json").write_text(MINE)
    assert "is not a file that the workbench wrote" in refusal(write_certificates, [decision("1")], Places(tmp_path))
    assert tree(folder) == {"1.json": MINE}


def test_a_certificate_that_no_manifest_names_is_known_by_its_claim(tmp_path):
    write_certificates([decision("1")], Places(tmp_path))
    path = tmp_path / "doe2026" / "1.json"
    path.write_text(path.read_text().replace("1\n", "1 \n"))
    (tmp_path / "doe2026" / "manifest.json").unlink()
    write_certificates([decision("1")], Places(tmp_path))
    assert [reason for *_, reason in check_folder(tmp_path)] == [None]


def test_a_stale_certificate_that_someone_has_changed_is_kept(tmp_path):
    write_certificates([decision("1"), decision("2")], Places(tmp_path))
    (tmp_path / "doe2026" / "1.json").write_text(MINE)
    write_certificates([decision("2")], Places(tmp_path))
    assert (tmp_path / "doe2026" / "1.json").read_text() == MINE


def test_names_that_many_disks_take_for_one_are_refused(tmp_path):
    assert "one file on many disks" in refusal(write_certificates, [decision("1a"), decision("1A")], Places(tmp_path))


@pytest.mark.parametrize("link", ["certificates", "certificates/doe2026", "certificates/gains"])
def test_a_link_leads_no_certificate_elsewhere(link, tmp_path):
    paper, other = tmp_path / "doe2026", tmp_path / "other"
    (paper / link).parent.mkdir(parents=True)
    other.mkdir()
    (other / "1.json").write_text(MINE)
    (paper / link).symlink_to(other)
    assert "link" in refusal(write_folder, paper / "certificates" / "gains" if "gains" in link else paper / link, paper,
                             "doe2026", {"1": ("undecided", None)}, True)
    assert tree(other) == {"1.json": MINE}
    if link == "certificates":
        assert "link" in refusal(check_places, [paper], None, {})


def test_no_other_output_lies_among_certificates(tmp_path):
    paper = tmp_path / "doe2026"
    (paper / "certificates").mkdir(parents=True)
    for json_file in (paper / "certificates" / "out.json", paper / "certificates" / "gains" / "out.json"):
        assert "lies among" in refusal(check_places, [paper], None, {"--json": json_file})
    check_places([paper], None, {"--json": paper / "out.json"})
    assert "lies among" in refusal(check_places, [paper], tmp_path / "c", {"--json": tmp_path / "c" / "x" / "1.json"})
    check_places([paper], tmp_path / "c", {"--json": tmp_path / "c" / "out.json"})
    (tmp_path / "file").write_text("")
    assert "--certificates" in refusal(check_places, [paper], tmp_path / "file", {})


def test_what_has_not_changed_is_not_written_again(tmp_path):
    decisions = [decision("1"), decision("2")]
    write_certificates(decisions, Places(tmp_path))
    before = {path: path.stat().st_ino for path in tmp_path.rglob("*.json")}
    write_certificates(decisions, Places(tmp_path))
    assert before == {path: path.stat().st_ino for path in tmp_path.rglob("*.json")}


def chart(title: str) -> Chart:
    curve = Curve("one", np.array([0.0, 1.0]), np.array([0.5, 2.0]))
    return Chart(title, "t in s", (Panel("x in m", (curve,)),))


def test_curves_of_an_earlier_report_go_and_others_stay(tmp_path):
    write_curves([chart("First: a/b"), chart("../Second")], tmp_path)
    assert set(tree(tmp_path)) == {"curves/01-first-a-b.csv", "curves/02-second.csv", "curves/manifest.json"}
    (tmp_path / "curves" / "03-mine.csv").write_text("t,x\n1,2\n")
    write_curves([chart("First: a/b")], tmp_path)
    assert set(tree(tmp_path)) == {"curves/01-first-a-b.csv", "curves/03-mine.csv", "curves/manifest.json"}
    (tmp_path / "curves" / "02-other.csv").write_text("t,x\n1,2\n")
    assert "is not a file that the workbench wrote" in refusal(write_curves, [chart("First"), chart("Other")], tmp_path)
    assert (tmp_path / "curves" / "02-other.csv").read_text() == "t,x\n1,2\n"
