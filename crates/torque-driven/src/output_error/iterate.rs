//! Fits by the common solver, and what the data determine.

use faer::{Mat, Side};
use inference::least_squares::{Normal, Parameter, Problem, Settings, Step, Stopped, minimise};
use robot_model::Robot;

use super::equations::Equations;
use super::{OutputError, OutputErrorError};
use crate::settings::output_error::{Iteration, SETTINGS};

const ITERATION: Iteration = SETTINGS.iteration;

/// Constants fitted to recordings.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// Change of each constant: logarithm of a factor, or an offset in its unit.
    pub delta: Vec<f64>,
    /// One standard deviation of each, by the curvature: right if noise is as stated and the model is.
    pub sigma: Vec<f64>,
    /// The robot with its constants changed.
    pub robot: Robot<f64>,
    /// `Σ ((y − ŷ)/σ)²` over the numbers that are compared.
    pub cost: f64,
    /// Numbers that are compared.
    pub numbers: usize,
    /// Jacobians that it took: each is one run of all recordings, of as many robots as there are constants and one more.
    pub jacobians: usize,
    /// False if the steps ran out before the cost came to rest.
    pub converged: bool,
}

/// Where a fit stands.
struct Point {
    delta: Vec<f64>,
    equations: Equations,
}

/// A fit of the constants.
struct Task<'a>(&'a OutputError<'a>);

impl Problem for Task<'_> {
    type Point = Point;

    fn cost(&self, at: &Point) -> f64 {
        0.5 * at.equations.cost
    }

    fn parameters(&self, at: &Point) -> Vec<Parameter> {
        let free = self.0.constants.iter().zip(&at.delta);
        free.map(|(c, &delta)| {
            let scale = c.scale();
            Parameter { longest: c.longest_step() / scale, ..Parameter::unbounded(delta, scale) }
        })
        .collect()
    }

    /// The equations came with the point: a Jacobian is one run with the shifted robots side by side.
    fn linearise(&self, at: &mut Point, _iteration: usize) -> Option<Normal> {
        self.0.all_leave_a_trace(&at.equations).ok()?;
        let (n, scale) = (self.0.constants.len(), |i: usize| self.0.constants[i].scale());
        let equations = &at.equations;
        let matrix = Mat::from_fn(n, n, |i, j| equations.matrix[(i, j)] * scale(i) * scale(j));
        Some(Normal::new(matrix, Mat::from_fn(n, 1, |i, _| equations.gradient[(i, 0)] * scale(i))))
    }

    fn moved(&self, _from: &Point, step: &Step<'_>) -> Option<Point> {
        let equations = self.0.linearised(&step.values).ok()?;
        Some(Point { delta: step.values.clone(), equations })
    }
}

impl OutputError<'_> {
    /// Fits the constants from `start`, one value for each.
    ///
    /// # Errors
    /// A start that is none or cannot be run, and constants that the recordings do not determine.
    pub fn fit(&self, start: &[f64]) -> Result<Fitted, OutputErrorError> {
        self.check(start)?;
        let equations = self.linearised(start).map_err(|place| self.not_finite(place))?;
        let settings = Settings {
            iterations: ITERATION.most_steps,
            least_relative_fall: ITERATION.least_fall,
            least_move: ITERATION.least_move,
            ..Settings::default()
        };
        let outcome = minimise(&Task(self), Point { delta: start.to_vec(), equations }, &settings);

        let Point { delta, equations: at } = outcome.at;
        let sigma = self.determined(&at)?;
        let robot = self.changed(&delta).ok_or_else(|| self.not_finite(0))?;
        let converged = outcome.stopped == Stopped::Arrived;
        Ok(Fitted { delta, sigma, robot, cost: at.cost, numbers: at.numbers, jacobians: 1 + outcome.trials, converged })
    }

    /// `Σ ((y − ŷ(δ))/σ)²`, each recording run by itself.
    ///
    /// # Errors
    /// Changes that are not one finite number for each constant, and runs that are not finite.
    pub fn cost(&self, delta: &[f64]) -> Result<f64, OutputErrorError> {
        self.check(delta)?;
        let residuals = self.residuals(delta).ok_or_else(|| self.not_finite(0))?;
        Ok(residuals.iter().map(|e| e * e).sum())
    }

    /// The curvature `JᵀJ` at `delta` with `J = ∂(ŷ/σ)/∂δ`, row by row, all robots and recordings side by side.
    ///
    /// # Errors
    /// As [`OutputError::cost`].
    pub fn curvature(&self, delta: &[f64]) -> Result<Vec<Vec<f64>>, OutputErrorError> {
        self.check(delta)?;
        let at = self.linearised(delta).map_err(|place| self.not_finite(place))?;
        let n = self.constants.len();
        Ok((0..n).map(|i| (0..n).map(|j| at.matrix[(i, j)]).collect()).collect())
    }

    fn not_finite(&self, place: usize) -> OutputErrorError {
        OutputErrorError::NotFinite { recording: self.recordings[place].name.clone() }
    }

    fn undetermined(&self, mut which: impl FnMut(usize) -> bool) -> OutputErrorError {
        let names: Vec<&str> =
            (0..self.constants.len()).filter(|i| which(*i)).map(|i| self.constants[i].name()).collect();
        let together = if names.len() > 1 { " apart" } else { "" };
        OutputErrorError::NotDetermined { constants: names.join(", ") + together }
    }

    /// Refuses constants that change nothing.
    fn all_leave_a_trace(&self, at: &Equations) -> Result<(), OutputErrorError> {
        let silent = |i: usize| at.matrix[(i, i)] * (ITERATION.most_sigma * self.constants[i].scale()).powi(2) < 1.0;
        if (0..self.constants.len()).any(silent) { Err(self.undetermined(silent)) } else { Ok(()) }
    }

    /// Standard deviations, or which constants are not determined.
    fn determined(&self, at: &Equations) -> Result<Vec<f64>, OutputErrorError> {
        self.all_leave_a_trace(at)?;
        let n = self.constants.len();
        let size: Vec<f64> = (0..n).map(|i| at.matrix[(i, i)].sqrt()).collect();
        let correlation = Mat::from_fn(n, n, |i, j| at.matrix[(i, j)] / (size[i] * size[j]));
        let eigen = correlation.self_adjoint_eigen(Side::Lower).map_err(|_| self.undetermined(|_| true))?;
        let values = eigen.S().column_vector();
        let worst = (0..n).min_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
        if values[worst] < ITERATION.least_eigenvalue {
            return Err(self.undetermined(|i| eigen.U()[(i, worst)].abs() > ITERATION.part));
        }
        let sigma: Vec<f64> = (0..n)
            .map(|i| (0..n).map(|k| eigen.U()[(i, k)].powi(2) / values[k]).sum::<f64>().sqrt() / size[i])
            .collect();
        let vague = |i: usize| sigma[i] > ITERATION.most_sigma * self.constants[i].scale();
        if (0..n).any(vague) { Err(self.undetermined(vague)) } else { Ok(sigma) }
    }
}
