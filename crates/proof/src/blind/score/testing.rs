//! Parts of answers for tests.

use case_files::answers::AnswerCause;

/// A cause of which only the probability is known.
pub(super) fn cause(effect: &str, probability: f64) -> AnswerCause {
    AnswerCause { effect: effect.to_owned(), probability, magnitude: None, sigma: None, side: None, intervals: None }
}
