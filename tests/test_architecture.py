"""The shape of the package: imports run one way, files stay readable, nothing executes what it reads."""

import ast
import functools
import sys
from graphlib import TopologicalSorter
from pathlib import Path

import workbench

ROOT = Path(workbench.__file__).parent
PATHS = {".".join(path.relative_to(ROOT.parent).with_suffix("").parts).removesuffix(".__init__"): path
         for path in sorted(ROOT.rglob("*.py"))}

# The rooms of the package, the upper ones first: a module imports from its own room and from rooms below it. Rooms of
# one floor may know each other, as long as no two know each other in both directions.
ORDER = (
    ("cli",),
    ("api",),
    ("report",),
    ("contest", "fmu"),
    ("paper",),
    ("kernel",),
    ("simulate", "mpc", "optimal", "gains", "proof"),
    ("systems",),
    ("compile",),
    ("trains",),
    ("model",),
    ("tasks",),
    ("files",),
)
FLOOR_OF = {room: -floor for floor, rooms in enumerate(ORDER) for room in rooms}
# Files that stand in no room: the names that a program imports, the errors, and what `python -m workbench` runs.
ABOVE_ALL, BELOW_ALL = {"__init__", "__main__"}, {"errors"}
FLOOR_OF |= dict.fromkeys(ABOVE_ALL, 1) | dict.fromkeys(BELOW_ALL, -len(ORDER))

LONGEST = 300
# Checkers are one file each, so that a sceptic reads and runs one.
LONGER = {"workbench.proof.checker": 2040, "workbench.optimal.bound_checker": 600}

# Loading a file of Python as a module: the generated kernels, a paper's folder, and the single file of claims that a
# user names.
MAY_LOAD_MODULES = {"workbench.compile.code_cache", "workbench.files.modules", "workbench.proof.loading"}
# numba's compiled code, of this user's own and held against a digest before it is believed; what a process of a cluster
# is sent and answers.
MAY_UNPICKLE = {"workbench.compile.sealed", "workbench.tasks.sent"}
FORBIDDEN_CALLS = {"eval", "exec", "compile", "__import__", "parse_expr"}
FORBIDDEN_MODULES = {"pickle", "cPickle", "marshal", "shelve", "dill", "cloudpickle", "joblib"}


def room(module: str) -> str:
    """The folder of the package in which a module lies; of those that lie in none their own name."""
    return module.split(".")[1] if "." in module else "__init__"


@functools.cache
def parsed(text: str) -> tuple[tuple[ast.Import | ast.ImportFrom, ...], tuple[str, ...]]:
    """What a module's text imports, and where it may execute what it reads, as `line 3: eval`; by its text, because a
    test writes another one. Its tree is not kept: those of the whole package take a hundred megabytes."""
    nodes = [*ast.walk(ast.parse(text))]
    return (tuple(node for node in nodes if isinstance(node, ast.Import | ast.ImportFrom)),
            tuple(f"line {node.lineno}: {_name(node)}" for node in nodes
                  if isinstance(node, ast.Call) and may_execute(node)))


def of_module(module: str) -> tuple[tuple[ast.Import | ast.ImportFrom, ...], tuple[str, ...]]:
    return parsed(PATHS[module].read_text(encoding="utf-8"))


def imported(module: str) -> set[str]:
    """Full names of everything a module imports, anywhere in it; members of packages by their own module."""
    names: set[str] = set()
    package = module if PATHS[module].name == "__init__.py" else module.rpartition(".")[0]
    for node in of_module(module)[0]:
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        else:
            above = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            source = ".".join([*above, *([node.module] if node.module else [])])
            names |= {f"{source}.{a.name}" if f"{source}.{a.name}" in PATHS else source for a in node.names}
    return names


def own(module: str) -> set[str]:
    return {name for name in imported(module) if name in PATHS and name != "workbench"}


def test_every_room_has_its_floor_and_nothing_lies_about():
    folders = {path.name for path in ROOT.iterdir() if path.is_dir() and path.name != "__pycache__"}
    assert folders == {name for rooms in ORDER for name in rooms}
    assert {path.stem for path in ROOT.glob("*.py")} == ABOVE_ALL | BELOW_ALL
    assert all((ROOT / folder / "__init__.py").is_file() for folder in folders)


