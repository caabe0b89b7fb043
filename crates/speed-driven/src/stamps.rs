//! Stamps of a recording as times.

use recordings::{Channel, Recording};

/// The first stamp of a recording, ns: times count from here, whatever epoch the stamps have.
pub(crate) fn origin(recording: &Recording) -> i64 {
    recording.channels().iter().filter_map(|c| c.t_ns().first().copied()).min().unwrap_or(0)
}

/// Times in s from the recording's origin, and values of a channel.
pub(crate) fn samples(channel: &Channel, origin: i64) -> (Vec<f64>, &[f64]) {
    (channel.t_ns().iter().map(|t| (*t - origin) as f64 * 1e-9).collect(), channel.values())
}
