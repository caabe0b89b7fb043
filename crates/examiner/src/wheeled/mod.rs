//! Robots of several kinds of wheels under the torques of their motors, beside a pose and a gyro, or a gyro alone, with something
//! that the robot file does not have.
//!
//! A speed controller drives smooth random motions; its torques are recorded. Tyres are brushes with a sliding level, dry friction
//! is a steep sigmoid, loads are those of springs, casters swing: laws and steps of its own.

mod draw;
mod plant;
mod sheet;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

/// A kind of robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Layout {
    /// Two driven wheels and two casters.
    Differential,
    /// A driven and steered front wheel before two free wheels.
    Tricycle,
    /// Two steered wheels, and a rear axle driven through a differential.
    Car,
    /// Three omni wheels.
    Omni3,
    /// Four omni wheels.
    Omni4,
    /// Four mecanum wheels.
    Mecanum4,
    /// Six wheels, those of a side on one motor.
    SixWheel,
}

impl Layout {
    /// All.
    pub const ALL: [Self; 7] =
        [Self::Differential, Self::Tricycle, Self::Car, Self::Omni3, Self::Omni4, Self::Mecanum4, Self::SixWheel];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Differential => "differential",
            Self::Tricycle => "tricycle",
            Self::Car => "car",
            Self::Omni3 => "three omni wheels",
            Self::Omni4 => "four omni wheels",
            Self::Mecanum4 => "four mecanum wheels",
            Self::SixWheel => "six wheels",
        }
    }

    /// Whether its wheels carry rollers.
    pub fn has_rollers(self) -> bool {
        matches!(self, Self::Omni3 | Self::Omni4 | Self::Mecanum4)
    }

    /// Whether a wheel is steered.
    pub fn is_steered(self) -> bool {
        matches!(self, Self::Tricycle | Self::Car)
    }
}

/// Something hidden in a robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WheeledHidden {
    /// A payload in the middle of the mass.
    Mass,
    /// The centre of mass is elsewhere.
    CentreOfMass,
    /// A motor, or the only one, has more dry friction.
    DryFriction,
    /// The same, viscous.
    ViscousFriction,
    /// A motor, or the only one, gives less torque, or more.
    TorqueScale,
    /// Torques come with a lag.
    Lag,
    /// One driven wheel has another radius.
    Radius,
    /// A fixed wheel points elsewhere.
    Direction,
    /// The steering's zero is off.
    SteeringZero,
    /// The steering turns more or less than it says.
    SteeringGain,
    /// Wheels roll hard.
    Rolling,
    /// The air holds the body.
    Drag,
    /// Rollers roll hard.
    RollerDrag,
    /// Casters roll hard.
    CasterDrag,
    /// The ground is a slope.
    Slope,
}

impl WheeledHidden {
    /// All.
    pub const ALL: [Self; 15] = [
        Self::Mass,
        Self::CentreOfMass,
        Self::DryFriction,
        Self::ViscousFriction,
        Self::TorqueScale,
        Self::Lag,
        Self::Radius,
        Self::Direction,
        Self::SteeringZero,
        Self::SteeringGain,
        Self::Rolling,
        Self::Drag,
        Self::RollerDrag,
        Self::CasterDrag,
        Self::Slope,
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::CentreOfMass => "centre of mass",
            Self::DryFriction => "dry friction of a motor",
            Self::ViscousFriction => "viscous friction of a motor",
            Self::TorqueScale => "torque of a motor",
            Self::Lag => "lag of motors",
            Self::Radius => "radius of one wheel",
            Self::Direction => "direction of a wheel",
            Self::SteeringZero => "zero of the steering",
            Self::SteeringGain => "gain of the steering",
            Self::Rolling => "rolling resistance",
            Self::Drag => "drag of the air",
            Self::RollerDrag => "drag of rollers",
            Self::CasterDrag => "drag of casters",
            Self::Slope => "slope",
        }
    }

    /// Whether it may begin while a robot drives.
    pub fn can_begin(self) -> bool {
        !matches!(self, Self::CentreOfMass | Self::Direction | Self::Radius | Self::Lag | Self::Slope)
    }

    /// Whether a robot of this kind can have it, and its drives can show it.
    pub fn is_of(self, layout: Layout) -> bool {
        match self {
            Self::SteeringZero | Self::SteeringGain => layout.is_steered(),
            Self::RollerDrag => layout.has_rollers(),
            Self::CasterDrag => layout == Layout::Differential,
            // Where one motor turns a side of six wheels, one radius of them hardly shows, nor does one wheel's direction.
            Self::Radius => matches!(layout, Layout::Differential | Layout::Car) || layout.has_rollers(),
            Self::Direction => layout == Layout::Tricycle,
            // Where all wheels carry the mass alike it shows only in turns on the spot.
            Self::CentreOfMass => matches!(layout, Layout::SixWheel | Layout::Differential),
            _ => true,
        }
    }
}

