//! Numbers from Python as one array of doubles.

use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::error::LacunaError;

/// What was given, as doubles in the order of C: the array itself where it is that already, else a copy.
pub(crate) struct Samples<'py>(PyReadonlyArrayDyn<'py, f64>);

impl<'py> Samples<'py> {
    /// Takes anything that numpy makes an array of; `what` is what messages call it.
    pub(crate) fn of(what: &str, given: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Some(array) = as_it_is(given) {
            return Ok(Self(array));
        }
        let py = given.py();
        let array = py
            .import("numpy")?
            .call_method1("require", (given, "float64", ["C", "ALIGNED"]))
            .map_err(|e| LacunaError::new_err(format!("{what}: these are no numbers ({})", e.value(py))))?;
        Ok(Self(array.cast::<PyArrayDyn<f64>>()?.try_readonly()?))
    }

    /// The same with a single axis.
    pub(crate) fn line(what: &str, given: &Bound<'py, PyAny>) -> PyResult<Self> {
        let out = Self::of(what, given)?;
        if out.shape().len() == 1 {
            Ok(out)
        } else {
            Err(LacunaError::new_err(format!(
                "{what}: an array of shape {:?}; give one with a single axis",
                out.shape()
            )))
        }
    }

    pub(crate) fn shape(&self) -> &[usize] {
        self.0.shape()
    }

    /// The numbers, read where they are.
    pub(crate) fn values(&self) -> PyResult<&[f64]> {
        Ok(self.0.as_slice()?)
    }
}

/// An array that can be read where it is.
fn as_it_is<'py>(given: &Bound<'py, PyAny>) -> Option<PyReadonlyArrayDyn<'py, f64>> {
    let array = given.cast::<PyArrayDyn<f64>>().ok()?.try_readonly().ok()?;
    // A slice is also had of arrays in the order of Fortran, and of none that is not aligned.
    (array.is_c_contiguous() && array.as_slice().is_ok()).then_some(array)
}

/// Refuses an array that is not as long as it must be.
pub(crate) fn has_length(what: &str, values: &[f64], length: usize) -> PyResult<()> {
    if values.len() == length {
        Ok(())
    } else {
        Err(LacunaError::new_err(format!("{what}: {} numbers; give {length}", values.len())))
    }
}
