//! Normal equations of a session, with and without its own deviation.
//!
//! The constants of a session are those of the robot plus a deviation `δ ~ N(0, T)`, which is eliminated (Schur complement):
//! sessions then weigh by what they say of the robot, not by their length, and the interval of a constant is as wide as sessions
//! scatter (Laird & Ware 1982, random effects).

use faer::{Mat, Side};
use inference::least_squares::Normal;
use nalgebra::{DMatrix, DVector};

/// Normal equations of a session: curvature, slope and cost of its own windows.
#[derive(Debug, Clone)]
pub struct Session {
    /// Second derivatives of the cost by the constants, nats per unit².
    pub curvature: DMatrix<f64>,
    /// First derivatives, nats per unit.
    pub slope: DVector<f64>,
    /// Cost, nats.
    pub cost: f64,
    /// Sum of squares of the slopes of stretches of it, nats² per unit²: about the curvature where its rows are independent and
    /// nothing but noise.
    pub scores: DMatrix<f64>,
}

/// Normal equations of the robot's constants, steps in these units of each: those of sessions whose deviations are eliminated, and of
/// what is known, by its information and how far the constants are from what it says.
pub fn joint(
    sessions: &[Session],
    scatter: &DVector<f64>,
    (information, distance): (&DMatrix<f64>, &DVector<f64>),
    unit: impl Fn(usize) -> f64,
) -> Option<Normal> {
    let n = distance.len();
    let mut curvature = information.clone();
    let mut slope = information * distance;
    for session in sessions {
        let marginal = session.marginal(scatter)?;
        curvature += marginal.curvature;
        slope += marginal.slope;
    }
    let matrix = Mat::from_fn(n, n, |i, j| curvature[(i, j)] * unit(i) * unit(j));
    Some(Normal::new(matrix, Mat::from_fn(n, 1, |i, _| -slope[i] * unit(i))))
}

/// By how many times rows seem to say more than they do, at least 1: the mean over all directions of what the slopes of stretches
/// scatter by over what the curvature promises, `tr(H⁻¹ J)/n`.
///
/// Source: Varin, Reid & Firth 2011, Statistica Sinica 21, Section 2.3 (composite likelihoods, adjusted in magnitude).
pub(crate) fn overdispersion(sessions: &[Session], scales: &DVector<f64>) -> f64 {
    let n = scales.len();
    let s = DMatrix::from_diagonal(scales);
    let sum = |of: fn(&Session) -> &DMatrix<f64>| sessions.iter().fold(DMatrix::zeros(n, n), |sum, x| sum + of(x));
    let [curvature, scores] = [sum(|x| &x.curvature), sum(|x| &x.scores)].map(|m| &s * m * &s);
    // Directions of which the rows say nothing have nothing to scatter.
    let Some(cholesky) = (DMatrix::identity(n, n) + curvature).cholesky() else { return 1.0 };
    let inverse = cholesky.inverse();
    let known = n as f64 - inverse.trace();
    ((inverse * scores).trace() / known.max(f64::MIN_POSITIVE)).max(1.0)
}

/// A session whose deviation is eliminated.
pub struct Marginal {
    /// Second derivatives of its cost by the constants, nats per unit².
    pub curvature: DMatrix<f64>,
    /// First derivatives, nats per unit.
    pub slope: DVector<f64>,
    /// Negative log-likelihood of the most probable deviation, its prior included, nats.
    pub cost: f64,
    /// What is added where all deviations count by their probability, nats, but for what all scatters share.
    pub width: f64,
}

impl Session {
    /// Equations of no rows.
    pub fn of_nothing(constants: usize) -> Self {
        let zero = DMatrix::zeros(constants, constants);
        Self { curvature: zero.clone(), slope: DVector::zeros(constants), cost: 0.0, scores: zero }
    }

    /// Equations about constants that lie `shift` beyond a place, seen from there.
    pub(crate) fn seen_from(mut self, shift: &DVector<f64>) -> Self {
        let turned = &self.curvature * shift;
        self.cost += 0.5 * shift.dot(&turned) - self.slope.dot(shift);
        self.slope -= turned;
        self
    }

    /// The same where each row says so much less.
    pub(crate) fn scaled(mut self, by: f64) -> Self {
        self.curvature *= by;
        self.slope *= by;
        self.cost *= by;
        self.scores *= by * by;
        self
    }

