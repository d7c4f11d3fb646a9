"""What a command says, where standard output is closed or its terminal has few letters."""

import io
import sys
from pathlib import Path

from command_line import one_line, run

from workbench.files.streams import ready_streams


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
