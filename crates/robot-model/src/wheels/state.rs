//! What moves.

use crate::scalar::Scalar;
use crate::wheels::{MOST, MOST_CASTERS};

/// State of a robot of any wheels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<T> {
    /// Place of the robot's origin in the world, m.
    pub position: [T; 2],
    /// Cosine and sine of the heading.
    pub heading: [T; 2],
    /// Velocity of the centre of mass in body axes, m/s.
    pub velocity: [T; 2],
    /// Yaw rate, rad/s.
    pub yaw_rate: T,
    /// Speed of each wheel, rad/s.
    pub wheel_speed: [T; MOST],
    /// Angle that each wheel has turned by, rad.
    pub wheel_angle: [T; MOST],
    /// Angle of each caster's wheel in the body, rad.
    pub caster: [T; MOST_CASTERS],
    /// Torque of each motor after its lag, N m.
    pub torque: [T; MOST],
    /// Angle of each joint after its lag, rad.
    pub steering: [T; MOST],
    /// Acceleration of the contacts' forces over the mass, m/s²: what moves the loads.
    pub specific: [T; 2],
    /// Heading that the robot has turned by, rad.
    pub turned: T,
}

impl<T: Scalar> Default for State<T> {
    /// At rest at the origin.
    fn default() -> Self {
        let zero = T::zero();
        Self {
            position: [zero; 2],
            heading: [T::one(), zero],
            velocity: [zero; 2],
            yaw_rate: zero,
            wheel_speed: [zero; MOST],
            wheel_angle: [zero; MOST],
            caster: [zero; MOST_CASTERS],
            torque: [zero; MOST],
            steering: [zero; MOST],
            specific: [zero; 2],
            turned: zero,
        }
    }
}
