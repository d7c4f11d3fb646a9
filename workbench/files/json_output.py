"""Documents that other programs read."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from workbench.files.outputs import STANDARD_OUTPUT
from workbench.files.streams import own_output
from workbench.files.writing import write_text


def write_json(path: Path, document: Mapping[str, Any]) -> None:
    """Write a document as JSON, to standard output where the path is `-`; NaN is refused. Raises InputError where it
    cannot be written."""
    to_stream = path == STANDARD_OUTPUT
    few_letters = to_stream and (own_output().encoding or "utf-8").lower().replace("-", "") != "utf8"
    text = json.dumps(document, indent=1, ensure_ascii=few_letters, allow_nan=False) + "\n"
    if to_stream:
        own_output().write(text)
        return
    write_text(path, text, "name another file")
