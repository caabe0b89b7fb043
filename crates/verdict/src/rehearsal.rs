//! What a rehearsal says: which effects a diagnosis would find on a robot's own inputs, from which size on.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::Word;

/// Version of the JSON of a rehearsal.
pub const REHEARSAL_FORMAT: u32 = 1;

/// All that a rehearsal says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rehearsal {
    /// Version of this structure.
    pub format: u32,
    /// What was simulated.
    pub drives: RehearsedDrives,
    /// Answers to replicas in which nothing was hidden.
    pub fault_free: Answers,
    /// Effects, those that are found from the smallest multiple on first.
    pub effects: Vec<RehearsedEffect>,
    /// Effects that were not rehearsed.
    pub left_out: Vec<NotRehearsed>,
    /// What was shortened or left away so that it takes minutes, in sentences.
    pub shortened: Vec<String>,
    /// What limits the answer, in sentences.
    pub limits: Vec<String>,
}

/// What every replica consists of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RehearsedDrives {
    /// Seed of all that is drawn.
    pub seed: u64,
    /// Replicas of each size.
    pub replicas: usize,
    /// Replicas in which nothing is hidden.
    pub fault_free_replicas: usize,
    /// References of a replica.
    pub references: usize,
    /// Recordings whose inputs are driven again, with the time that is, s.
    pub recordings: BTreeMap<String, f64>,
    /// Noise that sensors get: one sigma of each recorded channel.
    pub noise: Vec<SensorNoise>,
    /// Share of replicas from which on an effect counts as found.
    pub wanted_share: f64,
}

/// Noise of a channel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SensorNoise {
    /// The channel.
    pub channel: Word,
    /// One sigma in `unit`.
    pub sigma: f64,
    /// Its unit.
    pub unit: Word,
    /// Samples per second.
    pub rate: f64,
    /// Where the sigma comes from.
    pub source: Word,
}

/// How often each kind of answer was given.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Answers {
    /// Replicas that were diagnosed.
    pub replicas: usize,
    /// The hidden effect was named first.
    pub first: usize,
    /// Another was named first, the hidden one beside it or as one of its class.
    pub in_set: usize,
    /// "Something that is not in the catalogue".
    pub unknown: usize,
    /// "Nothing is missing".
    pub nothing: usize,
    /// Only others were named.
    pub wrong: usize,
    /// The diagnosis withheld an answer, or could not be made.
    pub withheld: usize,
    /// Other names that were given, alone, beside the hidden effect, or in one class with it: how often each.
    pub others: BTreeMap<String, usize>,
    /// Why diagnoses could not be made, each once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<String>,
}

impl Answers {
    /// Replicas whose answer holds the hidden effect.
    pub fn found(&self) -> usize {
        self.first + self.in_set
    }

    /// Replicas in which something was named or called unknown: of fault-free ones, the false alarms.
    pub fn alarmed(&self) -> usize {
        self.first + self.in_set + self.wrong + self.unknown
    }
}

/// An effect that was rehearsed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RehearsedEffect {
    /// Its id.
    pub effect: String,
    /// Its name for people.
    pub name: String,
    /// Size of interest on this robot, in `unit`.
    pub interest: f64,
    /// Unit of its sizes.
    pub unit: Word,
    /// What came out at each size, rising.
    pub sizes: Vec<RehearsedSize>,
    /// From where on it is found.
    pub found: FoundFrom,
    /// Other names that stood in the answers to its larger half of sizes: how often, of how many answers.
    pub look_alikes: Vec<LookAlike>,
}

/// What came out at a size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RehearsedSize {
    /// In sizes of interest.
    pub multiple: f64,
    /// In the unit of the effect.
    pub size: f64,
    /// The answers.
    pub answers: Answers,
    /// Share of replicas whose answer holds the effect, and its 95 % interval after Wilson.
    pub found: [f64; 3],
    /// Wheel speed of the replicas over that of the recordings (root mean squares, median of replicas).
    pub driven: f64,
}

/// The smallest simulated size from which on an effect is found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FoundFrom {
    /// At the smallest simulated size already; perhaps below it too.
    Below(f64),
    /// At this size and all larger ones, and not at the next smaller one.
    Size(f64),
    /// At none of the sizes, or not at the largest.
    Never,
}

/// Another name that stood in the answers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LookAlike {
    /// Its id.
    pub effect: String,
    /// Answers in which it stood.
    pub count: usize,
    /// Answers that were counted.
    pub of: usize,
}

/// An effect that was not rehearsed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NotRehearsed {
    /// Its id.
    pub effect: String,
    /// Why.
    pub why: Word,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_names_the_hidden_effect_is_found_and_what_names_or_suspects_anything_is_an_alarm() {
        let answers = Answers {
            replicas: 41,
            first: 5,
            in_set: 3,
            unknown: 2,
            nothing: 11,
            wrong: 7,
            withheld: 13,
            ..Answers::default()
        };
        assert_eq!(answers.found(), 8);
        assert_eq!(answers.alarmed(), 17);
        // All but these were told that nothing is missing, or nothing at all.
        assert_eq!(answers.replicas - answers.alarmed(), answers.nothing + answers.withheld);
    }
}
