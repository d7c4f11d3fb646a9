"""A scenario that runs in milliseconds, and its Monte Carlo."""

from pathlib import Path

from scenarios import LIGHT_TRAIN

from workbench.simulate.sweep import sweep
from workbench.simulate.sweep_rows import SweepRow
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
