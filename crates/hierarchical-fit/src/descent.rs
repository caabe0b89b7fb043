//! The descent of a fit: equations of every drive, its columns kept for a step, and how steps are taken.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::data::{Data, Noise, Prior};
use crate::observed::{Observed, Spread};
use crate::session::{Session, joint};
use crate::settings::SETTINGS;
use inference::least_squares::{Normal, Parameter, Problem, Settings, Step};

/// Normal equations of a drive whose errors and columns are known.
pub fn equations<D: Observed>(drive: &D, known: (&[f64], &[Vec<f64>]), noise: Noise) -> Session {
    of_rows(drive, known, noise, 0..drive.rows().len())
}

/// The same of some of its rows.
pub(crate) fn of_rows<D: Observed>(
    drive: &D,
    (errors, columns): (&[f64], &[Vec<f64>]),
    noise: Noise,
    rows: impl IntoIterator<Item = usize>,
) -> Session {
    let n = columns.len();
    let mut out = Session::of_nothing(n);
    let (mut stretch, mut own) = (0.0, DVector::zeros(n));
    let outlier = SETTINGS.errors.outlier;
    let mut row = DVector::zeros(n);
    for i in rows {
        let r = &drive.rows()[i];
        let (scale, weight) = (noise.sigma[r.kind as usize], r.weight * noise.power[r.kind as usize]);
        let error = errors[i] / scale;
        let root = (1.0 + (error / outlier).powi(2)).sqrt();
        out.cost += weight * outlier.powi(2) * (root - 1.0);
        for k in 0..n {
            row[k] = columns[k][i] / scale;
        }
        out.curvature.ger(weight / root, &row, &row, 1.0);
        let of_stretch = (r.time / SETTINGS.errors.stretch).floor();
        if of_stretch != stretch {
            out.scores.ger(1.0, &own, &own, 1.0);
            out.slope += &own;
            own.fill(0.0);
            stretch = of_stretch;
        }
        own.axpy(weight / root * error, &row, 1.0);
    }
    out.scores.ger(1.0, &own, &own, 1.0);
    out.slope += own;
    out
}

/// Normal equations of every drive, linearised about its own constants and seen from those of the robot: where drives deviate
/// much, the equations about the robot's would not say where the cost falls (conditional estimation, Lindstrom & Bates 1990).
pub(crate) fn sessions<D: Observed>(data: &Data<D>, theta: &[f64], own: &[DVector<f64>], noise: Noise) -> Vec<Session> {
    let of = |(drive, own): (&D, &DVector<f64>)| {
        let at = data.own_constants(theta, own);
        session(data, drive, (theta, &at), &drive.columns(&data.model, &at), noise)
    };
    data.drives.par_iter().zip(own).map(of).collect()
}

/// The same of one drive at its own constants `at`, of which the columns are known.
fn session<D: Observed>(
    data: &Data<D>,
    drive: &D,
    (theta, at): (&[f64], &[f64]),
    columns: &[Vec<f64>],
    noise: Noise,
) -> Session {
    let shift = DVector::from_iterator(theta.len(), at.iter().zip(theta).map(|(a, t)| a - t));
    equations(drive, (&drive.errors(&data.model, at), columns), noise).seen_from(&shift)
}

/// Fit of the constants where scales of errors and scatter of drives are known.
pub(crate) struct Driven<'a, D: Observed> {
    pub(crate) data: &'a Data<D>,
    pub(crate) prior: &'a Prior,
    /// Inverse of the prior's covariance.
    pub(crate) information: DMatrix<f64>,
    pub(crate) scatter: DVector<f64>,
    pub(crate) noise: Noise,
}

/// Columns of every drive.
pub(crate) type Columns = Arc<Vec<Vec<Vec<f64>>>>;

/// Where a fit stands.
pub(crate) struct Point {
    pub(crate) theta: Vec<f64>,
    /// Deviations of the drives about which they are linearised.
    own: Vec<DVector<f64>>,
    pub(crate) sessions: Vec<Session>,
    columns: Columns,
    /// Whether the columns are those of where the fit stands.
    is_renewed: bool,
}

