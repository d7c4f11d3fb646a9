"""Results as tables of other libraries, where these are installed, and as MAT files."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from workbench.errors import WorkbenchError
from workbench.files.writing import write_bytes


def data_frame(rows: Sequence[Mapping[str, Any]] | Mapping[str, Any], index: str | None = None) -> Any:
    """A pandas DataFrame of rows or columns; WorkbenchError where pandas is not installed."""
    try:
        pandas = import_module("pandas")
    except ImportError:
        raise WorkbenchError("to_pandas needs pandas, which is not installed: pip install pandas") from None
    frame = pandas.DataFrame(list(rows) if isinstance(rows, Sequence) else dict(rows))
    return frame.set_index(index) if index else frame


def write_mat(columns: Mapping[str, ArrayLike], path: Path) -> None:
    """Columns as variables of a MAT file; two names that MATLAB cannot tell apart are a WorkbenchError."""
    from scipy.io import savemat  # noqa: PLC0415 - costs a start of the package nothing

    names = {name: re.sub(r"\W", "_", name, flags=re.ASCII) for name in columns}
    if len(set(names.values())) < len(names):
        raise WorkbenchError(f"{path}: two of the columns {', '.join(columns)} have one name in MATLAB: rename a state")
    text = io.BytesIO()
    savemat(text, {names[name]: column for name, column in columns.items()}, long_field_names=True, oned_as="column")
    write_bytes(path, text.getvalue())
