//! What is inside recordings, and how good it is.

use case_files::columns_case;
use pyo3::prelude::*;

use crate::work::{self, Listener};
use crate::{case, from_json};

/// Tells what is inside recordings, and how good it is.
///
/// Parameters
/// ----------
/// paths : path or iterable of paths
///     Files, or folders of recordings: ROS 2 bags (MCAP, sqlite3), Parquet, CSV.
/// mapping : path, optional
///     Mapping file, or name of a built-in mapping. Without it one is looked for.
/// reading : {"normal", "strict", "tolerant"}
///     What to do with bad rows and cells.
/// robot : path, optional
///     Robot of wheel counts or car, whose file names its columns itself: the recordings are read by these.
///
/// Returns
/// -------
/// dict
///     What ``lacuna check --json`` writes: ``bags`` with their topics, ``tables``, the ``mapping`` that fits, and for each
///     of the ``recordings`` its ``channels`` (signal, unit in SI, rate in Hz, findings) and the diagnoses that they permit.
///
/// Raises
/// ------
/// LacunaError
///     When a file is missing or cannot be read.
#[pyfunction]
#[pyo3(signature = (paths, *, mapping=None, reading="normal", robot=None))]
pub(crate) fn check<'py>(
    py: Python<'py>,
    paths: &Bound<'py, PyAny>,
    mapping: Option<&Bound<'py, PyAny>>,
    reading: &str,
    robot: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (paths, mapping, options) = (case::paths(paths)?, case::mapping(mapping)?, case::reading(reading)?);
    let robot = case::mapping(robot)?;
    let found = work::run(py, move || {
        let listener = Listener::new(None);
        let (stage, bytes) = (|what: &str| listener.stage(what), |done, _| listener.read(done));
        let robot = robot.as_deref().map(|robot| anyhow::Ok((robot, columns_case::needed_kind(robot)?))).transpose()?;
        let request = case_files::check::Request { paths: &paths, mapping: mapping.as_deref(), robot, options };
        let checked =
            case_files::check::check(&request, &case_files::check::Listener { stage: &stage, bytes: &bytes })?;
        Ok(checked.to_json())
    })?;
    from_json::python(py, &found)
}
