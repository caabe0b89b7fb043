//! Fits of functions that give residuals.

use faer::Mat;
use rayon::prelude::*;

use crate::algebra::solve_spd;
use crate::settings::{Fitting, SETTINGS};

use super::{Loss, Normal, Outcome, Parameter, Problem, Settings, Step, Stopped, minimise};

/// A constant that is to be fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    /// Where the fit starts.
    pub start: f64,
    /// How far it usually moves, in its unit: the unit of steps.
    pub scale: f64,
    /// Whether the scale grows with the value where that is larger.
    pub relative: bool,
    /// Least and largest value.
    pub bounds: [f64; 2],
    /// Longest step, scales.
    pub longest: f64,
    /// Step of finite differences, scales. Its default is a setting of this crate.
    pub difference: f64,
    /// Added to its diagonal, per scale². Its default is a setting of this crate.
    pub ridge: f64,
    /// What is known of it beforehand: a mean and one standard deviation, in its unit.
    pub prior: Option<[f64; 2]>,
}

impl Constant {
    /// A constant without bounds of which nothing is known beforehand.
    #[must_use]
    pub fn new(start: f64, scale: f64) -> Self {
        let bounds = [f64::NEG_INFINITY, f64::INFINITY];
        let Fitting { difference, ridge } = SETTINGS.constant;
        Self { start, scale, relative: false, bounds, longest: f64::INFINITY, difference, ridge, prior: None }
    }

    /// The same within bounds.
    #[must_use]
    pub fn within(self, least: f64, largest: f64) -> Self {
        Self { bounds: [least, largest], ..self }
    }

    /// The same with a normal prior, in its unit.
    #[must_use]
    pub fn known(self, mean: f64, sigma: f64) -> Self {
        Self { prior: Some([mean, sigma]), ..self }
    }

    fn parameter(&self, value: f64) -> Parameter {
        let scale = if self.relative { value.abs().max(self.scale) } else { self.scale };
        Parameter { value, scale, bounds: self.bounds, longest: self.longest, ridge: self.ridge }
    }
}

/// Why constants could not be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// A constant's numbers contradict each other.
    #[error(
        "constant {place} starts at {start} with bounds {bounds:?} and scale {scale}; it needs a finite start within \
         its bounds and a scale, a step of differences and a standard deviation of its prior above 0"
    )]
    Constant {
        /// Which, counted from 0.
        place: usize,
        /// Where it starts.
        start: f64,
        /// Its bounds.
        bounds: [f64; 2],
        /// Its scale.
        scale: f64,
    },
    /// The residuals at the start are not finite.
    #[error("residual {place} is not finite where the fit starts; start elsewhere, or leave that residual out")]
    NotFinite {
        /// Which, counted from 0.
        place: usize,
    },
}

/// Constants that were fitted.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// Their values.
    pub values: Vec<f64>,
    /// Covariance by the curvature of the cost, priors included: right if residuals are in their own
    /// standard deviations and the model is. `None` if data and priors do not determine the constants.
    pub covariance: Option<Mat<f64>>,
    /// Cost, nats.
    pub cost: f64,
    /// Part of the cost that is the priors'.
    pub prior_cost: f64,
    /// Residuals there.
    pub residuals: Vec<f64>,
    /// Linearisations that it took.
    pub linearisations: usize,
    /// Why it ended.
    pub stopped: Stopped,
    /// Log-determinant of the curvature in each constant's unit.
    log_determinant: f64,
    /// Logarithm of the product of the priors' standard deviations.
    log_prior: f64,
}

impl Fitted {
    /// One standard deviation of a constant; infinite if the constants are not determined.
    pub fn sigma(&self, constant: usize) -> f64 {
        self.covariance.as_ref().map_or(f64::INFINITY, |c| c[(constant, constant)].max(0.0).sqrt())
    }

    /// How far the data narrow the constants down from their priors, nats: `½ ln det(P H)` of prior
    /// covariance and curvature. Constants without a prior count with a standard deviation of their unit.
    pub fn occam(&self) -> f64 {
        0.5 * self.log_determinant + self.log_prior
    }

    /// Log evidence by Laplace's approximation, `−cost − occam`, nats: hypotheses about the same residuals
    /// are compared by their differences.
    pub fn log_evidence(&self) -> f64 {
        -self.cost - self.occam()
    }
}

/// A function that gives residuals, with the constants that are free in it.
pub struct Residuals<F> {
    function: F,
    constants: Vec<Constant>,
    loss: Loss,
}

/// Where a fit stands.
struct Point {
    values: Vec<f64>,
    residuals: Vec<f64>,
}

impl<F: Fn(&[f64]) -> Vec<f64> + Sync> Residuals<F> {
    /// A function of the constants' values that gives as many residuals each time, in units of their
    /// standard deviations. Values for which it gives others, or no numbers, are not gone to.
    pub fn new(constants: Vec<Constant>, function: F) -> Self {
        Self { function, constants, loss: Loss::Square }
    }

    /// The same with another loss than the square.
    #[must_use]
    pub fn with_loss(self, loss: Loss) -> Self {
        Self { loss, ..self }
    }

    /// Fits the constants.
    ///
    /// # Errors
    /// Constants whose numbers contradict each other, and residuals that are not finite at the start.
    pub fn fit(&self, settings: &Settings) -> Result<Fitted, FitError> {
        self.check()?;
        let task = Task(self);
        let start = task.at(self.constants.iter().map(|c| c.start).collect());
        if let Some(place) = start.residuals.iter().position(|r| !r.is_finite()) {
            return Err(FitError::NotFinite { place });
        }

        Ok(task.judged(minimise(&task, start, settings)))
    }

