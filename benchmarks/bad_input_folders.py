"""Folders of small valid inputs for every verb, and the commands that read them: what bad input is made of."""

from __future__ import annotations

import contextlib
import io
import json
import re
import shlex
import shutil
import sys
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from bad_input_texts import (
    CLAIMS,
    CONTEST,
    CONTROLLERS,
    EXTRAS,
    FLEET,
    JOURNEY,
    LAW,
    LINE_MORE,
    PAPER,
    PID,
    RUN,
    STORE,
    STORE_STUDY,
    SYMBOLS,
    TRACK,
    TRAIN,
    UNCERTAINTY,
    VEHICLE,
    WINDOWS,
    line_text,
    sourced,
)

from workbench.cli.app import main
from workbench.paper.new_paper import write_new_paper

ROOT = Path(__file__).parents[1]


@dataclass(frozen=True)
class Command:
    """A command line that is run in a folder; reads: the files in it that may be spoiled, and the outputs it asks for.

    one_is_fine: whether exit code 1 is a verdict of this verb; weight: how often it is drawn, less where it takes long.
    """

    folder: str
    arguments: tuple[str, ...]
    reads: tuple[str, ...]
    outputs: tuple[str, ...] = ()
    one_is_fine: bool = False
    weight: float = 1.0

    @property
    def verb(self) -> str:
        """What is asked for."""
        return self.arguments[0]


def _command(
    folder: str, line: str, reads: str, outputs: str = "", one_is_fine: bool = False, weight: float = 1.0
) -> Command:
    words = tuple(shlex.split(line))
    fine = one_is_fine or words[0] in ("compare", "sweep")  # which say by it that every run failed
    return Command(folder, words, tuple(reads.split()), tuple(outputs.split()), fine, weight)


