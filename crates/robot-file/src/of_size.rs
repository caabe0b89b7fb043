//! A robot of which only size and mass are known.

use std::collections::BTreeMap;

use inference::KnownEffects;
use robot_model::tunable::{USUAL_POSE_SIGMA, usual_sigma};
use robot_model::{Chassis, ModelError, Robot};

use crate::keys::USUAL_GEOMETRY_SIGMA;
use crate::{Causality, RobotSpec};

/// Height of the centre of mass, wheel radii above the ground (guess: batteries lie at the axles, sensors above).
const COM_HEIGHT: f64 = 1.2;
/// Mass of the four wheels, share of the robot's (guess; that of the open Husky is 14 %).
const WHEELS: f64 = 0.1;
/// Adhesion of rubber on indoor floors (textbook value).
const ADHESION: f64 = 0.7;
/// Rolling resistance of wheels on hard ground (textbook value).
const ROLLING: f64 = 0.03;
/// Dry friction of a side's drivetrain, share of weight times wheel radius (guess; that of the open Husky is 2.5 %).
const COULOMB: f64 = 0.02;
/// Viscous friction of a side's drivetrain, share of weight times wheel radius, s (guess).
const VISCOUS: f64 = 0.002;
/// Inertia of the motors of a side, share of that of the body about the contact of a wheel (guess).
const MOTORS: f64 = 0.05;

/// Where the centre of mass is on the way from the driven axle to the middle of what holds a robot up (guess).
const TOWARDS_CASTERS: f64 = 0.5;

/// Size and mass of a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// kg.
    pub mass: f64,
    /// m.
    pub wheel_radius: f64,
    /// Between the middles of the wheels of both sides, m.
    pub track: f64,
    /// What it stands on.
    pub stands: Stands,
}

/// What a robot stands on, as a tape measures it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stands {
    /// Four wheels: the distance between their axles, m.
    Axles(f64),
    /// Two wheels and casters: where their pivots are from the middle of the axle, ahead and to the left, m. One stands twice.
    Casters([[f64; 2]; 2]),
}

impl Stands {
    fn chassis(self) -> Chassis {
        match self {
            Self::Axles(_) => Chassis::SkidSteer,
            Self::Casters(_) => Chassis::Differential,
        }
    }

    /// From the foremost to the rearmost of what holds it up, m.
    pub fn length(self) -> f64 {
        match self {
            Self::Axles(wheelbase) => wheelbase,
            Self::Casters([[first, _], [second, _]]) => first.max(second).max(0.0) - first.min(second).min(0.0),
        }
    }

    /// Where the middle of its length is, ahead of its geometric centre, m.
    fn middle(self) -> f64 {
        match self {
            Self::Axles(_) => 0.0,
            Self::Casters([[first, _], [second, _]]) => 0.5 * (first.max(second).max(0.0) + first.min(second).min(0.0)),
        }
    }

    fn constants(self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Axles(wheelbase) => vec![("wheelbase", wheelbase)],
            Self::Casters([[x, y], [second_x, second_y]]) => {
                vec![("caster_x", x), ("caster_y", y), ("second_caster_x", second_x), ("second_caster_y", second_y)]
            }
        }
    }
}

impl RobotSpec {
    /// A torque-driven robot of this size; its other constants are those of a usual one: a box on its wheels. To start a fit
    /// from, for the sources of all of them say "guess".
    ///
    /// # Errors
    /// A size that no robot can have.
    pub fn of_size(name: &str, size: &Size) -> Result<Self, ModelError> {
        let Size { mass, wheel_radius, track, stands } = *size;
        let length = stands.length() + 2.0 * wheel_radius;
        let lever = wheel_radius * mass * 9.81;
        let mut constants = vec![
            ("mass", mass),
            ("yaw_inertia", mass * (length * length + track * track) / 12.0),
            ("com_height", COM_HEIGHT * wheel_radius),
            ("track", track),
            ("wheel_radius", wheel_radius),
            ("wheel_inertia", 0.5 * 0.25 * WHEELS * mass * wheel_radius * wheel_radius),
            ("motor_inertia", MOTORS * mass * wheel_radius * wheel_radius),
            ("adhesion", ADHESION),
            ("rolling_resistance", ROLLING),
            ("coulomb", COULOMB * lever),
            ("viscous", VISCOUS * lever),
        ];
        constants.extend(stands.constants());
        // Most of the weight is on the driven wheels.
        constants.push(("com_x", TOWARDS_CASTERS * stands.middle()));
        let robot = Robot::on_chassis(stands.chassis(), &constants)?;
        Ok(Self {
            name: name.to_owned(),
            description: None,
            causality: Causality::TorqueDriven,
            robot,
            is_chassis_stated: false,
            effects: Vec::new(),
            known: KnownEffects::default(),
            response: None,
            sources: BTreeMap::new(),
            sigma: usual_sigma(),
            pose_sigma: USUAL_POSE_SIGMA,
            torque_per_current: None,
            geometry_sigma: [USUAL_GEOMETRY_SIGMA; 2],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_of_a_size_can_be_written_and_read_and_one_without_mass_is_refused() {
        let size = Size { mass: 20.0, wheel_radius: 0.1, track: 0.4, stands: Stands::Axles(0.36) };
        let spec = RobotSpec::of_size("mine", &size).expect("a robot");
        let read = RobotSpec::parse("mine.toml", &spec.to_toml().expect("written")).expect("read");
        assert_eq!((read.robot.mass, read.robot.half_track, read.name.as_str()), (20.0, 0.2, "mine"));
        assert!(RobotSpec::of_size("none", &Size { mass: 0.0, ..size }).is_err());

        let on_casters = Size { stands: Stands::Casters([[-0.2, 0.1], [-0.2, -0.1]]), ..size };
        let spec = RobotSpec::of_size("mine", &on_casters).expect("a robot");
        let read = RobotSpec::parse("mine.toml", &spec.to_toml().expect("written")).expect("read");
        assert_eq!((read.robot.chassis, read.robot.casters), (Chassis::Differential, [[-0.2, 0.1], [-0.2, -0.1]]));
        assert!((read.robot.com[0] + 0.05).abs() < 1e-12 && (read.robot.half_wheelbase - 0.1).abs() < 1e-12);
    }
}