def test_imports_run_downwards():
    above = [(module, name) for module in PATHS for name in own(module)
             if FLOOR_OF[room(name)] > FLOOR_OF[room(module)]]
    assert above == []


def test_no_two_rooms_know_each_other_in_both_directions():
    known: dict[str, set[str]] = {}
    for module in PATHS:
        known.setdefault(room(module), set()).update(room(name) for name in own(module))
    order = list(TopologicalSorter({name: others - {name} for name, others in known.items()}).static_order())
    assert set(order) == set(FLOOR_OF)


def test_no_import_runs_in_a_circle():
    order = list(TopologicalSorter({module: own(module) for module in PATHS}).static_order())
    assert set(order) >= set(PATHS)


def test_the_package_knows_no_paper_file_no_benchmark_and_no_test():
    known = [(module, name) for module in PATHS for name in imported(module)
             if name.partition(".")[0] in ("proofs", "benchmarks", "tests")]
    assert known == []


def test_the_checker_needs_nothing_but_the_standard_library():
    roots = {name.partition(".")[0] for name in imported("workbench.proof.checker")}
    assert roots <= sys.stdlib_module_names


def reached_from(module: str) -> set[str]:
    """The package's modules that a module needs, directly or not."""
    found, waiting = set(), [module]
    while waiting:
        current = waiting.pop()
        if current not in found:
            found.add(current)
            waiting += own(current)
    return found


def test_what_decides_lies_in_the_folder_whose_digest_invalidates_the_cache():
    outside = {m for m in reached_from("workbench.proof.decide.engine") if not m.startswith("workbench.proof.")}
    # What these two say ends a run, and nothing is kept of such a one.
    assert outside <= {"workbench.errors", "workbench.files.mistakes"}


def test_a_file_can_be_read_in_one_sitting():
    lines = {module: len(path.read_text(encoding="utf-8").splitlines()) for module, path in PATHS.items()}
    assert {module: count for module, count in lines.items() if count > LONGER.get(module, LONGEST)} == {}


def _name(call: ast.Call) -> str:
    function = call.func
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def may_execute(call: ast.Call) -> bool:
    """Whether a call is eval or one like it, a text parsed by sympy, or loads a module."""
    name = _name(call)
    # re.compile is meant for text and typst.compile for documents, and what is given no text compiles none; every
    # other attribute called `compile` is not.
    of_re = isinstance(call.func, ast.Attribute) and (
        getattr(call.func.value, "id", "") in ("re", "typst") or not (call.args or call.keywords))
    strict = any(k.arg == "strict" and getattr(k.value, "value", None) is True for k in call.keywords)
    return (name in FORBIDDEN_CALLS and not of_re) or (name in ("sympify", "S") and not strict) or name == "exec_module"


def executions(module: str) -> list[str]:
    """Where a module has eval, a pickle or a text parsed by sympy, or loads a module where that is not its task."""
    offences = [call for call in of_module(module)[1]
                if module not in MAY_LOAD_MODULES or not call.endswith(": exec_module")]
    if module not in MAY_UNPICKLE:
        offences += sorted(FORBIDDEN_MODULES & {name.partition(".")[0] for name in imported(module)})
    return offences


def test_nothing_that_was_read_is_executed():
    assert {module: found for module in PATHS if (found := executions(module))} == {}


def test_the_check_for_execution_finds_what_it_looks_for(tmp_path, monkeypatch):
    bad = tmp_path / "bad.py"
    monkeypatch.setitem(PATHS, "workbench.bad", bad)
    for line in ("eval('1')", "exec('1')", "sp.sympify(text)", "import pickle", "from joblib import load",
                 "loader.exec_module(m)", "compile('1', '', 'eval')"):
        bad.write_text(line)
        assert executions("workbench.bad")
    for line in ("re.compile('a')", "sp.sympify(value, strict=True)", "import json"):
        bad.write_text(line)
        assert not executions("workbench.bad")
