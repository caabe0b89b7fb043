//! What the ground does to each wheel, in the numbers that engines take.

use robot_model::contact::Stance;

use crate::vehicle::Vehicle;

/// A wheel on the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grip {
    /// Load at rest, N.
    pub(crate) load: f64,
    /// Friction along the axle and across it, per load at rest as if no diagonal carried more.
    pub(crate) friction: [f64; 2],
    /// Slip ratio per adhesion that is used, while little is: λp/(2 μ), the slope of Kiencke's law at zero.
    pub(crate) compliance: f64,
    /// Peak adhesion; the same without what limits traction and lateral grip.
    pub(crate) adhesion: f64,
    /// Slip ratio at the peak.
    pub(crate) slip_at_peak: f64,
    /// Torque of bearings and rolling resistance at rest, N m.
    pub(crate) dry: f64,
    /// Viscous friction, N m s/rad.
    pub(crate) viscous: f64,
}

/// The four wheels.
pub(crate) fn grips(v: &Vehicle) -> [Grip; 4] {
    let (r, w) = (&v.robot, &v.coefficients);
    let stance = Stance::new(r.mass, r.gravity, r.half_wheelbase, r.half_track, r.com);
    std::array::from_fn(|i| {
        let even = stance.static_load[i];
        let twist = if i == 0 || i == 3 { -w.twist } else { w.twist };
        let load = (even + twist).max(0.0);
        // Engines have one coefficient where the law has a peak and a share of it that remains: the middle of both. Where
        // a diagonal carries more, their rigid wheels would not: the coefficient stands for the load.
        let mu = w.adhesion[i] * 0.5 * (1.0 + r.sliding_share) * load / even;
        Grip {
            load,
            friction: [mu * w.lateral[i], mu * w.traction[i]],
            compliance: w.slip_at_peak[i] / (2.0 * w.adhesion[i].max(1e-3)),
            adhesion: w.adhesion[i],
            slip_at_peak: w.slip_at_peak[i],
            dry: (0.5 * w.coulomb[i % 2] + w.rolling[i] * load * w.radius[i]).max(0.0),
            viscous: 0.5 * w.viscous[i % 2],
        }
    })
}

/// Names of the wheels.
pub(crate) const WHEELS: [&str; 4] = ["front_left", "front_right", "rear_left", "rear_right"];
/// Names of the sides.
pub(crate) const SIDES: [&str; 2] = ["left", "right"];
