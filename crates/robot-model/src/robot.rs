//! The constants of a user's robot model.

use nalgebra::RealField;

use crate::chassis::Chassis;
use crate::contact::Stance;
use crate::error::ModelError;
use crate::paper;
use crate::scalar::{Scalar, real};

/// From the commanded to the delivered torque of a side:
/// delay → gain → limit → first-order lags → dead band.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive<T> {
    /// Delivered torque per commanded torque.
    pub gain: T,
    /// Time constant of the current loop, s.
    pub lag: T,
    /// Time constant of a second lag in series, s; zero when there is none.
    pub extra_lag: T,
    /// Pure delay, s; applied by whoever looks the command up.
    pub delay: T,
    /// Largest torque of a side, N m.
    pub limit: T,
    /// Torque that is lost in a dead band, N m.
    pub dead_band: T,
}

/// A robot that is commanded by side: four wheels, those of a side coupled by a belt or with a motor each, or two driven wheels and
/// casters.
///
/// Its geometric centre lies in the middle of its wheels, or of the driven axle where casters hold it up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Robot<T> {
    /// What it stands on.
    pub chassis: Chassis,
    /// Mass m, kg.
    pub mass: T,
    /// Inertia about the vertical through the centre of mass I_z, kg m².
    pub yaw_inertia: T,
    /// Centre of mass from the geometric centre on the ground (x, y, height), m.
    pub com: [T; 3],
    /// Half the wheelbase a, m; with casters half the distance from the axle to the farther of them.
    pub half_wheelbase: T,
    /// Half the track b, m.
    pub half_track: T,
    /// Wheel radius r, m.
    pub wheel_radius: T,
    /// Inertia of one wheel about its axle, kg m².
    pub wheel_inertia: T,
    /// Inertia of one side's motors and gears, seen at the wheel, kg m².
    pub motor_inertia: T,
    /// Peak adhesion μ of the ground.
    pub adhesion: T,
    /// Slip ratio λp at the peak of the adhesion.
    pub slip_at_peak: T,
    /// Share of the peak adhesion that remains however much the wheel slides; 1 is a plateau.
    pub sliding_share: T,
    /// Slip speed below which a contact answers viscously, m/s: `λ = v_slip / sqrt((ω r)² + v0²)`.
    pub rest_speed: T,
    /// Lateral over longitudinal adhesion.
    pub lateral_factor: T,
    /// Rolling resistance coefficient f_r.
    pub rolling_resistance: T,
    /// Dry friction of each side's drivetrain, N m.
    pub coulomb: [T; 2],
    /// Viscous friction of each side's drivetrain, N m s/rad.
    pub viscous: [T; 2],
    /// Rise of the dry friction of each side towards rest (Stribeck), N m.
    pub stribeck: T,
    /// Where the casters' pivots are from the geometric centre, m; one caster counts as two at one place.
    pub casters: [[T; 2]; 2],
    /// Distance by which a caster's wheel trails its pivot, m.
    pub caster_trail: T,
    /// Rolling resistance coefficient of the casters.
    pub caster_rolling: T,
    /// Where a trailer is hitched, m ahead of the geometric centre.
    pub hitch_x: T,
    /// From command to torque.
    pub drive: Drive<T>,
    /// Gravity, m/s².
    pub gravity: T,
}

impl<T: Scalar + RealField> Robot<T> {
    /// Checks every constant.
    ///
    /// # Errors
    /// The first constant that no robot can have.
    pub fn checked(self) -> Result<Self, ModelError> {
        let robot = self.cast::<f64>();
        // A bound that another constant sets means something only once that one is as it must be.
        for is_relative in [false, true] {
            let rows = Robot::CONSTANTS.iter().filter(|constant| constant.is_of(robot.chassis));
            for constant in rows.filter(|constant| constant.bounds.is_relative() == is_relative) {
                constant.check(&robot)?;
            }
            if robot.chassis == Chassis::Differential {
                robot.check_casters()?;
            }
        }
        Ok(self)
    }

    /// The same robot in another scalar.
    pub fn cast<U: Scalar>(&self) -> Robot<U> {
        Robot::assemble(self.chassis, |constant| {
            real(nalgebra::try_convert::<T, f64>(constant(self)).unwrap_or(f64::NAN))
        })
    }
}

impl Robot<f64> {
    /// Refuses casters by which the robot does not stand.
    fn check_casters(&self) -> Result<(), ModelError> {
        let [[first, _], [second, _]] = self.casters;
        let least = NEAREST_CASTER * self.wheel_radius.min(self.half_track);
        if first.abs().max(second.abs()) < least {
            return Err(ModelError::Caster { name: "caster_x", value: first });
        }
        Ok(())
    }
}

impl<U: Scalar> Robot<U> {
    /// A robot each of whose constants is made from the same constant of other robots: `make` gets what reads it.
    pub fn assemble<T: Scalar>(chassis: Chassis, make: impl Fn(fn(&Robot<T>) -> T) -> U) -> Self {
        let mut out = Self { chassis, ..Self::blank() };
        for (to, from) in Self::CONSTANTS.iter().zip(Robot::<T>::CONSTANTS) {
            (to.set)(&mut out, make(from.get));
        }
        out
    }

