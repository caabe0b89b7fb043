//! What may make a model and its drives disagree: directions in the space of the constants.

use catalogue::CauseSpec;

/// A cause that can be named.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// What is known about it.
    pub spec: &'static CauseSpec,
    /// The wheel that it is about, or which distance.
    pub of: Option<String>,
    /// Directions in which it moves the constants: weights by constant; each with its usual size, one sigma.
    pub directions: Vec<(Vec<(usize, f64)>, f64)>,
    /// The constant, of those that it moves, that cannot be negative if this is the cause: a share that slip loses. Not those
    /// that grow with a speed: below zero they forecast one of four open robots better than nothing does, whatever they stand for.
    pub at_least_zero: Option<usize>,
}

impl Cause {
    /// Its id with the wheel or distance that it is about.
    pub fn label(&self) -> String {
        self.of.as_ref().map_or_else(|| self.spec.id.to_owned(), |of| format!("{} ({of})", self.spec.id))
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
