//! Robots whose files name their columns: their recordings are tables, each a drive.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use case_files::columns::ColumnsEnvelope;
use case_files::columns_case::{ColumnsCase, kind_of};

use super::Settings;
use super::key;
use super::row::Measured;
use super::unit::Setup;

/// What recordings of such a robot are compared with: references are read with each of them.
pub(crate) struct Columns {
    /// The hash of all that answers share.
    pub(crate) key: String,
    /// Name of the robot, as it was given.
    pub(crate) robot: String,
    reference: Vec<PathBuf>,
}

impl Columns {
    /// The robot of a setup, if it is of such a kind.
    ///
    /// # Errors
    /// A robot file that cannot be read, and settings that such robots do not have.
    pub(crate) fn new(setup: &Setup, settings: &Settings) -> Result<Option<Self>> {
        let Some(kind) = kind_of(&setup.robot)? else { return Ok(None) };
        ensure!(
            setup.mapping.is_none(),
            "robot '{}' is of kind {} and names its columns itself, under [columns]; leave out the mapping",
            setup.robot,
            kind.name()
        );
        settings.options.known.refused_for(kind.name())?;
        let key = key::of_setup(setup, settings);
        Ok(Some(Self { key, robot: setup.robot.clone(), reference: setup.reference.clone() }))
    }

    /// Diagnoses one recording.
    ///
    /// # Errors
    /// Tables that cannot be read, or do not determine an answer.
    pub(crate) fn answer(&self, recording: &[PathBuf]) -> Result<(Measured, String, ColumnsEnvelope)> {
        let case = ColumnsCase::read(None, Some(&self.robot), [&self.reference, recording, &[]])?;
        let case = case.with_context(|| format!("robot file '{}' was changed meanwhile; start again", self.robot))?;
        let names = case.recordings();
        ensure!(
            names.len() == 1,
            "this is not one recording but {}: {}; give each by itself",
            names.len(),
            names.join(", ")
        );
        let measured = Measured::of_duration(case.duration());
        let diagnosis = case.diagnose(None, &|_| {})?;
        Ok((measured, case.robot_name().to_owned(), case.envelope(diagnosis)))
    }
}
