//! What may make a model and its drives disagree: directions in the space of the constants.

use catalogue::CauseSpec;
use inference::robust::normal_cdf;

use crate::weigh::Posterior;

/// A cause that can be named.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// What is known about it.
    pub spec: &'static CauseSpec,
    /// The wheel that it is about, or which distance.
    pub of: Option<String>,
    /// Directions in which it moves the constants: weights by constant; each with its usual size, one sigma.
    pub directions: Vec<(Vec<(usize, f64)>, f64)>,
    /// What one of these constants can be if this is the cause: a share that slip loses is not negative. Not those that grow with a
    /// speed: below zero they forecast one of four open robots better than nothing does, whatever they stand for.
    pub possible: Option<Possible>,
}

/// The range in which a constant lies if some cause moves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Possible {
    /// Index of the constant.
    pub constant: usize,
    /// Its least deviation.
    pub least: f64,
    /// Its largest deviation.
    pub most: f64,
}

impl Possible {
    /// Of a constant that cannot be negative.
    pub fn at_least_zero(constant: usize) -> Self {
        Self { constant, least: 0.0, most: f64::INFINITY }
    }

    /// Whether such constants may lie in it, within a sigma.
    pub(crate) fn may_hold(&self, Posterior { mean, covariance }: &Posterior) -> bool {
        let k = self.constant;
        let sd = covariance[(k, k)].max(0.0).sqrt();
        (self.least - sd..=self.most + sd).contains(&mean[k])
    }

    /// Probability that a normal constant lies in it.
    pub(crate) fn probability(&self, mean: f64, variance: f64) -> f64 {
        let sd = variance.max(f64::MIN_POSITIVE).sqrt();
        normal_cdf((self.most - mean) / sd) - normal_cdf((self.least - mean) / sd)
    }
}

impl Cause {
    /// Its id with the wheel or distance that it is about.
    pub fn label(&self) -> String {
        self.of.as_ref().map_or_else(|| self.spec.id.to_owned(), |of| format!("{} ({of})", self.spec.id))
    }

    /// Puts the constants that it moves where they were known to be.
    pub fn take_from(&self, constants: &mut [f64], known: &[f64]) {
        self.moves().into_iter().for_each(|k| constants[k] = known[k]);
    }

    /// Indices of the constants that it moves, each once, the one first whose value is its size.
    pub fn moves(&self) -> Vec<usize> {
        let mut out: Vec<usize> = Vec::new();
        for k in self.directions.iter().flat_map(|(d, _)| d.iter().map(|(k, _)| *k)) {
            if !out.contains(&k) {
                out.push(k);
            }
        }
        out
    }
}
