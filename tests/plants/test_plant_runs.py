"""Runs of any plant against theory and other integrators."""

import math
import re

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from shown_plants import CART, COMPUTED_TORQUE, FREE, GAINS, PENDULUM, omega, theta, u, v, x

from workbench.errors import CompileError
from workbench.model.law import LawState
from workbench.simulate.plants.run import Entrant, run
from workbench.systems.law import Reference, StateLaw
from workbench.systems.metric import Metric
from workbench.systems.plant import Parameter, Plant
from workbench.systems.setting import Setting
from workbench.systems.signals import Constant, Ramp, Sine, Spline, Step, signals_at

q = sp.Symbol("q", real=True)


def test_a_frictionless_pendulum_keeps_its_energy_and_its_period():
    l_, g = (p.symbol for p in PENDULUM.parameters[1:3])
    energy = omega**2 / 2 - g / l_ * sp.cos(theta)
    setting = Setting(PENDULUM, 20.0, parameters={"b": 1e-300}, initial={"theta": 1.5}, log_every_s=1e-3, metrics=(
        Metric("high", "largest", energy), Metric("low", "smallest", energy), Metric("end", "terminal", energy)))
    found = run(setting, Entrant("free", 0.01, FREE))
    assert found.failed is None
    assert found.metrics["high"] - found.metrics["low"] < 1e-9
    assert found.metrics["end"] == pytest.approx(-9.81 / 0.5 * math.cos(1.5), abs=1e-9)
    # The exact period by the arithmetic-geometric mean; each way down through zero is one period after the other.
    a, b = 1.0, math.cos(0.75)
    for _ in range(10):
        a, b = (a + b) / 2, math.sqrt(a * b)
    t, angle = found.column("t_s"), found.column("theta")
    down = np.nonzero((angle[:-1] > 0) & (angle[1:] <= 0))[0]
    crossings = t[down] + angle[down] / (angle[down] - angle[down + 1]) * 1e-3
    assert np.diff(crossings) == pytest.approx(2 * math.pi * math.sqrt(0.5 / 9.81) / a, abs=1e-6)


def test_a_linear_plant_is_moved_by_the_matrix_exponential():
    A, B = np.array([[0.0, 1.0, 0.0], [-2.0, -0.3, 1.0], [0.0, -1.0, -0.5]]), np.array([0.0, 1.0, 0.5])
    states = sp.symbols("z_1:4", real=True)
    rates = [sum(float(a) * s for a, s in zip(row, states, strict=True)) + float(b) * u
             for row, b in zip(A, B, strict=True)]
    plant, period = Plant("linear", states, rates, inputs=(u,)), 0.05
    law = StateLaw("sampled", {u: -states[0] + q}, states=(LawState(q, update=q / 2 + states[2]),))
    start = np.array([1.0, -0.5, 0.25])
    found = run(Setting(plant, 3.0, initial=dict(zip(map(str, states), start, strict=True)), log_every_s=period),
                Entrant("law", period, law))
    whole = expm(period * np.block([[A, B[:, None]], [np.zeros((1, 4))]]))
    at, own = start, 0.0
    for row in found.log:
        assert row[1:4] == pytest.approx(at, abs=1e-9)
        assert row[6] == pytest.approx(own, abs=1e-9) or row[0] == 3.0
        command = -at[0] + own
        own = own / 2 + at[2]
        at = whole[:3, :3] @ at + whole[:3, 3] * command


SIGNALS = {"references": {"theta_d": Sine(amplitude=0.5, period_s=2.0)},
           "disturbances": {"d": Spline(times_s=(0.2, 1.0, 1.7, 3.0), values=(0.0, 3.0, -1.0, 0.5))}}


