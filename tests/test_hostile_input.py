"""What somebody could write to keep a command busy for ever, or to have it say nothing of use: each is one line."""

import json
import os
import re
import resource
import sys
from pathlib import Path

import pytest
import sympy as sp
from command_line import one_line, run
from pydantic import ValidationError
from refusals import changed, changed_copy, refusal
from scenarios import LINES, ROOT, SHARED
from small_folders import small_folder, with_claims

sys.path.insert(0, str(ROOT / "benchmarks"))
from bad_input_texts import CONTEST

from workbench.compile.literals import require_short
from workbench.errors import CompileError, InputError, WorkbenchError
from workbench.files import folders, memory_limit, modules, time_limit
from workbench.files.depth_limit import MOST_CALLS
from workbench.files.json_input import read_json
from workbench.files.modules import module_in
from workbench.files.outputs import check_outputs
from workbench.files.toml import read_toml
from workbench.model.sensitivity import Sensitivity
from workbench.optimal.fleet import COLUMNS, TripRow
from workbench.proof import loading
from workbench.proof.latex.rows import ROWS, state_rows
from workbench.proof.loading import ProofFile
from workbench.proof.paper import Paper
from workbench.report.changes import read_claims
from workbench.report.formulas import formula
from workbench.simulate.journal import Journal
from workbench.tasks.processes import start_method
from workbench.trains.track import load_track

METRO = SHARED / "lines" / "metro.toml"


@pytest.fixture
def little_time(monkeypatch):
    for module in (modules, loading):
        monkeypatch.setattr(module, "IMPORT_S", 0.2)
    monkeypatch.setattr(time_limit, "WAITING_S", 0.2)


@pytest.mark.parametrize("text", ["while True: pass\n", "import os; os.read(os.pipe()[0], 1)\n"])
def test_a_module_that_never_ends_is_named(text, tmp_path, little_time):
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2")
    for name in ("paper", "laws", "claims/section_2"):
        path = folder / f"{name}.py"
        before = path.read_text()
        path.write_text(before + text)
        said = refusal(module_in, folder, name.replace("/", "."))
        assert said.startswith(f"{path}: cannot be imported: computes for more than")
        path.write_text(before)
    single = tmp_path / "single.py"
    single.write_text(text)
    assert refusal(ProofFile(single).modules).startswith(f"{single}: cannot be imported: computes for more than")


@pytest.mark.parametrize("text", ['with open("/dev/zero") as zero: zero.read()\n',
                                  'kept = []\nwhile True: kept.append("a" * 1000)\n'])
def test_a_module_that_takes_all_memory_is_named(text, tmp_path, monkeypatch):
    monkeypatch.setattr(memory_limit, "FOR_ANY", 2**24)
    monkeypatch.setattr(memory_limit, "FOR_A_CORE", 0)
    folder, single = with_claims(small_folder(tmp_path / "doe2030"), "section_2"), tmp_path / "single.py"
    (folder / "claims" / "section_2.py").write_text(text)
    single.write_text(text)
    before = resource.getrlimit(resource.RLIMIT_DATA)
    assert refusal(module_in, folder, "claims.section_2") == (
        f"{folder / 'claims' / 'section_2.py'}: {modules.OUT_OF_MEMORY}")
    assert refusal(ProofFile(single).modules) == f"{single}: {modules.OUT_OF_MEMORY}"
    assert resource.getrlimit(resource.RLIMIT_DATA) == before


def test_a_shell_that_allows_too_little_is_told_so(monkeypatch):
    """A library of linear algebra would ask for more and more for ever."""
    allowed = memory_limit.LEAST_ALLOWED
    monkeypatch.setattr(memory_limit.resource, "getrlimit", lambda limit: (allowed, -1))
    memory_limit.require_memory()
    allowed -= 1
    said = one_line(run("prove", "nowhere"))
    assert "allows a command 511 MiB of memory (ulimit -v), and it needs 512" in said and "ulimit -v unlimited" in said
    allowed = memory_limit.LEAST_FILES - 1
    with pytest.raises(WorkbenchError, match=r"63 open files \(ulimit -n\), and processes need 64.*--workers 1"):
        start_method()
    monkeypatch.undo()
    for trouble in (MemoryError(), ImportError("libx.so: failed to map segment from shared object")):
        monkeypatch.setattr(Path, "cwd", staticmethod(lambda trouble=trouble: throw(trouble)))
        assert "no memory is left: ask for less, or allow more" in one_line(run("prove", "nowhere"))


