//! Evidence of hypotheses that differ in what is known of the constants before the drives.
//!
//! About the fit the cost is quadratic, so that the evidence of any Gaussian prior follows from one set of equations. With the
//! curvature Λ and the slope g₀ of all sessions at the prior's mean μ₀, the evidence over that of μ₀ alone is
//! `½ g₀ᵀ (P⁻¹ + Λ)⁻¹ g₀ − ½ ln |I + P Λ|`. With `P = L Lᵀ`, `(P⁻¹ + Λ)⁻¹ = L (I + Lᵀ Λ L)⁻¹ Lᵀ`.

use nalgebra::{DMatrix, DVector};

use crate::session::Session;

/// What the sessions say together.
#[derive(Debug, Clone)]
pub struct Evidence {
    curvature: DMatrix<f64>,
    /// Slope of the cost at the prior's mean.
    slope: DVector<f64>,
    mean: DVector<f64>,
    /// Cost at the prior's mean, nats.
    pub base: f64,
}

/// What other sessions say is added.
impl std::ops::AddAssign<&Self> for Evidence {
    fn add_assign(&mut self, other: &Self) {
        self.base += other.base;
        self.slope += &other.slope;
        self.curvature += &other.curvature;
    }
}

/// Constants as a prior and the sessions have them together.
#[derive(Debug, Clone)]
pub struct Posterior {
    /// Most probable values.
    pub mean: DVector<f64>,
    /// Covariance about them.
    pub covariance: DMatrix<f64>,
}

impl Evidence {
    /// Of sessions linearised at `theta`, seen from the prior's mean.
    pub fn new(theta: &[f64], sessions: &[Session], scatter: &DVector<f64>, mean: &DVector<f64>) -> Option<Self> {
        let theta = DVector::from_column_slice(theta);
        let mut out = Self::of_nothing(mean);
        for session in sessions {
            out += &Self::of_session(&theta, session, scatter, mean)?;
        }
        Some(out)
    }

    /// Of no sessions.
    pub(crate) fn of_nothing(mean: &DVector<f64>) -> Self {
        let n = mean.len();
        Self { curvature: DMatrix::zeros(n, n), slope: DVector::zeros(n), mean: mean.clone(), base: 0.0 }
    }

    /// The prior's mean.
    pub(crate) fn mean(&self) -> &DVector<f64> {
        &self.mean
    }

    /// Slope of the cost at the prior's mean.
    pub(crate) fn slope(&self) -> &DVector<f64> {
        &self.slope
    }

    /// Of one session.
    pub(crate) fn of_session(
        theta: &DVector<f64>,
        session: &Session,
        scatter: &DVector<f64>,
        mean: &DVector<f64>,
    ) -> Option<Self> {
        let marginal = session.marginal(scatter)?;
        let d = mean - theta;
        let turned = &marginal.curvature * &d;
        Some(Self {
            base: marginal.cost + marginal.width + marginal.slope.dot(&d) + 0.5 * d.dot(&turned),
            slope: marginal.slope + turned,
            curvature: marginal.curvature,
            mean: mean.clone(),
        })
    }

    fn factors(&self, covariance: &DMatrix<f64>) -> Option<(DMatrix<f64>, nalgebra::Cholesky<f64, nalgebra::Dyn>)> {
        let l = covariance.clone().cholesky()?.l();
        let n = l.nrows();
        let inner = DMatrix::identity(n, n) + l.transpose() * &self.curvature * &l;
        Some((l, inner.cholesky()?))
    }

    /// Evidence of a prior covariance over that of none, nats.
    pub fn of(&self, covariance: &DMatrix<f64>) -> Option<f64> {
        let (l, inner) = self.factors(covariance)?;
        let pulled = l.transpose() * &self.slope;
        let half_log_determinant: f64 = inner.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        Some(0.5 * pulled.dot(&inner.solve(&pulled)) - half_log_determinant)
    }

    /// Constants under a prior covariance.
    pub fn posterior(&self, covariance: &DMatrix<f64>) -> Option<Posterior> {
        let (l, inner) = self.factors(covariance)?;
        let covariance = &l * inner.solve(&l.transpose());
        Some(Posterior { mean: &self.mean - &covariance * &self.slope, covariance })
    }
}
