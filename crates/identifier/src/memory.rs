//! What an identifier keeps: recursive least squares on filtered signals.

use nalgebra::{SMatrix, SVector};
use nn_basis::{Scalar, real};

use crate::Sample;
use crate::error::{IdentifierError, finite, positive};

/// How a memory filters, forgets and is held back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MemorySettings<T> {
    /// Bandwidth β of the filter that both sides of the equation pass, 1/s: noise beyond it does not count.
    pub bandwidth: T,
    /// Rate at which old samples lose weight, 1/s; 0 keeps all.
    pub forgetting: T,
    /// Ridge δ, s: as if each weight had been seen to be zero with a regressor of one for so long.
    pub ridge: T,
}

/// Recursive least squares with forgetting: the weights that explain all that was seen.
///
/// Of each sample the equation `(x_{k+1} − x_k)/h + a x_m = Wᵀφ` is passed through `y_{k+1} = y_k + α(u_k − y_k)`,
/// `α = βh/(1 + βh)`, on both sides, which leaves W as it is and takes the noise of the derivative away. With y the left
/// side so filtered and φ_f the right, `W = (R + δI)⁻¹ r`, where `R = Σ h φ_f φ_fᵀ` and `r = Σ h φ_f y` are discounted by
/// `1/(1 + h · forgetting)` per sample. Kept in this form R + δI stays positive definite, in single precision too, and
/// `‖W‖ ≤ √(Σ h y²)/(2√δ)`: bounded while the output is.
///
/// Regressor entries should be of the order of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Memory<T: Scalar, const N: usize> {
    settings: MemorySettings<T>,
    target: T,
    regressor: SVector<T, N>,
    information: SMatrix<T, N, N>,
    cross: SVector<T, N>,
    weight: SVector<T, N>,
}

impl<T: Scalar, const N: usize> Memory<T, N> {
    /// A memory of nothing.
    ///
    /// # Errors
    /// [`IdentifierError`] if bandwidth or ridge are not positive, or the forgetting negative or not finite.
    pub fn new(settings: MemorySettings<T>) -> Result<Self, IdentifierError> {
        positive("bandwidth of the memory", settings.bandwidth)?;
        positive("ridge of the memory", settings.ridge)?;
        if finite("forgetting of the memory", settings.forgetting)? < T::zero() {
            return Err(IdentifierError::Negative { name: "forgetting of the memory" });
        }
        let (target, vector) = (T::zero(), SVector::zeros());
        Ok(Self { settings, target, regressor: vector, information: SMatrix::zeros(), cross: vector, weight: vector })
    }

    /// Takes in a sample; `pole` is a, 1/s. What the sample names as known is not learned again.
    ///
    /// The work is the same for every sample: one Cholesky factorisation of N × N. A factorisation that fails, which
    /// takes input that is not finite, leaves the weights as they are.
    pub fn learn(&mut self, pole: T, sample: &Sample<T, N>) {
        let h = sample.h;
        let rate = self.settings.bandwidth * h;
        let share = rate / (T::one() + rate);
        self.target += share * (sample.right_hand_side(pole) - sample.known - self.target);
        self.regressor += (SVector::from(sample.regressor) - self.regressor) * share;
        let kept = T::one() / (T::one() + self.settings.forgetting * h);
        let weighted = self.regressor * h;
        self.information = (self.information + weighted * self.regressor.transpose()) * kept;
        self.cross = (self.cross + weighted * self.target) * kept;
        let mut normal = self.information;
        for i in 0..N {
            normal[(i, i)] += self.settings.ridge;
        }
        if let Some(factor) = normal.cholesky() {
            self.weight = factor.solve(&self.cross);
        }
    }

    /// The weights that explain what was seen.
    pub fn weight(&self) -> [T; N] {
        self.weight.into()
    }

    /// Standard deviation of each weight per standard deviation of white noise in the filtered equation, 1/√s.
    ///
    /// The square roots of the diagonal of `(R + δI)⁻¹`; large where what was seen says little.
    pub fn uncertainty(&self) -> [T; N] {
        let mut normal = self.information;
        for i in 0..N {
            normal[(i, i)] += self.settings.ridge;
        }
        let Some(factor) = normal.cholesky() else { return [real(f64::INFINITY); N] };
        let inverse = factor.inverse();
        core::array::from_fn(|i| inverse[(i, i)].sqrt())
    }
}