    /// A root `R` of the curvature, which may be singular: `R Rᵀ` is the curvature. `None` where it has no eigenvalues.
    pub fn root(&self) -> Option<DMatrix<f64>> {
        let n = self.curvature.nrows();
        let matrix = Mat::from_fn(n, n, |i, j| self.curvature[(i, j)]);
        let eigen = matrix.self_adjoint_eigen(Side::Lower).ok()?;
        let (vectors, values) = (eigen.U(), eigen.S());
        Some(DMatrix::from_fn(n, n, |i, j| vectors[(i, j)] * values[j].max(0.0).sqrt()))
    }

    /// The session's own most probable deviation from the constants about which it is linearised: `−S M⁻¹ S g`.
    pub fn deviation(&self, scatter: &DVector<f64>) -> Option<DVector<f64>> {
        let s = DMatrix::from_diagonal(scatter);
        let n = scatter.len();
        let cholesky = (DMatrix::identity(n, n) + &s * &self.curvature * &s).cholesky()?;
        Some(-(&s * cholesky.solve(&(&s * &self.slope))))
    }

    /// Without its deviation, of sigmas `scatter`: with `S = diag(scatter)`, `M = I + S H S`.
    pub fn marginal(&self, scatter: &DVector<f64>) -> Option<Marginal> {
        let s = DMatrix::from_diagonal(scatter);
        let sh = &s * &self.curvature;
        let sg = &s * &self.slope;
        let n = scatter.len();
        let cholesky = (DMatrix::identity(n, n) + &sh * &s).cholesky()?;
        let half_log_determinant: f64 = cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        let (of_curvature, of_slope) = (cholesky.solve(&sh), cholesky.solve(&sg));
        Some(Marginal {
            curvature: &self.curvature - sh.transpose() * of_curvature,
            slope: &self.slope - sh.transpose() * &of_slope,
            cost: self.cost - 0.5 * sg.dot(&of_slope),
            width: half_log_determinant,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use inference::robust::normal_quantile;
    use rand_core::{Rng, SeedableRng};
    use rand_pcg::Pcg64;

    const CONSTANTS: usize = 3;

    /// A session of rows with these columns and errors, `½ Σ (e + c·x)²`, in stretches of so many rows.
    fn session(rows: &[(DVector<f64>, f64)], stretch: usize) -> Session {
        let mut out = Session::of_nothing(CONSTANTS);
        for rows in rows.chunks(stretch) {
            let mut own = DVector::zeros(CONSTANTS);
            for (column, error) in rows {
                out.curvature.ger(1.0, column, column, 1.0);
                own.axpy(*error, column, 1.0);
                out.cost += 0.5 * error * error;
            }
            out.scores.ger(1.0, &own, &own, 1.0);
            out.slope += own;
        }
        out
    }

    fn drawn(count: usize) -> Vec<(DVector<f64>, f64)> {
        let mut random = Pcg64::seed_from_u64(7);
        let mut normal = || normal_quantile(((random.next_u64() >> 11) as f64 + 0.5) * 2.0_f64.powi(-53));
        let row = |_| (DVector::from_fn(CONSTANTS, |_, _| normal()), normal());
        (0..count).map(row).collect()
    }

    #[test]
    fn equations_seen_from_elsewhere_are_those_of_there() {
        let rows = drawn(20);
        let shift = DVector::from_vec(vec![0.3, -0.7, 0.2]);
        let there: Vec<_> = rows.iter().map(|(c, e)| (c.clone(), e + c.dot(&shift))).collect();
        let (seen, here) = (session(&there, 4).seen_from(&shift), session(&rows, 4));
        assert_relative_eq!(seen.cost, here.cost, epsilon = 1e-10);
        assert_relative_eq!(seen.slope, here.slope, epsilon = 1e-10);
        assert_eq!(seen.curvature, here.curvature);
    }

    #[test]
    fn rows_that_are_there_four_times_say_as_much_as_once() {
        let rows = drawn(4000);
        let scales = DVector::from_element(CONSTANTS, 1.0);
        assert_relative_eq!(overdispersion(&[session(&rows, 4)], &scales), 1.0, epsilon = 0.1);
        let four: Vec<_> = rows.iter().flat_map(|row| std::iter::repeat_n(row.clone(), 4)).collect();
        let times = overdispersion(&[session(&four, 16)], &scales);
        assert_relative_eq!(times, 4.0, epsilon = 0.4);
        let once = session(&four, 16).scaled(1.0 / times);
        assert_relative_eq!(overdispersion(&[once], &scales), 1.0, epsilon = 1e-9);
        // Of no rows nothing is said.
        assert_eq!(overdispersion(&[Session::of_nothing(CONSTANTS)], &scales), 1.0);
    }
}
