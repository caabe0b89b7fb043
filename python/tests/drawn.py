"""A robot and its drives: simulated by the package itself, with noise by numpy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import lacuna

#: Mass of the load that the simulation does not know, kg.
PAYLOAD = 6.0
#: Seconds of a drive, and samples per second.
SECONDS, RATE = 12.0, 100
#: One standard deviation of each sensor.
NOISE = {
    "wheel_speed_left_rad_s": 0.02,
    "wheel_speed_right_rad_s": 0.02,
    "wheel_angle_left_rad": 0.001,
    "wheel_angle_right_rad": 0.001,
    "gyro_z_rad_s": 0.004,
    "accel_x_m_s2": 0.05,
    "accel_y_m_s2": 0.05,
    "pose_x_m": 0.003,
    "pose_y_m": 0.003,
    "pose_yaw_rad": 0.002,
}


def robot(**effects: dict[str, float]) -> dict[str, Any]:
    """A torque-driven robot with these effects: their values by parameter."""

    def value(number: float, unit: str, sigma: float | None = None) -> dict[str, Any]:
        out: dict[str, Any] = {"value": number, "unit": unit, "source": "made up"}
        return out if sigma is None else out | {"sigma": sigma}

    return {
        "name": "drawn",
        "causality": "torque-driven",
        "parameters": {
            "mass": value(22.0, "kg", 0.2),
            "yaw_inertia": value(1.0, "kg m2", 0.2),
            "com_height": value(0.12, "m", 0.02),
            "wheelbase": value(0.36, "m"),
            "track": value(0.44, "m"),
            "wheel_radius": value(0.1, "m"),
            "wheel_inertia": value(0.006, "kg m2"),
            "motor_inertia": value(0.024, "kg m2"),
            "adhesion": value(0.6, "-", 0.1),
            "rolling_resistance": value(0.02, "-", 0.005),
            "coulomb": value(0.29, "N m", 0.1),
            "viscous": value(0.11, "N m s/rad", 0.04),
            "motor_lag": value(8, "ms"),
            "torque_limit": value(14.0, "N m"),
        },
        "effects": [{"effect": effect, "values": values} for effect, values in effects.items()],
    }


def torques(seed: int) -> dict[str, np.ndarray]:
    """Commanded torques: forward at changing speed, with turns both ways."""
    random = np.random.default_rng(seed)
    t = np.arange(int(SECONDS * RATE)) / RATE
    forward = 1.6 + 0.7 * np.sin(2 * np.pi * t / random.uniform(3, 5) + random.uniform(0, 6))
    turning = 3.0 * np.sin(2 * np.pi * t / random.uniform(4, 6) + random.uniform(0, 6))
    turning *= np.sin(np.pi * t / SECONDS) ** 2
    start = np.minimum(t / 0.5, 1.0)
    return {"t": t, "torque_left": start * (forward - turning), "torque_right": start * (forward + turning)}


def drive(model: dict[str, Any], seed: int, name: str) -> dict[str, Any]:
    """What noisy sensors show of a drive of that robot."""
    random = np.random.default_rng(seed + 1000)
    shown: dict[str, Any] = dict(lacuna.simulate(model, torques(seed)))
    for column, sigma in NOISE.items():
        shown[column] = shown[column] + sigma * random.standard_normal(shown[column].size)
    # What nobody measures directly.
    del shown["body_vx_m_s"], shown["body_vy_m_s"]
    return shown | {"name": name}


def write(recording: dict[str, Any], folder: Path) -> Path:
    """The recording as CSV with self-describing columns."""
    folder.mkdir(parents=True, exist_ok=True)
    columns = {("time_s" if key == "t" else key): values for key, values in recording.items() if key != "name"}
    path = folder / f"{recording['name']}.csv"
    table = np.column_stack(list(columns.values()))
    np.savetxt(path, table, fmt="%.17g", delimiter=",", header=",".join(columns), comments="")
    return path
