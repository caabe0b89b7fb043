//! A fit of constants with a cause that is there in some rows only.
//!
//! Its constants are `θ`, those of the rows without the cause, and `u`, how far the cause moves them along its directions `B`: rows with it
//! are those of `θ + B u`. Straight lines about another place do not lead there where tyres are far from linear.

use nalgebra::{DMatrix, DVector};

use super::Gate;
use crate::data::{Data, Noise, Prior};
use crate::fit::fit;
use crate::observed::{Kind, Observed, Row, Spread};

/// A drive whose rows depend on constants with a cause or without it.
#[derive(Clone)]
struct Gated<'a, D> {
    drive: &'a D,
    /// Its place among the drives.
    index: usize,
    gate: &'a Gate,
    directions: &'a DMatrix<f64>,
    spreads: &'a [Spread],
}

/// Constants as fitted: those without the cause and how far it moves them, the deviations of drives, and what rows scatter by.
pub(super) struct GatedFit {
    pub(super) theta: DVector<f64>,
    pub(super) own: Vec<DVector<f64>>,
    pub(super) noise: Noise,
}

/// Fits constants with a cause of these directions and variances that is there where a gate says, from `start`.
pub(super) fn fitted<D: Observed>(
    data: &Data<D>,
    known: &Prior,
    gate: &Gate,
    (directions, variances): &(DMatrix<f64>, DVector<f64>),
    start: &DVector<f64>,
) -> Option<GatedFit> {
    let (n, m) = directions.shape();
    let gated = |(index, drive)| Gated { drive, index, gate, directions, spreads: &data.spreads };
    let moves = |variance: &f64| Spread {
        sigma: variance.sqrt(),
        usual: variance.sqrt(),
        scatter: 0.0,
        bounds: [f64::NEG_INFINITY, f64::INFINITY],
    };
    let wide = Data {
        model: data.model.clone(),
        spreads: data.spreads.iter().copied().chain(variances.iter().map(moves)).collect(),
        drives: data.drives.iter().enumerate().map(gated).collect(),
    };
    let mut prior = Prior { mean: DVector::zeros(n + m), covariance: DMatrix::zeros(n + m, n + m) };
    prior.mean.rows_mut(0, n).copy_from(&known.mean);
    prior.covariance.view_mut((0, 0), (n, n)).copy_from(&known.covariance);
    prior.covariance.view_mut((n, n), (m, m)).set_diagonal(variances);

    // A straight line may lead beyond what a constant can be, from where no step is smaller than those that are tried.
    let start = start.iter().zip(&wide.spreads).map(|(x, spread)| x.clamp(spread.bounds[0], spread.bounds[1]));
    let found = fit(&wide, &prior, start.collect())?;
    let own = found.own.iter().map(|own| own.rows(0, n).into_owned()).collect();
    Some(GatedFit { theta: DVector::from_vec(found.theta), own, noise: found.noise })
}

impl<D: Observed> Gated<'_, D> {
    /// Constants without the cause and with it, within what they can be.
    fn both(&self, theta: &[f64]) -> [Vec<f64>; 2] {
        let (n, m) = self.directions.shape();
        let off = DVector::from_column_slice(&theta[..n]);
        let on = &off + self.directions * DVector::from_column_slice(&theta[n..n + m]);
        let held = |of: DVector<f64>| {
            of.iter().zip(self.spreads).map(|(x, spread)| x.clamp(spread.bounds[0], spread.bounds[1])).collect()
        };
        [held(off), held(on)]
    }
}

impl<D: Observed> Observed for Gated<'_, D> {
    type Model = D::Model;

    const WINDOW: f64 = D::WINDOW;
    const FLOOR: [f64; 3] = D::FLOOR;
    const NEAR: f64 = D::NEAR;
    const HARDLY: f64 = D::HARDLY;

    fn name(&self) -> &str {
        self.drive.name()
    }

    fn seconds(&self) -> f64 {
        self.drive.seconds()
    }

    fn rows(&self) -> &[Row] {
        self.drive.rows()
    }

    fn errors(&self, model: &D::Model, theta: &[f64]) -> Vec<f64> {
        let [off, on] = self.both(theta).map(|theta| self.drive.errors(model, &theta));
        self.gate.chosen(self.index, self.rows(), &on, &off)
    }

    fn columns(&self, model: &D::Model, theta: &[f64]) -> Vec<Vec<f64>> {
        let [off, on] = self.both(theta).map(|theta| self.drive.columns(model, &theta));
        let nothing = vec![0.0; self.rows().len()];
        let chosen = |on: &[f64], off: &[f64]| self.gate.chosen(self.index, self.rows(), on, off);
        let of_constants = on.iter().zip(&off).map(|(on, off)| chosen(on, off));
        let of_moves = self.directions.column_iter().map(|direction| {
            let mut along = nothing.clone();
            for (column, weight) in on.iter().zip(direction.iter()).filter(|(_, weight)| **weight != 0.0) {
                along.iter_mut().zip(column).for_each(|(sum, x)| *sum += weight * x);
            }
            chosen(&along, &nothing)
        });
        of_constants.chain(of_moves).collect()
    }

    fn sizes(&self) -> Vec<f64> {
        self.drive.sizes()
    }

    fn noise(&self) -> f64 {
        self.drive.noise()
    }

    fn judged_by(&self) -> Kind {
        self.drive.judged_by()
    }

    fn apart(&self, kind: Kind) -> usize {
        self.drive.apart(kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scaled::Scaled;

    #[test]
    fn a_cause_that_is_there_from_an_instant_on_is_fitted_beside_the_constants_before_it() {
        let spreads = vec![Spread { sigma: 0.1, usual: 0.3, scatter: 0.003, bounds: [-5.0, 5.0] }];
        let drives = [[1.0, 1.0], [1.0, 1.5], [1.5, 1.5]].map(|scale| Scaled::changing(scale, 12.0)).into();
        let data = Data { model: (), spreads, drives };
        let gate = Gate { known: vec![f64::INFINITY, 12.0, 0.0], ends: false };
        let moves = (DMatrix::from_element(1, 1, 1.0), DVector::from_element(1, 0.09));
        let start = DVector::from_column_slice(&[0.1, 0.2]);
        let found = fitted(&data, &data.prior(), &gate, &moves, &start).expect("a fit");
        approx::assert_relative_eq!(found.theta[0], 0.0, epsilon = 0.02);
        approx::assert_relative_eq!(found.theta[1], 1.5_f64.ln(), epsilon = 0.02);
    }
}
