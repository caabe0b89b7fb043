//! What is drawn in one colour on all pages.

use serde::Serialize;

/// What a line or a bar stands for. It has one colour on all pages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// What was measured.
    Recorded,
    /// The simulation as it is.
    Before,
    /// The simulation with its constants re-tuned, without any effect.
    Retuned,
    /// The simulation with what was named.
    After,
    /// The best wrong correction.
    Placebo,
}
