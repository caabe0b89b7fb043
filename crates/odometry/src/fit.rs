//! Fits of the constants to windows of many sessions, each with a deviation of its own.
//!
//! Errors `e` of a window, in sigmas, count by the pseudo-Huber loss `k² (√(1 + |e|²/k²) − 1)`. The constants of a session
//! are those of the robot plus a deviation of its own, as of [`hierarchical_fit`].

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::constants::{Constant, Quantity};
use crate::drive::Drive;
use crate::motion::implied;
use crate::settings::SETTINGS;
use crate::wheel::WheeledRobot;
use crate::windows::{Data, Window, laws};
use hierarchical_fit::{Evidence, Prior, Session, joint};
use inference::least_squares::{Normal, Parameter, Problem, Settings, Step, minimise};

/// Where a fit stands.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) theta: Vec<f64>,
    pub(crate) sessions: Vec<Session>,
}

/// Factors on the usual scatter of constants from session to session. Clocks that start at unlike times need not run at unlike rates, nor
/// the other way round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Factors {
    /// On that of all constants but the clocks'.
    pub(crate) others: f64,
    /// On that of the offset of the clocks.
    pub(crate) offset: f64,
    /// On that of their rate.
    pub(crate) rate: f64,
}

impl Factors {
    const USUAL: Self = Self { others: 1.0, offset: 1.0, rate: 1.0 };

    /// All that are tried.
    fn tried() -> impl Iterator<Item = Self> {
        let rules = SETTINGS.scatter;
        let of_clocks = move |others: f64| {
            let with_rate = move |offset: f64| rules.clocks.into_iter().map(move |rate| Self { others, offset, rate });
            rules.clocks.into_iter().flat_map(with_rate)
        };
        rules.factors.into_iter().flat_map(of_clocks)
    }

    fn of(self, quantity: &Quantity) -> f64 {
        match quantity {
            Quantity::ClockOffset => self.offset,
            Quantity::ClockRate(_) => self.rate,
            _ => self.others,
        }
    }

    /// What it costs that they are not usual, nats.
    fn price(self) -> f64 {
        let rules = SETTINGS.scatter;
        let [others, offset, rate] =
            [(self.others, rules.width), (self.offset, rules.clock_width), (self.rate, rules.clock_width)]
                .map(|(factor, width)| factor.ln() / width);
        0.5 * (others * others + offset * offset + rate * rate)
    }
}

/// Fitted constants with the equations about them.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    pub(crate) theta: Vec<f64>,
    pub(crate) sessions: Vec<Session>,
    /// Sigma of a window's errors, m.
    pub(crate) scale: f64,
    /// Factors on the usual scatter of sessions.
    pub(crate) factors: Factors,
}

/// A least-squares problem of the shared solver.
struct Windowed<'a, 'd> {
    data: &'a Data<'d>,
    prior: &'a Prior,
    information: DMatrix<f64>,
    scatter: DVector<f64>,
    scale: f64,
}

impl Windowed<'_, '_> {
    fn at(&self, theta: Vec<f64>) -> Point {
        let sessions = equations(self.data, &theta, self.scale);
        Point { theta, sessions }
    }

    fn distance(&self, theta: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(theta) - &self.prior.mean
    }
}

impl Problem for Windowed<'_, '_> {
    type Point = Point;

    fn cost(&self, at: &Point) -> f64 {
        let marginal =
            at.sessions.iter().map(|s| s.marginal(&self.scatter).map_or(f64::INFINITY, |m| m.cost + m.width));
        let d = self.distance(&at.theta);
        marginal.sum::<f64>() + 0.5 * d.dot(&(&self.information * &d))
    }

    fn parameters(&self, at: &Point) -> Vec<Parameter> {
        let of = |(value, constant): (&f64, &Constant)| Parameter {
            longest: 2.0,
            ..Parameter::unbounded(*value, constant.usual)
        };
        at.theta.iter().zip(self.data.constants).map(of).collect()
    }

    fn linearise(&self, at: &mut Point, _: usize) -> Option<Normal> {
        let distance = self.distance(&at.theta);
        joint(&at.sessions, &self.scatter, (&self.information, &distance), |i| self.data.constants[i].usual)
    }

    fn moved(&self, _: &Point, step: &Step<'_>) -> Option<Point> {
        Some(self.at(step.values.clone()))
    }
}

/// Normal equations of every session at these values, errors in units of `scale`.
pub(crate) fn equations(data: &Data<'_>, theta: &[f64], scale: f64) -> Vec<Session> {
    let n = theta.len();
    let empty = Session::of_nothing(n);
    let mut out = vec![empty; data.sessions.len()];
    let rules = SETTINGS.windows;
    let laws = data.laws(theta);
    for (index, drive) in data.drives.iter().enumerate() {
        let columns = columns(data, theta, index);
        let path = implied(data.robot, drive, &laws);
        let session = &mut out[data.session[index]];
        for (w, window) in data.windows[index].iter().enumerate() {
            if data.dropped[index][w] {
                continue;
            }
            let error = window.error(&path).map(|e| e / scale);
            let root = root(error);
            session.cost += rules.outlier.powi(2) * (root - 1.0);
            let weight = 1.0 / root;
            for axis in 0..3 {
                let row = DVector::from_fn(n, |k, _| columns[k][w][axis] / scale);
                session.curvature.ger(weight, &row, &row, 1.0);
                session.slope.axpy(weight * error[axis], &row, 1.0);
            }
        }
    }
    out
}

