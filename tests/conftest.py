"""What every test starts from: a kernel cache beside the code, and hypothesis without chance or clock."""

import os
from pathlib import Path

import papers_import  # noqa: F401 - tests import from proofs
import pytest
from hypothesis import settings

os.environ.setdefault("WORKBENCH_CACHE", str(Path(__file__).parent.parent / ".cache"))
settings.register_profile("fixed", derandomize=True, deadline=None)
settings.load_profile("fixed")


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
