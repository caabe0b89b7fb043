"""What MuJoCo does not hold of NAME; written by lacuna export.

    residual = Residual(model)
    while True:
        residual.apply(data)
        mujoco.mj_step(model, data)

and `shown(reading)` turns what ideal sensors read into what these show.
"""

from math import cos, exp, hypot, sin, tanh

import mujoco
import numpy as np

# Bodies of the contacts, casters first where there are some, and contacts of the wheels.
WHEELS = BODIES
CONTACTS = PAIRS
# WORDS


def sign(speed):
    """Smooth sign of a wheel speed in rad/s: dry friction turns round over REST rad/s."""
    x = min(max(speed / REST, -3.0), 3.0)
    return x * (27.0 + x * x) / (27.0 + 9.0 * x * x)


class Residual:
    """Adds torques at the driven wheel joints and a force and a moment on the chassis."""

    def __init__(self, model, start=0.0):
        """`start` is the simulation's time at which the run began, s."""
        self.model, self.start = model, start
        joints = [[model.joint(name) for name in side] for side in SIDES]
        self.speed = np.array([[joint.dofadr[0] for joint in side] for side in joints])
        self.angle = np.array([[joint.qposadr[0] for joint in side] for side in joints])
        self.drives = [model.actuator(name).id for name in ("left", "right")]
        self.chassis = model.body("chassis").id
        self.wheels = [model.body(name).id for name in WHEELS]
        self.pairs = [model.pair(name).id for name in CONTACTS]
        self.friction = model.pair_friction[self.pairs, :2].copy()

    def apply(self, data):
        """Sets the applied forces for the next step: everything in them is overwritten."""
        # What a side's encoders show is the mean of its driven wheels.
        w, angle = data.qvel[self.speed].mean(axis=1), data.qpos[self.angle].mean(axis=1)
        T = data.actuator_force[self.drives]
        t = data.time - self.start
        turn = data.xmat[self.chassis].reshape(3, 3)
        heading = np.arctan2(turn[1, 0], turn[0, 0])
        ch, sh = cos(heading), sin(heading)
        centre = data.xpos[self.chassis] + turn @ np.array([CENTRE])
        arm = centre - data.xpos[self.chassis]
        velocity = data.qvel[:3] + np.cross(turn @ data.qvel[3:6], arm)
        v = [ch * velocity[0] + sh * velocity[1], ch * velocity[1] - sh * velocity[0]]
        r, at = data.qvel[5], data.xpos[self.chassis]

        def share(wheel, x, y, radius):
            """How much of a wheel is in a disc: its edge is 30 mm wide."""
            place = data.xpos[self.wheels[wheel]]
            inside = (radius - hypot(place[0] - x, place[1] - y)) / 0.03
            return 0.5 * (1.0 + sign(inside * REST))

        grip = [1.0] * 4
        torque, force, moment = [0.0, 0.0], [0.0, 0.0], 0.0
        # GROUND
        # FORCES
        self.model.pair_friction[self.pairs, :2] = self.friction * np.array(grip[-len(self.pairs) :])[:, None]
        data.qfrc_applied[:] = 0.0
        push = np.array([ch * force[0] - sh * force[1], sh * force[0] + ch * force[1], 0.0])
        mujoco.mj_applyFT(
            self.model, data, push, np.array([0.0, 0.0, moment]), centre, self.chassis, data.qfrc_applied
        )
        data.qfrc_applied[self.speed] += np.array(torque)[:, None] / self.speed.shape[1]


def shown(reading):
    """`reading`: wheel_speed (left, right), gyro, accel (x, y), in SI."""
    y = {"wheel_speed": list(reading["wheel_speed"]), "gyro": reading["gyro"], "accel": list(reading["accel"])}
    # READINGS
    return y
