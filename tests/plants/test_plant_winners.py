"""The first table of a plant's page: who follows the reference most closely, and what it takes."""

from types import SimpleNamespace

import numpy as np
import sympy as sp

from workbench.paper.plants.study import _winners
from workbench.paper.results import Curve, Plot
from workbench.report.charts.chart import chart_json, chart_of
from workbench.report.standings import parted, standings
from workbench.report.table_view import table_views

x_1, u = sp.symbols("x_1 u")
SETTING = SimpleNamespace(tracks={"x_1": "r"}, plant=SimpleNamespace(id="doe.cart", inputs=(u,)), every_metric=(
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
