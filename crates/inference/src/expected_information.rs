//! Expected gain of information of an experiment, in bits.

use faer::Mat;

use crate::evidence::normalised;
use crate::robust::normal_quantile;
use crate::settings::SETTINGS;

/// Points of the quasi-random sum.
const POINTS: usize = SETTINGS.information.points;
/// Bases of Halton's sequence, one for each rival of the truth.
const BASES: [u32; 8] = [2, 3, 5, 7, 11, 13, 17, 19];

/// What an experiment would say about all rivals if a certain one were true.
#[derive(Debug, Clone)]
pub struct Forecast {
    /// Expected fall of each rival's log-likelihood below the truth's, nats; 0 of the truth itself.
    pub behind: Vec<f64>,
    /// Covariance of these falls; twice `behind` on the diagonal.
    pub covariance: Mat<f64>,
}

impl Forecast {
    /// Of rivals that fall `behind` by these log-likelihoods (those below zero count as zero), when
    /// what tells `a` from the truth and what tells `b` from it correlate by `alike(a, b)`.
    ///
    /// Twice the mean of a log-likelihood ratio of normal data is its variance:
    /// `Cov(a, b) = 2 √(d_a d_b) · alike(a, b)`.
    pub fn new(mut behind: Vec<f64>, alike: impl Fn(usize, usize) -> f64) -> Self {
        for d in &mut behind {
            *d = d.max(0.0);
        }
        let n = behind.len();
        let covariance = Mat::from_fn(n, n, |a, b| 2.0 * (behind[a] * behind[b]).sqrt() * alike(a, b));
        Self { behind, covariance }
    }
}

/// The pair of a truth and a rival of it that an experiment tells apart best: the largest
/// `p_k p_l (1 − exp(−d_kl / T))`; `None` of fewer than two.
pub fn widest_pair(p: &[f64], forecasts: &[Forecast], temperature: f64) -> Option<(usize, usize)> {
    let worth = |(k, l): (usize, usize)| p[k] * p[l] * (1.0 - (-forecasts[k].behind[l] / temperature).exp());
    let pairs = (0..p.len()).flat_map(|k| (0..p.len()).filter(move |l| *l != k).map(move |l| (k, l)));
    pairs.max_by(|a, b| worth(*a).total_cmp(&worth(*b)))
}

/// Entropy of a distribution, bits: `−Σ p log2 p`.
pub fn entropy(p: &[f64]) -> f64 {
    // A sum of no surprise at all is zero, not minus zero.
    p.iter().filter(|p| **p > 0.0).map(|p| -p * p.log2()).sum::<f64>().abs()
}

/// Bits that an experiment is expected to gain: the entropy of the rivals less its expectation afterwards,
/// `H(p) − Σ_k p_k E[H(p_l exp(−x_l / T))]` with `x ~ N(behind, covariance)` if rival k is true, and T the temperature
/// with which scores become probabilities.
///
/// The expectation is a sum over Halton points: the same bits for the same input.
pub fn expected_bits(p: &[f64], forecasts: &[Forecast], temperature: f64) -> f64 {
    let n = p.len();
    let points: Vec<Vec<f64>> =
        (1..=POINTS).map(|i| BASES.iter().map(|b| normal_quantile(radical_inverse(i as u32, *b))).collect()).collect();
    let mut after = 0.0;
    for (k, forecast) in forecasts.iter().enumerate() {
        let root = root(&forecast.covariance);
        let mut sum = 0.0;
        for z in &points {
            let weight = |l: usize| {
                let x: f64 = forecast.behind[l] + (0..n).map(|i| root[(l, i)] * z[i % BASES.len()]).sum::<f64>();
                p[l] * (-x / temperature).exp()
            };
            let all: Vec<f64> = (0..n).map(weight).collect();
            sum += entropy(&normalised(&all));
        }
        after += p[k] * sum / POINTS as f64;
    }
    (entropy(p) - after).max(0.0)
}

/// Halton's sequence: the digits of `i` mirrored at the point.
fn radical_inverse(mut i: u32, base: u32) -> f64 {
    let (mut out, mut share) = (0.0, 1.0 / f64::from(base));
    while i > 0 {
        out += f64::from(i % base) * share;
        i /= base;
        share /= f64::from(base);
    }
    out
}

/// Lower triangular root of a covariance that may be singular: a direction without variance gets none.
fn root(c: &Mat<f64>) -> Mat<f64> {
    let n = c.nrows();
    let mut l = Mat::<f64>::zeros(n, n);
    for j in 0..n {
        let rest = c[(j, j)] - (0..j).map(|k| l[(j, k)] * l[(j, k)]).sum::<f64>();
        let pivot = if rest > 1e-9 * c[(j, j)].max(1e-9) { rest.sqrt() } else { 0.0 };
        l[(j, j)] = pivot;
        for i in j + 1..n {
            let product = c[(i, j)] - (0..j).map(|k| l[(i, k)] * l[(j, k)]).sum::<f64>();
            l[(i, j)] = if pivot > 0.0 { product / pivot } else { 0.0 };
        }
    }
    l
}

#[cfg(test)]
mod tests {
    use rand_core::{Rng, SeedableRng};

    use super::*;

    /// Standard normal numbers by inversion.
    struct Stream(rand_pcg::Pcg64);

    impl Stream {
        fn normal(&mut self) -> f64 {
            normal_quantile((self.0.next_u64() >> 11) as f64 * 2.0_f64.powi(-53) + 2.0_f64.powi(-54))
        }
    }

