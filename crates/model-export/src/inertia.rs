//! Masses and inertias of the parts, which sum up to those of the robot.

use crate::contact::{motors, wheels};
use crate::vehicle::Vehicle;

/// Roll and pitch inertia over yaw inertia of chassis and load. A planar robot does not know them; they decide how fast
/// loads move between wheels, not how much. Above one half, as every body must be.
pub(crate) const FLAT: f64 = 0.6;
/// A wheel's inertia across its axle over that about it: one half of a thin disc, more with its width.
pub(crate) const ACROSS: f64 = 0.55;
/// Largest share of the robot's mass in a wheel.
pub(crate) const HEAVIEST: f64 = 0.05;
/// Least share of the yaw inertia that must be left to the chassis.
pub(crate) const LEFT: f64 = 0.3;

/// A rigid part: mass, centre in the robot's frame, inertia about it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Part {
    pub(crate) mass: f64,
    pub(crate) centre: [f64; 3],
    pub(crate) inertia: [f64; 3],
}

/// The parts of a robot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parts {
    pub(crate) chassis: Part,
    /// As [`names`](crate::contact::names); casters weigh nothing.
    pub(crate) wheels: [Part; 4],
    pub(crate) payload: Option<Part>,
}

impl Parts {
    /// Wheels are solid discs by their inertia about the axle, unless that makes them too heavy for the robot.
    ///
    /// Where joints have no rotor, the wheels that motors turn have these' inertia: `rotor_in_wheel`.
    pub(crate) fn new(v: &Vehicle, rotor_in_wheel: bool) -> Self {
        let r = &v.robot;
        let rotor = if rotor_in_wheel { r.motor_inertia } else { 0.0 };
        let disc = 2.0 * r.wheel_inertia / (r.wheel_radius * r.wheel_radius);
        let mut wheel = disc.min(HEAVIEST * r.mass);
        loop {
            let parts = Self::with_wheels_of(v, wheel, rotor);
            let fits = parts.chassis.inertia[2] > LEFT * r.yaw_inertia && parts.chassis.centre[2] > 0.0;
            if fits || wheel < 1e-6 * r.mass {
                return parts;
            }
            wheel *= 0.5;
        }
    }

    fn with_wheels_of(v: &Vehicle, mass: f64, rotor: f64) -> Self {
        let r = &v.robot;
        let (contacts, turning) = (r.contacts(), wheels(r));
        let wheels = std::array::from_fn(|i| {
            let [x, y] = contacts[i];
            let centre = [x, y, r.wheel_radius];
            if !turning.contains(&i) {
                return Part { mass: 0.0, centre, inertia: [0.0; 3] };
            }
            let spin = r.wheel_inertia + motors(r)[i] * rotor;
            let across = ACROSS * spin;
            Part { mass, centre, inertia: [across, spin, across] }
        });
        let payload = v.payload.map(|p| Part {
            mass: p.mass,
            centre: [r.com[0], r.com[1], p.height],
            inertia: [FLAT, FLAT, 1.0].map(|k| k * p.yaw_inertia),
        });
        let chassis = rest((r.mass, r.com, r.yaw_inertia), wheels.iter().chain(&payload));
        Self { chassis, wheels, payload }
    }

    pub(crate) fn all(&self) -> impl Iterator<Item = &Part> + Clone {
        std::iter::once(&self.chassis).chain(&self.wheels).chain(&self.payload)
    }

    /// Mass, centre of mass, and inertia about it.
    pub(crate) fn total(&self) -> Part {
        together(&self.all())
    }
}

/// Parts as one: mass, centre of mass, and inertia about it.
pub(crate) fn together<'a>(all: &(impl Iterator<Item = &'a Part> + Clone)) -> Part {
    let mass: f64 = all.clone().map(|p| p.mass).sum();
    let centre: [f64; 3] = std::array::from_fn(|k| all.clone().map(|p| p.mass * p.centre[k]).sum::<f64>() / mass);
    let inertia = std::array::from_fn(|k| {
        let (m, n) = ((k + 1) % 3, (k + 2) % 3);
        let arm2 = |p: &Part| (p.centre[m] - centre[m]).powi(2) + (p.centre[n] - centre[n]).powi(2);
        all.clone().map(|p| p.inertia[k] + p.mass * arm2(p)).sum()
    });
    Part { mass, centre, inertia }
}

/// What is left of a robot of this mass, centre of mass and yaw inertia beside parts of it.
pub(crate) fn rest<'a>(whole: (f64, [f64; 3], f64), others: impl Iterator<Item = &'a Part> + Clone) -> Part {
    let (whole_mass, com, whole_yaw) = whole;
    let mass = whole_mass - others.clone().map(|p| p.mass).sum::<f64>();
    let centre: [f64; 3] = std::array::from_fn(|k| {
        (whole_mass * com[k] - others.clone().map(|p| p.mass * p.centre[k]).sum::<f64>()) / mass
    });
    let apart = |p: &[f64; 3]| (p[0] - com[0]).powi(2) + (p[1] - com[1]).powi(2);
    let taken: f64 = others.map(|p| p.inertia[2] + p.mass * apart(&p.centre)).sum();
    let yaw = whole_yaw - taken - mass * apart(&centre);
    Part { mass, centre, inertia: [FLAT, FLAT, 1.0].map(|k| k * yaw) }
}
