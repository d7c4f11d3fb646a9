"""Of a paper's source no formula is proved, or refuted, for more than the sentence around it says."""

import pytest
from false_sources import CLAIMED, FALSE, TRUE

from workbench.errors import InputError
from workbench.paper.source.folder import write_from_source
from workbench.proof.latex.rows import ROWS, RowsFile, load_record

HEAD = r"""\documentclass{article}\newtheorem{lemma}{Lemma}\newtheorem{remark}{Remark}
\begin{document} The state is $x \in \mathbb{R}$, $D \in \mathbb{R}$ is known,
the positive constants $k$ and $c$ are gains.
\begin{equation} \dot x = -k x \end{equation}
"""


def outcomes(texts, folder):
    """The verdicts on the displays of each text, in one paper of all: each has a letter and a paragraph of its own."""
    parts = [text.replace("Z", f"z_{{{number}}}") for number, text in enumerate(texts)]
    letters = "".join(rf"It has $z_{{{number}}} \in \mathbb{{R}}$. " for number in range(len(texts)))
    (folder / "paper.tex").write_text("\n\n".join((HEAD + letters, *parts, r"\end{document}")))
    written = write_from_source("paper2030", folder, folder / "paper.tex")
    rows = [row for row in load_record(written.folder / ROWS, RowsFile).rows if row.title.startswith("Equation")]
    return {text: [written.verdicts[row.id] for row in rows if f"z_{{{number}}}" in row.printed]
            for number, text in enumerate(texts)}


def test_what_a_sentence_does_not_claim_is_not_proved(tmp_path):
    found = outcomes(FALSE, tmp_path)
    assert all(found.values()) and not {text: of for text, of in found.items() if of[-1] == "proved"}


def test_what_a_sentence_supposes_is_not_refuted(tmp_path):
    found = outcomes(TRUE, tmp_path)
    assert all(found.values()) and not {text: of for text, of in found.items() if {"refuted", "gap"} & {*of}}


def test_what_is_claimed_is_decided(tmp_path):
    found = outcomes(CLAIMED, tmp_path)
    assert {text: of[-1] for text, of in found.items()} == dict.fromkeys(CLAIMED, "proved")


def test_a_command_defined_anew_within_a_group_is_named(tmp_path):
    text = r"\def\p{x} {\def\p{x^2} } \begin{equation} \p \ge 0 \end{equation}"
    (tmp_path / "paper.tex").write_text(rf"{HEAD} {text} \end{{document}}")
    with pytest.raises(InputError, match=r"\\p is defined anew within braces") as refused:
        write_from_source("paper2030", tmp_path, tmp_path / "paper.tex")
    assert "\n" not in str(refused.value)