    fn pair(d: f64) -> Vec<Forecast> {
        let covariance = |k: usize| Mat::from_fn(2, 2, |i, j| f64::from(i == j && i != k) * 2.0 * d);
        let behind = |k: usize| (0..2).map(|l| if l == k { 0.0 } else { d }).collect();
        (0..2).map(|k| Forecast { behind: behind(k), covariance: covariance(k) }).collect()
    }

    #[test]
    fn what_shows_nothing_gains_nothing_and_what_shows_all_gains_all() {
        let p = [0.7, 0.3];
        assert!(expected_bits(&p, &pair(0.0), 1.0).abs() < 1e-12);
        approx::assert_relative_eq!(expected_bits(&p, &pair(200.0), 1.0), entropy(&p), epsilon = 1e-9);
        approx::assert_relative_eq!(entropy(&[0.5, 0.5]), 1.0);
        assert_eq!(entropy(&[1.0, 0.0]).to_bits(), 0.0_f64.to_bits(), "not minus zero");
        approx::assert_relative_eq!(entropy(&[0.25; 4]), 2.0, epsilon = 1e-12);
    }

    /// Of two rivals alike in probability the information is that of a binary channel with Gaussian noise:
    /// `1 − E[log2(1 + exp(−x))]`, `x ~ N(d, 2d)`, here by Simpson's rule.
    #[test]
    fn two_rivals_gain_what_the_integral_says() {
        for d in [0.3_f64, 1.0, 3.0, 8.0] {
            let (n, reach) = (2000, 8.0_f64);
            let h = 2.0 * reach / f64::from(n);
            let mut loss = 0.0;
            for i in 0..=n {
                let z: f64 = -reach + h * f64::from(i);
                let weight = if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                let x = d + (2.0 * d).sqrt() * z;
                let density = (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
                loss += weight * h / 3.0 * density * (-x).exp().ln_1p() / std::f64::consts::LN_2;
            }
            approx::assert_relative_eq!(expected_bits(&[0.5; 2], &pair(d), 1.0), 1.0 - loss, epsilon = 0.01);
        }
    }

    /// Three rivals whose responses are points of a plane: the sum agrees with drawing the data themselves.
    #[test]
    fn three_rivals_agree_with_drawing_the_data() {
        let mean = [[0.0, 0.0], [1.5, 0.4], [-0.3, 2.0]];
        let p = [0.5, 0.3, 0.2];
        let to = |a: usize, b: usize| [mean[b][0] - mean[a][0], mean[b][1] - mean[a][1]];
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let forecasts: Vec<Forecast> = (0..3)
            .map(|k| Forecast {
                behind: (0..3).map(|l| 0.5 * dot(to(k, l), to(k, l))).collect(),
                covariance: Mat::from_fn(3, 3, |a, b| dot(to(k, a), to(k, b))),
            })
            .collect();
        let mut stream = Stream(rand_pcg::Pcg64::seed_from_u64(7));
        let (draws, mut after) = (20_000, 0.0);
        for k in 0..3 {
            for _ in 0..draws {
                let y = [mean[k][0] + stream.normal(), mean[k][1] + stream.normal()];
                let w = |l: usize| p[l] * (-0.5 * ((y[0] - mean[l][0]).powi(2) + (y[1] - mean[l][1]).powi(2))).exp();
                let total = w(0) + w(1) + w(2);
                after += p[k] * entropy(&[w(0) / total, w(1) / total, w(2) / total]) / f64::from(draws);
            }
        }
        approx::assert_relative_eq!(expected_bits(&p, &forecasts, 1.0), entropy(&p) - after, epsilon = 0.02);
    }

    /// Worth of a pair: `p_k p_l (1 − exp(−d/T))`.
    #[test]
    fn the_widest_pair_is_probable_and_far_apart() {
        let forecasts = |apart: [[f64; 3]; 3]| -> Vec<Forecast> {
            apart.into_iter().map(|behind| Forecast::new(behind.to_vec(), |_, _| 0.0)).collect()
        };
        // All as far apart: the two most probable.
        let alike = forecasts([[0.0, 2.0, 2.0], [2.0, 0.0, 2.0], [2.0, 2.0, 0.0]]);
        let sorted = |pair: Option<(usize, usize)>| pair.map(|(k, l)| (k.min(l), k.max(l)));
        assert_eq!(sorted(widest_pair(&[0.2, 0.45, 0.35], &alike, 1.0)), Some((1, 2)));
        // The two most probable show the same: the next pair that differs.
        let hidden = forecasts([[0.0, 3.0, 3.0], [3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
        assert_eq!(sorted(widest_pair(&[0.2, 0.45, 0.35], &hidden, 1.0)), Some((0, 1)));
        // 0.2 · 0.2 (1 − e⁻⁴) = 0.039 against 0.2 · 0.6 (1 − e^(−0.5)) = 0.047; at ten times the temperature
        // 0.013 against 0.0059.
        let near = forecasts([[0.0, 4.0, 0.5], [4.0, 0.0, 0.0], [0.5, 0.0, 0.0]]);
        assert_eq!(sorted(widest_pair(&[0.2, 0.2, 0.6], &near, 1.0)), Some((0, 2)));
        assert_eq!(sorted(widest_pair(&[0.2, 0.2, 0.6], &near, 10.0)), Some((0, 1)));
        assert_eq!(widest_pair(&[1.0], &forecasts([[0.0; 3]; 3])[..1], 1.0), None);
    }
}
