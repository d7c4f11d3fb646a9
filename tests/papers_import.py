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

    @staticmethod
    def find_spec(name, path=None, target=None):
        root, _, rest = name.partition(".")
        if root != "proofs":
            return None
        return ModuleSpec(name, Alias, is_package=not rest)

    @staticmethod
    def create_module(spec):
        paper, _, rest = spec.name.removeprefix("proofs").removeprefix(".").partition(".")
        if not paper:
            return None
        package = package_of(PROOFS / paper)
        module = importlib.import_module(f"{package}.{rest}" if rest else package)
        Alias.own[spec.name] = module.__spec__
        return module

    @staticmethod
    def exec_module(module):
        name = next((n for n, spec in Alias.own.items() if n == module.__spec__.name), None)
        if name is not None:
            module.__spec__ = Alias.own[name]

    own = {}


sys.meta_path.insert(0, Alias)
