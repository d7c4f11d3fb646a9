"""Whatever touches the disk stands in workbench/files, where it is safe; few others may, each with its reason."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "workbench"
ROOM = "files"
# What reads, writes, makes or removes files, as a function or as a method of a path.
FUNCTIONS = {"open"}
METHODS = {"open", "read_text", "read_bytes", "write_text", "write_bytes", "mkdir", "rmdir", "unlink", "touch", "chmod",
           "rename", "symlink_to", "hardlink_to", "rmtree", "copy", "copyfile", "copytree", "move", "makedirs",
           "remove", "removedirs", "truncate", "NamedTemporaryFile", "TemporaryFile", "TemporaryDirectory", "mkdtemp",
           "mkstemp", "savefig", "loadtxt", "savetxt", "genfromtxt", "tofile", "fromfile"}
MODULES = {"shutil", "tempfile"}
# (module, calls): why.
EXCEPTIONS = {
    "proof/checker.py": {"open"},  # stands alone, on the standard library: whoever doubts the workbench runs it
    "optimal/bound_checker.py": {"open"},  # so does this one
    "simulate/journal.py": {"open", "mkdir", "replace", "truncate"},  # appends record by record, all others write whole
    "kernel/coqc.py": {"shutil"},  # looks up where a command is
    "report/svg.py": {"savefig"},  # draws into memory
    "report/reference_figure.py": {"savefig"},  # so does this one
    "api/figure.py": {"savefig"},  # and this one, for notebooks
}


def disk_calls(tree: ast.AST) -> set[str]:
    """The calls in a module that touch the disk, by name."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import | ast.ImportFrom):
            names = {alias.name for alias in node.names} if isinstance(node, ast.Import) else {node.module or ""}
            found |= {name for name in names if name.partition(".")[0] in MODULES}
        if not isinstance(node, ast.Call):
            continue
        match node.func:
            case ast.Name(name) if name in FUNCTIONS:
                found.add(name)
            # numpy's and sympy's arrays and dictionaries are copied too, and a path is replaced by one argument.
            case ast.Attribute(attr="copy" | "remove" | "move", value=ast.Name(name)) if name not in ("os", "shutil"):
                pass
            case ast.Attribute(attr="copy" | "remove" | "move", value=value) if not isinstance(value, ast.Name):
                pass
            case ast.Attribute(attr=name) if name in METHODS:
                found.add(name)
            case ast.Attribute(attr="replace", value=value) if (
                    len(node.args) == 1 and not node.keywords and ast.unparse(value) != "dataclasses"):
                found.add("replace")
    return found


def modules() -> list[Path]:
    return sorted(path for path in PACKAGE.rglob("*.py") if path.relative_to(PACKAGE).parts[0] != ROOM)


def test_no_other_room_touches_the_disk():
    found = {path.relative_to(PACKAGE).as_posix(): disk_calls(ast.parse(path.read_text(encoding="utf-8")))
             for path in modules()}
    assert {name: calls for name, calls in found.items() if calls - EXCEPTIONS.get(name, set())} == {}, (
        "use workbench.files")


@pytest.mark.parametrize("name", EXCEPTIONS)
def test_every_exception_is_needed(name):
    assert disk_calls(ast.parse((PACKAGE / name).read_text(encoding="utf-8"))) == EXCEPTIONS[name]


@pytest.mark.parametrize("line", [
    "open('x')", "p.open()", "Path('x').read_text()", "p.write_bytes(b'')", "p.unlink()", "import shutil",
    "from tempfile import mkdtemp", "p.replace(q)", "os.remove('x')", "os.open('x', 0)", "figure.savefig('x.png')",
])
def test_a_line_that_touches_the_disk_is_seen(line):
    assert disk_calls(ast.parse(line))


@pytest.mark.parametrize("line", ["text.replace('a', 'b')", "read_text(p, 'TOML')", "values.copy()", "seen.remove(x)"])
def test_a_line_that_does_not_is_passed_over(line):
    assert not disk_calls(ast.parse(line))
