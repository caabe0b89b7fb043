//! Wheel motion beside a pose: counts of the wheels, the angle of a steered one and a measured pose, and something between
//! them that the robot file does not have.
//!
//! The body is moved first, smoothly and at random; how far its wheels turn for that follows from where they really are, how
//! large they really are and how they slip. Counts are whole, the pose scatters.

mod draw;
mod plant;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// A kind of robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Chassis {
    /// Two driven wheels and a caster.
    Differential,
    /// A driven and steered front wheel before a free axle.
    Tricycle,
    /// Three omni wheels at 120 degrees.
    Omni3,
    /// Four omni wheels at 90 degrees.
    Omni4,
    /// Four mecanum wheels.
    Mecanum4,
    /// Two sides that are driven as a whole and skid in turns.
    SkidSteer,
}

impl Chassis {
    /// All.
    pub const ALL: [Self; 6] =
        [Self::Differential, Self::Tricycle, Self::Omni3, Self::Omni4, Self::Mecanum4, Self::SkidSteer];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Differential => "differential",
            Self::Tricycle => "tricycle",
            Self::Omni3 => "three omni wheels",
            Self::Omni4 => "four omni wheels",
            Self::Mecanum4 => "four mecanum wheels",
            Self::SkidSteer => "skid-steer",
        }
    }

    /// Whether it moves sideways as well.
    pub fn is_omni(self) -> bool {
        matches!(self, Self::Omni3 | Self::Omni4 | Self::Mecanum4)
    }
}

/// What shows how the body moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Seen {
    /// A pose.
    Pose,
    /// A gyro: how it turned, and not where it is.
    Gyro,
}

/// Something hidden between wheels and pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Hidden {
    /// All wheels roll with another radius.
    AllRadii,
    /// One wheel rolls with another radius.
    OneRadius,
    /// One wheel with rollers points another way.
    Direction,
    /// Wheels stand farther from each other, or from the centre, than stated.
    Distance,
    /// The steering's zero is off.
    SteeringZero,
    /// The steering turns more or less than it says.
    SteeringGain,
    /// A share of the way is lost in turns, however fast.
    TurnSlip,
    /// Turning is lost, the more the faster the turn.
    RateSlip,
    /// A share of the way is lost that grows with speed.
    SpeedSlip,
    /// Rollers slip sideways.
    RollerSlip,
    /// Clocks of wheels and pose start apart.
    ClockOffset,
    /// Clocks of wheels and pose run apart.
    ClockRate,
    /// The pose's frame is turned on the robot.
    Mounting,
    /// The pose is of another point of the robot.
    Origin,
    /// A wheel loses counts for some seconds at a time.
    LostCounts,
    /// The gyro shows turning by a factor.
    GyroScale,
    /// The gyro turns while the robot stands, and the robot never stands.
    GyroBias,
}

impl Hidden {
    /// All.
    pub const ALL: [Self; 17] = [
        Self::AllRadii,
        Self::OneRadius,
        Self::Direction,
        Self::Distance,
        Self::SteeringZero,
        Self::SteeringGain,
        Self::TurnSlip,
        Self::RateSlip,
        Self::SpeedSlip,
        Self::RollerSlip,
        Self::ClockOffset,
        Self::ClockRate,
        Self::Mounting,
        Self::Origin,
        Self::LostCounts,
        Self::GyroScale,
        Self::GyroBias,
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::AllRadii => "radius of all wheels",
            Self::OneRadius => "radius of one wheel",
            Self::Direction => "direction of one wheel",
            Self::Distance => "distance of wheels",
            Self::SteeringZero => "zero of the steering",
            Self::SteeringGain => "gain of the steering",
            Self::TurnSlip => "slip in turns",
            Self::RateSlip => "slip growing with turning",
            Self::SpeedSlip => "slip growing with speed",
            Self::RollerSlip => "slip of rollers",
            Self::ClockOffset => "offset of clocks",
            Self::ClockRate => "rate of clocks",
            Self::Mounting => "direction of the pose's frame",
            Self::Origin => "place of the pose",
            Self::LostCounts => "lost counts",
            Self::GyroScale => "scale of the gyro",
            Self::GyroBias => "bias of the gyro",
        }
    }

    /// Whether a robot of this kind can have it, and what is seen of its body can show it.
    pub fn is_of(self, chassis: Chassis, seen: Seen) -> bool {
        if seen == Seen::Gyro {
            let turns =
                !matches!(self, Self::TurnSlip | Self::SpeedSlip | Self::RollerSlip | Self::Mounting | Self::Origin);
            // By turning alone all radii and the gyro's scale are a track, which nobody knows of sides that skid.
            let is_factor = matches!(self, Self::AllRadii | Self::GyroScale);
            return turns
                && !(is_factor && chassis == Chassis::SkidSteer)
                && (self.is_of_gyro() || self.is_of_robot(chassis));
        }
        !self.is_of_gyro() && self.is_of_robot(chassis)
    }

    fn is_of_gyro(self) -> bool {
        matches!(self, Self::GyroScale | Self::GyroBias)
    }

    fn is_of_robot(self, chassis: Chassis) -> bool {
        match self {
            Self::OneRadius => chassis != Chassis::Tricycle,
            Self::SteeringZero | Self::SteeringGain => chassis == Chassis::Tricycle,
            Self::RollerSlip | Self::Direction => chassis.is_omni(),
            // Omni wheels slip by their rollers.
            Self::TurnSlip | Self::RateSlip => !chassis.is_omni(),
            // Nobody knows the effective track of sides that skid.
            Self::Distance => chassis != Chassis::SkidSteer,
            _ => true,
        }
    }
}

