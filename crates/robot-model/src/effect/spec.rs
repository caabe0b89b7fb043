//! The specification of an effect: all that is known about it besides its law, as plain data.

use crate::chassis::Chassis;
use crate::effect::Export;
use crate::robot::Robot;

/// Where in the chain an effect sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Forces on the robot or properties of its body.
    Physics,
    /// Between the logged command and the delivered torque.
    Command,
    /// What a sensor shows, not what the robot does.
    Sensor,
}

impl Kind {
    /// In one word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Physics => "physics",
            Self::Command => "command",
            Self::Sensor => "sensor",
        }
    }
}

/// What a parameter says about its effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// How strong: the response is close to proportional to it, zero at the neutral value.
    Strength,
    /// How strong, but with a response of its own shape at every size (a lag, a limit).
    Shaped,
    /// What kind: meaningless at zero strength.
    Shape,
}

impl Role {
    /// For people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Strength => "strength",
            Self::Shaped => "strength, not proportional",
            Self::Shape => "shape",
        }
    }
}

/// One number of an effect's law.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// Name in the field's words.
    pub name: &'static str,
    /// SI unit, "-" if none.
    pub unit: &'static str,
    /// Strength, shaped strength, or shape.
    pub role: Role,
    /// Bounds of sensible values.
    pub bounds: [f64; 2],
    /// Value at which nothing changes; of a shape, its usual value.
    pub neutral: f64,
    /// Sizes at which a screen probes it; of a strength, one: a medium size.
    pub probes: &'static [f64],
    /// Probes and bounds count in this quantity of the recordings instead of one.
    pub scale: Scale,
    /// Size of a usual change of it in a fit, where that is not its probe: of a shape that may be zero.
    pub step: Option<f64>,
    /// The constant of the robot to which it is added, where their sum cannot fall below zero.
    pub added_to: Option<fn(&Robot<f64>) -> f64>,
}

/// A parameter of this name is what the robot or the ground lost; below 0 it has gained as much.
pub const LOST_SHARE: &str = "lost share";

impl Parameter {
    /// A strength: zero is neutral; `probes` is one medium size.
    pub const fn strength(name: &'static str, unit: &'static str, bounds: [f64; 2], probes: &'static [f64]) -> Self {
        let (role, scale) = (Role::Strength, Scale::Own);
        Self { name, unit, role, bounds, neutral: 0.0, probes, scale, step: None, added_to: None }
    }

    /// A strength that is added to a constant of the robot: the sum is no less than zero.
    pub const fn added(
        name: &'static str,
        to: fn(&Robot<f64>) -> f64,
        bounds: [f64; 2],
        probes: &'static [f64],
    ) -> Self {
        Self { added_to: Some(to), ..Self::strength(name, "-", bounds, probes) }
    }

    /// A strength whose response has a shape of its own: several probes.
    pub const fn shaped(
        name: &'static str,
        unit: &'static str,
        bounds: [f64; 2],
        neutral: f64,
        probes: &'static [f64],
    ) -> Self {
        Self { role: Role::Shaped, neutral, ..Self::strength(name, unit, bounds, probes) }
    }

    /// A shape: a fit starts at its usual value.
    pub const fn shape(
        name: &'static str,
        unit: &'static str,
        bounds: [f64; 2],
        usual: f64,
        probes: &'static [f64],
    ) -> Self {
        Self { role: Role::Shape, neutral: usual, ..Self::strength(name, unit, bounds, probes) }
    }

    /// The unit that bounds and probes are counted in.
    pub const fn counted_in(&self) -> &'static str {
        match self.scale {
            Scale::Own => self.unit,
            Scale::LargestTorque => "largest commanded torque",
        }
    }
}

/// What a parameter's probes are measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// In the parameter's own unit.
    Own,
    /// In the largest torque commanded in the recordings.
    LargestTorque,
}

/// What sizes of an effect grow with from robot to robot: sizes of interest, probes and bounds of strengths are those of
/// [`SizedBy::REFERENCE`], and of other robots in proportion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SizedBy {
    /// Alike on all robots: a share, an angle, a time, an acceleration.
    Itself,
    /// Its mass m.
    Mass,
    /// Its weight m g.
    Weight,
    /// The torque that its tyres transmit, by m g r.
    Traction,
    /// That torque at the wheel speed of a driving speed: m g r².
    TractionPerSpeed,
    /// One over that torque.
    PerTraction,
    /// Its wheelbase.
    Wheelbase,
    /// The radius of its wheels r.
    WheelRadius,
}

impl SizedBy {
    /// Mass (kg), half the wheelbase (m), radius of the wheels (m) and gravity (m/s²) of the robot whose sizes a
    /// specification tells.
    pub const REFERENCE: [f64; 4] = [20.0, 0.176, 0.097, 9.81];

