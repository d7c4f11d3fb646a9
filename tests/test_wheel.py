"""The wheel is a product: in an empty environment, without a clone, a copied paper and a law of one's own work whole.

The environment sees this one's packages through a .pth file, so that nothing is downloaded; not its workbench, because
a folder that a .pth file adds has its own .pth files ignored.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest
from small_folders import OBJECTIVE

ROOT = Path(__file__).resolve().parent.parent
SHORT_M = 4600.0
# Reports start worker processes, which find laws by their folder; what else is run here does without their start.
ONE = ("--workers", "1")

# The law that the README shows.
(LAWS,) = re.findall(r"## A law of your own beside MPC.*?```python\n(.*?)```",
                     (ROOT / "README.md").read_text(encoding="utf-8"), re.DOTALL)
STUDY = '''
version = 1
name = "mine"
title = "A law of my own beside MPC"
paper = "mine"
citation = "none"
track = "line.toml"

[train]
mass_kg = 200000.0
davis_a_mps2 = 0.02
davis_b_per_s = 4e-4
davis_c_per_m = 1.6e-5
max_traction_n = 200000.0
max_braking_n = 240000.0

[reference]
kind = "cruise_speed"
cruise_mps = 15.0
acceleration_mps2 = 0.5
braking_mps2 = 0.5
ramp_s = 4.0

[simulation]
plant_step_s = 0.01
dwell_s = 2.0
position_band_m = 0.2
log_every_s = 0.1

[disturbance]
amplitude_mps2 = 0.0
period_s = 60.0

[controllers.spring]
law = "mine.spring"
period_s = 0.01
parameters = { k_p = 1.0, k_d = 2.0 }

[controllers.same_by_file]
law = "laws.py::spring"
period_s = 0.01
parameters = { k_p = 1.0, k_d = 2.0 }

[controllers.mpc]
law = "mpc.linear"
period_s = 0.1

[controllers.mpc.parameters]
horizon = 25.0
position_weight = 25.0
speed_weight = 14.8
command_weight = 4.34
change_weight = 0.1
band_price = 1000.0

[uncertainty]
runs = 2
seed = 1
spread = 0.1
factors = ["mass"]

[tuning]
runs = 3
seed = 1
''' + OBJECTIVE + '''
[tuning.ranges.spring]
k_p = [0.1, 10.0]
k_d = [0.2, 20.0]
'''
LINE = '''
name = "a mile"
length_m = 1600.0
grade = [{ start_m = 0.0, end_m = 1600.0, grade_permille = 2.0 }]
curve = [{ start_m = 0.0, end_m = 1600.0, radius_m = inf }]
'''


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder with the environment `env` that the wheel is installed in, and nothing of the clone."""
    place = tmp_path_factory.mktemp("elsewhere")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    subprocess.run([*pip, "wheel", ROOT, "--no-deps", "--no-build-isolation", "-w", place / "wheel"], check=True)
    venv.create(place / "env", with_pip=False)
    (wheel,) = (place / "wheel").iterdir()
    subprocess.run([*pip, "--python", place / "env" / "bin" / "python", "install", "--no-deps", "--no-index",
                    "--no-compile", wheel], check=True)
    (packages,) = (place / "env" / "lib").glob("python*/site-packages")
    (packages / "dependencies.pth").write_text(sysconfig.get_path("purelib"))
    assert Path(run(place, "-c", "import workbench; print(workbench.__file__)", program="python").strip()
                ).is_relative_to(packages)
    run(place, "examples", "given")
    return place


def run(place: Path, *arguments: str, program: str = "workbench", code: int = 0) -> str:
    """Standard output of a program of the environment, run in the folder."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([place / "env" / "bin" / program, *arguments], cwd=place, capture_output=True, text=True,
                          check=False, env=environment)
    assert done.returncode == code, f"{arguments}: {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout


# In one process, which imports the package once.
VERBS = """
import contextlib, io, json, sys
from workbench.cli.app import main
told = []
for arguments, code in json.loads(sys.argv[1]):
    sys.argv, found = ["workbench", *arguments], 0
    with contextlib.redirect_stdout(io.StringIO()) as said:
        try:
            main()
        except SystemExit as end:
            found = end.code or 0
    told.append(said.getvalue())
    assert found == code, (arguments, found, told[-1])
print(json.dumps(told))
"""


def run_all(place: Path, *verbs: tuple[str, ...], codes: dict[str, int] | None = None) -> list[str]:
    """Standard output of each verb, one after the other; codes: of those that do not end with 0, by name."""
    calls = [(verb, (codes or {}).get(verb[0], 0)) for verb in verbs]
    return json.loads(run(place, "-c", VERBS, json.dumps(calls), program="python"))


def shortened(folder: Path) -> None:
    """Cut yang2021's line behind its first kilometres, which its variants do not fit, so that a run takes a second."""
    study = (folder / "study.toml").read_text()
    kept = [table for table in re.split(r"^(?=\[)", study, flags=re.MULTILINE)
            if not table.startswith("[[variants]]")]
    (folder / "study.toml").write_text("".join(kept))
    line = (folder / "line.toml").read_text()
    rows = [row for row in line.splitlines() if not row.startswith("  {") or
            float(re.search(r"start_m = ([\d.]+)", row)[1]) < SHORT_M]
    text = re.sub(r"end_m = ([\d.]+)", lambda end: f"end_m = {min(float(end[1]), SHORT_M)}", "\n".join(rows))
    (folder / "line.toml").write_text(text.replace("53880.0", str(SHORT_M)))


