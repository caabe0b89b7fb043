//! What is diagnosed by itself: one recording of one robot.

use std::path::PathBuf;

use super::date::Date;

/// What recordings of the same robot share, and what is therefore prepared once.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Setup {
    /// Robot file, or name of a built-in robot.
    pub robot: String,
    /// Drives in which its simulation was right.
    pub reference: Vec<PathBuf>,
    /// Mapping file or name, if one was named.
    pub mapping: Option<String>,
}

/// One recording with all that is needed to diagnose it.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Its name, which no other unit has.
    pub id: String,
    /// Its files.
    pub recording: Vec<PathBuf>,
    /// Which vehicle it is of; the name in the robot file if nobody says.
    pub robot_id: Option<String>,
    /// When it was recorded; its own stamps, where they tell, if nobody says.
    pub date: Option<Date>,
    /// Robot, references and mapping.
    pub setup: Setup,
}

/// What holds for units that do not say otherwise.
#[derive(Debug, Clone, Default)]
pub struct Defaults {
    /// Robot file, or name of a built-in robot.
    pub robot: Option<String>,
    /// References.
    pub reference: Vec<PathBuf>,
    /// Mapping file or name.
    pub mapping: Option<String>,
}
