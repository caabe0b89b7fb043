//! Errors of free runs.

use crate::channel::{Channel, Channels};
use crate::fit::Problem;
use crate::simulate::RunResponse;

/// Residuals of the wheel speeds (both sides) and of the yaw rate of one run's response, where they were measured.
pub(crate) fn residuals(problem: &Problem<'_>, run: usize, response: &[Vec<Channels<f64>>]) -> [Vec<f64>; 2] {
    let mut out = [Vec::new(), Vec::new()];
    for (segment, response) in problem.cuts[run].segments.iter().zip(response) {
        for ((o, p), valid) in segment.observed.iter().zip(response).zip(&segment.valid) {
            for channel in Channel::ALL.into_iter().filter(|&c| valid[c]) {
                match channel {
                    Channel::LeftWheel | Channel::RightWheel => out[0].push(o[channel] - p[channel]),
                    Channel::YawRate => out[1].push(o[channel] - p[channel]),
                    _ => {}
                }
            }
        }
    }
    out
}

/// Root mean squared residual of the wheel speeds and of the yaw rate over these runs' responses.
pub(crate) fn rms(problem: &Problem<'_>, responses: &[(usize, RunResponse)]) -> [f64; 2] {
    let of_run: Vec<[Vec<f64>; 2]> = responses.iter().map(|(run, y)| residuals(problem, *run, y)).collect();
    [0, 1].map(|q| inference::robust::rms(of_run.iter().flat_map(|r| r[q].iter().copied())).unwrap_or(0.0))
}
