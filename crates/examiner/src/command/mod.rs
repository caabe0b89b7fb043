//! Command-driven cases: commanded and measured wheel speeds and a pose, and something between them that the simulation,
//! whose wheels do what is commanded and whose body rolls without slip, does not have.
//!
//! The drive is a discrete controller of 200 Hz with wheels of second order behind it, each side by itself; the body turns
//! about a centre that wanders with speed and loses a share of its way in turns by a law of its own. Encoders count whole
//! ticks, the pose scatters and comes with a delay of its own.

mod draw;
mod drive;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use drive::Robot;

/// Something hidden between command and motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Hidden {
    /// Commands act late.
    DeadTime,
    /// Speeds answer commands with a lag.
    Lag,
    /// The controller scales forward speed and turning.
    Gains,
    /// The controller limits turning.
    TurnLimit,
    /// The controller limits accelerations.
    Ramps,
    /// The body turns less than the track says.
    Track,
    /// Wheels roll with another radius.
    Radius,
    /// Forward speed is lost in turns.
    TurnSlip,
    /// One side rolls with another radius than the other.
    SideRadius,
}

impl Hidden {
    /// All.
    pub const ALL: [Self; 9] = [
        Self::DeadTime,
        Self::Lag,
        Self::Gains,
        Self::TurnLimit,
        Self::Ramps,
        Self::Track,
        Self::Radius,
        Self::TurnSlip,
        Self::SideRadius,
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::DeadTime => "dead time",
            Self::Lag => "lag",
            Self::Gains => "gains",
            Self::TurnLimit => "limit of turning",
            Self::Ramps => "limits of acceleration",
            Self::Track => "effective track",
            Self::Radius => "rolling radius",
            Self::TurnSlip => "slip in turns",
            Self::SideRadius => "one side's radius",
        }
    }

    /// Whether it sits between command and wheel.
    pub fn is_drive(self) -> bool {
        matches!(self, Self::DeadTime | Self::Lag | Self::Gains | Self::TurnLimit | Self::Ramps)
    }
}

/// What was hidden in a case, for the scorer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CommandTruth {
    /// Name of the case.
    pub case: String,
    /// What is hidden.
    pub hidden: Vec<Hidden>,
    /// Its numbers by name: `dead_time` s, `lag` s, `forward_gain`, `turn_gain`, `turn_limit` rad/s (half the difference of
    /// the sides), `forward_ramp` and `turn_ramp` rad/s², `track_factor`, `radius_factor`, `side_radius`.
    pub numbers: BTreeMap<String, f64>,
}

/// A drawn case: what the diagnoser gets, and what was hidden.
#[derive(Debug, Clone)]
pub struct CommandCase {
    /// Files of the case by their path in it.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// What was hidden.
    pub truth: CommandTruth,
}

/// Which case is to be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CommandPlan {
    /// Name of the case.
    pub name: String,
    /// Seed of the set.
    pub seed: u64,
    /// Number of the case in it.
    pub index: u64,
    /// How many things are hidden.
    pub hidden: usize,
    /// The first of them.
    pub first: Hidden,
    /// Drives before anything is hidden.
    pub references: usize,
    /// What the robot file lacks in all drives, references included.
    pub in_all: Option<Hidden>,
}

impl CommandPlan {
    /// A set of so many cases: in a quarter nothing is hidden, in a half one thing, in a quarter one between command and
    /// wheel and one between wheel and body. Where there are references, in every other case something else is there in all
    /// drives.
    pub fn set(seed: u64, count: usize, references: usize) -> Vec<Self> {
        let plan = |i: usize| Self {
            name: format!("c{:03}", i + 1),
            seed,
            index: i as u64,
            hidden: [0, 1, 1, 2][i % 4],
            first: Hidden::ALL[(i / 4 * 2 + usize::from(i % 4 == 2)) % Hidden::ALL.len()],
            references,
            in_all: (references > 0 && (i / 4 + i).is_multiple_of(2)).then_some(Self::FLAWS[i / 2 % Self::FLAWS.len()]),
        };
        (0..count).map(plan).collect()
    }

    /// What robot files lack most often.
    const FLAWS: [Hidden; 4] = [Hidden::DeadTime, Hidden::Track, Hidden::Lag, Hidden::TurnSlip];

    /// Draws the case.
    pub fn draw(&self) -> CommandCase {
        draw::case(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_hides_everything_as_often() {
        let all = CommandPlan::set(1, 200, 0);
        assert_eq!([0, 1, 2].map(|n| all.iter().filter(|p| p.hidden == n).count()), [50, 100, 50]);
        for hidden in Hidden::ALL {
            let singles = all.iter().filter(|p| p.hidden == 1 && p.first == hidden).count();
            assert!((10..=13).contains(&singles), "{hidden:?} {singles}");
        }
    }

    #[test]
    fn a_case_is_the_same_twice_and_its_truth_has_its_numbers() {
        for plan in CommandPlan::set(3, 12, 0) {
            let case = plan.draw();
            assert_eq!(case.files, plan.draw().files);
            assert_eq!(case.truth.hidden.len(), plan.hidden, "{:?}", case.truth);
            assert_eq!(case.truth.numbers.is_empty(), plan.hidden == 0 || case.truth.hidden == [Hidden::TurnSlip]);
            let two = case.truth.hidden.iter().filter(|h| h.is_drive()).count();
            assert!(plan.hidden < 2 || two == 1, "{:?}", case.truth);
        }
    }
}
