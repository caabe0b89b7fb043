//! The fixed first layer.

use nn_basis::{Activation, Basis, BasisError};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;

use crate::error::{LacunaError, refused};
use crate::identifier::MOST;
use crate::samples::{Samples, has_length};

/// A fixed layer of N sigmoid units over I scaled inputs, ``phi_j = S(V_j0 + sum_i V_ji x_i / scale_i)``.
///
/// Parameters
/// ----------
/// threshold : array, (N,)
///     V_j0, dimensionless.
/// weight : array, (N, I)
///     V_ji, dimensionless. At most 32 inputs.
/// scale : array, (I,)
///     A-priori magnitudes of the inputs, in their units, above zero.
/// activation : {"logistic", "tanh"}
///     S: ``1 / (1 + e^-z)`` or ``tanh z``.
///
/// Raises
/// ------
/// LacunaError
///     When shapes do not fit, or a number is not finite or out of its range.
#[pyclass(frozen, module = "lacuna")]
pub(crate) struct SigmoidLayer {
    /// One each, so that their number is no part of a type; inputs beyond those that are used weigh nothing.
    units: Vec<nn_basis::SigmoidLayer<f64, MOST, 1>>,
    inputs: usize,
}

#[pymethods]
impl SigmoidLayer {
    #[new]
    #[pyo3(signature = (threshold, weight, scale, activation="logistic"))]
    fn new(
        threshold: &Bound<'_, PyAny>,
        weight: &Bound<'_, PyAny>,
        scale: &Bound<'_, PyAny>,
        activation: &str,
    ) -> PyResult<Self> {
        let activation = match activation {
            "logistic" => Activation::Logistic,
            "tanh" => Activation::Tanh,
            _ => return Err(LacunaError::new_err(format!("activation = '{activation}': give 'logistic' or 'tanh'"))),
        };
        let (threshold, weight) = (Samples::line("threshold", threshold)?, Samples::of("weight", weight)?);
        let scale = Samples::line("scale", scale)?;
        let &[rows, inputs] = weight.shape() else {
            let problem = format!("weight: an array of shape {:?}; give one of (units, inputs)", weight.shape());
            return Err(LacunaError::new_err(problem));
        };
        if rows == 0 || !(1..=MOST).contains(&inputs) {
            let problem =
                format!("weight: {rows} units of {inputs} inputs; give a unit at least, and 1 to {MOST} inputs");
            return Err(LacunaError::new_err(problem));
        }
        has_length("threshold (a number for each unit)", threshold.values()?, rows)?;
        has_length("scale (a number for each input)", scale.values()?, inputs)?;
        let mut scales = [1.0; MOST];
        scales[..inputs].copy_from_slice(scale.values()?);
        let unit = |(j, row): (usize, &[f64])| {
            let mut own = [0.0; MOST];
            own[..inputs].copy_from_slice(row);
            nn_basis::SigmoidLayer::new([threshold.values()?[j]], [own], scales, activation).map_err(|e| {
                refused(match e {
                    BasisError::Weight { input, .. } => BasisError::Weight { unit: j, input },
                    BasisError::Threshold { .. } => BasisError::Threshold { unit: j },
                    other => other,
                })
            })
        };
        let units = weight.values()?.chunks_exact(inputs).enumerate().map(unit).collect::<PyResult<_>>()?;
        Ok(Self { units, inputs })
    }

    /// Number N of units.
    #[getter]
    fn units(&self) -> usize {
        self.units.len()
    }

    /// Number I of inputs.
    #[getter]
    fn inputs(&self) -> usize {
        self.inputs
    }

    /// The regressor of inputs (I,) as (N,), or of rows of inputs (n, I) as (n, N): dimensionless.
    ///
    /// Arrays of doubles in the order of C are read where they are; do not write to them meanwhile.
    #[pyo3(signature = (inputs, /))]
    fn regressor<'py>(&self, py: Python<'py>, inputs: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let given = Samples::of("inputs", inputs)?;
        let (shape, values) = (given.shape(), given.values()?);
        if shape.is_empty() || shape.len() > 2 || shape[shape.len() - 1] != self.inputs {
            let problem = format!("inputs: an array of shape {shape:?}; give (rows, {0}) or ({0},)", self.inputs);
            return Err(LacunaError::new_err(problem));
        }
        let phi: Vec<f64> = py.detach(|| {
            let mut row = [0.0; MOST];
            let mut out = Vec::with_capacity(values.len() / self.inputs * self.units.len());
            for inputs in values.chunks_exact(self.inputs) {
                row[..self.inputs].copy_from_slice(inputs);
                out.extend(self.units.iter().map(|unit| unit.regressor(&row)[0]));
            }
            out
        });
        let phi = phi.into_pyarray(py);
        Ok(if shape.len() == 1 { phi.into_any() } else { phi.reshape([shape[0], self.units.len()])?.into_any() })
    }

    fn __repr__(&self) -> String {
        format!("<lacuna.SigmoidLayer of {} units over {} inputs>", self.units.len(), self.inputs)
    }
}
