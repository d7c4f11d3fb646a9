"""A large cone program without what a coarser mesh leaves no use for: the same answer, or the whole program's."""

from dataclasses import replace

import numpy as np
import pytest
from test_optimal_nlp import TRAINS, hilly

from workbench.optimal import open_rows, socp
from workbench.optimal.grid import graded_grid, kept_borders
from workbench.optimal.open_rows import all_open, rightly_closed, thinned
from workbench.optimal.reference import least_time
from workbench.optimal.socp import solve_socp

CONVEX = [vehicle for vehicle in TRAINS if not vehicle.traction.table]
INTERVALS = 1000


@pytest.fixture(autouse=True)
def _large_from_fewer_intervals(monkeypatch):
    """What is shown of large programs is shown of smaller ones, at half the cost."""
    monkeypatch.setattr(socp, "COARSE_FIRST", INTERVALS - 100)


def whole(vehicle, grid, asked):
    return socp._solve(vehicle, grid, asked, (0.0, 0.0), unit=socp.cost_unit(grid))


@pytest.mark.parametrize("vehicle", TRAINS, ids=lambda vehicle: vehicle.name)
@pytest.mark.parametrize("stops", [(), (8e3,)])
def test_a_large_program_is_answered_as_if_nothing_had_been_left_out(vehicle, stops):
    course = hilly(stops)
    grid = graded_grid(course, INTERVALS)
    asked = 1.15 * least_time(vehicle, course).trip_time_s
    plan, (reference, _) = solve_socp(vehicle, grid, asked), whole(vehicle, grid, asked)
    assert plan.energy_j == pytest.approx(reference.energy_j, rel=2e-6)
    assert plan.time_price_w == pytest.approx(reference.time_price_w, rel=2e-3)
    np.testing.assert_allclose(np.sqrt(2 * plan.half_square), np.sqrt(2 * reference.half_square), atol=0.05)
    assert plan.solve_s > 0


def test_what_is_left_out_is_a_good_part_and_small_programs_are_left_alone(monkeypatch):
    sizes = []
    solve = socp._solve

    def counted(vehicle, grid, asked, ends, rows=None, extra_s=None, unit=1.0):
        sizes.append((len(grid.limit_mps), rows))
        return solve(vehicle, grid, asked, ends, rows, extra_s, unit)

    monkeypatch.setattr(socp, "_solve", counted)
    course = hilly()
    asked = 1.15 * least_time(CONVEX[0], course).trip_time_s
    solve_socp(CONVEX[0], graded_grid(course, 400), asked)
    assert [rows for _, rows in sizes] == [None]
    sizes.clear()
    solve_socp(CONVEX[0], graded_grid(course, INTERVALS), asked)
    (few, first), (many, rows) = sizes
    assert first is None and few < many / 5
    assert rows.brake.mean() < 0.5 and rows.pull.mean() < 0.8 and rows.top.mean() < 0.8


def test_the_unit_of_the_cost_decides_the_work_and_not_the_plan():
    course = hilly()
    grid, asked = graded_grid(course, 400), 1.05 * least_time(CONVEX[0], course).trip_time_s
    one, other = (socp._solve(CONVEX[0], grid, asked, (0.0, 0.0), unit=unit)[0] for unit in (1.0, socp.cost_unit(grid)))
    assert socp.cost_unit(grid) < socp.cost_unit(grid, 5e-4)
    assert one.energy_j == pytest.approx(other.energy_j, rel=2e-6)
    assert one.time_price_w == pytest.approx(other.time_price_w, rel=2e-3)
    np.testing.assert_allclose(np.sqrt(2 * one.half_square), np.sqrt(2 * other.half_square), atol=0.05)


@pytest.mark.parametrize("closed", ["pull", "brake", "pull_limit", "top"])
def test_what_was_left_out_wrongly_is_seen_and_the_whole_program_solved(monkeypatch, closed):
    """A guess that leaves out what is needed everywhere must cost time only."""
    # A linear term of the resistance comes with a rule that holds the speed limit as well.
    vehicle, course = replace(CONVEX[0], davis_n=(4e3, 0.0, 9.0)), hilly()
    grid = graded_grid(course, INTERVALS)
    asked = 1.04 * least_time(vehicle, course).trip_time_s
    verdicts = []

    def misled(vehicle, grid, *_):
        never = np.zeros(len(grid.limit_mps) + (closed == "top"), dtype=bool)
        return replace(all_open(grid), **{closed: never})

    def watched(*arguments):
        verdicts.append(rightly_closed(*arguments))
        return verdicts[-1]

    monkeypatch.setattr(socp, "open_rows", misled)
    monkeypatch.setattr(socp, "rightly_closed", watched)
    plan, (reference, _) = solve_socp(vehicle, grid, asked), whole(vehicle, grid, asked)
    assert not any(verdicts)  # without traction there is no plan, hence no verdict
    assert plan.energy_j == reference.energy_j
    np.testing.assert_array_equal(plan.half_square, reference.half_square)


def test_a_thinned_mesh_keeps_borders_and_stops():
    course = hilly((8e3,))
    grid = graded_grid(course, INTERVALS)
    coarse = thinned(grid)
    assert set(kept_borders(course)) <= set(coarse.position_m) <= set(grid.position_m)
    assert len(coarse.limit_mps) <= len(grid.limit_mps) / open_rows.THINNED + 2 * len(kept_borders(course))
    assert coarse.stands.sum() == 1


@pytest.mark.parametrize("apart", [0.1, 10.0])
def test_a_refined_attempt_follows_where_the_quick_one_is_far_from_its_dual(monkeypatch, apart):
    """Its answer is taken then; one that ends inaccurately but near its dual is taken as it is."""
    from types import SimpleNamespace

    from workbench.optimal import cone_program

    vehicle, course = CONVEX[0], hilly()
    grid = graded_grid(course, 100)
    asked = 1.15 * least_time(vehicle, course).trip_time_s
    refining, apart = [], apart * cone_program.NEAR
    solver = cone_program.clarabel.DefaultSolver

    def inaccurate_first(*arguments):
        refining.append(arguments[-1].iterative_refinement_enable)
        answer = solver(*arguments).solve()
        status = "AlmostSolved" if len(refining) == 1 else str(answer.status)
        return SimpleNamespace(solve=lambda: SimpleNamespace(x=answer.x, z=answer.z, obj_val=answer.obj_val,
                                                             obj_val_dual=(1 - apart) * answer.obj_val, status=status))

    monkeypatch.setattr(cone_program.clarabel, "DefaultSolver", inaccurate_first)
    is_far = apart > cone_program.NEAR
    assert solve_socp(vehicle, grid, asked).status == ("Solved" if is_far else "AlmostSolved")
    assert refining == ([False, True] if is_far else [False])
