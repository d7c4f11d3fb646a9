"""Plants, laws, signals and metrics as records: what fits together is kept, what does not is one clear line."""

import math

import casadi as ca
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from shown_plants import CART, COMPUTED_TORQUE, FREE, PENDULUM, omega, theta, torque, u, v, x

from workbench.errors import CompileError, InputError
from workbench.model.law import LawState, time
from workbench.simulate.plants.run import Entrant
from workbench.systems.law import Reference, StateLaw
from workbench.systems.lyapunov import Lyapunov, closed_loop
from workbench.systems.metric import Metric
from workbench.systems.plant import Parameter, Plant
from workbench.systems.setting import Setting
from workbench.systems.signals import Constant, Ramp, Sine, Spline, Step, read_signal, signals_at, table_of

k = sp.Symbol("k", positive=True)
z = sp.Symbol("z", real=True)


def plant(**changes):
    return Plant(**({"id": "p", "states": (x, v), "rates": (v, u), "inputs": (u,)} | changes))


@pytest.mark.parametrize(("changes", "words"), [
    ({"rates": (v,)}, "2 states and 1 rates"),
    ({"rates": (v, z)}, "rate of 'v' uses 'z', which is not declared"),
    ({"rates": (v, sp.Symbol("u", positive=True))}, "other assumptions"),
    ({"rates": (v, math.nan)}, "is nan"),
    ({"rates": (v, sp.I * u)}, "not real"),
    ({"rates": (v, "u")}, "no expression"),
    ({"rates": (v, sp.zoo)}, "no number"),
    ({"rates": (v, sp.Matrix([u]))}, "rate of 'v' is a .*Matrix, no scalar: give one expression each"),
    ({"states": (x, x)}, "'x' is a name of a state, twice"),
    ({"states": (x, "v")}, "no symbol"),
    ({"states": (x, sp.Symbol("v"))}, "not known to be real"),
    ({"states": (), "rates": ()}, "has no state"),
    ({"inputs": (u, x)}, "a state and an input"),
    ({"inputs": (u, time)}, "time or sampling period"),
    ({"input_limits": {u: (1.0, -1.0)}}, "not below the upper limit"),
    ({"input_limits": {x: (-1.0, 1.0)}}, "no input"),
    ({"state_limits": {x: (0.0, math.nan)}}, "NaN"),
    ({"state_limits": {x: 3.0}}, "no pair of numbers"),
    ({"state_limits": {x: (0, 10**400)}}, "no pair of numbers"),
    ({"state_limits": {x: (0, 10**5000)}}, "a tuple of thousands of digits is no pair of numbers"),
    ({"rates": (v, 10**5000)}, "a int of thousands of digits: give a finite number"),
    ({"outputs": {z: u}}, "output 'z' uses 'u'"),
    ({"units": {z: "m"}}, "does not have"),
    ({"units": {x: 3}}, "unit of 'x' is 3, no text"),
    ({"states": x, "rates": (0,)}, r"states is x, no list: write \(x,\)"),
    ({"inputs": u}, r"inputs is u, no list"),
    ({"parameters": (z,)}, r"z is no Parameter: write Parameter\(symbol, value\)"),
    ({"input_limits": (u,)}, "no table"),
    ({"input_limits": {"w": (0, 1)}}, "limits of 'w', which is no input: name one of u"),
    ({"events": (z,)}, "z is no Event"),
])
def test_what_is_no_plant_is_one_line(changes, words):
    with pytest.raises(ValueError, match=words) as caught:
        plant(**changes)
    assert "\n" not in str(caught.value)


def test_symbols_may_be_named_and_measured_states_listed():
    one = plant(states=sp.Matrix([x, v]), input_limits={"u": (None, 3)}, units={"x": "m"}, outputs=[v])
    assert one.input_limits == {u: (-math.inf, 3.0)} and one.units == {x: "m"} and one.outputs == {v: v}
    assert Setting(one, 1, references={Reference("r"): 2}).references == {"r": Constant(value=2.0)}


@pytest.mark.parametrize(("changes", "words"), [
    ({"references": {"r": math.sin}}, "references.r = <.*> is no signal: give a number, Constant"),
    ({"disturbances": {"d": "1"}}, "disturbances.d = '1' is no signal"),
    ({"references": {"r": math.inf}}, "is no signal"), ({"initial": [1.0, 0.0]}, "initial is .*, no table"),
    ({"initial": {"x": "1"}}, "initial.x = '1': give a finite number"), ({"tracks": {"x": "q"}}, "no reference"),
    ({"metrics": x}, "metrics is x, no list"), ({"step_s": 10**400}, "step_s = 10+: give a positive number"),
    ({"log_every_s": 0.0007}, "log_every_s = 0.0007 s is no whole number of plant steps of 0.001 s: choose a multiple"),
    ({"log_every_s": -1.0}, "log_every_s = -1.0: give a positive number"),
    ({"step_s": 2.0}, "duration_s = 1 is shorter than one step of 2 s"),
    ({"references": {"r": -10**5000}}, "thousands of digits is no signal"),
])
def test_what_is_no_setting_is_one_line(changes, words):
    with pytest.raises(ValueError, match=words):
        Setting(plant(), 1, **changes)


