"""Speeds that ETCS permits: against the closed form of constant deceleration, and as limits of runs and bounds."""

import json
from pathlib import Path

import numpy as np
import pytest

from workbench.errors import InputError
from workbench.optimal.course import Course
from workbench.optimal.inputs.etcs import (
    DRIVER_S,
    RELEASE_MPS,
    STAIR_MPS,
    Supervision,
    margin_mps,
    permitted,
    supervised,
)
from workbench.optimal.inputs.etcs_file import load_supervision
from workbench.optimal.reference import find_reference, least_time
from workbench.optimal.vehicle import ForceLimit, Vehicle

TRAIN = Vehicle("t", 2e5, (3e3, 20.0, 8.0), ForceLimit(2e5, 2e6), ForceLimit(1.5e5, 2e6), 2e5, max_speed_mps=40.0)
LEVEL = Course(np.array([0.0, 4000.0, 8000.0]), np.array([40.0, 20.0]), np.zeros((2, 2)), np.zeros((2, 2)))
BRAKES = Supervision(((0.0, 0.9),), ((0.0, 0.6),), dry=0.8, wet=0.9, traction_s=1.0, emergency_s=4.0, service_s=3.0,
                     speed_uncertainty=0.03, wet_share=0.5)
SHARED = Path(__file__).parent.parent.parent / "shared" / "ttobench"


def test_towards_a_lower_limit_the_emergency_brakes_curve_and_its_times_count():
    speeds = np.array([30.0, 35.0, 40.0])
    found = permitted(BRAKES, TRAIN, LEVEL, 4000.0, 20.0, speeds)
    rate, foot = 0.8 * (0.9 + 0.5 * 0.1) * 0.9, 20.0 + 7.5 / 3.6
    seen = 1.03 * speeds
    wanted = 4000.0 - (seen**2 - foot**2) / (2 * rate) - 4.0 * seen - (3.0 + DRIVER_S) * speeds
    assert found == pytest.approx(wanted, abs=3.0)


def test_towards_a_stop_the_nearer_of_both_brakes_curves_counts():
    speeds = np.array([12.0, 20.0, 40.0])
    found = permitted(BRAKES, TRAIN, LEVEL, 8000.0, 0.0, speeds)
    emergency = (1.03 * speeds)**2 / (2 * 0.8 * 0.95 * 0.9) + 4.0 * 1.03 * speeds
    service = speeds**2 / (2 * 0.6)
    assert found == pytest.approx(8000.0 - np.maximum(emergency, service) - (3.0 + DRIVER_S) * speeds, abs=3.0)


def test_the_margin_above_a_limit_rises_between_110_and_210_km_per_h():
    assert [3.6 * margin_mps(v / 3.6) for v in (50, 110, 160, 210, 300)] == pytest.approx([7.5, 7.5, 11.25, 15, 15])


def test_a_slope_lengthens_the_way_to_brake():
    down = Course(LEVEL.position_m, LEVEL.limit_mps, np.full((2, 2), -2e4), LEVEL.drag)
    speeds = np.array([35.0, 40.0])
    assert np.all(permitted(BRAKES, TRAIN, down, 4000.0, 20.0, speeds)
                  < permitted(BRAKES, TRAIN, LEVEL, 4000.0, 20.0, speeds) - 50.0)


def test_the_course_keeps_below_the_permitted_speed_by_less_than_a_stair():
    lowered = supervised(LEVEL, TRAIN, BRAKES)
    assert np.all(lowered.limit_mps <= np.where(lowered.position_m[:-1] < 4000.0, 40.0, 20.0))
    speeds = np.arange(20.5, 40.0, 0.5)
    for speed, until in zip(speeds, permitted(BRAKES, TRAIN, LEVEL, 4000.0, 20.0, speeds), strict=True):
        section = np.searchsorted(lowered.position_m, until - 0.5) - 1
        assert speed - 2 * STAIR_MPS <= lowered.limit_mps[section] <= speed + STAIR_MPS
        assert np.all(lowered.limit_mps[section + 2:][lowered.position_m[section + 2:-1] < 4000.0] <= speed)
    assert lowered.limit_mps[-1] == pytest.approx(RELEASE_MPS)


