//! What is proved about a step, and about a run.

use nn_basis::{Lanes, Scalar, dot, real};

use crate::{Sample, Step};

/// What one step does to `L = ½ x̃² + ‖W* − Ŵ‖²/(2γ)`, against comparison weights W*.
///
/// Every law has a balance `ΔL ≤ −c e² + b ε e + s` with its own error e, dissipation c > 0, coupling b and surplus s;
/// for most it is an equality. With `s ≤ 0`, L falls whenever `|e| > b |ε|/c`, at any step size, gain and regressor.
///
/// Source: Eq. 16–21 of Hendzel & Trojnacki 2014, made exact for the discrete laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate<T> {
    /// L before the step.
    pub before: T,
    /// L after the step.
    pub after: T,
    /// The change of L, measured from the two models.
    pub change: T,
    /// The change of L by the law's balance: its value where the balance is an equality, else its upper bound.
    pub predicted: T,
    /// How far the change is from the prediction, or above it, relative to the quantities involved: rounding, about
    /// 1e-15 in double precision.
    pub residual: T,
    /// The approximation error ε of W* in this step, unit of the output per second.
    pub epsilon: T,
    /// The error e that the balance is about.
    pub error: T,
    /// Dissipation c of the balance; about a h.
    pub dissipation: T,
    /// Coupling b of ε to e; about h, s.
    pub coupling: T,
}

impl<T: Scalar> Certificate<T> {
    /// Whether L falls for certain: the predicted change is negative; in every lane.
    pub fn falls(&self) -> bool {
        self.predicted.is_less(T::zero())
    }

    /// What the law adds by itself, `s = ΔL + c e² − b ε e`: never positive for laws that keep L.
    #[inline(always)]
    pub fn surplus(&self) -> T {
        self.predicted + self.dissipation * self.error * self.error - self.coupling * self.epsilon * self.error
    }

    /// The largest change that any error could have caused with this ε: `b² ε²/(4c) + s`.
    pub fn bound(&self) -> T {
        let injected = self.coupling * self.epsilon;
        injected * injected / (real::<T>(4.0) * self.dissipation) + self.surplus()
    }
}

/// The terms of a law's balance, from which its certificate is made.
pub(crate) struct Balance<T> {
    /// Distance ½ x̃² of the output before and after; of the dead zone's D where there is one.
    pub(crate) output: [T; 2],
    pub(crate) error: T,
    pub(crate) epsilon: T,
    /// Size of what ε is the difference of: its rounding is relative to this.
    pub(crate) scale: T,
    pub(crate) dissipation: T,
    pub(crate) coupling: T,
    pub(crate) surplus: T,
    /// Zero where the balance is an equality, above zero where it is an upper bound.
    pub(crate) slack: T,
}

impl<T: Scalar> Balance<T> {
    /// Measures the change of L over the step and compares.
    #[inline(always)]
    pub(crate) fn certificate<const N: usize>(self, step: &Step<T, N>, comparison: &[T; N], gain: T) -> Certificate<T> {
        let half = real::<T>(0.5);
        let [from, to] = self.output;
        let (old, new) = (&step.before.weight, &step.after.weight);
        let before = half * (from * from + distance(old, comparison) / gain);
        let after = half * (to * to + distance(new, comparison) / gain);
        // Differences times sums keep the digits that subtracting two large L would lose.
        let change = half * ((to - from) * (to + from) + difference(old, new, comparison) / gain);
        let dissipated = self.dissipation * self.error * self.error;
        let injected = self.coupling * self.epsilon * self.error;
        let predicted = injected - dissipated + self.surplus;
        let rounded = (self.coupling * self.scale * self.error).abs();
        let size = before + after + dissipated + rounded + self.surplus.abs();
        let gap = change - predicted;
        let gap = T::zero().if_less(self.slack, positive_part(gap), gap.abs());
        // The size itself where it is zero, or not a number: then the residual is not one either.
        let residual = T::zero().if_less(size, gap / size, size);
        let Self { error, epsilon, dissipation, coupling, .. } = self;
        Certificate { before, after, change, predicted, residual, epsilon, error, dissipation, coupling }
    }
}

/// `max(x, 0)`, but not a number stays not a number.
#[inline(always)]
pub(crate) fn positive_part<T: Scalar>(x: T) -> T {
    x.if_less(T::zero(), T::zero(), x)
}

