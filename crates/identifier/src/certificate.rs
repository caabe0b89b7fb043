//! What is proved about a step, and about a run.

use nn_basis::{Scalar, real};

use crate::Step;

/// What one step does to `L = ½ x̃² + ‖W* − Ŵ‖²/(2γ)`, against comparison weights W*.
///
/// Source: Eq. 16–21 of Hendzel & Trojnacki 2014, made exact for the discrete law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate<T> {
    /// L before the step.
    pub before: T,
    /// L after the step.
    pub after: T,
    /// The change of L, measured from the two models.
    pub change: T,
    /// The change of L that the law's identity predicts; for the midpoint law `−a h x̃_m² + h ε x̃_m`.
    pub predicted: T,
    /// The largest change that any error could have caused with this ε: `h ε²/(4a)`.
    pub bound: T,
    /// `|change − predicted|` relative to the quantities involved: rounding, about 1e-15 in double precision.
    pub residual: T,
    /// The approximation error ε of W* in this step, unit of the output per second.
    pub epsilon: T,
    /// The error that the identity is about, x̃_m for the midpoint law.
    pub error: T,
    /// Length of the step, s.
    pub h: T,
}

impl<T: Scalar> Certificate<T> {
    /// Whether L falls for certain: `predicted < 0`, that is `|x̃_m| > |ε|/a` or ε of opposite sign.
    pub fn falls(&self) -> bool {
        self.predicted < T::zero()
    }
}

/// Certificates added up over a run: the mean-square bound.
///
/// `Σ h x̃² ≤ (2/a) L₀ + (1/a²) Σ h ε²` for every comparison W*: the mean square of the error is bounded by that of ε,
/// not its maximum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ledger<T> {
    pole: T,
    start: Option<T>,
    error_energy: T,
    epsilon_energy: T,
    worst_residual: T,
    rises: u32,
}

impl<T: Scalar> Ledger<T> {
    /// An empty ledger for an identifier with pole a, 1/s.
    pub fn new(pole: T) -> Self {
        let zero = T::zero();
        Self { pole, start: None, error_energy: zero, epsilon_energy: zero, worst_residual: zero, rises: 0 }
    }

    /// Adds the certificate of the next step. All must be against the same W*.
    #[inline]
    pub fn add(&mut self, certificate: &Certificate<T>) {
        let c = certificate;
        self.start.get_or_insert(c.before);
        self.error_energy += c.h * c.error * c.error;
        self.epsilon_energy += c.h * c.epsilon * c.epsilon;
        // A residual that is not a number is kept, not lost.
        if self.worst_residual.is_finite() && (c.residual > self.worst_residual || !c.residual.is_finite()) {
            self.worst_residual = c.residual;
        }
        if c.change > T::zero() {
            self.rises = self.rises.saturating_add(1);
        }
    }

    /// `Σ h x̃²`, unit of the output squared times s.
    pub fn error_energy(&self) -> T {
        self.error_energy
    }

    /// The bound `(2/a) L₀ + (1/a²) Σ h ε²` on [`Ledger::error_energy`].
    pub fn bound(&self) -> T {
        let start = self.start.unwrap_or_else(T::zero);
        real::<T>(2.0) * start / self.pole + self.epsilon_energy / (self.pole * self.pole)
    }

    /// Whether the bound holds, rounding aside.
    pub fn holds(&self) -> bool {
        self.error_energy <= self.bound() * (T::one() + real::<T>(1e-6))
    }

    /// Largest relative residual of the identity so far.
    pub fn worst_residual(&self) -> T {
        self.worst_residual
    }

    /// How many steps raised L. With approximation error some do; without, none.
    pub fn rises(&self) -> u32 {
        self.rises
    }
}

/// `½ x̃² + ‖W* − Ŵ‖²/(2γ)`.
pub(crate) fn lyapunov<T: Scalar, const N: usize>(error: T, weight: &[T; N], comparison: &[T; N], gain: T) -> T {
    let mut distance = T::zero();
    for (w, c) in weight.iter().zip(comparison) {
        distance += (*c - *w) * (*c - *w);
    }
    real::<T>(0.5) * (error * error + distance / gain)
}

/// The change of L as differences times sums, which keeps the digits that subtracting two large L would lose.
pub(crate) fn difference_of_squares<T: Scalar, const N: usize>(step: &Step<T, N>, comparison: &[T; N], gain: T) -> T {
    let mut weights = T::zero();
    for ((old, new), c) in step.before.weight.iter().zip(&step.after.weight).zip(comparison) {
        weights += (*old - *new) * ((*c - *new) + (*c - *old));
    }
    let error = (step.error_after - step.error_before) * (step.error_after + step.error_before);
    real::<T>(0.5) * (error + weights / gain)
}
