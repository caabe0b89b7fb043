//! Identifiers with and without a memory, as one.

use identifier::{Certificate, Identifier, Law, Retaining, Sample, Step};
use robot_model::paper::Structured;

/// Something that follows one output.
pub(super) trait Follower<const N: usize> {
    fn follow(&mut self, sample: &Sample<f64, N>) -> Step<f64, N>;
    fn certificate(&self, step: &Step<f64, N>, w_star: &[f64; N]) -> Certificate<f64>;
    /// Estimated output.
    fn output(&self) -> f64;
    /// The weights that act now.
    fn acting(&self) -> [f64; N];
    /// The weights that it would keep if it were switched off.
    fn kept(&self) -> [f64; N];
    /// The constants of Eq. 8 that it keeps, if it knows of any.
    fn constants(&self) -> Option<Structured<f64>> {
        None
    }
}

impl<L: Law<f64, N>, const N: usize> Follower<N> for Identifier<f64, N, L> {
    fn follow(&mut self, sample: &Sample<f64, N>) -> Step<f64, N> {
        Identifier::follow(self, sample)
    }

    fn certificate(&self, step: &Step<f64, N>, w_star: &[f64; N]) -> Certificate<f64> {
        Identifier::certificate(self, step, w_star)
    }

    fn output(&self) -> f64 {
        self.model().output
    }

    fn acting(&self) -> [f64; N] {
        self.model().weight
    }

    fn kept(&self) -> [f64; N] {
        self.model().weight
    }
}

impl<L: Law<f64, N>, const N: usize> Follower<N> for Retaining<f64, N, L> {
    fn follow(&mut self, sample: &Sample<f64, N>) -> Step<f64, N> {
        Retaining::follow(self, sample)
    }

    fn certificate(&self, step: &Step<f64, N>, w_star: &[f64; N]) -> Certificate<f64> {
        Retaining::certificate(self, step, w_star)
    }

    fn output(&self) -> f64 {
        self.identifier().model().output
    }

    fn acting(&self) -> [f64; N] {
        self.weight()
    }

    fn kept(&self) -> [f64; N] {
        self.memory().kept()
    }
}
