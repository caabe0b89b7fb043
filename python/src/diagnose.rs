//! From drives to a verdict.

use case_files::envelope::Envelope;
use case_files::visits::GivenVisit;
use pyo3::prelude::*;

use crate::case::{self, Part, RobotGiven};
use crate::diagnosis::Diagnosis;
use crate::error::LacunaError;
use crate::work::{self, Listener};

/// Length of the drives that are advised, s: that of `lacuna diagnose --next`.
const NEXT_LENGTH: f64 = 12.0;

/// Names what a simulation lacks, by comparing drives in which it was right with drives in which it was not.
///
/// Either a case folder is given, or a robot with its drives. The interpreter's lock is released meanwhile; an interrupt ends
/// the work at its next stage, of which there are about seven. The same input gives the same answer, whatever the number of
/// threads.
///
/// Parameters
/// ----------
/// case : path, optional
///     Folder with robot.toml (or robot.json), reference/, recordings/ and perhaps heldout/.
/// robot : path or dict, optional
///     Robot file, name of a built-in robot, or a robot file as a dict.
/// reference, recordings, heldout : path, dict of arrays, or iterable of them, optional
///     Drives in which the simulation was right; in which it was not; whose response is to be predicted. A dict has ``t``
///     (s, rising) and signals of the same length under their ids (``torque_left``) or columns' names
///     (``torque_left_Nm``), in SI; nan where a sample is missing; perhaps a ``name``. Arrays are copied once.
/// mapping : path, optional
///     Mapping file, or name of a built-in mapping, for drives that are files.
/// reading : {"normal", "strict", "tolerant"}
///     What to do with bad rows and cells of files.
/// same_robot : bool
///     Nobody changed the robot since it was right: its mass, motors and wheels are not weighed (torque- and speed-driven
///     robots).
/// visit : list of str, optional
///     Drives of one day, place and load, between which constants do not move (torque-driven robots): ``name=file,file`` for
///     each visit, as ``--visit`` of the command line.
/// effects : path or iterable of paths, optional
///     Law files, as ``lacuna law --save`` writes them: each is an effect of your own beside those of the catalogue
///     (torque-driven robots).
/// adopt : path or iterable of paths, optional
///     Law files that become part of the simulation at their numbers: what it lacks in every drive (torque-driven robots).
/// next : bool
///     Advise on the next drive too: a few seconds more.
/// progress : callable, optional
///     Is called with the name of each stage as it begins. What it raises ends the work.
///
/// Returns
/// -------
/// Diagnosis
///
/// Raises
/// ------
/// LacunaError
///     When something is missing or cannot be read, or the recordings do not determine an answer.
#[pyfunction]
#[pyo3(signature = (case=None, *, robot=None, reference=None, recordings=None, heldout=None, mapping=None,
    reading="normal", same_robot=false, visit=None, effects=None, adopt=None, next=false, progress=None))]
#[expect(clippy::too_many_arguments, reason = "each is a keyword of its own in Python")]
pub(crate) fn diagnose(
    py: Python<'_>,
    case: Option<&Bound<'_, PyAny>>,
    robot: Option<&Bound<'_, PyAny>>,
    reference: Option<&Bound<'_, PyAny>>,
    recordings: Option<&Bound<'_, PyAny>>,
    heldout: Option<&Bound<'_, PyAny>>,
    mapping: Option<&Bound<'_, PyAny>>,
    reading: &str,
    same_robot: bool,
    visit: Option<Vec<String>>,
    effects: Option<&Bound<'_, PyAny>>,
    adopt: Option<&Bound<'_, PyAny>>,
    next: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Diagnosis> {
    let folder = case.map(case::path).transpose()?;
    let robot = robot.map(RobotGiven::of).transpose()?;
    let parts = [Part::of(reference, "reference")?, Part::of(recordings, "recording")?, Part::of(heldout, "heldout")?];
    if folder.is_some() && parts.iter().any(|part| !part.is_empty()) {
        return Err(LacunaError::new_err("a case folder has its drives; give either it, or a robot with drives"));
    }
    if folder.is_none() && robot.is_none() {
        return Err(LacunaError::new_err("no robot was named; give a case folder, or robot = with drives"));
    }
    let visits = visit.unwrap_or_default();
    let visits = visits.iter().map(|text| GivenVisit::parse(text)).collect::<Result<Vec<_>, _>>();
    let visits = visits.map_err(LacunaError::new_err)?;
    let (mapping, read) = (case::mapping(mapping)?, case::reading(reading)?);
    let known = case::effects(effects, adopt)?;
    let usual = inference::Options::default();
    let options = inference::Options { next: next.then_some(NEXT_LENGTH), same_robot, known, ..usual };
    let (envelope, found) = work::run(py, || {
        let listener = Listener::new(progress);
        listener.stage("reading the recordings");
        let name = mapping.as_deref();
        let mut opened = match (&folder, &robot) {
            (None, Some(robot)) => case::drives(robot, known, parts, name, read)?,
            (folder, robot) => case::folder(&folder.clone().unwrap_or_default(), robot.as_ref(), name, read)?,
        };
        opened.case = opened.case.with_visits(&visits)?;
        let diagnosis = opened.case.diagnose(&options, &|what| listener.stage(what))?;
        let envelope = Envelope::new(diagnosis, &opened.case, &options, &opened.mapping, reading)?;
        Ok((envelope, opened.found))
    })?;
    Ok(Diagnosis::new(envelope, found))
}
