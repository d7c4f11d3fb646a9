"""mao2018's study."""

import pytest
from mao2018_cases import FILE

from workbench.cli.loading import load


@pytest.fixture(scope="module")
def study():
    return load(FILE.parent).study
