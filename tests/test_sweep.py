"""Monte Carlo: paired draws, the same bytes however it was run, and nothing lost."""

import csv
import hashlib
import json
import math
import operator
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import numpy as np
import pandas
import pytest
import scipy.stats
from scenarios import LIGHT_TRAIN, ROOT
from worker_tasks import end_the_process

from workbench.errors import InputError
from workbench.simulate import row_store, stopping
from workbench.simulate import sweep as sweep_module
from workbench.simulate.closed_loop import Factors
from workbench.simulate.draws import draw_factors, factors_of
from workbench.simulate.row_store import MANIFEST_NAME
from workbench.simulate.stopping import UntilWidth
from workbench.simulate.sweep import MonteCarlo, Options, monte_carlo, summarise, sweep
from workbench.simulate.sweep_rows import SweepRow
from workbench.tasks.handing_out import run_tasks
from workbench.trains.scenario import load_scenario

RUNS, SEED = 3, 7


def write_scenario(folder: Path, extra: str = "") -> Path:
    """A scenario that runs in milliseconds; `narrow` has a barrier so tight that it fails at once."""
    (folder / "line.toml").write_text("""
name = "short"
length_m = 2000.0
grade = [{ start_m = 0.0, end_m = 800.0, grade_permille = 2.0 },
         { start_m = 800.0, end_m = 2000.0, grade_permille = -1.0 }]
curve = [{ start_m = 0.0, end_m = 2000.0, radius_m = inf }]
[source]
name = "convention: a name"
length_m = "assumed: short"
grade = "assumed: gentle"
curve = "assumed: straight"
""")
    adaptive = """
law = "yang2021.pocrac"
period_s = 0.01
parameters = {{ alpha = 0.5, beta = 0.51, k = {k}, lambda_1 = 0.01, lambda_2 = 0.01, lambda_3 = 0.01, \
sigma_1 = 0.005, sigma_2 = 0.005, sigma_3 = 0.005 }}
initial = {{ a_hat = 0.25, b_hat = 0.0, c_hat = 0.0 }}
[controllers.{name}.source]
law = "paper, (33)"
period_s = "assumed: coarse"
parameters = "paper, section 6"
initial = "paper, section 6"
"""
    path = folder / "tiny.toml"
    path.write_text(f"""
version = 1
name = "tiny"
title = "A <tiny> scenario"
paper = "yang2021"
citation = "Nobody & Sons"
{LIGHT_TRAIN}max_braking_n = 240000.0
[train.source]
mass_kg = "assumed: <b>heavy</b>"
davis_a_mps2 = "paper, section 6"
davis_b_per_s = "paper, section 6"
davis_c_per_m = "paper, section 6"
max_traction_n = "assumed: plenty"
max_braking_n = "assumed: plenty"
[reference]
kind = "cruise_speed"
cruise_mps = 20.0
acceleration_mps2 = 0.5
braking_mps2 = 0.5
ramp_s = 4.0
[reference.source]
kind = "assumed: simple"
cruise_mps = "assumed: brisk"
acceleration_mps2 = "assumed: gentle"
braking_mps2 = "assumed: gentle"
ramp_s = "assumed: smooth"
[simulation]
plant_step_s = 0.01
dwell_s = 2.0
position_band_m = 0.2
log_every_s = 0.1
[simulation.source]
plant_step_s = "assumed: coarse"
dwell_s = "assumed: short"
position_band_m = "paper, section 4"
log_every_s = "convention: ten a second"
[disturbance]
amplitude_mps2 = 0.0
period_s = 60.0
[disturbance.source]
amplitude_mps2 = "assumed: none"
period_s = "assumed: any"
[controllers.pocrac]
{adaptive.format(name="pocrac", k=0.21)}
[controllers.narrow]
{adaptive.format(name="narrow", k=0.0001)}
[controllers.pid]
law = "pid"
period_s = 0.01
parameters = {{ K_p = 0.75, K_i = 0.125, K_d = 1.5 }}
initial = {{ eta_e = 0.0 }}
[controllers.pid.source]
law = "paper, section 6.2"
period_s = "assumed: coarse"
parameters = "assumed: poles at -0.5"
initial = "assumed: empty"
[uncertainty]
runs = 3
seed = 7
spread = 0.1
factors = ["mass", "davis_a"]
[uncertainty.source]
runs = "assumed: few"
seed = "assumed: any"
spread = "paper, section 6.2"
factors = "assumed: two"
[printed_table]
source = "paper, Table 2"
[[printed_table.rows]]
controller = "pocrac"
position_error_m = [-0.1, 0.2]
speed_error_mps = [-0.2, 0.3]
stopping_accuracy_m = 0.05
[[printed_table.rows]]
controller = "pid"
position_error_m = [-1.0, 1.5]
speed_error_mps = [-1.0, 0.9]
stopping_accuracy_m = 0.4
{extra}
""")
    return path


