//! What the ground does to each wheel, in the numbers that engines take.

use std::ops::Range;

use robot_model::{Chassis, Robot};

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

/// The four wheels; or casters and two wheels, casters as spheres that slide as hard as they roll.
pub(crate) fn grips(v: &Vehicle) -> [Grip; 4] {
    let (r, w) = (&v.robot, &v.coefficients);
    let stance = r.stance();
    let wheels = wheels(r);
    // Every wheel of a side bears its share of that side's friction.
    let part = 2.0 / wheels.len() as f64;
    std::array::from_fn(|i| {
        let even = stance.static_load[i];
        if !wheels.contains(&i) {
            let (load, slides) = (even.max(0.0), w.rolling[i]);
            let grip = Grip {
                load,
                friction: [slides; 2],
                compliance: 0.0,
                adhesion: slides,
                slip_at_peak: 1.0,
                dry: 0.0,
                viscous: 0.0,
            };
            return grip;
        }
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
            dry: (part * w.coulomb[i % 2] + w.rolling[i] * load * w.radius[i]).max(0.0),
            viscous: part * w.viscous[i % 2],
        }
    })
}

/// Which contacts are wheels: the others are casters.
pub(crate) fn wheels(robot: &Robot<f64>) -> Range<usize> {
    match robot.chassis {
        Chassis::SkidSteer | Chassis::FourMotors => 0..4,
        Chassis::Differential => 2..4,
    }
}

/// Which contacts are casters: one that counts as two stands once.
pub(crate) fn casters(robot: &Robot<f64>) -> Range<usize> {
    match robot.chassis {
        Chassis::SkidSteer | Chassis::FourMotors => 0..0,
        Chassis::Differential if robot.casters[0] == robot.casters[1] => 0..1,
        Chassis::Differential => 0..2,
    }
}

/// Names of the contacts; the last two are wheels on any chassis.
pub(crate) const fn names(robot: &Robot<f64>) -> [&'static str; 4] {
    match robot.chassis {
        Chassis::SkidSteer | Chassis::FourMotors => ["front_left", "front_right", "rear_left", "rear_right"],
        Chassis::Differential => ["caster_1", "caster_2", "left_wheel", "right_wheel"],
    }
}

/// Share of its side's motors that turns each contact.
pub(crate) const fn motors(robot: &Robot<f64>) -> [f64; 4] {
    match robot.chassis {
        Chassis::SkidSteer | Chassis::Differential => [0.0, 0.0, 1.0, 1.0],
        Chassis::FourMotors => [0.5; 4],
    }
}

/// Names of the wheels that the motors of a side turn, front to rear.
pub(crate) fn driven(robot: &Robot<f64>, side: usize) -> impl Iterator<Item = &'static str> {
    let (names, motors) = (names(robot), motors(robot));
    [side, side + 2].into_iter().filter(move |i| motors[*i] > 0.0).map(move |i| names[i])
}

/// Which joints take the torque of a side, for people.
pub(crate) const fn driven_wheels(robot: &Robot<f64>) -> &'static str {
    match robot.chassis {
        Chassis::SkidSteer => "The rear wheel joints take the torque of a side",
        Chassis::FourMotors => "Each wheel joint takes half of the torque of its side",
        Chassis::Differential => "The wheel joints take the torque of a side",
    }
}
/// Names of the sides.
pub(crate) const SIDES: [&str; 2] = ["left", "right"];
