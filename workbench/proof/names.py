"""What a certificate names, and in which order: that of its file, so that what is made of it is the same either way."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, TypeVar

_NAME = re.compile(r"[A-Za-z_]\w*")
T = TypeVar("T")


def in_key_order(record: T) -> T:
    """Plain data with the names of every mapping in it sorted, as they are in a file of certificates."""
    return _sorted(record)


def _sorted(part: Any) -> Any:
    if isinstance(part, dict):
        return {name: _sorted(part[name]) for name in sorted(part)}
    return [_sorted(one) for one in part] if isinstance(part, list) else part


def names_in(certificate: Mapping[str, Any] | None) -> frozenset[str]:
    """The names in the goal of a certificate and in that of its correction; those of functions are among them."""
    parts = [(part or {}).get("goal", {}) for part in (certificate, (certificate or {}).get("correction"))]
    return frozenset(_NAME.findall(json.dumps(parts)))