    /// Every constant zero: what a robot is before any is set.
    pub(crate) fn blank() -> Self {
        let o = U::zero();
        Self {
            chassis: Chassis::SkidSteer,
            mass: o,
            yaw_inertia: o,
            com: [o; 3],
            half_wheelbase: o,
            half_track: o,
            wheel_radius: o,
            wheel_inertia: o,
            motor_inertia: o,
            adhesion: o,
            slip_at_peak: o,
            sliding_share: o,
            rest_speed: o,
            lateral_factor: o,
            rolling_resistance: o,
            coulomb: [o; 2],
            viscous: [o; 2],
            stribeck: o,
            casters: [[o; 2]; 2],
            caster_trail: o,
            caster_rolling: o,
            hitch_x: o,
            drive: Drive { gain: o, lag: o, extra_lag: o, delay: o, limit: o, dead_band: o },
            gravity: o,
        }
    }
}

impl<T: Scalar> Robot<T> {
    /// Where the wheels stand and how they are loaded.
    pub fn stance(&self) -> Stance<T> {
        match self.chassis {
            Chassis::SkidSteer | Chassis::FourMotors => {
                Stance::new(self.mass, self.gravity, self.half_wheelbase, self.half_track, self.com)
            }
            Chassis::Differential => {
                let from_com = self.contacts().map(|[x, y]| [x - self.com[0], y - self.com[1]]);
                Stance::on(from_com, self.mass, self.gravity, self.com[2])
            }
        }
    }

    /// Inertia of the wheels of a side and of its motor, seen at a wheel, kg m².
    pub fn side_inertia(&self) -> T {
        let wheels = match self.chassis {
            Chassis::SkidSteer | Chassis::FourMotors => 2.0,
            Chassis::Differential => 1.0,
        };
        self.wheel_inertia * real(wheels) + self.motor_inertia
    }

    /// The same of the wheels that are driven or coupled to such: without casters.
    pub fn wheels(&self) -> impl ExactSizeIterator<Item = [T; 2]> + Clone {
        let first = if self.chassis == Chassis::Differential { 2 } else { 0 };
        self.contacts().into_iter().skip(first)
    }

    /// Where it touches the ground, from the geometric centre in body axes, m: front left, front right, rear left and rear
    /// right wheel, or the first and second caster and the left and right wheel.
    pub fn contacts(&self) -> [[T; 2]; 4] {
        let (a, b) = (self.half_wheelbase, self.half_track);
        match self.chassis {
            Chassis::SkidSteer | Chassis::FourMotors => [[a, b], [a, -b], [-a, b], [-a, -b]],
            Chassis::Differential => [self.casters[0], self.casters[1], [T::zero(), b], [T::zero(), -b]],
        }
    }
}

impl<T: Scalar> From<&paper::Parameters> for Robot<T> {
    /// The paper's robot with an ideal drive and Kiencke's law unchanged (no share of the adhesion survives all slip).
    fn from(p: &paper::Parameters) -> Self {
        let (o, half) = (T::zero(), 0.5);
        Self {
            chassis: Chassis::SkidSteer,
            mass: real(p.mass),
            yaw_inertia: real(p.yaw_inertia),
            com: [real(half * p.wheelbase - p.com_to_front_axle), o, real(p.com_height)],
            half_wheelbase: real(half * p.wheelbase),
            half_track: real(half * p.track),
            wheel_radius: real(p.wheel_radius),
            // The paper's a1 already holds half of the motor.
            wheel_inertia: real(p.wheel_inertia),
            motor_inertia: o,
            adhesion: real(p.adhesion),
            slip_at_peak: real(p.slip_at_peak),
            sliding_share: o,
            rest_speed: real(USUAL_REST_SPEED),
            lateral_factor: T::one(),
            rolling_resistance: real(p.rolling_resistance),
            coulomb: [real(2.0 * p.coulomb_torque); 2],
            viscous: [o; 2],
            stribeck: o,
            casters: [[o; 2]; 2],
            caster_trail: o,
            caster_rolling: o,
            hitch_x: real(-half * p.wheelbase),
            drive: Drive { gain: T::one(), lag: o, extra_lag: o, delay: o, limit: real(UNLIMITED), dead_band: o },
            gravity: real(p.gravity),
        }
    }
}

/// Least distance of a caster from the driven axle, share of the smaller of wheel radius and half track (guess: nearer, its
/// wheel and the driven ones would be in each other's way).
const NEAREST_CASTER: f64 = 0.5;

/// Share of the peak adhesion that remains in full sliding when nobody knows better: a plateau.
pub const USUAL_SLIDING_SHARE: f64 = 1.0;

/// Share of the brush model in the law of a tyre when nobody knows better (guess: in the middle).
pub(crate) const USUAL_BRUSH_SHARE: f64 = 0.5;

/// Slip speed at rest when nobody knows better, m/s.
pub const USUAL_REST_SPEED: f64 = 0.3;

/// A torque beyond any robot's, N m: stands for "no limit".
pub(crate) const UNLIMITED: f64 = 1e9;
