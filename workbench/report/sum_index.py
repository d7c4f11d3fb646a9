"""By which letter a sum counts its terms."""

from __future__ import annotations

import ast


def index_of(term: ast.expr) -> str:
    """The index of a sum, j where the names of its letters end with it; else i."""
    ends = {node.id[-1] for node in ast.walk(term) if isinstance(node, ast.Name) and node.id[-2:-1] == "_"}
    return "j" if "j" in ends and "i" not in ends else "i"
