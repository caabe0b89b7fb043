//! Recordings beside the simulation, as arrays.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// One recording beside the simulation, window by window.
///
/// Attributes
/// ----------
/// recording : str
///     Its name.
/// left_out : bool
///     Whether it was left out of the fits behind ``retuned`` and ``corrected``.
/// time : numpy.ndarray
///     Middle of each of the n windows (or rows), s after the first row.
/// restarts : list of int
///     Windows at which a free run begins.
/// path : numpy.ndarray, (n, 2)
///     Position of the geometric centre, m; no rows without a pose.
/// before, after : numpy.ndarray
///     Mean squared mismatch of all signals, divided by that of the references, of the simulation
///     as it is and corrected.
/// signals : list of TracedSignal
///     What is compared.
#[pyclass(frozen, get_all, module = "lacuna")]
pub(crate) struct Trace {
    recording: String,
    left_out: bool,
    time: Py<PyArray1<f64>>,
    restarts: Vec<usize>,
    path: Py<PyArray2<f64>>,
    before: Py<PyArray1<f64>>,
    after: Py<PyArray1<f64>>,
    signals: Vec<Py<TracedSignal>>,
}

/// One signal of a recording beside the simulation's; nan in gaps, empty where there is none.
///
/// Attributes
/// ----------
/// signal, unit : str
///     Name for people, and unit.
/// side : {"left", "right"} or None
///     Side, if it has one.
/// recorded, nominal, retuned, corrected : numpy.ndarray
///     As recorded; the simulation as it is, with its constants re-tuned, and with the named effects.
/// usual : float or None
///     One standard deviation by which fault-free drives differ from their simulation.
#[pyclass(frozen, get_all, module = "lacuna")]
pub(crate) struct TracedSignal {
    signal: String,
    unit: String,
    side: Option<String>,
    recorded: Py<PyArray1<f64>>,
    nominal: Py<PyArray1<f64>>,
    retuned: Py<PyArray1<f64>>,
    corrected: Py<PyArray1<f64>>,
    usual: Option<f64>,
}

/// Numbers with gaps as an array with nan.
fn with_gaps(py: Python<'_>, values: &[Option<f64>]) -> Py<PyArray1<f64>> {
    let values: Vec<f64> = values.iter().map(|v| v.unwrap_or(f64::NAN)).collect();
    values.into_pyarray(py).unbind()
}

/// Rows as an array with two axes.
pub(crate) fn rows<const N: usize>(py: Python<'_>, rows: &[[f64; N]]) -> PyResult<Py<PyArray2<f64>>> {
    Ok(rows.as_flattened().to_vec().into_pyarray(py).reshape([rows.len(), N])?.unbind())
}

impl Trace {
    pub(crate) fn of(py: Python<'_>, trace: &verdict::Trace) -> PyResult<Self> {
        let signal = |c: &verdict::Compared| {
            Py::new(
                py,
                TracedSignal {
                    signal: c.signal.to_string(),
                    unit: c.unit.to_string(),
                    side: c.side.as_ref().map(ToString::to_string),
                    recorded: with_gaps(py, &c.recorded),
                    nominal: with_gaps(py, &c.nominal),
                    retuned: with_gaps(py, &c.retuned),
                    corrected: with_gaps(py, &c.corrected),
                    usual: c.usual,
                },
            )
        };
        Ok(Self {
            recording: trace.recording.clone(),
            left_out: trace.left_out,
            time: trace.time.clone().into_pyarray(py).unbind(),
            restarts: trace.restarts.clone(),
            path: rows(py, &trace.path)?,
            before: with_gaps(py, &trace.before),
            after: with_gaps(py, &trace.after),
            signals: trace.channels.iter().map(signal).collect::<PyResult<_>>()?,
        })
    }
}

#[pymethods]
impl Trace {
    fn __repr__(&self, py: Python<'_>) -> String {
        use numpy::PyUntypedArrayMethods;
        format!("<lacuna.Trace of {}, {} windows>", self.recording, self.time.bind(py).len())
    }
}

#[pymethods]
impl TracedSignal {
    fn __repr__(&self) -> String {
        let side = self.side.as_ref().map_or(String::new(), |side| format!(", {side}"));
        format!("<lacuna.TracedSignal {}{side}, {}>", self.signal, self.unit)
    }
}
