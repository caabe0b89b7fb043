//! Equations of drives stretch by stretch in time, from which those of a cause that is there for a part of them follow.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::data::{Data, Noise};
use crate::descent::of_rows;
use crate::observed::Observed;
use crate::session::Session;

/// What one stretch of a drive says.
#[derive(Debug, Clone)]
pub(crate) struct Stretch {
    /// From when on its rows became known, s from the start of the drive.
    pub(crate) from: f64,
    pub(crate) equations: Session,
}

/// Equations of every drive about constants `theta`, each about its own, in stretches of so many seconds; stretches without rows are
/// none.
pub(crate) fn stretches<D: Observed>(
    data: &Data<D>,
    theta: &[f64],
    own: &[DVector<f64>],
    (noise, length): (Noise, f64),
) -> Vec<Vec<Stretch>> {
    let of = |(drive, own): (&D, &DVector<f64>)| {
        let at = data.own_constants(theta, own);
        let shift = DVector::from_iterator(theta.len(), at.iter().zip(theta).map(|(a, t)| a - t));
        let (errors, columns) = (drive.errors(&data.model, &at), drive.columns(&data.model, &at));
        let mut rows: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
        for (i, row) in drive.rows().iter().enumerate() {
            rows.entry((row.time / length).floor() as i64).or_default().push(i);
        }
        let stretch = |(k, rows): (i64, Vec<usize>)| Stretch {
            from: k as f64 * length,
            equations: of_rows(drive, (&errors, &columns), noise, rows).seen_from(&shift),
        };
        rows.into_iter().map(stretch).collect()
    };
    data.drives.par_iter().zip(own).map(of).collect()
}

/// Sums of the equations of a drive's stretches: of the first `k` of them at place `k`.
pub(crate) fn sums(of_nothing: Session, stretches: &[Stretch]) -> Vec<Session> {
    let mut out = vec![of_nothing];
    for stretch in stretches {
        let last = &out[out.len() - 1];
        out.push(Session {
            curvature: &last.curvature + &stretch.equations.curvature,
            slope: &last.slope + &stretch.equations.slope,
            cost: last.cost + stretch.equations.cost,
            scores: last.scores.clone(),
        });
    }
    out
}

/// Equations of the constants and of how far a cause moves them along its `directions`: of rows in which it is not there, and of rows in
/// which it is, these about constants that it has moved.
pub(crate) fn joined(off: &Session, on: &Session, directions: &DMatrix<f64>) -> Session {
    let (n, m) = directions.shape();
    let mut curvature = DMatrix::zeros(n + m, n + m);
    let crossed = &on.curvature * directions;
    curvature.view_mut((0, 0), (n, n)).copy_from(&(&off.curvature + &on.curvature));
    curvature.view_mut((0, n), (n, m)).copy_from(&crossed);
    curvature.view_mut((n, 0), (m, n)).copy_from(&crossed.transpose());
    curvature.view_mut((n, n), (m, m)).copy_from(&(directions.transpose() * crossed));
    let mut slope = DVector::zeros(n + m);
    slope.rows_mut(0, n).copy_from(&(&off.slope + &on.slope));
    slope.rows_mut(n, m).copy_from(&(directions.transpose() * &on.slope));
    Session { curvature, slope, cost: off.cost + on.cost, scores: DMatrix::zeros(n + m, n + m) }
}

/// What one sum of equations has beyond another.
pub(crate) fn difference(of: &Session, beyond: &Session) -> Session {
    Session {
        curvature: &of.curvature - &beyond.curvature,
        slope: &of.slope - &beyond.slope,
        cost: of.cost - beyond.cost,
        scores: of.scores.clone(),
    }
}
