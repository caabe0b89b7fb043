//! A diagnosis of a robot whose file names its columns itself, with what it was made from: what `lacuna diagnose --json` writes
//! of wheel motion beside a pose and of cars, and `lacuna report` reads.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use verdict::Diagnosis;

use crate::envelope::{FORMAT, Program, SourceFile};

/// Kinds of robots whose files name their columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Wheel motion beside a pose.
    Odometry,
    /// Throttle and steering in, motion out.
    Car,
    /// Torques of motors in, motion out, on any wheels.
    Wheeled,
}

impl Kind {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Odometry, Self::Car, Self::Wheeled];

    /// The kind of a robot file; `None` where it names no columns itself.
    pub(crate) fn of_file(text: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| match kind {
            Self::Odometry => odometry::file::RobotFile::is_one(text),
            Self::Car => single_track::file::RobotFile::is_one(text),
            Self::Wheeled => wheeled::file::RobotFile::is_one(text),
        })
    }

    /// The kind of a robot that is named, a file or built in.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn of_robot(name: &str) -> Result<Option<Self>> {
        Ok(named(name)?.map(|(kind, _)| kind))
    }

    /// Names and files of the robots that are built in.
    pub(crate) fn built_in(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Odometry => odometry::file::BUILT_IN,
            Self::Car => single_track::file::BUILT_IN,
            Self::Wheeled => wheeled::file::BUILT_IN,
        }
    }

    /// As robot files write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Odometry => "odometry",
            Self::Car => "car",
            Self::Wheeled => "wheeled",
        }
    }

    /// What is compared, for people.
    pub fn compares(self) -> &'static str {
        match self {
            Self::Odometry => "wheel motion beside a pose or a gyro",
            Self::Car => "motion beside throttle and steering",
            Self::Wheeled => "motion beside the torques of motors",
        }
    }
}

/// A diagnosis with all that it was made from. No clock and no machine in it: the same input gives the same text.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ColumnsEnvelope {
    /// Version of this form.
    pub format: u32,
    /// What kind of robot it is.
    pub kind: Kind,
    /// What wrote it.
    pub program: Program,
    /// The robot file, or the built-in robot's name.
    pub robot: String,
    /// What the robot file says, word by word; older verdicts have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robot_file: Option<String>,
    /// Files by the part they play: reference, recordings, heldout.
    pub sources: BTreeMap<String, Vec<SourceFile>>,
    /// Other things in the folders, which were not read.
    pub ignored_files: Vec<String>,
    /// The answer.
    pub diagnosis: Diagnosis,
}

impl ColumnsEnvelope {
    /// Packs a diagnosis with what it was made from: name and text of the robot file, files of the references, then of
    /// the recordings.
    pub fn new(
        kind: Kind,
        [robot, robot_file]: [&str; 2],
        files: &[Vec<SourceFile>; 3],
        ignored: &[String],
        diagnosis: Diagnosis,
    ) -> Self {
        let [reference, recordings, heldout] = files.clone();
        Self {
            format: FORMAT,
            kind,
            program: Program::default(),
            robot: robot.to_owned(),
            robot_file: Some(robot_file.to_owned()),
            sources: [("reference", reference), ("recordings", recordings), ("heldout", heldout)]
                .map(|(k, v)| (k.to_owned(), v))
                .into(),
            ignored_files: ignored.to_vec(),
            diagnosis,
        }
    }
}

/// What the file of a robot says that is named, a file or built in; `None` where it is of another kind.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn robot_text(name: &str, kind: Kind) -> Result<Option<String>> {
    Ok(named(name)?.filter(|(own, _)| *own == kind).map(|(_, text)| text))
}

/// The kind of a robot that is named, a file or built in, and what its file says.
fn named(name: &str) -> Result<Option<(Kind, String)>> {
    if Path::new(name).is_file() {
        let text = std::fs::read_to_string(name).with_context(|| format!("cannot read robot file '{name}'"))?;
        return Ok(Kind::of_file(&text).map(|kind| (kind, text)));
    }
    let built_in = |kind: Kind| {
        let (_, text) = kind.built_in().iter().find(|robot| robot.0 == name)?;
        Some((kind, (*text).to_owned()))
    };
    Ok(Kind::ALL.into_iter().find_map(built_in))
}
