//! Running sums of one output.

use identifier::{Ledger, Step};
use nn_basis::{Lanes, Scalar, dot, real};

use crate::Trajectory;

/// Quality of one output of one identifier. Errors are x̃ = x − x̂ of a wheel speed at the samples 1..=n, rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutputIndices {
    /// Largest error, rad/s.
    pub max: f64,
    /// Root of the mean squared error, rad/s.
    pub rmse: f64,
    /// Largest error in each event's window, rad/s.
    pub peak: [f64; 5],
    /// When it occurred, s.
    pub peak_at: [f64; 5],
    /// Share of each event's window in the sum of squared errors.
    pub share: [f64; 5],
    /// Root of the mean squared error in the quiet parts, rad/s.
    pub quiet_rms: f64,
    /// Mean of ‖φ‖².
    pub mean_regressor_square: f64,
    /// Largest relative residual of the Lyapunov identity over the run, for zero and for random comparison weights.
    pub identity_residual: f64,
    /// Whether the mean-square bound held against both comparison weights.
    pub mean_square_bound_holds: bool,
}

/// Running sums of one output, of one draw or of several side by side.
pub(crate) struct Tally<T> {
    pub(crate) chosen: Ledger<T>,
    pub(crate) zero: Ledger<T>,
    max: T,
    squares: T,
    phi2: T,
    peak: [T; 5],
    peak_at: [T; 5],
    window: [T; 5],
    quiet: T,
    quiet_count: usize,
}

impl<T: Scalar> Tally<T> {
    pub(crate) fn new(pole: T) -> Self {
        let zero = T::zero();
        Self {
            chosen: Ledger::new(pole),
            zero: Ledger::new(pole),
            max: zero,
            squares: zero,
            phi2: zero,
            peak: [zero; 5],
            peak_at: [zero; 5],
            window: [zero; 5],
            quiet: zero,
            quiet_count: 0,
        }
    }

    #[inline(always)]
    pub(crate) fn add<const N: usize>(&mut self, trajectory: &Trajectory, time: f64, step: &Step<T, N>) {
        let error = step.error_after.abs();
        let square = error * error;
        self.max = self.max.max(error);
        self.squares += square;
        self.phi2 += dot(&step.sample.regressor, &step.sample.regressor);
        let windows = &trajectory.windows;
        if let Some(i) = windows.end.iter().position(|end| time <= *end) {
            self.window[i] += square;
            if time > windows.quiet[i] {
                self.quiet += square;
                self.quiet_count += 1;
            } else {
                let peak = self.peak[i];
                self.peak_at[i] = peak.if_less(error, real(time), self.peak_at[i]);
                self.peak[i] = peak.if_less(error, error, peak);
            }
        }
    }
}

impl Tally<f64> {
    pub(crate) fn close(self, samples: usize) -> OutputIndices {
        let n = samples as f64;
        OutputIndices {
            max: self.max,
            rmse: (self.squares / n).sqrt(),
            peak: self.peak,
            peak_at: self.peak_at,
            share: self.window.map(|w| w / self.squares),
            quiet_rms: (self.quiet / self.quiet_count.max(1) as f64).sqrt(),
            mean_regressor_square: self.phi2 / n,
            identity_residual: self.chosen.worst_residual().max(self.zero.worst_residual()),
            mean_square_bound_holds: self.chosen.holds() && self.zero.holds(),
        }
    }
}

impl<const L: usize> Tally<Lanes<L>> {
    /// The tally of each lane.
    pub(crate) fn apart(&self) -> [Tally<f64>; L] {
        let (chosen, zero) = (self.chosen.apart(), self.zero.apart());
        std::array::from_fn(|i| Tally {
            chosen: chosen[i],
            zero: zero[i],
            max: self.max.0[i],
            squares: self.squares.0[i],
            phi2: self.phi2.0[i],
            peak: self.peak.map(|x| x.0[i]),
            peak_at: self.peak_at.map(|x| x.0[i]),
            window: self.window.map(|x| x.0[i]),
            quiet: self.quiet.0[i],
            quiet_count: self.quiet_count,
        })
    }
}