def sweep_of(path: Path, *arguments: object, **options: object) -> list[SweepRow]:
    """The sweep of a scenario's file."""
    return sweep(load_scenario(path), path, *arguments, **options)


@pytest.fixture(scope="module")
def scenario_path(tmp_path_factory):
    return write_scenario(tmp_path_factory.mktemp("tiny"))


@pytest.fixture(scope="module")
def whole(scenario_path, tmp_path_factory):
    """The folder and rows of an uninterrupted run in one process."""
    out = tmp_path_factory.mktemp("whole")
    return out, sweep_of(scenario_path, RUNS, SEED, out=out, workers=1)


def test_rows_are_ordered_and_paired(whole, scenario_path):
    _, rows = whole
    scenario = load_scenario(scenario_path)
    names = list(scenario.controllers)
    assert [(row.run, row.controller) for row in rows] == [(k, name) for k in range(RUNS) for name in names]
    for row in rows:
        assert row.factors == draw_factors(scenario, row.run, SEED)
    assert len({row.factors for row in rows}) == RUNS


def test_factors_are_drawn_for_named_ones_only_within_the_spread(scenario_path):
    scenario = load_scenario(scenario_path)
    drawn = [draw_factors(scenario, run) for run in range(200)]
    assert all(abs(f.mass - 1) <= 0.1 and abs(f.davis_a - 1) <= 0.1 for f in drawn)
    assert min(f.mass for f in drawn) < 0.91 and max(f.mass for f in drawn) > 1.09
    assert all(f.davis_b == f.davis_c == f.line_resistance == 1.0 for f in drawn)
    everything = scenario.uncertainty.model_copy(update={"factors": tuple(f.name for f in fields(Factors))})
    more = draw_factors(scenario.model_copy(update={"uncertainty": everything}), 5)
    assert (more.mass, more.davis_a) == (drawn[5].mass, drawn[5].davis_a)
    assert draw_factors(scenario, 5, seed=8) != drawn[5]


def chunks_written(folder: Path) -> list[dict]:
    return [json.loads(line) for line in (folder / MANIFEST_NAME).read_text().splitlines()[1:]]


def rows_kept(folder: Path) -> int:
    """How many rows the manifest names."""
    return sum(count for chunk in chunks_written(folder) for _, _, count in chunk["parts"])


@pytest.fixture
def every_run_is_a_chunk(monkeypatch):
    monkeypatch.setattr(row_store, "CHUNK_S", 0.0)
    monkeypatch.setattr(sweep_module, "TASK_S", 0.0)


def test_two_workers_write_the_same_bytes(whole, scenario_path, tmp_path):
    out, _ = whole
    seen = []
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, workers=2, on_progress=lambda *step: seen.append(step))
    assert (tmp_path / "sweep.csv").read_bytes() == (out / "sweep.csv").read_bytes()
    assert seen == sorted(seen) and seen[-1] == (9, 9)


def test_chunks_are_parquet_that_others_read_in_a_line(whole):
    out, rows = whole
    table = pandas.read_parquet(out / "sweep").sort_values(["run", "controller"])
    assert len(table) == len(rows) and set(table["controller"]) == {"pocrac", "narrow", "pid"}
    stops = {(row.run, row.controller): row.stopping_error for row in rows}
    for row in table.itertuples():
        assert stops[row.run, row.controller] in (row.stopping_error, None)
    record = chunks_written(out)[0]
    assert record["sha256"] == hashlib.sha256((out / "sweep" / "00000.parquet").read_bytes()).hexdigest()


def test_an_interruption_at_any_run_loses_none_of_the_others(whole, scenario_path, tmp_path, every_run_is_a_chunk):
    for stop_at in (1, 4, 8):
        def stop(done, total, stop_at=stop_at):
            if done == stop_at:
                raise KeyboardInterrupt

        out = tmp_path / str(stop_at)
        with pytest.raises(KeyboardInterrupt):
            sweep_of(scenario_path, RUNS, SEED, out=out, workers=1, on_progress=stop)
        assert not (out / "sweep.csv").exists()
        assert rows_kept(out) == stop_at
        fresh = []
        sweep_of(scenario_path, RUNS, SEED, out=out, resume=True, workers=1,
                 on_progress=lambda *one, fresh=fresh: fresh.append(one))
        assert len(fresh) == 9 - stop_at
        assert (out / "sweep.csv").read_bytes() == (whole[0] / "sweep.csv").read_bytes()


