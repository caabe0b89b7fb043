//! Recordings as dicts of arrays, in and out.

use std::fmt::Write as _;

use numpy::{IntoPyArray, PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use recordings::suggest;
use recordings::{Channel, Clock, Read, Recording, Signal, Source};
use sha2::{Digest, Sha256};

use crate::error::{LacunaError, refused};
use crate::samples::{Samples, has_length};

/// Keys under which instants are given, s as doubles.
const SECONDS: [&str; 2] = ["t", "time_s"];
/// The same in whole ns.
const NANOSECONDS: [&str; 2] = ["t_ns", "time_ns"];
const PER_SECOND: f64 = 1e9;

/// A recording from a dict: `name` (else `usual_name`), instants, and a signal under its id or its column's name.
///
/// Values that are not a number are samples that are missing.
pub(crate) fn read(given: &Bound<'_, PyDict>, usual_name: &str) -> PyResult<Read> {
    let name = match given.get_item("name")? {
        Some(name) => name.extract::<String>()?,
        None => usual_name.to_owned(),
    };
    let stamps = stamps(given, &name)?;
    let mut channels = Vec::new();
    for (key, values) in given {
        let key = key.extract::<String>()?;
        if key == "name" || SECONDS.contains(&key.as_str()) || NANOSECONDS.contains(&key.as_str()) {
            continue;
        }
        let what = format!("recording '{name}', {key}");
        let samples = Samples::line(&what, &values)?;
        let values = samples.values()?;
        has_length(&format!("{what} (an instant each)"), values, stamps.len())?;
        if let Some(at) = values.iter().position(|v| v.is_infinite()) {
            return Err(LacunaError::new_err(format!(
                "{what}: infinite at index {at}; put nan where a sample is missing"
            )));
        }
        let (t, v) = if values.iter().any(|v| v.is_nan()) {
            stamps.iter().zip(values).filter(|(_, v)| !v.is_nan()).map(|(t, v)| (*t, *v)).unzip()
        } else {
            (stamps.clone(), values.to_vec())
        };
        let channel = Channel::new(signal(&name, &key)?, 0, t, v).map_err(|e| refused(format!("{what}: {e}")))?;
        channels.push(channel.with_column(key));
    }
    if channels.is_empty() {
        return Err(LacunaError::new_err(format!("recording '{name}': no signal beside the instants")));
    }
    let clock = Clock { name: name.clone(), nominal_rate_hz: None };
    let recording = Recording::new(name, vec![clock], channels).map_err(refused)?;
    Ok(Read { sources: vec![source(&recording)], recording, losses: Vec::new(), unused: Vec::new() })
}

/// Instants in ns.
fn stamps(given: &Bound<'_, PyDict>, name: &str) -> PyResult<Vec<i64>> {
    let mut found = Vec::new();
    for key in SECONDS.iter().chain(&NANOSECONDS) {
        if let Some(values) = given.get_item(key)? {
            found.push((*key, values));
        }
    }
    let [(key, values)] = found.as_slice() else {
        let problem = if found.is_empty() { "no instants" } else { "instants twice" };
        return Err(LacunaError::new_err(format!(
            "recording '{name}': {problem}; give t (s, doubles) or t_ns (whole ns), with one number for each sample"
        )));
    };
    let what = format!("recording '{name}', {key}");
    if NANOSECONDS.contains(key) {
        let numpy = values.py().import("numpy")?;
        let whole = numpy.call_method1("asarray", (values,))?;
        let kind = whole.getattr("dtype")?.getattr("kind")?.extract::<String>()?;
        if !["i", "u"].contains(&kind.as_str()) || whole.getattr("ndim")?.extract::<usize>()? != 1 {
            return Err(LacunaError::new_err(format!(
                "{what}: give whole numbers of ns, as an array with a single axis"
            )));
        }
        let whole = numpy.call_method1("require", (whole, "int64", ["C", "ALIGNED"]))?;
        return Ok(whole.cast::<PyArray1<i64>>()?.try_readonly()?.as_slice()?.to_vec());
    }
    let samples = Samples::line(&what, values)?;
    let in_ns = |(at, t): (usize, &f64)| {
        let ns = (t * PER_SECOND).round();
        // What fits: 292 years around 1970.
        if ns.is_finite() && ns.abs() < i64::MAX as f64 {
            Ok(ns as i64)
        } else {
            Err(LacunaError::new_err(format!("{what}: {t} s at index {at} is no instant")))
        }
    };
    samples.values()?.iter().enumerate().map(in_ns).collect()
}

fn signal(recording: &str, key: &str) -> PyResult<Signal> {
    let all = Signal::ALL.iter().copied();
    all.clone().find(|s| s.name() == key || s.column_name() == key).ok_or_else(|| {
        let names: Vec<&str> = all.map(Signal::name).collect();
        let hint = suggest::hint(key, &names);
        LacunaError::new_err(format!("recording '{recording}': no signal is called '{key}'; {hint}"))
    })
}

/// What a recording of arrays is known by: as a file by its bytes.
fn source(recording: &Recording) -> Source {
    let (mut hash, mut bytes) = (Sha256::new(), 0);
    for channel in recording.channels() {
        hash.update(channel.name());
        for (t, v) in channel.samples() {
            hash.update(t.to_le_bytes());
            hash.update(v.to_le_bytes());
            bytes += 16;
        }
    }
    let sha256 = hash.finalize().iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    });
    Source { name: format!("{} (arrays)", recording.name()), bytes, sha256 }
}

/// A recording on one clock as a dict: `t` in s, and each signal under its column's name, nan where a sample is missing.
pub(crate) fn dict<'py>(py: Python<'py>, recording: &Recording) -> PyResult<Bound<'py, PyDict>> {
    let mut stamps: Vec<i64> = recording.channels().iter().flat_map(Channel::t_ns).copied().collect();
    stamps.sort_unstable();
    stamps.dedup();
    let out = PyDict::new(py);
    let seconds: Vec<f64> = stamps.iter().map(|t| *t as f64 / PER_SECOND).collect();
    out.set_item(SECONDS[0], seconds.into_pyarray(py))?;
    for channel in recording.channels() {
        let values = if channel.len() == stamps.len() {
            channel.values().to_vec()
        } else {
            let mut row = vec![f64::NAN; stamps.len()];
            for (t, v) in channel.samples() {
                if let Ok(at) = stamps.binary_search(&t) {
                    row[at] = v;
                }
            }
            row
        };
        out.set_item(channel.signal().column_name(), values.into_pyarray(py))?;
    }
    Ok(out)
}
