//! Smoothing: velocity from noisy poses, local polynomial estimates.

use crate::settings::preparation::{SETTINGS, Smoothing};

const SMOOTHING: Smoothing = SETTINGS.smoothing;

/// Whittaker–Henderson smoother on equally spaced nodes: minimises
/// `Σ (z_i − x(t_i))² + λ Σ (Δ³x)²`, with `x` linear between nodes (a discrete quintic smoothing spline).
///
/// `at` are the sample positions in nodes. λ is found so that the rms residual equals `sigma`
/// (discrepancy principle). Returns the node values; `None` with too few samples.
pub(crate) fn smooth(at: &[f64], z: &[f64], nodes: usize, sigma: f64) -> Option<Vec<f64>> {
    if at.len() < SMOOTHING.least_samples || nodes < SMOOTHING.least_samples {
        return None;
    }
    let rms = |x: &[f64]| {
        let sum: f64 = at.iter().zip(z).map(|(&t, &v)| (v - interpolate(x, t)).powi(2)).sum();
        (sum / at.len() as f64).sqrt()
    };
    let [mut low, mut high] = SMOOTHING.log_weights;
    let mut best = whittaker(at, z, nodes, 10f64.powf(low));
    // The residual grows with λ: bisect its logarithm.
    for _ in 0..SMOOTHING.halvings {
        let middle = 0.5 * (low + high);
        let x = whittaker(at, z, nodes, 10f64.powf(middle));
        if rms(&x) > sigma {
            high = middle;
        } else {
            low = middle;
            best = x;
        }
    }
    Some(best)
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

/// Half bandwidth of the normal matrix: third differences couple four nodes.
const BAND: usize = 3;

fn whittaker(at: &[f64], z: &[f64], n: usize, lambda: f64) -> Vec<f64> {
    // Row i holds the entries (i, i), (i, i+1), ... (i, i+3) of the symmetric normal matrix.
    let mut m = vec![[0.0; BAND + 1]; n];
    let mut b = vec![0.0; n];
    for (&t, &v) in at.iter().zip(z) {
        let t = t.clamp(0.0, (n - 1) as f64);
        let i = (t.floor() as usize).min(n - 2);
        let f = t - i as f64;
        m[i][0] += (1.0 - f) * (1.0 - f);
        m[i][1] += f * (1.0 - f);
        m[i + 1][0] += f * f;
        b[i] += (1.0 - f) * v;
        b[i + 1] += f * v;
    }

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
            b[i + k] -= l * b[i];
        }
    }
    for i in (0..n).rev() {
        for k in 1..=BAND.min(n - 1 - i) {
            b[i] -= m[i][k] * b[i + k];
        }
        b[i] /= m[i][0];
    }
    b
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
        let x = smooth(&at, &z, 104, 1e-3).expect("enough samples");
        // Linear between nodes: up to an eighth of the second difference is lost.
        approx::assert_abs_diff_eq!(interpolate(&x, 50.0), f(50.0), epsilon = 0.04 / 8.0);
        approx::assert_abs_diff_eq!(slope(&x, 50.0), 0.1 - 0.04 * 50.0, epsilon = 1e-2);
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
