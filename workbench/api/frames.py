"""Results as tables of other libraries, where these are installed, as MAT files, and as tables of a notebook."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping, Sequence
from html import escape
from importlib import import_module
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from workbench.errors import WorkbenchError
from workbench.files.writing import write_bytes


def data_frame(rows: Sequence[Mapping[str, Any]] | Mapping[str, Any], index: str | None = None) -> Any:
    """A pandas DataFrame of rows or columns; WorkbenchError where pandas is not installed."""
    pandas = _installed("pandas", "to_pandas")
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


def dataset(columns: Mapping[str, Any], units: Mapping[str, str], about: Mapping[str, Any]) -> Any:
    """An xarray Dataset of columns over time, each with its unit; WorkbenchError where xarray is not installed.

    columns: `t_s` among them; about: attributes of the whole.
    """
    xarray = _installed("xarray", "to_xarray")
    variables = {name: ("t_s", values, {"units": units[name]} if units.get(name) else {})
                 for name, values in columns.items() if name != "t_s"}
    return xarray.Dataset(variables, {"t_s": ("t_s", columns["t_s"], {"units": "s"})}, dict(about))


def html_table(rows: Sequence[Mapping[str, Any]]) -> str:
    """Rows as an HTML table, which a notebook shows; numbers to six digits, nothing for None."""
    header = [*dict.fromkeys(key for row in rows for key in row)]

    def cell(value: Any) -> str:
        text = "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)
        return f"<td>{escape(text)}</td>"

    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    body = "".join(f"<tr>{''.join(cell(row.get(name)) for name in header)}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _installed(library: str, user: str) -> Any:
    try:
        return import_module(library)
    except ImportError:
        raise WorkbenchError(f"{user} needs {library}, which is not installed: pip install {library}") from None