@pytest.mark.parametrize("lag_s", [0.0, 0.07])
@pytest.mark.parametrize("integrator", ["rk4", "radau", "lsoda"])
def test_a_law_with_signals_lag_delay_and_lateness_is_what_plain_python_makes_of_it(lag_s, integrator):
    period, late, delay = 0.02, 2, 0.04
    setting = Setting(PENDULUM, 1.0, step_s=1e-3 if integrator == "rk4" else period, initial={"theta": 0.3},
                      tracks={"theta": "theta_d"}, late_s={"theta": late * period}, lag_s={"tau": lag_s},
                      delay_s={"tau": delay}, log_every_s=period, integrator=integrator, **SIGNALS)
    found = run(setting, Entrant("law", period, COMPUTED_TORQUE, GAINS))
    times, state, waiting = plain(period, late, delay, lag_s)
    assert found.column("t_s") == pytest.approx(times, abs=1e-12)
    for i, name in enumerate(("theta", "omega")):
        assert found.column(name) == pytest.approx(state[:, i], abs=2e-6)
    assert found.column("tau_wanted")[:-1] == pytest.approx(waiting, abs=1e-5)
    error = (state[:, 0] - 0.5 * np.sin(np.pi * times))
    assert found.metrics["theta_error_final"] == pytest.approx(error[-1], abs=2e-6)
    assert found.metrics["theta_error_largest"] >= np.max(np.abs(error)) - 1e-6


def plain(period, late, delay, lag_s):
    """The same loop by scipy at a tight tolerance, without any code of the package but the spline's definition."""
    from scipy.interpolate import CubicSpline

    spline = CubicSpline((0.2, 1.0, 1.7, 3.0), (0.0, 3.0, -1.0, 0.5), bc_type="natural")
    push = lambda t: float(spline(t)) if t >= 0.2 else float(spline(0.2) + (t - 0.2) * spline(0.2, 1))  # noqa: E731
    samples, w = round(1.0 / period), math.pi
    states, seen, commands, actual = [np.array([0.3, 0.0])], [], [], 0.0
    for n in range(samples):
        t, at = n * period, states[-1]
        seen.append(at[0])
        angle = seen[max(n - late, 0)]
        r, rd, rdd = 0.5 * math.sin(w * t), 0.5 * w * math.cos(w * t), -0.5 * w * w * math.sin(w * t)
        command = 0.25 * (rdd - 25 * (angle - r) - 10 * (at[1] - rd) + 0.1 * at[1]) + 9.81 * 0.5 * math.sin(angle)
        commands.append(min(max(command, -5.0), 5.0))
        held = commands[n - round(delay / period)] if n >= round(delay / period) else 0.0
        begin = actual

        def torque(now, t=t, held=held, begin=begin):
            return held + (begin - held) * math.exp(-(now - t) / lag_s) if lag_s else held

        done = solve_ivp(lambda now, y, torque=torque: [y[1], -9.81 / 0.5 * math.sin(y[0]) - 0.1 * y[1]
                                                        + torque(now) / 0.25 + push(now)],
                         (t, t + period), at, rtol=1e-11, atol=1e-12)
        states.append(done.y[:, -1])
        actual = torque(t + period)
    return np.arange(samples + 1) * period, np.array(states), np.array(commands)


def test_metrics_are_what_they_say():
    metrics = (Metric("way", "integral", sp.Abs(v)), Metric("mean", "mean", x), Metric("end", "terminal", x),
               Metric("low", "smallest", x), Metric("rms", "root mean square", v))
    above = x - sp.Rational(1, 4)
    metrics += (Metric("left", "last above zero", above), Metric("forward", "last above zero", -v),
                Metric("never", "last above zero", x - 2),
                Metric("nowhere", "last above zero", sp.log(x - sp.Rational(1, 2))))
    setting = Setting(CART, 2.0, initial={"x": 1.0, "v": -2.0}, references={"r": Ramp(slope_per_s=1.0)},
                      tracks={"x": "r"}, metrics=metrics)
    found = run(setting, Entrant("push", 0.5, StateLaw("push", {u: 2})))
    # x is above 1/4 until 1/2 and again from 3/2 on; v is below 0 until 1.
    assert found.metrics["left"] == 2.0 and found.metrics["never"] == 0.0 and found.metrics["nowhere"] is None
    assert found.metrics["forward"] == pytest.approx(1.0, abs=1.1 * setting.step_s)
    assert next(metric.unit for metric in setting.every_metric if metric.id == "left") == "s"
    # x = 1 - 2 t + t^2: down to 0 at t = 1, back to 1 at t = 2.
    assert {k: found.metrics[k] for k in ("mean", "end", "low", "rms", "u_rms")} == pytest.approx(
        {"mean": 1 / 3, "end": 1.0, "low": 0.0, "rms": math.sqrt(4 / 3), "u_rms": 2.0}, abs=1e-9)
    assert found.metrics["way"] == pytest.approx(2.0, abs=1e-5)  # its integrand has a kink
    assert found.metrics["x_error_final"] == pytest.approx(-1.0)
    assert found.metrics["x_error_largest"] == pytest.approx(1.25)


