"""Recordings as dicts of arrays, and files beside them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import drawn
import numpy as np
import pytest

import lacuna


def test_a_simulated_drive_has_the_columns_of_the_program(tmp_path: Path) -> None:
    inputs = drawn.torques(1)
    shown = lacuna.simulate(drawn.robot(), inputs)
    assert list(shown)[0] == "t" and "gyro_z_rad_s" in shown and len(shown) == 15
    assert all(values.dtype == np.float64 and values.shape == inputs["t"].shape for values in shown.values())
    assert np.allclose(shown["t"], inputs["t"], atol=1e-12)
    assert np.array_equal(shown["torque_left_Nm"], inputs["torque_left"])
    # From a file, by names of columns, in whole nanoseconds, from lists: the same.
    path = drawn.write(shown | {"name": "run"}, tmp_path)
    in_ns = {"t_ns": np.round(inputs["t"] * 1e9).astype(np.int64), "torque_left_Nm": list(inputs["torque_left"])}
    in_ns["torque_right"] = inputs["torque_right"].astype(object)
    for same in (inputs, {"time_s": inputs["t"]} | in_ns_without(in_ns), in_ns):
        again = lacuna.simulate(drawn.robot(), same)
        assert all(np.array_equal(again[column], shown[column]) for column in shown)
    from_file = lacuna.simulate(drawn.robot(), path)
    assert np.allclose(from_file["pose_x_m"], shown["pose_x_m"])
    # With another load it is another drive.
    loaded = lacuna.simulate(drawn.robot(payload={"mass": 6.0}), inputs)
    assert not np.allclose(loaded["wheel_speed_left_rad_s"], shown["wheel_speed_left_rad_s"])


def in_ns_without(given: dict[str, Any]) -> dict[str, Any]:
    return {key: values for key, values in given.items() if key != "t_ns"}


def test_arrays_of_any_layout_are_read() -> None:
    inputs = drawn.torques(2)
    whole = np.column_stack([inputs["t"], inputs["torque_left"], inputs["torque_right"]])
    strided = {"t": whole[:, 0], "torque_left": whole[:, 1], "torque_right": whole[:, 2]}
    assert not strided["t"].flags.c_contiguous
    one, other = lacuna.simulate(drawn.robot(), inputs), lacuna.simulate(drawn.robot(), strided)
    assert all(np.array_equal(one[column], other[column]) for column in one)
    before = whole.copy()
    assert np.array_equal(before, whole), "inputs are not written to"


def test_samples_that_are_missing_are_gaps() -> None:
    robot = drawn.robot() | {"causality": "speed-driven"}
    t = np.arange(200) / 100.0
    speeds = {"t": t, "wheel_speed_left": np.sin(t), "wheel_speed_right": np.sin(t)}
    speeds["wheel_speed_left"][50:60] = np.nan
    shown = lacuna.simulate(robot, speeds)
    assert shown["t"].size == 190 and np.isfinite(shown["torque_left_Nm"]).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"t": None}, "no instants; give t"),
        ({"time_s": np.zeros(3)}, "instants twice"),
        ({"torque_lft": np.zeros(3)}, "`torque_left`"),
        ({"t": None, "t_ns": np.zeros(3)}, "t_ns: give whole numbers of ns"),
        ({"torque_left": np.zeros(2)}, "torque_left .*2 numbers; give 3"),
        ({"torque_left": np.zeros((3, 1))}, r"shape \[3, 1\]"),
        ({"torque_left": ["a", "b", "c"]}, "no numbers"),
        ({"torque_left": [0.0, np.inf, 0.0]}, "infinite at index 1"),
        ({"t": [0.0, 1.0, np.nan]}, "index 2 is no instant"),
        ({"t": [0.0, 1.0, 1e300]}, "index 2 is no instant"),
        ({"t": [0.0, 1.0, 1.0]}, "torque_left"),
        ({"torque_left_Nm": np.zeros(3)}, "two channels are called torque_left"),
        ({"torque_left": None, "torque_right": None}, "no signal beside the instants"),
        ({"torque_right": None}, "torque_right"),
    ],
)
def test_what_no_recording_can_be_is_refused(change: dict[str, Any], message: str) -> None:
    inputs: dict[str, Any] = {"t": np.arange(3.0), "torque_left": np.zeros(3), "torque_right": np.zeros(3)}
    given = {key: values for key, values in (inputs | change).items() if values is not None}
    with pytest.raises(lacuna.LacunaError, match=message):
        lacuna.simulate(drawn.robot(), given)


def test_recordings_are_checked(tmp_path: Path) -> None:
    shown = lacuna.simulate(drawn.robot(), drawn.torques(1))
    path = drawn.write(shown | {"name": "run"}, tmp_path)
    told = lacuna.check(path)
    assert told["mapping"]["name"] == "skid-steer-columns" and told["lost"] == []
    (recording,) = told["recordings"]
    signals = {channel["signal"]: channel for channel in recording["channels"]}
    assert signals["gyro_z"]["unit"] == "rad/s" and signals["gyro_z"]["samples"] == shown["t"].size
    assert np.isclose(signals["gyro_z"]["rate_hz"], drawn.RATE)
    assert recording["diagnoses"][0] == "torque-driven robot: permitted"
    assert lacuna.check([str(tmp_path)], mapping="skid-steer-columns")["mapping"]["named_by_user"] is True
    with pytest.raises(lacuna.LacunaError, match="no file or folder"):
        lacuna.check(tmp_path / "missing.csv")
    with pytest.raises(lacuna.LacunaError, match="skid-steer-columns"):
        lacuna.check(path, mapping="skid-steer-colums")


def test_damaged_files_are_refused_in_one_sentence(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    for name, content in (("a.mcap", b"\x89MCAP0\r\n" + bytes(range(200))), ("b.parquet", b"PAR1" + b"\xff" * 90 + b"PAR1")):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(lacuna.LacunaError, match=name):
            lacuna.diagnose(robot="husky-drive", recordings=tmp_path / name)
    assert capfd.readouterr().err == ""


def test_every_effect_has_a_card() -> None:
    effects = {effect["id"]: effect for effect in lacuna.effects()}
    assert len(effects) >= 30 and effects["payload"]["parameters"][0]["unit"] == "kg"
    assert lacuna.__version__.count(".") == 2
