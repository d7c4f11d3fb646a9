"""chen2019's study, and one on a short trip with its runs."""

import pytest
from chen2019_studies import FOLDER, changed

from proofs.chen2019.study.runs import groups, run_cases_together
from workbench.cli.loading import load
from workbench.paper.reproduced import stated_and_changed
from workbench.paper.reproduction import case_title

# A stronger train that is at its cruise speed soon, and fewer trips.
SHORT = {"train.traction_n": 2e5, "train.braking_n": 2e5, "reference.acceleration_mps2": 1.0,
         "reference.braking_mps2": 1.0, "reference.trip_time_s": 200.0, "trials.count": 8, "trials.shown": (1, 8),
         "cost.end_s": 2.0}


@pytest.fixture(scope="module")
def study():
    return load(FOLDER).study


@pytest.fixture(scope="module")
def short(study):
    """The stated study on a short trip, with the changes that the tests look at."""
    wanted = ("c_1 = 1, acceleration of the sample before", "c_3 = 1/100, room of 100 kg for the estimate of the mass",
              "(17)-(22) with the errors of the same sample", "slopes as a function of time", "slopes where the car is",
              "50.03 to 55 t: the lower bound 30 kg above the mass", "acceleration filtered with 0.1 s")
    base = changed(study, **{key.replace(".", "__"): value for key, value in SHORT.items()})
    return base.model_copy(update={"changes": tuple(c for c in study.changes if c.title in wanted),
                                   "pairs": study.pairs.model_copy(update={"draws": 2, "set": {
                                       "reference.cruise_mps": 30.0, "reference.trip_time_s": 80.0}})})


@pytest.fixture(scope="module")
def runs(short):
    """Of every change by its title, and the stated one."""
    return {case_title(short, case): run for among in groups(short, stated_and_changed(short))
            for case, run in zip(among, run_cases_together(short, among), strict=True)}
