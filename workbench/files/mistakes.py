"""What went wrong in a proof file, in one line: where, what, and what to do about it."""

from __future__ import annotations

import re
import traceback
from pathlib import Path

from workbench.errors import of_an_extra

# How the modules of a paper's folder are called.
OF_A_FOLDER = "workbench_folder_"
_WITHIN = re.compile(rf"\b{OF_A_FOLDER}(\w+)_[0-9a-f]{{10}}(\.?)")

REMEDIES: tuple[tuple[str, str], ...] = (
    ("SyntaxError", "correct that line"),
    ("ModuleNotFoundError", "install it, or put it beside the proof file"),
    ("ImportError", "correct the import"),
    ("NameError", "declare it first, a symbol as in x = sympy.Symbol('x', real=True)"),
    ("SympifyError", "give an expression of sympy or an exact number, no text"),
    ("FileNotFoundError", "put the file there or correct its name"),
    ("SystemExit", "a paper's code ends nothing: leave that out"),
    ("RecursionError", "break up the expression, or the function that calls itself"),
)


def mistake(trouble: BaseException, file: str | Path) -> str:
    """An exception that the code of a proof file raised, as one line: place, exception, remedy."""
    kinds = [kind.__name__ for kind in type(trouble).__mro__]
    left_out = of_an_extra(trouble) if isinstance(trouble, ImportError) else None
    if left_out is not None:
        return f"{_place(trouble, Path(file))}{left_out}"
    remedy = next((text for name, text in REMEDIES if name in kinds), "correct the file")
    what = f"{trouble.msg}" if isinstance(trouble, SyntaxError) else f"{trouble}"
    what = _WITHIN.sub(lambda name: "" if name[2] else name[1], what)  # as the files and the folder are called
    return " ".join(f"{_place(trouble, Path(file))}{kinds[0]}: {what}: {remedy}".split())


def _place(trouble: BaseException, file: Path) -> str:
    """'line 7: ' in the proof file, with the name of the file where it is another one; empty where unknown."""
    if isinstance(trouble, SyntaxError) and trouble.filename and trouble.lineno:
        other = "" if Path(trouble.filename).name == file.name else f"{Path(trouble.filename).name}, "
        return f"{other}line {trouble.lineno}: "
    frames = [(Path(frame.f_code.co_filename), str(frame.f_globals.get("__name__", "")), line)
              for frame, line in traceback.walk_tb(trouble.__traceback__)
              if not frame.f_code.co_filename.startswith("<")]  # of the import system, no file
    beside = [(path, line) for path, module, line in frames
              if path.parent == file.absolute().parent or module.startswith(OF_A_FOLDER)]
    own = beside or [(path, line) for path, _, line in frames if path.name == file.name]
    if not own:
        return ""
    last, line = own[-1]
    return f"{'' if last.name == file.name else f'{last.name}, '}line {line}: "
