//! Smoothing: velocity from noisy poses, local polynomial estimates.

use inference::robust;

use crate::settings::preparation::{SETTINGS, Smoothing};

const SMOOTHING: Smoothing = SETTINGS.smoothing;

/// Whittaker–Henderson smoother on equally spaced nodes: minimises
/// `Σ w_i (z_i − x(t_i))² / σ_i² + λ Σ (Δ³x)²`, with `x` linear between nodes (a discrete quintic smoothing spline).
///
/// `at` are the sample positions in nodes, `sigma` their errors relative to each other. λ and the common factor `s` of the
/// errors are the likeliest where the third differences are a random walk's ([`Normal::path`]): a residual as large as
/// `sigma` says would be met by paths far too smooth and far too rough alike where samples are many per node.
/// Samples that err by more than [`Smoothing::outlier`] times `s σ_i` weigh by `(outlier / error)²`, so that a few wild ones
/// neither bend the path nor make it follow the noise of the others.
/// Returns the node values; `None` with too few samples.
pub(crate) fn smooth(at: &[f64], z: &[f64], nodes: usize, sigma: &[f64]) -> Option<Vec<f64>> {
    if at.len() < SMOOTHING.least_samples || nodes < SMOOTHING.least_samples {
        return None;
    }
    let most = SMOOTHING.outlier;
    let exact: Vec<f64> = sigma.iter().map(|s| s.powi(-2)).collect();
    let mut best = Normal::new(at, z, &exact, nodes).likeliest();
    let mut scale = best.variance.sqrt();
    for _ in 1..SMOOTHING.rounds {
        let error = |(i, s): (usize, &f64)| (z[i] - interpolate(&best.nodes, at[i])).abs() / (s * scale);
        let errors = sigma.iter().enumerate().map(error);
        let weights: Vec<f64> = exact.iter().zip(errors).map(|(w, e)| w * (most / e.max(most)).powi(2)).collect();
        best = Normal::new(at, z, &weights, nodes).likeliest();
        // Clipped squares of normal errors are smaller than their squares.
        scale = (best.variance / clipped(most)).sqrt();
    }
    Some(best.nodes)
}

/// A path and what speaks for its smoothness.
struct Path {
    nodes: Vec<f64>,
    /// Likeliest square of the factor of the errors, `s²`.
    variance: f64,
    /// Marginal log-likelihood of λ with that factor, less what does not depend on it.
    log_likelihood: f64,
}

/// Half bandwidth of the normal matrix: third differences couple four nodes.
const BAND: usize = 3;

/// Normal equations of the samples.
struct Normal {
    /// Row i holds the entries (i, i), (i, i+1), ... (i, i+3) of the symmetric matrix `HᵀWH`.
    matrix: Vec<[f64; BAND + 1]>,
    /// `HᵀWz`.
    right: Vec<f64>,
    /// `zᵀWz`.
    squares: f64,
    samples: usize,
    /// Sum of the weights.
    weight: f64,
    /// Mean of the samples, which all of this is about.
    mean: f64,
}

impl Normal {
    fn new(at: &[f64], z: &[f64], weights: &[f64], nodes: usize) -> Self {
        let weight: f64 = weights.iter().sum();
        let mean = z.iter().zip(weights).map(|(z, w)| z * w).sum::<f64>() / weight;
        let (matrix, right) = (vec![[0.0; BAND + 1]; nodes], vec![0.0; nodes]);
        let mut out = Self { matrix, right, squares: 0.0, samples: z.len(), weight, mean };
        for ((&t, &v), &w) in at.iter().zip(z).zip(weights) {
            let (t, v) = (t.clamp(0.0, (nodes - 1) as f64), v - mean);
            let i = (t.floor() as usize).min(nodes - 2);
            let f = t - i as f64;
            out.matrix[i][0] += w * (1.0 - f) * (1.0 - f);
            out.matrix[i][1] += w * f * (1.0 - f);
            out.matrix[i + 1][0] += w * f * f;
            out.right[i] += w * (1.0 - f) * v;
            out.right[i + 1] += w * f * v;
            out.squares += w * v * v;
        }
        out
    }

    /// The path of the likeliest λ on a grid: the width of a path changes by the sixth root of λ only.
    fn likeliest(&self) -> Path {
        let unit = self.weight / self.matrix.len() as f64;
        let of = |log: f64| self.path(unit * 10f64.powf(log));
        let [low, high] = SMOOTHING.log_weights;
        let logs = (1..=SMOOTHING.tried).map(|k| low + (high - low) * k as f64 / SMOOTHING.tried as f64);
        let better = |a: Path, b: Path| if b.log_likelihood > a.log_likelihood { b } else { a };
        logs.map(of).fold(of(low), better)
    }

