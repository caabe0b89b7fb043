//! A robot as its owner states it.

use robot_model::wheels::Robot;

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