/// What was hidden in a case, for the scorer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WheeledTruth {
    /// Name of the case.
    pub case: String,
    /// Kind of the robot.
    pub layout: Layout,
    /// What is hidden.
    pub hidden: Vec<WheeledHidden>,
    /// The motor or wheel that it is about.
    pub part: Option<String>,
    /// Its numbers as the robot has them, by what they are.
    pub numbers: BTreeMap<String, f64>,
    /// The recording in which it begins, and when, s from its start; it is there in all after it, and in none before. `None` where it is
    /// there all the time.
    pub onset: Option<(String, f64)>,
}

/// A drawn case: what the diagnoser gets, and what was hidden.
#[derive(Debug, Clone)]
pub struct WheeledCase {
    /// Files of the case by their path in it.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// What was hidden.
    pub truth: WheeledTruth,
}

/// Which case is to be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WheeledPlan {
    /// Name of the case.
    pub name: String,
    /// Seed of the set.
    pub seed: u64,
    /// Number of the case in it.
    pub index: u64,
    /// Kind of the robot.
    pub layout: Layout,
    /// What is hidden.
    pub hidden: Option<WheeledHidden>,
    /// Whether it begins in the course of a recording.
    pub begins: bool,
    /// Drives before anything is hidden.
    pub references: usize,
}

impl WheeledPlan {
    /// A set of so many cases: every kind of robot in turn; in a quarter nothing is hidden, in the others one thing, each as
    /// often as kinds permit. In another quarter it begins while the robot drives, where it can.
    pub fn set(seed: u64, count: usize, references: usize) -> Vec<Self> {
        let mut turn = [0; Layout::ALL.len()];
        let mut plan = |i: usize| {
            let kind = i % Layout::ALL.len();
            let layout = Layout::ALL[kind];
            let of: Vec<WheeledHidden> = WheeledHidden::ALL.into_iter().filter(|h| h.is_of(layout)).collect();
            let hidden = (!(i / Layout::ALL.len()).is_multiple_of(4)).then(|| {
                turn[kind] += 1;
                // Each kind begins elsewhere, so that a small set has many sorts.
                of[(turn[kind] - 1 + 2 * kind) % of.len()]
            });
            let begins = i / Layout::ALL.len() % 4 == 2 && hidden.is_some_and(WheeledHidden::can_begin);
            Self { name: format!("w{:03}", i + 1), seed, index: i as u64, layout, hidden, begins, references }
        };
        (0..count).map(&mut plan).collect()
    }

    /// Draws the case.
    pub fn draw(&self) -> WheeledCase {
        draw::case(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_hides_nothing_in_a_quarter_and_everything_that_a_kind_can_have() {
        let all = WheeledPlan::set(1, 560, 0);
        assert_eq!(all.iter().filter(|p| p.hidden.is_none()).count(), 140);
        let begin = all.iter().filter(|p| p.begins).count();
        assert!((60..140).contains(&begin) && all.iter().all(|p| !p.begins || p.hidden.is_some()), "{begin}");
        for (layout, hidden) in Layout::ALL.into_iter().flat_map(|l| WheeledHidden::ALL.map(|h| (l, h))) {
            let cases = all.iter().filter(|p| p.layout == layout && p.hidden == Some(hidden)).count();
            assert_eq!(cases > 2, hidden.is_of(layout), "{layout:?} {hidden:?} {cases}");
        }
    }

    #[test]
    fn a_case_is_the_same_twice_and_its_robot_moves() {
        for plan in WheeledPlan::set(3, 21, 0) {
            let case = plan.draw();
            assert_eq!(case.files, plan.draw().files);
            assert_eq!(case.truth.hidden, plan.hidden.into_iter().collect::<Vec<_>>());
            assert_eq!(case.truth.onset.is_some(), plan.begins);
            let table = String::from_utf8(case.files[1].1.clone()).expect("text");
            let numbers = |line: &str| line.split(',').filter_map(|x| x.parse().ok()).collect::<Vec<f64>>();
            let last = numbers(table.lines().last().expect("rows"));
            assert!(last.iter().all(|x| x.is_finite() && x.abs() < 1e4), "{plan:?} {last:?}");
            let width = table.lines().next().expect("a header").split(',').count();
            let ways = table.lines().skip(1).map(|line| numbers(line)[width - 3]);
            assert!(ways.fold(0.0, |most, x| f64::max(most, x.abs())) > 0.3, "{plan:?} hardly moves");
        }
    }
}