    /// The path of one λ. Its log-likelihood is, of n samples and N nodes,
    /// `−½ [(n − 3) ln s² + ln det(HᵀWH + λ DᵀD) − (N − 3) ln λ]`, `s² = (zᵀWz − zᵀWH x) / (n − 3)`
    /// (Wahba 1985, "A comparison of GCV and GML for choosing the smoothing parameter", of splines).
    fn path(&self, lambda: f64) -> Path {
        let (mut m, mut x) = (self.matrix.clone(), self.right.clone());
        let n = m.len();
        let d = [-1.0, 3.0, -3.0, 1.0];
        for i in 0..n - BAND {
            for r in 0..=BAND {
                for c in r..=BAND {
                    m[i + r][c - r] += lambda * d[r] * d[c];
                }
            }
        }

        // Banded LDLᵀ in place, then the two substitutions.
        for i in 0..n {
            for k in 1..=BAND.min(n - 1 - i) {
                let l = m[i][k] / m[i][0];
                for j in k..=BAND {
                    let u = m[i][j];
                    m[i + k][j - k] -= l * u;
                }
                x[i + k] -= l * x[i];
            }
        }
        for i in (0..n).rev() {
            for k in 1..=BAND.min(n - 1 - i) {
                x[i] -= m[i][k] * x[i + k];
            }
            x[i] /= m[i][0];
        }

        let free = (self.samples - BAND) as f64;
        let explained: f64 = self.right.iter().zip(&x).map(|(b, x)| b * x).sum();
        // Rounding leaves no less than this.
        let variance = (self.squares - explained).max(f64::EPSILON * self.squares).max(f64::MIN_POSITIVE) / free;
        let determinant = m.iter().map(|row| row[0].ln()).sum::<f64>() - (n - BAND) as f64 * lambda.ln();
        let value = -0.5 * (free * variance.ln() + determinant);
        let nodes = x.into_iter().map(|x| x + self.mean).collect();
        // A matrix that rounding made singular has no likelihood.
        Path { nodes, variance, log_likelihood: if value.is_finite() { value } else { f64::NEG_INFINITY } }
    }
}

/// Errors, one sigma, of samples that err by `sigma` and are written in the first row after their instant, where rows are
/// `row` nodes apart: they come late by up to a row, which errs by `|ż| row / √12`. Samples in every row are not late.
pub(crate) fn errors_of_late(at: &[f64], z: &[f64], sigma: f64, row: f64) -> Vec<f64> {
    let apart = robust::median(at.windows(2).map(|t| t[1] - t[0])).unwrap_or(0.0);
    let late = if apart > SMOOTHING.every_row * row { row / 12_f64.sqrt() } else { 0.0 };
    let beside = SMOOTHING.beside;
    let speed = |i: usize| {
        let (a, b) = (i.saturating_sub(beside), (i + beside).min(at.len() - 1));
        if at[b] > at[a] { (z[b] - z[a]) / (at[b] - at[a]) } else { 0.0 }
    };
    (0..at.len()).map(|i| sigma.hypot(late * speed(i))).collect()
}

/// `E min(z², c²)` of a standard normal `z`: `Φ(c) − Φ(−c) − 2 c φ(c) + 2 c² Φ(−c)`.
fn clipped(c: f64) -> f64 {
    let beyond = robust::normal_cdf(-c);
    let density = (-0.5 * c * c).exp() / std::f64::consts::TAU.sqrt();
    1.0 - 2.0 * beyond - 2.0 * c * density + 2.0 * c * c * beyond
}

/// Value between nodes.
pub(crate) fn interpolate(x: &[f64], t: f64) -> f64 {
    let t = t.clamp(0.0, (x.len() - 1) as f64);
    let i = (t.floor() as usize).min(x.len() - 2);
    let f = t - i as f64;
    x[i] * (1.0 - f) + x[i + 1] * f
}

/// Slope at a node position, per node, by a central difference over two nodes.
pub(crate) fn slope(x: &[f64], t: f64) -> f64 {
    let last = (x.len() - 1) as f64;
    let (a, b) = ((t - 1.0).max(0.0), (t + 1.0).min(last));
    (interpolate(x, b) - interpolate(x, a)) / (b - a)
}

