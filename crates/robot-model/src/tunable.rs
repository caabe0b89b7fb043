//! The constants of a robot model that may be re-tuned: the nuisance parameters of a diagnosis.

use crate::robot::Robot;
use crate::scalar::{Scalar, real};

/// How a tuning acts on its constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tuning {
    /// Multiplies by `exp(δ)`.
    Factor,
    /// Adds `δ`.
    Offset,
}

/// One constant of a robot model that the user does not know exactly.
pub struct Tunable<T> {
    /// Identifier, as in robot files.
    pub id: &'static str,
    /// Factor or offset.
    pub tuning: Tuning,
    /// Unit of an offset; "-" of a factor.
    pub unit: &'static str,
    /// One sigma when the robot file says nothing: relative for a factor, in `unit` for an offset.
    pub sigma: f64,
    /// Applies the tuning `δ`.
    pub apply: Apply<T>,
}

/// Time constant below which a lag goes on as a lead, s.
const LEAST_LAG: f64 = 1e-3;

/// Number of tunable constants.
pub const COUNT: usize = 17;

/// Applies a tuning to a robot.
type Apply<T> = fn(&mut Robot<T>, T);

fn factor<T>(id: &'static str, sigma: f64, apply: Apply<T>) -> Tunable<T> {
    Tunable { id, tuning: Tuning::Factor, unit: "-", sigma, apply }
}

fn offset<T>(id: &'static str, unit: &'static str, sigma: f64, apply: Apply<T>) -> Tunable<T> {
    Tunable { id, tuning: Tuning::Offset, unit, sigma, apply }
}

/// All tunable constants.
///
/// The last three are model discrepancies: without them contact compliance reads as a motor lag, friction near rest
/// as stiction, and sliding wheels as other ground. The lag is an offset because as a factor it could absorb a true additional lag.
pub fn tunables<T: Scalar>() -> [Tunable<T>; COUNT] {
    [
        factor("adhesion", 0.10, |r, d| r.adhesion *= d.exp()),
        factor("slip_at_peak", 0.6, |r, d| r.slip_at_peak *= d.exp()),
        factor("rolling_resistance", 0.13, |r, d| r.rolling_resistance *= d.exp()),
        factor("coulomb_left", 0.14, |r, d| r.coulomb[0] *= d.exp()),
        factor("coulomb_right", 0.14, |r, d| r.coulomb[1] *= d.exp()),
        factor("viscous", 0.13, |r, d| {
            r.viscous[0] *= d.exp();
            r.viscous[1] *= d.exp();
        }),
        factor("yaw_inertia", 0.06, |r, d| r.yaw_inertia *= d.exp()),
        offset("com_x", "m", 0.004, |r, d| r.com[0] += d),
        offset("com_y", "m", 0.004, |r, d| r.com[1] += d),
        factor("lateral_factor", 0.15, |r, d| r.lateral_factor *= d.exp()),
        factor("motor_inertia", 0.06, |r, d| r.motor_inertia *= d.exp()),
        factor("torque_constant", 0.015, |r, d| r.drive.gain *= d.exp()),
        factor("mass", 0.01, |r, d| r.mass *= d.exp()),
        factor("com_height", 0.05, |r, d| r.com[2] *= d.exp()),
        offset("motor_lag", "s", 0.012, |r, d| {
            // Below zero a lag goes on as a lead: a small lag and a delay are the same to first order.
            let (lag, least) = (r.drive.lag + d, real(LEAST_LAG));
            r.drive.lag = lag.max(least);
            r.drive.delay += (lag - least).min(T::zero());
        }),
        offset("stribeck", "N m", 0.12, |r, d| r.stribeck += d),
        offset("sliding_share", "-", 0.1, |r, d| r.sliding_share = (r.sliding_share + d).max(T::zero()).min(real(1.3))),
    ]
}

/// One sigma of every tunable constant when nothing better is known.
pub fn usual_sigma() -> [f64; COUNT] {
    tunables::<f64>().map(|t| t.sigma)
}

/// The robot with its constants tuned by `theta`, in sigmas.
pub fn tuned(robot: &Robot<f64>, sigma: &[f64; COUNT], theta: &[f64; COUNT]) -> Robot<f64> {
    let mut out = *robot;
    for ((t, s), x) in tunables::<f64>().iter().zip(sigma).zip(theta) {
        (t.apply)(&mut out, s * x);
    }
    out
}
