//! Drives of a robot under a speed controller, as sensors show them.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use super::Layout;
use super::plant::{Robot, State, Wheel};
use crate::random::Stream;

/// Step of the true robot, s.
const STEP: f64 = 2.5e-4;
/// Seconds of a recording, at least and at most.
const SECONDS: [f64; 2] = [25.0, 40.0];

/// A smooth motion of the body that a controller is to follow: velocities and steering angle of a row.
struct Wanted {
    until: f64,
    target: [f64; 3],
    first: [f64; 3],
    now: [f64; 3],
    fastest: f64,
    turn: f64,
}

impl Wanted {
    fn next(&mut self, layout: Layout, time: f64, row: f64, s: &mut Stream) -> [f64; 3] {
        if time >= self.until {
            self.until = time + s.uniform(1.2, 3.5);
            let (v, w) = (self.fastest, self.turn);
            self.target = match layout {
                Layout::Tricycle | Layout::Car => [s.uniform(-0.5, 1.0) * v, 0.0, s.uniform(-0.5, 0.5)],
                Layout::Differential | Layout::SixWheel => [s.uniform(-0.6, 1.0) * v, 0.0, s.uniform(-1.0, 1.0) * w],
                Layout::Omni3 | Layout::Omni4 | Layout::Mecanum4 => {
                    [s.uniform(-1.0, 1.0) * v, s.uniform(-1.0, 1.0) * v, s.uniform(-1.0, 1.0) * w]
                }
            };
        }
        let keep = (-row / 0.25).exp();
        for axis in 0..3 {
            self.first[axis] = self.target[axis] + keep * (self.first[axis] - self.target[axis]);
            self.now[axis] = self.first[axis] + keep * (self.now[axis] - self.first[axis]);
        }
        self.now
    }
}

/// A robot before something begins, and after it.
#[derive(Clone, Copy)]
pub(super) struct Lasting<'a> {
    pub(super) before: &'a Robot,
    pub(super) after: &'a Robot,
    /// Share of the recording before it.
    pub(super) share: f64,
}

/// Rows as sensors show them: time, torques, steering, speeds, yaw rate, pose; and when the robot changes, s.
pub(super) fn sheet(layout: Layout, stated: &Robot, robot: Lasting<'_>, s: &mut Stream) -> (String, f64) {
    let seconds = s.uniform(SECONDS[0], SECONDS[1]);
    let row = [0.01, 0.02][s.index(2)];
    let noise = [s.uniform(0.005, 0.03), s.uniform(0.002, 0.006), s.uniform(0.0003, 0.002)];
    let bias = s.normal(0.003);
    let mut wanted = Wanted {
        until: 0.0,
        target: [0.0; 3],
        first: [0.0; 3],
        now: [0.0; 3],
        fastest: s.uniform(0.6, 1.2),
        turn: s.uniform(0.8, 1.5),
    };
    let begins = robot.share * seconds;
    let mut state: State = robot.after.at_rest();
    let mut sums = vec![0.0; stated.motors.len()];
    let per_motor = stated.mass / stated.motors.len() as f64;
    let mut out = header(layout, stated);
    let substeps = (row / STEP).round() as usize;
    for k in 0..(seconds / row) as usize {
        let time = row * k as f64;
        let now = wanted.next(layout, time, row, s);
        let steering = if layout.is_steered() { now[2] } else { 0.0 };
        let twist = if layout.is_steered() { [now[0], 0.0, now[0] * steering.tan() / stated.steered_at] } else { now };
        let torques: Vec<f64> = (0..stated.motors.len())
            .map(|motor| {
                let of = stated.wheels.iter().enumerate().filter(|(_, w)| w.motor == Some(motor));
                let gaps: Vec<f64> = of.map(|(i, w)| rolling(stated, w, steering, twist) - state.spin[i]).collect();
                let gap = gaps.iter().sum::<f64>() / gaps.len() as f64;
                let inertia = per_motor * stated.wheels[0].radius.powi(2);
                sums[motor] += row * gap;
                inertia * (3.0 * gap + 4.0 * sums[motor])
            })
            .collect();
        let _ = write!(out, "{time:.3}");
        for torque in &torques {
            let _ = write!(out, ",{torque:.5}");
        }
        if layout.is_steered() {
            let _ = write!(out, ",{:.5}", steering + s.normal(0.001));
        }
        for i in measured(layout) {
            let _ = write!(out, ",{:.5}", state.spin[i] + s.normal(noise[0]));
        }
        let _ = write!(out, ",{:.5}", state.rate + bias + s.normal(noise[1]));
        let [x, y] = state.place.map(|v| v + s.normal(noise[2]));
        let yaw = (state.yaw + s.normal(noise[2]) + PI).rem_euclid(TAU) - PI;
        let _ = writeln!(out, ",{x:.5},{y:.5},{yaw:.5}");
        for _ in 0..substeps {
            let now = if time < begins { robot.before } else { robot.after };
            now.step(&mut state, &torques, steering, STEP);
        }
    }
    (out, begins)
}

/// Speed at which a wheel rolls under a motion of the body.
fn rolling(robot: &Robot, wheel: &Wheel, steering: f64, [vx, vy, rate]: [f64; 3]) -> f64 {
    let v = [vx - rate * wheel.place[1], vy + rate * wheel.place[0]];
    let (axis, at) = (robot.axis(wheel, steering), robot.direction(wheel, steering));
    (v[0] * axis[0] + v[1] * axis[1]) / (wheel.radius * (axis[0] * at.cos() + axis[1] * at.sin()))
}

fn header(layout: Layout, stated: &Robot) -> String {
    let mut out = "time_s".to_owned();
    for motor in &stated.motors {
        let _ = write!(out, ",torque_{}", column(&motor.name));
    }
    out += if layout.is_steered() { ",steer_rad" } else { "" };
    for i in measured(layout) {
        let _ = write!(out, ",speed_{}", column(&stated.wheels[i].name));
    }
    out += ",gyro_z,x_m,y_m,yaw_rad\n";
    out
}

/// Wheels whose speed is recorded.
pub(super) fn measured(layout: Layout) -> Vec<usize> {
    match layout {
        Layout::Tricycle => vec![0],
        Layout::Car | Layout::SixWheel => vec![2, 3],
        Layout::Differential => vec![0, 1],
        Layout::Omni3 => (0..3).collect(),
        Layout::Omni4 | Layout::Mecanum4 => (0..4).collect(),
    }
}

pub(super) fn column(name: &str) -> String {
    name.replace(' ', "_")
}
