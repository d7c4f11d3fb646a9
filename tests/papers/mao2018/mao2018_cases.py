"""The cases of mao2018's study, by their numbers."""

from pathlib import Path

from proofs.mao2018.simulation.trip import wrong_signs

FILE = Path(__file__).parents[3] / "proofs" / "mao2018" / "study.toml"
CASES = (1, 2, 3, 4, 5)


def all_wrong(study, case):
    return wrong_signs(study.cases[case - 1])
