//! The outer loop: from the error of the pose to a speed and a yaw rate.

use nn_basis::Scalar;

use crate::Reference;

/// A pose in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<T> {
    /// Position, m.
    pub x: T,
    /// Position, m.
    pub y: T,
    /// Heading, rad, not wrapped.
    pub yaw: T,
}

/// What the body shall do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Command<T> {
    /// Speed v_c, m/s.
    pub speed: T,
    /// Yaw rate ω_c, rad/s.
    pub yaw_rate: T,
}

/// Kanayama's law: `v_c = v_d cos e3 + k_x e1`, `ω_c = ω_d + k_y v_d e2 + k_φ sin e3`.
///
/// (e1, e2) is the position error in body axes and e3 the heading error. With ideal wheels
/// `V = ½(e1² + e2²) + (1 − cos e3)/k_y` obeys `dV/dt = −k_x e1² − (k_φ/k_y) sin² e3`.
/// Source: Kanayama et al. 1990.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematic<T> {
    /// Gain along the path k_x, 1/s.
    pub kx: T,
    /// Gain across the path k_y, 1/m².
    pub ky: T,
    /// Gain of the heading k_φ, 1/s.
    pub k_yaw: T,
}

impl<T: Scalar> Kinematic<T> {
    /// The command for a pose and a reference.
    #[inline(always)]
    pub fn command(&self, pose: &Pose<T>, reference: &Reference<T>) -> Command<T> {
        let (dx, dy) = (reference.x - pose.x, reference.y - pose.y);
        let (sin, cos) = pose.yaw.sin_cos();
        let (e1, e2) = (cos * dx + sin * dy, cos * dy - sin * dx);
        let (sin3, cos3) = (reference.yaw - pose.yaw).sin_cos();
        Command {
            speed: reference.speed * cos3 + self.kx * e1,
            yaw_rate: reference.yaw_rate + self.ky * reference.speed * e2 + self.k_yaw * sin3,
        }
    }
}
