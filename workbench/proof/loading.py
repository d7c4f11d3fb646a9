"""Import a proof file by its path, with the modules that stand beside it."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.machinery import FileFinder, ModuleSpec, SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

from workbench.errors import ClaimError, InputError
from workbench.proof.mistakes import mistake
from workbench.proof.reads import reading, reads

PREFIX = "workbench_proofs_"


class _FromSource(SourceFileLoader):
    """Reads the source, never bytecode: that knows its source by size and second only, and a changed claim must
    not be taken for the old one."""

    def path_stats(self, path: Any) -> Mapping[str, Any]:
        raise OSError(f"{path}: no bytecode wanted")


class _Beside:
    """Finds the modules that stand in a folder."""

    def __init__(self, folder: Path) -> None:
        self.finder = FileFinder(str(folder), (_FromSource, [".py"]))
        self.found: set[str] = set()

    def find_spec(self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None,
                  ) -> ModuleSpec | None:
        """The module of that name in the folder, as the import system asks for it."""
        spec = self.finder.find_spec(name) if path is None else None
        if spec is None or spec.loader is None:
            return None
        self.found.add(name)
        return spec


class ProofFile:
    """A proof file, imported on first use.

    Modules beside it are found while it is `at_home`, as Python does for a script; they are its own, so that
    files of one name in two folders are not taken for each other.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.sources = {str(path.absolute())}
        self._beside = _Beside(path.absolute().parent)
        self._own: dict[str, ModuleType] = {}
        self._module: ModuleType | None = None

    @contextmanager
    def at_home(self) -> Iterator[None]:
        """Whatever is imported within sees the modules beside the file first."""
        sys.meta_path.insert(0, self._beside)
        hidden = {name: sys.modules[name] for name in self._own if name in sys.modules}
        sys.modules.update(self._own)
        try:
            with reading(self.sources):
                yield
        finally:
            sys.meta_path.remove(self._beside)
            for name in [n for n in sys.modules if n.partition(".")[0] in self._beside.found]:
                self._own[name] = sys.modules.pop(name)
            sys.modules.update(hidden)

    def module(self) -> ModuleType:
        """The imported file; raises InputError when it cannot be imported."""
        if self._module is None:
            try:
                with self.at_home():
                    self._module = self._imported()
            except ClaimError as trouble:
                raise InputError(self.path, "", str(trouble)) from None
            except (Exception, SystemExit) as trouble:  # a file that exits would end the run undecided
                raise InputError(self.path, "", f"cannot be imported: {mistake(trouble, self.path)}") from trouble
        return self._module

    def _imported(self) -> ModuleType:
        name = f"{PREFIX}{self.path.stem}"
        spec = importlib.util.spec_from_file_location(name, self.path,
                                                      loader=_FromSource(name, str(self.path.absolute())))
        if spec is None or spec.loader is None:
            raise InputError(self.path, "", "cannot be imported: is it a Python file?")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
        return module

    def reads(self, cache_folder: Path | None = None) -> frozenset[str]:
        """The files it may depend on, as far as they have been read yet, those of the cache left out."""
        return reads(self.sources, (PREFIX,), cache_folder)
