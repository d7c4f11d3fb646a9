"""Lets tests write `from proofs.NAME.laws import ...` for the modules that the workbench itself loads from that folder.

Without it Python would import a second copy, whose classes are not those of the first.
"""

import importlib
import sys
from importlib.machinery import ModuleSpec
from pathlib import Path

from workbench.files.modules import package_of

PROOFS = Path(__file__).resolve().parents[1] / "proofs"


class Alias:
    """Finds `proofs.NAME...` as the module of the package that a paper's folder is."""

    def __init__(self):
        self.specs = {}

    def find_spec(self, name, path=None, target=None):
        root, _, rest = name.partition(".")
        return ModuleSpec(name, self, is_package=not rest) if root == "proofs" else None

    def create_module(self, spec):
        paper, _, rest = spec.name.removeprefix("proofs").removeprefix(".").partition(".")
        if not paper:
            return None
        package = package_of(PROOFS / paper)
        module = importlib.import_module(f"{package}.{rest}" if rest else package)
        self.specs[spec.name] = module.__spec__
        return module

    def exec_module(self, module):
        """The import system has given the module the alias's spec: it keeps its own, by which it imports others."""
        module.__spec__ = self.specs.get(module.__spec__.name, module.__spec__)


sys.meta_path.insert(0, Alias())
