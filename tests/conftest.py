"""What every test starts from: one thread, a kernel cache beside the code, hypothesis without chance, clock or a look
at what is imported; and what each module leaves behind."""

import ctypes
import gc
import os
import sys
from pathlib import Path

import compiled_apart
import one_thread  # noqa: F401 - before anything imports numpy
import papers_import  # noqa: F401 - tests import from proofs
import pytest
from _pytest import runner
from hypothesis import settings
from hypothesis.internal.conjecture import providers
from shared_work import scheduler_of_files

from workbench.tasks.room_for_calls import with_room_for_calls

# Of glibc; elsewhere nothing is done.
give_back = getattr(ctypes.CDLL(None), "malloc_trim", int)
READ = {"workbench.files.text": ("_read", "_sources", "_digests"), "workbench.proof.dependencies": ("_data",)}

os.environ.setdefault("WORKBENCH_CACHE", str(Path(__file__).parent.parent / ".cache"))
# The same examples in every run, so that more of them find nothing that these have not found.
settings.register_profile("fixed", derandomize=True, deadline=None, max_examples=50)
settings.load_profile("fixed")
compiled_apart.install()
# Some examples are constants of the modules imported so far, which are others where other tests have run before.
providers._get_local_constants = lambda: providers._local_constants
# Nothing that collection imports is garbage: to look for some again and again takes a quarter of its time.
gc.disable()


@pytest.hookimpl(optionalhook=True)  # where xdist is not installed there is one process
def pytest_xdist_make_scheduler(config, log):
    return scheduler_of_files(config, log)


def pytest_collection_finish():
    """What was imported stays until the end, so that the collector need not go through it again and again."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 20)
    gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item, nextitem):
    """As pytest's own, on a stack without an edge, where kernels took nearly twice as long to compile."""
    return with_room_for_calls(runner.pytest_runtest_protocol, item, nextitem)


@pytest.fixture(scope="module", autouse=True)
def nothing_kept(request):
    """What the functions of a test's module have cached goes with it: a test process runs a hundred modules. What it
    has read is forgotten, too: decisions that are kept depend on everything that a process has read. What is left then
    stays, and is looked through no more. Memory that is free goes back to the system, as far as the C library can."""
    for module, names in READ.items():
        for name in names if module in sys.modules else ():
            getattr(sys.modules[module], name).clear()
    yield
    for value in vars(request.module).values():
        if getattr(value, "__module__", None) == request.module.__name__ and hasattr(value, "cache_clear"):
            value.cache_clear()
    gc.collect()
    gc.freeze()
    give_back(0)


@pytest.fixture(scope="session")
def contest():
    """The shipped contest; imported by those who ask for it, so that other tests start as fast as before."""
    from contests import common

    return common()


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory):
    """A folder that all processes of this test run share."""
    own = tmp_path_factory.getbasetemp()
    return own.parent if "PYTEST_XDIST_WORKER" in os.environ else own
