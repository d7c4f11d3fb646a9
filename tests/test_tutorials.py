"""The tutorials, run as they stand: every command of a console block, its output compared with the lines below it."""

import re
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from workbench.cli.app import app
from workbench.cli.terminal import out_console

ROOT = Path(__file__).resolve().parent.parent
TUTORIALS = sorted((ROOT / "docs" / "tutorials").glob("*.md"))
BLOCK = re.compile(r"(?:<!-- file: (?P<file>[\w./-]+) -->\n)?```(?P<kind>\w+)\n(?P<body>.*?)```", re.DOTALL)


def commands(body):
    """Each command of a console block, and the lines that stand below it."""
    found = []
    for line in body.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


def as_pattern(lines):
    """The lines as a pattern: `...` alone is any lines, within a line anything; spaces count as one."""
    parts = [r"(?:.*\n)*?" if line.strip() == "..." else
             r"\s*" + r"\s+".join(re.escape(word).replace(r"\.\.\.", ".*") for word in line.split()) + r"\s*\n"
             for line in lines]
    return re.compile("".join(parts) + r"\s*")


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_every_command_of_a_tutorial_says_what_stands_below_it(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ran = 0
    for block in BLOCK.finditer(path.read_text(encoding="utf-8")):
        if block["file"]:
            Path(block["file"]).write_text(block["body"], encoding="utf-8")
        for command, lines in commands(block["body"]) if block["kind"] == "console" else ():
            out_console.stderr = False
            done = CliRunner().invoke(app, shlex.split(command)[1:], catch_exceptions=False)
            assert done.exit_code == 0, f"{command}\n{done.output}"
            assert as_pattern(lines).fullmatch(done.stdout + "\n"), f"{command}\n{done.stdout}"
            ran += 1
    assert ran >= 1


def test_a_line_that_is_not_said_is_noticed():
    assert as_pattern(["a b", "...", "c ... d"]).fullmatch("a  b\nx\ny\nc 1 d\n\n")
    assert not as_pattern(["a b"]).fullmatch("a c\n")


@pytest.mark.parametrize("path", [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")], ids=lambda p: p.stem)
def test_links_between_documents_lead_somewhere(path):
    for target in re.findall(r"\]\((?!https?:)([^)#\s]+)", path.read_text(encoding="utf-8").split("\n$$\n")[0]):
        assert (path.parent / target).exists(), target
