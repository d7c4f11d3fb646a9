"""What a command says, where standard output is closed or its terminal has few letters."""

import io
import json
import os
import sys
from pathlib import Path

from command_line import one_line, run
from small_folders import small_folder, with_claims

from workbench.files.json_output import write_json
from workbench.files.outputs import STANDARD_OUTPUT
from workbench.files.streams import ready_streams
from workbench.model.laws import law_named


def test_a_closed_stream_keeps_nothing_and_fails_nothing(monkeypatch):
    monkeypatch.setattr(sys, "stdout", None)
    ready_streams()
    with sys.stdout as stream:
        stream.write("is lost")


def test_what_a_terminal_has_no_letter_for_is_written_by_its_number(monkeypatch):
    for encoding, said in (("ascii", b"x\\u2082 \\udcff"), ("utf-8", b"x\xe2\x82\x82 \\udcff")):
        written = io.BytesIO()
        monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding=encoding, write_through=True))
        ready_streams()
        sys.stdout.write("x\u2082 \udcff")
        assert written.getvalue() == said


def test_a_folder_that_is_gone_under_the_command_is_told(monkeypatch):
    def gone() -> Path:
        raise FileNotFoundError(2, "No such file or directory")

    monkeypatch.setattr(Path, "cwd", staticmethod(gone))
    said = one_line(run("list"))
    assert said == ("workbench: the folder you are in cannot be entered (No such file or directory): change to another "
                    "one")


def test_a_folder_whose_name_is_no_text_is_worked_in(tmp_path, monkeypatch):
    """As one of another system's letters: by its bytes on the disk, by their numbers where it is written."""
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))
    folder = with_claims(small_folder(tmp_path / os.fsdecode(b"caf\xe9") / "doe2030"), "section_2")
    for decided in ("1 decided now", "1 from the cache"):
        done = run("prove", folder, "--json", folder / "out.json")
        assert done.returncode == 0 and decided in done.stdout, done.stderr
        assert json.loads((folder / "out.json").read_text())["claims"][0]["verdict"] == "proved"
    law = law_named("doe2030.pd", folder)
    assert law is not None and law.title == "PD"


def test_json_is_json_on_a_terminal_of_few_letters(monkeypatch):
    for encoding in ("ascii", "utf-8"):
        written = io.BytesIO()
        monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(written, encoding=encoding, write_through=True))
        ready_streams()
        write_json(STANDARD_OUTPUT, {"é": "x\u2082"})
        assert json.loads(written.getvalue()) == {"é": "x\u2082"}