def test_a_step_acts_from_its_instant_on_and_limits_hold():
    setting = Setting(CART, 2.0, references={"r": Step(before=0.0, after=9.0, at_s=1.0)}, log_every_s=0.5)
    r = Reference("r")
    plant = Plant("limited", CART.states, CART.rates, CART.inputs, input_limits={u: (-1.0, 4.0)},
                  state_limits={x: (-math.inf, 1.5)})
    found = run(setting.varied(plant=plant), Entrant("law", 0.1, StateLaw("law", {u: r.value}, references=(r,))))
    assert found.column("u").tolist() == [0.0, 0.0, 4.0, 4.0, 4.0]
    assert found.column("x")[-1] == pytest.approx(2.0, abs=1e-12)
    assert found.metrics["x_limit_excess"] == pytest.approx(0.5, abs=1e-12)
    # Of 20 commands ten ask for 9 and get 4; what is called by the sample counts alike.
    assert found.metrics["u_variation"] == pytest.approx(2.0) and found.metrics["u_saturated"] == 0.5
    by_solver = run(setting.varied(plant=plant, integrator="radau"), Entrant("law", 0.1, StateLaw(
        "law", {u: r.value}, references=(r,))))
    assert {k: by_solver.metrics[k] for k in ("u_variation", "u_saturated")} == {
        k: found.metrics[k] for k in ("u_variation", "u_saturated")}
    with pytest.raises(ValueError, match=r"'chatter': measure 'variation' is of an input .* name one of u"):
        setting.varied(metrics=(Metric("chatter", "variation", 2 * u),))


def test_who_looks_ahead_sees_a_step_at_its_sample_whatever_rounding_says():
    """43 samples of 0.1 s and one more are 4.3999999999999995 s, and a step at 4.4 s was seen a sample late there."""
    for count, period_s, ahead in ((43, 0.1, 1), (86, 0.05, 2)):
        t = count * period_s + period_s * ahead
        assert t < 4.4
        assert signals_at({"r": Step(after=1.0, at_s=4.4)}, t)["r"][0].tolist() == [1.0]
    assert signals_at({"r": Step(after=1.0, at_s=4.4)}, [4.399, 4.4])["r"][0].tolist() == [0.0, 1.0]


def test_noise_is_the_same_for_the_same_seed_and_has_its_deviation():
    law = StateLaw("echo", {u: 0 * v + x})
    setting = Setting(CART, 50.0, step_s=0.01, noise={"x": 0.1}, log_every_s=0.01, seed=3)
    one, same = (run(setting.varied(plant=STILL), Entrant("echo", 0.01, law)) for _ in range(2))
    other = run(setting.varied(plant=STILL, seed=4), Entrant("echo", 0.01, law))
    assert (one.log == same.log).all() and (one.log != other.log).any()
    assert np.std(one.column("u")) == pytest.approx(0.1, rel=0.05)


STILL = Plant("still", (x, v), (0, 0), inputs=(u,))


a, b, room, push, root, top = sp.symbols("a b room push root top", real=True)
ANYWHERE = {"a": 0.0, "b": 0.0, "room": 1e300}, {"push": 0.0, "root": 0.0, "top": 1e300}


@pytest.mark.parametrize(("of_plant", "of_law", "initial", "words"), [
    ({"a": 1.0}, {}, 2.0, r"l diverged at t = 0\.5"),
    ({"b": -1.0, "room": 0.0}, {}, 1.0, r"left the plant's domain \(room \+ x > 0\) at t = 1 s"),
    ({}, {"root": 1.0}, -1.0, "gave a command that is no number"),
    ({}, {"push": 1.0, "top": 1.95}, 1.0, r"left its domain \(top - x > 0\) at t = 1 s")])