@pytest.mark.parametrize(("rate", "words"), [
    (sp.Abs(x), "kink"), (sp.sign(x), "kink"), (sp.Max(x, 0), "kink"), (sp.Piecewise((0, x < 0), (x, True)), "kink"),
    (sp.floor(x), "floor has no derivative"), (sp.sqrt(x), "no finite number"), (1 / x, "no finite number")])
def test_a_plant_without_a_derivative_at_the_point_is_not_linearised(rate, words):
    with pytest.raises(ValueError, match=words) as caught:
        plant(rates=(v, u - rate)).linearise()
    assert "\n" not in str(caught.value)
    if rate.func is not sp.floor:
        shift = 1e-6
        slope = (rate.subs(x, 2 + shift) - rate.subs(x, 2 - shift)) / (2 * shift)
        assert plant(rates=(v, u - rate)).linearise({"x": 2}).A[1, 0] == pytest.approx(-float(slope), abs=1e-9)


@pytest.mark.parametrize(("value", "known", "words"), [
    (-1.0, None, "declared positive"), (math.inf, None, "not finite"), (1j, None, "no real number"),
    (10**400, None, "not finite"),
    ("1", None, "no real number"), (True, None, "no real number"), (3.0, (1.0, 2.0), "outside the known interval"),
    (1.5, (2.0, 1.0), "exchange them")])
def test_what_is_no_parameter_is_one_line(value, known, words):
    with pytest.raises(ValueError, match=words):
        Parameter(k, value, "", known)


def test_a_law_is_held_against_its_plant():
    with pytest.raises(ValueError, match="no input of plant 'cart'"):
        FREE.check(CART)
    with pytest.raises(ValueError, match="no command for input 'u'"):
        StateLaw("l", {z: 0}).check(plant(inputs=(u, z), rates=(v, u + z)))
    with pytest.raises(ValueError, match="uses 'v', a state that plant 'p' does not measure"):
        StateLaw("l", {u: -v}).check(plant(outputs={x: x}))
    with pytest.raises(ValueError, match="did you mean 'theta'"):
        StateLaw("l", {torque: sp.Symbol("thet", real=True)}).check(PENDULUM)
    with pytest.raises(ValueError, match="commands nothing"):
        StateLaw("l", {}).check(CART)
    with pytest.raises(ValueError, match="parameter 'k' of law 'l' has no value"):
        StateLaw("l", {u: -k * x}, parameters=(k,)).values(CART, {}, {})
    with pytest.raises(ValueError, match="no parameter of law"):
        COMPUTED_TORQUE.values(PENDULUM, PENDULUM.values(), {"k_q": 1.0})
    with pytest.raises(ValueError, match="measure 'median' is not known"):
        Metric("m", "median", x)


@pytest.mark.parametrize(("law", "words"), [
    (StateLaw("l", {u: -x}, states=(LawState(x, rate=-x),)), "its state 'x' has the name of a state of plant 'p'"),
    (StateLaw("l", {u: -k * x}, states=(LawState(k, rate=x**2),)), "its state 'k' has the name of a parameter"),
    (StateLaw("l", {u: -z}, states=(LawState(z, rate=x),)), "its state 'z' has the name of a disturbance"),
    (StateLaw("l", {u: -z}, parameters=(z,)), "its parameter 'z' has the name of a disturbance"),
    (StateLaw("l", {u: -x}, references=(Reference("x"),)), "its reference's symbol 'x' has the name of a state"),
    (StateLaw("l", {u: -x}, states=(LawState(sp.Symbol("u_wanted", real=True), rate=x),)), "a column of the log"),
])
def test_what_a_law_calls_like_something_of_its_plant_is_refused(law, words):
    """One symbol for both would take the plant's rate for the law's: x' = -x was "proved" of a mass without damping."""
    mass = plant(rates=(v, u - k * v + z), disturbances=(z,), parameters=(Parameter(k, 1.0),))
    for ask in (law.check, lambda one: closed_loop(one, law)):
        with pytest.raises(ValueError, match=words):
            ask(mass)


