//! Speed-driven cases: set speeds, currents without sign, an inertial unit on its own clock, and something that happened.
//!
//! The robot is a law of steady torques of its own: rolling, dry and viscous drive trains that warm up, a scrub couple, an
//! effective track, slopes; nothing of it is the diagnoser's plant. What sensors show has the defects of a real skid-steer
//! robot: currents with an offset per side, a dead band and a step at 6.5 Hz, set-points for speeds, two clocks that drift
//! against each other, vibration on the accelerometer.

mod draw;
mod drive;
mod sheet;

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use drive::{Ground, Robot};

/// What is hidden in a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SpeedKind {
    /// Nothing: another day, a cold or a warm drive train.
    FaultFree,
    /// The body stands for a while though its wheels turn.
    Standing,
    /// A ramp on hard ground.
    Slope,
    /// Ground that gives way, the whole recording long.
    SoftGround,
    /// Slippery ground, the whole recording long.
    SlipperyGround,
    /// Mass on board.
    Payload,
    /// A side that drags.
    DraggingSide,
    /// Onto soft ground and back inside a recording.
    Crossing,
    /// Two of standing, slope and crossing in one drive.
    Several,
    /// Two or three stretches of other ground in one long drive, each soft or slippery.
    Grounds,
}

impl SpeedKind {
    /// All, with how many of 220 cases are of each.
    pub const SHARES: [(Self, usize); 10] = [
        (Self::FaultFree, 50),
        (Self::Standing, 30),
        (Self::Slope, 30),
        (Self::SoftGround, 15),
        (Self::SlipperyGround, 10),
        (Self::Payload, 10),
        (Self::DraggingSide, 10),
        (Self::Crossing, 15),
        (Self::Several, 30),
        (Self::Grounds, 20),
    ];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::FaultFree => "nothing",
            Self::Standing => "standing",
            Self::Slope => "slope",
            Self::SoftGround => "soft ground",
            Self::SlipperyGround => "slippery ground",
            Self::Payload => "payload",
            Self::DraggingSide => "dragging side",
            Self::Crossing => "crossing",
            Self::Several => "two events",
            Self::Grounds => "several grounds",
        }
    }
}

/// Which sensors of an inertial unit are recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    /// Three turning rates and an accelerometer.
    Accelerometer,
    /// Three turning rates.
    ThreeRates,
    /// The yaw rate alone.
    YawRate,
}

impl Sight {
    /// All.
    pub const ALL: [Self; 3] = [Self::Accelerometer, Self::ThreeRates, Self::YawRate];

    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accelerometer => "accelerometer",
            Self::ThreeRates => "three rates",
            Self::YawRate => "yaw rate",
        }
    }
}

/// Something that happened in a recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// What.
    pub kind: SpeedKind,
    /// From, until: s on the recording's own time.
    pub interval: [f64; 2],
    /// Of a slope: degrees, uphill along the robot positive.
    pub degrees: Option<f64>,
}

/// What was hidden in a case, for the scorer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpeedTruth {
    /// Name of the case.
    pub case: String,
    /// What is hidden.
    pub kind: SpeedKind,
    /// What was recorded beside speeds and currents.
    pub sight: Sight,
    /// What happened inside the recording.
    pub events: Vec<Event>,
    /// Steady torque of straight driving, both sides, on the references and in the recording: N m and N m per m/s.
    pub straight: [[f64; 2]; 2],
    /// Effective track on the references and in the recording, m.
    pub track: [f64; 2],
}

/// A drawn case: what the diagnoser gets, and what was hidden.
#[derive(Debug, Clone)]
pub struct SpeedCase {
    /// Files of the case by their path in it.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// What was hidden.
    pub truth: SpeedTruth,
}

/// Which case is to be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpeedPlan {
    /// Name of the case.
    pub name: String,
    /// Seed of the set.
    pub seed: u64,
    /// Number of the case in it.
    pub index: u64,
    /// What is hidden.
    pub kind: SpeedKind,
}

impl SpeedPlan {
    /// A set of so many cases, of each kind its share and of each at least one while there is room.
    pub fn set(seed: u64, count: usize) -> Vec<Self> {
        let total: usize = SpeedKind::SHARES.iter().map(|(_, share)| share).sum();
        // The largest remainders go first: each kind gets what it lacks most.
        let mut given = [0_usize; SpeedKind::SHARES.len()];
        for n in 1..=count {
            let lack = |k: usize| {
                let share = SpeedKind::SHARES[k].1 as f64 / total as f64;
                share * n as f64 - given[k] as f64 + if given[k] == 0 { 1.0 } else { 0.0 }
            };
            let most = (0..given.len()).max_by(|a, b| lack(*a).total_cmp(&lack(*b))).unwrap_or(0);
            given[most] += 1;
        }
        let kinds = given.iter().zip(SpeedKind::SHARES).flat_map(|(n, (kind, _))| std::iter::repeat_n(kind, *n));
        let plan = |(i, kind)| Self { name: format!("v{:03}", i + 1), seed, index: i as u64, kind };
        kinds.enumerate().map(plan).collect()
    }

    /// Draws the case.
    pub fn draw(&self) -> SpeedCase {
        draw::case(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_has_each_kind_in_its_share_and_a_small_one_each_once() {
        let all = SpeedPlan::set(1, 220);
        for (kind, share) in SpeedKind::SHARES {
            assert_eq!(all.iter().filter(|p| p.kind == kind).count(), share, "{kind:?}");
        }
        let few = SpeedPlan::set(1, 10);
        assert!(SpeedKind::SHARES.iter().all(|(kind, _)| few.iter().any(|p| p.kind == *kind)), "{few:?}");
    }

    #[test]
    fn a_case_is_the_same_twice_and_holds_what_its_truth_says() {
        for plan in SpeedPlan::set(5, 10) {
            let case = plan.draw();
            assert_eq!(case.files, plan.draw().files);
            let names: Vec<String> = case.files.iter().map(|(p, _)| p.display().to_string()).collect();
            assert!(names.iter().any(|n| n.starts_with("reference")), "{names:?}");
            assert_eq!(names.iter().filter(|n| n.starts_with("recordings")).count(), 2, "{names:?}");
            let events = case.truth.events.len();
            let expected = match plan.kind {
                SpeedKind::Standing | SpeedKind::Slope | SpeedKind::Crossing => 1..=1,
                SpeedKind::Several => 2..=2,
                SpeedKind::Grounds => 2..=3,
                _ => 0..=0,
            };
            assert!(expected.contains(&events), "{:?}: {events}", plan.kind);
            assert!(case.truth.events.iter().all(|e| e.interval[1] > e.interval[0] + 5.0), "{:?}", case.truth);
        }
    }
}
