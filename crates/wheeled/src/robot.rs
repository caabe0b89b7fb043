//! A robot as its owner states it.

use robot_model::wheels::{Robot, Wheel};

use crate::settings::SETTINGS;

/// How well the owner knows the robot: one sigma each.
#[derive(Debug, Clone, PartialEq)]
pub struct Sigmas {
    /// Mass, relative.
    pub mass: f64,
    /// Place of the centre of mass, m.
    pub com: f64,
    /// Yaw inertia, relative.
    pub yaw_inertia: f64,
    /// Radius of each wheel, relative.
    pub radius: Vec<f64>,
    /// Distances of wheels from the origin, relative.
    pub place: f64,
    /// Direction of a wheel, rad.
    pub direction: f64,
    /// Dry friction of each motor, N m.
    pub coulomb: Vec<f64>,
    /// Viscous friction of each motor, N m s/rad.
    pub viscous: Vec<f64>,
    /// Torque over what is recorded, relative.
    pub gain: f64,
    /// Lag of motors, s.
    pub lag: f64,
    /// Zero of a steering joint, rad.
    pub steering: f64,
    /// Angle over what is recorded, relative.
    pub steering_gain: f64,
    /// Drag over the square of the speed, N s²/m².
    pub drag: f64,
    /// Rolling resistance.
    pub rolling: f64,
    /// Rolling resistance of casters.
    pub caster_rolling: f64,
    /// Slip at the peak, relative.
    pub slip: f64,
    /// Friction coefficient of the ground, relative.
    pub grip: f64,
    /// Slope, rad.
    pub slope: f64,
    /// Direction of the tracked axes, rad.
    pub pose_direction: f64,
    /// Place of the tracked point, m.
    pub pose_origin: f64,
}

/// A robot of any wheels with the names of its parts.
#[derive(Debug, Clone, PartialEq)]
pub struct AnyWheels {
    /// Its name.
    pub name: String,
    /// Its plant.
    pub plant: Robot<f64>,
    /// Names of its wheels, in the order of the plant.
    pub wheels: Vec<String>,
    /// Names of its motors.
    pub motors: Vec<String>,
    /// Names of its steering joints.
    pub joints: Vec<String>,
    /// Wheels whose turning is recorded.
    pub measured: Vec<usize>,
    /// Tracked point: x, y, m, and direction of its axes, rad.
    pub point: [f64; 3],
    /// How well it is known.
    pub sigmas: Sigmas,
}

impl AnyWheels {
    /// A torque at a wheel that is a fair part of what moves the robot: a share of its weight at a wheel's radius, N m.
    pub(crate) fn torque_scale(&self) -> f64 {
        let radius = self.plant.wheels.iter().flatten().map(|w| w.radius).fold(0.0, f64::max);
        let motors = self.motors.len().max(1) as f64;
        SETTINGS.known.push * self.weight() * radius / motors
    }

    /// Weight, N.
    pub(crate) fn weight(&self) -> f64 {
        self.plant.mass * self.plant.ground.gravity
    }

    /// The same over the wheel speed of a walking pace, N m s/rad.
    pub(crate) fn viscous_scale(&self) -> f64 {
        let radius = self.plant.wheels.iter().flatten().map(|w| w.radius).fold(f64::INFINITY, f64::min);
        self.torque_scale() * radius / SETTINGS.known.pace
    }

    /// Whether fixed wheels without rollers stand behind each other: turning then makes them skid.
    pub(crate) fn skids(&self) -> bool {
        let is_fixed = |w: &&Wheel<f64>| w.joint.is_none() && w.roller.is_none();
        let along = || self.plant.wheels.iter().flatten().filter(is_fixed).map(|w| w.place[0]);
        along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min) > SETTINGS.known.com * self.size()
    }

    /// The largest yaw inertia that is believed: of all the mass at half the longest distance of two contacts, or more than is stated by a
    /// share, as of a robot that juts out beyond its wheels, kg m². Where fixed wheels skid, laws of tyres that are not quite those of the
    /// robot turn it as a far larger one would.
    pub(crate) fn largest_yaw_inertia(&self) -> f64 {
        let plant = &self.plant;
        (plant.mass * (0.5 * self.size()).powi(2)).max((1.0 + SETTINGS.usual.yaw_inertia) * plant.yaw_inertia)
    }

    /// Longest distance between two contacts, m.
    pub(crate) fn size(&self) -> f64 {
        let of = |a: [f64; 2]| self.plant.contacts().map(move |b| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
        self.plant.contacts().map(of).fold(0.0, f64::max)
    }
}