def test_a_reference_that_is_called_like_something_of_the_plant_is_refused():
    """Metrics and the log would show one for the other."""
    with pytest.raises(ValueError, match="'x' is a name of a state and a reference"):
        Setting(plant(), 1, references={"x": 1.0})
    rated = sp.Symbol("r_dot", real=True)
    with pytest.raises(ValueError, match="'r_dot' is a name of a state and a reference"):
        Setting(plant(states=(x, rated), rates=(rated, u)), 1, references={"r": 1.0})


def test_a_laws_state_and_a_reference_that_it_does_not_follow_have_names_of_their_own():
    """Both are columns of the log, where one hid the other."""
    law = StateLaw("l", {u: -z}, states=(LawState(z, rate=x),))
    with pytest.raises(ValueError, match="its state 'z' has the name of a reference"):
        Entrant("l", 0.1, law).check(Setting(plant(), 1, references={"z": 1.0}))


def test_a_law_takes_the_plants_nominal_values_unless_others_are_given():
    values = COMPUTED_TORQUE.values(PENDULUM, PENDULUM.values(), {"k_p": 1.0, "k_d": 2.0, "m": 3.0})
    assert values == {"k_p": 1.0, "k_d": 2.0, "m": 3.0, "l": 0.5, "g": 9.81, "b": 0.1}


def test_linear_and_casadi_and_control_models_are_of_the_same_expressions():
    at = {"theta": 0.7, "omega": -0.3, "tau": 1.2}
    point = [0.7, -0.3], [1.2]
    rates = PENDULUM.rates_at(*point)
    by_hand = [-0.3, -9.81 / 0.5 * math.sin(0.7) + 0.03 + 1.2 / 0.25]
    assert rates == pytest.approx(by_hand, rel=1e-14)
    assert np.array(PENDULUM.to_casadi()(0, *point, [0.0])).ravel() == pytest.approx(rates, rel=1e-14)
    system = PENDULUM.to_control()
    assert system.dynamics(0.0, point[0], [1.2, 0.0]) == pytest.approx(rates, rel=1e-14)
    linear = PENDULUM.linearise(at)
    step = 1e-6
    for column in range(2):
        ahead, behind = (np.array(point[0]) + sign * step * np.eye(2)[column] for sign in (1, -1))
        slope = (PENDULUM.rates_at(ahead, [1.2]) - PENDULUM.rates_at(behind, [1.2])) / (2 * step)
        assert linear.A[:, column] == pytest.approx(slope, abs=1e-6)
    assert linear.B.ravel() == pytest.approx([0.0, 4.0])
    with pytest.raises(ValueError, match="no state and no input"):
        PENDULUM.linearise({"phi": 1.0})
    for wrong in (math.nan, math.inf, "1"):
        with pytest.raises(ValueError, match=r"'theta' = .* is no finite number: give one"):
            PENDULUM.linearise({"theta": wrong})


@pytest.mark.parametrize("expr", [
    sp.Piecewise((x**2, x < 0), (-v, (x > 1) & (v < 2)), (x * v, True)), sp.Max(x, 0, v) - sp.Min(x, 2 * v),
    sp.sign(x) * sp.sqrt(sp.Abs(x)), sp.atan2(v, 2 + x**2) + sp.tanh(x) / (1 + sp.exp(-v)),
    sp.Abs(x) ** sp.Rational(3, 2),
    sp.pi * x + sp.Rational(1, 3), sp.cosh(x / 3) - sp.floor(v)])
def test_casadi_has_the_same_values_as_sympy(expr):
    function = Plant("q", (x, v), (expr, 0)).to_casadi()
    for at in ((0.5, -0.25), (-1.5, 0.75), (3.25, 1.5)):
        exact = float(expr.subs({x: sp.Float(at[0], 30), v: sp.Float(at[1], 30)}))
        assert float(function(0, ca.DM(at), [], [])[0]) == pytest.approx(exact, rel=1e-12, abs=1e-12)


def test_a_case_that_does_not_hold_is_not_calculated():
    """A root that two terms of a case share was taken out of it, and Python has none of -1."""
    root = sp.sqrt(x)
    tank = Plant("tank", (x,), (u - sp.Piecewise((2 * root + sp.sin(root), x > 0), (0, True)),), (u,))
    assert tank.rates_at([-1.0], [0.5]) == pytest.approx([0.5])
    assert tank.rates_at([4.0], [0.5]) == pytest.approx([0.5 - 4.0 - math.sin(2.0)])
    assert tank.to_control().dynamics(0.0, [-1.0], [0.5]) == pytest.approx([0.5])


def test_what_casadi_does_not_have_is_said():
    with pytest.raises(CompileError, match="besselj"):
        Plant("q", (x,), (sp.besselj(0, x),)).to_casadi()


