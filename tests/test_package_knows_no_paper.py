"""No paper of proofs/ is named anywhere in the package: what it needs of one it finds in the folder it is given."""

from collections.abc import Iterator
from pathlib import Path

import workbench
from workbench.files.folders import papers_in

PACKAGE = Path(workbench.__file__).parent
PROOFS = Path(__file__).parents[1] / "proofs"


def mentions(package: Path, names: list[str]) -> Iterator[str]:
    """Every line of a file below the package (a font too), and every path in it, that has one of the names in it."""
    for path in sorted(package.rglob("*")):
        if not path.is_file() or path.parent.name == "__pycache__":
            continue
        lines = [str(path.relative_to(package)), *path.read_text(encoding="utf-8", errors="replace").splitlines()]
        for number, line in enumerate(lines):
            yield from (f"{path}:{number}: {name}" for name in names if name.lower() in line.lower())


def test_the_package_names_no_paper():
    names = [folder.name for folder in papers_in(PROOFS)]
    assert len(names) >= 5
    assert list(mentions(PACKAGE, names)) == []


def test_a_mention_is_found_wherever_it_stands(tmp_path):
    (tmp_path / "room").mkdir()
    (tmp_path / "room" / "law.py").write_text('"""A law."""\n\n# as in Doe2026 (3)\n')
    (tmp_path / "room" / "page.html.j2").write_text("<p>doe2026</p>\n")
    (tmp_path / "room" / "doe2026_tables.txt").write_text("nothing\n")
    (tmp_path / "room" / "other.py").write_text("doe = 2026\n")
    found = [line.rpartition("/")[2] for line in mentions(tmp_path, ["doe2026"])]
    assert found == ["doe2026_tables.txt:0: doe2026", "law.py:3: doe2026", "page.html.j2:1: doe2026"]