DAMAGE = {
    "a changed digit in a chunk": lambda out: changed(out / "sweep" / "00002.parquet", 90),
    "half a chunk": lambda out: cut(out / "sweep" / "00001.parquet"),
    "an empty chunk": lambda out: (out / "sweep" / "00000.parquet").write_bytes(b""),
    "a chunk that is gone": lambda out: (out / "sweep" / "00003.parquet").unlink(),
    "one chunk in the place of another": lambda out: (out / "sweep" / "00001.parquet").write_bytes(
        (out / "sweep" / "00002.parquet").read_bytes()),
    "a changed digit in the manifest": lambda out: changed(out / MANIFEST_NAME, -40),
    "a record twice": lambda out: (out / MANIFEST_NAME).write_text(
        (out / MANIFEST_NAME).read_text() + (out / MANIFEST_NAME).read_text().splitlines(keepends=True)[-1]),
    "half a record": lambda out: cut(out / MANIFEST_NAME),
    "a record of something else": lambda out: (out / MANIFEST_NAME).write_text(
        (out / MANIFEST_NAME).read_text() + '{"run": NaN}\n[1]\nnot json\n'),
}


def changed(path: Path, place: int) -> None:
    data = bytearray(path.read_bytes())
    data[place] ^= 1
    path.write_bytes(data)


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


@pytest.mark.parametrize("damage", DAMAGE)
def test_what_was_damaged_is_found_by_its_digest_and_made_again(whole, scenario_path, tmp_path, every_run_is_a_chunk,
                                                                capsys, damage):
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, workers=1)
    (tmp_path / "sweep.csv").unlink()
    assert len(chunks_written(tmp_path)) == 9
    DAMAGE[damage](tmp_path)
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, resume=True, workers=1)
    assert (tmp_path / "sweep.csv").read_bytes() == (whole[0] / "sweep.csv").read_bytes()
    assert len(pandas.read_parquet(tmp_path / "sweep")) == 9, "what readers of the folder see has no row twice"
    assert damage == "half a record" or "note:" in capsys.readouterr().err


def test_a_finished_sweep_serves_fewer_and_more_runs(whole, scenario_path, tmp_path):
    _, rows = whole
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, workers=1)
    assert sweep_of(scenario_path, 2, SEED, ["pid"], tmp_path, resume=True) == [
        row for row in rows if row.controller == "pid" and row.run < 2]
    more = sweep_of(scenario_path, RUNS + 1, SEED, ["pid"], tmp_path, resume=True, workers=1)
    assert [row.run for row in more] == [0, 1, 2, 3]


def test_a_sweep_of_something_else_is_refused_with_a_remedy(whole, scenario_path, tmp_path):
    manifest = tmp_path / MANIFEST_NAME
    manifest.write_bytes((whole[0] / MANIFEST_NAME).read_bytes())
    with pytest.raises(InputError, match=r"seed 7, not 8.*without resume"):
        sweep_of(scenario_path, RUNS, SEED + 1, out=tmp_path, resume=True)
    folder = tmp_path / "other"
    folder.mkdir()
    other = write_scenario(folder)
    line = folder / "line.toml"
    line.write_text(line.read_text().replace("grade_permille = 2.0", "grade_permille = 3.0"))
    with pytest.raises(InputError, match=r"values, line and code.*without resume"):
        sweep_of(other, RUNS, SEED, out=tmp_path, resume=True)
    for text in ("not json\n", '{"a": 1}\n', "[1]\n"):
        manifest.write_text(text)
        with pytest.raises(InputError, match="without resume"):
            sweep_of(scenario_path, RUNS, SEED, out=tmp_path, resume=True)


def test_starting_anew_keeps_the_old_sweep_beside(whole, scenario_path, tmp_path):
    sweep_of(scenario_path, 1, SEED, ["pid"], tmp_path, workers=1)
    before = {path: path.read_bytes() for path in (tmp_path / MANIFEST_NAME, tmp_path / "sweep" / "00000.parquet")}
    sweep_of(scenario_path, 2, SEED, ["pid"], tmp_path, workers=1)
    for path, data in before.items():
        assert path.with_name(path.name + ".before").read_bytes() == data != path.read_bytes()


