//! A robot on the inputs of a drive.

use anyhow::Context;
use case_files::case_folder::file_names;
use case_files::own_effects;
use case_files::simulated::simulated;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::case::{self, Part, RobotGiven};
use crate::{arrays, work};

/// Simulates a robot on the inputs of a drive: what ideal sensors show, with the effects of the robot applied.
///
/// A torque-driven robot takes the commanded torques of both sides, and starts in the state of the first row where all of it
/// was recorded, else at rest. A speed-driven robot takes the wheel speeds, and the torque that they take comes out. A
/// command-driven robot takes the commanded wheel speeds.
///
/// Parameters
/// ----------
/// robot : path or dict
///     Robot file, name of a built-in robot, or a robot file as a dict; it may hold ``effects``.
/// inputs : path or dict of arrays
///     A recording. A dict has ``t`` (s, rising) and signals of the same length under their ids (``torque_left``) or
///     columns' names (``torque_left_Nm``), in SI; nan where a sample is missing.
/// mapping : path, optional
///     Mapping file, or name of a built-in mapping, for a recording that is a file.
/// effects : path or iterable of paths, optional
///     Law files of the robot's ``effects`` that are your own (torque-driven robots).
///
/// Returns
/// -------
/// dict of numpy.ndarray
///     ``t`` (s) and each signal under its column's name, all of one length: a recording that ``diagnose`` takes, and the
///     columns of the mapping ``skid-steer-columns``.
///
/// Raises
/// ------
/// LacunaError
///     When inputs are missing or cannot be read, or the simulation does not stay finite.
#[pyfunction]
#[pyo3(signature = (robot, inputs, *, mapping=None, effects=None))]
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    robot: &Bound<'py, PyAny>,
    inputs: &Bound<'py, PyAny>,
    mapping: Option<&Bound<'py, PyAny>>,
    effects: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (robot, mapping) = (RobotGiven::of(robot)?, case::mapping(mapping)?);
    let inputs = Part::of(Some(inputs), "drive")?;
    let (options, known) = (case::reading("normal")?, case::effects(effects, None)?);
    let shown = work::run(py, move || {
        let robot = robot.open(known)?;
        own_effects::ensure_torque_driven(&robot)?;
        let read = inputs.only(mapping.as_deref(), options)?;
        simulated(&robot, &read.recording).with_context(|| file_names(&read))
    })?;
    arrays::dict(py, &shown)
}
