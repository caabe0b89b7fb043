//! The answer to a case.

use std::path::PathBuf;

use case_files::envelope::Envelope;
use case_files::report_page;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use report::diagnosis_text;
use report::words::{is_no_cause, probability, size, where_and_when};

use crate::cause::Cause;
use crate::error::{LacunaError, raised, refused};
use crate::from_json;
use crate::trace::{Trace, rows};

/// Rows of the table in a notebook.
const ROWS: usize = 6;

/// The answer to a case, with all that it was made from: what ``lacuna diagnose --json`` writes.
///
/// It can be pickled, all but ``predictions``.
#[pyclass(frozen, module = "lacuna")]
pub(crate) struct Diagnosis {
    envelope: Envelope,
    /// A mapping that nobody named.
    found: Option<String>,
}

impl Diagnosis {
    pub(crate) fn new(envelope: Envelope, found: Option<String>) -> Self {
        Self { envelope, found }
    }

    fn answer(&self) -> &verdict::Diagnosis {
        &self.envelope.diagnosis
    }
}

#[pymethods]
impl Diagnosis {
    /// ``explained``, ``unknown`` (a mismatch that nothing in the catalogue explains), ``no_mismatch`` or ``withheld``.
    #[getter]
    fn verdict(&self) -> &'static str {
        match self.answer().verdict {
            verdict::Verdict::Explained => "explained",
            verdict::Verdict::Unknown => "unknown",
            verdict::Verdict::NoMismatch => "no_mismatch",
            verdict::Verdict::Withheld => "withheld",
        }
    }

    /// Effects that may be missing, the most probable first. Those of a verdict ``explained`` have more than 0.5.
    #[getter]
    fn causes(&self) -> Vec<Cause> {
        self.answer().ranked.iter().filter(|c| !is_no_cause(c)).map(Cause::from).collect()
    }

    /// Probability of each effect that may be missing, of ``none`` and of ``unknown``, the largest first.
    ///
    /// Two effects may be missing at once: these need not add up to 1.
    #[getter]
    fn probabilities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        for cause in &self.answer().ranked {
            // The same effect elsewhere comes later and is less probable.
            if !out.contains(&cause.effect)? {
                out.set_item(&cause.effect, cause.probability)?;
            }
        }
        Ok(out)
    }

    /// The answer in sentences, the most important one first.
    #[getter]
    fn sentences(&self) -> Vec<String> {
        self.answer().sentences.clone()
    }

    /// What limits the answer, in sentences.
    #[getter]
    fn limits(&self) -> Vec<String> {
        self.answer().limits.clone()
    }

    /// What was lost in reading, in sentences.
    #[getter]
    fn lost(&self) -> Vec<String> {
        self.envelope.lost.clone()
    }

    /// What ``lacuna diagnose`` prints.
    #[getter]
    fn text(&self) -> String {
        let e = &self.envelope;
        let mut not_used = e.ignored_files.clone();
        not_used.extend(e.unused_columns.iter().map(|u| format!("{}: column {}", u.file, u.column)));
        let text = diagnosis_text::render(self.answer(), &e.lost, &not_used, self.found.as_deref());
        anstream::adapter::strip_str(&text).to_string()
    }

    /// Recordings beside the simulation, as arrays. New arrays each time.
    #[getter]
    fn traces(&self, py: Python<'_>) -> PyResult<Vec<Trace>> {
        self.answer().traces.iter().map(|trace| Trace::of(py, trace)).collect()
    }

    /// Predicted responses of the held-out drives of a torque-driven robot.
    ///
    /// A list of dicts: ``name``, ``t`` (n, s), and ``corrected`` and ``nominal`` (calibrated, without the effect), each with
    /// ``wheel_speed`` (n x 2, left and right, rad/s) and ``yaw_rate`` (n, rad/s). They are no part of the JSON: a diagnosis
    /// that was read or pickled has none.
    #[getter]
    fn predictions<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let one = |p: &verdict::Prediction| {
            let out = PyDict::new(py);
            out.set_item("wheel_speed", rows(py, &p.wheel_speed)?)?;
            out.set_item("yaw_rate", p.yaw_rate.clone().into_pyarray(py))?;
            PyResult::Ok(out)
        };
        let both = |(corrected, nominal): &(verdict::Prediction, verdict::Prediction)| {
            let out = PyDict::new(py);
            out.set_item("name", &corrected.name)?;
            out.set_item("t", corrected.time.clone().into_pyarray(py))?;
            out.set_item("corrected", one(corrected)?)?;
            out.set_item("nominal", one(nominal)?)?;
            Ok(out)
        };
        self.answer().predictions.iter().map(both).collect()
    }

    /// All of it as a dict.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        from_json::parsed(py, &serde_json::to_string(&self.envelope).map_err(refused)?)
    }

    /// The text that ``lacuna diagnose --json`` writes: other commands read it.
    fn to_json(&self) -> PyResult<String> {
        let value = serde_json::to_value(&self.envelope).map_err(refused)?;
        Ok(serde_json::to_string_pretty(&value).map_err(refused)? + "\n")
    }

    /// Reads what ``to_json`` or ``lacuna diagnose --json`` wrote.
    ///
    /// Raises
    /// ------
    /// LacunaError
    ///     When the text is something else, or was written by a version of another format.
    #[classmethod]
    #[pyo3(signature = (text, /))]
    fn from_json(_cls: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
        Ok(Self::new(Envelope::parse("this text", text).map_err(|e| raised(&e))?, None))
    }

    /// Writes the page of ``lacuna report``: one file that opens in any browser and needs no network.
    ///
    /// Raises
    /// ------
    /// LacunaError
    ///     When the file cannot be written.
    #[pyo3(signature = (path))]
    fn save_report(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| std::fs::write(&path, report_page::page(&self.envelope)))
            .map_err(|e| LacunaError::new_err(format!("cannot write '{}': {e}", path.display())))
    }

    fn __repr__(&self) -> String {
        let shown = self.answer().ranked.iter().take(3);
        let causes: Vec<String> = shown.map(|c| format!("{} {}", c.effect, probability(c.probability))).collect();
        format!("<lacuna.Diagnosis {}: {}>", self.verdict(), causes.join(", "))
    }

    fn __str__(&self) -> String {
        self.text()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let read = slf.py().get_type::<Self>().getattr("from_json")?;
        Ok((read, (slf.get().to_json()?,)))
    }

    /// The verdict and the first causes, for notebooks.
    fn _repr_html_(&self) -> String {
        let sentence = self.answer().sentences.first().map_or("", String::as_str);
        let row = |c: &verdict::Cause| {
            let [value, interval] = size(c);
            let cells = [c.name.clone(), probability(c.probability), value, interval, where_and_when(c)];
            format!("<tr><td>{}</td></tr>", cells.map(|cell| escaped(&cell)).join("</td><td>"))
        };
        let head = ["cause", "probability", "magnitude", "90 %", "where and when"].join("</th><th>");
        let all: Vec<String> = self.answer().ranked.iter().take(ROWS).map(row).collect();
        format!("<p><b>{}</b></p><table><tr><th>{head}</th></tr>{}</table>", escaped(sentence), all.concat())
    }
}

/// Names from files stay text.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
