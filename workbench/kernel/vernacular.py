"""Which sentences a Coq file may have: those of an export alone. Coq's other commands load programs, write files and
declare axioms, and a file may come from anybody."""

from __future__ import annotations

import re

from workbench.kernel.export import IMPORTS

COMMANDS = ("Definition", "Theorem", "Proof", "Qed", "Print Assumptions")
WHOLE = frozenset(("Require Import Reals Lra", "Open Scope R_scope",
                   *(line.removesuffix(".") for text in IMPORTS.values() for line in text.splitlines())))
_MARK = re.compile(r"\(\*|\*\)")
_END = re.compile(r"\.(?:\s+|$)")
_BULLETS = " \t\r\n{}+-*"


def strange_sentence(text: str) -> str | None:
    """The beginning of the first sentence that no export has; None where there is none. Tactics, which begin with a
    small letter, are as they may be: none of them does more than prove."""
    bare = without_comments(text)
    if bare is None or '"' in bare:  # a string may hide the end of a sentence
        return "a comment that does not end, or a string"
    for sentence in _END.split(bare):
        words = " ".join(sentence.strip(_BULLETS).split())
        tactic = "a" <= words[:1] <= "z"
        if words and not tactic and words not in WHOLE and not _begins_with_a_command(words):
            return f"'{words[:60]}'"
    return None


def _begins_with_a_command(words: str) -> bool:
    return any(words == command or words.startswith(f"{command} ") for command in COMMANDS)


def without_comments(text: str) -> str | None:
    """A text without its comments, which may stand in each other; None where one does not end, or none began."""
    found, at, depth = [], 0, 0
    for mark in _MARK.finditer(text):
        if depth == 0:
            found.append(text[at:mark.start()])
        depth += 1 if mark[0] == "(*" else -1
        if depth < 0:
            return None
        at = mark.end()
    return None if depth else " ".join([*found, text[at:]])
