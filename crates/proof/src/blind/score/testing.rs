//! Parts of answers for tests.

use case_files::answers::ToldCause;

/// A cause of which only the probability is known.
pub(super) fn cause(effect: &str, probability: f64) -> ToldCause {
    ToldCause { effect: effect.to_owned(), probability, magnitude: None, sigma: None, side: None, intervals: None }
}
