//! Errors of predictions from the torques alone.

use super::course::Course;

/// How far ahead is predicted, s.
pub const HORIZONS: [f64; 3] = [0.1, 0.5, 2.0];
/// Time from one start to the next, s.
pub(super) const BETWEEN_STARTS: f64 = 0.5;

/// Squared errors at the horizons, added up over starts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Errors {
    squares: [f64; HORIZONS.len()],
    count: [usize; HORIZONS.len()],
}

impl Errors {
    /// Intervals that a prediction needs.
    pub(super) fn intervals(course: &Course) -> usize {
        (HORIZONS[HORIZONS.len() - 1] / course.run.step).round() as usize
    }

    /// Adds a prediction from sample `k`. Horizons that span the change of the ground are left out: it is not in the
    /// torques yet, so no model can foresee it.
    pub(super) fn add(&mut self, course: &Course, k: usize, predicted: &[[f64; 2]]) {
        let h = course.run.step;
        let start = k as f64 * h;
        for (i, horizon) in HORIZONS.iter().enumerate() {
            if (start..start + horizon).contains(&course.changes_at) {
                continue;
            }
            let n = (horizon / h).round() as usize;
            let (found, truth) = (&predicted[n - 1], &course.run.states[k + n].speed);
            self.squares[i] += 0.5 * ((found[0] - truth[0]).powi(2) + (found[1] - truth[1]).powi(2));
            self.count[i] += 1;
        }
    }

    /// Root mean squares, rad/s.
    pub(super) fn rms(&self) -> [f64; HORIZONS.len()] {
        std::array::from_fn(|i| (self.squares[i] / self.count[i].max(1) as f64).sqrt())
    }
}
