"""Rows of a Monte Carlo: paired draws, the same bytes for any number of processes, sums over what did not fail."""

import csv
import math

import pytest
from short_sweep import RUNS, SEED, sweep_of

from workbench.errors import InputError
from workbench.simulate.draws import draw_factors
from workbench.simulate.sweep import summarise
from workbench.trains.scenario import load_scenario


def test_rows_are_ordered_and_paired(whole, scenario_path):
    _, rows = whole
    scenario = load_scenario(scenario_path)
    names = list(scenario.controllers)
    assert [(row.run, row.controller) for row in rows] == [(k, name) for k in range(RUNS) for name in names]
    for row in rows:
        assert row.factors == draw_factors(scenario, row.run, SEED)
    assert len({row.factors for row in rows}) == RUNS


def test_runs_are_counted_as_they_finish_and_leave_the_same_bytes(whole, scenario_path, tmp_path):
    """What processes and a cluster leave is told by tests/tasks/test_cluster.py."""
    out, _ = whole
    seen = []
    sweep_of(scenario_path, RUNS, SEED, out=tmp_path, workers=1, on_progress=lambda *step: seen.append(step))
    assert (tmp_path / "sweep.csv").read_bytes() == (out / "sweep.csv").read_bytes()
    assert seen == sorted(seen) and seen[-1] == (9, 9)


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