def test_a_second_writer_is_turned_away_in_a_line(scenario_path, tmp_path):
    script = ("import sys; from pathlib import Path; from workbench.files.folder_lock import FolderLock\n"
              "FolderLock(Path(sys.argv[1])); print('held', flush=True); sys.stdin.read()")
    with subprocess.Popen([sys.executable, "-c", script, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          cwd=ROOT) as other:
        assert other.stdout.readline() == b"held\n"
        for resume in (True, False):
            with pytest.raises(InputError, match="another command writes its results here"):
                sweep_of(scenario_path, 1, SEED, ["pid"], tmp_path, resume=resume)
        other.kill()
    sweep_of(scenario_path, 1, SEED, ["pid"], tmp_path, workers=1)


def test_draws_end_once_the_intervals_are_narrow_wherever_they_are_run(scenario_path, monkeypatch):
    monkeypatch.setattr(stopping, "FIRST_LOOK", 4)
    scenario = load_scenario(scenario_path)

    def found(width: float, workers: int) -> MonteCarlo:
        return monte_carlo(scenario, scenario_path, Options(64, SEED, ["pid"], workers=workers,
                                                            until=UntilWidth("position_error_max", width)))

    one, two = found(0.03, 1), found(0.03, 2)
    assert 4 < one.runs == two.runs < 64
    assert list(one.rows()) == list(two.rows())
    values = [row.position_error_max for row in one.rows()]
    interval = scipy.stats.t.interval(0.95, len(values) - 1, np.mean(values), scipy.stats.sem(values))
    assert math.isclose(interval[1] - interval[0], one.means["pid"].width)
    assert one.means["pid"].width <= 0.03
    assert found(1e-9, 1).runs == 64


def test_sobol_draws_are_the_same_in_parts_and_fill_the_range_evenly(scenario_path):
    scenario = load_scenario(scenario_path)
    every = list(factors_of(scenario, 0, 64, SEED, "sobol"))
    assert every == [*factors_of(scenario, 0, 5, SEED, "sobol"), *factors_of(scenario, 5, 59, SEED, "sobol")]
    places = sorted((f.mass - 0.9) / 0.2 for f in every)
    assert all(i / 64 <= place < (i + 1) / 64 for i, place in enumerate(places)), "one in each 64th of the range"
    assert all(f.davis_b == 1.0 for f in every)


@pytest.mark.parametrize(("options", "key"), [
    ({"runs": 0}, "runs"), ({"seed": -1}, "seed"), ({"workers": 0}, "workers"), ({"resume": True}, "resume"),
    ({"controllers": ["pid", "mcp"]}, "mcp"), ({"controllers": []}, "controllers"),
])
def test_unusable_options_are_named(scenario_path, options, key):
    with pytest.raises(InputError, match=key):
        sweep_of(scenario_path, **({"runs": 1, "seed": 1} | options))


def test_failed_runs_are_rows_without_meaningless_numbers(whole):
    out, rows = whole
    failed = [row for row in rows if row.controller == "narrow"]
    assert all("left its domain" in row.failed for row in failed)
    assert all(row.stopping_error is None and row.energy_J is None for row in failed)
    text = (out / "sweep.csv").read_text()
    assert "nan" not in text.lower().replace("narrow", "") and "inf" not in text
    table = list(csv.DictReader(text.splitlines()))
    assert [row["stopping_error"] == "" for row in table] == [row["controller"] == "narrow" for row in table]
    assert not any("step_us" in column or "deadline" in column for column in table[0])
    for row, cells in zip(rows, table, strict=True):
        assert float(cells["factor_mass"]) == row.factors.mass
        if row.stopping_error is not None:
            assert float(cells["stopping_error"]) == row.stopping_error


def test_summary_counts_failures_and_takes_extrema_over_the_rest(whole, scenario_path):
    _, rows = whole
    summaries = {s.controller: s for s in summarise(rows, load_scenario(scenario_path))}
    assert list(summaries) == ["pocrac", "narrow", "pid"]
    assert (summaries["narrow"].failed, summaries["narrow"].runs) == (RUNS, RUNS)
    assert summaries["narrow"].position_error_max is None
    own = [row for row in rows if row.controller == "pid"]
    assert summaries["pid"].position_error_min == min(row.position_error_min for row in own)
    assert summaries["pid"].speed_error_max == max(row.speed_error_max for row in own)
    mean = sum(abs(row.stopping_error) for row in own) / RUNS
    assert math.isclose(summaries["pid"].mean_abs_stopping_error, mean)


def test_what_workers_have_started_is_recorded_before_an_interruption_goes_on():
    recorded = []

    def record(value):
        recorded.append(value)
        if len(recorded) == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_tasks(operator.add, 100, range(50), 2, record)
    assert 1 < len(recorded) < 10
    assert set(recorded) <= set(range(100, 150))


def test_an_exception_in_a_worker_is_raised_here():
    with pytest.raises(ZeroDivisionError):
        run_tasks(operator.truediv, 1.0, [1, 2, 0, 3], 2, print)


def test_tasks_of_a_process_that_dies_are_run_again(tmp_path, capsys):
    recorded = []
    run_tasks(end_the_process, str(tmp_path), range(8), 2, recorded.append)
    assert sorted(recorded) == list(range(8))
    assert "a worker process died" in capsys.readouterr().err
