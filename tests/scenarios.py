"""Scenarios the tests run: the shipped ones, and a short line on which a run takes a fraction of a second."""

import tomllib
from pathlib import Path

from workbench.files.folders import STUDY_FILE, held_in, papers_in
from workbench.files.toml import read_toml, validate_record
from workbench.model.law import ControlLaw
from workbench.model.laws import GENERAL, law_named
from workbench.trains.scenario import ControllerSpec, Scenario, Variant, changed_scenario, load_scenario
from workbench.trains.track import Track

ROOT = Path(__file__).resolve().parent.parent
PROOFS, SHARED = ROOT / "proofs", ROOT / "benchmarks"
PAPERS = [folder.name for folder in papers_in(PROOFS)]
# Papers about trains have a line; the others bring a plant of their own.
TRAIN_PAPERS = [paper for paper in PAPERS if (PROOFS / paper / "line.toml").is_file()]
FILES = [*sorted(SHARED.glob("*.toml")), *(PROOFS / paper / "study.toml" for paper in PAPERS),
         *sorted(PROOFS.glob("*/contest.toml"))]
BENCHMARKS = [path for path in FILES if "kind" not in tomllib.loads(path.read_text(encoding="utf-8"))]
STUDIES = [path for path in FILES if path not in BENCHMARKS]
YANG = PROOFS / "yang2021" / "study.toml"



def name_of(path: Path) -> str:
    """What a shipped file is called among the others: its paper, or its own name."""
    return path.parent.name if path.name == STUDY_FILE else path.stem


# Every line that ships: the shared ones, and those of papers.
LINES = [*sorted(SHARED.glob("lines/*.toml")), *(PROOFS / paper / "line.toml" for paper in TRAIN_PAPERS)]
TRAINS = sorted(SHARED.glob("trains/*.toml"))
# Lines that every train can run, and with them each paper's own line under its own train.
LINES_FOR_ALL = [*sorted(SHARED.glob("lines/*.toml")), PROOFS / "yang2021" / "line.toml"]
DRIVEN = [(line, train) for line in LINES_FOR_ALL for train in TRAINS]
DRIVEN += [(PROOFS / train.stem / "line.toml", train) for train in TRAINS
           if train.stem in PAPERS and PROOFS / train.stem / "line.toml" not in LINES_FOR_ALL]


def line_name(path: Path) -> str:
    """What a shipped line is called among the others: its paper, or its own name."""
    return path.parent.name if path.name == "line.toml" else path.stem


# Every compiled law that ships and runs with plain values, by its id; liu2020's own tests run its laws with its values.
LAWS = {name: make() for name, make in GENERAL.items()} | {
    law.id: law for paper in PAPERS if paper != "liu2020"
    for law in held_in(PROOFS / paper, "laws", ControlLaw).values()}

SHORT_LINE = {
    "name": "short line",
    "length_m": 900.0,
    "grade": [
        {"start_m": 0.0, "end_m": 1.0, "grade_permille": 2.0},
        {"start_m": 1.0, "end_m": 400.0, "grade_permille": -3.0},
        {"start_m": 400.0, "end_m": 900.0, "grade_permille": 4.0},
    ],
    "curve": [
        {"start_m": 0.0, "end_m": 300.0, "radius_m": float("inf")},
        {"start_m": 300.0, "end_m": 900.0, "radius_m": 400.0},
    ],
    "tunnel": [{"start_m": 500.0, "end_m": 600.0, "resistance_n_per_kn": 1.5}],
}
SHORT_REFERENCE = {
    "kind": "cruise_speed", "cruise_mps": 15.0, "acceleration_mps2": 0.4, "braking_mps2": 0.5, "ramp_s": 6.0,
}
# A light train, as the text of a scenario on the line beside it.
LIGHT_TRAIN = """\
track = "line.toml"
[train]
mass_kg = 200000.0
davis_a_mps2 = 0.02
davis_b_per_s = 1e-4
davis_c_per_m = 1e-5
max_traction_n = 200000.0
"""


