//! What an effect is: a card for people and up to three places in which it changes the plant.

use crate::robot::Robot;
use crate::scalar::Scalar;

/// One physical phenomenon, or one fault of a sensor, that a simulation may lack.
///
/// At the neutral value of its strengths an effect changes nothing, bit for bit.
/// `values` are in the order of the card's parameters.
pub trait Effect<T: Scalar>: Sync {
    /// What people and the diagnosis need to know about it.
    fn card(&self) -> &'static Card;
    /// Changes constants of the robot.
    fn robot(&self, _values: &Values<T>, _robot: &mut Robot<T>) {}
    /// Changes the forces of an instant.
    fn act(&self, _values: &Values<T>, _at: &Situation<T>, _world: &mut World<T>) {}
    /// Changes what the sensors show; of a one-sided effect, that side alone is taken.
    fn sense(&self, _values: &Values<T>, _readings: &mut Readings<T>) {}
}

/// The state of the robot that a force may depend on.
#[derive(Debug, Clone, Copy)]
pub struct Situation<T> {
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
    /// Wheel positions from the geometric centre in body axes, m.
    pub half_base: [T; 2],
    /// Torque that the drive of each side delivers, N m; of a speed-driven robot, that of the step before.
    pub torque: [T; 2],
}

/// What the ground, the drivetrain and the surroundings do at an instant.
#[derive(Debug, Clone, Copy)]
pub struct World<T> {
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
}

impl Parameter {
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

/// Presences that make sense for an effect beyond "always and everywhere".
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools, reason = "four questions that are answered one by one")]
pub struct Wears {
    /// Everywhere and always.
    pub everywhere: bool,
    /// From an instant on.
    pub onset: bool,
    /// Inside a disc on the ground.
    pub disc: bool,
    /// On one side only, left or right.
    pub side: bool,
}

impl Wears {
    /// The forms in which an effect is looked for, in words.
    pub fn forms(self) -> impl Iterator<Item = &'static str> {
        let all = [
            (self.everywhere && !self.side, "everywhere, always"),
            (self.side, "on one side"),
            (self.onset, "from an instant on"),
            (self.disc, "at one place on the ground"),
        ];
        all.into_iter().filter(|(is_worn, _)| *is_worn).map(|(_, words)| words)
    }
}

/// Present always and everywhere on the whole robot.
pub const WHOLE: Wears = Wears { everywhere: true, onset: false, disc: false, side: false };
/// Present on one side of the robot.
pub const ONE_SIDE: Wears = Wears { everywhere: true, onset: false, disc: false, side: true };

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

/// The card of an effect: all that is known about it besides its law.
#[derive(Debug, Clone, Copy)]
pub struct Card {
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
    pub wears: Wears,
    /// Sensor redundancy in which it shows, if any.
    pub redundancy: Redundancy,
    /// Size, in the unit of the magnitude, below which nobody would act; zero when any size matters.
    pub interest: f64,
    /// Penalty in nats because few robots have it: 0 for what most studies of such robots name, 3 for what some robots
    /// have, 6 for the exotic and for look-alikes of a commoner effect.
    pub rarity: f64,
    /// The drive that reveals it best.
    pub revealed_by: &'static str,
    /// Effects that look alike, and when.
    pub resembles: &'static str,
    /// Source of the law.
    pub source: &'static str,
}

impl Card {
    /// Indices of the parameters that measure strength.
    pub fn strengths(&self) -> impl Iterator<Item = usize> + '_ {
        self.parameters.iter().enumerate().filter(|(_, p)| p.role != Role::Shape).map(|(i, _)| i)
    }

    /// Whether the response is proportional to the strength.
    pub fn is_linear(&self) -> bool {
        self.parameters.iter().all(|p| p.role != Role::Shaped)
    }
}

/// Most parameters an effect's law may have.
pub const MAX_PARAMETERS: usize = 4;

/// Values of an effect's parameters in the order of its card; what the card does not name is zero.
pub type Values<T> = [T; MAX_PARAMETERS];
