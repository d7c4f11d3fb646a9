"""Functions that numba compiles as they stand are kept by what they are made of, wherever their package lies."""

import importlib
import sys

import pytest

from workbench.optimal import bound, envelope, grid, refine, verify, verify_smooth
from workbench.optimal.cars import share_forces

PART = """from workbench.compile.package_kernels import compiled

SHARE = {share}


@compiled(error_model="numpy")
def part_of(x):
    return SHARE * x
"""
WHOLE = """from part_of_a_test import part_of
from workbench.compile.package_kernels import compiled


@compiled(error_model="numpy")
def one_more(x):
    return part_of(x) + 1.0
"""


@pytest.fixture
def answer(tmp_path, monkeypatch):
    """What the function of a copy in a folder of its own answers, and the sealed files that there are then."""
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))

    def of(copy, share):
        folder = tmp_path / copy
        folder.mkdir()
        (folder / "part_of_a_test.py").write_text(PART.format(share=share))
        (folder / "whole_of_a_test.py").write_text(WHOLE)
        with monkeypatch.context() as patch:
            patch.syspath_prepend(folder)
            for name in ("part_of_a_test", "whole_of_a_test"):
                patch.delitem(sys.modules, name, raising=False)
            module = importlib.import_module("whole_of_a_test")
            value = module.one_more(4.0)
        assert not list(folder.rglob("*.nb?"))
        return value, {path.name: path.stat().st_mtime_ns for path in (tmp_path / "cache").rglob("*.sealed-*")}

    yield of
    for name in ("part_of_a_test", "whole_of_a_test"):
        sys.modules.pop(name, None)


def test_a_copy_elsewhere_finds_what_is_compiled_and_a_number_of_another_file_makes_it_anew(answer):
    """The text of `one_more` is the same in all: what is compiled into it is not."""
    value, kept = answer("first", 0.5)
    assert value == 3.0 and any(name.startswith("whole_of_a_test.one_more.") for name in kept)
    assert answer("second", 0.5) == (3.0, kept)
    value, more = answer("third", 0.75)
    assert value == 4.0 and more.keys() > kept.keys() and more.items() >= kept.items()


def test_numba_keeps_no_function_of_the_package_by_itself():
    """What is beside the source is known by its time alone."""
    for module in (bound, envelope, grid, refine, verify, verify_smooth, share_forces):
        for name, function in vars(module).items():
            if hasattr(function, "py_func"):
                assert "compile" in vars(function), f"{module.__name__}.{name}"