def test_runs_keep_the_curve_take_more_time_and_stay_above_their_bound():
    lowered = supervised(LEVEL, TRAIN, BRAKES)
    free, least = least_time(TRAIN, LEVEL).trip_time_s, least_time(TRAIN, lowered).trip_time_s
    assert least > free + 2.0
    asked = 1.05 * least
    found, plain = find_reference(TRAIN, lowered, asked), find_reference(TRAIN, LEVEL, asked)
    assert 0 <= found.gap < 2e-3
    assert plain.lower_bound_j <= found.lower_bound_j * (1 + 1e-6)
    assert found.energy_j > plain.lower_bound_j
    assert found.check.speed_excess_mps < 1e-6 and found.check.force_excess <= 1e-9


def test_a_train_without_the_data_is_refused_and_one_with_them_in_toml_is_read(tmp_path):
    own = Path(__file__).parent.parent / "benchmarks" / "trains" / "yang2021.toml"
    with pytest.raises(InputError, match="etcs: is missing"):
        load_supervision(own, tmp_path / "line.toml")
    path = tmp_path / "train.toml"
    path.write_text(own.read_text(encoding="utf-8") + """
[etcs]
emergency = [{ speed_mps = 0.0, deceleration_mps2 = 0.9 }, { speed_mps = 20.0, deceleration_mps2 = 0.8 }]
service = [{ speed_mps = 0.0, deceleration_mps2 = 0.6 }]
emergency_s = 4.0
""", encoding="utf-8")
    read = load_supervision(path, tmp_path / "line.toml")
    assert read.safe_mps2(25.0) == 0.8 and read.safe_mps2(19.9) == 0.9 and read.emergency_s == 4.0
    text = path.read_text(encoding="utf-8")
    for key, more in (("emergency_s", ("emergency_s = 4.0", "emergency_s = 4000.0")),
                      ("dry", ("[etcs]", "[etcs]\ndry = 1e-3"))):
        path.write_text(text.replace(*more), encoding="utf-8")
        with pytest.raises(InputError, match=f"train.toml: etcs.{key}: .* correct it or its unit"):
            load_supervision(path, tmp_path / "line.toml")


def test_shares_delays_and_errors_that_would_permit_more_than_the_brakes_hold_are_refused(tmp_path):
    """A factor in per cent, a negative delay or error: each lets a train go faster than it can brake."""
    def number(value: float, unit: str = "-") -> dict[str, object]:
        return {"value": value, "unit": unit}

    steps = {"units": {"velocity": "m/s", "deceleration": "m/s^2"}, "values": [[0, 0.9], [20, 0.8]]}
    good = {"A_brake_emergency": steps, "A_brake_service": steps, "K_dry_rst": number(0.8), "K_wet_rst": number(0.9),
            "T_traction": number(1, "s"), "T_be": number(4, "s"), "T_bs": number(3, "s"),
            "v_uncertainty": number(3, "%")}
    path = tmp_path / "train.json"
    for name, wrong in ((None, None), ("K_dry_rst", number(80)), ("K_dry_rst", number(-1)), ("K_wet_rst", number(1.5)),
                        ("T_traction", number(-1, "s")), ("T_be", number(4000, "s")), ("T_bs", number(-3, "s")),
                        ("v_uncertainty", number(-3, "%")), ("v_uncertainty", number(298, "%"))):
        path.write_text(json.dumps({"ETCS braking data": good | ({name: wrong} if name else {})}), encoding="utf-8")
        if name is None:
            assert load_supervision(path, tmp_path / "line.toml").safe_mps2(0.0) == pytest.approx(0.8 * 0.9 * 0.9)
            continue
        with pytest.raises(InputError, match=f"train.json: ETCS braking data.{name}: .* correct it or its unit"):
            load_supervision(path, tmp_path / "line.toml")


@pytest.mark.skipif(not SHARED.exists(), reason="the public instances are not beside this checkout")
def test_the_public_train_and_line_are_read():
    read = load_supervision(SHARED / "trains" / "CH_Stadler_FLIRT_TPF.json", SHARED / "tracks" / "CH_StGallen_Wil.json")
    assert read.safe_mps2(0.0) == pytest.approx(0.8 * 0.9 * 0.9) and read.expected_mps2(45.0) == 0.45
    assert (read.traction_s, read.emergency_s, read.service_s) == (1.0, 4.0, 3.0)
    assert read.speed_uncertainty == pytest.approx(0.0298) and read.wet_share == 0.0
    with pytest.raises(InputError, match="ETCS braking data: is missing"):
        load_supervision(SHARED / "trains" / "CN_Beijing_Subway.json", SHARED / "tracks" / "CH_StGallen_Wil.json")
