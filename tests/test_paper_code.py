"""A paper's own Python code cannot end, double, silence or change the command that runs it: each is one line."""

import decimal
import errno
import json
import os
import signal
import sys
import threading
from pathlib import Path

import mpmath
import pytest
from command_line import one_line, run
from refusals import changed, refusal
from small_folders import small_folder, with_claims

from workbench.cli import app
from workbench.cli.console import out_console
from workbench.errors import InputError, OutOfTime
from workbench.files.modules import module_in
from workbench.files.paper_code import mistakes_told

# What a module does as it is imported, and what is said of it.
REFUSED = (
    ("import os; os._exit(0)", "line 1: calls os._exit, which ends this command"),
    ("import os; os.abort()", "calls os.abort"), ("import os; os.kill(os.getpid(), 9)", "calls os.kill"),
    ("import os; os.execl('/bin/true', 'true')", "line 1: calls os.execv"),
    ("import os; os.fork()", "calls os.fork, which makes another process"),
    ("import os; os.chdir('/')", "calls os.chdir"),
    ("import os; os.close(1)", "calls os.close, which closes"),
    ("import os; os.closerange(0, 9)", "calls os.closerange"),
    ("import signal; signal.signal(signal.SIGINT, signal.SIG_IGN)", "calls signal.signal"),
    ("import atexit; atexit.register(print)", "calls atexit.register"),
    ("import sys; sys.settrace(None)", "calls sys.settrace"),
    ("import resource as r; r.setrlimit(r.RLIMIT_CORE, (0, 0))", "calls resource.setrlimit"),
    ("import sys; sys.modules.clear()", "changes sys.modules"), ("import builtins; del builtins.len", "builtins"),
    ("import threading as t; t.Thread(target=t.Event().wait, args=(2,)).start()", "starts a thread"),
    ("import os; os.posix_spawn('/bin/sleep', ['sleep', '60'], {})", "starts another process"),
    ("import sys; sys.exit(0)", "line 1: SystemExit: 0"), ("input()", "line 1: EOFError"),
    ("raise BaseExceptionGroup('two', [SystemExit(0)])", "line 1: BaseExceptionGroup"),
)

# What many a module does for its own numbers: it is put back, with a note.
PUT_BACK = (
    ("import contextlib; contextlib.chdir('/').__enter__()", "changes the working folder"),
    ("import sys; sys.path.clear()", "changes sys.path"),
    ("import sys; sys.meta_path.clear()", "changes sys.meta_path"),
    ("import locale; locale.setlocale(locale.LC_NUMERIC, 'C.UTF-8')", "changes the locale"),
    ("import decimal; decimal.getcontext().prec = 2", "changes decimal's context"),
    ("import mpmath; mpmath.mp.dps = 2", "changes mpmath's precision"),
    ("import numpy; numpy.seterr(all='raise')", "changes what numpy does"),
)


def state():
    return (Path.cwd(), list(sys.path), list(sys.meta_path), decimal.getcontext().prec, mpmath.mp.prec, sys.stdin,
            sys.stdout, sys.stderr, signal.getsignal(signal.SIGINT), len([]))


def test_what_a_module_does_to_others_is_refused_with_its_file_and_undone(tmp_path):
    before = state()
    for number, (text, words) in enumerate(REFUSED):
        (tmp_path / f"module_{number}.py").write_text(text + "\n")
        said = refusal(module_in, tmp_path, f"module_{number}")
        assert said.startswith(f"{tmp_path / f'module_{number}.py'}: ") and words in said, (text, said)
        assert state() == before, text


def test_what_a_module_sets_for_its_own_numbers_is_put_back_with_a_note(tmp_path, capsys):
    before = state()
    for number, (text, words) in enumerate(PUT_BACK):
        (tmp_path / f"module_{number}.py").write_text(f"{text}\nfound = {number}\n")
        assert module_in(tmp_path, f"module_{number}").found == number
        assert f"{tmp_path / f'module_{number}.py'}: {words}" in capsys.readouterr().err, text
        assert state() == before, text


def test_what_a_module_imports_is_named_and_not_who_imports_it(tmp_path):
    (tmp_path / "__init__.py").write_text("")
    (tmp_path / "inner.py").write_text("import builtins\ndel builtins.len\n")
    (tmp_path / "outer.py").write_text("from . import inner\n")
    assert refusal(module_in, tmp_path, "outer").startswith(f"{tmp_path / 'inner.py'}: changes builtins")


def test_others_may_do_what_a_paper_may_not(tmp_path):
    (tmp_path / "quiet.py").write_text("import os\nhandle = os.open(os.devnull, os.O_RDONLY)\nos.close(handle)\n")
    module_in(tmp_path, "quiet")
    child = os.fork()
    if not child:
        os._exit(7)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7


def test_what_a_module_prints_and_warns_of_stands_beside_the_answer(tmp_path):
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2")
    claims = folder / "claims" / "section_2.py"
    claims.write_text("import sys, warnings\nprint('imported')\n"
                      "warnings.simplefilter('always')\nwarnings.warn('look')\n"
                      "sys.stdin.close()\nsys.stdout.close()\n"
                      + claims.read_text().replace("    return", "    print('called')\n    return"))
    done = run("prove", folder, "--json", "-", "--no-cache", "--workers", 1)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["claims"][0]["verdict"] == "proved"
    said = done.stderr.splitlines()
    assert {"imported", "called"} < set(said)
    assert f"workbench: note: {claims}: line 4: UserWarning: look" in said


