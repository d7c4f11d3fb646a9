"""liu2020's study, and one so short that a run takes a fraction of a second."""

from pathlib import Path

import pytest

from proofs.liu2020.study.record import Section
from workbench.cli.loading import load

FILE = Path(__file__).parents[3] / "proofs" / "liu2020" / "study.toml"


@pytest.fixture(scope="module")
def study():
    return load(FILE.parent).study


@pytest.fixture(scope="module")
def short(study):
    """12 km with a slope, networks that matter, steps of 5 ms: a run takes a fraction of a second."""
    source = dict.fromkeys(("from_m", "to_m", "slope"), "assumed: a test")
    section = Section(from_m=5000.0, to_m=7000.0, slope=1.0, source=source)
    faster = {"gamma_f_per_s2": 6e-3, "alpha_1_per_s2": 0.09, "gamma_v_n_per_m": 135.0, "alpha_2_n_per_m": 2000.0}
    return study.model_copy(update={
        "line": study.line.model_copy(update={"length_m": 12e3, "sections": (section,)}),
        "sampling": study.sampling.model_copy(update={"period_s": 0.005}),
        "adaptation": study.adaptation.model_copy(update=faster),
        "pairs": study.pairs.model_copy(update={"draws": 2, "set": {}})})
