"""Documents that other programs read."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from workbench.errors import InputError


def write_json(path: Path, document: dict[str, Any]) -> None:
    """Write a document as JSON; NaN is refused. Raises InputError where it cannot be written."""
    text = json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as trouble:
        raise InputError(path, "", f"cannot be written ({trouble.strerror}): name another file") from None
