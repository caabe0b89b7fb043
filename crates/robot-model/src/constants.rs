//! The table of constants: one row for each number that a robot model consists of.
//!
//! A new constant is a field of [`Robot`], its row here, and its use in the plant. The checks of a robot, what a diagnosis
//! may re-tune and what robot files hold follow from the rows.

use crate::chassis::Chassis;
use crate::error::{ModelError, finite, not_negative, positive, within};
use crate::robot::{Robot, USUAL_REST_SPEED, USUAL_SLIDING_SHARE};
use crate::scalar::{Scalar, real};
use crate::tunable::{Apply, LEAST_LAG, Tunable, Tuning};

/// What a constant of a robot can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bounds {
    /// Larger than zero.
    Positive,
    /// Zero or larger.
    NotNegative,
    /// Any finite number.
    Finite,
    /// In this interval.
    Within(f64, f64),
    /// At most half a wheelbase from the middle; of a robot on casters from the rearmost to the foremost of what holds it up.
    BetweenAxles,
    /// At most half a track from the middle.
    BetweenWheels,
}

impl Bounds {
    /// Whether other constants set them.
    pub(crate) const fn is_relative(self) -> bool {
        matches!(self, Self::BetweenAxles | Self::BetweenWheels)
    }
}

/// What a constant is when nobody says it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Usual {
    /// It must be said.
    Needed,
    /// This number.
    Value(f64),
    /// So much that it limits nothing: [`NO_LIMIT`].
    Unlimited,
    /// The place of the rear axle, or of the driven one where casters hold the robot up.
    RearAxle,
    /// What another constant is, which stands before it.
    As(&'static str),
}

/// A torque beyond any robot's, N m: stands for a limit that nobody gave.
pub const NO_LIMIT: f64 = 1e6;

/// One constant of a robot model.
#[derive(Debug, Clone, Copy)]
pub struct Constant<T: Scalar> {
    /// Its name, as in robot files.
    pub id: &'static str,
    /// The name under which both sides are given at once, of a constant that each side has.
    pub both: Option<&'static str>,
    /// Its unit; "-" when it has none.
    pub unit: &'static str,
    /// What it can be.
    pub bounds: Bounds,
    /// What it is when nobody says it.
    pub usual: Usual,
    /// The chassis that alone has it, or that alone derives it from others; none where every robot has it.
    pub of: &'static [Chassis],
    /// Where it acts, for people.
    pub acts: &'static str,
    /// How a diagnosis re-tunes it, with its usual spread; `None` for what a user measures well enough or what
    /// recordings cannot tell.
    pub tuning: Option<Tunable<T>>,
    /// Reads it.
    pub get: fn(&Robot<T>) -> T,
    /// Changes it.
    pub set: fn(&mut Robot<T>, T),
}

impl<T: Scalar> Constant<T> {
    /// The same of one side.
    const fn of_side(mut self, both: &'static str) -> Self {
        self.both = Some(both);
        self
    }

    /// A constant of this chassis alone.
    const fn only_of(mut self, chassis: &'static [Chassis]) -> Self {
        self.of = chassis;
        self
    }

    /// Whether a robot on this chassis is given it.
    pub fn is_of(&self, chassis: Chassis) -> bool {
        self.of.is_empty() || self.of.contains(&chassis)
    }

    /// Re-tuned by `exp(δ)`; `sigma` is relative.
    const fn factor(mut self, order: usize, sigma: f64, source: &'static str, apply: Apply<T>) -> Self {
        self.tuning = Some(Tunable {
            id: self.id,
            order,
            tuning: Tuning::Factor,
            unit: "-",
            sigma,
            source,
            between_visits: 0.0,
            apply,
        });
        self
    }

    /// Re-tuned by adding `δ`; `sigma` is in the constant's unit.
    const fn offset(mut self, order: usize, sigma: f64, source: &'static str, apply: Apply<T>) -> Self {
        let unit = self.unit;
        self.tuning = Some(Tunable {
            id: self.id,
            order,
            tuning: Tuning::Offset,
            unit,
            sigma,
            source,
            between_visits: 0.0,
            apply,
        });
        self
    }

    /// The name of its tuning, where that is not its own.
    const fn tuned_as(mut self, id: &'static str) -> Self {
        if let Some(mut tuning) = self.tuning {
            tuning.id = id;
            self.tuning = Some(tuning);
        }
        self
    }