def test_a_run_that_ends_early_says_why_and_has_no_metrics(of_plant, of_law, initial, words):
    """One plant and one law, compiled once, whose values decide which end a run meets."""
    plant = Plant("ends", (x,), (a * x**2 + b + u,), inputs=(u,), domain=(x + room,),
                  parameters=[Parameter(symbol, ANYWHERE[0][str(symbol)]) for symbol in (a, b, room)])
    law = StateLaw("l", {u: push + sp.sqrt(root * x)}, parameters=(push, root, top), domain=(top - x,))
    found = run(Setting(plant, 3.0, initial={"x": initial}, parameters=of_plant),
                Entrant("l", 0.1, law, ANYWHERE[1] | of_law))
    assert found.failed is not None and re.search(words, found.failed), found.failed
    assert set(found.metrics.values()) == {None} and found.reached_s < 3.0
    assert np.isfinite(found.log).all()


def test_a_stiff_plant_is_moved_by_a_library_solver_where_fixed_steps_diverge():
    plant = Plant("van der Pol", (x, v), (v, 1000 * (1 - x**2) * v - x), inputs=(u,))
    free = StateLaw("free", {u: 0})
    setting = Setting(plant, 1.0, step_s=0.01, initial={"x": 2.0})
    told = run(setting, Entrant("free", 0.1, free)).failed
    assert "diverged" in told and "'radau'" in told and "\n" not in told and "nan" not in told
    found = run(setting.varied(integrator="radau", step_s=0.1), Entrant("free", 0.1, free))
    exact = solve_ivp(lambda t, y: [y[1], 1000 * (1 - y[0] ** 2) * y[1] - y[0]], (0, 1.0), [2.0, 0.0], "BDF",
                      rtol=1e-10, atol=1e-12).y[:, -1]
    assert found.log[-1, 1:3] == pytest.approx(exact, rel=1e-6)


@pytest.mark.parametrize(("changes", "words"), [
    ({"initial": {"phi": 1.0}}, "initial.phi: plant 'pendulum' has no state"), ({"duration_s": -1.0}, "duration_s"),
    ({"tracks": {"theta": "r"}}, "is no reference"), ({"noise": {"theta": -0.1}}, "not negative"),
    ({"delay_s": {"tau": 1.5e-4}}, "no whole number of plant steps"), ({"parameters": {"mm": 1.0}}, "no parameter"),
    ({"integrator": "euler"}, "not known"), ({"metrics": (Metric("m", "mean", q),)}, "not declared"),
    ({"disturbances": {"w": Constant(value=1.0)}}, "no disturbance"),
    ({"references": {"r": Step(after=1.0, at_s=2.5e-3)}}, "references.r: at_s = 0.0025 s is no whole number"),
    ({"seed": -1}, "seed = -1: give a whole number that is not negative"), ({"seed": 0.5}, "seed = 0.5")])
def test_what_is_no_setting_is_one_line(changes, words):
    with pytest.raises(ValueError, match=words):
        Setting(**({"plant": PENDULUM, "duration_s": 1.0} | changes))


def test_what_does_not_fit_a_controller_is_one_line():
    setting = Setting(PENDULUM, 1.0)
    with pytest.raises(ValueError, match="follows reference 'theta_d', which is not stated"):
        run(setting, Entrant("law", 0.01, COMPUTED_TORQUE, GAINS))
    with pytest.raises(ValueError, match="no whole number of plant steps"):
        run(setting, Entrant("law", 0.0015, FREE))
    with pytest.raises(ValueError, match="no whole number of periods"):
        run(setting, Entrant("law", 0.3, FREE))
    with pytest.raises(ValueError, match="no whole number of periods"):
        run(setting, Entrant("law", 1e300, FREE))
    with pytest.raises(CompileError, match=r"plant '.*function 'besselj' cannot be compiled"):
        odd = Plant("q", (x,), (sp.besselj(0, x) + u,), inputs=(u,))
        run(Setting(odd, 1.0), Entrant("l", 0.1, StateLaw("l", {u: 0})))


def test_names_that_python_does_not_allow_run_too():
    lam, angle = sp.Symbol("lambda", real=True), sp.Symbol(r"\theta", real=True)
    plant = Plant("odd", (angle,), (-sp.Symbol("in", positive=True) * angle + lam,), inputs=(lam,),
                  parameters=(Parameter(sp.Symbol("in", positive=True), 1.0),))
    found = run(Setting(plant, 1.0, initial={r"\theta": 1.0}), Entrant("l", 0.1, StateLaw("l", {lam: 0})))
    assert found.column(r"\theta")[-1] == pytest.approx(math.exp(-1), abs=1e-10)
