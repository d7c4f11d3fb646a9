"""How a reader of the paper calls its lines, and what letters are that the paper does not have."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from workbench.proof.places import place_of
from workbench.proof.verdict import Decision
from workbench.report.certificate_latex import name_latex
from workbench.report.worded import worded

_NAME = re.compile(r"[A-Za-z_]\w*")


def noted(note: str, titles: Mapping[str, str]) -> str:
    """A note with the lines that it names as a reader of the paper calls them: 51.whole is a name of ours alone."""
    names = [name for name in titles if not name.isdigit() and ("." in name or name[-1].isdigit())]
    if not names:
        return worded(note)
    told = re.compile(rf"(?<![\w.])(?:{'|'.join(map(re.escape, sorted(names, key=len, reverse=True)))})(?!\.?\w)")
    return worded(told.sub(lambda found: _in_sentence(place_of(found[0], titles[found[0]])), note))


def _in_sentence(place: str) -> str:
    small = ("Equation", "The ")
    return place[0].lower() + place[1:] if place.startswith(small) else place


def name_of_line(d: Decision) -> str:
    """The name of a line, its part told by what it says."""
    return worded(place_of(d.claim.equation, d.claim.title))


def legend(certificate: Mapping[str, Any], letters: Mapping[str, str]) -> str:
    """What the letters of a certificate's goal stand for that are not the paper's; empty where it has none."""
    named = set(_NAME.findall(json.dumps(certificate["goal"])))
    told = [f"${name_latex(name)}$ is {worded(text)}" for name, text in letters.items() if name in named]
    return f"{'; '.join(told)}." if told else ""
