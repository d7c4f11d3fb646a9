"""Figures that a notebook shows without pyplot's help."""

from __future__ import annotations

import io

from matplotlib.figure import Figure


class _Drawn(Figure):
    def _repr_svg_(self) -> str:
        text = io.StringIO()
        self.savefig(text, format="svg")
        return text.getvalue()


def drawn(figsize: tuple[float, float]) -> Figure:
    """An empty figure of a size in inches."""
    return _Drawn(figsize=figsize, layout="constrained")
