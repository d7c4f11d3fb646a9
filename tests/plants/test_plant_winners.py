"""The first table of a plant's page: who follows the reference most closely, and what it takes."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp

from workbench.api.functions import entrant
from workbench.mpc.plant_tracking import PlantMpc
from workbench.paper.plants.study import _findings, _inaccurate, _taken_for_zero, _winners
from workbench.paper.results import Curve, Plot
from workbench.report.charts.chart import chart_json, chart_of
from workbench.report.standings import parted, standings
from workbench.report.table_view import table_views
from workbench.simulate.plants.run import Entrant, run
from workbench.simulate.plants.step_length import shortest_time
from workbench.systems.law import StateLaw
from workbench.systems.plant import Plant
from workbench.systems.setting import Setting
from workbench.systems.signals import Constant, Step

x_1, u = sp.symbols("x_1 u")
CART = SimpleNamespace(id="doe.cart", inputs=(u,), state_limits={}, units={})
SETTING = SimpleNamespace(tracks={"x_1": "r"}, plant=CART, every_metric=(
    SimpleNamespace(id="x_1_error_rms", unit="m"), SimpleNamespace(id="u_rms", unit="N")))


def ended(name, error, failed=None):
    return SimpleNamespace(name=name, failed=failed, step_us=2.0, metrics={"x_1_error_rms": error, "u_rms": 5.0})


def test_the_closest_is_named_with_its_error_the_others_and_what_it_takes():
    runs = [ended("pid", 0.5), ended("mpc", 0.02), ended("lost", None, "left domain"), ended("early", 0.01, "fell")]
    table = _winners(SETTING, runs)
    assert table.headings == ("output", "closest", "its RMS error", "the others", "its RMS of u", "its step (µs)")
    assert table.text == (("x_1", "mpc", "0.0200 m", "pid 0.500 m; lost fails; early fails", "5.00 N", "2.00"),)
    assert table_views([table], "winners")[0].anchor == "winners-1"
    assert standings(table) == ("x_1: mpc, its RMS error 0.0200 m, its RMS of u 5.00 N, its step 2.00 µs; "
                                "the others: pid 0.500 m; lost fails; early fails.",)
    assert standings(None) == () and parted("ten: pid: 1 m.") == ("ten", "pid: 1 m.")
    assert _winners(SETTING, runs[:1]) is None and _winners(SETTING, runs[2:]) is None


def test_letters_of_a_figure_are_shown_as_letters():
    plot = Plot("x_1", "state", "time (s)", "x_1 (m)", (Curve("rule_of_thumb", np.arange(3.0), np.arange(3.0)),))
    assert '"y":"x₁ (m)"' in chart_json(chart_of(plot)) and '"label":"rule_of_thumb"' in chart_json(chart_of(plot))


def test_a_run_whose_step_was_too_long_says_so_though_it_came_to_an_end():
    """A reaction that sets in on the way: x' = -x**3 from 3, whose time constant is 1/27 s there."""
    x = sp.Symbol("x", real=True)
    plant, law = Plant("cubic", (x,), (-x**3 + sp.sign(x - 1),)), StateLaw("none", {})
    settings = [Setting(plant, 1.0, step_s=step, initial={"x": 3.0}, log_every_s=0.05) for step in (0.05, 0.01)]
    runs = [run(setting, Entrant("free", 0.05, law)) for setting in settings]
    assert all(one.failed is None for one in runs)
    assert shortest_time(settings[0], runs[0]) == (pytest.approx(1 / 27), 0.0)
    assert [*_inaccurate(settings[0], runs[0])] == [
        "The numbers of free are not accurate: at t = 0 s the plant has a time constant of 0.0370 s, shorter than its "
        "integration step of 0.0500 s. Give plant_step_s = 0.005 or less, or the integrator 'radau'."]
    assert not [*_inaccurate(settings[1], runs[1])]


def test_a_controller_whose_step_takes_longer_than_its_period_would_not_keep_up():
    setting = SimpleNamespace(tracks={}, integrator="radau", every_metric=(), plant=CART)
    late = SimpleNamespace(name="mpc", ahead_s=0.0, failed=None, fallbacks=0, step_us=601.0, period_s=1e-4,
                           at_zero=())
    assert [*_findings(setting, [late])] == ["A step of mpc took 0.000601 s here, longer than its period of 0.000100 "
                                             "s: on this computer it would not keep up."]
    assert not [*_findings(setting, [SimpleNamespace(**{**vars(late), "step_us": 99.0})])]


def test_who_leaves_the_plant_s_limits_is_told_and_wins_over_nobody_who_keeps_them():
    """An MPC that let the cart go 25 m beyond its metre of rail was named as the closest."""
    limited = SimpleNamespace(**{**vars(CART), "state_limits": {x_1: (-1.0, 1.0)}, "units": {x_1: "m"}})
    setting = SimpleNamespace(**{**vars(SETTING), "plant": limited, "references": {"r": Constant(value=0.0)},
                                 "integrator": "radau"})

    def gone(name, error, excess):
        run = ended(name, error)
        return SimpleNamespace(**{**vars(run), "metrics": {**run.metrics, "x_1_limit_excess": excess}, "ahead_s": 0.0,
                                  "at_zero": (), "fallbacks": 0, "period_s": 0.1})

    far, near, slight = gone("mpc", 0.02, 24.6), gone("pid", 0.5, 0.0), gone("lqr", 0.6, 0.01)
    assert _winners(setting, [far, slight, near]).text[0][1:4] == (
        "pid", "0.500 m", "lqr 0.600 m; mpc 0.0200 m beyond the limits")
    assert [*_findings(setting, [far, near, slight])] == [
        "RMS error of x_1, least within the plant's limits: pid, 0.500 m.",
        "mpc goes beyond the plant's limits: x_1 by 24.6 m."]
    assert _winners(setting, [far, gone("lost", 0.5, 3.0)]).text[0][1] == "mpc beyond the limits"


def test_an_mpc_that_takes_a_feed_for_zero_is_told_of():
    """An MPC that planned with an empty feed kept its pump still, and lost by fifty times without a word."""
    x, u, feed = sp.symbols("x u feed", real=True)
    tank = Plant("tank", (x,), (u * (feed - x),), inputs=(u,), disturbances=(feed,), input_limits={u: (0, 1)},
                 units={feed: "g/L"})
    setting = Setting(tank, 1.0, step_s=0.05, initial={"x": 1.0}, references={"r": Constant(value=2.0)},
                      tracks={"x": "r"}, disturbances={"feed": Step(before=10.0, after=12.0, at_s=0.5)})
    blind, seeing = (run(setting, entrant(PlantMpc(3, {"x": 1.0}, {"u": 1e-3}, **more), 0.1, name="mpc"))
                     for more in ({}, {"observer": {"feed": 1.0}}))
    assert seeing.at_zero == () and not [*_taken_for_zero(setting, seeing)]
    assert [*_taken_for_zero(setting, blind)] == [
        "mpc plans with disturbance feed at zero, where it is 10.0 to 12.0 g/L all along: it would find it by observer "
        "= { feed = ... }, or what is known of it is a parameter."]
    for passing in (Step(after=3.0, at_s=0.5), Constant(value=0.0)):
        assert not [*_taken_for_zero(setting.varied(disturbances={"feed": passing}), blind)]
