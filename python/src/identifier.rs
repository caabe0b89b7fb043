//! The identifier for any number of units up to a largest one.
//!
//! Sizes are part of the identifier's type. Units beyond those that are used have a regressor of zero: they add exact zeros to
//! every sum and their weights stay zero, so that numbers have the bits of an identifier of the right size.

use identifier::{
    Certificate, Euler, Exponential, Identifier, IdentifierError, Law, Ledger, Midpoint, Model, Sample, Step,
};

/// Most units of a network.
pub(crate) const MOST: usize = 32;
/// Most units of the small type, which networks like the paper's take.
const FEW: usize = 8;

/// One of the schemes.
#[derive(Clone, Copy)]
pub(crate) enum Scheme {
    Midpoint(Midpoint<f64>),
    Exponential(Exponential<f64>),
    Euler(Euler<f64>),
}

impl<const N: usize> Law<f64, N> for Scheme {
    fn advance(&self, pole: f64, model: &Model<f64, N>, sample: &Sample<f64, N>) -> Step<f64, N> {
        match self {
            Self::Midpoint(law) => law.advance(pole, model, sample),
            Self::Exponential(law) => law.advance(pole, model, sample),
            Self::Euler(law) => law.advance(pole, model, sample),
        }
    }

    fn certify(&self, pole: f64, step: &Step<f64, N>, comparison: &[f64; N]) -> Certificate<f64> {
        match self {
            Self::Midpoint(law) => law.certify(pole, step, comparison),
            Self::Exponential(law) => law.certify(pole, step, comparison),
            Self::Euler(law) => law.certify(pole, step, comparison),
        }
    }

    fn gain(&self) -> f64 {
        match self {
            Self::Midpoint(law) => Law::<f64, N>::gain(law),
            Self::Exponential(law) => Law::<f64, N>::gain(law),
            Self::Euler(law) => Law::<f64, N>::gain(law),
        }
    }
}

/// An interval of the measured output with its regressor.
pub(crate) struct Interval<'a> {
    pub(crate) start: f64,
    pub(crate) end: f64,
    pub(crate) regressor: &'a [f64],
    pub(crate) h: f64,
}

/// An identifier whose size is not part of its type.
pub(crate) trait Follows: Send + Sync {
    /// Advances over an interval and gives the error at its end. The certificate against `comparison` goes to the ledger.
    fn step(&mut self, interval: &Interval<'_>, certify: Option<(&[f64], &mut Ledger<f64>)>) -> f64;

    /// The estimate of the output.
    fn output(&self) -> f64;

    /// The weights, and zeros behind them.
    fn weights(&self) -> &[f64];
}

/// The numbers, and zeros behind them.
fn padded<const N: usize>(values: &[f64]) -> [f64; N] {
    let mut out = [0.0; N];
    for (to, from) in out.iter_mut().zip(values) {
        *to = *from;
    }
    out
}

impl<const N: usize> Follows for Identifier<f64, N, Scheme> {
    fn step(&mut self, i: &Interval<'_>, certify: Option<(&[f64], &mut Ledger<f64>)>) -> f64 {
        let step = Self::step(self, i.start, i.end, &padded(i.regressor), i.h);
        if let Some((comparison, ledger)) = certify {
            ledger.add(&self.certificate(&step, &padded(comparison)));
        }
        step.error_after
    }

    fn output(&self) -> f64 {
        self.model().output
    }

    fn weights(&self) -> &[f64] {
        &self.model().weight
    }
}

/// An identifier for up to `units` units, which are at most [`MOST`].
pub(crate) fn of_size(
    units: usize,
    pole: f64,
    scheme: Scheme,
    output: f64,
) -> Result<Box<dyn Follows>, IdentifierError> {
    Ok(if units <= FEW {
        Box::new(Identifier::<f64, FEW, Scheme>::new(pole, scheme, output)?)
    } else {
        Box::new(Identifier::<f64, MOST, Scheme>::new(pole, scheme, output)?)
    })
}