def _sourced(values: dict) -> dict:
    return values | {"source": dict.fromkeys(values, "assumed: a test")}


def short_scenario(**changes: object) -> Scenario:
    """yang2021's train and controllers on the short line; changes by dotted key, written with `__`."""
    data = tomllib.loads(YANG.read_text(encoding="utf-8"))
    track = validate_record(_sourced(SHORT_LINE), Track, "short line")
    data |= {"track": track, "reference": _sourced(SHORT_REFERENCE)}
    data["simulation"] |= {"plant_step_s": 0.01, "dwell_s": 2.0, "log_every_s": 0.01}
    for spec in data["controllers"].values():
        spec["period_s"] = 0.1 if spec["law"].startswith("mpc") else 0.01
    for key, value in changes.items():
        *parents, last = key.split("__")
        table = data
        for parent in parents:
            table = table[parent]
        if "source" in table and last not in table["source"]:
            table["source"][last] = "assumed: a test"
        table[last] = value
    return validate_record(data, Scenario, "short scenario").in_folder(YANG.parent)


def variant_of(path: Path, variant: Variant) -> Scenario:
    """The scenario of a file with one variant's values set."""
    return changed_scenario(path, read_toml(path), variant, load_scenario(path))


def with_law(scenario: Scenario, law: ControlLaw, period_s: float, estimates: str = "corrected") -> Scenario:
    """The scenario with one controller, 'only', that runs `law` with `values_for` it."""
    spec = values_for(law) | {"law": law.id, "period_s": period_s, "estimates": estimates}
    only = validate_record(_sourced(spec), ControllerSpec, f"controller for {law.id}")
    return scenario.model_copy(update={"controllers": {"only": only}, "printed_table": None})


# What a law of mao2018 can run with at 15 m/s and 20 samples a second, where a plain 0.5 is too much; modes that come.
MODERATE = {
    "Gamma_a": 0.1, "Gamma_b": 1e-3, "Gamma_c": 1e-5, "Gamma_vartheta": 1e-3, "Gamma_m": 1e-3, "Gamma_k": 1e-3,
    "Gamma_xi": 1e-3, "Gamma_d": 1e-3, "k_1": 1e-4, "k_2": 1e-6, "delta_0": 0.01, "layer": 0.05, "T_2": 2.0,
    "T_3": 5.0, "T_4": 60.0, "psi_rate": 0.25, "rho_hat_1": 2.0, "rho_hat_2": 2.0, "rho_hat_3": 2.0, "rho_hat_4": 2.0,
    "lambda_0_1": 0.01, "lambda_0_2": 0.01, "lambda_0_3": 0.01, "lambda_0_4": 0.01,
}


def values_for(law: ControlLaw) -> dict:
    """Values a law can run with: those of a shipped scenario's law of the same names, else plain ones."""
    for path in BENCHMARKS:
        for spec in tomllib.loads(path.read_text(encoding="utf-8"))["controllers"].values():
            other = None if spec["law"].startswith("mpc.") else law_named(spec["law"], path.parent)
            if other and set(other.parameters) == set(law.parameters) and \
                    {s.symbol for s in other.states} == {s.symbol for s in law.states}:
                return {key: spec[key] for key in ("parameters", "initial", "neurons") if key in spec}
    values: dict = {
        "parameters": {str(s): MODERATE.get(str(s), 0.5) for s in law.parameters},
        "initial": {str(s.symbol): MODERATE.get(str(s.symbol), 0.1) for s in law.scalar_states},
    }
    indexed = (*(s.symbol for s in law.neuron_states), *law.neuron_data)
    bases = [str(symbol.base.label) for symbol in indexed]
    if bases:
        inputs = sum(base[:2] == "c_" and base[2:].isdigit() for base in bases)
        placed = {"b_h", "b_before"} | {base for base in bases if base.startswith("c_")}
        values["initial"] |= {base: 0.1 for base in bases if base not in placed}
        values["neurons"] = _sourced({"count": 5, "first_center": 0.0, "last_center": 900.0,
                                      "other_centers": [1.0] * (inputs - 1), "width": 100.0})
    return values
