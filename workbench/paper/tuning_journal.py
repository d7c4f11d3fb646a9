"""The restarts of a search kept as they end, so that an interrupted one goes on where it stopped."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from workbench.errors import InputError
from workbench.files.modules import python_files
from workbench.files.regular import contents
from workbench.model.tuning import FOUND_KEYS
from workbench.paper.loading import Loaded
from workbench.paper.parameter_search import Finished, Restart, Task
from workbench.simulate.journal import REMEDY, Journal, code_digest, laws_digest
from workbench.trains.scenario import Scenario

JOURNAL_NAME = "tuning.journal.jsonl"
# On which modules of the package what is found depends.
SEARCHING = ("files/*.py", "model/*.py", "systems/*.py", "trains/*.py", "compile/*.py", "mpc/*.py", "simulate/*.py",
             "simulate/plants/*.py", "paper/*.py", "paper/plants/*.py", "contest/*.py")


def tuning_journal(folder: Path, loaded: Loaded, record: Any, resume: bool) -> Journal:
    """The journal of a file's searches in a folder; InputError where it is another file's, or cannot be written.

    What is found depends on the file's values, on the files beside it and on the code, which the digest holds; what was
    found before is no part of it.
    """
    values = record.model_dump(exclude={"tuning": set(FOUND_KEYS), "title": True, "citation": True})
    digest = hashlib.sha256(code_digest(*SEARCHING) + json.dumps(values, sort_keys=True, default=str).encode())
    if isinstance(record, Scenario):
        digest.update(laws_digest(record))
    elif loaded.kind and loaded.kind.depends:
        digest.update(loaded.kind.depends(record).encode())
    else:
        for file in sorted(python_files(loaded.folder)):
            digest.update(contents(file))
    return Journal(folder / JOURNAL_NAME, {"tuning of": record.name, "digest of values and code":
                                           digest.hexdigest()[:20]}, resume)


def kept_in(journal: Journal) -> Finished:
    """The restarts that a journal held, and what adds others to it; InputError for a record that is none."""
    finished: dict[Task, Restart] = {}
    read: TypeAdapter[Restart] = TypeAdapter(Restart)
    try:
        for line in journal.records:
            name, restart = line["task"]
            finished[(name if isinstance(name, str) else (name[0], name[1]), int(restart))] = read.validate_python(
                line["found"])
    except (ValidationError, KeyError, TypeError, ValueError, IndexError):
        raise InputError(journal.path, "", f"holds a record that is no restart of a search: {REMEDY}") from None
    return Finished(finished, lambda task, found: journal.append({"task": task, "found": asdict(found)}))