ALONE = "--workers 1"
COMMANDS = (
    _command("run", f"compare study.toml --json out.json {ALONE}", "study.toml line.toml reference.csv", "out.json"),
    _command("run", f"compare . --variants {ALONE}", "study.toml line.toml reference.csv"),
    _command("run", f"sweep . --runs 2 --out mc {ALONE}", "study.toml line.toml", "mc"),
    _command(
        "run", f"sweep . --runs 2 --out kept --resume {ALONE}", "kept/sweep.manifest.jsonl kept/sweep/00000.parquet",
        "kept", weight=0.4,
    ),
    _command(
        "run", f"sweep . --sensitivity --out joint --resume {ALONE}",
        "study.toml joint/joint_sensitivity.journal.jsonl", "joint", weight=0.4,
    ),
    _command("run", f"tune study.toml --out tuned --resume {ALONE}", "study.toml tuned/tuning.journal.jsonl", "tuned"),
    _command("run", f"tune study.toml --write {ALONE}", "study.toml", "study.toml"),
    _command("run", f"report study.toml --runs 1 --out page {ALONE}", "study.toml line.toml", "page", weight=0.1),
    _command("law", f"compare . {ALONE}", "study.toml laws.py line.toml"),
    _command(
        "contest", f"compare contest.toml --json out.json {ALONE}", "contest.toml run.toml line.toml", "out.json",
        weight=0.5,
    ),
    _command(
        "contest", f"compare contest.toml --out kept --resume {ALONE}", "kept/matches.journal.jsonl contest.toml",
        "kept", weight=0.15,
    ),
    _command("contest", f"tune contest.toml --runs 2 --out tuned {ALONE}", "contest.toml", "tuned"),
    _command("contest", f"report contest.toml --out page {ALONE}", "contest.toml", "page", weight=0.1),
    _command("plant", f"compare . {ALONE}", "study.toml plant.py laws.py"),
    _command("plant", f"sweep . --runs 1 --out mc {ALONE}", "study.toml", "mc"),
    _command("plant", f"tune . --runs 2 {ALONE}", "study.toml"),
    _command(
        "claims", f"prove . --json out.json --limit 2 {ALONE}", "paper.py claims/section_1.py values.toml", "out.json",
        True, weight=0.5,
    ),
    _command("claims", "show .::*", "paper.py claims/section_1.py values.toml", weight=0.04),
    _command(
        "claims", f"errata . --out pages {ALONE}", "paper.py claims/section_1.py values.toml", "pages", weight=0.3
    ),
    _command("claims", "list .", "paper.py claims/section_1.py"),
    _command(
        "claims", "export-coq . --out coq", "certificates/1.json certificates/2.json certificates/manifest.json", "coq"
    ),
    _command(
        "claims", "check-certificates certificates",
        "certificates/1.json certificates/2.json certificates/3.json certificates/manifest.json claims/section_1.py",
        "", True,
    ),
    _command("claims", "check-certificates certificates/2.json", "certificates/2.json", "", True),
    _command("claims", "check-coq coq --workers 1 --record .", "coq/index.json", "kernel.txt", True, 0.02),
    _command("claims", f"report study.toml --runs 1 --out page {ALONE}", "claims/section_1.py", "page", weight=0.1),
    _command("rows", f"prove . --limit 2 {ALONE}", "rows.toml symbols.toml", "", True, weight=0.4),
    _command("rows", "show .::*", "rows.toml symbols.toml", weight=0.04),
    _command("source", "new-paper made2026 --from paper.tex", "paper.tex", "made2026", weight=0.5),
    _command(
        "source", r"check '\dot V = -\alpha\frac{e^2}{k^2 - e^2}' --symbols symbols.toml --json out.json",
        "symbols.toml", "out.json", True,
    ),
    _command("source", "diff a.json b.json --json out.json", "a.json b.json", "out.json", True),
    _command(
        "reference", "reference line.toml train.toml --time 60 --intervals 20 --json out.json", "line.toml train.toml",
        "out.json out.csv out_certified.csv", weight=0.4,
    ),
    _command(
        "reference", "reference track.json train.json --time 80 --intervals 20", "track.json train.json", weight=0.4
    ),
    _command(
        "reference", "reference line.toml train.toml --timetable windows.toml --intervals 20",
        "windows.toml line.toml", weight=0.4,
    ),
    _command(
        "reference", "reference track.json train.json --timetable journey.json --intervals 20", "journey.json",
        weight=0.4,
    ),
    _command(
        "reference", "reference track.json train.json --time 90 --etcs --intervals 20", "train.json track.json",
        weight=0.4,
    ),
    _command(
        "reference", "reference line.toml train.toml --time 60 --check bound.json", "bound.json line.toml train.toml",
        weight=0.4,
    ),
    _command(
        "reference", f"reference --fleet fleet.toml --json day.json --csv day.csv --resume {ALONE}",
        "fleet.toml line.toml day.json", "day.json day.csv", weight=0.4,
    ),
    _command(
        "run", f"sweep . --rare position_rms>1000 --out rare {ALONE}", "study.toml line.toml", "rare", weight=0.1
    ),
    _command("run", f"sweep . --runs 2 --until-width position_rms=1 --draws sobol --out m {ALONE}", "study.toml", "m"),
    _command("run", "sweep . --runs 1 --out mc --dask nonsense", "study.toml", "mc", weight=0.1),
    _command("law", "export-fmu . good --out law.fmu", "study.toml laws.py line.toml", "law.fmu"),
    _command("store", f"compare . {ALONE}", "study.toml plant.py laws.py"),
    _command("store", f"sweep . --runs 2 --out mc {ALONE}", "study.toml plant.py", "mc"),
    _command("store", "export-fmu . up_to --out law.fmu", "study.toml plant.py laws.py", "law.fmu", weight=0.3),
    _command(
        "rows", r"check '\dot V \le 0' --symbols . --json -", "rows.toml symbols.toml paper.py", "", True, weight=0.5
    ),
    _command("claims", "examples claims", "paper.py", weight=0.1),
    _command("plant", "gains . --search --no-runs", "study.toml gains.py plant.py", weight=0.1),
    _command("gains", "gains . --no-runs --json out.json", "study.toml gains.py", "out.json", weight=0.05),
)


