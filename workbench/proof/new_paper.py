"""A proof file to start from."""

from __future__ import annotations

import keyword
import sys
from pathlib import Path
from string import Template

from workbench.errors import InputError

TEMPLATE = Path(__file__).with_suffix(".txt")


def write_new_paper(name: str, directory: Path) -> Path:
    """Write the commented template as <name>.py; the path written.

    Raises InputError for a name that cannot be a module's, and where such a file stands already.
    """
    if not name.isidentifier() or keyword.iskeyword(name):
        raise InputError("new-paper", name, "is no name in Python: use letters, digits and underscores, as in yang2021")
    if name.startswith("_") or name in sys.stdlib_module_names or name in ("sympy", "workbench"):
        raise InputError("new-paper", name, "would hide another module, or be hidden: name it as in yang2021")
    path = directory / f"{name}.py"
    text = Template(TEMPLATE.read_text(encoding="utf-8")).substitute(name=name)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        where = path if path.exists() else directory
        raise InputError(where, "", "exists already: name another paper, or move it away first") from None
    except OSError as trouble:
        raise InputError(path, "", f"cannot be written ({trouble.strerror}): name another --directory") from None
    return path
