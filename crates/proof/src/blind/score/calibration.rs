//! Answers of similar confidence: how often they are right.

use report::reliability::Bin;

use super::statistics::{Rate, mean};
use super::{Belief, Row};

/// Answers in bins of equal width; a bound belongs to the bin below it.
pub(in crate::blind) fn bins(rows: &[&Row], count: usize) -> Vec<Bin> {
    of_beliefs(&rows.iter().map(|r| &r.belief).collect::<Vec<_>>(), count)
}

fn of_beliefs(beliefs: &[&Belief], count: usize) -> Vec<Bin> {
    let bound = |i: usize| i as f64 / count as f64;
    (0..count)
        .map(|i| {
            let (above, until) = (bound(i), bound(i + 1));
            let inside: Vec<_> =
                beliefs.iter().filter(|b| (i == 0 || b.confidence > above) && b.confidence <= until).collect();
            let right: Rate = inside.iter().map(|b| b.confidence_right).collect();
            let confidence: Vec<f64> = inside.iter().map(|b| b.confidence).collect();
            Bin {
                above,
                until,
                count: right.count,
                confidence: mean(&confidence).unwrap_or(0.0),
                right: right.share().unwrap_or(0.0),
                interval: right.interval(),
            }
        })
        .collect()
}

/// Expected calibration error: mean distance of confidence from the share that is right.
pub(in crate::blind) fn expected_error(bins: &[Bin]) -> Option<f64> {
    let all: usize = bins.iter().map(|b| b.count).sum();
    let sum: f64 = bins.iter().map(|b| b.count as f64 * (b.confidence - b.right).abs()).sum();
    (all > 0).then(|| sum / all as f64)
}

#[cfg(test)]
mod tests {
    use super::super::Belief;
    use super::{expected_error, of_beliefs};

    #[test]
    fn errors_are_weighed_by_the_answers_in_a_bin() {
        let belief = |confidence, confidence_right| Belief {
            brier: 0.0,
            confidence,
            confidence_right,
            in_set: true,
            set_size: 1,
        };
        // Two answers above 0.8, mean 0.9, one right; one at 0.6, which belongs to (0.4, 0.6], right; one without.
        let all = [belief(0.85, true), belief(0.95, false), belief(0.6, true), belief(0.0, false)];
        let bins = of_beliefs(&all.iter().collect::<Vec<_>>(), 5);
        assert_eq!(bins.iter().map(|b| b.count).collect::<Vec<_>>(), [1, 0, 1, 0, 2]);
        assert!((bins[4].confidence - 0.9).abs() < 1e-12 && bins[4].right == 0.5);
        // (2 x 0.4 + 1 x 0.4 + 1 x 0) / 4
        assert!((expected_error(&bins).expect("answers") - 0.3).abs() < 1e-12);
        assert_eq!(expected_error(&of_beliefs(&[], 5)), None);
    }
}
