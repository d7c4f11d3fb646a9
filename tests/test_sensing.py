"""Noise and delays between train and controller, of compiled laws and of controllers called once a sample."""

from collections import deque

import numpy as np
import pytest
from scenarios import YANG

from workbench.errors import WorkbenchError
from workbench.model.pid import pid
from workbench.model.sensing import PERFECT, Instruments, Sensing
from workbench.simulate import closed_loop, sensing_loop
from workbench.simulate.closed_loop import Factors, Run, law_values, run_law, setting_of
from workbench.trains.scenario import Scenario, load_scenario

PERIOD_S = 0.01


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    return load_scenario(YANG)


def pid_run(scenario: Scenario, sensing: Sensing, end_s: float = 60.0) -> Run:
    name, spec = next((n, s) for n, s in scenario.controllers.items() if s.law == "pid")
    law = pid
    setting = closed_loop.replace(setting_of(scenario), end_s=end_s, log_every_s=PERIOD_S, sensing=sensing)
    return run_law(law, law_values(law, spec, name), setting, PERIOD_S)


def test_perfect_sensing_changes_nothing(scenario: Scenario) -> None:
    assert np.array_equal(pid_run(scenario, PERFECT).log, pid_run(scenario, Sensing(seed=7)).log)


def test_the_law_sees_exactly_the_noise_of_its_seed(scenario: Scenario) -> None:
    run = pid_run(scenario, Sensing(position_noise_m=0.05, speed_noise_mps=0.02, seed=3))
    spec = next(s for s in scenario.controllers.values() if s.law == "pid")
    k_p, k_i, k_d = (spec.parameters[name] for name in ("K_p", "K_i", "K_d"))
    noise, *_ = Sensing(0.05, 0.02, seed=3).arrays(len(run.log), PERIOD_S)
    error = run.column("s_desired_m") - run.column("s_m") - noise[: len(run.log), 0]
    speed = run.column("v_desired_mps") - run.column("v_mps") - noise[: len(run.log), 1]
    integral = PERIOD_S * np.insert(np.cumsum(error), 0, spec.initial["eta_e"] / PERIOD_S)
    before, after = (k_p * error + k_i * integral[k : len(error) + k] + k_d * speed for k in (0, 1))
    used = after if np.allclose(run.column("u_mps2"), after, atol=1e-9) else before
    assert run.column("u_mps2") == pytest.approx(used, abs=1e-9)
    assert noise.std(axis=0) == pytest.approx([0.05, 0.02], rel=0.05)


def test_the_same_seed_gives_the_same_bytes_and_another_does_not(scenario: Scenario) -> None:
    one, same, other = (pid_run(scenario, Sensing(0.05, 0.02, seed=seed)).log for seed in (1, 1, 2))
    assert one.tobytes() == same.tobytes()
    assert one.tobytes() != other.tobytes()


@pytest.mark.parametrize("late", [1, 2, 7])
def test_measurements_and_commands_are_late_by_whole_samples(late: int) -> None:
    _, past, commands, none = Sensing(measurement_delay_s=late * 0.1, command_delay_s=late * 0.1).arrays(100, 0.1)
    told, wanted, waiting = [], deque([0.0] * late), deque()
    for sample in range(50):
        told.append(sensing_loop.measured(sample, float(sample), -float(sample),
                                          (np.zeros((0, 2)), past, commands, none)))
        waiting.append(1.0 + sample)
        wanted.append(1.0 + sample)
        assert sensing_loop.delayed(sample, 1.0 + sample, commands) == wanted.popleft()
    assert told == [(float(max(k - late, 0)), -float(max(k - late, 0))) for k in range(50)]


def test_a_late_command_moves_the_train_later(scenario: Scenario) -> None:
    now, late = (pid_run(scenario, Sensing(command_delay_s=delay)) for delay in (0.0, 0.2))
    first = np.flatnonzero(np.abs(now.column("u_mps2")) > 0)[0]
    assert late.column("u_applied_mps2")[first : first + 20] == pytest.approx(0.0)
    assert late.totals["position_error_square_sum"] > now.totals["position_error_square_sum"]


@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
def test_values_that_are_none_are_refused(value: float) -> None:
    with pytest.raises(WorkbenchError, match="zero or positive"):
        Sensing(position_noise_m=value)
    with pytest.raises(WorkbenchError, match="zero or positive"):
        Sensing(command_delay_s=value)


def through(odometer, positions, speeds):
    return np.array([sensing_loop.counted(p, v, odometer) for p, v in zip(positions, speeds, strict=True)])


def test_a_counted_position_is_whole_pulses_of_the_way() -> None:
    *_, odometer = Sensing(position_quantum_m=0.25, odometer_scale=1.02).arrays(10, 0.1)
    p, v = np.linspace(0.0, 40.0, 500), np.full(500, 3.0)
    told = through(odometer, p, v)
    assert told[:, 0] == pytest.approx(0.25 * np.floor(1.02 * p / 0.25), abs=1e-12)
    assert told[:, 1] == pytest.approx(1.02 * v)


def test_balises_put_a_worn_wheel_right() -> None:
    *_, odometer = Sensing(odometer_scale=0.97, balise_spacing_m=100.0).arrays(10, 0.1)
    p = np.linspace(0.0, 450.0, 2000)
    told = through(odometer, p, np.zeros(2000))[:, 0]
    last = 100.0 * np.floor(p / 100.0)
    assert told == pytest.approx(last + 0.97 * (p - last))
    # Backwards it is the balise ahead that was passed last.
    back = through(odometer, [395.0, 350.0], np.zeros(2))[:, 0]
    assert back == pytest.approx([400.0 - 0.97 * 5.0, 400.0 - 0.97 * 50.0])


def test_speed_by_differences_is_the_counted_way_over_a_period() -> None:
    *_, odometer = Sensing(position_quantum_m=0.1, speed_from="differences", balise_spacing_m=7.0).arrays(10, 0.2)
    p = np.cumsum(np.random.default_rng(1).uniform(0.0, 1.0, 100))
    told = through(odometer, p, np.zeros(100))
    assert told[0, 1] == 0.0
    assert told[1:, 1] == pytest.approx(np.diff(0.1 * np.floor(p / 0.1)) / 0.2)


def test_a_law_and_a_sampled_controller_are_told_by_the_same_odometer(scenario: Scenario) -> None:
    quantum = Sensing(position_quantum_m=0.5, speed_from="differences")
    assert pid_run(scenario, quantum).log.tobytes() != pid_run(scenario, PERFECT).log.tobytes()
    stated = scenario.model_copy(update={"sensing": Instruments(position_quantum_m=0.5)})
    assert setting_of(stated).sensing == Sensing(position_quantum_m=0.5)
    assert setting_of(stated, Factors(odometer_scale=1.01)).sensing.odometer_scale == 1.01
