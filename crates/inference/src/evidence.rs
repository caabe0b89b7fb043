//! From scores of hypotheses, in nats, to probabilities, and back to what may be said.

/// `ln Σ exp(xᵢ)` without overflow; −∞ of nothing.
pub fn log_sum_exp(x: &[f64]) -> f64 {
    let top = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if top.is_finite() { top + x.iter().map(|x| (x - top).exp()).sum::<f64>().ln() } else { top }
}

/// Probabilities of hypotheses that exclude each other, from their log evidences (softmax):
/// `pᵢ = exp(sᵢ/T) / Σ exp(sⱼ/T)`. They sum to one.
///
/// A temperature above 1 says that scores are surer than they deserve: evidence counts by 1/T.
/// A score of −∞ is impossible.
pub fn probabilities(scores: &[f64], temperature: f64) -> Vec<f64> {
    let top = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weight: Vec<f64> = scores.iter().map(|s| ((s - top) / temperature).exp()).collect();
    normalised(&weight)
}

/// Weights over their sum; as they are if there is no sum to divide by.
pub fn normalised(weights: &[f64]) -> Vec<f64> {
    let sum: f64 = weights.iter().sum();
    if sum > 0.0 && sum.is_finite() { weights.iter().map(|w| w / sum).collect() } else { weights.to_vec() }
}

/// Probability of log odds: `1/(1 + exp(−x))`.
pub fn logistic(log_odds: f64) -> f64 {
    1.0 / (1.0 + (-log_odds).exp())
}

/// Probability that none of some independent things is there: `Π (1 − pᵢ)`.
pub fn none_of(p: impl IntoIterator<Item = f64>) -> f64 {
    p.into_iter().map(|p| 1.0 - p).product()
}

/// Price of a free number by the Bayesian information criterion, `½ ln n` of `n` numbers that it was
/// fitted to; nats. Fewer than two numbers count as two.
pub fn price_of_a_constant(numbers: usize) -> f64 {
    0.5 * (numbers as f64).max(2.0).ln()
}

/// Penalty of a size below the smallest that matters, nats: half the square of how many `width`s its
/// logarithm falls short of `interest`; none from `interest` on.
pub fn penalty_of_smallness(size: f64, interest: f64, width: f64) -> f64 {
    if interest <= 0.0 {
        return 0.0;
    }
    let short = (interest / size.abs().max(1e-12)).ln().max(0.0) / width;
    0.5 * short * short
}

/// Whether a hypothesis cannot be told from the best: its score lies within `log_odds` of it.
pub fn is_within_odds(score: f64, best: f64, log_odds: f64) -> bool {
    score > best - log_odds
}

/// The smallest set of hypotheses, most probable first, that holds the truth with probability `mass`.
pub fn credible_set(p: &[f64], mass: f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|a, b| p[*b].total_cmp(&p[*a]));

    let mut held = 0.0;
    let mut out = Vec::new();
    for i in order {
        if held >= mass {
            break;
        }
        held += p[i];
        out.push(i);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_sum_to_one_and_follow_the_odds() {
        for scores in [vec![0.0], vec![1.0, -2.0, 0.5], vec![900.0, 899.0, -900.0], vec![-1e5, -1e5]] {
            let p = probabilities(&scores, 1.0);
            approx::assert_relative_eq!(p.iter().sum::<f64>(), 1.0, epsilon = 1e-12);
        }
        let p = probabilities(&[3.0, 1.0, f64::NEG_INFINITY], 4.0);
        approx::assert_relative_eq!(p[0] / p[1], 0.5_f64.exp(), epsilon = 1e-12);
        assert_eq!(p[2], 0.0);
    }

    #[test]
    fn the_sum_in_logarithms_does_not_overflow() {
        approx::assert_relative_eq!(log_sum_exp(&[1000.0, 1000.0]), 1000.0 + 2.0_f64.ln(), epsilon = 1e-12);
        approx::assert_relative_eq!(
            log_sum_exp(&[0.3, -0.2]),
            (0.3_f64.exp() + (-0.2_f64).exp()).ln(),
            epsilon = 1e-14
        );
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
    }

    #[test]
    fn independent_causes_leave_nothing_with_the_product() {
        approx::assert_relative_eq!(none_of([0.5, 0.2]), 0.4, epsilon = 1e-15);
        assert_eq!((none_of([]), none_of([1.0, 0.3])), (1.0, 0.0));
        assert_eq!(logistic(0.0), 0.5);
        approx::assert_relative_eq!(logistic(9.0_f64.ln()), 0.9, epsilon = 1e-15);
    }

    #[test]
    fn the_credible_set_is_the_smallest_that_holds_its_mass() {
        assert_eq!(credible_set(&[0.1, 0.6, 0.3], 0.85), [1, 2]);
        assert_eq!(credible_set(&[0.1, 0.6, 0.3], 0.6), [1]);
        assert_eq!(credible_set(&[0.1, 0.6, 0.3], 1.0).len(), 3);
        assert!(credible_set(&[], 0.9).is_empty());
    }

    #[test]
    fn prices_are_those_of_their_formulas() {
        assert_eq!(price_of_a_constant(0), 0.5 * 2.0_f64.ln());
        approx::assert_relative_eq!(price_of_a_constant(100), 10.0_f64.ln(), epsilon = 1e-15);
        assert_eq!((penalty_of_smallness(2.0, 1.0, 0.35), penalty_of_smallness(0.1, 0.0, 0.35)), (0.0, 0.0));
        approx::assert_relative_eq!(penalty_of_smallness(-1.0, 0.35_f64.exp(), 0.35), 0.5, epsilon = 1e-12);
        assert!(is_within_odds(-4.0, 1.0, 5.3) && !is_within_odds(-4.4, 1.0, 5.3));
    }

    #[test]
    fn weights_without_a_finite_sum_stay_and_the_limit_of_the_odds_is_outside() {
        assert_eq!(normalised(&[0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(normalised(&[f64::INFINITY, 1.0]), [f64::INFINITY, 1.0]);
        assert!(is_within_odds(1.5, 3.0, 2.0) && !is_within_odds(1.0, 3.0, 2.0));
    }
}
