//! Recordings beside the simulation, window by window: what pages and pictures draw.

use serde::{Deserialize, Serialize};

use crate::Word;

/// Five significant digits: more are not seen in a picture.
pub fn rounded(v: f64) -> f64 {
    if v == 0.0 || !v.is_finite() {
        return v;
    }
    let scale = 10.0_f64.powi(4 - v.abs().log10().floor() as i32);
    (v * scale).round() / scale
}

/// A time to a tenth of a millisecond.
pub fn instant(t: f64) -> f64 {
    (t * 1e4).round() / 1e4
}

/// One recording beside the simulation.
///
/// The simulation of a torque-driven or command-driven robot runs free and is set to the measured state at `restarts`
/// only; that of a speed-driven robot follows its measured speeds, row by row.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Name of the recording.
    pub recording: String,
    /// Whether this recording was left out of the fits behind `retuned` and `corrected`.
    pub left_out: bool,
    /// Middle of each window (of a torque-driven robot, 0.1 s long) or row, s after the first row.
    pub time: Vec<f64>,
    /// Windows at which a free run begins.
    pub restarts: Vec<usize>,
    /// What is compared.
    pub channels: Vec<Compared>,
    /// Position of the geometric centre in each window, m; empty without a pose.
    pub path: Vec<[f64; 2]>,
    /// Mean squared mismatch of all channels, divided by that of the references in the same kind of
    /// driving, of the simulation as it is; of a command-driven robot, over what the corrected
    /// simulation leaves on average.
    pub before: Vec<Option<f64>>,
    /// The same of the corrected simulation.
    pub after: Vec<Option<f64>>,
}

/// One signal of a recording beside the simulation's.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// Name for people.
    pub signal: Word,
    /// Unit.
    pub unit: Word,
    /// Side of the signal, if it has one.
    pub side: Option<Word>,
    /// As recorded; `None` in gaps.
    pub recorded: Vec<Option<f64>>,
    /// The simulation as it is.
    pub nominal: Vec<Option<f64>>,
    /// With its constants re-tuned, no effect; empty where nothing was.
    pub retuned: Vec<Option<f64>>,
    /// Corrected by the named effects; empty where none is named.
    pub corrected: Vec<Option<f64>>,
    /// One sigma by which fault-free drives differ from their simulation, where that is known.
    pub usual: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_get_five_digits_of_a_value_and_a_tenth_of_a_millisecond_of_a_time() {
        assert_eq!([123_456.0, 1.234_56, 0.012_345_6].map(rounded), [123_460.0, 1.2346, 0.012_346]);
        assert_eq!([-123_454.0, -0.999_994, 10.0].map(rounded), [-123_450.0, -0.999_99, 10.0]);
        assert_eq!([0.0, f64::INFINITY, f64::NEG_INFINITY].map(rounded), [0.0, f64::INFINITY, f64::NEG_INFINITY]);
        assert!(rounded(f64::NAN).is_nan());
        assert_eq!([12.345_67, 0.000_04, -2.000_06].map(instant), [12.3457, 0.0, -2.0001]);
    }
}
