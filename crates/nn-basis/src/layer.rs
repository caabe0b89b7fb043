//! The fixed first layer.

use crate::{Activation, Basis, BasisError, Lanes, Scalar};

/// A fixed layer of N sigmoid units over I scaled inputs, `φ_j = S(V_j0 + Σ_i V_ji x_i / scale_i)`.
///
/// The paper's V is N × (I + 1); its first column, which multiplies x₀ ≡ 1, is `threshold` here.
/// Scales are a-priori magnitudes: without them large inputs saturate units, which then switch off together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SigmoidLayer<T, const I: usize, const N: usize> {
    threshold: [T; N],
    weight: [[T; I]; N],
    activation: Activation,
}

impl<T: Scalar, const I: usize, const N: usize> SigmoidLayer<T, I, N> {
    /// Builds the layer.
    ///
    /// `threshold` and `weight` (one row per unit) are dimensionless; `scale` has the units of the inputs.
    ///
    /// # Errors
    /// [`BasisError`] names the first entry that is not finite, or the scale that is not positive.
    pub fn new(
        threshold: [T; N],
        mut weight: [[T; I]; N],
        scale: [T; I],
        activation: Activation,
    ) -> Result<Self, BasisError> {
        if let Some(input) = scale.iter().position(|s| !(s.is_finite() && T::zero().is_less(*s))) {
            return Err(BasisError::Scale { input });
        }
        for unit in 0..N {
            if !threshold[unit].is_finite() {
                return Err(BasisError::Threshold { unit });
            }
            for input in 0..I {
                weight[unit][input] /= scale[input];
                if !weight[unit][input].is_finite() {
                    return Err(BasisError::Weight { unit, input });
                }
            }
        }
        Ok(Self { threshold, weight, activation })
    }
}

impl<const L: usize, const I: usize, const N: usize> SigmoidLayer<Lanes<L>, I, N> {
    /// Several layers as one, a lane for each. `None` if their activations differ, or there are none.
    pub fn side_by_side(layers: &[SigmoidLayer<f64, I, N>; L]) -> Option<Self> {
        let activation = layers.first()?.activation;
        if layers.iter().any(|l| l.activation != activation) {
            return None;
        }
        let mut all = Self { threshold: [Lanes([0.0; L]); N], weight: [[Lanes([0.0; L]); I]; N], activation };
        for (lane, layer) in layers.iter().enumerate() {
            for unit in 0..N {
                all.threshold[unit].0[lane] = layer.threshold[unit];
                for input in 0..I {
                    all.weight[unit][input].0[lane] = layer.weight[unit][input];
                }
            }
        }
        Some(all)
    }
}

impl<T: Scalar, const I: usize, const N: usize> Basis<T, I, N> for SigmoidLayer<T, I, N> {
    #[inline(always)]
    fn regressor(&self, input: &[T; I]) -> [T; N] {
        let mut phi = self.threshold;
        for (unit, row) in phi.iter_mut().zip(&self.weight) {
            for (w, x) in row.iter().zip(input) {
                *unit += *w * *x;
            }
        }
        // Apart from the sums, so that several units go through the function at once.
        for unit in &mut phi {
            *unit = self.activation.apply(*unit);
        }
        phi
    }
}
