"""What is public says what it is."""

import ast
from pathlib import Path
from typing import get_args

import pytest
from scenarios import LAWS

import workbench
from workbench.errors import WorkbenchError
from workbench.model.law import Information
from workbench.simulate.controllers import SAMPLED

ROOT = Path(workbench.__file__).parent
MODULES = sorted(ROOT.rglob("*.py"))


def _public(node: ast.AST, where: str) -> list[tuple[str, ast.AST]]:
    """Public functions and classes of a module, and the public methods of public classes."""
    found = []
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef) and child.name[0] != "_":
            found.append((f"{where}{child.name}", child))
            if isinstance(child, ast.ClassDef):
                found += _public(child, f"{where}{child.name}.")
    return found


def test_every_module_function_and_class_says_what_it_is():
    silent = []
    for path in MODULES:
        text, module = path.read_text(encoding="utf-8"), path.relative_to(ROOT).as_posix()
        tree = ast.parse(text)
        silent += [f"{module}: {name}" for name, node in _public(tree, "") if len(ast.get_docstring(node) or "") < 10]
        if text.strip() and not ast.get_docstring(tree):
            silent.append(f"{module}: the module itself")
    assert silent == []


@pytest.mark.parametrize("law_id", LAWS)
def test_every_law_says_where_it_comes_from_and_what_it_knows(law_id):
    law = LAWS[law_id]
    assert law.id == law_id
    assert law.title.strip()
    assert law.source.strip()
    assert law.information in get_args(Information)


@pytest.mark.parametrize("law_id", SAMPLED)
def test_every_sampled_controller_says_what_it_is_and_what_it_knows(law_id):
    assert SAMPLED[law_id].title.strip()
    assert SAMPLED[law_id].information in (
        "full state, nominal model", "full state, nominal model, the line",
        "full state, nominal model, bound of the disturbance", "full state, nominal model at the start")


def test_every_error_says_when_it_is_raised():
    def below(kind: type) -> list[type]:
        return [kind, *(other for child in kind.__subclasses__() for other in below(child))]

    kinds = [kind for kind in below(WorkbenchError) if kind.__module__.startswith("workbench")]
    assert len(kinds) >= 5
    assert [kind.__name__ for kind in kinds if len(kind.__doc__ or "") < 20] == []
