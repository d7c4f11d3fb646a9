"""Several workers do what one does, in the same order, and none outlives the command."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import pytest
from small_papers import TEXT, certificates, deciders_at_rest, document, proved, write_paper

from workbench.errors import InputError, WorkbenchError

PATIENCE_S = 300.0  # a busy machine may take long; nothing waits longer than it must

STUCK = '''
    import os, time
    (Path(__file__).parent / "pid").write_text(str(os.getpid()))
    time.sleep(600)
'''

# The command line, interruptible though whoever started the tests ignores Ctrl-C, as a shell does in the background.
INTERRUPTIBLE = """
import signal
signal.signal(signal.SIGINT, signal.default_int_handler)
from workbench.cli.app import main
main()
"""


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("WORKBENCH_CACHE", str(tmp_path / "cache"))


def test_the_number_of_workers_changes_nothing_but_the_time(tmp_path):
    other = TEXT.replace("small2020", "other2020").replace("bound),)", "2 * bound),)")
    papers = [write_paper(tmp_path / "a"), write_paper(tmp_path / "b", other, bound=-5)]
    papers[1] = papers[1].rename(tmp_path / "b" / "other2020.py")
    one, several = (proved(*papers, jobs=jobs, use_cache=False) for jobs in (1, 3))
    assert document(one, seconds=False) == document(several, seconds=False)
    assert [d.claim.id for d in several.decisions] == [
        f"{paper}2020:{number}" for paper in ("small", "other") for number in range(1, 6)]
    assert certificates(one, tmp_path / "one") == certificates(several, tmp_path / "several") != {}


def test_what_several_workers_decide_is_kept_for_all(tmp_path):
    path = write_paper(tmp_path)
    command = [sys.executable, "-m", "workbench", "prove", str(path), "--jobs"]
    with deciders_at_rest():
        shown = [subprocess.run([*command, jobs], cwd=tmp_path, capture_output=True, text=True, check=True).stdout
                 for jobs in ("2", "2", "1")]
        assert "5 decided now, 0 from the cache" in shown[0]
        assert "0 decided now, 5 from the cache" in shown[1]
        assert shown[1] == shown[2]


@pytest.mark.parametrize("jobs", [1, 2])
def test_all_claims_that_cannot_be_built_are_told_of_in_their_order(tmp_path, jobs):
    text = TEXT
    for wrong in ("x**2, bound", "x**2, stated", "D(x**2), -2"):
        text = text.replace(wrong, f"undeclared_{wrong[-2:]} * {wrong}")
    misstated = proved(write_paper(tmp_path, text), jobs=jobs).misstated
    assert next(iter(misstated)) == "small2020:2"
    assert "small2020.py: claim small2020:2: " in misstated["small2020:2"]
    assert "undeclared_nd" in misstated["small2020:2"]


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_file_that_cannot_be_imported_is_named(tmp_path, jobs):
    good, bad = write_paper(tmp_path / "a"), write_paper(tmp_path / "b", "import helper\nV = undeclared")
    with pytest.raises(InputError, match=r"b.small2020\.py: cannot be imported: line 2: NameError.*declare"):
        proved(good, bad, jobs=jobs)


@pytest.mark.parametrize("jobs", [1, 2])
def test_modules_of_one_name_in_two_folders_are_not_taken_for_each_other(tmp_path, jobs):
    text = TEXT.replace("x**2, bound", "x**2, later()").replace("    return Goal((at_least(x**2, later", (
        "    from helper import bound as later\n    return Goal((at_least(x**2, later")).replace("later()", "later")
    one = write_paper(tmp_path / "a", text, bound=-1)
    other = write_paper(tmp_path / "b", text.replace("small2020", "other2020"), bound=7)
    proof = proved(one, other, jobs=jobs, use_cache=False)
    verdicts = {d.claim.id: d.verdict for d in proof.decisions}
    assert verdicts["small2020:2"] == "proved"
    assert verdicts["other2020:2"] == "refuted"
    assert "helper" not in sys.modules


def test_a_worker_that_dies_is_said_in_one_line(tmp_path):
    dies = "    import ctypes; ctypes.CDLL(None)._exit(3)"
    path = write_paper(tmp_path, TEXT.replace('    """The note of 3."""', dies))
    with pytest.raises(WorkbenchError, match=r"died.*--workers 1"):
        proved(path, jobs=2)


def test_so_is_a_server_of_workers_that_dies(tmp_path, monkeypatch):
    """As the standard library tells of it: by the end of what it reads."""
    def submit(*_):
        raise EOFError("unexpected EOF")

    monkeypatch.setattr(ProcessPoolExecutor, "submit", submit)
    with pytest.raises(WorkbenchError, match=r"starts the workers has died .*: run again.*what was finished is kept"):
        proved(write_paper(tmp_path), jobs=2)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_an_interruption_leaves_no_process_behind(tmp_path, jobs):
    path = write_paper(tmp_path, TEXT.replace('    """The note of 3."""\n', STUCK[1:]))
    command = [sys.executable, "-c", INTERRUPTIBLE, "prove", str(path), "--jobs", jobs]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          start_new_session=True) as running:
        worker = stuck_worker(tmp_path / "pid")
        os.killpg(running.pid, signal.SIGINT)  # what a terminal sends
        _, errors = running.communicate(timeout=PATIENCE_S)
    assert running.returncode == 130
    assert errors.strip().splitlines() == ["workbench: interrupted; what was finished is kept"]
    assert not runs(worker)


def test_workers_go_with_a_parent_that_is_killed(tmp_path):
    path = write_paper(tmp_path, TEXT.replace('    """The note of 3."""\n', STUCK[1:]))
    with subprocess.Popen([sys.executable, "-m", "workbench", "prove", str(path), "--jobs", "2"], cwd=tmp_path,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        worker = stuck_worker(tmp_path / "pid")
        running.kill()
    deadline = time.monotonic() + PATIENCE_S
    while runs(worker) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not runs(worker)


def stuck_worker(path):
    """The process that decides the claim that never ends."""
    deadline = time.monotonic() + PATIENCE_S
    while not (path.exists() and path.read_text()):
        assert time.monotonic() < deadline, "the claim was never reached"
        time.sleep(0.05)
    return int(path.read_text())


def runs(process):
    """Whether it still does anything; one that ended may wait for whoever should note it."""
    try:
        return "Z" not in Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
