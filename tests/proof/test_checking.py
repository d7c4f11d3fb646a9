"""Certificates checked in several processes: the rows of one process, whatever is wrong with which of them."""

import shutil

import pytest
from scenarios import ROOT

from workbench.proof import checking
from workbench.proof.checker import CertificateError, check, check_folder, exact_json


def test_several_processes_find_what_one_finds(tmp_path, monkeypatch):
    monkeypatch.setattr(checking, "WORTH_PROCESSES", 0)
    for paper in ("ilchmann2002", "goodwin1980"):
        shutil.copytree(ROOT / "proofs" / paper / "certificates", tmp_path / paper)
    spoiled = sorted((tmp_path / "goodwin1980").glob("*.json"))[0]
    spoiled.write_text(spoiled.read_text(encoding="utf-8").replace('"version": 2', '"version": 3'), encoding="utf-8")
    counted = []
    rows, _ = checking.check_all(tmp_path, {}, 2, lambda done, total: counted.append((done, total)))
    assert rows == check_folder(tmp_path)
    assert [path for path, _, reason in rows if reason] == [spoiled]
    assert len(counted) == 2 and counted[-1] == (len(rows), len(rows))  # certificates, a paper's at once


def test_a_part_of_a_theorem_that_was_changed_is_checked_though_its_certificate_was_accepted():
    folder = ROOT / "proofs" / "krstic1992" / "certificates"
    assert [reason for *_, reason in check_folder(folder) if reason] == []
    theorem = exact_json((folder / "theorems" / "decrease.json").read_text(encoding="utf-8"))
    check(theorem)
    theorem["composition"]["certificates"]["step1"]["example"]["c_1"] = "-3"  # where its assumptions do not hold
    with pytest.raises(CertificateError):
        check(theorem)
