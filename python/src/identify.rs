//! The online identifier.

use ::identifier::{Euler, Exponential, Ledger, Midpoint};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{LacunaError, refused};
use crate::identifier::{Follows, Interval, MOST, Scheme, of_size};
use crate::samples::{Samples, has_length};

/// Follows one output x of an unknown system with the model ``d/dt x^ = -a x^ + W' phi`` and adapts W online.
///
/// The identifier of Hendzel & Trojnacki 2014 with A = -a I: ``d/dt W = gamma phi (x - x^)``, from zero weights.
///
/// Parameters
/// ----------
/// units : int
///     Number N of regressor entries, 1 to 32.
/// pole : float
///     a, 1/s, above zero.
/// gain : float
///     Adaptation gain gamma, above zero.
/// scheme : {"midpoint", "exponential", "euler"}
///     How the law is advanced over a sample. The midpoint rule keeps the paper's Lyapunov function exactly at any step size;
///     forward Euler is for comparison only.
/// dead_zone : float
///     Approximation error that is tolerated, unit of x per s; of the exponential scheme only.
/// start : float
///     Estimate to begin with, unit of x.
///
/// Raises
/// ------
/// LacunaError
///     When a number is out of its range.
#[pyclass(module = "lacuna")]
pub(crate) struct Identifier {
    inner: Box<dyn Follows>,
    units: usize,
    pole: f64,
}

/// What an identifier did over n intervals.
///
/// Attributes
/// ----------
/// estimates, errors : numpy.ndarray, (n,)
///     Estimate x^ and error x - x^ at the end of each interval, unit of x.
/// weights : numpy.ndarray, (n, N)
///     Weights after each interval, unit of x per s.
/// certificate : dict or None
///     The mean-square bound against comparison weights, where they were given: ``error_energy`` and its ``bound`` (unit of x
///     squared times s), whether it ``holds``, the ``worst_residual`` of the balance of L (rounding), and how often L ``rises``.
#[pyclass(frozen, get_all, module = "lacuna")]
pub(crate) struct Followed {
    estimates: Py<PyArray1<f64>>,
    errors: Py<PyArray1<f64>>,
    weights: Py<PyArray2<f64>>,
    certificate: Option<Py<PyDict>>,
}

/// Length of each interval.
enum Periods<'a> {
    All(f64),
    Each(&'a [f64]),
}

#[pymethods]
impl Identifier {
    #[new]
    #[pyo3(signature = (units, *, pole=8.0, gain=500.0, scheme="midpoint", dead_zone=0.0, start=0.0))]
    fn new(units: usize, pole: f64, gain: f64, scheme: &str, dead_zone: f64, start: f64) -> PyResult<Self> {
        if !(1..=MOST).contains(&units) {
            return Err(LacunaError::new_err(format!("units = {units}: give 1 to {MOST}")));
        }
        if dead_zone != 0.0 && scheme != "exponential" {
            return Err(LacunaError::new_err(format!("scheme = '{scheme}' has no dead zone; 'exponential' has")));
        }
        let scheme = match scheme {
            "midpoint" => Midpoint::new(gain).map(Scheme::Midpoint),
            "exponential" => Exponential::with_dead_zone(gain, dead_zone).map(Scheme::Exponential),
            "euler" => Euler::new(gain).map(Scheme::Euler),
            _ => {
                let problem = format!("scheme = '{scheme}': give 'midpoint', 'exponential' or 'euler'");
                return Err(LacunaError::new_err(problem));
            }
        };
        let inner = scheme.and_then(|scheme| of_size(units, pole, scheme, start)).map_err(refused)?;
        Ok(Self { inner, units, pole })
    }

    /// Number N of regressor entries.
    #[getter]
    fn units(&self) -> usize {
        self.units
    }

    /// Estimate x^ now, unit of x.
    #[getter]
    fn estimate(&self) -> f64 {
        self.inner.output()
    }