/// What was hidden in a case, for the scorer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RollingTruth {
    /// Name of the case.
    pub case: String,
    /// Kind of the robot.
    pub chassis: Chassis,
    /// What is hidden.
    pub hidden: Vec<Hidden>,
    /// The wheel that one of them is about.
    pub wheel: Option<String>,
    /// Its numbers as the robot has them, by what they are: `radius`, `distance`, m; `direction`, rad beyond what is stated; `steering_zero`, rad; `steering_gain`;
    /// `mounting`, rad; `origin_x`, `origin_y`, m; `clock_offset`, s, and `clock_rate`, without sign; `gyro_scale`; `gyro_bias`, rad/s.
    pub numbers: BTreeMap<String, f64>,
}

/// A drawn case: what the diagnoser gets, and what was hidden.
#[derive(Debug, Clone)]
pub struct RollingCase {
    /// Files of the case by their path in it.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// What was hidden.
    pub truth: RollingTruth,
}

/// Which case is to be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RollingPlan {
    /// Name of the case.
    pub name: String,
    /// Seed of the set.
    pub seed: u64,
    /// Number of the case in it.
    pub index: u64,
    /// Kind of the robot.
    pub chassis: Chassis,
    /// What shows how its body moves.
    pub seen: Seen,
    /// What is hidden.
    pub hidden: Option<Hidden>,
    /// Drives before anything is hidden.
    pub references: usize,
    /// What the robot file lacks in all drives, references included.
    pub in_all: Option<Hidden>,
}

impl RollingPlan {
    /// A set of so many cases: every kind of robot in turn; in a quarter nothing is hidden, in the others one thing, each as
    /// often as kinds permit. Where there are references, in every other case something else is there in all drives.
    pub fn set(seed: u64, count: usize, seen: Seen, references: usize) -> Vec<Self> {
        let mut turn = [0; Chassis::ALL.len()];
        let mut plan = |i: usize| {
            let kind = i % Chassis::ALL.len();
            let chassis = Chassis::ALL[kind];
            let of: Vec<Hidden> = Hidden::ALL.into_iter().filter(|h| h.is_of(chassis, seen)).collect();
            let hidden = (!(i / Chassis::ALL.len()).is_multiple_of(4)).then(|| {
                turn[kind] += 1;
                of[(turn[kind] - 1) % of.len()]
            });
            let round = i / Chassis::ALL.len();
            let is_flawed = references > 0 && (round / 4 + round + kind).is_multiple_of(2);
            let flaws: Vec<Hidden> = Self::FLAWS.into_iter().filter(|h| h.is_of(chassis, seen)).collect();
            let in_all = flaws.get(round / 2 % flaws.len().max(1)).copied();
            let in_all = in_all.filter(|flaw| is_flawed && hidden != Some(*flaw));
            Self { name: format!("r{:03}", i + 1), seed, index: i as u64, chassis, seen, hidden, references, in_all }
        };
        (0..count).map(&mut plan).collect()
    }

    /// What robot files lack most often.
    const FLAWS: [Hidden; 4] = [Hidden::TurnSlip, Hidden::AllRadii, Hidden::SpeedSlip, Hidden::Distance];

    /// Draws the case.
    pub fn draw(&self) -> RollingCase {
        draw::case(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_hides_nothing_in_a_quarter_and_everything_that_a_kind_can_have() {
        for seen in [Seen::Pose, Seen::Gyro] {
            let all = RollingPlan::set(1, 480, seen, 0);
            assert_eq!(all.iter().filter(|p| p.hidden.is_none()).count(), 120);
            for (chassis, hidden) in Chassis::ALL.into_iter().flat_map(|c| Hidden::ALL.map(|h| (c, h))) {
                let cases = all.iter().filter(|p| p.chassis == chassis && p.hidden == Some(hidden)).count();
                assert_eq!(cases > 2, hidden.is_of(chassis, seen), "{chassis:?} {hidden:?} {cases}");
            }
        }
    }

    #[test]
    fn a_case_is_the_same_twice_and_its_truth_has_its_numbers() {
        for plan in [Seen::Pose, Seen::Gyro].into_iter().flat_map(|seen| RollingPlan::set(3, 60, seen, 0)) {
            let case = plan.draw();
            assert_eq!(case.files, plan.draw().files);
            assert_eq!(case.truth.hidden, plan.hidden.into_iter().collect::<Vec<_>>());
            let has_wheel = matches!(plan.hidden, Some(Hidden::OneRadius | Hidden::Direction | Hidden::LostCounts));
            assert_eq!(case.truth.wheel.is_some(), has_wheel);
        }
    }
}
