//! The zero-order hold between a commanded and a delayed torque.

use std::array::from_fn;

use super::Grid;

/// Which set-points a step sees, relative to its row, and the share of the first.
#[derive(Debug, Clone, Copy)]
struct HeldSetPoints {
    from: isize,
    until: isize,
    share: f64,
}

/// Set-points held for the row that follows, delayed: the mean over each step, continuous in the delay.
///
/// A negative delay looks ahead.
pub struct Hold {
    /// Of each step within a row.
    steps: Vec<HeldSetPoints>,
}

impl Hold {
    /// For rows divided as `grid` says; `delay` in s.
    pub fn new(grid: Grid, delay: f64) -> Self {
        let (n, delay) = (grid.substeps as f64, delay / grid.period);
        let steps = (0..grid.substeps)
            .map(|i| {
                // A hair of slack: row borders are exact multiples of the step up to rounding.
                let (a, b) = (i as f64 / n - delay + 1e-6, (i + 1) as f64 / n - delay - 1e-6);
                let (from, until) = (a.floor(), b.floor());
                let share = if from < until { ((until - a) / (b - a)).clamp(0.0, 1.0) } else { 1.0 };
                HeldSetPoints { from: from as isize, until: until as isize, share }
            })
            .collect();
        Self { steps }
    }

    /// Torque of each side, N m, over step `step` of row `row`; zero before the first set-point (or without
    /// any), the last one stays.
    #[inline]
    pub fn command(&self, torque: &[[f64; 2]], row: usize, step: usize) -> [f64; 2] {
        let at = |by: isize| match row.checked_add_signed(by) {
            Some(i) => torque.get(i).or(torque.last()).copied().unwrap_or_default(),
            None => [0.0; 2],
        };
        let seen = self.steps[step];
        let (x, y) = (at(seen.from), at(seen.until));
        from_fn(|j| x[j] * seen.share + y[j] * (1.0 - seen.share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD: f64 = 0.01;
    const SUBSTEPS: usize = 10;
    const H: f64 = 1e-3;
    const TORQUE: [[f64; 2]; 4] = [[1.0, -1.0], [3.0, -3.0], [2.0, 5.0], [0.0, 7.0]];

    fn at(t: f64, delay: f64) -> [f64; 2] {
        let step = (t / H).round() as usize;
        Hold::new(Grid { period: PERIOD, substeps: SUBSTEPS }, delay).command(&TORQUE, step / SUBSTEPS, step % SUBSTEPS)
    }

    fn left(t: f64, delay: f64) -> f64 {
        at(t, delay)[0]
    }

    #[test]
    fn a_command_is_held_for_the_row_that_follows() {
        for k in 0..4 {
            for i in 0..10 {
                let t = k as f64 * PERIOD + f64::from(i) * H;
                assert_eq!(at(t, 0.0), TORQUE[k]);
            }
        }
        // The last set-point stays; before the first there is none.
        assert_eq!(left(1.0, 0.0), 0.0);
        assert_eq!(left(0.0, 0.02), 0.0);
    }

    #[test]
    fn a_delay_is_fractional_and_continuous() {
        assert_eq!(left(0.012, 0.0035), TORQUE[0][0]);
        assert!((left(0.013, 0.0035) - 2.0).abs() < 0.01);
        assert_eq!(left(0.014, 0.0035), TORQUE[1][0]);
        let (mut last, step) = (left(0.025, -0.02), 1e-5);
        for i in -1999..3000 {
            let now = left(0.025, f64::from(i) * step);
            // The largest jump between set-points is 2 N m.
            assert!((now - last).abs() <= 2.0 * 1.01 * step / H, "delay {i}: {last} to {now}");
            last = now;
        }
    }

    #[test]
    fn a_negative_delay_looks_ahead() {
        assert_eq!(left(0.005, -PERIOD), TORQUE[1][0]);
        assert_eq!(left(0.005, -2.0 * PERIOD), TORQUE[2][0]);
    }
}
