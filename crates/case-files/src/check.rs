//! What is inside recordings, and how good it is: what `lacuna check` tells.

use std::path::PathBuf;

use anyhow::{Result, ensure};
use recordings::{
    Contents, Fingerprint, Quality, ReadOptions, Survey, SurveyedChannel, TableContents, group_by_content,
};
use serde_json::Value;

use crate::columns::Kind;
use crate::{Watch, which_mapping};
use find::Discovery;
pub use of_robot::{ColumnRead, DriveRead, OfRobot};

mod as_json;
mod find;
mod of_robot;
mod permits;
mod tables;

/// What is to be checked.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// Files, or folders of recordings.
    pub paths: &'a [PathBuf],
    /// Mapping file, or name of a built-in mapping; without it one is looked for.
    pub mapping: Option<&'a str>,
    /// A robot whose file names its columns itself, by which the recordings are read instead.
    pub robot: Option<(&'a str, Kind)>,
    /// What to do with bad rows and cells.
    pub options: ReadOptions,
}

/// Whom to tell how far the work is.
#[derive(Clone, Copy)]
pub struct Listener<'a> {
    /// A stage begins.
    pub stage: &'a dyn Fn(&str),
    /// So many bytes are read, of so many.
    pub bytes: Watch<'a>,
}

/// A channel and what was measured of it.
#[derive(Debug)]
pub struct Measured {
    /// Id of its signal.
    pub name: String,
    /// Column that it comes from.
    pub column: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// What was measured.
    pub quality: Quality,
}

/// A recording as a mapping reads it.
#[derive(Debug)]
pub struct Mapped {
    /// Its files.
    pub name: String,
    /// Its channels.
    pub channels: Vec<Measured>,
    /// Which diagnoses the signals permit, in sentences.
    pub permits: Vec<String>,
}

/// The mapping that was used.
#[derive(Debug)]
pub enum Used {
    /// By the user.
    Named(String),
    /// Found to fit.
    BuiltIn(String),
    /// Proposed for a bag.
    Proposed {
        /// The bag.
        bag: String,
        /// What was inferred, in sentences.
        inferred: Vec<String>,
    },
    /// None is needed: the robot file names its columns.
    RobotFile,
    /// None; why a proposed one does not read the recordings, if one was.
    Nothing(Option<String>),
}

/// A mapping that was written.
#[derive(Debug)]
pub struct Proposed {
    /// Where.
    pub file: String,
    /// What was inferred, in sentences.
    pub inferred: Vec<String>,
    /// Which column is which signal is still to be said.
    pub is_skeleton: bool,
}

/// All that was found.
#[derive(Debug)]
pub struct Checked {
    /// Bags and what is inside, before anybody has said what it means.
    pub bags: Vec<(String, Contents)>,
    /// Tables that no mapping fits.
    pub tables: Vec<(String, TableContents)>,
    /// The mapping that was used.
    pub mapping: Used,
    /// What it reads.
    pub recordings: Vec<Mapped>,
    /// What the columns of a robot file read, where one was named.
    pub of_robot: Option<OfRobot>,
    /// Recordings of the same data.
    pub same: Vec<Vec<String>>,
    /// Where a proposed mapping was written, if somebody did.
    pub proposed: Option<Proposed>,
    /// What was lost, in sentences.
    pub lost: Vec<String>,
}

impl Checked {
    /// All of it as JSON.
    pub fn to_json(&self) -> Value {
        as_json::render(self)
    }
}

/// Checks recordings. Nothing is written.
///
/// # Errors
/// What is missing or cannot be read, and recordings of which the named mapping reads none.
pub fn check(request: &Request<'_>, listener: &Listener<'_>) -> Result<Checked> {
    for path in request.paths {
        ensure!(path.exists(), "there is no file or folder '{}'", path.display());
    }
    if let Some((robot, kind)) = request.robot {
        return by_robot(robot, kind, request, listener);
    }
    let (bags, Discovery { mapping, surveyed, tables }) = find::find(request, listener)?;
    let prints: Vec<Fingerprint> = surveyed.surveys.iter().map(Survey::fingerprint).collect();
    let names: Vec<String> = surveyed.surveys.iter().map(file_names).collect();
    let same = group_by_content(&prints).into_iter().filter(|group| group.len() > 1);
    let same = same.map(|group| group.into_iter().map(|i| names[i].clone()).collect()).collect();
    let recordings = surveyed.surveys.iter().zip(&names).map(|(survey, name)| Mapped {
        name: name.clone(),
        permits: permits::permits(&survey.channels.iter().map(|channel| channel.signal).collect::<Vec<_>>()),
        channels: survey.channels.iter().map(measured).collect(),
    });
    // What a mapping reads of a bag is lost there as well: told once.
    let mut lost: Vec<String> = surveyed.lost().collect();
    for loss in bags.iter().flat_map(|(_, contents)| &contents.losses).map(ToString::to_string) {
        if !lost.contains(&loss) {
            lost.push(loss);
        }
    }
    lost.extend(tables.iter().filter_map(tables::lost));
    let recordings = recordings.collect();
    Ok(Checked { bags, tables, mapping, recordings, of_robot: None, same, proposed: None, lost })
}

/// The same by the columns of a robot file.
fn by_robot(robot: &str, kind: Kind, request: &Request<'_>, listener: &Listener<'_>) -> Result<Checked> {
    let mut bags = Vec::new();
    for bag in which_mapping::bags(request.paths)? {
        (listener.stage)(&bag.display().to_string());
        bags.push(which_mapping::look(&bag)?);
    }
    (listener.stage)("columns");
    let of_robot = of_robot::read(robot, kind, request.paths)?;
    let mut lost: Vec<String> = of_robot.iter().flat_map(OfRobot::refused).collect();
    lost.extend(bags.iter().flat_map(|(_, contents)| &contents.losses).map(ToString::to_string));
    Ok(Checked {
        bags,
        tables: Vec::new(),
        mapping: Used::RobotFile,
        recordings: Vec::new(),
        of_robot,
        same: Vec::new(),
        proposed: None,
        lost,
    })
}

fn measured(channel: &SurveyedChannel) -> Measured {
    Measured {
        name: channel.signal.name().to_owned(),
        column: channel.column.clone(),
        unit: channel.signal.unit().symbol(),
        quality: channel.quality.clone(),
    }
}

/// The files of a recording.
fn file_names(survey: &Survey) -> String {
    survey.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>().join(" + ")
}