    /// Moves between visits by this share of its sigma.
    const fn between_visits(mut self, share: f64) -> Self {
        if let Some(mut tuning) = self.tuning {
            tuning.between_visits = share;
            self.tuning = Some(tuning);
        }
        self
    }

    /// Whether a file or a caller may mean it by this name.
    pub fn is_called(&self, name: &str) -> bool {
        self.id == name || self.both == Some(name)
    }
}

impl Constant<f64> {
    /// Refuses a value that no robot can have.
    pub(crate) fn check(&self, robot: &Robot<f64>) -> Result<(), ModelError> {
        let (name, value) = (self.id, (self.get)(robot));
        let (a, b) = (robot.half_wheelbase, robot.half_track);
        match self.bounds {
            Bounds::Positive => positive(name, value),
            Bounds::NotNegative => not_negative(name, value),
            Bounds::Finite => finite(name, value),
            Bounds::Within(low, high) => within(name, value, low, high),
            Bounds::BetweenAxles if robot.chassis == Chassis::Differential => {
                let along = robot.casters.map(|caster| caster[0]);
                within(name, value, along[0].min(along[1]).min(0.0), along[0].max(along[1]).max(0.0))
            }
            Bounds::BetweenAxles => within(name, value, -a, a),
            Bounds::BetweenWheels => within(name, value, -b, b),
        }
    }
}

/// A row: name, unit, bounds, usual value, where it acts, and its place in the robot.
macro_rules! row {
    ($id:literal, $unit:literal, $bounds:expr, $usual:expr, $acts:literal, |$robot:ident| $place:expr) => {
        row!($id, $unit, $bounds, $usual, $acts, |$robot| $place, |$robot, x| $place = x)
    };
    ($id:literal, $unit:literal, $bounds:expr, $usual:expr, $acts:literal, $get:expr, $set:expr) => {
        Constant::<T> {
            id: $id,
            both: None,
            unit: $unit,
            bounds: $bounds,
            usual: $usual,
            of: &[],
            acts: $acts,
            tuning: None,
            get: $get,
            set: $set,
        }
    };
}

/// Source of a spread that nobody has measured.
const GUESS: &str = "guess: what a careful user misses by";
/// Source of a spread that makes up for a law that the plant does not have.
const DISCREPANCY: &str = "guess: stands for what the plant's own law misses";

/// Shares of a constant's sigma by which it moves between visits. All three are guesses: ground, grease and magnets follow
/// weather and warmth, a body what is loaded, while what stands for a law that the plant lacks stays.
const WEATHER: f64 = 0.6;
const LOAD: f64 = 0.6;
const FORM: f64 = 0.25;

/// Trail of a caster, m (guess: half the wheel of a small one).
const USUAL_TRAIL: f64 = 0.025;

/// Largest share of the adhesion that is left in full sliding.
const MOST_SHARE: f64 = 1.3;
const SHARES: Bounds = Bounds::Within(0.0, MOST_SHARE);

