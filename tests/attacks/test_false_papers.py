"""Of a text of which one word is not understood nothing is taken; what it claims in words that are is decided."""

from false_papers import FALSE, HEADS
from true_papers import TRUE

from workbench.paper.source.document import read_source
from workbench.paper.source.folder import rows_and_letters, write_from_source
from workbench.proof.latex.rows import ROWS, RowsFile, load_record

READ = 0.95  # of the true ones


def paper(manner, text, number="T"):
    shown = text.replace("[[", rf"\begin{{equation}} \tag{{{number}}} ").replace("]]", r"\end{equation}")
    return f"{HEADS[manner]}{shown}\n\\end{{document}}\n"


def row_of(manner, text):
    rows, letters, _ = rows_and_letters(read_source(paper(manner, text)))
    return next(row for row in rows if row.id == "T"), letters


def verdict(folder, manner, text):
    folder.mkdir()
    (folder / "paper.tex").write_text(paper(manner, text))
    return write_from_source("paper2030", folder, folder / "paper.tex").verdicts["T"]


def test_what_is_taken_back_or_rests_on_what_is_not_understood_is_neither_proved_nor_refuted(tmp_path):
    """Where it is a claim all the same, what would prove it is not taken."""
    found = {}
    for manner, texts in FALSE.items():
        for number, text in enumerate(texts):
            row, _ = row_of(manner, text)
            if row.role == "claim":
                found[text] = verdict(tmp_path / f"{manner}{number}", manner, text)
            else:
                assert row.role == "words" and row.unread, text
    assert len(found) < 25
    assert not {text: of for text, of in found.items() if of == "proved" or (of == "refuted" and "half" not in text)}


def test_what_is_claimed_is_read_and_what_its_letters_are(tmp_path):
    read = {text: row_of(manner, text) for manner, texts in TRUE.items() for text in texts}
    assert {row.role for row, _ in read.values()} == {"claim", "words"}
    assert sum(row.role == "claim" for row, _ in read.values()) >= READ * len(read)
    left = [text for text, (row, letters) in read.items() if row.role == "claim" and not all(
        entry.kind for letter, entry in letters.items() if letter != "u")]
    assert not left


def test_what_is_claimed_is_proved(tmp_path):
    for manner, texts in TRUE.items():
        assert verdict(tmp_path / manner, manner, texts[1]) == "proved", texts[1]


def test_what_is_not_understood_is_told(tmp_path):
    (tmp_path / "paper.tex").write_text(paper("thesis", r"Imagine that $z \ge 0$. We obtain [[z^3 \ge 0]]"))
    found = write_from_source("paper2030", tmp_path, tmp_path / "paper.tex")
    row = next(row for row in load_record(found.folder / ROWS, RowsFile).rows if row.id == "T")
    assert found.missing["T"].startswith("left to you: 'imagine' in 'Imagine that $z \\ge 0$ .'")
    assert (row.role, row.unread) == ("words", "'imagine' in 'Imagine that $z \\ge 0$ .'")