    fn check(&self) -> Result<(), FitError> {
        let good = |c: &Constant| {
            let [least, largest] = c.bounds;
            c.start.is_finite()
                && (least..=largest).contains(&c.start)
                && [c.scale, c.difference].iter().all(|x| x.is_finite() && *x > 0.0)
                && c.prior.is_none_or(|[mean, sigma]| mean.is_finite() && sigma > 0.0)
        };
        match self.constants.iter().enumerate().find(|(_, c)| !good(c)) {
            None => Ok(()),
            Some((place, c)) => Err(FitError::Constant { place, start: c.start, bounds: c.bounds, scale: c.scale }),
        }
    }
}

/// A fit of such a function.
struct Task<'a, F>(&'a Residuals<F>);

impl<F: Fn(&[f64]) -> Vec<f64> + Sync> Task<'_, F> {
    /// Values, covariance and evidence where a fit ended.
    fn judged(&self, mut outcome: Outcome<Point>) -> Fitted {
        let parameters = self.parameters(&outcome.at);
        let n = parameters.len();
        let solved = self.linearise(&mut outcome.at, 0).and_then(|mut normal| {
            normal.stiffen(&parameters);
            solve_spd(&normal.matrix, &Mat::identity(n, n))
        });

        let unit = |i: usize| parameters[i].scale;
        let log_scales: f64 = parameters.iter().map(|p| p.scale.ln()).sum();
        let log_determinant = solved.as_ref().map_or(f64::INFINITY, |s| s.1 - 2.0 * log_scales);
        let covariance = solved.map(|(scaled, _)| Mat::from_fn(n, n, |i, j| scaled[(i, j)] * unit(i) * unit(j)));
        Fitted {
            prior_cost: self.prior_cost(&outcome.at.values),
            values: outcome.at.values,
            residuals: outcome.at.residuals,
            covariance,
            cost: outcome.cost,
            linearisations: outcome.linearisations,
            stopped: outcome.stopped,
            log_determinant,
            log_prior: self.0.constants.iter().filter_map(|c| c.prior).map(|[_, sigma]| sigma.ln()).sum(),
        }
    }

    fn at(&self, values: Vec<f64>) -> Point {
        Point { residuals: (self.0.function)(&values), values }
    }

    fn prior_cost(&self, values: &[f64]) -> f64 {
        let cost = |(c, v): (&Constant, &f64)| Some(0.5 * ((v - c.prior?[0]) / c.prior?[1]).powi(2));
        self.0.constants.iter().zip(values).filter_map(cost).sum()
    }

    /// Derivatives of the residuals, per scale: a column for each constant.
    fn columns(&self, at: &Point, parameters: &[Parameter]) -> Vec<Vec<f64>> {
        let column = |i: usize| {
            let (c, p) = (&self.0.constants[i], &parameters[i]);
            let mut shifted = at.values.clone();
            // Towards the inside of the bounds.
            let size = c.difference * p.scale;
            let h = if shifted[i] + size > c.bounds[1] { -size } else { size };
            shifted[i] += h;
            let residuals = (self.0.function)(&shifted);
            residuals.iter().zip(&at.residuals).map(|(a, b)| (a - b) / h * p.scale).collect()
        };
        (0..parameters.len()).into_par_iter().map(column).collect()
    }
}

impl<F: Fn(&[f64]) -> Vec<f64> + Sync> Problem for Task<'_, F> {
    type Point = Point;

    fn cost(&self, at: &Point) -> f64 {
        self.0.loss.cost(&at.residuals) + self.prior_cost(&at.values)
    }

    fn parameters(&self, at: &Point) -> Vec<Parameter> {
        self.0.constants.iter().zip(&at.values).map(|(c, v)| c.parameter(*v)).collect()
    }

    fn linearise(&self, at: &mut Point, _iteration: usize) -> Option<Normal> {
        let parameters = self.parameters(at);
        let columns = self.columns(at, &parameters);
        let root: Vec<f64> = self.0.loss.weights(&at.residuals).into_iter().map(f64::sqrt).collect();
        let (rows, n) = (at.residuals.len(), parameters.len());
        if columns.iter().any(|c| c.len() < rows) {
            return None;
        }
        let a = Mat::from_fn(rows, n, |i, k| columns[k][i] * root[i]);
        let downhill = Mat::from_fn(rows, 1, |i, _| -at.residuals[i] * root[i]);

        let mut normal = Normal::new(a.transpose() * &a, a.transpose() * &downhill);
        for (i, (c, p)) in self.0.constants.iter().zip(&parameters).enumerate() {
            if let Some([mean, sigma]) = c.prior {
                let weight = (p.scale / sigma).powi(2);
                normal.matrix[(i, i)] += weight;
                normal.gradient[(i, 0)] -= weight * (p.value - mean) / p.scale;
            }
        }
        let finite = (0..n).all(|i| normal.gradient[(i, 0)].is_finite() && normal.matrix[(i, i)].is_finite());
        finite.then_some(normal)
    }

    fn moved(&self, from: &Point, step: &Step<'_>) -> Option<Point> {
        Some(self.at(step.values.clone())).filter(|to| to.residuals.len() == from.residuals.len())
    }
}
