"""What is written into a generated module is what the parser finds, and everything else stays as it was."""

import ast
import importlib.util
from pathlib import Path

import numpy as np
import pytest
from scenarios import LAWS

from workbench.compile.kernel import kernel_module, loop_module
from workbench.compile.text import CALLED, MARKER, PUT_IN, Form, loop_text, module_text
from workbench.errors import CompileError
from workbench.simulate import kernel_loop
from workbench.simulate.setting_loop import COUNTED, STAGES
from workbench.trains.train import single_particle

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


def test_nothing_but_what_is_meant_is_changed(loop):
    plain, made = (module_text("a test", [ADDED], loop(), form).splitlines()
                   for form in (Form(), Form(("added",), (("rows", 3),))))
    assert [pair for pair in zip(plain, made, strict=True) if pair[0] != pair[1]] == [
        (CALLED, PUT_IN),
        ("    for i in range(rows.shape[0]):", "    for i in range(3):"),
        ("        found += added(rows[i, 0], rows.shape[1]) * max(rows.shape[0], 1)",
         "        found += added(rows[i, 0], rows.shape[1]) * max(3, 1)"),
    ]
    whole = "\n".join(line for line in plain if line != CALLED)
    assert whole.endswith(f"{ADDED}\n{LOOP.partition(MARKER)[2]}".rstrip("\n"))
    assert plain.count(CALLED) == 3


def test_a_form_computes_the_same(loop):
    rows = np.arange(6.0).reshape(3, 2)
    plain, made = (loop_module("a test", [ADDED], loop(), form) for form in (Form(), Form(("added",), (("rows", 3),))))
    assert plain is not made
    assert plain.total(rows) == made.total(rows) == 3 * (0.0 + 2.0 + 4.0 + 3 * 2)
    assert made.of_others(rows[:2]) == 2


@pytest.mark.parametrize(("form", "message"), [
    (Form(("add",)), "no function 'add' to be put into its callers: choose among added, total, of_others"),
    (Form(rows=(("row", 1),)), "no function counts the rows of an argument 'row'"),
    (Form(rows=(("value", 1),)), "no function counts the rows of an argument 'value'"),
])
def test_a_form_that_does_not_fit_is_refused_by_name(loop, form, message):
    with pytest.raises(CompileError, match=message):
        module_text("a test", [ADDED], loop(), form)


def test_rows_of_an_argument_that_becomes_another_are_no_constant(loop):
    changed = LOOP.replace("    found = 0.0", "    rows = rows[1:]\n    found = 0.0")
    with pytest.raises(CompileError, match="function 'total' gives 'rows' another value"):
        module_text("a test", [ADDED], loop(changed), Form(rows=(("rows", 3),)))


def test_a_loop_without_its_marker_is_refused(loop):
    assert loop_text(loop()).lstrip().startswith("def total")
    with pytest.raises(CompileError, match=r"test_a_loop_without_its_marker_is_refused\.py: has no line"):
        loop_text(loop(LOOP.replace(MARKER, "")))


@pytest.mark.parametrize("law", LAWS)
def test_the_loop_of_every_law_can_be_made_for_a_setting(law):
    form = Form(STAGES, tuple((name, count) for count, name in enumerate(COUNTED)))
    module = kernel_module(single_particle(), LAWS[law], kernel_loop, form=form)
    tree = ast.parse(Path(module.__file__).read_text(encoding="utf-8"))
    marks = {node.name: ast.unparse(node.decorator_list[0]) for node in tree.body if isinstance(node, ast.FunctionDef)}
    assert {name for name, mark in marks.items() if "inline='always'" in mark} == set(STAGES)
    assert {"control_step", "domain_margin", "closed_loop"} <= marks.keys() - set(STAGES)
    counted = {ast.unparse(node) for node in ast.walk(tree) if isinstance(node, ast.Subscript)}
    assert counted.isdisjoint(f"{name}.shape[0]" for name in COUNTED)
