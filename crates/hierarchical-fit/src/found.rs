//! What the drives of a case say, as plain data.

use crate::cause::Cause;
use crate::name::Weighed;
use crate::settings::SETTINGS;
use catalogue::CauseSpec;

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

    /// Whether an owner may believe it of a constant that was re-tuned: others are no rival of a cause, however well they forecast.
    pub fn is_believable(&self) -> bool {
        self.sigmas.abs() <= SETTINGS.naming.within[0]
    }
}

/// When a cause begins, or ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Began {
    /// The drive in which it does.
    pub drive: String,
    /// When, s from its start, with a 90 % interval; `None` between two drives.
    pub at: Option<(f64, [f64; 2])>,
    /// The other drives in which it does so anew, and when.
    pub anew: Vec<(String, (f64, [f64; 2]))>,
    /// Whether it ends there.
    pub ends: bool,
    /// Whether there are drives after it, or before it where it ends.
    pub others: bool,
}

impl std::fmt::Display for Began {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { drive, at, anew, ends, others } = self;
        let [to, rest] = if *ends { ["until", "before"] } else { ["from", "after"] };
        let of = |drive: &str, at: f64, [least, most]: [f64; 2]| {
            format!("{to} {at:.0} s of drive '{drive}' (90 %: {least:.0} to {most:.0} s)")
        };
        match at {
            Some((at, interval)) => {
                write!(f, "it is there {}", of(drive, *at, *interval))?;
                for (drive, (at, interval)) in anew {
                    write!(f, ", {}", of(drive, *at, *interval))?;
                }
                if !anew.is_empty() {
                    write!(f, ": it {} in each of these drives anew", if *ends { "ends" } else { "begins" })?;
                } else if *others {
                    write!(f, ", and in all drives {rest} it in the order of their names")?;
                }
            }
            None if *ends => write!(f, "it is there in all drives before '{drive}', and no longer in it")?,
            None => write!(
                f,
                "it is there in drive '{drive}' and all after it in the order of their names, and not before"
            )?,
        }
        if *ends {
            f.write_str(", and predictions are made without it")?;
        }
        if self.is_in_one() {
            f.write_str("; no other drive shows it, so that no forecast of a drive that was left out can confirm it")?;
        }
        Ok(())
    }
}

impl Began {
    /// Whether it is there in a single drive.
    fn is_in_one(&self) -> bool {
        !self.others && self.anew.is_empty()
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
    /// When it begins or ends, where it does while the drives go on.
    pub onset: Option<Began>,
}

impl NamedCause {
    /// Whether it is there in a single drive, so that no forecast of another can confirm it.
    pub fn is_in_one_drive(&self) -> bool {
        self.onset.as_ref().is_some_and(Began::is_in_one)
    }

    /// A cause as it was weighed, with estimates of all constants, when it was there, and when it begins or ends.
    pub fn new(
        weighed: &Weighed,
        causes: &[Cause],
        constants: &[Estimate],
        (intervals, onset): (Vec<(String, [f64; 2])>, Option<Began>),
    ) -> Self {
        let cause = &causes[weighed.cause];
        Self {
            spec: cause.spec,
            label: cause.label(),
            probability: weighed.probability,
            alike: weighed.class[1..].iter().map(|&c| causes[c].label()).collect(),
            estimates: cause.moves().into_iter().map(|k| constants[k].clone()).collect(),
            intervals,
            onset,
        }
    }
}