    /// Weights now, (N,), unit of x per s.
    #[getter]
    fn weights<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.inner.weights()[..self.units].to_vec().into_pyarray(py)
    }

    /// Advances over one interval of h seconds in which x goes from x_k to x_k1, with the regressor phi, (N,).
    ///
    /// Returns the error x - x^ at the end. Input that is not finite gives output that is not finite.
    fn step(&mut self, x_k: f64, x_k1: f64, phi: &Bound<'_, PyAny>, h: f64) -> PyResult<f64> {
        let phi = Samples::line("phi", phi)?;
        let regressor = phi.values()?;
        has_length("phi (a number for each unit)", regressor, self.units)?;
        Ok(self.inner.step(&Interval { start: x_k, end: x_k1, regressor, h }, None))
    }

    /// Advances over n intervals at once, as n calls of ``step``.
    ///
    /// Arrays of doubles in the order of C are read where they are; do not write to them meanwhile.
    ///
    /// Parameters
    /// ----------
    /// x : array, (n + 1,)
    ///     Measured output at the borders of the intervals.
    /// phi : array, (n, N)
    ///     Regressor over each interval, dimensionless.
    /// h : float or array, (n,)
    ///     Length of the intervals, s.
    /// comparison : array, (N,), optional
    ///     Comparison weights W* of a certificate, unit of x per s. The bound holds for any.
    #[pyo3(signature = (x, phi, h, *, comparison=None))]
    fn follow(
        &mut self,
        py: Python<'_>,
        x: &Bound<'_, PyAny>,
        phi: &Bound<'_, PyAny>,
        h: &Bound<'_, PyAny>,
        comparison: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Followed> {
        let (x, phi) = (Samples::line("x", x)?, Samples::of("phi", phi)?);
        let (outputs, regressors, units) = (x.values()?, phi.values()?, self.units);
        let &[n, width] = phi.shape() else {
            let problem = format!("phi: an array of shape {:?}; give one of (intervals, {units})", phi.shape());
            return Err(LacunaError::new_err(problem));
        };
        if width != units {
            return Err(LacunaError::new_err(format!("phi: {width} columns; give {units}, one for each unit")));
        }
        has_length("x (one more than phi has rows)", outputs, n + 1)?;
        let each = if h.extract::<f64>().is_ok() { None } else { Some(Samples::line("h", h)?) };
        let periods = match &each {
            Some(each) => Periods::Each(each.values()?),
            None => Periods::All(h.extract()?),
        };
        if let Periods::Each(each) = periods {
            has_length("h (a length for each interval)", each, n)?;
        }
        let comparison = comparison.map(|given| Samples::line("comparison", given)).transpose()?;
        let comparison = comparison.as_ref().map(Samples::values).transpose()?;
        if let Some(comparison) = comparison {
            has_length("comparison (a weight for each unit)", comparison, units)?;
        }
        let (pole, inner) = (self.pole, &mut self.inner);
        let (estimates, errors, weights, ledger) = py.detach(|| {
            let mut ledger = Ledger::new(pole);
            let (mut estimates, mut errors) = (Vec::with_capacity(n), Vec::with_capacity(n));
            let mut weights = Vec::with_capacity(n * units);
            for (k, regressor) in regressors.chunks_exact(units).enumerate() {
                let h = match periods {
                    Periods::All(h) => h,
                    Periods::Each(each) => each[k],
                };
                let interval = Interval { start: outputs[k], end: outputs[k + 1], regressor, h };
                errors.push(inner.step(&interval, comparison.map(|w| (w, &mut ledger))));
                estimates.push(inner.output());
                weights.extend_from_slice(&inner.weights()[..units]);
            }
            (estimates, errors, weights, ledger)
        });
        Ok(Followed {
            estimates: estimates.into_pyarray(py).unbind(),
            errors: errors.into_pyarray(py).unbind(),
            weights: weights.into_pyarray(py).reshape([n, units])?.unbind(),
            certificate: comparison.map(|_| certificate(py, &ledger)).transpose()?,
        })
    }

    fn __repr__(&self) -> String {
        format!("<lacuna.Identifier with {} units, a = {} 1/s, estimate {:.4}>", self.units, self.pole, self.estimate())
    }
}

fn certificate(py: Python<'_>, ledger: &Ledger<f64>) -> PyResult<Py<PyDict>> {
    let out = PyDict::new(py);
    out.set_item("error_energy", ledger.error_energy())?;
    out.set_item("bound", ledger.bound())?;
    out.set_item("holds", ledger.holds())?;
    out.set_item("worst_residual", ledger.worst_residual())?;
    out.set_item("rises", ledger.rises())?;
    Ok(out.unbind())
}
