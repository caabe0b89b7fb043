//! A robot with its references, read and calibrated once for all of its recordings.

use anyhow::{Context, Result};
use case_files::case_folder::{CaseFolder, file_names, robot_with};
use case_files::inputs::Loaded;
use case_files::own_effects;
use case_files::which_mapping::named_or_built_in;
use recordings::{Mapping, Read, Recording};
use robot_file::RobotSpec;
use verdict::{Coverage, Diagnosis};

use super::Settings;
use super::key;
use super::unit::Setup;

/// What recordings of a robot are compared with.
pub(crate) struct Prepared {
    pub(crate) robot: RobotSpec,
    /// The hash of all that is prepared here.
    pub(crate) key: String,
    /// What was read of the references, without their samples.
    reference: Loaded,
    /// The references with their samples, for long recordings to be compared with.
    compared: Vec<Read>,
    /// Where references were long: what they stand for.
    of_reference: Option<Coverage>,
    /// The mapping that was named, or that reads the references.
    mapping: Option<Mapping>,
    ready: diagnosis::Prepared,
}

impl Prepared {
    /// Reads a robot and its references and calibrates the model on them.
    ///
    /// # Errors
    /// What cannot be read, and references that do not determine the model.
    pub(crate) fn new(setup: &Setup, settings: &Settings) -> Result<Self> {
        let key = key::of_setup(setup, settings);
        let robot = robot_with(settings.options.known, &setup.robot)?;
        own_effects::ensure_torque_driven(&robot)?;
        let name = setup.mapping.as_deref();
        let known = name.is_some() || !setup.reference.is_empty();
        let mapping = known.then(|| named_or_built_in(name, &setup.reference)).transpose()?;
        let (mut reference, of_reference) = match &mapping {
            Some(mapping) if !setup.reference.is_empty() => {
                settings.budget.load(mapping, &setup.reference, &settings.reading, (robot.causality, &[]))?
            }
            _ => (Loaded::default(), None),
        };
        // The conversions are those of a case.
        let none = Loaded::default;
        let case = CaseFolder::new(robot, [std::mem::take(&mut reference), none(), none()])?;
        let ready = diagnosis::Prepared::new(case.case()?, &settings.options)?;
        let compared = case.reference.reads.clone();
        let reference = without_samples(case.reference)?;
        Ok(Self { robot: case.robot, key, reference, compared, of_reference, mapping, ready })
    }

    /// The mapping for a recording of this robot.
    pub(crate) fn mapping(&self, paths: &[std::path::PathBuf]) -> Result<Mapping> {
        self.mapping.clone().map_or_else(|| named_or_built_in(None, paths), Ok)
    }

    /// Diagnoses one recording; beside the answer the case that it is of.
    ///
    /// # Errors
    /// A recording without the signals that are needed, or that is one of the references.
    pub(crate) fn diagnose(
        &self,
        read: (Loaded, Option<Coverage>),
        settings: &Settings,
    ) -> Result<(Diagnosis, CaseFolder)> {
        let (recordings, coverage) = read;
        let none = Loaded::default;
        let mut case = CaseFolder::new(self.robot.clone(), [none(), recordings, none()])?;
        let covered = [("reference", &self.of_reference), ("recordings", &coverage)];
        let covered = covered.into_iter().filter_map(|(part, c)| Some((part.to_owned(), c.clone()?)));
        case.coverage = covered.collect();
        let mut diagnosis = self.ready.diagnose(case.case()?, &settings.options, &|_: &str| {})?;
        case.complete(&mut diagnosis);
        case.reference = self.reference.clone();
        case.refuse_twins()?;
        Ok((diagnosis, case))
    }

    /// Reads a recording: of a long one, the stretches that the diagnosis rests on.
    ///
    /// # Errors
    /// What cannot be read.
    pub(crate) fn read(
        &self,
        mapping: &Mapping,
        paths: &[std::path::PathBuf],
        settings: &Settings,
    ) -> Result<(Loaded, Option<Coverage>)> {
        settings.budget.load(mapping, paths, &settings.reading, (self.robot.causality, &self.compared))
    }
}

/// What was read, less the samples: they have become runs.
fn without_samples(loaded: Loaded) -> Result<Loaded> {
    let bare = |read: Read| -> Result<Read> {
        let name = read.recording.name().to_owned();
        let recording = Recording::new(name, Vec::new(), Vec::new()).with_context(|| file_names(&read))?;
        Ok(Read { recording, ..read })
    };
    let reads = loaded.reads.into_iter().map(bare).collect::<Result<_>>()?;
    Ok(Loaded { reads, ..loaded })
}