def called(folder: Path, line: str) -> None:
    """A command that must end well, in this process."""
    out, err = io.StringIO(), io.StringIO()
    with (
        patch.object(sys, "argv", ["workbench", *line.split()]),
        contextlib.chdir(folder),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        try:
            main()
        except SystemExit as end:
            if end.code not in (0, 1, None):
                raise RuntimeError(f"{line}: {end.code}: {err.getvalue()}") from None


def put(folder: Path, **files: str) -> Path:
    """A folder with files, by their names with `__` for a slash and `_DOT_` for a dot."""
    for name, text in files.items():
        path = folder / name.replace("__", "/").replace("_DOT_", ".")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder


def _reference(place: Path) -> None:
    train = TRAIN + "max_speed_mps = 40.0\nlength_m = 50.0\n"
    train += "".join(f'source.{key} = "assumed: a test"\n' for key in re.findall(r"(?m)^(\w+) = ", train))
    folder = put(
        place / "reference", line_DOT_toml=line_text(LINE_MORE), train_DOT_toml=train, windows_DOT_toml=WINDOWS,
        track_DOT_json=json.dumps(TRACK), train_DOT_json=json.dumps(VEHICLE), fleet_DOT_toml=FLEET,
        journey_DOT_json=json.dumps(JOURNEY),
    )
    called(
        folder,
        "reference line.toml train.toml --time 60 --intervals 20 --every 1 --csv run.csv --certificate bound.json",
    )
    called(folder, f"reference --fleet fleet.toml --json day.json --csv day.csv {ALONE}")


def _run(place: Path) -> None:
    table = (place / "reference" / "run.csv").read_text(encoding="utf-8")
    folder = put(
        place / "run", study_DOT_toml=sourced(RUN + PID + UNCERTAINTY + EXTRAS), line_DOT_toml=line_text(),
        reference_DOT_csv=table,
    )
    for line in ("sweep . --runs 2 --out kept", "sweep . --sensitivity --out joint", "tune study.toml --out tuned"):
        called(folder, f"{line} {ALONE}")


def _law(place: Path) -> None:
    law = CONTROLLERS.format(law="law.pd", parameters="K_p = 1.0, K_d = 2.0", initial="")
    put(place / "law", study_DOT_toml=sourced(RUN + law + UNCERTAINTY), line_DOT_toml=line_text(), laws_DOT_py=LAW)


def _contest(place: Path) -> None:
    folder = put(
        place / "contest", contest_DOT_toml=CONTEST, run_DOT_toml=sourced(RUN + PID + UNCERTAINTY),
        line_DOT_toml=line_text(),
    )
    called(folder, f"compare contest.toml --out kept {ALONE}")


def _plant(place: Path) -> None:
    study = write_new_paper("plant", place, "plant") / "study.toml"
    text = study.read_text(encoding="utf-8")
    for old, new in (
        ("duration_s = 10.0", "duration_s = 0.5"),
        ("at_s = 5.0", "at_s = 0.25"),
        ("runs = 30", "runs = 2"),
        ("horizon = 20", "horizon = 4"),
    ):
        text = text.replace(old, new)
    study.write_text(text, encoding="utf-8")


def _store(place: Path) -> None:
    plant, _, _ = STORE.partition("up_to = ")
    put(place / "store", plant_DOT_py=plant, laws_DOT_py=STORE, study_DOT_toml=STORE_STUDY)


def _claims(place: Path) -> None:
    folder = put(
        place / "claims", paper_DOT_py=PAPER, claims__section_1_DOT_py=CLAIMS, values_DOT_toml="bound = 1\n",
        study_DOT_toml=sourced(RUN + PID + UNCERTAINTY), line_DOT_toml=line_text(),
    )
    called(folder, f"prove . --write --json claims.json {ALONE}")
    called(folder, "export-coq . --out coq")


def _source(place: Path) -> None:
    folder = put(place / "source", symbols_DOT_toml=SYMBOLS)
    shutil.copy(ROOT / "tests" / "sources" / "twisting.tex", folder / "paper.tex")
    document = json.loads((place / "claims" / "claims.json").read_text(encoding="utf-8"))
    put(folder, a_DOT_json=json.dumps(document))
    document["claims"][0]["verdict"] = "refuted"
    put(folder, b_DOT_json=json.dumps(document))


def _rows(place: Path) -> None:
    called(place, "new-paper rows --from source/paper.tex")


def _gains(place: Path) -> None:
    shutil.copytree(
        ROOT / "proofs" / "chen2019", place / "gains", ignore=shutil.ignore_patterns("certificates", "claims")
    )


# In this order, for some take what others have made.
FOLDERS: dict[str, Callable[[Path], None]] = {
    "reference": _reference, "run": _run, "law": _law, "contest": _contest, "plant": _plant, "store": _store,
    "claims": _claims,
    "source": _source, "rows": _rows, "gains": _gains,
}


def write_folders(place: Path, names: Collection[str] = tuple(FOLDERS)) -> None:
    """The folders of those names, and what resumed commands go on with; all of them take a minute the first time."""
    for name, write in FOLDERS.items():
        if name in names:
            write(place)
