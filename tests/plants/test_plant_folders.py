"""A folder with a plant of one's own through every verb, and the same from Python."""

import io
import json
import re
import shutil
import subprocess
import sys
from contextlib import contextmanager
from weakref import ref

import pyarrow.parquet
import pytest
from command_line import one_line
from rich.console import Console
from test_cli import run

import workbench as wb
from workbench.cli.study_tables import result_table
from workbench.errors import InputError, WorkbenchError
from workbench.paper.loading import load
from workbench.paper.new_paper import TEMPLATES, template_files, write_new_paper
from workbench.paper.plants.sweep import PlantSweep, row_columns, sweep
from workbench.simulate import parts, row_store
from workbench.systems.metric import Metric

FILES = ["claims/section_2.py", "gains.py", "laws.py", "paper.py", "plant.py", "study.toml"]


@pytest.fixture(scope="module")
def mine(tmp_path_factory):
    """A new folder, shortened to half a second a run."""
    folder = write_new_paper("mine2026", tmp_path_factory.mktemp("new"), "plant")
    study = folder / "study.toml"
    text = study.read_text().replace("duration_s = 10.0", "duration_s = 0.5").replace("at_s = 5.0", "at_s = 0.25")
    study.write_text(text.replace("runs = 30", "runs = 6").replace("horizon = 20", "horizon = 8"))
    return folder


def test_a_newcomer_reads_less_than_a_hundred_and_fifty_lines():
    template = TEMPLATES["plant"]
    assert [place.as_posix() for place in template_files(template)] == FILES
    assert sum(len((template / name).read_text().splitlines()) for name in FILES) < 150


def test_every_verb_takes_it(mine):
    folder = mine.parent
    proved = run("prove", "mine2026", "--json", "claims.json", "--jobs", 1, folder=folder)
    assert proved.returncode == 0, proved.stderr
    claims = json.loads((folder / "claims.json").read_text())["claims"]
    assert {c["kind"] for c in claims} == {"identity", "inequality", "implication", "limit"}
    assert {c["verdict"] for c in claims} == {"proved", "refuted"}
    compared = run("compare", "mine2026", "--json", "compared.json", "--workers", 1, folder=folder)
    assert compared.returncode == 0, compared.stderr
    rows = {row["controller"]: row for row in json.loads((folder / "compared.json").read_text())["rows"]}
    assert list(rows) == ["adaptive", "mpc"] and all(row["failed"] is None for row in rows.values())
    assert all(row["x_error_rms"] < 0.3 and row["fallbacks"] == 0 for row in rows.values())
    swept = run("sweep", "mine2026", "--runs", 2, "--out", "mc", "--workers", 1, folder=folder)
    assert swept.returncode == 0, swept.stderr
    assert len((folder / "mc" / "sweep.csv").read_text().splitlines()) == 1 + 2 * 2
    tuned = run("tune", "mine2026", "--write", "--workers", 1, folder=folder)
    assert tuned.returncode == 0 and "tuned: alpha" in tuned.stdout, tuned.stderr
    assert "not tuned, since tuning.ranges does not name them: mpc" in tuned.stdout
    searched = run("gains", "mine2026", "--json", "gains.json", "--workers", 1, folder=folder)
    assert searched.returncode == 0, searched.stderr
    effects = json.loads((folder / "gains.json").read_text())["effects"]
    assert len(effects) == 2 and all(
        one["failed"] is None and one["root_of_V_left"] < one["root_of_V_left_proved"] < 0.01 for one in effects)
    report = run("report", "mine2026", "--out", "page", "--workers", 1, folder=folder)
    assert report.returncode == 0, report.stderr
    page = (folder / "page" / "report.html").read_text()
    assert "adaptive (tuned)" in page and "conditions at the stated gains" not in page  # it states none
    assert "m/s²" in page and page.index('id="figure-1"') < page.index('id="tables"')
    curves = sorted(path.name for path in (folder / "page" / "curves").glob("*.csv"))
    assert curves == ["01-x.csv", "02-v.csv", "03-u.csv"]
    # The folder can be sent as it is: what its page names lies beside it, and re-checks itself.
    named = re.findall(r'href="(certificates/[^"]+)"', page)
    assert named and all((folder / "page" / name).is_file() for name in named)
    checked = subprocess.run([sys.executable, "-S", "checker.py", "certificates"], cwd=folder / "page",
                             capture_output=True, check=False)
    assert checked.returncode == 0, checked.stderr


