//! Drives beside their simulations, as pages and pictures draw them.

use hierarchical_fit::Beside;
use verdict::Trace;

use crate::drive::Drive;
use crate::motion::{Laws, implied, placed, relative};
use crate::settings::{SETTINGS, Traces};
use crate::wheel::WheeledRobot;

const RULES: Traces = SETTINGS.traces;

/// The pose of a drive from its counts alone: from the first row of each stretch in which it was seen, and anew from the last one
/// where rows follow in which it was not; in the rows before all, as counts say backwards. At the origin where it was never seen.
pub(crate) fn predicted(robot: &WheeledRobot, drive: &Drive, laws: &Laws) -> Vec<[f64; 3]> {
    let path = implied(robot, drive, &laws.of_body());
    let seen = |row: usize| drive.is_seen(row);
    let is_end = |row: usize| row == 0 || !seen(row - 1) || (row + 1 < path.len() && !seen(row + 1));
    let mut starts = (0..path.len()).filter(|&row| seen(row) && is_end(row)).peekable();
    let Some(mut start) = starts.next() else { return path };
    (0..path.len())
        .map(|row| {
            if starts.peek() == Some(&row) {
                start = row;
                starts.next();
            }
            placed(begun(drive, start), relative(path[start], path[row]))
        })
        .collect()
}

/// The pose of a row in which it was seen; at the origin where only the heading was.
fn begun(drive: &Drive, row: usize) -> [f64; 3] {
    let [x, y, yaw] = drive.pose[row];
    if drive.heading_only { [0.0, 0.0, yaw] } else { [x, y, yaw] }
}

/// A drive beside these paths from its counts alone: as stated, re-tuned, corrected.
pub(crate) fn trace(drive: &Drive, paths: [Option<Vec<[f64; 3]>>; 3], left_out: bool) -> Trace {
    let starts = starts(drive);
    let of = |path: Vec<[f64; 3]>| -> Vec<[f64; 3]> {
        let mut out = vec![[f64::NAN; 3]; path.len()];
        for (k, &start) in starts.iter().enumerate() {
            let end = starts.get(k + 1).copied().unwrap_or(path.len());
            for row in start..end {
                out[row] = placed(begun(drive, start), relative(path[start], path[row]));
            }
        }
        out
    };
    let simulated = paths.map(|path| path.map(of).unwrap_or_default());
    Beside { recording: &drive.name, left_out, time: drive.time.clone(), measured: &drive.pose, starts, simulated }
        .trace()
}

/// Rows in which the pose was seen, so far apart as the simulations run free.
fn starts(drive: &Drive) -> Vec<usize> {
    let mut out: Vec<usize> = Vec::new();
    for row in (0..drive.time.len()).filter(|&row| drive.is_seen(row)) {
        if out.last().is_none_or(|last| drive.time[row] - drive.time[*last] >= RULES.free) {
            out.push(row);
        }
    }
    out
}
