"""Errata as files: Markdown, LaTeX, HTML, PDF and the findings for programs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from workbench.files.writing import make_folder, write_bytes, write_text
from workbench.proof.verdict import Decision
from workbench.report.errata.content import errata
from workbench.report.errata.latex import latex_document
from workbench.report.errata.markdown import markdown
from workbench.report.errata.page import html_document
from workbench.report.errata.pdf import pdf_of
from workbench.report.finding import findings
from workbench.report.finding_sentences import findings_document

FILES = ("errata.md", "errata.tex", "errata.html", "findings.json", "errata.pdf")
ANOTHER_FOLDER = "name another folder"
NO_PDF = "errata.pdf is not written, because Typst is not installed: pip install typst"


def errata_texts(decisions: Sequence[Decision], citation: str,
                 at_hand: bool = True) -> dict[str, str]:
    """The text of every file but the PDF, by its name; at_hand: as `errata` takes it."""
    blocks = errata(decisions, citation, at_hand)
    document = {"version": 1, **findings_document(findings(decisions))}
    title = f"Corrections: {citation}"
    return {"errata.md": markdown(blocks), "errata.tex": latex_document(blocks),
            "errata.html": html_document(blocks, title),
            "findings.json": json.dumps(document, indent=1, ensure_ascii=False) + "\n"}


def write_errata(decisions: Sequence[Decision], citation: str, out: Path,
                 at_hand: bool = True) -> tuple[list[Path], str | None]:
    """Write the errata of a paper into a folder; the files, and what could not be written in one line. at_hand: as
    `errata` takes it.

    Raises InputError where the folder cannot be written.
    """
    make_folder(out, out, ANOTHER_FOLDER)
    written = []
    for name, text in errata_texts(decisions, citation, at_hand).items():
        write_text(out / name, text, ANOTHER_FOLDER)
        written.append(out / name)
    pdf = pdf_of(errata(decisions, citation, at_hand))
    if pdf is None:
        return written, NO_PDF
    write_bytes(out / "errata.pdf", pdf, ANOTHER_FOLDER)
    return [*written, out / "errata.pdf"], None
