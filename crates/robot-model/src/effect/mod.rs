//! What an effect is: a specification, and up to three places in which it changes the plant.

use core::any::Any;

use crate::chassis::Chassis;
use crate::robot::{Robot, UNLIMITED};
use crate::scalar::{Scalar, real};

pub mod export;
mod spec;

pub use export::Export;
pub use spec::{EffectSpec, Kind, LOST_SHARE, LoadTerm, Parameter, Redundancy, Role, Scale, Scopes, SizedBy};

/// One physical phenomenon, or one fault of a sensor, that a simulation may lack.
///
/// At the neutral value of its strengths an effect changes nothing, bit for bit.
/// `values` are in the order of the specification's parameters. An effect is [`Any`], so that one that is none of the
/// catalogue's can be found for another scalar.
pub trait Effect<T: Scalar>: Any + Sync {
    /// What people, the diagnosis and the exporters need to know about it.
    fn spec(&self) -> &'static EffectSpec;
    /// Changes constants of the robot.
    fn robot(&self, _values: &Values<T>, _robot: &mut Robot<T>) {}
    /// Changes the coefficients and forces of an instant.
    fn apply(&self, _values: &Values<T>, _at: &OperatingPoint<T>, _c: &mut Coefficients<T>) {}
    /// Changes what the sensors show; of a one-sided effect, that side alone is taken.
    fn sense(&self, _values: &Values<T>, _readings: &mut Readings<T>) {}
}

/// All that the law of an instant may depend on.
#[derive(Debug, Clone, Copy)]
pub struct OperatingPoint<T> {
    /// What the robot stands on.
    pub chassis: Chassis,
    /// Time since the start of the recording, s.
    pub time: T,
    /// Geometric centre on the ground, m.
    pub position: [T; 2],
    /// Cosine and sine of the yaw angle.
    pub heading: [T; 2],
    /// Velocity of the centre of mass in body axes, m/s.
    pub velocity: [T; 2],
    /// Yaw rate, rad/s.
    pub yaw_rate: T,
    /// Speed of the driven wheel of each side, rad/s.
    pub wheel_speed: [T; 2],
    /// Angle of the driven wheel of each side, rad.
    pub wheel_angle: [T; 2],
    /// Mass of the robot, kg.
    pub mass: T,
    /// Gravity, m/s².
    pub gravity: T,
    /// Hitch from the centre of mass in body axes, m.
    pub hitch: [T; 2],
    /// Half the wheelbase and half the track, m.
    pub half_base: [T; 2],
    /// Torque that the drive of each side delivers, N m; of a speed-driven robot, that of the step before.
    pub torque: [T; 2],
}

/// What the ground, the drivetrain and the surroundings do at an instant: all that a law may change.
///
/// Wheels are those of [`Robot::contacts`]: of a robot with casters these come first, and nothing but their rolling
/// resistance counts.
#[derive(Debug, Clone, Copy)]
pub struct Coefficients<T> {
    /// Peak adhesion under each wheel.
    pub adhesion: [T; 4],
    /// Slip ratio at the peak of the adhesion of each wheel.
    pub slip_at_peak: [T; 4],
    /// Lateral over longitudinal adhesion of each wheel.
    pub lateral: [T; 4],
    /// Rolling resistance coefficient of each wheel.
    pub rolling: [T; 4],
    /// Effective radius of each wheel, m.
    pub radius: [T; 4],
    /// Share of its longitudinal force that the ground takes from each wheel.
    pub traction: [T; 4],
    /// Load that moves from the front left and rear right wheel to the other two, each, N.
    pub twist: T,
    /// Dry friction of each side's drivetrain, N m.
    pub coulomb: [T; 2],
    /// Viscous friction of each side's drivetrain, N m s/rad.
    pub viscous: [T; 2],
    /// Rise of the dry friction towards rest on each side, N m.
    pub stribeck: [T; 2],
    /// Torque at each side's driven wheel beside what the drive delivers, N m.
    pub torque: [T; 2],
    /// Largest torque that each side's belt passes to the front wheel, N m.
    pub belt_limit: [T; 2],
    /// Force on the centre of mass in body axes, N.
    pub force: [T; 2],
    /// Yaw moment on the body, N m.
    pub moment: T,
    /// Gravity's component in the ground plane in body axes, m/s²; accelerometers do not see it.
    pub tilt: [T; 2],
}

/// What ideal sensors at the geometric centre show.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Readings<T> {
    /// Speed of the encoder wheel of each side, rad/s.
    pub wheel_speed: [T; 2],
    /// Yaw rate of the gyro, rad/s.
    pub gyro: T,
    /// Velocity in body axes, m/s.
    pub velocity: [T; 2],
    /// Specific force in body axes, m/s².
    pub accel: [T; 2],
    /// Torque that each side's drive must deliver, N m (speed-driven robots).
    pub torque: [T; 2],
}

/// Most parameters an effect's law may have.
pub const MAX_PARAMETERS: usize = 5;

/// Values of an effect's parameters in the order of its specification; what that does not name is zero.
pub type Values<T> = [T; MAX_PARAMETERS];

impl<T: Scalar> Robot<T> {
    /// The operating point of the robot at rest at the origin.
    #[inline(always)]
    pub fn at_rest(&self) -> OperatingPoint<T> {
        OperatingPoint {
            chassis: self.chassis,
            time: T::zero(),
            position: [T::zero(); 2],
            heading: [T::one(), T::zero()],
            velocity: [T::zero(); 2],
            yaw_rate: T::zero(),
            wheel_speed: [T::zero(); 2],
            wheel_angle: [T::zero(); 2],
            mass: self.mass,
            gravity: self.gravity,
            hitch: [self.hitch_x - self.com[0], -self.com[1]],
            half_base: [self.half_wheelbase, self.half_track],
            torque: [T::zero(); 2],
        }
    }

    /// What every instant begins with before effects change it.
    pub fn coefficients(&self) -> Coefficients<T> {
        Coefficients {
            adhesion: [self.adhesion; 4],
            slip_at_peak: [self.slip_at_peak; 4],
            lateral: [self.lateral_factor; 4],
            rolling: match self.chassis {
                Chassis::SkidSteer | Chassis::FourMotors => [self.rolling_resistance; 4],
                Chassis::Differential => {
                    let (caster, wheel) = (self.caster_rolling, self.rolling_resistance);
                    [caster, caster, wheel, wheel]
                }
            },
            radius: [self.wheel_radius; 4],
            traction: [T::one(); 4],
            twist: T::zero(),
            coulomb: self.coulomb,
            viscous: self.viscous,
            stribeck: [self.stribeck; 2],
            torque: [T::zero(); 2],
            belt_limit: [real(UNLIMITED); 2],
            force: [T::zero(); 2],
            moment: T::zero(),
            tilt: [T::zero(); 2],
        }
    }
}
