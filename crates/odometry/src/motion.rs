//! The pose that the wheels' motion implies, with the laws of slip and of the pose's frame.
//!
//! With the motion `(x, y, t)` of a row from [`Kinematics`](crate::kinematics), rates `v`, `w` = ω of the body about that
//! row, and `a = (−v_y ω, v_x ω)` its acceleration in curves:
//!
//! * wheels: a wheel that rolls at `u` keeps the share `exp(−wheel_slip |u|)` of its way, before all others;
//! * way: `x, y ← (1 − turn_slip g/(1 + g)) exp(−(speed_slip − wheel_slip) |v|) (x, (1 − roller_slip) y)`,
//!   `g = (|ω|/turn_slip_rate)^turn_slip_power`: dry friction does not grow with the rate, and from which rate on it is whole, and
//!   how soon, depends on the ground; `speed_slip` is so all that is lost in straight driving. The exponential lies between slip as
//!   a share of the wheels' motion and of the body's;
//! * sideslip: `(x, y) ← (x, y) − sideslip a dt`;
//! * turning: `t ← (1 − rate_slip |ω|) exp(−speed_turn_slip |v|) t − (cornering_forward v_x + cornering_sideways v_y) ω dt`;
//! * gyro, where it stands for the pose: it shows the heading `scale ψ + bias t`;
//! * frame: the pose's x axis points `mounting` from the robot's, its origin stands at `origin`.

use crate::constants::{ClockZero, Quantity};
use crate::drive::Drive;
use crate::kinematics::{Geometry, Kinematics};
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;

/// A gyro that shows turning as it is.
const RIGHT_GYRO: [f64; 2] = [1.0, 0.0];

/// All numbers of which the pose depends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Laws {
    pub(crate) geometry: Geometry,
    pub(crate) mounting: f64,
    pub(crate) origin: [f64; 2],
    pub(crate) roller_slip: f64,
    pub(crate) turn_slip: f64,
    pub(crate) turn_slip_rate: f64,
    pub(crate) turn_slip_power: f64,
    pub(crate) rate_slip: f64,
    pub(crate) speed_slip: f64,
    pub(crate) speed_turn_slip: f64,
    pub(crate) wheel_slip: f64,
    pub(crate) sideslip: f64,
    pub(crate) cornering: [f64; 2],
    pub(crate) clock: [f64; 2],
    pub(crate) clock_zero: ClockZero,
    /// Factor by which a gyro shows turning, and what it shows at rest, rad/s.
    pub(crate) gyro: [f64; 2],
}

impl Laws {
    /// As the robot file has it: no slip, clocks right, the pose that of the origin.
    pub(crate) fn given(robot: &WheeledRobot) -> Self {
        Self {
            geometry: Geometry::given(robot),
            mounting: 0.0,
            origin: [0.0; 2],
            roller_slip: 0.0,
            turn_slip: 0.0,
            turn_slip_rate: SETTINGS.slip.turning,
            turn_slip_power: 1.0,
            rate_slip: 0.0,
            speed_slip: 0.0,
            speed_turn_slip: 0.0,
            wheel_slip: 0.0,
            sideslip: 0.0,
            cornering: [0.0; 2],
            clock: [0.0; 2],
            clock_zero: ClockZero::Middle,
            gyro: RIGHT_GYRO,
        }
    }

    /// The same of a body as it moves, and not as a gyro shows it.
    pub(crate) fn of_body(&self) -> Self {
        Self { gyro: RIGHT_GYRO, ..self.clone() }
    }

    /// The same with these constants at these values.
    pub(crate) fn with(&self, values: &[(Quantity, f64)]) -> Self {
        let mut out = self.clone();
        for &(quantity, value) in values {
            let geometry = &mut out.geometry;
            match quantity {
                Quantity::Radius(k) => geometry.radius[k] = value.exp(),
                Quantity::Direction(k) => geometry.direction[k] = value,
                Quantity::Across => geometry.across = value.exp(),
                Quantity::Along => geometry.along = value.exp(),
                Quantity::Reach => (geometry.across, geometry.along) = (value.exp(), value.exp()),
                Quantity::SteeringOffset => geometry.steering_offset = value,
                Quantity::SteeringGain => geometry.steering_gain = value.exp(),
                Quantity::Mounting => out.mounting = value,
                Quantity::OriginX => out.origin[0] = value,
                Quantity::OriginY => out.origin[1] = value,
                Quantity::RollerSlip => out.roller_slip = value,
                Quantity::TurnSlip => out.turn_slip = value,
                Quantity::TurnSlipRate => out.turn_slip_rate = SETTINGS.slip.turning * value.exp(),
                Quantity::TurnSlipPower => out.turn_slip_power = value.exp(),
                Quantity::RateSlip => out.rate_slip = value,
                Quantity::SpeedSlip => out.speed_slip = value,
                Quantity::SpeedTurnSlip => out.speed_turn_slip = value,
                Quantity::WheelSpeedSlip => out.wheel_slip = value,
                Quantity::Sideslip => out.sideslip = value,
                Quantity::CorneringForward => out.cornering[0] = value,
                Quantity::CorneringSideways => out.cornering[1] = value,
                Quantity::ClockOffset => out.clock[0] = value,
                Quantity::ClockRate(zero) => (out.clock[1], out.clock_zero) = (value, zero),
                Quantity::GyroScale => out.gyro[0] = value.exp(),
                Quantity::GyroBias => out.gyro[1] = value,
            }
        }
        out
    }
}

