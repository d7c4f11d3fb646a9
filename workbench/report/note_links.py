"""Notes in which the ids of other claims lead to them: "see 51.zeta.glyph" is a link."""

from __future__ import annotations

import re
from collections.abc import Mapping

from markupsafe import Markup

_TAGS = re.compile(r"(<math.*?</math>|<[^>]*>)", re.DOTALL)
_ID = re.compile(r"(?<![\w.:/])\w+(?:\.\w+)+(?![\w/])")


def linked(note: Markup, anchors: Mapping[str, str]) -> Markup:
    """The note with a link at each id that has an anchor; only ids with a dot, for `51` may be any number."""
    def link(found: re.Match[str]) -> str:
        anchor = anchors.get(found[0])
        return str(Markup('<a href="#{}">{}</a>').format(anchor, found[0])) if anchor else found[0]

    pieces = _TAGS.split(str(note))
    return Markup("".join(piece if i % 2 else _ID.sub(link, piece) for i, piece in enumerate(pieces)))


def anchors_beside(name: str, anchors: Mapping[str, str]) -> dict[str, str]:
    """Of the claims of the same paper as the claim `name`, the anchors by their ids without the paper's."""
    paper = name.partition(":")[0] + ":"
    return {other.removeprefix(paper): anchor for other, anchor in anchors.items()
            if other.startswith(paper) and other != name}