def written(folder, *asked, **more):
    """The bytes of sweep.csv, which is read block by block."""
    found = sweep(*asked, **more)
    found.write_csv(folder / "sweep.csv")
    return (folder / "sweep.csv").read_bytes()


def test_a_sweep_goes_on_where_it_stopped_to_the_same_bytes(mine, tmp_path, monkeypatch, capsys):
    """A stop after some parts, two processes, more runs, a chunk with a NaN: the bytes of a run in one go."""
    monkeypatch.setattr(row_store, "CHUNK_S", 0.0)
    monkeypatch.setattr(row_store, "BLOCK", 1)
    monkeypatch.setattr(parts, "TASK_S", 0.0)
    study, out = load(mine).study, tmp_path / "mc"
    whole = written(tmp_path, study, 4, 1, ["adaptive"], workers=1)

    def stop(done, *_):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(study, 3, 1, ["adaptive"], out, 1, stop)
    assert not (out / "sweep.csv").exists() and len(list((out / "sweep").glob("*.parquet"))) == 2
    made = []
    again = {"study": study, "runs": 4, "seed": 1, "controllers": ["adaptive"], "out": out, "resume": True}
    assert written(out, **again, workers=2, on_progress=lambda done, *_: made.append(done)) == whole
    assert made == [3, 4]
    path = min((out / "sweep").glob("*.parquet"))
    table = pyarrow.parquet.read_table(path)
    assert {"drawn_a", "x_error_rms", "failed"} < set(table.column_names)
    spoiled = table.set_column(table.column_names.index("x_error_rms"), "x_error_rms", pyarrow.array([float("nan")]))
    pyarrow.parquet.write_table(spoiled, path)
    with rows_held(monkeypatch) as held:
        assert written(out, **again, workers=1) == whole and "is not what was written" in capsys.readouterr().err
    assert len(held) == 4 and max(held) <= 2  # the block that is written, and the one that is read
    for other in ({"seed": 2}, {"study": study.model_copy(update={"duration_s": study.duration_s + 1})}):
        with pytest.raises(InputError, match="belongs to another job"):
            sweep(**again | {"workers": 1} | other)


@contextmanager
def rows_held(monkeypatch):
    """How many blocks of rows are in memory, at each time that one is read from where they are kept."""
    class Block(list):
        """A list that tells when it is gone."""

    made, held, read = [], [], row_store.RowStore.rows

    def rows(self, *asked):
        block = Block(read(self, *asked))
        made.append(ref(block))
        held.append(sum(one() is not None for one in made))
        return block

    with monkeypatch.context() as patch:
        patch.setattr(row_store.RowStore, "rows", rows)
        yield held


def test_a_sweep_is_the_same_for_the_same_seed_and_draws_what_is_known(mine):
    study = load(mine).study
    one, same, other = (sweep(study, 2, seed, ["adaptive"], workers=1) for seed in (1, 1, 2))
    assert list(one.csv()) == list(same.csv()) != list(other.csv())
    assert all(0.2 <= row["drawn_a"] <= 0.8 for row in one.rows())


def test_a_sweep_takes_what_is_later_than_a_period(mine, tmp_path):
    """What compiles the loops once ran a single period, in which nothing late arrives, and ended with a traceback."""
    late = shutil.copytree(mine, tmp_path / "late")
    study = late / "study.toml"
    study.write_text("sensing = { late_s = { x = 0.1 } }\nactuators = { delay_s = { u = 0.075 } }\n"
                     + study.read_text(encoding="utf-8"), encoding="utf-8")
    found = sweep(load(late).study, runs=1, workers=1)
    assert [row["failed"] for row in found.rows()] == [None] * len(found.names)


def test_a_sweeps_table_tells_what_is_farthest_from_zero_and_the_least_of_the_smallest(mine, tmp_path, monkeypatch):
    monkeypatch.setattr(row_store, "BLOCK", 2)
    study = load(mine).study
    study.__dict__["setting"] = study.setting.varied(metrics=(Metric("room", "smallest", study.the_plant.states[0]),))
    rest = dict.fromkeys(("x_error_rms", "x_error_largest", "u_rms", "u_variation", "u_saturated"), 1.0)
    rows = [{"room": room, "x_error_final": error, "failed": failed, **rest} for room, error, failed in (
        (0.5, 0.1, None), (None, None, "diverges"), (0.2, -0.3, None))]
    store = row_store.RowStore()
    store.add(row_store.Part("adaptive", 0, 3), [
        tuple({"run": run, "controller": "adaptive", "drawn_a": 0.5, **row}[name] for name in row_columns(study))
        for run, row in enumerate(rows)])
    table = PlantSweep(study, ("adaptive",), 3, store).write_csv(tmp_path / "sweep.csv")
    told = dict(zip((one.split(" (")[0] for one in table.headings), table.rows[0], strict=True))
    assert told["room, least"] == 0.2 and told["x error final, largest"] == -0.3
    assert told["failed runs"] == 1.0 and told["room, mean"] == pytest.approx(0.35)
    shown = io.StringIO()
    Console(file=shown, width=60).print(result_table(table))
    lines = shown.getvalue().splitlines()
    assert ["room,", "least", "0.200"] in [line.split() for line in lines] and len(lines) < 25


