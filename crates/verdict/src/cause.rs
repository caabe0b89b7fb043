//! A possible cause and what is known about it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::Word;

/// One possible cause with what is known about it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cause {
    /// Effect id, "none" or "unknown".
    pub effect: String,
    /// Name for people, with side, axis and place.
    pub name: String,
    /// Probability that it is part of the truth.
    pub probability: f64,
    /// Size in `unit`.
    pub magnitude: Option<f64>,
    /// One sigma of the size.
    pub sigma: Option<f64>,
    /// Unit of the size.
    pub unit: Word,
    /// Every number of its law, by name; of a place also x, y and radius, m.
    pub parameters: BTreeMap<String, Estimate>,
    /// Side, when it sits on one.
    pub side: Option<Word>,
    /// Where on the ground, when it is a place: x, y, radius in m.
    pub place: Option<[f64; 3]>,
    /// When it was present in each recording, s; `None` when it was there all the time.
    pub intervals: Option<BTreeMap<String, Vec<[f64; 2]>>>,
}

/// A fitted number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// Its value in the unit of its specification.
    pub value: f64,
    /// One sigma, where it is known.
    pub sigma: Option<f64>,
    /// Whether the fit stopped at the end of what its specification calls sensible: the value is then no estimate.
    pub at_bound: bool,
}

impl Cause {
    /// Its numbers that stopped at the end of their range: name and that end.
    pub fn at_bounds(&self) -> impl Iterator<Item = (&str, f64)> {
        self.parameters.iter().filter(|(_, p)| p.at_bound).map(|(name, p)| (name.as_str(), p.value))
    }

    /// A cause of which only the probability is known.
    pub fn plain(effect: &str, name: &str, probability: f64) -> Self {
        Self {
            effect: effect.to_owned(),
            name: name.to_owned(),
            probability,
            magnitude: None,
            sigma: None,
            unit: "-".into(),
            parameters: BTreeMap::new(),
            side: None,
            place: None,
            intervals: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbers_that_stopped_at_the_end_of_their_range_are_told_as_such() {
        let mut cause = Cause::plain("grade", "slope", 0.8);
        for (name, value, at_bound) in [("angle", 0.1, false), ("heading", 3.1, true), ("onset", 2.0, false)] {
            cause.parameters.insert(name.to_owned(), Estimate { value, sigma: None, at_bound });
        }
        assert_eq!(cause.at_bounds().collect::<Vec<_>>(), [("heading", 3.1)]);
    }
}