/// Least-squares polynomial of degree at most two through `(t, z)`: value and slope at t = 0.
///
/// Fewer than three points, or points that coincide, give what is determined: a line, a mean, or `None`.
pub(crate) fn local_fit(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len();
    if n == 0 {
        return None;
    }
    let scale = points.iter().fold(0.0_f64, |a, p| a.max(p.0.abs()));
    if n < 3 || scale == 0.0 {
        let mean = points.iter().map(|p| p.1).sum::<f64>() / n as f64;
        if n == 2 && points[0].0 != points[1].0 {
            let slope = (points[1].1 - points[0].1) / (points[1].0 - points[0].0);
            return Some((points[0].1 - slope * points[0].0, slope));
        }
        return Some((mean, 0.0));
    }
    let mut s = [0.0; 5];
    let mut b = [0.0; 3];
    for &(t, z) in points {
        let t = t / scale;
        let mut p = 1.0;
        for (i, s) in s.iter_mut().enumerate() {
            *s += p;
            if i < 3 {
                b[i] += p * z;
            }
            p *= t;
        }
    }
    let m = nalgebra::Matrix3::new(s[0], s[1], s[2], s[1], s[2], s[3], s[2], s[3], s[4]);
    let x = m.cholesky()?.solve(&nalgebra::Vector3::from(b));
    Some((x[0], x[1] / scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn follows_a_parabola_through_noise_free_samples() {
        let f = |t: f64| 0.3 + 0.1 * t - 0.02 * t * t;
        let at: Vec<f64> = (0..60).map(|i| 0.3 + 1.7 * f64::from(i)).collect();
        let z: Vec<f64> = at.iter().map(|&t| f(t)).collect();
        let x = smooth(&at, &z, 104, &[1e-3; 60]).expect("enough samples");
        // Linear between nodes: about an eighth of the second difference is lost.
        approx::assert_abs_diff_eq!(interpolate(&x, 50.0), f(50.0), epsilon = 0.04 / 7.0);
        approx::assert_abs_diff_eq!(slope(&x, 50.0), 0.1 - 0.04 * 50.0, epsilon = 1e-2);
    }

    #[test]
    fn a_few_wild_samples_do_not_make_the_path_follow_the_noise() {
        let mut stream = sim::Stream::new(3, sim::Purpose::SensorNoise, 0);
        let at: Vec<f64> = (0..300).map(|i| 2.0 * f64::from(i)).collect();
        let truth = |t: f64| (0.02 * t).sin();
        let plain: Vec<f64> = at.iter().map(|&t| truth(t) + 0.01 * stream.normal()).collect();
        let wild: Vec<f64> = plain.iter().enumerate().map(|(i, z)| z + if i % 33 == 7 { 0.08 } else { 0.0 }).collect();
        let error = |z: &[f64]| {
            let x = smooth(&at, z, 600, &[0.01; 300]).expect("enough samples");
            robust::rms((20..580).map(|k| slope(&x, f64::from(k)) - 0.02 * (0.02 * f64::from(k)).cos()))
                .expect("slopes")
        };
        let [plain, wild] = [error(&plain), error(&wild)];
        // A path that follows the noise has slopes thirty times as wrong.
        assert!(wild < 5.0 * plain, "{wild} beside {plain}");
    }

    #[test]
    fn samples_that_come_late_err_by_what_is_moved_meanwhile() {
        // Ten nodes apart at two per row, moving by 0.3 a node.
        let at: Vec<f64> = (0..20).map(|i| 10.0 * f64::from(i)).collect();
        let z: Vec<f64> = at.iter().map(|t| 0.3 * t).collect();
        for error in errors_of_late(&at, &z, 0.1, 2.0) {
            approx::assert_relative_eq!(error, 0.1_f64.hypot(0.3 * 2.0 / 12_f64.sqrt()), epsilon = 1e-12);
        }
        // In every row none is late.
        assert!(errors_of_late(&at, &z, 0.1, 10.0).iter().all(|e| *e == 0.1));
    }

    #[test]
    fn a_clipped_square_of_a_normal_number_is_as_large_as_its_formula_says() {
        // By the trapezoidal rule.
        let of = |c: f64| {
            let z = |i: i32| f64::from(i) * 1e-3;
            let density = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
            (-9000..9000).map(|i| z(i).abs().min(c).powi(2) * density(z(i)) * 1e-3).sum::<f64>()
        };
        for c in [0.5, 2.0, 2.5] {
            approx::assert_abs_diff_eq!(clipped(c), of(c), epsilon = 1e-6);
        }
    }

    #[test]
    fn local_fit_returns_value_and_slope_of_a_parabola() {
        let p: Vec<_> = (-5..=5).map(|i| f64::from(i) * 0.01).map(|t| (t, 2.0 + 3.0 * t + 40.0 * t * t)).collect();
        let (v, s) = local_fit(&p).expect("points");
        approx::assert_relative_eq!(v, 2.0, epsilon = 1e-9);
        approx::assert_relative_eq!(s, 3.0, epsilon = 1e-7);
        assert_eq!(local_fit(&[]), None);
        assert_eq!(local_fit(&[(0.0, 4.0)]), Some((4.0, 0.0)));
    }
}