    /// What follows a size of the reference, for people.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Itself => "",
            Self::Mass => " on a robot of 20 kg, in proportion to its mass",
            Self::Weight => " on a robot of 20 kg, in proportion to its weight",
            Self::Traction => " on a robot of 20 kg with wheels of 97 mm radius, in proportion to weight times radius",
            Self::TractionPerSpeed => {
                " on a robot of 20 kg with wheels of 97 mm radius, in proportion to weight times radius squared"
            }
            Self::PerTraction => {
                " on a robot of 20 kg with wheels of 97 mm radius, in inverse proportion to weight times radius"
            }
            Self::Wheelbase => " on a robot with a wheelbase of 352 mm, in proportion to it",
            Self::WheelRadius => " on wheels of 97 mm radius, in proportion to it",
        }
    }

    /// Sizes of this robot over those of the reference.
    pub fn factor(self, robot: &Robot<f64>) -> f64 {
        let [mass, half_wheelbase, radius, gravity] = Self::REFERENCE;
        let (mass, radius) = (robot.mass / mass, robot.wheel_radius / radius);
        let weight = mass * robot.gravity / gravity;
        match self {
            Self::Itself => 1.0,
            Self::Mass => mass,
            Self::Weight => weight,
            Self::Traction => weight * radius,
            Self::TractionPerSpeed => weight * radius * radius,
            Self::PerTraction => 1.0 / (weight * radius),
            Self::Wheelbase => robot.half_wheelbase / half_wheelbase,
            Self::WheelRadius => radius,
        }
    }
}

/// Where and when an effect may be present: each is one more candidate of the diagnosis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools, reason = "four questions that are answered one by one")]
pub struct Scopes {
    /// Everywhere and always.
    pub everywhere: bool,
    /// From an instant on.
    pub onset: bool,
    /// Inside a disc on the ground.
    pub disc: bool,
    /// On one side only, left or right.
    pub side: bool,
}

impl Scopes {
    /// Always and everywhere on the whole robot.
    pub const WHOLE: Self = Self { everywhere: true, onset: false, disc: false, side: false };
    /// On one side of the robot.
    pub const ONE_SIDE: Self = Self { side: true, ..Self::WHOLE };
    /// On one side of the robot, always or from an instant on.
    pub const ONE_SIDE_OR_LATER: Self = Self { onset: true, ..Self::ONE_SIDE };
    /// Of the ground: everywhere, from an instant on, or at one place.
    pub const GROUND: Self = Self { onset: true, disc: true, ..Self::WHOLE };

    /// The forms in which an effect is looked for, in words.
    pub fn forms(self) -> impl Iterator<Item = &'static str> {
        let all = [
            (self.everywhere && !self.side, "everywhere, always"),
            (self.side, "on one side"),
            (self.onset, "from an instant on"),
            (self.disc, "at one place on the ground"),
        ];
        all.into_iter().filter(|(may_be, _)| *may_be).map(|(_, words)| words)
    }
}

/// A redundancy between sensors, free of any force law, in which a sensor fault shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Redundancy {
    /// None: the effect shows in the motion.
    None,
    /// Constant part of gyro less rate of the pose heading.
    GyroOffset,
    /// Part of gyro less rate of the pose heading proportional to the rate.
    GyroGain,
    /// Wheel angle frozen while moving, then jumping.
    FrozenAngle,
    /// Wheel angle jumping within a row while the speed before and after is the same.
    JumpingAngle,
    /// Wheel speed over ground speed on straights, alike when driving and when braking.
    WheelScale,
    /// Accelerometer less acceleration of the pose: its part fixed in the robot.
    AccelOffset,
    /// Accelerometer turned against the acceleration of the pose.
    AccelTurn,
    /// Delay between the clocks of two sensors.
    Delay,
    /// Growth of the delay between the clocks of two sensors.
    DelayGrowth,
}

impl Redundancy {
    /// What is compared, for people; `None` when nothing is.
    pub const fn shows_in(self) -> Option<&'static str> {
        match self {
            Self::None => None,
            Self::GyroOffset => Some("gyro less rate of the pose heading: its constant part"),
            Self::GyroGain => Some("gyro less rate of the pose heading: its part proportional to the rate"),
            Self::FrozenAngle => Some("wheel angle frozen while moving, then jumping"),
            Self::JumpingAngle => Some("wheel angle jumping within a row at steady speed"),
            Self::WheelScale => Some("wheel speed over pose speed on straights, alike when driving and braking"),
            Self::AccelOffset => Some("accelerometer less acceleration of the pose: its part fixed in the robot"),
            Self::AccelTurn => Some("accelerometer turned against the acceleration of the pose"),
            Self::Delay => Some("delay of the gyro against the pose and the wheels"),
            Self::DelayGrowth => Some("growth of the delay of the gyro against the pose"),
        }
    }
}

