"""What libraries bring along and no command uses: it is imported once somebody looks into it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import LazyLoader
from types import ModuleType

# scipy asks numpy for all that it names, its compiler of Fortran and its tools for tests among that; numba asks for a
# reader of C headers in case that somebody has some. Together a tenth of a short command.
UNUSED = ("numpy.f2py", "numpy.testing", "pycparser")


class _Later:
    """Finds these modules as others, and has them run when they are used.

    It inherits from nothing: to import the class that it would takes longer than what it spares.
    """

    @staticmethod
    def find_spec(fullname: str, path: Sequence[str] | None, target: ModuleType | None = None) -> ModuleSpec | None:
        """As the import system asks for it."""
        found = PathFinder.find_spec(fullname, path, target) if fullname in UNUSED else None
        if found is not None and found.loader is not None:
            found.loader = LazyLoader(found.loader)
        return found


def import_unused_later() -> None:
    """Have this process import UNUSED when they are used; asked for twice, it is done once."""
    if _Later not in sys.meta_path:
        sys.meta_path.insert(0, _Later)