/// `‖W* − Ŵ‖²`.
#[inline(always)]
fn distance<T: Scalar, const N: usize>(weight: &[T; N], comparison: &[T; N]) -> T {
    let mut sum = T::zero();
    for (w, c) in weight.iter().zip(comparison) {
        sum += (*c - *w) * (*c - *w);
    }
    sum
}

/// `‖W* − Ŵ_new‖² − ‖W* − Ŵ_old‖²` without cancellation.
#[inline(always)]
pub(crate) fn difference<T: Scalar, const N: usize>(old: &[T; N], new: &[T; N], comparison: &[T; N]) -> T {
    let mut sum = T::zero();
    for i in 0..N {
        sum += (old[i] - new[i]) * ((comparison[i] - new[i]) + (comparison[i] - old[i]));
    }
    sum
}

/// What the comparison weights leave of the right-hand side `shown` by a sample, and the size of what it is a difference of.
#[inline(always)]
pub(crate) fn approximation_error<T: Scalar, const N: usize>(
    shown: T,
    sample: &Sample<T, N>,
    comparison: &[T; N],
) -> (T, T) {
    let known = sample.known + dot(comparison, &sample.regressor);
    (shown - known, shown.abs() + known.abs())
}

/// The larger residual; one that is not finite is kept for ever, not lost.
#[inline(always)]
pub(crate) fn worse<T: Scalar>(so_far: T, residual: T) -> T {
    // Zero times a finite number is zero, times any other it is not a number.
    so_far.if_less(residual, residual, so_far) + T::zero() * (residual + so_far)
}

/// Certificates added up over a run: the mean-square bound.
///
/// `Σ h e² ≤ (2/a)(L₀ + Σ s) + (1/a²) Σ h ε²` for every comparison W*, h standing for c/a on the left and a b²/c on the
/// right: the mean square of the error is bounded by that of ε, not its maximum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ledger<T> {
    pole: T,
    start: Option<T>,
    error_energy: T,
    epsilon_energy: T,
    surplus: T,
    worst_residual: T,
    rises: T,
}

impl<T: Scalar> Ledger<T> {
    /// An empty ledger for an identifier with pole a, 1/s.
    pub fn new(pole: T) -> Self {
        let zero = T::zero();
        Self {
            pole,
            start: None,
            error_energy: zero,
            epsilon_energy: zero,
            surplus: zero,
            worst_residual: zero,
            rises: zero,
        }
    }

    /// Adds the certificate of the next step. All must be against the same W*.
    #[inline(always)]
    pub fn add(&mut self, certificate: &Certificate<T>) {
        let c = certificate;
        self.start.get_or_insert(c.before);
        self.error_energy += c.dissipation / self.pole * c.error * c.error;
        let injected = c.coupling * c.epsilon;
        self.epsilon_energy += self.pole * injected * injected / c.dissipation;
        // What a law gives away besides is not needed for the bound, only what it adds.
        self.surplus += positive_part(c.surplus());
        // A residual that is not a number is kept, not lost.
        self.worst_residual = worse(self.worst_residual, c.residual);
        self.rises += T::zero().if_less(c.change, T::one(), T::zero());
    }

    /// `Σ h e²`, unit of the output squared times s.
    pub fn error_energy(&self) -> T {
        self.error_energy
    }

    /// The bound `(2/a)(L₀ + Σ s) + (1/a²) Σ h ε²` on [`Ledger::error_energy`].
    pub fn bound(&self) -> T {
        let start = self.start.unwrap_or_else(T::zero) + self.surplus;
        real::<T>(2.0) * start / self.pole + self.epsilon_energy / (self.pole * self.pole)
    }

    /// Whether the bound holds, rounding aside; in every lane.
    pub fn holds(&self) -> bool {
        self.error_energy.is_at_most(self.bound() * (T::one() + real::<T>(1e-6)))
    }

    /// Largest relative residual of the balance so far.
    pub fn worst_residual(&self) -> T {
        self.worst_residual
    }

    /// How many steps raised L, in single precision up to 2²⁴. With approximation error some do; without, none.
    pub fn rises(&self) -> T {
        self.rises
    }
}

impl<const N: usize> Ledger<Lanes<N>> {
    /// The ledger of each lane.
    pub fn apart(&self) -> [Ledger<f64>; N] {
        core::array::from_fn(|i| Ledger {
            pole: self.pole.0[i],
            start: self.start.map(|s| s.0[i]),
            error_energy: self.error_energy.0[i],
            epsilon_energy: self.epsilon_energy.0[i],
            surplus: self.surplus.0[i],
            worst_residual: self.worst_residual.0[i],
            rises: self.rises.0[i],
        })
    }
}