def test_the_folder_is_checked_and_a_wrong_derivative_is_found(mine, tmp_path):
    assert wb.check_paper(mine).holds, wb.check_paper(mine)
    wrong = write_new_paper("wrong2026", tmp_path, "plant")
    laws = wrong / "laws.py"
    # V of a law whose adaptation has the other sign than the one that runs.
    text = laws.read_text().replace('lyapunov = Lyapunov("V", V, adaptive)', (
        'from dataclasses import replace\n'
        'lyapunov = Lyapunov("V", V, replace(adaptive, states=(LawState(a_hat, rate=gamma * s * v),)))'))
    laws.write_text(text)
    (wrong / "study.toml").write_text((mine / "study.toml").read_text())
    found = wb.check_paper(wrong)
    wrong_ones = [check.what for check in found.checks if not check.holds]
    # As stated, and as tuned where another test has tuned it.
    assert {name.replace(" (tuned)", "") for name in wrong_ones} == {"V changes along the run of adaptive as derived"}


@pytest.mark.parametrize(("old", "new", "words"), [
    ('law = "adaptive"', 'law = "adaptve"', "controllers: law 'adaptve' is not known"),
    ('law = "adaptive"', 'law = "own.py::adaptive"', "controllers: 'own.py::adaptive' names "),
    ("alpha = 2.0", "alpa = 2.0", "no parameter of law"), ("k = 4.0", "k = -4.0", "declared positive"),
    ("period_s = 0.005", "period_s = 0.0", "controllers.adaptive.period_s: input should be greater than 0"),
    ("k = 4.0", 'k = "4 1/s"', "controllers.adaptive.parameters.k: input should be a valid number"),
    ("k = [1.0, 20.0]", "k = [-3.0, 20.0]",
     r"tuning.ranges.adaptive.k\[0\]: input should be greater than 0, not -3.0: correct it$"),
    ("duration_s = ", "log_every_s = 0.0007\nduration_s = ", "log_every_s = 0.0007 s is no whole number"),
    ('initial = { x = 0.3 }', 'initial = { y = 0.3 }', "initial.y"), ("horizon = 8", "horizon = 0", "horizon"),
    ("reference.x_d = {", "reference.y_d = {", "tracks.x = 'x_d' is no reference: state reference.x_d$"),
    ("disturbance.d = {", "disturbance.w = {", "study.toml: disturbance.w: plant"),
    ("duration_s = ", "actuators = { lag_s = { v = 1.0 } }\nduration_s = ", "study.toml: actuators.lag_s.v: plant"),
    ("plant_step_s = ", "plant_step_s = 1e-9 #", "duration_s / plant_step_s is more than"),
    ('kind = "sine"', 'kind = "sinus"', "reference.x_d"), ("period_s = 0.05\n", "period_s = 0.0505\n", "whole number"),
    ('factors = ["a"]', 'factors = ["c"]', "uncertainty"), ("weights = { x", "weights = { v", "weights.v")])
def test_a_mistake_in_the_file_is_one_line_that_names_it(mine, tmp_path, old, new, words):
    folder = write_new_paper("mine2026", tmp_path, "plant")
    text = (mine / "study.toml").read_text()
    assert old in text
    (folder / "study.toml").write_text(text.replace(old, new))
    with pytest.raises(InputError, match=words) as caught:
        sweep(load(folder).study, 1, workers=1)
    assert str(caught.value).startswith(str(folder / "study.toml"))


