//! Every cause at every instant at which it may begin or end, by equations about one place.
//!
//! There the equations of the constants `θ` are the same wherever a cause acts. Of how far it moves them, `u`, each drive adds its
//! curvature, its coupling with `θ` and its slope, over the rows in which it acts, the drive's own deviation eliminated; then
//! `ln p = ln p(without) + ½ rᵀ V⁻¹ r − ½ ln |V U|` with `V = U⁻¹ + Λ_uu − Λ_uθ C Λ_θu`, `r = g_u − Λ_uθ C g_θ`, `U` the variances of `u` and
//! `C` the covariance of `θ` (a Schur complement).

use nalgebra::{DMatrix, DVector};

use crate::onset::Instants;
use crate::onset::courses::{Course, Grid};
use crate::session::Session;
use crate::stretches::{Stretch, difference, sums};
use crate::weigh::Evidence;

/// What a cause that acts in some rows adds to the equations.
struct Acting {
    curvature: DMatrix<f64>,
    /// With the constants, one column for each direction.
    coupling: DMatrix<f64>,
    slope: DVector<f64>,
}

impl Acting {
    fn of_nothing(constants: usize, directions: usize) -> Self {
        Self {
            curvature: DMatrix::zeros(directions, directions),
            coupling: DMatrix::zeros(constants, directions),
            slope: DVector::zeros(directions),
        }
    }

    fn add(&mut self, other: &Self) {
        self.curvature += &other.curvature;
        self.coupling += &other.coupling;
        self.slope += &other.slope;
    }
}

/// A drive with its own deviation eliminated.
struct Drive {
    sums: Vec<Session>,
    /// `S (I + S H S)⁻¹ S` of its scatter and curvature.
    own: DMatrix<f64>,
}

impl Drive {
    fn new(stretches: &[Stretch], scatter: &DVector<f64>) -> Option<Self> {
        let n = scatter.len();
        let sums = sums(Session::of_nothing(n), stretches);
        let s = DMatrix::from_diagonal(scatter);
        let whole = &sums[sums.len() - 1].curvature;
        let inverse = (DMatrix::identity(n, n) + &s * whole * &s).cholesky()?.inverse();
        Some(Self { own: &s * inverse * &s, sums })
    }

    fn whole(&self) -> &Session {
        &self.sums[self.sums.len() - 1]
    }

    /// What a cause adds that acts in the rows of these equations.
    fn acting(&self, rows: &Session, directions: &DMatrix<f64>) -> Acting {
        let whole = self.whole();
        let pulled = &rows.curvature * directions;
        let own = &self.own * &pulled;
        Acting {
            curvature: directions.transpose() * &pulled - pulled.transpose() * &own,
            slope: directions.transpose() * &rows.slope - own.transpose() * &whole.slope,
            coupling: pulled - &whole.curvature * own,
        }
    }
}

/// Equations of all drives about one place.
pub(crate) struct Scan {
    drives: Vec<Drive>,
    evidence: Evidence,
    /// From where they stand to what was known.
    back: DVector<f64>,
}

/// Causes that are always there.
pub(crate) struct Always {
    evidence: f64,
    covariance: DMatrix<f64>,
}

impl Scan {
    /// Of drives about `theta`, whose constants scatter so, of which `mean` was known.
    pub(crate) fn new(
        drives: &[Vec<Stretch>],
        theta: &DVector<f64>,
        scatter: &DVector<f64>,
        mean: &DVector<f64>,
    ) -> Option<Self> {
        let drives: Vec<Drive> = drives.iter().map(|d| Drive::new(d, scatter)).collect::<Option<_>>()?;
        let mut evidence = Evidence::of_nothing(mean);
        for drive in &drives {
            evidence += &Evidence::of_session(theta, drive.whole(), scatter, mean)?;
        }
        Some(Self { drives, evidence, back: mean - theta })
    }

    /// The answer of causes that are always there, of which this is known.
    pub(crate) fn always(&self, known: &DMatrix<f64>) -> Option<Always> {
        let evidence = self.evidence.of(known)? - self.evidence.base;
        Some(Always { evidence, covariance: self.evidence.posterior(known)?.covariance })
    }

    /// Evidence of each of these courses, or of those that change anew in each drive, of a cause of these directions and variances that
    /// begins, or ends, there.
    pub(crate) fn instants(
        &self,
        (series, grid): (&[Course], &Grid),
        (directions, variances): &(DMatrix<f64>, DVector<f64>),
        always: &Always,
        (ends, anew): (bool, bool),
    ) -> Option<Instants> {
        let (n, m) = directions.shape();
        // What each drive adds where all is otherwise from each of its stretches on.
        let of_drive = |drive: &Drive| -> Vec<Acting> {
            let rows = |sum: &Session| if ends { sum.clone() } else { difference(drive.whole(), sum) };
            drive.sums.iter().map(|sum| drive.acting(&rows(sum), directions)).collect()
        };
        let added: Vec<Vec<Acting>> = self.drives.iter().map(of_drive).collect();
        // By how much the slope of the constants pulls at the cause.
        let pulls = &always.covariance * self.evidence.slope();
        let known = DMatrix::from_diagonal(&variances.map(|v| 1.0 / v));
        let score = |course: &Course| {
            let mut acting = Acting::of_nothing(n, m);
            course.iter().zip(&added).for_each(|(from, added)| acting.add(&added[*from]));
            let held = &always.covariance * &acting.coupling;
            let curvature = &known + acting.curvature - acting.coupling.transpose() * held;
            let slope = acting.slope + acting.coupling.transpose() * (&self.back - &pulls);
            let scaled = DMatrix::from_diagonal(&variances.map(f64::sqrt));
            let cholesky = (&scaled * curvature * &scaled).cholesky()?;
            let slope = scaled * slope;
            let half_log_determinant: f64 = cholesky.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
            let gain = 0.5 * slope.dot(&cholesky.solve(&slope)) - half_log_determinant;
            Some(always.evidence + gain)
        };
        let once = series.iter().map(|course| Some((score(course)?, course.clone()))).collect::<Option<Instants>>()?;
        if !anew {
            return Some(once);
        }
        let (_, best) = once.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        grid.anew(&best, score)
    }
}