impl<D: Observed> Driven<'_, D> {
    pub(crate) fn at(&self, theta: Vec<f64>, own: Vec<DVector<f64>>) -> Point {
        let columns = self.columns(&theta, &own);
        self.renewed(theta, own, columns)
    }

    pub(crate) fn columns(&self, theta: &[f64], own: &[DVector<f64>]) -> Columns {
        let of =
            |(drive, own): (&D, &DVector<f64>)| drive.columns(&self.data.model, &self.data.own_constants(theta, own));
        Arc::new(self.data.drives.par_iter().zip(own).map(of).collect())
    }

    /// With the columns of just there.
    pub(crate) fn renewed(&self, theta: Vec<f64>, own: Vec<DVector<f64>>, columns: Columns) -> Point {
        Point { is_renewed: true, ..self.with(theta, own, columns) }
    }

    fn distance(&self, theta: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(theta) - &self.prior.mean
    }

    /// With the columns of elsewhere: near by they hardly differ, and they take most of the time.
    fn with(&self, theta: Vec<f64>, own: Vec<DVector<f64>>, columns: Columns) -> Point {
        let of = |((drive, own), columns): ((&D, &DVector<f64>), &Vec<Vec<f64>>)| {
            let at = self.data.own_constants(&theta, own);
            session(self.data, drive, (&theta, &at), columns, self.noise)
        };
        let sessions = self.data.drives.par_iter().zip(&own).zip(columns.par_iter()).map(of).collect();
        Point { theta, own, sessions, columns, is_renewed: false }
    }
}

impl<D: Observed> Problem for Driven<'_, D> {
    type Point = Point;

    fn cost(&self, at: &Point) -> f64 {
        let marginal = at.sessions.iter().map(|s| s.marginal(&self.scatter).map_or(f64::INFINITY, |m| m.cost));
        let d = self.distance(&at.theta);
        marginal.sum::<f64>() + 0.5 * d.dot(&(&self.information * &d))
    }

    fn parameters(&self, at: &Point) -> Vec<Parameter> {
        let of = |(value, c): (&f64, &Spread)| Parameter {
            longest: SETTINGS.fitting.longest,
            bounds: c.bounds,
            ..Parameter::unbounded(*value, c.usual)
        };
        at.theta.iter().zip(&self.data.spreads).map(of).collect()
    }

    fn linearise(&self, at: &mut Point, iteration: usize) -> Option<Normal> {
        if iteration.is_multiple_of(SETTINGS.fitting.renewed) {
            self.renew(at);
        }
        let distance = self.distance(&at.theta);
        joint(&at.sessions, &self.scatter, (&self.information, &distance), |i| self.data.spreads[i].usual)
    }

    fn renew(&self, at: &mut Point) -> bool {
        if at.is_renewed {
            return false;
        }
        let Some(own) = at.sessions.iter().map(|s| s.deviation(&self.scatter)).collect() else { return false };
        *at = self.at(std::mem::take(&mut at.theta), own);
        true
    }

    fn moved(&self, from: &Point, step: &Step<'_>) -> Option<Point> {
        Some(self.with(step.values.clone(), from.own.clone(), Arc::clone(&from.columns)))
    }
}

/// How steps are taken: undamped ones first, for most fits are close to linear.
pub(crate) fn damped(iterations: usize) -> Settings {
    let rules = SETTINGS.fitting;
    Settings {
        iterations,
        least_relative_fall: rules.fall,
        least_damping: rules.damping[0],
        lower: rules.damping[1],
        ..Settings::gauss_newton()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scaled::Scaled;

    /// Drives whose scales are far from each other: the cost falls as the equations say where each is linearised about its own.
    #[test]
    fn equations_about_each_drives_own_constants_say_where_the_cost_falls() {
        let spreads = vec![Spread { sigma: 1.0, usual: 1.0, scatter: 0.5, bounds: [-5.0, 5.0] }];
        let data = Data { model: (), spreads, drives: vec![Scaled::by(0.6), Scaled::by(2.5), Scaled::by(3.0)] };
        let prior = data.prior();
        let driven = Driven {
            data: &data,
            prior: &prior,
            information: DMatrix::identity(1, 1),
            scatter: data.scatter(1.0),
            noise: Noise { sigma: [0.1; 3], power: [1.0; 3] },
        };
        let slope = |own: &[DVector<f64>]| {
            let mut at = driven.at(vec![0.2], own.to_vec());
            let told = -driven.linearise(&mut at, 1).expect("equations").gradient[(0, 0)];
            let cost = |theta: f64| {
                // The most probable deviations, wherever the constants stand.
                let mut at = driven.at(vec![theta], own.to_vec());
                for _ in 0..20 {
                    at.is_renewed = false;
                    driven.renew(&mut at);
                }
                driven.cost(&at)
            };
            (told, (cost(0.2 + 1e-4) - cost(0.2 - 1e-4)) / 2e-4)
        };
        let nowhere = vec![DVector::zeros(1); 3];
        let (told, is) = slope(&nowhere);
        assert!((told - is).abs() > 0.5 * is.abs(), "{told} {is}: about the constants of all they are wrong");

        let mut at = driven.at(vec![0.2], nowhere);
        for _ in 0..20 {
            at.is_renewed = false;
            assert!(driven.renew(&mut at));
        }
        let (told, is) = slope(&at.own);
        assert!((told - is).abs() < 1e-3 * is.abs(), "{told} {is}");
        assert!(!driven.renew(&mut at), "there is nothing to renew");
    }
}
