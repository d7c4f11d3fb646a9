"""The small valid inputs, as texts, that bad input and faults are made of."""

from __future__ import annotations

import re

LINE = """\
name = "short"
length_m = 400.0
grade = [{ start_m = 0.0, end_m = 150.0, grade_permille = 2.0 },
         { start_m = 150.0, end_m = 400.0, grade_permille = -1.0 }]
curve = [{ start_m = 0.0, end_m = 400.0, radius_m = inf }]
"""
LINE_MORE = "speed_limit = [{ start_m = 0.0, end_m = 400.0, speed_mps = 20.0 }]\nstops_m = [0.0, 200.0, 400.0]\n"
TRAIN = """\
mass_kg = 200000.0
davis_a_mps2 = 0.02
davis_b_per_s = 1e-4
davis_c_per_m = 1e-5
max_traction_n = 200000.0
max_braking_n = 200000.0
max_power_w = 3000000.0
"""
RUN = f"""\
version = 1
name = "short"
title = "A short run"
paper = "none"
citation = "none"
track = "line.toml"
[train]
{TRAIN}
[reference]
kind = "cruise_speed"
cruise_mps = 10.0
acceleration_mps2 = 0.5
braking_mps2 = 0.5
ramp_s = 2.0
[simulation]
plant_step_s = 0.01
dwell_s = 1.0
position_band_m = 0.2
log_every_s = 0.1
[disturbance]
amplitude_mps2 = 0.01
period_s = 60.0
"""
CONTROLLERS = """\
[controllers.good]
law = "{law}"
period_s = 0.01
parameters = {{ {parameters} }}
initial = {{ {initial} }}
"""
PID = CONTROLLERS.format(law="pid", parameters="K_p = 1.0, K_i = 0.1, K_d = 2.0", initial="eta_e = 0.0")
UNCERTAINTY = """\
[uncertainty]
runs = 2
seed = 1
spread = 0.1
factors = ["mass"]
"""
EXTRAS = """\
[actuator]
lag_s = 0.1
delay_s = 0.05
rise_n_per_s = 1e6
[actuator.adhesion]
factor = 0.6
[sensing]
position_noise_m = 0.01
speed_noise_mps = 0.01
measurement_delay_s = 0.01
seed = 3
[tuning]
runs = 2
seed = 1
ranges = { good = { K_p = [0.5, 2.0], K_d = [1.0, 4.0] } }
objective = { position_m = 0.1, speed_mps = 0.1, jerk_mps3 = 0.3, failed = 100.0 }
[joint_sensitivity]
ranges = { "train.mass_kg" = [1.8e5, 2.2e5], "disturbance.amplitude_mps2" = [0.0, 0.02] }
metric = "stopping_error"
controller = "good"
samples = 2
seed = 1
resamples = 20
[printed_table]
source = "paper, Table 1"
[[printed_table.rows]]
controller = "good"
position_error_m = [-0.1, 0.1]
speed_error_mps = [-0.1, 0.1]
stopping_accuracy_m = 0.1
[[variants]]
title = "heavier"
set = { "train.mass_kg" = 2.1e5 }
[[variants]]
title = "along a table"
set = { reference = { kind = "table", file = "reference.csv" } }
"""
CONTEST = """\
version = 1
kind = "contest"
name = "small"
title = "a small contest"
paper = "contest"
citation = "none"
scenario = "run.toml"
seeds = 2
seed = 1
resamples = 20
confidence = 0.95
source = { seed = "convention: any" }
periods_s = { good = [0.05] }
[entrants.second]
law = "pid"
period_s = 0.01
parameters = { K_p = 1.0, K_i = 0.2, K_d = 2.0 }
initial = { eta_e = 0.0 }
[conditions.nominal]
title = "nominal"
[conditions.ten]
title = "drawn"
spread = 0.1
speed_noise_mps = 0.02
failed_share = 0.1
failure_n = 1000.0
failure_from_s = 10.0
[tuning]
runs = 2
seed = 7
condition = "ten"
draws = 1
ranges = { good = { K_p = [0.5, 2.0] } }
objective = { position_m = 0.1, speed_mps = 0.1, ride_jerk_mps3 = 0.3, failed = 100.0 }
[tuning.without_curve]
energy_j = 3.6e6
stopping_m = 0.1
late_s = 1.0
overspeed_mps = 0.1
ride_jerk_mps3 = 0.3
failed = 100.0
"""
LAW = '''\
"""A law."""
import sympy as sp
from workbench.model.law import ControlLaw, desired_position, desired_speed, position, speed
K_p, K_d = sp.symbols("K_p K_d", positive=True)
pd = ControlLaw(id="law.pd", title="PD", source="none", information="full state, model unknown",
                command=K_p * (desired_position - position) + K_d * (desired_speed - speed), parameters=(K_p, K_d))
'''
STORE = '''\
"""A store in discrete time."""
import sympy as sp
from workbench.systems.law import StateLaw
from workbench.systems.plant import Parameter, Plant

x, p, o, d = sp.symbols("x p o d", real=True)
S, r = sp.symbols("S r", positive=True)
plant = Plant("store.store", (x, p), updates=(x + r * p - d, o), step_s=0.5, inputs=(o,), disturbances=(d,),
              parameters=(Parameter(r, 1.0, "1"),), input_limits={o: (0.0, 50.0)})
up_to = StateLaw("store.up_to", title="order up to", source="none", commands={o: S - x - p}, parameters=(S,))
'''
STORE_STUDY = """\
version = 1
kind = "plant"
name = "store"
title = "A store"
paper = "store"
citation = "none"
duration_s = 20.0
initial = { x = 3.0 }
disturbance.d = { kind = "sine", offset = 8.0, amplitude = 4.0, period_s = 6.0 }
uncertainty = { runs = 2, seed = 1, factors = ["r"] }
[controllers.up_to]
law = "up_to"
period_s = 0.5
parameters = { S = 30.0 }
"""
PAPER = '''\
"""A paper."""
from workbench.proof.paper import Paper

paper = Paper("small2030", "A. Author, A title, 2030")
'''
CLAIMS = r'''"""Section 1."""
import tomllib
from pathlib import Path
import sympy as sp
from workbench.proof.claim import D, Goal, at_least, at_most, equal
from ..paper import paper

bound = tomllib.loads((Path(__file__).parents[1] / "values.toml").read_text())["bound"]
x, y = sp.symbols("x y", real=True)
k = sp.Symbol("k", positive=True)

@paper.claim("1", "an identity", "identity", r"(x + y)^2 = x^2 + 2 x y + y^2", "proved")
def identity() -> Goal:
    """A note with $x^2$ in it."""
    return Goal((equal((x + y)**2, x**2 + 2*x*y + y**2),))

@paper.claim("2", "decay", "inequality", r"\dot V \le 0", "proved", rests_on=("1",))
def decay() -> Goal:
    """Along the flow."""
    return Goal((at_most(D(x**2 / 2), 0),), flow={x: -k * x})

@paper.claim("3", "a false one", "inequality", r"x^2 \ge 1", "refuted", premises=("2",))
def false() -> Goal:
    """Below the bound."""
    return Goal((at_least(x**2, sp.Rational(bound)),))

paper.axiom("4", "a lemma", r"a \le b", "somebody's lemma", hypotheses=("2",))
'''
SYMBOLS = r"""
assumptions = ['e^2 < k^2']
[symbols]
'e' = "real"
'k' = "positive"
'\alpha' = "positive"
[definitions]
'V' = '\tfrac12\ln\frac{k^2}{k^2 - e^2}'
[flow]
'e' = '-\alpha e'
"""
TRACK = {
    "metadata": {"id": "mine", "library version": "TTOBench v1.5"},
    "altitude": {"unit": "m", "value": 400},
    "stops": {"unit": "m", "values": [0, 250.0, 900.0]},
    "speed limits": {"units": {"position": "m", "velocity": "km/h"}, "values": [[0, 60], [300, 80]]},
    "gradients": {"units": {"position": "m", "slope": "permil"}, "values": [[0, 1.5], [300, -2.5]]},
    "curvatures": {
        "units": {"position": "m", "radius at start": "m", "radius at end": "m"},
        "values": [[0, "infinity", "infinity"], [100, "infinity", -500], [120, -500, 400]],
    },
    "tunnels": {"units": {"position": "m", "length": "m", "cross section": "m^2"}, "values": [[400, 80.5, 44]]},
    "ETCS braking data": {"M_NVAVADH": {"unit": "-", "value": 0}},
}
VEHICLE = {
    "metadata": {"id": "mine", "library version": "TTOBench v1.5"},
    "length": {"unit": "m", "value": 58.6},
    "mass": {"unit": "kg", "value": 122000.0},
    "rho": {"unit": "%", "value": 10},
    "max traction power": {"unit": "kW", "value": 2600.0},
    "max reg braking power": {"unit": "kW", "value": 2500.0},
    "max traction force": {"unit": "kN", "value": 200.0},
    "max reg braking force": {"unit": "kN", "value": 190.0},
    "max acceleration": {"unit": "m/s^2", "value": 1.1},
    "max deceleration": {"unit": "m/s^2", "value": 0.9},
    "max speed": {"unit": "km/h", "value": 162},
    "rolling resistance r0": {"unit": "kN", "value": 2.37888},
    "rolling resistance r1": {"unit": "kN/(km/h)", "value": 0.0169},
    "rolling resistance r2": {"unit": "kN/(km/h)^2", "value": 0.000932},
    "efficiency traction": {"unit": "%", "value": 90.0},
    "efficiency reg brake": {"unit": "%", "value": 85.0},
    "ETCS braking data": {
        **{
            name: {"units": {"velocity": "km/h", "deceleration": "m/s^2"}, "values": [[0, rate], [100, 0.9 * rate]]}
            for name, rate in (("A_brake_emergency", 1.1), ("A_brake_service", 0.8))
        },
        "K_dry_rst": {"unit": "-", "value": 0.8},
        "K_wet_rst": {"unit": "-", "value": 0.9},
        **{name: {"unit": "s", "value": value} for name, value in (("T_traction", 1.0), ("T_be", 2.0), ("T_bs", 2.0))},
        "v_uncertainty": {"unit": "%", "value": 3.0},
    },
}
JOURNEY = {
    "metadata": {"id": "mine", "library version": "TTOBench v1.5", "associated track": "mine"},
    "timing points": {
        "units": {
            "position": "m", "lower time constraint": "s", "upper time constraint": "s",
            "lower speed constraint": "km/h", "upper speed constraint": "km/h",
        },
        "values": [[0, 0, 0, 0, 0], [250, 30, 60, 0, 0], [900, None, 160, 0, 0]],
    },
}
WINDOWS = """\
name = "short"
track = "short"
point = [
  { position_m = 0.0, earliest_s = 0.0, latest_s = 0.0, slowest_mps = 0.0, fastest_mps = 0.0 },
  { position_m = 200.0, earliest_s = 20.0, latest_s = 60.0 },
  { position_m = 400.0, latest_s = 80.0, fastest_mps = 0.0 },
]
"""
FLEET = """\
name = "short trips"
track = "line.toml"
train = "train.toml"
trips = [{ id = "a", time_s = 60.0 }, { id = "too soon", time_s = 2.0 }, { id = "b", time_s = 70.0, from_m = 100.0 }]
"""


def sourced(text: str) -> str:
    """The TOML text with a source for every value of its tables that take one."""
    head, *tables = re.split(r"(?m)^(?=\[)", text)
    lines = [head]
    for table in tables:
        keys = re.findall(r"(?m)^(\w+) = ", table)
        plain = table.startswith(("[[", "[printed", "[uncertainty", "[tuning", "[joint", "[conditions"))
        source = ", ".join(f'{key} = "assumed: a test"' for key in keys)
        lines.append(table if plain or not keys else f"{table}source = {{ {source} }}\n")
    return "".join(lines)


def line_text(more: str = "") -> str:
    """A short line with its sources; more: of its keys."""
    return (
        LINE
        + more
        + "".join(f'source.{key} = "assumed: a test"\n' for key in re.findall(r"(?m)^(\w+) = ", LINE + more))
    )
