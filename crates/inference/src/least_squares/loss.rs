//! Losses of residuals, of which some let outliers count less.

/// What a residual costs. Residuals come in units of their standard deviation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Loss {
    /// `½ r²`.
    #[default]
    Square,
    /// `½ r²` up to the scale, linear beyond (Huber 1964).
    Huber(f64),
    /// `s² (√(1 + (r/s)²) − 1)`: Huber's without a corner.
    SoftL1(f64),
    /// Blocks of so many residuals in turn: `½ n κ ln(1 + Σr²/(n κ))`. A block that fits badly as a whole
    /// counts less, however its residuals are spread within.
    Saturated {
        /// Residuals of a block, n.
        block: usize,
        /// Mean square at which a block counts half, κ.
        scale: f64,
    },
}

/// Cost of a block of `count` numbers with the sum of squares `q`, saturated at mean squares of `scale`:
/// `½ n κ ln(1 + q/(n κ))`, nats; 0 of nothing.
pub fn saturated(q: f64, count: f64, scale: f64) -> f64 {
    if count == 0.0 { 0.0 } else { 0.5 * count * scale * (q / (scale * count)).ln_1p() }
}

/// Weight of such a block: `1/(1 + q/(n κ))`.
pub fn saturation(q: f64, count: f64, scale: f64) -> f64 {
    1.0 / (1.0 + q / (scale * count.max(1.0)))
}

impl Loss {
    /// Cost of all residuals.
    pub fn cost(self, r: &[f64]) -> f64 {
        match self {
            Self::Square => r.iter().map(|r| 0.5 * r * r).sum(),
            Self::Huber(s) => r.iter().map(|r| if r.abs() < s { 0.5 * r * r } else { s * (r.abs() - 0.5 * s) }).sum(),
            Self::SoftL1(s) => r.iter().map(|r| s * s * ((1.0 + (r / s).powi(2)).sqrt() - 1.0)).sum(),
            Self::Saturated { block, scale } => {
                r.chunks(block.max(1)).map(|b| saturated(squares(b), b.len() as f64, scale)).sum()
            }
        }
    }

    /// Weight of each residual in the normal equations: the loss's slope over the residual.
    pub fn weights(self, r: &[f64]) -> Vec<f64> {
        match self {
            Self::Square => vec![1.0; r.len()],
            Self::Huber(s) => r.iter().map(|r| s / r.abs().max(s)).collect(),
            Self::SoftL1(s) => r.iter().map(|r| (1.0 + (r / s).powi(2)).powf(-0.5)).collect(),
            Self::Saturated { block, scale } => r
                .chunks(block.max(1))
                .flat_map(|b| std::iter::repeat_n(saturation(squares(b), b.len() as f64, scale), b.len()))
                .collect(),
        }
    }
}

fn squares(r: &[f64]) -> f64 {
    r.iter().map(|r| r * r).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_slopes_over_residuals() {
        let r = [0.3, -2.0, 7.0, 0.9];
        for loss in [Loss::Square, Loss::Huber(1.0), Loss::SoftL1(3.0), Loss::Saturated { block: 2, scale: 4.0 }] {
            let weights = loss.weights(&r);
            for i in 0..r.len() {
                let at = |h: f64| {
                    let mut r = r;
                    r[i] += h;
                    loss.cost(&r)
                };
                let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
                approx::assert_relative_eq!(slope, weights[i] * r[i], epsilon = 1e-6);
            }
        }
        assert_eq!(saturated(0.0, 0.0, 1.0), 0.0);
    }
}
