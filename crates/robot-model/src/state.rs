//! The moving state of the robot.

use crate::scalar::Scalar;

/// The moving state of the robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<T> {
    /// Time since the start of the recording, s.
    pub time: T,
    /// Geometric centre on the ground, m.
    pub position: [T; 2],
    /// Cosine and sine of the yaw angle.
    pub heading: [T; 2],
    /// Velocity of the centre of mass in body axes, m/s.
    pub velocity: [T; 2],
    /// Yaw rate, rad/s.
    pub yaw_rate: T,
    /// Speed of the driven (rear) wheel of each side, rad/s.
    pub wheel_speed: [T; 2],
    /// What no motor turns: of four wheels, the speed of the belt-driven front wheel of each side, rad/s; of a robot on
    /// casters, the angle at which each rolls in the body, rad.
    pub passive: [T; 2],
    /// Angle of the driven wheel of each side, rad.
    pub wheel_angle: [T; 2],
    /// Torque after the current loop of each side, N m.
    pub torque: [T; 2],
    /// Torque after the second lag of each side, N m.
    pub lagged: [T; 2],
    /// Specific force at the centre of mass in body axes, m/s² (of the last step).
    pub specific: [T; 2],
    /// Rate of change of the body velocity and yaw rate in the last step.
    pub rate: [T; 3],
    /// Torque needed at each side's wheels in the last step, N m (speed-driven robots).
    pub needed: [T; 2],
}

impl<T: Scalar> Default for State<T> {
    /// At rest at the origin, heading along x.
    fn default() -> Self {
        let (o, oo) = (T::zero(), [T::zero(); 2]);
        Self {
            time: o,
            position: oo,
            heading: [T::one(), o],
            velocity: oo,
            yaw_rate: o,
            wheel_speed: oo,
            passive: oo,
            wheel_angle: oo,
            torque: oo,
            lagged: oo,
            specific: oo,
            rate: [o; 3],
            needed: oo,
        }
    }
}