def throw(trouble):
    raise trouble


def test_a_module_that_raises_the_limit_of_calls_is_named_as_soon_as_others(tmp_path):
    folder, single = with_claims(small_folder(tmp_path / "doe2030"), "section_2"), tmp_path / "single.py"
    text = "import sys\nsys.setrecursionlimit(10**9)\ndef f(n):\n    return f(n + 1) + 1\nf(0)\n"
    (folder / "claims" / "section_2.py").write_text(text)
    single.write_text(text)
    before, set_limit = sys.getrecursionlimit(), sys.setrecursionlimit
    try:
        for read in (lambda: module_in(folder, "claims.section_2"), ProofFile(single).modules):
            assert "line 4: RecursionError: " in refusal(read)
            assert sys.getrecursionlimit() == MOST_CALLS and sys.setrecursionlimit is set_limit
    finally:
        sys.setrecursionlimit(before)


def test_a_module_that_raises_what_is_no_exception_is_named(tmp_path):
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2")
    (folder / "claims" / "section_2.py").write_text("raise GeneratorExit\n")
    assert "section_2.py: cannot be imported: line 1: GeneratorExit" in refusal(module_in, folder, "claims.section_2")


@pytest.mark.parametrize(("number", "words"), [("2**70", "beyond 64 bits"), ("sp.I", "no real number")])
def test_a_number_that_a_law_cannot_have_is_told_with_its_file_and_law(number, words, tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    (folder / "numbers.py").write_text(f"import sympy as sp\nSHARE = {number}\n")
    said = one_line(run("compare", folder))
    assert words in said and "study.toml: controllers.own.law" in said, said


def test_a_line_and_a_row_are_refused_with_their_file(tmp_path):
    letters = tmp_path / "symbols.toml"
    letters.write_text('[symbols]\nx = "real"\n')
    assert f"letters of {letters}" in one_line(run("check", "zz <= 1", "--symbols", letters))
    row = "[[rows]]\nid = '{}'\ntitle = 't'\nrole = 'claim'\nprinted = 'x = 1'\n"
    letters.write_text('[letters]\nx = { kind = "real" }\n')
    for text, words in ((row.format("1") * 2, "rows[1].id"), (row.format("../1"), "rows[0]: claim id")):
        (tmp_path / ROWS).write_text(text)
        assert f"{tmp_path / ROWS}: {words}" in refusal(state_rows, Paper("doe2030", "nowhere"), tmp_path)


def test_a_folder_of_a_whole_disk_is_refused_before_it_is_looked_through(tmp_path, monkeypatch):
    monkeypatch.setattr(folders, "MOST_ENTRIES", 3)
    small_folder(tmp_path / "doe2030")
    for arguments in (("check-certificates", tmp_path), ("export-coq", tmp_path, "--out", tmp_path / "out")):
        assert f"{tmp_path}: holds more than 3 files and folders" in one_line(run(*arguments))
    assert not (tmp_path / "out").exists()


def test_what_is_no_place_for_outputs_is_refused(tmp_path):
    (tmp_path / "mc").mkdir()
    os.mkfifo(tmp_path / "mc" / "rare.csv")
    assert "is a pipe" in refusal(check_outputs, {}, (), {"--out": (tmp_path / "mc", ("rare.csv",))})
    inside = tmp_path / "doe2030" / "certificates"
    inside.mkdir(parents=True)
    assert "holds certificates" in one_line(run("export-coq", tmp_path / "doe2030", "--out", inside))
    assert "--seconds is too large: give 86400 or less" in one_line(run("check-coq", tmp_path, "--seconds", "inf"))


def test_a_limit_within_another_is_the_outer_one():
    with pytest.raises(time_limit.OutOfTime), time_limit.at_most_seconds(0.05), time_limit.at_most_seconds(60.0):
        while True:
            pass


def test_deep_brackets_and_what_is_no_number_in_a_journal_are_damaged_records(tmp_path, capsys):
    path = tmp_path / "a.jsonl"
    with Journal(path, {"job": 1}, False) as journal:
        journal.append({"run": 1})
    path.write_bytes(path.read_bytes() + b"[" * 100_000 + b"\n")
    with Journal(path, {"job": 1}, True) as journal:
        assert journal.records == [{"run": 1}]
    assert "1 of 2 records are not what was written" in capsys.readouterr().err
    path.write_bytes(path.read_bytes().replace(b'{"run": 1', b'{"run": NaN'))
    with Journal(path, {"job": 1}, True) as journal:
        assert journal.records == []
    assert "2 of 2 records are not what was written" in capsys.readouterr().err


@pytest.mark.parametrize(("old", "new", "words"), [
    ("speed_mps = 13.88888888888889", "speed_mps = 1e-300", "speed_limit[0].speed_mps"),
    ("length_m = 5400.0", "length_m = 1e8", "length_m"), ("radius_m = 300.0", "radius_m = 1e-300", "curve[1]")])
def test_a_number_that_no_line_has_is_named_with_its_key(old, new, words, tmp_path):
    assert METRO in LINES
    assert words in refusal(load_track, changed_copy(METRO, tmp_path, old, new))


def test_options_are_refused_in_one_line(tmp_path):
    for arguments, words in ((("reference", "a", "b", "--intervals", 100_000), "--intervals is too large"),
                             (("compare", "--bogus"), "no such option --bogus"), (("nothing",), "'nothing'"),
                             (("sweep", "."), "'--out'"), (("compare", "a\nb", "c"), "unexpected extra argument")):
        said = one_line(run(*arguments, folder=tmp_path))
        assert words in said and "--help'" in said and said.isprintable()
    assert run().returncode == 0 and "Usage" in run().stdout


def test_a_value_of_any_length_is_told_in_a_short_line(tmp_path):
    huge, path = "x" * 200_000, tmp_path / "a.json"
    path.write_text(json.dumps({"verdict": huge, "version": huge}))
    ended = run("check-certificates", path)
    assert ended.returncode == 1 and len(ended.stderr) < 3000
    for line in (f'track = "{huge}"', f'"{huge}" = 1', f'kind = "{huge}"', f"kind = '''{huge}\n'''"):
        (tmp_path / "study.toml").write_text(f"version = 1\n{line}\n")
        assert len(one_line(run("compare", tmp_path / "study.toml"))) < 3000


def test_a_formula_that_would_take_minutes_stands_as_it_is():
    for latex in ("x + " * 50_000, r"\frac{x}{y} + " * 50_000):
        assert formula(latex).startswith("<code>")


@pytest.mark.parametrize("latex", [r"\undefined", r"\frac{", "{" * 400, "}" * 400, "\\", "\0", "x" * 5000])
def test_a_formula_that_cannot_be_read_stands_on_the_page_as_it_is(latex):
    assert len(formula(latex)) > 0


def test_a_trip_is_taken_over_only_as_it_was_written():
    row = TripRow("a", "line", "train", 1.0, 2.0, 1.5, 3.0, 2.9, 0.1, "optimal").document()
    assert TripRow.read(row) == TripRow(**row)
    for name in COLUMNS:
        assert TripRow.read({key: value for key, value in row.items() if key != name}) is None
        assert TripRow.read(row | {name: [1]}) is None
    for wrong in (row | {"more": 1}, row | {"energy_J": float("nan")}, row | {"gap": None}, None, []):
        assert TripRow.read(wrong) is None


@pytest.mark.parametrize("wrong", [1.5, [1], "17"])
def test_a_document_of_claims_that_is_none_is_named(wrong, tmp_path):
    path = tmp_path / "a.json"
    path.write_text(json.dumps({"claims": [{"id": "a:1", "tainted_by": wrong}]}))
    with pytest.raises(InputError, match=r"claims\[0\].tainted_by"):
        read_claims(path)


def test_certificates_that_do_not_hold_are_not_exported(tmp_path):
    path = tmp_path / "1.json"
    for text in ("[" * 100_000, "{}", "[]", '{"verdict": "proved", "goal": 1, "version": 2}', ""):
        path.write_text(text)
        assert str(path) in one_line(run("export-coq", tmp_path, "--out", tmp_path / "coq"))
    assert list(tmp_path.iterdir()) == [path]


def test_a_joint_sweep_is_no_larger_than_can_be_drawn():
    stated = {"ranges": {"a": (0.0, 1.0)}, "metric": "f", "seed": 1}
    with pytest.raises(ValidationError, match="samples"):
        Sensitivity(**stated, samples=2**40)


def test_a_line_that_is_not_there_is_told_with_the_key_that_names_it(tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    study = folder / "study.toml"
    study.write_text(changed(study.read_text(), 'track = "line.toml"', 'track = "nowhere.toml"'))
    said = one_line(run("compare", study))
    assert "nowhere.toml: no such file: check the path, 'track' in" in said and str(study) in said
    text = study.read_text()
    study.write_text(changed(text, '"nowhere.toml"', '"no\\u0000where.toml"'))
    said = one_line(run("compare", study))
    assert "is no path" in said and f"'track' in {study}" in said
    study.write_text(changed(text, '"nowhere.toml"', '"."'))
    said = one_line(run("compare", study))
    assert "is a folder: name a .toml file in it (check the path, 'track' in" in said and str(study) in said
    (folder / "words.toml").write_text("no table", encoding="utf-8")
    study.write_text(changed(text, '"nowhere.toml"', '"words.toml"'))
    said = one_line(run("compare", study))
    assert "words.toml: is not valid TOML" in said and f"(check the path, 'track' in {study})" in said
    for hostile, words in (("/dev/zero", "is a pipe, a device or a socket"), ("raw.toml", "is not UTF-8 text")):
        (folder / "raw.toml").write_bytes(b"\xff\xfe\x00")
        study.write_text(changed(text, '"nowhere.toml"', f'"{hostile}"'))
        said = one_line(run("compare", study))
        assert words in said and f"(check the path, 'track' in {study})" in said
    curve = '[reference]\nkind = "table"\nfile = "nowhere.csv"\n'
    study.write_text(re.sub(r"(?ms)^\[reference\].*?(?=^\[)", curve, changed(text, '"nowhere.toml"', '"line.toml"')))
    said = one_line(run("compare", study))
    assert "nowhere.csv: no such file" in said and f"'reference.file' in {study}" in said


def test_a_contest_says_so_of_its_scenario(tmp_path):
    path = tmp_path / "contest.toml"
    path.write_text(CONTEST)
    assert f"run.toml: no such file: check the path, 'scenario' in {path}" in one_line(run("compare", path))


def test_links_in_a_circle_are_named(tmp_path):
    path = tmp_path / "loop.json"
    path.symlink_to(path)
    assert str(path) in one_line(run("check-certificates", path))


@pytest.mark.parametrize("value", ["9223372036854775808", "-0x1" + "f" * 5000, "[{ a = [18446744073709551616] }]"])
def test_a_whole_number_beyond_64_bits_is_none_of_toml(value, tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(f"seed = {value}\n")
    with pytest.raises(InputError, match=r"seed.*64 bits|is not valid TOML"):
        read_toml(path)
    path.write_text("seed = 9223372036854775807\n")
    assert read_toml(path)["seed"] == 2**63 - 1


@pytest.mark.parametrize("text", ["a" + ".a" * 100_000 + " = 1", f"[{'a.' * 100_000}a]",
                                  "x = {" + "a." * 9999 + "a = 1}",
                                  "[[a]]\n" * 60_000, "".join(f"[[{'.'.join('a' * i)}]]\n" for i in range(1, 300))])
def test_a_file_of_keys_without_end_is_refused_before_it_is_parsed(text, tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(text)
    with pytest.raises(InputError, match=r"nested too deeply|more than 50000 tables") as said:
        read_toml(path)
    assert str(path) in str(said.value)


def test_a_number_that_no_float_holds_is_none_of_json(tmp_path):
    path = tmp_path / "a.json"
    path.write_text('{"claims": [1e999]}')
    with pytest.raises(InputError, match="too large a number"):
        read_json(path)


def test_a_whole_number_that_compiled_code_cannot_hold_is_refused_before_it_is_compiled():
    x = sp.Symbol("x")
    require_short([x * 2**63, x**9999, x / 3, sp.Rational(1, 2**62)])
    for expr in (x ** (10**30), x * sp.Rational(1, 10**30), sp.Integer(2**64)):
        with pytest.raises(CompileError, match="64 bits"):
            require_short([expr])


def test_a_name_of_any_length_is_told_in_a_short_line():
    assert len(one_line(run("prove", "a." + "y" * 5000))) < 900
