//! Robots from constants by their names.

use nalgebra::RealField;

use crate::chassis::Chassis;
use crate::constants::{NO_LIMIT, Usual};
use crate::error::ModelError;
use crate::robot::Robot;
use crate::scalar::{Scalar, real};

impl<T: Scalar + RealField> Robot<T> {
    /// A robot from constants by their names, as [`Robot::CONSTANTS`] lists them; those that are not given are usual.
    /// Needed are nine: mass, inertias, height of the centre of mass, wheels, adhesion and rolling resistance.
    ///
    /// ```
    /// use robot_model::{ModelError, Robot};
    ///
    /// let given = [
    ///     ("mass", 75.0),
    ///     ("yaw_inertia", 5.0),
    ///     ("com_height", 0.2),
    ///     ("wheelbase", 0.512),
    ///     ("track", 0.5708),
    ///     ("wheel_radius", 0.1651),
    ///     ("wheel_inertia", 0.044),
    ///     ("adhesion", 0.6),
    ///     ("rolling_resistance", 0.03),
    ///     ("coulomb", 3.0), // both sides
    /// ];
    /// let robot = Robot::from_constants(&given)?;
    /// assert_eq!((robot.half_track, robot.coulomb, robot.gravity), (0.2854, [3.0, 3.0], 9.81));
    ///
    /// // The second entry of a name counts: a table of constants can be changed by adding to it.
    /// let weightless = Robot::from_constants(&[&given[..], &[("mass", 0.0)]].concat());
    /// assert_eq!(weightless.unwrap_err().to_string(), "mass is 0, but it must be larger than zero");
    /// # Ok::<(), ModelError>(())
    /// ```
    ///
    /// # Errors
    /// A name that no constant has, one that must be given and is not, and a value that no robot can have.
    pub fn from_constants(given: &[(&'static str, T)]) -> Result<Self, ModelError> {
        Self::on_chassis(Chassis::SkidSteer, given)
    }

    /// The same on a chassis. On casters, `caster_x` is needed in place of the wheelbase.
    ///
    /// ```
    /// use robot_model::{Chassis, ModelError, Robot};
    ///
    /// let given = [
    ///     ("mass", 10.0),
    ///     ("yaw_inertia", 0.2),
    ///     ("com_x", -0.03),
    ///     ("com_height", 0.1),
    ///     ("track", 0.3),
    ///     ("caster_x", -0.15), // behind the driven axle
    ///     ("wheel_radius", 0.05),
    ///     ("wheel_inertia", 4e-4),
    ///     ("adhesion", 0.7),
    ///     ("rolling_resistance", 0.02),
    /// ];
    /// let robot = Robot::on_chassis(Chassis::Differential, &given)?;
    /// assert_eq!((robot.casters, robot.caster_rolling), ([[-0.15, 0.0]; 2], 0.02));
    /// assert!(Robot::on_chassis(Chassis::SkidSteer, &given).is_err());
    /// # Ok::<(), ModelError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Robot::from_constants`], and a constant that robots on this chassis do not have.
    pub fn on_chassis(chassis: Chassis, given: &[(&'static str, T)]) -> Result<Self, ModelError> {
        for (name, _) in given {
            let row = Self::CONSTANTS.iter().find(|c| c.is_called(name)).ok_or(ModelError::Unknown { name })?;
            if !row.is_of(chassis) {
                return Err(ModelError::Foreign { name, chassis });
            }
        }
        let find = |name: &str| given.iter().rev().find(|g| g.0 == name).map(|g| g.1);

        let mut out = Self { chassis, ..Self::blank() };
        for constant in Self::CONSTANTS.iter().filter(|c| c.is_of(chassis)) {
            let said = find(constant.id).or_else(|| constant.both.and_then(find));
            let value = match (said, constant.usual) {
                (Some(value), _) => value,
                (None, Usual::Value(usual)) => real(usual),
                (None, Usual::Unlimited) => real(NO_LIMIT),
                (None, Usual::RearAxle) => match chassis {
                    Chassis::SkidSteer | Chassis::FourMotors => -out.half_wheelbase,
                    Chassis::Differential => real(0.0),
                },
                (None, Usual::As(other)) => {
                    Self::CONSTANTS.iter().find(|c| c.id == other).map_or_else(|| real(0.0), |c| (c.get)(&out))
                }
                (None, Usual::Needed) => {
                    return Err(ModelError::Missing { name: constant.id, unit: constant.unit });
                }
            };
            (constant.set)(&mut out, value);
        }
        if chassis == Chassis::Differential {
            let [first, second] = out.casters.map(|caster| Scalar::abs(caster[0]));
            out.half_wheelbase = Scalar::max(first, second) * real(0.5);
        }
        out.checked()
    }
}
