//! Loads of steady driving of a speed-driven robot.
use serde::Serialize;

/// Loads.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Loads {}
