"""Results as tables of other libraries, where these are installed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any

from workbench.errors import WorkbenchError


def data_frame(rows: Sequence[Mapping[str, Any]] | Mapping[str, Any], index: str | None = None) -> Any:
    """A pandas DataFrame of rows or columns; WorkbenchError where pandas is not installed."""
    try:
        pandas = import_module("pandas")
    except ImportError:
        raise WorkbenchError("to_pandas needs pandas, which is not installed: pip install pandas") from None
    frame = pandas.DataFrame(list(rows) if isinstance(rows, Sequence) else dict(rows))
    return frame.set_index(index) if index else frame