@pytest.mark.parametrize("text", ["import sys; sys.exit(0)", "import os; os._exit(0)", "raise GeneratorExit",
                                  "class Mine(BaseException): pass\n    raise Mine",
                                  "async def late(): pass\n    return late()"])
def test_a_claim_that_makes_no_goal_is_misstated_even_where_it_ends_the_process(text, tmp_path):
    """And not as recorded, which an exit code of 0 would say."""
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2")
    claims = folder / "claims" / "section_2.py"
    claims.write_text(claims.read_text().replace("    return", f"    {text}\n    return"))
    done = run("prove", folder, "--workers", 1)
    assert done.returncode == 2 and "misstated: " in done.stderr
    assert "claim doe2030:2: " in done.stderr and "Traceback" not in done.stderr and "awaited" not in done.stderr


def test_what_a_papers_function_raises_is_told_with_its_file_and_nothing_else_is(tmp_path):
    path = tmp_path / "called.py"
    path.write_text("import sys\n\ndef leave(): sys.exit(0)\n\ndef fail(): return int('x')\n\n"
                    "def through(f): return f()\n")
    called = module_in(tmp_path, "called")
    for function, words in ((called.leave, "line 3: SystemExit: 0"), (called.fail, "line 5: ValueError: invalid")):
        with pytest.raises(InputError, match=words) as said, mistakes_told():
            function()
        assert str(said.value).startswith(f"{path}: ")
    for trouble in (KeyboardInterrupt, OutOfTime):
        with pytest.raises(trouble), mistakes_told():
            called.through(lambda trouble=trouble: throw(trouble))
    with pytest.raises(ZeroDivisionError), mistakes_told():
        throw(ZeroDivisionError)


def throw(trouble):
    raise trouble


def test_a_command_ends_though_a_papers_thread_does_not(tmp_path, monkeypatch):
    folder = with_claims(small_folder(tmp_path / "doe2030"), "section_2")
    claims, go_on = folder / "claims" / "section_2.py", threading.Event()
    monkeypatch.setattr(threading, "go_on", go_on, raising=False)
    claims.write_text("import threading\n" + claims.read_text().replace(
        "    return", "    threading.Thread(target=threading.go_on.wait).start()\n    return"))
    ended = []
    monkeypatch.setattr(app, "THREADS_S", 0.0)
    monkeypatch.setattr(app.atexit, "_run_exitfuncs", lambda: ended.append("functions"))
    monkeypatch.setattr(app.os, "_exit", ended.append)
    try:
        run("prove", folder, "--workers", 1, "--no-cache")
    finally:
        go_on.set()
    assert ended == ["functions", 0]


def test_nobody_reading_is_no_failure(monkeypatch):
    """As in `workbench list | true`: the exit code of a shell for a command that its pipe has ended, and no word."""
    def broken(*_):
        raise BrokenPipeError(errno.EPIPE, os.strerror(errno.EPIPE))

    monkeypatch.setattr(out_console, "print", broken)
    done = run("list")
    assert (done.returncode, done.stdout, done.stderr) == (app.NOBODY_READS, "", "")


def test_a_command_that_is_refused_says_so_in_one_line_where_its_code_ends_it(tmp_path):
    folder = small_folder(tmp_path / "doe2030")
    with (folder / "laws.py").open("a") as laws:
        laws.write("import os\nos._exit(0)\n")
    assert "laws.py: line 11: calls os._exit" in one_line(run("compare", folder))


@pytest.mark.parametrize(("file", "old", "new", "words"), [
    ("plant.py", "u - a * v", "u - a * v**1e300", "plant 'mine2030.mass': v**1"),
    ("plant.py", "u - a * v", "u - a * v**(10**30)", "beyond 64 bits"),
    ("plant.py", "u - a * v", "u - a * v * sp.Float('1e400')", "a number that no float holds"),
    ("laws.py", "- k * s", "- k * s * sp.Float('1e-400')", "law 'mine2030.adaptive': -1"),
    ("laws.py", "- k * s", "- k * s**(2**70)", "beyond 64 bits"),
    ("laws.py", "- k * s", "- k * s**-20_000", "has an exponent beyond 10000")])
def test_a_number_with_which_no_run_ends_is_told_with_its_file(file, old, new, words, tmp_path):
    """Of x**1e300 and its slopes a solver of MPC came to no end."""
    assert run("new-paper", "mine2030", "--plant", folder=tmp_path).returncode == 0
    path = tmp_path / "mine2030" / file
    path.write_text(changed(path.read_text(), old, new))
    said = one_line(run("compare", "mine2030", folder=tmp_path))
    assert said.startswith(f"workbench: mine2030/{file}: ") and words in said


def test_a_law_of_another_file_is_told_with_that_file(tmp_path):
    assert run("new-paper", "mine2030", "--plant", folder=tmp_path).returncode == 0
    folder = tmp_path / "mine2030"
    text = (folder / "laws.py").read_text()
    (folder / "other.py").write_text(changed(text, "- k * s", "- k * s**20_000"))
    study = folder / "study.toml"
    study.write_text(changed(study.read_text(), 'law = "adaptive"', 'law = "other.py::adaptive"'))
    assert one_line(run("compare", "mine2030", folder=tmp_path)).startswith("workbench: mine2030/other.py: law ")
