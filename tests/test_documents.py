"""The documents: links lead somewhere, and the pages that `make docs` builds leave nothing out."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
GENERATED = re.compile(r"(?:\.\./)*generated/(\w+\.md)")
WRITTEN = {"commands.md", "gallery.md", "files_read.md", "files_written.md"}


@pytest.mark.parametrize("path", [*ROOT.glob("*.md"), *(path for path in DOCS.glob("**/*.md")
                                                        if path.parent.name != "generated")], ids=lambda p: p.stem)
def test_links_between_documents_lead_somewhere(path):
    for target in re.findall(r"\]\((?!https?:)([^)#\s]+)", path.read_text(encoding="utf-8").split("\n$$\n")[0]):
        made = GENERATED.fullmatch(target)
        assert (made and made[1] in WRITTEN) or (path.parent / target).exists(), target


def test_the_start_of_the_readme_says_what_is_found():
    """The lines that it shows of a run stand in the errata, which are made from the same decisions."""
    start = (ROOT / "README.md").read_text(encoding="utf-8").partition("## Start here")[2].partition("\n## ")[0]
    fate, _, finding, _, counts = start.split("```")[3].strip().splitlines()
    errata = (DOCS / "errata/yang2021/errata.md").read_text(encoding="utf-8")
    fate = fate.replace("l/μ", r"$l/\mu$")
    assert re.search(rf"^- {re.escape(fate)} See correction \d+\b.*\.$", errata, re.MULTILINE)
    for plain, formula in (("e₁ = 0.2075, k = 0.21", "$e_{1} = 0.2075$, $k = 0.21$"),
                           ("is 0.2075 and the right side 0.2.", "is $0.2075$ and the right side $0.2$."),
                           ("|e₁| ≤ 0.2", r"$\left|e_{1}\right| \le 0.2$")):
        assert plain in finding
        finding = finding.replace(plain, formula)
    assert finding in errata
    lines, words = re.fullmatch(r"(\d+) lines of the paper: (.*)", counts).groups()
    told = re.search(rf"Of {lines} lines, (?:\d+ of which the text implies [^,]*, )?(.*?)"
                     r"(?:; (?:one|\d+) more [^.]*)?\. Proved", errata)[1]
    assert re.findall(r"\d+", words) == re.findall(r"\d+", told)


def test_every_page_is_named_in_a_table_of_contents():
    named = set()
    for path in DOCS.glob("**/*.md"):
        for block in re.findall(r"```\{toctree\}\n(.*?)```", path.read_text(encoding="utf-8"), re.DOTALL):
            for line in block.splitlines():
                if line and not line.startswith(":"):
                    place = f"{path.parent.relative_to(DOCS).as_posix()}/{line}.md"
                    named |= {found.resolve() for found in DOCS.glob(place.removeprefix("./"))} if "*" in line else {
                        (path.parent / f"{line}.md").resolve()}
    pages = {path.resolve() for path in DOCS.glob("**/*.md") if path.parent.name != "generated"}
    assert pages - named == {DOCS / "index.md"}
