"""The font of formulas, put into a page: dots over letters need a table of it that few systems' fonts have."""

from __future__ import annotations

import base64
from importlib.resources import files
from pathlib import Path

from workbench.files.regular import contents


def math_font() -> str:
    """The rule of CSS that brings the font as `Page Math`; a page's policy must allow fonts from `data:`."""
    folder = Path(str(files("workbench.report")))
    font = base64.b64encode(contents(folder / "fonts" / "math.woff2")).decode()
    return f'@font-face {{ font-family: "Page Math"; src: url(data:font/woff2;base64,{font}) format("woff2"); }}\n'