/// `√(1 + |e|²/k²)` of an error in sigmas.
fn root(error: [f64; 3]) -> f64 {
    let square: f64 = error.iter().map(|e| e * e).sum::<f64>() / SETTINGS.windows.outlier.powi(2);
    (1.0 + square).sqrt()
}

/// What an error costs whose sigma is `scale`, nats.
pub(crate) fn loss(error: [f64; 3], scale: f64) -> f64 {
    SETTINGS.windows.outlier.powi(2) * (root(error.map(|e| e / scale)) - 1.0)
}

/// Change of the errors of a drive's windows with each constant.
pub(crate) fn columns(data: &Data<'_>, theta: &[f64], drive: usize) -> Vec<Vec<[f64; 3]>> {
    columns_of((data.robot, data.constants), (data.drives[drive], &data.windows[drive]), theta)
}

/// The same of any windows, by central differences.
pub(crate) fn columns_of(
    (robot, constants): (&WheeledRobot, &[Constant]),
    (drive, windows): (&Drive, &[Window]),
    theta: &[f64],
) -> Vec<Vec<[f64; 3]>> {
    let of = |k: usize| {
        let step = SETTINGS.windows.difference * constants[k].usual;
        let at = |sign: f64| {
            let mut moved = theta.to_vec();
            moved[k] += sign * step;
            implied(robot, drive, &laws(robot, constants, &moved))
        };
        let (below, above) = (at(-1.0), at(1.0));
        let difference = |w: &Window| {
            let (a, b) = (w.error(&above), w.error(&below));
            [0, 1, 2].map(|axis| (a[axis] - b[axis]) / (2.0 * step))
        };
        windows.iter().map(difference).collect()
    };
    (0..theta.len()).into_par_iter().map(of).collect()
}

/// Sigmas of the deviations of sessions.
pub(crate) fn scatter(data: &Data<'_>, factors: Factors) -> DVector<f64> {
    let of = |c: &Constant| c.scatter * factors.of(&c.quantity);
    DVector::from_iterator(data.constants.len(), data.constants.iter().map(of))
}

/// Fits the constants from `start`, scale of errors and scatter of sessions included; `None` where a prior is no covariance.
pub(crate) fn fit(data: &Data<'_>, prior: &Prior, start: Vec<f64>) -> Option<Fit> {
    let information = prior.covariance.clone().cholesky()?.inverse();
    let settings = Settings { iterations: 20, least_relative_fall: 1e-6, ..Settings::gauss_newton() };
    let mut theta = start;
    let mut scale = data.scale(&data.errors(&theta));
    let mut factors = Factors::USUAL;
    let mut sessions = Vec::new();
    for _ in 0..SETTINGS.fitting.rounds {
        let problem =
            Windowed { data, prior, information: information.clone(), scatter: scatter(data, factors), scale };
        let outcome = minimise(&problem, problem.at(theta), &settings);
        (theta, sessions) = (outcome.at.theta, outcome.at.sessions);
        // What a session has of its own is no noise of its windows.
        let of_session = |session: &Session| {
            let deviation = session.deviation(&scatter(data, factors));
            deviation.map_or_else(|| theta.clone(), |d| theta.iter().zip(d.iter()).map(|(t, d)| t + d).collect())
        };
        let thetas: Vec<Vec<f64>> = sessions.iter().map(of_session).collect();
        let now = data.scale(&data.errors_by_session(&thetas));
        let best = scatter_factors(data, prior, &theta, &sessions);
        let at_rest = (now / scale).ln().abs() < SETTINGS.fitting.same_scale && best == factors;
        (scale, factors) = (now, best);
        if at_rest {
            break;
        }
    }
    // The equations belong to the scale that is told.
    sessions = if sessions.is_empty() { sessions } else { equations(data, &theta, scale) };
    Some(Fit { theta, sessions, scale, factors })
}

/// The factors on the scatter of sessions under which they are most probable together.
fn scatter_factors(data: &Data<'_>, prior: &Prior, theta: &[f64], sessions: &[Session]) -> Factors {
    let score = |factors: Factors| {
        let scatter = scatter(data, factors);
        let evidence =
            Evidence::new(theta, sessions, &scatter, &prior.mean).and_then(|e| Some(e.of(&prior.covariance)? - e.base));
        evidence.unwrap_or(f64::NEG_INFINITY) - factors.price()
    };
    let scored: Vec<(f64, Factors)> = Factors::tried().map(|factors| (score(factors), factors)).collect();
    let best = scored.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(Factors::USUAL, |(_, factors)| factors)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constants::ClockZero;

    #[test]
    fn offset_and_rate_of_the_clocks_scatter_apart() {
        let apart = Factors { rate: 5.0, ..Factors::USUAL };
        assert!(Factors::tried().any(|factors| factors == apart));
        let of =
            [Quantity::ClockOffset, Quantity::ClockRate(ClockZero::Middle), Quantity::Across].map(|q| apart.of(&q));
        assert_eq!(of, [1.0, 5.0, 1.0]);
        assert!(apart.price() > 0.0);
        approx::assert_relative_eq!(Factors::USUAL.price(), 0.0);
    }
}
