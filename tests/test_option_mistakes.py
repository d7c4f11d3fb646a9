"""Values of options that are none: one line that names the option and what to give."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import run
from refusals import changed
from scenarios import PROOFS

from workbench.cli.option_mistakes import in_plain_words


@pytest.mark.parametrize(("arguments", "said"), [
    (("reference", "a.toml", "b.toml", "--time", "43:20"), "--time is no number: give one such as 2600 or 0.5"),
    (("report", "yang2021", "--runs", "0"), "--runs is too small: give 1 or more"),
    (("sweep", "yang2021", "--out", "o", "--runs", "many"), "--runs is no whole number: give one such as 10"),
    (("sweep", "yang2021", "--out", "o", "--draws", "sobel"),
     "--draws has no value 'sobel': did you mean 'sobol'? Else choose one of random, sobol"),
    (("prove", "yang2021", "--oracle", "cvc"), "--oracle has no value 'cvc': choose one of z3"),
    (("sweep", "yang2021", "--out", "o", "--controler", "pid"),
     "no such option --controler: did you mean '--controller'? Else choose one of --controller, --workers")])
def test_what_an_option_cannot_be_is_said_in_plain_words(arguments, said):
    ended = run(*arguments)
    assert ended.returncode == 2 and ended.stderr == (
        f"workbench: {arguments[0]}: {said}: see 'workbench {arguments[0]} --help'\n")


def test_what_is_not_of_a_number_stays():
    assert in_plain_words("No such option: --bogus") == "No such option: --bogus"


def test_certificates_that_are_nowhere_and_a_unit_without_its_ending_are_refused(tmp_path):
    ended = run("check-certificates", tmp_path / "nope")
    assert ended.returncode == 2 and "no such folder or file: check the path" in ended.stderr
    ended = run("check-certificates", PROOFS / "yang201")
    assert ended.returncode == 2 and ended.stderr.endswith(f"did you mean '{PROOFS / 'yang2021'}'?\n")
    ended = run("export-fmu", "yang2021", "pid", "--out", tmp_path / "pid.zip")
    assert ended.returncode == 2 and "end the name in .fmu" in ended.stderr


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="no /proc here")
@pytest.mark.parametrize("arguments", [
    ("report", "yang2021", "--out", "/proc"), ("report", "jiao2025", "--out", "/proc/x"),
    ("compare", "yang2021", "--json", "/proc/x.json"), ("sweep", "yang2021", "--out", "/proc/x"),
    ("tune", "yang2021", "--out", "/proc/x"), ("prove", "yang2021", "--json", "/proc/x.json"),
    ("prove", "yang2021", "--certificates", "/proc/x"), ("gains", "yang2021", "--certificates", "/proc/x"),
    ("errata", "yang2021", "--out", "/proc/x"), ("export-coq", "yang2021", "--out", "/proc/x")])
def test_a_place_that_keeps_no_files_is_refused_before_anything_runs(arguments):
    ended = run(*arguments)
    assert ended.returncode == 2 and ended.stdout == ""
    place, option = arguments[-1], arguments[-2]
    assert ended.stderr == (
        f"workbench: {place}: {option}: cannot be written (/proc may not be written): name another place\n")


@pytest.mark.parametrize(("option", "text", "said"), [
    ("--rare", "stopping_error", "'stopping_error' says no number behind '>': give 'METRIC>VALUE', in quotes"),
    ("--until-width", "stopping_error", "'stopping_error' says no number behind '=': give METRIC=WIDTH"),
    ("--until-width", "stopping_error=-1", "'-1' is no positive number: give a width in the unit of stopping_error")])
def test_half_of_an_option_is_asked_for_the_other_half(tmp_path, option, text, said):
    ended = run("sweep", "yang2021", "--out", tmp_path / "mc", option, text)
    assert ended.returncode == 2 and ended.stderr == f"workbench: {option}: {said}\n"


def test_a_kind_that_is_none_and_a_controller_without_ranges_are_told_which_there_are(tmp_path):
    text = (PROOFS / "yang2021" / "study.toml").read_text()
    (tmp_path / "line.toml").write_bytes((PROOFS / "yang2021" / "line.toml").read_bytes())
    (tmp_path / "study.toml").write_text(changed(text, 'kind = "davis_cruise"', 'kind = "davis_cruse"'))
    ended = run("compare", tmp_path / "study.toml")
    assert ended.returncode == 2 and ended.stderr.endswith(
        "reference: 'kind' = 'davis_cruse' is not known: choose one of 'davis_cruise', 'cruise_speed', 'table'\n")
    ended = run("tune", "yang2021", "--controller", "nobody")
    assert "tuning.ranges.nobody: is missing: add ranges there, or name one of rbfnn_pocrac, " in ended.stderr


def test_a_paper_lends_its_letters_by_its_name():
    ended = run("check", r"x = ", "--symbols", "yang2021")
    assert ended.returncode == 2 and "the line was read with the letters of " in ended.stderr
