"""Import a paper by its path: a folder with its claims, or a single proof file with the modules beside it."""

from __future__ import annotations

import importlib.util
import re
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib.machinery import FileFinder, ModuleSpec
from pathlib import Path
from types import ModuleType

from workbench.errors import ClaimError, InputError, OutOfTime
from workbench.files.depth_limit import limited_depth
from workbench.files.folders import CLAIMS_FOLDER, PAPER_FILE
from workbench.files.memory_limit import limited_memory
from workbench.files.mistakes import mistake
from workbench.files.modules import (
    IMPORT_S,
    OF_A_KERNEL,
    OUT_OF_MEMORY,
    OUT_OF_TIME,
    SourceLoader,
    forget_changed,
    module_in,
    sources_of,
)
from workbench.files.modules import PREFIX as FOLDER_PREFIX
from workbench.files.time_limit import at_most_seconds
from workbench.proof.dependencies import reading, reads
from workbench.proof.typed import whole_domains

PREFIX = "workbench_proofs_"


class _NeighbourModules:
    """Finds the modules that stand in a folder."""

    def __init__(self, folder: Path) -> None:
        self.finder = FileFinder(str(folder), (SourceLoader, [".py"]))
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
    """A paper's folder or a single proof file, imported on first use.

    Modules beside a single file are found while it is `at_home`, as Python does for a script; they are its own, so
    that files of one name in two folders are not taken for each other. A folder is a package, whose modules import
    each other relatively; its claims are imported in the order of their names, section_2 before section_10.
    """

    def __init__(self, path: Path) -> None:
        if path.is_dir():
            forget_changed(path)
        self.path = path
        self.sources = {str(path.absolute())}
        self._neighbours = None if path.is_dir() else _NeighbourModules(path.absolute().parent)
        self._own: dict[str, ModuleType] = {}
        self._modules: list[ModuleType] = []

    @contextmanager
    def at_home(self) -> Iterator[None]:
        """Whatever is imported within sees the modules beside the file first."""
        if self._neighbours is None:  # a package, whose modules know each other
            with reading(self.sources):
                yield
            return
        sys.meta_path.insert(0, self._neighbours)
        hidden = {name: sys.modules[name] for name in self._own if name in sys.modules}
        sys.modules.update(self._own)
        try:
            with reading(self.sources):
                yield
        finally:
            sys.meta_path.remove(self._neighbours)
            for name in [n for n in sys.modules if n.partition(".")[0] in self._neighbours.found]:
                self._own[name] = sys.modules.pop(name)
            sys.modules.update(hidden)

    def modules(self) -> list[ModuleType]:
        """The imported files that may state a paper; raises InputError when one cannot be imported."""
        if not self._modules:
            try:
                with self.at_home(), whole_domains():
                    self._modules = self._of_folder() if self.path.is_dir() else [self._imported()]
            except ClaimError as trouble:
                raise InputError(self.path, "", str(trouble)) from None
            except (InputError, KeyboardInterrupt):
                raise
            except BaseException as trouble:  # a file that exits would end the run undecided
                raise InputError(self.path, "", f"cannot be imported: {mistake(trouble, self.path)}") from trouble
        return self._modules

    def _of_folder(self) -> list[ModuleType]:
        names = [CLAIMS_FOLDER + "." + name for name in claim_files(self.path)]
        if (self.path / PAPER_FILE).is_file():
            names.insert(0, PAPER_FILE.removesuffix(".py"))
        return [module_in(self.path, name) for name in names]

    def _imported(self) -> ModuleType:
        name = f"{PREFIX}{self.path.stem}"
        spec = importlib.util.spec_from_file_location(name, self.path,
                                                      loader=SourceLoader(name, str(self.path.absolute())))
        if spec is None or spec.loader is None:
            raise InputError(self.path, "", "cannot be imported: is it a Python file?")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        try:
            with at_most_seconds(IMPORT_S), limited_memory(), limited_depth():
                spec.loader.exec_module(module)
        except OutOfTime:
            raise InputError(self.path, "", OUT_OF_TIME) from None
        except MemoryError:
            raise InputError(self.path, "", OUT_OF_MEMORY) from None
        return module

    def reads(self, cache_folder: Path | None = None) -> frozenset[str]:
        """The files it may depend on, as far as they have been read yet, those of the cache left out."""
        own = self.sources | sources_of(self.path) if self.path.is_dir() else self.sources
        return reads(own, (PREFIX, FOLDER_PREFIX, OF_A_KERNEL), cache_folder)


def claim_files(folder: Path) -> list[str]:
    """The names of the modules in a paper's claims, numbers in them by their value."""
    names = [path.stem for path in (folder / CLAIMS_FOLDER).glob("*.py") if not path.name.startswith(("_", "."))]
    return sorted(names, key=lambda name: [(not part.isdigit(), int(part) if part.isdigit() else 0, part)
                                           for part in re.findall(r"\d+|\D+", name)])