/// The term of the torque law of a speed-driven robot that an effect stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LoadTerm {
    /// A share of the weight along the way, of either sign.
    Slope,
    /// Straight load against the motion.
    Rolling,
    /// Torque against turning.
    Turning,
    /// Grows with the speed.
    Speed,
    /// Drifts with time.
    Drift,
    /// The same force whatever the motion.
    Pull,
}

impl LoadTerm {
    /// In a word or two, for sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slope => "slope",
            Self::Rolling => "rolling resistance",
            Self::Turning => "turning resistance",
            Self::Speed => "loads that grow with speed",
            Self::Drift => "loads that drift with time",
            Self::Pull => "constant pull",
        }
    }
}

/// The specification of an effect: all that is known about it besides its law.
///
/// A file states what is its own and takes the rest from [`EffectSpec::PHYSICS`], [`COMMAND`](EffectSpec::COMMAND) or
/// [`SENSOR`](EffectSpec::SENSOR): `EffectSpec { id: "wind", .., ..EffectSpec::PHYSICS }`.
#[derive(Debug, Clone, Copy)]
pub struct EffectSpec {
    /// Identifier, the file's name.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// Physics, command or sensor.
    pub kind: Kind,
    /// The law as a formula.
    pub law: &'static str,
    /// What one sees on the robot.
    pub seen: &'static str,
    /// The numbers of the law.
    pub parameters: &'static [Parameter],
    /// Strengths are of either sign.
    pub signed: bool,
    /// The strengths are alternatives (axes), not components.
    pub axes: &'static [&'static str],
    /// Where and when it may be present.
    pub scopes: Scopes,
    /// The chassis on which alone it can be; none for any.
    pub chassis: &'static [Chassis],
    /// Sensor redundancy in which it shows, if any.
    pub redundancy: Redundancy,
    /// Term of the torque law of a speed-driven robot that it stands for, if any.
    pub load_term: Option<LoadTerm>,
    /// What its sizes grow with from robot to robot.
    pub sized_by: SizedBy,
    /// Size, in the unit of the magnitude, below which nobody would act; zero when any size matters.
    pub interest: f64,
    /// Size of it that a robot without it may show, because its true laws differ in form from the plant's: one sigma.
    /// References take it in; without them smaller sizes are not told from the form.
    pub form_error: f64,
    /// Share of its size, one sigma, that numbers leave open which the law holds fixed.
    pub law_error: f64,
    /// Penalty in nats because few robots have it: 0 for what most studies of such robots name, 3 for what some robots
    /// have, 6 for the exotic and for look-alikes of a commoner effect.
    pub rarity: f64,
    /// The drive that reveals it best.
    pub revealed_by: &'static str,
    /// Effects that look alike, and when.
    pub resembles: &'static str,
    /// Source of the law.
    pub source: &'static str,
    /// How it is written to simulators.
    pub export: Export,
}

impl EffectSpec {
    /// Forces on the robot or properties of its body, present always and everywhere, common, of one sign.
    pub const PHYSICS: Self = Self {
        id: "",
        name: "",
        kind: Kind::Physics,
        law: "",
        seen: "",
        parameters: &[],
        signed: false,
        axes: &[],
        scopes: Scopes::WHOLE,
        chassis: &[],
        redundancy: Redundancy::None,
        load_term: None,
        sized_by: SizedBy::Itself,
        interest: 0.0,
        form_error: 0.0,
        law_error: 0.0,
        rarity: 0.0,
        revealed_by: "",
        resembles: "",
        source: "",
        export: Export::ADDED_BY_HAND,
    };
    /// Between the logged command and the delivered torque; the rest as of [`EffectSpec::PHYSICS`].
    pub const COMMAND: Self = Self { kind: Kind::Command, export: Export::DRIVE, ..Self::PHYSICS };
    /// What a sensor shows; the rest as of [`EffectSpec::PHYSICS`].
    pub const SENSOR: Self = Self { kind: Kind::Sensor, export: Export::SENSOR, ..Self::PHYSICS };

    /// Whether it can be on a robot of this chassis.
    pub fn is_of(&self, chassis: Chassis) -> bool {
        self.chassis.is_empty() || self.chassis.contains(&chassis)
    }

    /// The robots on which alone it can be, for people; nothing where it can be on any.
    pub fn on(&self) -> &'static str {
        match self.chassis {
            [] => "",
            [Chassis::Differential] => "robots on two wheels and casters only",
            [Chassis::SkidSteer] => "robots on four wheels only, those of a side coupled by a belt",
            _ => "robots on four wheels only",
        }
    }

    /// Indices of the parameters that measure strength.
    pub fn strengths(&self) -> impl Iterator<Item = usize> + '_ {
        self.parameters.iter().enumerate().filter(|(_, p)| p.role != Role::Shape).map(|(i, _)| i)
    }

    /// Whether the response is proportional to the strength.
    pub fn is_linear(&self) -> bool {
        self.parameters.iter().all(|p| p.role != Role::Shaped)
    }
}