def test_the_examples_are_those_of_the_clone(place):
    given = {path.relative_to(place / "given") for path in (place / "given").rglob("*") if path.is_file()}
    papers = {path.relative_to(ROOT) for path in (ROOT / "proofs").rglob("*")
              if path.is_file() and "__pycache__" not in path.parts}
    shared = {path.relative_to(ROOT) for path in (ROOT / "benchmarks").rglob("*")
              if path.is_file() and path.suffix in (".toml", ".json", ".csv")
              and not {"peers", "textbook", "gains_problems"} & {*path.parts}}
    assert given == papers | shared
    assert [path for path in given if (place / "given" / path).read_bytes() != (ROOT / path).read_bytes()] == []
    listed = run(place, "list", "given/proofs")
    assert all(folder.name in listed for folder in (place / "given" / "proofs").iterdir())


def test_certificates_and_references_of_the_examples_work(place):
    run(place, "check-certificates", "given/proofs/goodwin1980")  # a small folder: elsewhere all are checked
    run(place, "reference", "given/benchmarks/lines/metro.toml", "given/benchmarks/trains/yang2021.toml",
        "--time", "150", "--to-m", "1200", "--json", "reference.json")
    assert json.loads((place / "reference.json").read_text())


def test_a_gallery_paper_takes_its_verbs(place):
    """The smallest one, its runs shortened: a plant, laws and MPC of the paper's own folder."""
    folder = place / "papers" / "gallery"
    shutil.copytree(place / "given" / "proofs" / "goodwin1980", folder)
    study = (folder / "study.toml").read_text()
    (folder / "study.toml").write_text(study.replace("duration_s = 20.0", "duration_s = 1.0"))
    of = "papers/gallery"
    *_, tuned, report = run_all(
        place, ("prove", of, *ONE), ("compare", of, "--json", "g.json", *ONE), ("tune", of, "--runs", "2", *ONE),
        ("report", of, "--out", "gallery", *ONE))
    assert "tuned: alpha" in tuned and "report: gallery/report.html" in report
    rows = {row["controller"]: row for row in json.loads((place / "g.json").read_text())["rows"]}
    assert set(rows) == {"projection", "frozen", "mpc"} and not any(row["failed"] for row in rows.values())
    claims = json.loads((place / "gallery" / "claims.json").read_text())["claims"]
    assert len(claims) > 5 and all(claim["verdict"] == claim["recorded"] for claim in claims)


@pytest.fixture(scope="module")
def copied(place):
    """yang2021's folder elsewhere, under another name, its line shortened."""
    shutil.copytree(place / "given" / "proofs" / "yang2021", place / "papers" / "own2026")
    shortened(place / "papers" / "own2026")
    return "papers/own2026"


def test_a_copied_paper_is_proved_compared_tuned_and_reported_under_another_name(place, copied):
    assert "report: page/report.html" in run(place, "report", copied, "--out", "page", "--runs", "1", "--no-gains")
    page = (place / "page" / "report.html").read_text()
    assert "rbfnn_pocrac" in page and "mpc" in page
    claims = json.loads((place / "page" / "claims.json").read_text())
    other = [c["equation"] for c in claims["claims"] if c["verdict"] != c["recorded"]]
    # The line that was cut is not the paper's: both are of its sections.
    assert len(claims["claims"]) > 50 and other == ["53.start", "table1"]
    _, _, _, tuned, _ = run_all(
        place, ("prove", copied, "--json", "claims.json"),  # from what the report has kept
        ("compare", copied, "--json", "compared.json", *ONE),
        ("sweep", copied, "--runs", "1", "--out", "mc", "--controller", "pid", *ONE),
        ("tune", copied, "--runs", "2", "--controller", "pid", *ONE), ("gains", copied, "--json", "gains.json", *ONE),
        codes={"prove": 1})
    rows = {row["controller"]: row for row in json.loads((place / "compared.json").read_text())["rows"]}
    assert set(rows) == {"rbfnn_pocrac", "pocrac", "rbf_pid", "pid", "mpc"}
    assert not any(row["failed"] for row in rows.values())
    assert (place / "mc" / "sweep.csv").read_bytes().splitlines()[1] in (
        place / "page" / "monte_carlo" / "sweep.csv").read_bytes().splitlines()
    assert "tuned" in tuned
    effects = json.loads((place / "gains.json").read_text())["effects"]
    better = [effect for effect in effects if effect["gains"] == "found"]
    assert better and len(better) < len(effects) and not any(effect["failed"] for effect in better)


def test_a_law_of_ones_own_beside_mpc_needs_one_file(place):
    folder = place / "papers" / "mine"
    folder.mkdir(parents=True)
    for name, text in (("laws.py", LAWS), ("study.toml", STUDY), ("line.toml", LINE)):
        (folder / name).write_text(text)
    run(place, "report", "papers/mine", "--out", "mine_page", "--runs", "1")
    rows = {row["controller"]: row for row in json.loads((place / "mine_page" / "compare.json").read_text())["rows"]}
    assert not any(row["failed"] for row in rows.values())
    assert rows["spring"]["position_rms"] == rows["same_by_file"]["position_rms"] > rows["mpc"]["position_rms"]
    _, tuned, compared, listed = run_all(
        place, ("sweep", "papers/mine", "--runs", "2", "--out", "mine_mc", *ONE),
        ("tune", "papers/mine", "--write", *ONE), ("compare", "papers/mine", "--variants", *ONE), ("list", "papers"))
    assert "written" in tuned and "tuned, 3 runs each" in compared and "mine" in listed