/// The pose that the wheels' motion implies in each row of a drive, from the origin on.
pub(crate) fn implied(robot: &WheeledRobot, drive: &Drive, laws: &Laws) -> Vec<[f64; 3]> {
    let kinematics = Kinematics::new(robot, &laws.geometry);
    let rows = drive.time.len();
    let steering = |row: usize| drive.steering.as_ref().map_or(0.0, |s| s[row]);
    let own = if laws.wheel_slip == 0.0 { Vec::new() } else { kept_by_wheels(robot, drive, laws.wheel_slip) };
    let mut turned = Vec::new();
    let mut rolled = vec![[0.0; 3]; rows];
    for row in 1..rows {
        let turns = &drive.turns[row];
        turned.clear();
        turned.extend(
            turns
                .iter()
                .enumerate()
                .map(|(k, turn)| own.get(turns.len() * row + k).map_or(*turn, |share| share * turn)),
        );
        rolled[row] = kinematics.motion(&turned, steering(row));
    }

    let rates = drive.rates(|row| rolled[row]);
    let mut pose = [0.0; 3];
    let mut path = Vec::with_capacity(rows);
    path.push(pose);
    for row in 1..rows {
        let step = slipped(laws, rolled[row], rates[row], drive.time[row] - drive.time[row - 1]);
        pose = moved(pose, framed(laws, step));
        path.push(pose);
    }
    if laws.clock != [0.0; 2] {
        path = drive.at_shifted_clock(&path, laws.clock, laws.clock_zero);
    }
    if drive.heading_only && laws.gyro != RIGHT_GYRO {
        let [scale, bias] = laws.gyro;
        for (pose, time) in path.iter_mut().zip(&drive.time) {
            pose[2] = scale * pose[2] + bias * (time - drive.time[0]);
        }
    }
    path
}

/// The shares of their turns that the wheels keep by their own speed, row by row.
fn kept_by_wheels(robot: &WheeledRobot, drive: &Drive, slip: f64) -> Vec<f64> {
    let measured = robot.measured();
    let wheels = measured.len();
    let mut out = vec![1.0; wheels * drive.time.len()];
    for (k, &wheel) in measured.iter().enumerate() {
        let slip = slip * robot.wheels[wheel].radius;
        let rates = drive.rates(|row| [drive.turns[row][k]]);
        for (row, [rate]) in rates.into_iter().enumerate() {
            out[wheels * row + k] = falling(slip * rate.abs());
        }
    }
    out
}

/// `exp(−x)` of small `x`, to the third order.
fn falling(x: f64) -> f64 {
    (2.0 - x) / (2.0 + x)
}

/// A row's motion less its slip.
fn slipped(laws: &Laws, [x, y, t]: [f64; 3], [vx, vy, turning]: [f64; 3], dt: f64) -> [f64; 3] {
    let rate = turning.abs();
    let grown = (rate / laws.turn_slip_rate).powf(laws.turn_slip_power);
    let speed = vx.hypot(vy);
    let kept = (1.0 - laws.turn_slip * grown / (1.0 + grown)) * falling((laws.speed_slip - laws.wheel_slip) * speed);
    let curved = turning * dt;
    let [forward, sideways] = laws.cornering;
    [
        kept * x + laws.sideslip * vy * curved,
        kept * (1.0 - laws.roller_slip) * y - laws.sideslip * vx * curved,
        (1.0 - laws.rate_slip * rate) * falling(laws.speed_turn_slip * speed) * t
            - (forward * vx + sideways * vy) * curved,
    ]
}

/// A row's motion as the frame of the pose sees it.
fn framed(laws: &Laws, [x, y, t]: [f64; 3]) -> [f64; 3] {
    let [x, y] = [x - laws.origin[1] * t, y + laws.origin[0] * t];
    let (sin, cos) = laws.mounting.sin_cos();
    [cos * x + sin * y, cos * y - sin * x, t]
}

/// A motion that the frame of the pose sees, as the robot's: the inverse of [`framed`].
pub(crate) fn of_robot(laws: &Laws, [x, y, t]: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = laws.mounting.sin_cos();
    let [x, y] = [cos * x - sin * y, cos * y + sin * x];
    [x + laws.origin[1] * t, y - laws.origin[0] * t, t]
}

/// A pose after a motion in its own frame on a circle: `x, y` are lengths along the arc.
fn moved([px, py, yaw]: [f64; 3], [x, y, t]: [f64; 3]) -> [f64; 3] {
    let half = 0.5 * t;
    let chord = if half.abs() < 1e-6 { 1.0 } else { half.sin() / half };
    let (sin, cos) = (yaw + half).sin_cos();
    [px + chord * (cos * x - sin * y), py + chord * (sin * x + cos * y), yaw + t]
}

/// Pose `to` as seen from pose `from`.
pub(crate) fn relative(from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = from[2].sin_cos();
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    [cos * dx + sin * dy, cos * dy - sin * dx, to[2] - from[2]]
}

/// A pose after the motion between two others.
pub(crate) fn moved_on(pose: [f64; 3], from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    placed(pose, relative(from, to))
}

/// The pose that is seen from pose `from` as `seen`: the inverse of [`relative`].
pub(crate) fn placed([x, y, yaw]: [f64; 3], seen: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = yaw.sin_cos();
    [x + cos * seen[0] - sin * seen[1], y + sin * seen[0] + cos * seen[1], yaw + seen[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_from_a_pose_is_where_it_was() {
        let (from, to) = ([1.0, -2.0, 0.7], [0.3, 4.0, -1.9]);
        for (a, b) in placed(from, relative(from, to)).into_iter().zip(to) {
            approx::assert_relative_eq!(a, b, epsilon = 1e-12);
        }
    }
}
