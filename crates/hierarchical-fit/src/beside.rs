//! Drives beside their simulations, as pages and pictures draw them: for every comparison with a pose.

use verdict::{Compared, Trace, instant, rounded};

use crate::settings::SETTINGS;

/// A measured pose beside simulations that run free and begin anew at the measured pose in some of its rows.
#[derive(Debug, Clone)]
pub struct Beside<'a> {
    /// The drive.
    pub recording: &'a str,
    /// Whether the fits behind the simulations did without it.
    pub left_out: bool,
    /// Time of each row, s, rising.
    pub time: Vec<f64>,
    /// Measured x, y, m, and yaw, rad, in each row; NaN where it was not seen.
    pub measured: &'a [[f64; 3]],
    /// Rows in which the simulations begin anew.
    pub starts: Vec<usize>,
    /// As stated, re-tuned, corrected: the pose in each row, NaN where it is not simulated; empty where there is no simulation.
    pub simulated: [Vec<[f64; 3]>; 3],
}

impl Beside<'_> {
    /// Position and heading over time, rows no closer than pages show.
    pub fn trace(&self) -> Trace {
        let rows = self.shown();
        let pick = |pose: &[[f64; 3]], axis: usize| -> Vec<Option<f64>> {
            let value = |&row: &usize| pose.get(row).map(|p| p[axis]).filter(|v| v.is_finite()).map(rounded);
            if pose.is_empty() { Vec::new() } else { rows.iter().map(value).collect() }
        };
        let channel = |(axis, (signal, unit)): (usize, (&'static str, &'static str))| Compared {
            signal: signal.into(),
            unit: unit.into(),
            recorded: pick(self.measured, axis),
            nominal: pick(&self.simulated[0], axis),
            retuned: pick(&self.simulated[1], axis),
            corrected: pick(&self.simulated[2], axis),
            ..Compared::default()
        };
        let is_seen = rows.iter().all(|&row| self.measured[row].iter().all(|v| v.is_finite()));
        let path = rows.iter().filter(|_| is_seen).map(|&row| [0, 1].map(|axis| rounded(self.measured[row][axis])));
        // By a gyro alone there is a heading and no place.
        let is_measured = |axis: usize| self.measured.iter().any(|pose| pose[axis].is_finite());
        let signals = [("position x", "m"), ("position y", "m"), ("heading", "rad")];
        let place = |start: &usize| rows.partition_point(|row| row < start);
        Trace {
            recording: self.recording.to_owned(),
            left_out: self.left_out,
            time: rows.iter().map(|&row| instant(self.time[row] - self.time[0])).collect(),
            restarts: self.starts.iter().map(place).collect(),
            channels: signals.into_iter().enumerate().filter(|(axis, _)| is_measured(*axis)).map(channel).collect(),
            path: path.collect(),
            ..Trace::default()
        }
    }

    /// Rows far enough apart, and those in which a simulation begins.
    fn shown(&self) -> Vec<usize> {
        let mut out: Vec<usize> = Vec::new();
        for (row, time) in self.time.iter().enumerate() {
            let is_far = out.last().is_none_or(|last| time - self.time[*last] >= SETTINGS.traces.step);
            if is_far || self.starts.contains(&row) {
                out.push(row);
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simulation_that_begins_anew_is_right_there_and_lies_in_the_row_that_is_shown() {
        let measured: Vec<[f64; 3]> = (0..500).map(|k| [0.01 * f64::from(k), 0.5, 0.1]).collect();
        let simulated: Vec<[f64; 3]> = (0..500).map(|k| [0.01 * f64::from(k - k % 203), 0.5, 0.1]).collect();
        let told = Beside {
            recording: "drive",
            left_out: true,
            time: (0..500).map(|k| 5.0 + 0.02 * f64::from(k)).collect(),
            measured: &measured,
            starts: vec![0, 203, 406],
            simulated: [simulated, Vec::new(), Vec::new()],
        }
        .trace();
        assert_eq!((told.time[0], told.left_out, told.restarts.len()), (0.0, true, 3));
        assert!(told.time.len() < 110 && told.time.windows(2).all(|t| t[0] < t[1]));
        for &restart in &told.restarts {
            assert_eq!(told.channels[0].recorded[restart], told.channels[0].nominal[restart]);
        }
        assert_ne!(told.channels[0].recorded[told.restarts[1] - 1], told.channels[0].nominal[told.restarts[1] - 1]);
        assert!(told.channels.iter().all(|c| c.corrected.is_empty()), "nothing was named");
        assert_eq!(told.path.len(), told.time.len());
    }

    #[test]
    fn a_pose_that_was_not_seen_is_a_gap_and_no_number() {
        let mut measured = vec![[1.0, 2.0, 0.0]; 60];
        measured[20] = [f64::NAN; 3];
        let time = (0..60).map(f64::from).collect();
        let simulated = Default::default();
        let told =
            Beside { recording: "drive", left_out: false, time, measured: &measured, starts: vec![0], simulated };
        let told = told.trace();
        assert_eq!((told.channels[2].recorded[20], told.channels[2].recorded[21]), (None, Some(0.0)));
        assert!(told.path.is_empty());
    }
}
