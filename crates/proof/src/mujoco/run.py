"""Runs models in MuJoCo on the inputs of drives: run.py JOB.json RESULT.json."""

import importlib.util
import json
import math
import sys

import mujoco

WHEELS = ["front_left", "front_right", "rear_left", "rear_right"]
SETTLING = 0.5  # s


def load_residual(path):
    spec = importlib.util.spec_from_file_location("residual", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def times(a, b):
    """Product of two quaternions."""
    w, x, y, z = a
    p, q, r, s = b
    return [
        w * p - x * q - y * r - z * s,
        w * q + x * p + y * s - z * r,
        w * r - x * s + y * p + z * q,
        w * s + x * r - y * q + z * p,
    ]


def standing(model):
    """Height and lean at which the robot stands on level ground with its heading along x."""
    slope = model.opt.gravity.copy()
    model.opt.gravity[:] = [0.0, 0.0, -float((slope**2).sum()) ** 0.5]
    data = mujoco.MjData(model)
    while data.time < SETTLING:
        mujoco.mj_step(model, data)
    model.opt.gravity[:] = slope
    w, x, y, z = data.qpos[3:7]
    yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return data.qpos[2], times([math.cos(yaw / 2), 0.0, 0.0, -math.sin(yaw / 2)], [w, x, y, z])


def run(model_path, residual_path, drive):
    model = mujoco.MjModel.from_xml_path(model_path)
    height, lean = standing(model)
    data = mujoco.MjData(model)
    module = load_residual(residual_path) if residual_path else None
    residual = module.Residual(model) if module else None
    joints = [model.joint(name) for name in WHEELS]
    steps = round(drive["period"] / model.opt.timestep)
    restarts = {r["row"]: r for r in drive["restarts"]}
    rows = []
    for k, torque in enumerate(drive["torque"]):
        if k in restarts:
            r = restarts[k]
            x, y, yaw = r["pose"]
            c, s = math.cos(yaw), math.sin(yaw)
            vx, vy = r["velocity"]
            data.qpos[:3] = [x, y, height]
            data.qpos[3:7] = times([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)], lean)
            data.qvel[:] = 0.0
            data.qvel[:2] = [vx * c - vy * s, vx * s + vy * c]
            data.qvel[5] = r["gyro"]
            for i, joint in enumerate(joints):
                data.qpos[joint.qposadr[0]] = r["wheel_angle"][i % 2]
                data.qvel[joint.dofadr[0]] = r["wheel_speed"][i % 2]
        reading = {
            "wheel_speed": [float(data.qvel[j.dofadr[0]]) for j in joints[2:]],
            "gyro": float(data.qvel[5]),
            "accel": [0.0, 0.0],
        }
        if module:
            reading = module.shown(reading)
        rows.append([*reading["wheel_speed"], reading["gyro"]])
        data.ctrl[:2] = torque
        for _ in range(steps):
            if residual:
                residual.apply(data)
            mujoco.mj_step(model, data)
    return rows


def main():
    with open(sys.argv[1]) as file:
        job = json.load(file)
    result = [run(r["model"], r["residual"], r["drive"]) for r in job]
    with open(sys.argv[2], "w") as file:
        json.dump(result, file)


main()
