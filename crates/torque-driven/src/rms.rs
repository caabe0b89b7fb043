//! Errors of free runs.

use crate::fit::Problem;
use crate::windows::CHANNELS;

/// Root mean squared residual of the wheel speeds and of the yaw rate over these runs' responses.
pub(crate) fn rms(problem: &Problem<'_>, responses: &[(usize, Vec<Vec<f64>>)]) -> [f64; 2] {
    let mut sum = [(0.0, 0.0); 2];
    for (run, response) in responses {
        for (segment, response) in problem.cuts[*run].segments.iter().zip(response) {
            for (i, (o, p)) in segment.observed.iter().zip(response).enumerate().filter(|(i, _)| segment.valid[*i]) {
                let slot = match i % CHANNELS {
                    0 | 1 => &mut sum[0],
                    2 => &mut sum[1],
                    _ => continue,
                };
                slot.0 += (o - p).powi(2);
                slot.1 += 1.0;
            }
        }
    }
    sum.map(|(q, n): (f64, f64)| (q / n.max(1.0)).sqrt())
}
