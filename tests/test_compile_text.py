"""What is marked in a generated module is what the parser finds, and everything else stays as it was."""

import ast
import importlib.util
from itertools import pairwise

import numpy as np
import pytest

from workbench.compile.kernel import loop_module
from workbench.compile.text import (
    CALLED,
    CALLED_UNCOUNTED,
    MARKER,
    PUT_IN,
    WITHIN,
    WITHIN_UNCOUNTED,
    loop_text,
    module_text,
)
from workbench.errors import CompileError

LOOP = f'''"""A loop."""

{MARKER}

def total(rows):
    """Not rows.shape[0] and not\\ndef total( in a text."""
    found = 0.0  # nor rows.shape[0] – in a comment
    for i in range(rows.shape[0]):
        found += added(rows[i, 0], rows.shape[1]) * max(rows.shape[0], 1)
    return found


def of_others(others):
    rows = others
    return rows.shape[0]
'''
ADDED = "def added(value, width):\n    return value + width\n"


@pytest.fixture
def loop(tmp_path, request):
    def written(text=LOOP):
        path = tmp_path / f"{request.node.name.partition('[')[0]}.py"
        path.write_text(text, encoding="utf-8")
        spec = importlib.util.spec_from_file_location(path.stem, path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    return written


@pytest.mark.parametrize(("stated", "total", "others"), [
    ("", CALLED, CALLED), ('ENTRIES = ("total",)', CALLED, WITHIN),
    ('ENTRIES = ("total",)\nMAKES_NO_ARRAY = True', CALLED_UNCOUNTED, WITHIN_UNCOUNTED),
    ('ENTRIES = ("total",)\nONE_BODY = True', CALLED_UNCOUNTED, PUT_IN)])
def test_every_function_is_marked_for_what_calls_it_and_nothing_else_is_changed(loop, stated, total, others):
    lines = module_text("a test", [ADDED], loop(LOOP.replace(MARKER, f"{stated}\n{MARKER}"))).splitlines()
    marks = {after.partition("(")[0]: line for line, after in pairwise(lines) if line.startswith("@")}
    assert marks == {"def added": others, "def total": total, "def of_others": others}
    whole = "\n".join(line for line in lines if line not in marks.values())
    assert whole.endswith(f"{ADDED}\n{LOOP.partition(MARKER)[2]}".rstrip("\n"))


def test_marks_change_no_value(loop):
    rows = np.arange(6.0).reshape(3, 2)
    stated = ("", 'ENTRIES = ("total",)', 'ENTRIES = ("total",)\nMAKES_NO_ARRAY = True',
              'ENTRIES = ("total",)\nONE_BODY = True')
    found = [loop_module("a test", [ADDED], loop(LOOP.replace(MARKER, f"{s}\n{MARKER}"))).total(rows) for s in stated]
    assert found == [3 * (0.0 + 2.0 + 4.0 + 3 * 2)] * 4


def test_an_entry_that_is_not_there_is_refused_by_name(loop):
    with pytest.raises(CompileError, match="no function 'add' to be called: choose among added, total, of_others"):
        module_text("a test", [ADDED], loop(LOOP.replace(MARKER, f"ENTRIES = ('add',)\n{MARKER}")))


def test_a_loop_without_its_marker_is_refused(loop):
    assert loop_text(loop()).lstrip().startswith("def total")
    with pytest.raises(CompileError, match=r"test_a_loop_without_its_marker_is_refused\.py: has no line"):
        loop_text(loop(LOOP.replace(MARKER, "")))



def test_words_of_a_law_are_text_and_never_code(loop):
    """As of a title in LaTeX, and of one that closes the text to run what follows."""
    for words in (r"means of $\undefined$", '"""; import os; os._exit(3); """', "two\nlines", "a null \0", "an end \\"):
        tree = ast.parse(module_text(words, [], loop()))
        assert ast.get_docstring(tree, clean=False) == f"Generated from the sympy expressions of {words}."
        assert [ast.unparse(node) for node in tree.body if isinstance(node, ast.Import)] == ["import math"]
