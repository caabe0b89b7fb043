//! What is raised.

use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

pyo3::create_exception!(
    lacuna,
    LacunaError,
    PyValueError,
    "What the program says of input that it cannot use: what is wrong, where, and what to do."
);

/// A failure of the program with all that it says, as one sentence.
pub(crate) fn raised(error: &anyhow::Error) -> PyErr {
    LacunaError::new_err(format!("{error:#}"))
}

/// A failure of a part that tells itself.
pub(crate) fn refused(error: impl std::fmt::Display) -> PyErr {
    LacunaError::new_err(error.to_string())
}
