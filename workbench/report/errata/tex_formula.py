"""Which formulas may stand in a document of TeX: mathematics alone, because TeX reads and writes files."""

from __future__ import annotations

import re

from latex2mathml.symbols_parser import convert_symbol

from workbench.proof.latex.commands import ENVIRONMENTS, EQUIVALENT, IMPLIES, KNOWN, QUANTIFIERS

MATHEMATICS = KNOWN | IMPLIES | EQUIVALENT | QUANTIFIERS
MATRICES = frozenset(("matrix", "pmatrix", "bmatrix", "Bmatrix", "vmatrix", "Vmatrix", "smallmatrix"))
_COMMAND = re.compile(r"\\([A-Za-z]+|.)", re.DOTALL)
_ENVIRONMENT = re.compile(r"\\(?:begin|end)\{(?:" + "|".join(map(re.escape, ENVIRONMENTS | MATRICES)) + r")\}")


def is_mathematics(latex: str) -> bool:
    r"""Whether a formula has no command but those of mathematics, and ends where it is said to: not `\input`, not
    `^^5c`, which is a backslash to TeX, no comment, which would hide what follows, no brace too many."""
    rest = _ENVIRONMENT.sub(" ", latex)
    words = _COMMAND.findall(rest)
    bare = _COMMAND.sub(" ", rest)
    return all(map(_known, words)) and _balanced(bare) and not any(sign in bare for sign in ("^^", "%", "#", "\\"))


def _known(word: str) -> bool:
    """Any sign behind a backslash is one of mathematics or prints itself."""
    return not word.isalpha() or word in MATHEMATICS or convert_symbol(f"\\{word}") is not None


def _balanced(text: str) -> bool:
    depth = 0
    for sign in text:
        depth += (sign == "{") - (sign == "}")
        if depth < 0:
            return False
    return depth == 0
