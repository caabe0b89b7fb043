//! Lacuna for Python: arrays and paths in, verdicts and arrays out. What is computed is in the crates of Lacuna; here is what
//! turns their types into Python's.

mod arrays;
mod case;
mod cause;
mod check;
mod diagnose;
mod diagnosis;
mod error;
mod from_json;
mod identifier;
mod identify;
mod layer;
mod samples;
mod simulate;
mod trace;
mod work;

use pyo3::prelude::*;

/// The compiled half of the package `lacuna`.
#[pymodule]
mod _lacuna {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::cause::Cause;
    #[pymodule_export]
    use super::check::check;
    #[pymodule_export]
    use super::diagnose::diagnose;
    #[pymodule_export]
    use super::diagnosis::Diagnosis;
    #[pymodule_export]
    use super::error::LacunaError;
    #[pymodule_export]
    use super::identify::{Followed, Identifier};
    #[pymodule_export]
    use super::layer::SigmoidLayer;
    #[pymodule_export]
    use super::simulate::simulate;
    #[pymodule_export]
    use super::trace::{Trace, TracedSignal};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        super::work::quiet_panics();
        module.add("__version__", case_files::envelope::Program::default().version)
    }

    /// The specifications of all effects that a diagnosis can name.
    ///
    /// Returns
    /// -------
    /// list of dict
    ///     ``id``, ``name``, ``kind``, ``law``, ``parameters`` (each with ``unit`` and ``bounds``), ``revealed_by`` ...: what
    ///     ``lacuna effects --json`` writes.
    #[pyfunction]
    fn effects(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        super::from_json::python(py, &serde_json::Value::from(robot_file::catalogue_json::effects_json()))
    }
}
