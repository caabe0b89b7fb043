//! JSON as Python's own types.

use pyo3::prelude::*;
use serde_json::Value;

/// Dicts, lists, numbers and strings.
pub(crate) fn python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    parsed(py, &value.to_string())
}

/// The same of a text.
pub(crate) fn parsed<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}
