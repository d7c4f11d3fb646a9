"""Values of options that are none: one line that names the option and what to give."""

from __future__ import annotations

import pytest
from command_line import run

from workbench.cli.option_mistakes import in_plain_words


@pytest.mark.parametrize(("arguments", "said"), [
    (("reference", "a.toml", "b.toml", "--time", "43:20"), "--time is no number: give one such as 2600 or 0.5"),
    (("report", "yang2021", "--runs", "0"), "--runs is too small: give 1 or more"),
    (("sweep", "yang2021", "--out", "o", "--runs", "many"), "--runs is no whole number: give one such as 10")])
def test_a_number_that_is_none_is_said_in_plain_words(arguments, said):
    ended = run(*arguments)
    assert ended.returncode == 2 and ended.stderr == (
        f"workbench: {arguments[0]}: {said}: see 'workbench {arguments[0]} --help'\n")


def test_what_is_not_of_a_number_stays():
    assert in_plain_words("No such option: --bogus") == "No such option: --bogus"


def test_certificates_that_are_nowhere_and_a_unit_without_its_ending_are_refused(tmp_path):
    ended = run("check-certificates", tmp_path / "nope")
    assert ended.returncode == 2 and "no such folder or file: check the path" in ended.stderr
    ended = run("export-fmu", "yang2021", "pid", "--out", tmp_path / "pid.zip")
    assert ended.returncode == 2 and "end the name in .fmu" in ended.stderr
