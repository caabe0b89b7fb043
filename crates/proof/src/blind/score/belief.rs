//! Whether probabilities are worth their name.

use case_files::answers::AnswerCause;
use serde::Serialize;

/// The smallest set of answers must hold this share of the probability.
const HELD: f64 = 0.9;

/// What the probabilities of an answer are worth.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(in crate::blind) struct Belief {
    /// Sum of the squares of probability less truth over effects, "none" and "unknown": 0 is best.
    pub(in crate::blind) brier: f64,
    /// The largest probability.
    pub(in crate::blind) confidence: f64,
    /// Whether the answer that has it is right.
    pub(in crate::blind) confidence_right: bool,
    /// Whether the smallest set of answers that holds 90 % of the probability holds all that is right.
    pub(in crate::blind) in_set: bool,
    /// Size of that set.
    pub(in crate::blind) set_size: usize,
}

impl Belief {
    /// `ranked` by falling probability. A probability is that of being part of the truth: of two effects both may be
    /// near one, so that the sum of all may be two.
    pub(super) fn of(wanted: &[&str], ranked: &[&AnswerCause]) -> Self {
        let all = summed(ranked);
        let given = |w: &str| all.iter().find(|(e, _)| *e == w).map_or(0.0, |(_, p)| *p);
        let others = all.iter().filter(|(e, _)| !wanted.contains(e));
        let brier =
            wanted.iter().map(|w| (given(w) - 1.0).powi(2)).sum::<f64>() + others.map(|(_, p)| p * p).sum::<f64>();
        // The first of several that are equally sure.
        let surest = all
            .iter()
            .fold(None, |best: Option<&(&str, f64)>, a| if best.is_some_and(|b| b.1 >= a.1) { best } else { Some(a) });
        let set = smallest_set(&all);
        Self {
            brier,
            confidence: surest.map_or(0.0, |s| s.1),
            confidence_right: surest.is_some_and(|s| wanted.contains(&s.0)),
            in_set: wanted.iter().all(|w| set.contains(w)),
            set_size: set.len(),
        }
    }
}

/// The probability of each answer; several entries of one effect count together.
fn summed<'a>(ranked: &[&'a AnswerCause]) -> Vec<(&'a str, f64)> {
    let mut all: Vec<(&str, f64)> = Vec::new();
    for cause in ranked {
        let p = cause.probability.max(0.0);
        match all.iter_mut().find(|(e, _)| *e == cause.effect) {
            Some((_, sum)) => *sum = (*sum + p).min(1.0),
            None => all.push((&cause.effect, p.min(1.0))),
        }
    }
    all
}

/// The fewest answers whose probabilities make 90 % of the sum of all.
fn smallest_set<'a>(all: &[(&'a str, f64)]) -> Vec<&'a str> {
    let mut sorted = all.to_vec();
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
    // Sums of decimal fractions miss the mark by a rounding error.
    let needed = HELD * sorted.iter().map(|(_, p)| p).sum::<f64>() - 1e-9;
    let mut held = 0.0;
    let mut set = Vec::new();
    for (effect, p) in sorted {
        if held >= needed {
            break;
        }
        held += p;
        set.push(effect);
    }
    set
}

#[cfg(test)]
mod tests {
    use super::super::testing::cause;
    use super::Belief;

    fn belief(wanted: &[&str], ranked: &[(&str, f64)]) -> Belief {
        let causes: Vec<_> = ranked.iter().map(|(e, p)| cause(e, *p)).collect();
        Belief::of(wanted, &causes.iter().collect::<Vec<_>>())
    }

    #[test]
    fn brier_sums_squares_over_all_answers() {
        let b = belief(&["payload"], &[("payload", 0.7), ("grade", 0.2), ("none", 0.1)]);
        assert!((b.brier - (0.09 + 0.04 + 0.01)).abs() < 1e-12);
        assert!((b.confidence, b.confidence_right) == (0.7, true));
        // What is not listed has no probability; of a pair both should be sure.
        let b = belief(&["payload", "stiction"], &[("payload", 0.9), ("grade", 0.5)]);
        assert!((b.brier - (0.01 + 1.0 + 0.25)).abs() < 1e-12);
        let b = belief(&["none"], &[]);
        assert!((b.brier, b.confidence, b.confidence_right, b.in_set) == (1.0, 0.0, false, false));
    }

    #[test]
    fn entries_of_one_effect_count_together() {
        let b = belief(&["grade"], &[("payload", 0.5), ("grade", 0.4), ("grade", 0.3)]);
        assert!((b.confidence - 0.7).abs() < 1e-12 && b.confidence_right);
    }

    #[test]
    fn the_set_is_the_smallest_that_holds_ninety_percent() {
        let ranked = [("a", 0.6), ("b", 0.3), ("c", 0.07), ("d", 0.03)];
        for (wanted, inside) in [("a", true), ("b", true), ("c", false)] {
            let b = belief(&[wanted], &ranked);
            assert_eq!((b.in_set, b.set_size), (inside, 2), "{wanted}");
        }
        // Of a pair both are near one: 90 % of the sum needs both.
        let pair = [("a", 0.98), ("b", 0.95), ("c", 0.03), ("none", 0.01)];
        let b = belief(&["b", "a"], &pair);
        assert!(b.in_set && b.set_size == 2);
        assert!(!belief(&["a", "c"], &pair).in_set);
    }
}
