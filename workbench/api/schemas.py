"""JSON Schemas of the files that the workbench reads and writes, made from the types that read and write them."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, Literal

from pydantic import TypeAdapter

from workbench.errors import InputError
from workbench.files.folders import is_folder
from workbench.files.known_names import one_of
from workbench.files.modules import has_module
from workbench.paper.loading import study_file, study_kind

DRAFT = "https://json-schema.org/draft/2020-12/schema"


@dataclass(frozen=True)
class Format:
    """A kind of file: what it is, whether it is read or written, and the type that its schema is made from."""

    name: str
    title: str
    use: Literal["reads", "writes"]
    module: str
    type: str


FORMATS = tuple(Format(*row) for row in (
    ("scenario", "a scenario in TOML: train, line, reference and controllers", "reads",
     "trains.scenario", "Scenario"),
    ("plant-study", "a study of a plant of one's own (kind = \"plant\") in TOML", "reads",
     "paper.plants.record", "PlantStudy"),
    ("contest", "a contest (kind = \"contest\") in TOML", "reads", "contest.record", "Contest"),
    ("line", "a line in TOML", "reads", "trains.track", "Track"),
    ("train", "a train in TOML", "reads", "optimal.inputs.train_file", "TrainFile"),
    ("timetable", "a timetable in TOML", "reads", "optimal.inputs.journey", "TimetableFile"),
    ("fleet", "a day's trips in TOML", "reads", "optimal.inputs.fleet_file", "FleetFile"),
    ("reference-rule", "the rule for a paper's reference.csv in TOML", "reads",
     "optimal.curve_request", "CurveRequest"),
    ("symbols", "the letters of a pasted line in TOML", "reads", "proof.latex.symbols", "SymbolsFile"),
    ("rows", "rows.toml of a paper that was made from its LaTeX source", "reads", "proof.latex.rows", "RowsFile"),
    ("letters", "symbols.toml of a paper that was made from its LaTeX source", "reads",
     "proof.latex.rows", "LettersFile"),
    ("front", "front.toml, the gains that `gains --search --write` found", "reads", "paper.gain_front", "FrontRecord"),
    ("claims", "what `prove --json` and `show --json` write", "writes", "proof.document_format", "ClaimsDocument"),
    ("answer", "what `check --json` writes", "writes", "proof.document_format", "AnswerDocument"),
    ("changes", "what `diff --json` writes", "writes", "report.document_format", "ChangesDocument"),
    ("findings", "findings.json of `errata`", "writes", "report.document_format", "FindingsDocument"),
    ("certificate", "a certificate", "writes", "proof.document_format", "Certificate"),
    ("certificates-manifest", "manifest.json of a folder of certificates", "writes",
     "proof.document_format", "Manifest"),
    ("comparison", "what `compare --json` writes of a scenario", "writes",
     "report.document_format", "ComparisonDocument"),
    ("study-result", "what `compare --json` writes of a study or a contest", "writes",
     "report.document_format", "StudyDocument"),
    ("gains", "what `gains --json` writes", "writes", "report.document_format", "GainsDocument"),
    ("reference", "what `reference --json` writes", "writes", "optimal.document_format", "ReferenceDocument"),
    ("fleet-result", "what `reference --fleet --json` writes", "writes", "report.document_format", "FleetDocument"),
))


def schema(what: str | Path) -> dict[str, Any]:
    """The schema of a format by its name, or of the file of a paper's own study by the paper's folder or that file.

    Raises InputError for what is neither.
    """
    found = next((one for one in FORMATS if one.name == str(what)), None)
    if found is not None:
        return _made(getattr(import_module(f"workbench.{found.module}"), found.type), found.title)
    path = Path(what)
    if is_folder(path) or path.suffix == ".toml":
        path = study_file(path)
        if not has_module(path.parent, "study"):
            raise InputError(path, "", "has no study of a paper's own beside it (study/__init__.py): name its format, "
                             "such as scenario")
        return _made(study_kind(path).record, f"the study of {path.parent.name} in TOML")
    raise InputError("", str(what), "is no format and no study's folder: "
                     f"{one_of(str(what), [one.name for one in FORMATS])}, or name a folder")


def schemas() -> dict[str, dict[str, Any]]:
    """The schemas of all formats, by their names."""
    return {one.name: schema(one.name) for one in FORMATS}


def _made(kind: Any, title: str) -> dict[str, Any]:
    return {"$schema": DRAFT, **TypeAdapter(kind).json_schema(), "title": title}
