//! Errors of free runs.

use crate::channel::{Channel, Channels};
use crate::fit::Problem;
use crate::simulate::RunResponse;
use crate::windows::Cut;

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

/// Root mean squared wheel speed and yaw rate of runs, rad/s.
pub(crate) fn motion(cuts: &[Cut]) -> [f64; 2] {
    let windows = || cuts.iter().flat_map(|cut| &cut.segments).flat_map(|s| s.observed.iter().zip(&s.valid));
    let of = |channels: &[Channel]| {
        let shown = windows().flat_map(|(y, valid)| channels.iter().filter(|&&c| valid[c]).map(|&c| y[c]));
        inference::robust::rms(shown).unwrap_or(0.0)
    };
    [of(&Channel::WHEELS), of(&[Channel::YawRate])]
}
