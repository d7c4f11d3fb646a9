"""How many claims have which verdict, in the words of every verb that says so."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from rich.text import Text

from workbench.cli.terminal import COLOURS
from workbench.files.numbers import counted
from workbench.proof.verdict import FAILED, VERDICTS, in_number


def verdict_lines(document: Mapping[str, Any]) -> list[Text]:
    """Of a document of claims: how many lines of the papers have which verdict, and how many questions of ours.

    What fails only as extracted is counted apart: no paper is charged with it.
    """
    claims = document["claims"]
    verdicts = {claim["id"]: claim["verdict"] for claim in claims}
    papers = len({claim["paper"] for claim in claims})
    lines = []
    for ours, whose in ((False, f"of the paper{'' if papers == 1 else 's'}"), (True, "of ours")):
        of_them = [claim for claim in claims if (claim["origin"] == "ours") == ours]
        if of_them:
            number = counted(len(of_them), "question" if ours else "line")
            lines.append(Text(f"{number} {whose}: ").append_text(_by_verdict(of_them, verdicts)))
    return lines


def _by_verdict(claims: Sequence[Mapping[str, Any]], verdicts: Mapping[str, str]) -> Text:
    charged = [claim for claim in claims if claim["verdict"] not in FAILED
               or verdicts.get(claim["glyph_claim"] or "") != "proved"]
    counts, under = Counter(claim["verdict"] for claim in charged), sum(bool(claim["proved_under"]) for claim in claims)
    line = Text(", ").join(Text(count_words(verdict, counts[verdict], under), COLOURS[verdict])
                           for verdict in VERDICTS if counts[verdict])
    if readings := len(claims) - len(charged):
        line.append("; one more fails only as extracted and holds in another reading" if readings == 1 else
                    f"; {readings} more fail only as extracted and hold in another reading")
    if by_kernel := sum(claim["trust"] == "kernel" for claim in claims):
        certified = sum(claim["goal_digest"] is not None for claim in claims)
        every = "its certificate" if certified == 1 else f"all {certified} certificates"
        accepted = every if by_kernel == certified else f"{by_kernel} of their {certified} certificates"
        line.append(f"; Coq's kernel accepts {accepted} too")
    return line


def count_words(verdict: str, count: int, under: int) -> str:
    """How many claims have a verdict, and of the proved ones how many only under claims that are not shown."""
    only = f" ({under} under lines that are not shown)" if under and verdict == "proved" else ""
    return f"{count} {in_number(verdict, count)}{only}"
