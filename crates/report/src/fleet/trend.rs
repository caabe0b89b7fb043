//! Whether a size grows: a weighted line with the interval of its slope.

use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::words::NINETY;

/// Fewer recordings than this show no trend.
pub(super) const FEWEST: usize = 5;
/// Steps of the bisection: far below what a scatter is known to.
const STEPS: usize = 100;

pub(super) const METHOD: &str = "Trend: a straight line by weighted least squares, from five recordings on. A weight is one \
    over the variance of the size plus that between recordings, which is what makes the residuals as large as expected \
    (Paule and Mandel); the 90 % interval of the slope is Student's with two degrees less than recordings. A trend is \
    claimed only where that interval leaves out zero: of ten robots on which nothing changes, about one is still said to \
    have one.";

/// A line through sizes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// Slope, in the unit of the size per unit of the abscissa.
    pub slope: f64,
    /// Half of its 90 % interval.
    pub half: f64,
    /// Size at `centre`.
    pub level: f64,
    /// Weighted mean of the abscissae.
    pub centre: f64,
    /// Scatter between recordings beyond what their intervals say, one sigma.
    pub scatter: f64,
}

impl Trend {
    /// Whether the interval of the slope leaves out zero.
    pub fn is_clear(&self) -> bool {
        self.slope.abs() > self.half
    }

    /// The line at an abscissa.
    pub fn at(&self, x: f64) -> f64 {
        self.level + self.slope * (x - self.centre)
    }
}

/// Weighted sums of a line fitted with a scatter.
struct Fit {
    trend: Trend,
    /// Weighted sum of squared residuals.
    squares: f64,
    /// Weighted sum of squared distances from the centre.
    lever: f64,
}

fn fit(points: &[[f64; 3]], scatter: f64) -> Fit {
    let weight = |p: &[f64; 3]| 1.0 / (p[2] * p[2] + scatter * scatter);
    let sum = |f: &dyn Fn(&[f64; 3]) -> f64| points.iter().map(|p| weight(p) * f(p)).sum::<f64>();
    let all = sum(&|_| 1.0);
    let (centre, level) = (sum(&|p| p[0]) / all, sum(&|p| p[1]) / all);
    let lever = sum(&|p| (p[0] - centre).powi(2));
    let slope = sum(&|p| (p[0] - centre) * (p[1] - level)) / lever;
    let trend = Trend { slope, half: 0.0, level, centre, scatter };
    Fit { squares: sum(&|p| (p[1] - trend.at(p[0])).powi(2)), lever, trend }
}

/// The line through points (abscissa, size, half of the size's 90 % interval); none for fewer than five, for points at one
/// abscissa, and where an interval is not known.
///
/// y_i = a + b x_i + u_i + e_i with e_i of the size's own sigma and u_i of a scatter tau that makes
/// Σ w_i r_i² = n − 2, w_i = 1 / (sigma_i² + tau²). Half of the interval: t(n − 2, 0.95) / √(Σ w_i (x_i − x̄)²).
pub fn trend(points: &[[f64; 3]]) -> Option<Trend> {
    let usable = |p: &[f64; 3]| p.iter().all(|v| v.is_finite()) && p[2] > 0.0;
    let (first, count) = (points.first()?, points.len());
    if count < FEWEST || !points.iter().all(usable) || points.iter().all(|p| p[0] == first[0]) {
        return None;
    }
    let points: Vec<[f64; 3]> = points.iter().map(|p| [p[0], p[1], p[2] / NINETY]).collect();
    let freedom = (count - 2) as f64;
    let excess = |scatter: f64| fit(&points, scatter).squares - freedom;
    let spread = points.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max)
        - points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let (mut low, mut high) = (0.0, if excess(0.0) > 0.0 { spread.max(f64::MIN_POSITIVE) } else { 0.0 });
    while excess(high) > 0.0 {
        high *= 2.0;
    }
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    let Fit { mut trend, lever, .. } = fit(&points, high);
    // Never narrower than the sizes' own intervals permit.
    trend.half = StudentsT::new(0.0, 1.0, freedom).ok()?.inverse_cdf(0.95) / lever.sqrt();
    (trend.slope.is_finite() && trend.half.is_finite()).then_some(trend)
}
