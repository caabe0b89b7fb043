//! The robot with its effects, sorted into what an engine holds and what must be added: all that writers read.

use robot_model::Robot;
use robot_model::effect::Coefficients;
use robot_model::effect::export::Section;

use crate::residual::Residual;

/// A belt that passes any torque has this limit or more, N m.
const ANY_TORQUE: f64 = 1e8;

/// All that the writers of models read.
pub(crate) struct Vehicle {
    /// Constants, effects included.
    pub(crate) robot: Robot<f64>,
    /// Ground and drivetrain with the effects that are always the same.
    pub(crate) coefficients: Coefficients<f64>,
    /// A load that is a body of its own; part of `robot` too.
    pub(crate) payload: Option<Payload>,
    /// How far the axle of each wheel is off its middle: cosine and sine, m.
    pub(crate) eccentric: [[f64; 2]; 4],
    /// Discs of other grip: x, y, radius, share of the adhesion that is left.
    pub(crate) patches: Vec<[f64; 4]>,
    /// Quadratic drag, N s²/m².
    pub(crate) drag: f64,
    pub(crate) sensors: Sensors,
    /// Where values come from.
    pub(crate) origins: Vec<(Section, String)>,
    /// What the engine does not hold.
    pub(crate) residuals: Vec<Residual>,
}

/// A load.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Payload {
    pub(crate) mass: f64,
    /// Height of its centre, m.
    pub(crate) height: f64,
    /// About the vertical through its centre, kg m².
    pub(crate) yaw_inertia: f64,
}

/// Faults of sensors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sensors {
    /// The accelerometer's x and y axis point up by, rad.
    pub(crate) up: [f64; 2],
    /// The accelerometer is turned to the left by, rad.
    pub(crate) left: f64,
    /// Shown over true wheel speed of each side.
    pub(crate) encoder: [f64; 2],
    /// Delay of the IMU and of the pose, s.
    pub(crate) late: [f64; 2],
    /// Constant error of the gyro, rad/s.
    pub(crate) gyro: f64,
    /// Constant error of the accelerometer, m/s².
    pub(crate) accel: [f64; 2],
}

impl Vehicle {
    /// Largest torque that a side's belt passes, if any is too much for it.
    pub(crate) fn belt(&self, side: usize) -> Option<f64> {
        Some(self.coefficients.belt_limit[side]).filter(|most| *most < ANY_TORQUE)
    }

    /// Gravity in the world, m/s²: along the slope and what is left of it downwards.
    pub(crate) fn gravity(&self) -> [f64; 3] {
        let [x, y] = self.coefficients.tilt;
        let g = self.robot.gravity;
        [x, y, -(g * g - x * x - y * y).max(0.0).sqrt()]
    }

    /// Comments for a section of the model.
    pub(crate) fn comments(&self, section: Section) -> impl Iterator<Item = String> + '_ {
        self.origins.iter().filter(move |(s, _)| *s == section).map(|(_, text)| text.clone())
    }
}