def test_what_has_no_code_is_told_with_its_file_and_as_it_was_stated(mine, tmp_path):
    folder = write_new_paper("mine2026", tmp_path, "plant")
    (folder / "study.toml").write_text((mine / "study.toml").read_text())
    laws = folder / "laws.py"
    laws.write_text(laws.read_text().replace("a_hat * v + c * x**3}", "a_hat * v + sp.Derivative(x**2, x)}"))
    told = one_line(run("compare", folder, "--workers", 1))
    assert told.startswith(f"workbench: {folder / 'study.toml'}: controllers.adaptive: plant 'mine2026.mass' under law")
    assert "Derivative(x**2, x)" in told and "carry them out" in told


@pytest.mark.parametrize("option", [("--rare", "x_error_rms>1"), ("--until-width", "x_error_rms=0.1")])
def test_what_a_plants_sweep_does_not_have_is_told_as_such(mine, tmp_path, option):
    """It was told that its own metric is none, and given those of trains."""
    told = one_line(run("sweep", mine, "--out", tmp_path / "out", *option))
    assert f"is a plant's study, which is drawn by chance and as often as asked: leave {option[0]} out" in told


SCRIPT = """
import sys
from contextlib import contextmanager
import workbench as wb
assert not {"sympy", "numpy", "casadi"} & set(sys.modules), "import workbench brings them all"
import sympy as sp
x, v, u = sp.symbols("x v u", real=True)
k, d = sp.symbols("k d", positive=True)
mass = wb.Plant("mass", (x, v), (v, u), inputs=(u,))
r = wb.Reference("r")
law = wb.Law("pd", {u: -k * (x - r.value) - d * v}, parameters=(k, d), references=(r,))
run = wb.simulate(mass, law, period_s=0.01, duration_s=8, law_parameters={k: 4.0, d: 4.0},
                  references={"r": wb.Step(after=1.0, at_s=1.0)}, tracks={"x": "r"})
# (1 + 2 t) exp(-2 t) is left of a step, 7 s later.
assert abs(run.metrics["x_error_final"]) < 1e-4 and run.failed is None
assert run.to_pandas().index.name == "t_s" and len(run.plot().axes) == 3
again = wb.simulate(mass, law, period_s=0.01, duration_s=1, law_parameters={k: 4.0, d: 4.0},
                    references={"r": wb.Constant(value=1.0)})
assert again.failed is None and callable(wb.gains)
import workbench.gains.feedback as feedback
import workbench.simulate.compare
assert wb.gains.feedback is feedback and callable(workbench.simulate.compare.compare)
assert wb.gains.__module__ == wb.simulate.__module__ == "workbench.api.functions"
run.to_mat(sys.argv[2])
from scipy.io import loadmat
kept = loadmat(sys.argv[2])
assert all((kept[name][:, 0] == run[name]).all() for name in run.columns) and kept["t_s"].shape[1] == 1
both = wb.compare(run.setting, [wb.entrant(law, 0.01, {k: 4, d: 4}),
                                wb.entrant(wb.PlantMpc(20, {"x": 1.0}, {"u": 0.01}), 0.1)])
assert [row["controller"] for row in both.rows] == ["pd", "mpc"] and both["mpc"].found.fallbacks == 0
assert set(wb.prove(sys.argv[1]).verdicts.values()) == {"proved", "refuted"}
assert [one.name for one in wb.compare(sys.argv[1])][:2] == ["adaptive", "mpc"]
print("done")
"""


def test_a_plain_script_without_a_guard_works(mine, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    found = subprocess.run([sys.executable, str(script), str(mine), str(tmp_path / "run.mat")], capture_output=True,
                           text=True, check=False, timeout=300)
    assert found.returncode == 0, found.stderr
    assert found.stdout.endswith("done\n")


def test_names_of_the_api_are_there_and_others_are_not():
    assert all(getattr(wb, name) is not None for name in wb.__all__)
    assert set(wb.__all__) <= set(dir(wb))
    with pytest.raises(AttributeError, match="no attribute 'train'"):
        _ = wb.train


def test_without_pandas_it_is_said_what_to_install(monkeypatch):
    from workbench.api.frames import data_frame

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(WorkbenchError, match="pip install pandas"):
        data_frame([{"a": 1}])


def test_columns_that_matlab_cannot_tell_apart_are_refused(tmp_path):
    from workbench.api.frames import write_mat

    with pytest.raises(WorkbenchError, match="one name in MATLAB"):
        write_mat({"a.b": [1.0], "a_b": [2.0]}, tmp_path / "x.mat")
    assert not list(tmp_path.iterdir())


def test_a_folder_with_nothing_to_check_does_not_hold(tmp_path):
    with pytest.raises(InputError, match="has nothing to check"):
        wb.check_paper(tmp_path / "nowhere")