impl<T: Scalar> Robot<T> {
    /// Every constant, in the order of robot files.
    ///
    /// Three tunings stand for discrepancies of the model: without them contact compliance reads as a motor lag, friction
    /// near rest as stiction, and sliding wheels as other ground. The lag is an offset because as a factor it could
    /// absorb a true additional lag.
    #[rustfmt::skip]
    pub const CONSTANTS: &'static [Constant<T>] = &[
        row!("mass", "kg", Bounds::Positive, Usual::Needed, "weight and inertia", |r| r.mass)
            .factor(12, 0.01, GUESS, |r, d| r.mass *= d.exp())
            .between_visits(LOAD),
        row!("yaw_inertia", "kg m2", Bounds::Positive, Usual::Needed, "turning", |r| r.yaw_inertia)
            .factor(6, 0.06, GUESS, |r, d| r.yaw_inertia *= d.exp())
            .between_visits(LOAD),
        row!("caster_x", "m", Bounds::Finite, Usual::Needed, "where the casters stand", |r| r.casters[0][0])
            .only_of(&[Chassis::Differential]),
        row!("caster_y", "m", Bounds::Finite, Usual::Value(0.0), "where the casters stand", |r| r.casters[0][1])
            .only_of(&[Chassis::Differential]),
        row!("second_caster_x", "m", Bounds::Finite, Usual::As("caster_x"), "where the casters stand", |r| r.casters[1][0])
            .only_of(&[Chassis::Differential]),
        row!("second_caster_y", "m", Bounds::Finite, Usual::As("caster_y"), "where the casters stand", |r| r.casters[1][1])
            .only_of(&[Chassis::Differential]),
        row!("caster_trail", "m", Bounds::Positive, Usual::Value(USUAL_TRAIL), "casters", |r| r.caster_trail)
            .only_of(&[Chassis::Differential]),
        row!("com_x", "m", Bounds::BetweenAxles, Usual::Value(0.0), "wheel loads", |r| r.com[0])
            .offset(7, 0.004, GUESS, |r, d| r.com[0] += d)
            .between_visits(LOAD),
        row!("com_y", "m", Bounds::BetweenWheels, Usual::Value(0.0), "wheel loads", |r| r.com[1])
            .offset(8, 0.004, GUESS, |r, d| r.com[1] += d)
            .between_visits(LOAD),
        row!("com_height", "m", Bounds::Positive, Usual::Needed, "wheel loads", |r| r.com[2])
            .factor(13, 0.05, GUESS, |r, d| r.com[2] *= d.exp())
            .between_visits(LOAD),
        row!("wheelbase", "m", Bounds::Positive, Usual::Needed, "where the wheels stand",
            |r| r.half_wheelbase + r.half_wheelbase, |r, x| r.half_wheelbase = x * real(0.5))
            .only_of(Chassis::ON_FOUR_WHEELS),
        row!("track", "m", Bounds::Positive, Usual::Needed, "where the wheels stand",
            |r| r.half_track + r.half_track, |r, x| r.half_track = x * real(0.5)),
        row!("wheel_radius", "m", Bounds::Positive, Usual::Needed, "wheels", |r| r.wheel_radius),
        row!("wheel_inertia", "kg m2", Bounds::Positive, Usual::Needed, "wheels", |r| r.wheel_inertia),
        row!("motor_inertia", "kg m2", Bounds::NotNegative, Usual::Value(0.0), "drivetrain", |r| r.motor_inertia)
            .factor(10, 0.06, GUESS, |r, d| r.motor_inertia *= d.exp())
            .between_visits(LOAD),
        row!("adhesion", "-", Bounds::Positive, Usual::Needed, "ground", |r| r.adhesion)
            .factor(0, 0.10, GUESS, |r, d| r.adhesion *= d.exp())
            .between_visits(WEATHER),
        row!("slip_at_peak", "-", Bounds::Positive, Usual::Value(0.12), "ground", |r| r.slip_at_peak)
            .factor(1, 0.6, GUESS, |r, d| r.slip_at_peak *= d.exp())
            .between_visits(FORM),
        row!("sliding_share", "-", SHARES, Usual::Value(USUAL_SLIDING_SHARE), "ground", |r| r.sliding_share)
            .offset(16, 0.1, DISCREPANCY, |r, d| {
                r.sliding_share = (r.sliding_share + d).max(T::zero()).min(real(MOST_SHARE));
            })
            .between_visits(FORM),
        row!("rest_speed", "m/s", Bounds::Positive, Usual::Value(USUAL_REST_SPEED), "ground", |r| r.rest_speed)
            .factor(17, 1.0, DISCREPANCY, |r, d| r.rest_speed *= d.exp()),
        row!("lateral_factor", "-", Bounds::Positive, Usual::Value(1.0), "ground", |r| r.lateral_factor)
            .factor(9, 0.15, GUESS, |r, d| r.lateral_factor *= d.exp())
            .between_visits(FORM),
        row!("rolling_resistance", "-", Bounds::NotNegative, Usual::Needed, "ground", |r| r.rolling_resistance)
            .factor(2, 0.13, GUESS, |r, d| r.rolling_resistance *= d.exp())
            .between_visits(WEATHER),
        row!("caster_rolling", "-", Bounds::NotNegative, Usual::As("rolling_resistance"), "casters", |r| r.caster_rolling)
            .only_of(&[Chassis::Differential]),
        row!("coulomb_left", "N m", Bounds::NotNegative, Usual::Value(0.0), "drivetrain", |r| r.coulomb[0])
            .of_side("coulomb")
            .factor(3, 0.14, GUESS, |r, d| r.coulomb[0] *= d.exp())
            .between_visits(WEATHER),
        row!("coulomb_right", "N m", Bounds::NotNegative, Usual::Value(0.0), "drivetrain", |r| r.coulomb[1])
            .of_side("coulomb")
            .factor(4, 0.14, GUESS, |r, d| r.coulomb[1] *= d.exp())
            .between_visits(WEATHER),
        // One tuning for both sides, since a difference in damping hides behind one in dry friction.
        row!("viscous_left", "N m s/rad", Bounds::NotNegative, Usual::Value(0.0), "drivetrain", |r| r.viscous[0])
            .of_side("viscous")
            .factor(5, 0.13, GUESS, |r, d| {
                r.viscous[0] *= d.exp();
                r.viscous[1] *= d.exp();
            })
            .tuned_as("viscous")
            .between_visits(WEATHER),
        row!("viscous_right", "N m s/rad", Bounds::NotNegative, Usual::Value(0.0), "drivetrain", |r| r.viscous[1])
            .of_side("viscous"),
        // A re-tuning may make friction fall towards rest.
        row!("stribeck", "N m", Bounds::Finite, Usual::Value(0.0), "drivetrain", |r| r.stribeck)
            .offset(15, 0.12, DISCREPANCY, |r, d| r.stribeck += d)
            .between_visits(FORM),
        row!("hitch_x", "m", Bounds::Finite, Usual::RearAxle, "trailer", |r| r.hitch_x),
        row!("torque_gain", "-", Bounds::Positive, Usual::Value(1.0), "motors", |r| r.drive.gain)
            .factor(11, 0.015, GUESS, |r, d| r.drive.gain *= d.exp())
            .tuned_as("torque_constant")
            .between_visits(WEATHER),
        // A re-tuning may make a lead of a small lag.
        row!("motor_delay", "s", Bounds::Finite, Usual::Value(0.0), "motors", |r| r.drive.delay),
        row!("motor_lag", "s", Bounds::NotNegative, Usual::Value(0.0), "motors", |r| r.drive.lag)
            .offset(14, 0.012, DISCREPANCY, |r, d| {
                // Below zero a lag goes on as a lead: a small lag and a delay are the same to first order.
                let (lag, least) = (r.drive.lag + d, real(LEAST_LAG));
                r.drive.lag = lag.max(least);
                r.drive.delay += (lag - least).min(T::zero());
            })
            .between_visits(FORM),
        row!("second_lag", "s", Bounds::NotNegative, Usual::Value(0.0), "motors", |r| r.drive.extra_lag),
        row!("dead_band", "N m", Bounds::NotNegative, Usual::Value(0.0), "motors", |r| r.drive.dead_band),
        row!("torque_limit", "N m", Bounds::Positive, Usual::Unlimited, "motors", |r| r.drive.limit),
        row!("gravity", "m/s2", Bounds::Positive, Usual::Value(9.81), "weight", |r| r.gravity),
    ];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tunable::{COUNT, tunables};

    /// Numbers that no other constant has.
    fn all_different() -> Robot<f64> {
        let mut robot = Robot::blank();
        for (i, constant) in Robot::CONSTANTS.iter().enumerate() {
            (constant.set)(&mut robot, 1.0 + i as f64);
        }
        robot
    }

    #[test]
    fn each_row_reads_what_it_writes_and_nothing_else() {
        let robot = all_different();
        for (i, constant) in Robot::CONSTANTS.iter().enumerate() {
            assert_eq!((constant.get)(&robot), 1.0 + i as f64, "{}", constant.id);
        }
    }

    #[test]
    fn names_are_unique_and_every_row_says_where_it_acts() {
        for (i, constant) in Robot::<f64>::CONSTANTS.iter().enumerate() {
            assert!(!Robot::<f64>::CONSTANTS[..i].iter().any(|c| c.is_called(constant.id)), "{}", constant.id);
            assert!(!constant.acts.is_empty() && !constant.unit.is_empty(), "{}", constant.id);
        }
    }

    #[test]
    fn a_tuning_changes_its_constant_and_says_where_its_spread_is_from() {
        let table = Robot::<f64>::CONSTANTS;
        for (place, tunable) in tunables::<f64>().iter().enumerate() {
            assert_eq!(tunable.order, place, "{}", tunable.id);
            assert!(tunable.sigma > 0.0 && !tunable.source.is_empty(), "{}", tunable.id);
            let row = table.iter().find(|c| c.tuning.is_some_and(|t| t.id == tunable.id)).expect("a row");
            let mut robot = Robot { sliding_share: 0.5, ..all_different() };
            let before = (row.get)(&robot);
            (tunable.apply)(&mut robot, 0.01);
            assert!((row.get)(&robot) > before, "{}", tunable.id);
        }
        assert_eq!(table.iter().filter(|c| c.tuning.is_some()).count(), COUNT);
    }
}