@given(st.lists(st.floats(-5, 5), min_size=3, max_size=6))
@settings(max_examples=20, deadline=None)
def test_rates_of_signals_are_their_derivatives(values):
    times = tuple(float(i) for i in range(len(values)))
    signals = {"a": Sine(offset=1.0, amplitude=2.0, period_s=3.0, phase_rad=0.4),
               "b": Ramp(offset=1.0, slope_per_s=-2.0), "d": Constant(value=3.0),
               "c": Spline(times_s=times, values=tuple(values))}
    t, step = np.linspace(-1.0, len(values) + 1.0, 37) + 0.0123, 1e-5
    found, ahead, behind = (signals_at(signals, t + shift) for shift in (0.0, step, -step))
    for name in signals:
        for order in (1, 2):
            slope = (ahead[name][order - 1] - behind[name][order - 1]) / (2 * step)
            assert found[name][order] == pytest.approx(slope, abs=2e-3)
    assert signals_at({"c": signals["c"]}, np.array(times))["c"][0] == pytest.approx(values, abs=1e-9)


@pytest.mark.parametrize(("period_s", "sample", "ahead"), [(0.3, 0, 3), (0.1, 43, 1), (0.01, 1, 6)])
def test_a_step_has_come_at_a_sample_that_rounding_puts_before_it(period_s, sample, ahead):
    """What MPC is told ahead is what compiled code and laws are told when it comes, which take a step 1e-9 s early."""
    at_s = round((sample + ahead) * period_s, 9)
    t = sample * period_s + period_s * ahead
    assert t < at_s
    told = signals_at({"r": Step(before=1.0, after=2.0, at_s=at_s)}, np.array([t - 1e-6, t]))["r"]
    assert told[0].tolist() == [1.0, 2.0]


def test_a_spline_is_read_from_a_file_and_a_wrong_one_is_one_line(tmp_path):
    (tmp_path / "r.csv").write_text("t_s,q\n0,1\n1,2\n2,0\n")
    found = read_signal(Spline(file="r.csv", column="q"), tmp_path)
    assert found == Spline(times_s=(0.0, 1.0, 2.0), values=(1.0, 2.0, 0.0))
    assert table_of([found, Step(after=1.0)])[1].shape == (4, 5)
    (tmp_path / "bad.csv").write_text("t_s,q\n0,1\n1,nan\n")
    (tmp_path / "huge.csv").write_text(f"t_s,q\n0,{'9' * 200_000}\n")
    for file, column, words in (("r.csv", "p", "is no column"), ("bad.csv", "q", "line 3"), ("no.csv", "q", "no.csv"),
                                ("huge.csv", "q", "huge.csv: is not CSV")):
        with pytest.raises(InputError, match=words):
            read_signal(Spline(file=file, column=column), tmp_path)
    for wrong in ({"times_s": (0.0, 0.0), "values": (1.0, 2.0)}, {"times_s": (0.0, 1.0), "values": (1.0,)},
                  {"file": "r.csv"}, {}):
        with pytest.raises(ValueError, match=r"spline|times_s|column"):
            Spline(**wrong)


def test_the_closed_loop_is_the_flow_of_plant_law_and_reference():
    r, q = Reference("r"), sp.Symbol("q", real=True)
    law = StateLaw("pi", {u: r.second_rate - k * (x - r.value) - q}, states=(LawState(q, rate=x - r.value),),
                   parameters=(k,), references=(r,))
    flow = closed_loop(CART, law)
    assert flow == {x: v, v: r.second_rate - k * (x - r.value) - q, q: x - r.value, r.value: r.rate,
                    r.rate: r.second_rate, r.second_rate: r.third_rate}
    energy = Lyapunov("V", v**2 / 2, law)
    assert sp.expand(energy.rate(CART) - v * flow[v]) == 0
    with pytest.raises(ValueError, match="jumps by its update"):
        closed_loop(CART, StateLaw("d", {u: q}, states=(LawState(q, update=x),)))


def test_the_flow_of_a_plant_is_what_a_goal_takes():
    assert PENDULUM.flow[theta] == omega and list(PENDULUM.flow) == [theta, omega]


@pytest.mark.parametrize("value", [None, "1", math.nan, [1.0], True])
def test_what_is_no_number_is_one_line(value):
    for key in ("initial", "noise"):
        with pytest.raises(ValueError, match=rf"{key}\.x = .*: give a finite number"):
            Setting(CART, 1.0, **{key: {"x": value}})
    with pytest.raises(ValueError, match=r"duration_s = .*: give a positive number of seconds"):
        Setting(CART, value if value is not True else math.inf)
