//! Hypotheses that were fitted.

use serde::{Deserialize, Serialize};

use crate::Correction;

/// A hypothesis that was fitted in free run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Its effects, with side, axis and place.
    pub hypothesis: Vec<String>,
    /// Fall of the cost below "re-tune only", nats.
    pub gain: f64,
    /// Separate visits that support a place on the ground, if it names one.
    pub visits: Option<usize>,
    /// Gain less penalties, nats.
    pub score: f64,
    /// Its share of the probability.
    pub probability: f64,
    /// The simulation as this hypothesis would have it.
    pub correction: Correction,
}
