//! What the drives of a case say, as plain data.

use crate::constants::Measured;
use crate::drive::Drive;
use crate::motion::Laws;
use crate::settings::SETTINGS;
use crate::traces::predicted;
use crate::wheel::WheeledRobot;
use catalogue::CauseSpec;
use verdict::{PredictedPath, Trace};

/// Kind of answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Wheels and pose agree as well as the robot is known: nothing is missing.
    Nothing,
    /// They agree once constants are set within what the owner states.
    Retune,
    /// Causes beyond that were named.
    Named,
    /// Something is missing, and nothing that can be named accounts for it.
    Unknown,
}

/// A constant as it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Its name.
    pub name: String,
    /// Unit of the values.
    pub unit: &'static str,
    /// As the robot file, or the references, have it.
    pub given: f64,
    /// As the recordings have it.
    pub value: f64,
    /// Half width of its 90 % interval.
    pub half_width: f64,
    /// How far it moved, in the sigmas with which it was known.
    pub sigmas: f64,
}

impl Estimate {
    /// Whether it moved by a good part of what is known of it, to where its interval leaves the given value out.
    pub fn is_moved(&self) -> bool {
        (self.value - self.given).abs() > self.half_width && self.sigmas.abs() > SETTINGS.naming.moved
    }
}

/// A cause that was named, or may be.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCause {
    /// What is known about it.
    pub spec: &'static CauseSpec,
    /// Its id with what it is about.
    pub label: String,
    /// Probability that it is part of the truth.
    pub probability: f64,
    /// Labels of causes that these drives cannot tell from it.
    pub alike: Vec<String>,
    /// The constants that it moves.
    pub estimates: Vec<Estimate>,
    /// When it was there: recording, and from when to when, s; empty where it was there all the time.
    pub intervals: Vec<(String, [f64; 2])>,
}

/// What the drives of a case say.
#[derive(Debug, Clone)]
pub struct Findings {
    /// Kind of answer.
    pub answer: Answer,
    /// Causes that were named, the one that the data would miss most first.
    pub named: Vec<NamedCause>,
    /// Causes that were not, with their probabilities.
    pub others: Vec<(String, f64)>,
    /// All constants with the named causes.
    pub constants: Vec<Estimate>,
    /// Constants re-tuned within what is known, with no cause.
    pub retuned: Vec<Estimate>,
    /// The cause that is little less probable than the first.
    pub rival: Option<String>,
    /// Sigma of a window's error, m.
    pub noise: f64,
    /// Factor on the usual scatter of constants between sessions.
    pub scatter: f64,
    /// Root mean square error of windows over their way: as given, re-tuned, with the named causes.
    pub shares: [f64; 3],
    /// Sessions, drives, windows.
    pub counts: [usize; 3],
    /// What the drives measure of the body's motion.
    pub measured: Measured,
    /// What was done to the recordings, for people.
    pub told: Vec<String>,
    /// The recordings beside the simulations that were fitted to them.
    pub traces: Vec<Trace>,
    /// As stated, re-tuned, with the named causes.
    pub(crate) laws: [Laws; 3],
}

impl Findings {
    /// The pose of a drive from its counts alone. It begins in the first row of each stretch in which the pose was seen, and anew
    /// in the last one where rows follow in which it was not; at the origin where it was never seen.
    pub fn predict(&self, robot: &WheeledRobot, drive: &Drive) -> PredictedPath {
        let [_, retuned, corrected] = &self.laws;
        let path = |laws: &Laws| predicted(robot, drive, laws);
        PredictedPath {
            name: drive.name.clone(),
            time: drive.time.clone(),
            corrected: path(corrected),
            retuned: path(retuned),
        }
    }
}
