"""References read from a table: the curve between its rows, what is refused, and scenarios that use one."""

import shutil
import tomllib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scenarios import PROOFS, YANG

from workbench.errors import InputError, WorkbenchError
from workbench.model.curve_table import COLUMNS, Row, curve_through, read_rows
from workbench.model.desired_curve import start_cruise_stop
from workbench.simulate.closed_loop import simulate
from workbench.trains.scenario import load_scenario

CURVE = start_cruise_stop(2000.0, 20.0, 0.5, 0.6, 4.0)


def rows_of(curve, times) -> tuple[Row, ...]:
    return tuple(Row(t, *x) for t, *x in zip(times.tolist(), *(y.tolist() for y in curve.at(times)), strict=True))


def written(path: Path, rows, header=COLUMNS) -> Path:
    lines = [",".join(header), *(",".join(str(x) for x in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def test_a_curve_of_degree_five_is_found_again_exactly():
    times = np.unique(np.concatenate((CURVE.breaks_s, np.linspace(0, CURVE.trip_time_s, 7))))
    found, fine = curve_through(rows_of(CURVE, times)), np.linspace(-1, CURVE.trip_time_s + 5, 5001)
    for got, wanted in zip(found.at(np.maximum(fine, 0)), CURVE.at(np.maximum(fine, 0)), strict=True):
        assert got == pytest.approx(wanted, abs=1e-9)
    assert found.length_m == pytest.approx(2000.0) and found.trip_time_s == pytest.approx(CURVE.trip_time_s)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_curve_meets_every_row_and_is_twice_differentiable(seed):
    inner = np.sort(np.random.default_rng(seed).uniform(0, CURVE.trip_time_s, 150))
    times = np.unique(np.concatenate(([0.0], inner[np.diff(inner, prepend=-1) > 0.01], [CURVE.trip_time_s])))
    rows = rows_of(CURVE, times)
    found = curve_through(rows)  # DesiredCurve itself refuses jumps of position, speed and acceleration
    for got, wanted in zip(found.at(times), np.array(rows).T[1:], strict=True):
        assert got == pytest.approx(wanted, abs=1e-7)


def test_the_error_between_rows_falls_with_the_fourth_power_of_their_distance_or_faster():
    smooth = start_cruise_stop(2000.0, 20.0, 0.5, 0.6, 12.0)
    fine = np.linspace(0, smooth.trip_time_s, 20_001)
    off = [np.abs(curve_through(rows_of(smooth, np.linspace(0, smooth.trip_time_s, n + 1))).at(fine)[0]
                  - smooth.at(fine)[0]).max() for n in (50, 100, 200)]
    assert off[0] / off[1] > 8 and off[1] / off[2] > 8


def test_positions_and_times_count_from_the_first_row():
    rows = rows_of(CURVE, np.linspace(0, CURVE.trip_time_s, 300))
    moved = tuple(Row(r.t_s + 7.0, r.s_m + 1500.0, r.v_mps, r.a_mps2) for r in rows)
    assert curve_through(moved).at(np.array([30.0]))[0] == pytest.approx(curve_through(rows).at(np.array([30.0]))[0])


GOOD = rows_of(CURVE, np.linspace(0, CURVE.trip_time_s, 200))


@pytest.mark.parametrize(("change", "says"), [
    (lambda r: r[:1], "fewer than two rows"), (lambda r: r[::-1], "sort"), (lambda r: (*r[:5], r[4], *r[5:]), "sort"),
    (lambda r: r[40:], "starts at"), (lambda r: r[:150], "ends at"),
    (lambda r: tuple(x._replace(v_mps=3.6 * x.v_mps) for x in r), "units"),
    (lambda r: tuple(x._replace(v_mps=36 * x.v_mps) for x in r), "km/h"),
    (lambda r: tuple(x._replace(s_m=x.s_m / 1000) for x in r), "units"),
    (lambda r: r[::100] + r[-1:], "rows"),
])
def test_rows_that_are_no_run_are_refused(change, says):
    with pytest.raises(WorkbenchError, match=says):
        curve_through(change(GOOD))


@pytest.mark.parametrize(("text", "says"), [
    ("", "t_s"), ("t_s,s_m,v_mps\n0,0,0\n", "a_mps2"), ("t_s,s_m,v_mps,a_mps2\n0,0,x,0\n", "row 1 has 'x'"),
    ("t_s,s_m,v_mps,a_mps2\n0,0,0\n", "row 1"), ("t_s,s_m,v_mps,a_mps2\n0,0,nan,0\n", "no finite number"),
    ("t_s,s_m,v_mps,a_mps2\n", "fewer than two"),
])
def test_a_file_that_is_no_table_is_refused_in_one_line(tmp_path, text, says):
    path = tmp_path / "curve.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=says) as trouble:
        read_rows(path)
    assert str(path) in str(trouble.value) and "\n" not in str(trouble.value)


def test_a_missing_folder_or_binary_file_is_said(tmp_path):
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00\x80" * 50)
    for path in (tmp_path / "no.csv", tmp_path, tmp_path / "binary.csv"):
        with pytest.raises(InputError):
            read_rows(path)


def with_table(tmp_path: Path, name: str, rows) -> Path:
    """yang2021's scenario with a table as its reference, beside its line."""
    text = YANG.read_text(encoding="utf-8")
    start, end = text.index("[reference]"), text.index("[simulation]")
    table = f'[reference]\nkind = "table"\nfile = "{name}"\n\n[reference.source]\nkind = "convention: x"\n'
    path = tmp_path / "scenario.toml"
    path.write_text(text[:start] + table + 'file = "assumed: x"\n\n' + text[end:].partition("[[variants]]")[0],
                    encoding="utf-8")
    shutil.copy(YANG.parent / "line.toml", tmp_path / "line.toml")
    written(tmp_path / "curve.csv", rows)
    return path


def test_a_scenario_reads_the_same_curve_from_a_table_as_from_its_rule(tmp_path):
    own = load_scenario(YANG)
    curve = own.desired_curve()
    times = np.unique(np.concatenate((curve.breaks_s, np.linspace(0, curve.trip_time_s, 500))))
    read = load_scenario(with_table(tmp_path, "curve.csv", rows_of(curve, times)))
    fine = np.linspace(0, curve.trip_time_s, 3001)
    for got, wanted in zip(read.desired_curve().at(fine), curve.at(fine), strict=True):
        assert got == pytest.approx(wanted, abs=1e-6)
    one, two = (simulate(scenario, "pid").totals["traction_work_j"] for scenario in (own, read))
    assert two == pytest.approx(one, rel=1e-6)


@pytest.mark.parametrize(("name", "rows", "says"), [
    ("missing.csv", GOOD, "no such file"), ("curve.csv", GOOD, "make the curve for this line"),
    ("curve.csv", GOOD[::-1], "sort"),
])
def test_a_scenario_says_what_is_wrong_with_its_table(tmp_path, name, rows, says):
    with pytest.raises(InputError, match=says) as trouble:
        load_scenario(with_table(tmp_path, name, rows))
    assert "\n" not in str(trouble.value)


def test_rows_do_not_stand_in_the_scenario_itself(tmp_path):
    path = with_table(tmp_path, "curve.csv", GOOD)
    path.write_text(path.read_text(encoding="utf-8").replace('file = "curve.csv"', 'file = "curve.csv"\nrows = [[0.0, '
                                                             '0.0, 0.0, 0.0]]'), encoding="utf-8")
    with pytest.raises(InputError, match="rows"):
        load_scenario(path)


def test_the_bundled_tables_are_named_by_bundled_files():
    tables, rules = (sorted(PROOFS.glob(f"*/*.{ending}")) for ending in ("csv", "toml"))
    rules = [path for path in rules if path.stem == "reference"]
    assert tables == [path.with_suffix(".csv") for path in rules] != []
    assert all("source" in tomllib.loads(path.read_text(encoding="utf-8")) for path in rules)
