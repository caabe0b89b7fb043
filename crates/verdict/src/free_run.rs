//! Errors of the simulation on recordings that were left out of a fit.

use serde::{Deserialize, Serialize};

/// Free-run errors of a recording that was not used for the fit, rms.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FreeRun {
    /// Name of the recording that was left out.
    pub recording: String,
    /// What is compared, with its unit.
    pub quantity: String,
    /// The user's model as it is.
    pub nominal: f64,
    /// Re-tuned without any effect.
    pub retuned: f64,
    /// Corrected by the named effects.
    pub corrected: f64,
    /// Corrected by the best wrong effect, given the same freedom; `None` when no other effect was fitted.
    pub placebo: Option<f64>,
}
