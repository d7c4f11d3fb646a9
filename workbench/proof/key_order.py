"""The order of what a certificate names: that of its file, so that what is made of it is the same either way."""

from __future__ import annotations

from typing import Any, TypeVar

T = TypeVar("T")


def in_key_order(record: T) -> T:
    """Plain data with the names of every mapping in it sorted, as they are in a file of certificates."""
    return _sorted(record)


def _sorted(part: Any) -> Any:
    if isinstance(part, dict):
        return {name: _sorted(part[name]) for name in sorted(part)}
    return [_sorted(one) for one in part] if isinstance(part, list) else part
