//! Signals as integrals on a grid of steps.

/// A signal as its integral on a grid of steps: means over any span follow.
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    step: f64,
    sums: Vec<f64>,
    ends: [f64; 2],
}

impl Command {
    /// Of values that hold from their times on, s from the start of the grid.
    pub fn held((times, values): (&[f64], &[f64]), steps: usize, step: f64) -> Self {
        let mut sums = Vec::with_capacity(steps + 1);
        let (mut k, mut sum, mut at) = (0, 0.0, 0.0);
        for k_step in 0..=steps {
            let until = step * k_step as f64;
            while k + 1 < times.len() && times[k + 1] <= until {
                sum += values[k] * (times[k + 1] - at).max(0.0);
                at = at.max(times[k + 1]);
                k += 1;
            }
            sum += values[k] * (until - at).max(0.0);
            at = until;
            sums.push(sum);
        }
        Self { step, sums, ends: [values[0], values[values.len() - 1]] }
    }

    /// Of an integral that is known at the beginning of each step; beyond its ends it goes on at these rates.
    pub fn summed(sums: Vec<f64>, ends: [f64; 2], step: f64) -> Self {
        Self { step, sums, ends }
    }

    /// The integral from the start to a time.
    pub fn sum(&self, time: f64) -> f64 {
        let last = self.sums.len() - 1;
        let place = time / self.step;
        if place <= 0.0 {
            return self.ends[0] * time;
        }
        if place >= last as f64 {
            return self.sums[last] + self.ends[1] * (time - self.step * last as f64);
        }
        let k = place as usize;
        self.sums[k] + (place - k as f64) * (self.sums[k + 1] - self.sums[k])
    }

    /// The same command on another clock, which shows `time` as `start + pace time`.
    #[must_use]
    pub fn retimed(&self, start: f64, pace: f64) -> Self {
        let before = self.sum(start);
        let sum = |step: usize| (self.sum(start + pace * self.step * step as f64) - before) / pace;
        Self { step: self.step, sums: (0..self.sums.len()).map(sum).collect(), ends: self.ends }
    }

    /// Mean over the step that begins at a time, s from the start of the drive.
    pub fn mean(&self, time: f64) -> f64 {
        (self.sum(time + self.step) - self.sum(time)) / self.step
    }
}
