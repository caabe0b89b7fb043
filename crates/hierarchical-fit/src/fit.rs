//! Fits of the constants to many drives, each with a deviation of its own.
//!
//! Errors in sigmas count by a loss without a corner (pseudo-Huber); the deviation `δ ~ N(0, T)` of every drive is eliminated, so
//! that drives weigh by what they say of the robot and intervals are as wide as drives scatter.

use std::sync::Arc;

use faer::Mat;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::observed::{Kind, Observed, Spread};
use crate::session::{Session, overdispersion};
use crate::settings::SETTINGS;
use crate::weigh::Evidence;
use inference::least_squares::{Normal, Parameter, Problem, Settings, Step, minimise};
use inference::robust::{quantile, rms, sorted};

/// Drives with the model that they are compared with.
#[derive(Debug, Clone)]
pub struct Data<D: Observed> {
    /// The model.
    pub model: D::Model,
    /// How far each of its constants may be from what is given.
    pub spreads: Vec<Spread>,
    /// The drives.
    pub drives: Vec<D>,
}

/// What rows of each kind scatter by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Sigma of a row's error.
    pub sigma: [f64; 3],
    /// Independent rows for each row, at most 1: errors that follow one another say less (effective number of samples).
    pub power: [f64; 3],
}

impl Noise {
    /// The same with every row for itself.
    #[must_use]
    pub fn of_single_rows(self) -> Self {
        Self { power: [1.0; 3], ..self }
    }

    /// The same where rows say so many times as much.
    fn times(self, by: f64) -> Self {
        Self { power: self.power.map(|p| p * by), ..self }
    }

    /// The less noisy of two, kind by kind.
    pub(crate) fn least(self, other: Self) -> Self {
        let of = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|kind| a[kind].min(b[kind]));
        Self { sigma: of(self.sigma, other.sigma), power: of(self.power, other.power) }
    }
}

/// What is known of the constants before the drives.
#[derive(Debug, Clone, PartialEq)]
pub struct Prior {
    /// Most probable deviations.
    pub mean: DVector<f64>,
    /// Covariance about them.
    pub covariance: DMatrix<f64>,
}

/// Fitted constants with the equations about them.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Deviations of the constants.
    pub theta: Vec<f64>,
    /// Deviation of each drive from them, about which it is linearised.
    pub own: Vec<DVector<f64>>,
    /// Equations of each drive about the constants.
    pub sessions: Vec<Session>,
    /// What rows scatter by.
    pub noise: Noise,
    /// Factor on the scatter of all constants.
    pub factor: f64,
}

impl<D: Observed> Data<D> {
    pub(crate) fn errors(&self, thetas: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let of = |(drive, theta): (&D, &Vec<f64>)| drive.errors(&self.model, theta);
        self.drives.par_iter().zip(thetas).map(of).collect()
    }

    /// Of errors of rows in motion: sigmas by their upper quantile, and how many are independent.
    pub(crate) fn noise(&self, errors: &[Vec<f64>]) -> Noise {
        let sigma = self.sigmas(errors);
        let power = Kind::ALL.map(|kind| {
            let most = 2.0 * SETTINGS.errors.quantile_sigmas * sigma[kind as usize];
            let (mut square, mut product) = (0.0, 0.0);
            for (drive, errors) in self.drives.iter().zip(errors) {
                let of_kind = drive.rows().iter().zip(errors).filter(|(r, _)| r.kind == kind);
                let held: Vec<Option<f64>> =
                    of_kind.map(|(r, e)| (r.is_moving && *e != 0.0).then(|| e.clamp(-most, most))).collect();
                for (a, b) in held.iter().zip(held.iter().skip(drive.apart(kind))) {
                    if let (Some(a), Some(b)) = (a, b) {
                        product += a * b;
                        square += 0.5 * (a * a + b * b);
                    }
                }
            }
            // Of a process of first order with this correlation.
            let correlation = (product / square.max(f64::MIN_POSITIVE)).clamp(0.0, SETTINGS.errors.correlated);
            (1.0 - correlation) / (1.0 + correlation)
        });
        Noise { sigma, power }
    }

    fn sigmas(&self, errors: &[Vec<f64>]) -> [f64; 3] {
        let rules = SETTINGS.errors;
        Kind::ALL.map(|kind| {
            let of = |(drive, e): (&D, &Vec<f64>)| {
                let rows = drive.rows().iter().zip(e).filter(|(r, e)| r.kind == kind && r.is_moving && **e != 0.0);
                rows.map(|(_, e)| e.abs()).collect::<Vec<f64>>()
            };
            let sizes = sorted(self.drives.iter().zip(errors).flat_map(of));
            let limit = quantile(&sizes, rules.quantile).unwrap_or(0.0) / rules.quantile_sigmas;
            let cut = 2.0 * rules.quantile_sigmas * limit;
            rms(sizes.iter().map(|e| e.min(cut))).unwrap_or(0.0).max(D::FLOOR[kind as usize])
        })
    }

    /// Root mean square error of the rows in motion over the size of what they measure.
    pub fn share(&self, theta: &[f64]) -> f64 {
        let errors = self.errors(&vec![theta.to_vec(); self.drives.len()]);
        let (mut ways, mut sizes) = (Vec::new(), Vec::new());
        for (drive, errors) in self.drives.iter().zip(&errors) {
            let kind = drive.judged_by();
            let moving = drive.rows().iter().zip(errors).filter(|(r, _)| r.kind == kind && r.is_moving);
            ways.extend(moving.map(|(_, e)| *e));
            sizes.extend(drive.sizes());
        }
        rms(ways).unwrap_or(0.0) / rms(sizes).unwrap_or(1.0).max(f64::MIN_POSITIVE)
    }

    /// One sigma by which drives differ.
    pub fn scatter(&self, factor: f64) -> DVector<f64> {
        DVector::from_iterator(self.spreads.len(), self.spreads.iter().map(|c| factor * c.scatter))
    }

    /// Constants within what they can be.
    pub(crate) fn within_bounds(&self, theta: &DVector<f64>) -> Vec<f64> {
        self.spreads.iter().zip(theta.iter()).map(|(c, x)| x.clamp(c.bounds[0], c.bounds[1])).collect()
    }

    /// Constants of a drive that deviates from the robot's.
    pub(crate) fn own_constants(&self, theta: &[f64], own: &DVector<f64>) -> Vec<f64> {
        self.within_bounds(&(DVector::from_column_slice(theta) + own))
    }

    /// What the robot file knows.
    pub(crate) fn prior(&self) -> Prior {
        let n = self.spreads.len();
        let variances = DVector::from_iterator(n, self.spreads.iter().map(|c| c.sigma.powi(2)));
        Prior { mean: DVector::zeros(n), covariance: DMatrix::from_diagonal(&variances) }
    }
}

/// Normal equations of rows whose errors and columns are known.
pub fn equations<D: Observed>(drive: &D, (errors, columns): (&[f64], &[Vec<f64>]), noise: Noise) -> Session {
    let n = columns.len();
    let mut out = Session::of_nothing(n);
    let (mut stretch, mut own) = (0.0, DVector::zeros(n));
    let outlier = SETTINGS.errors.outlier;
    let mut row = DVector::zeros(n);
    for (i, r) in drive.rows().iter().enumerate() {
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

struct Driven<'a, D: Observed> {
    data: &'a Data<D>,
    prior: &'a Prior,
    information: DMatrix<f64>,
    scatter: DVector<f64>,
    noise: Noise,
}

/// Columns of every drive.
type Columns = Arc<Vec<Vec<Vec<f64>>>>;

struct Point {
    theta: Vec<f64>,
    own: Vec<DVector<f64>>,
    sessions: Vec<Session>,
    columns: Columns,
    /// Whether the columns are those of where the fit stands.
    is_renewed: bool,
}

impl<D: Observed> Driven<'_, D> {
    fn at(&self, theta: Vec<f64>, own: Vec<DVector<f64>>) -> Point {
        let of =
            |(drive, own): (&D, &DVector<f64>)| drive.columns(&self.data.model, &self.data.own_constants(&theta, own));
        let columns = Arc::new(self.data.drives.par_iter().zip(&own).map(of).collect());
        Point { is_renewed: true, ..self.with(theta, own, columns) }
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
        let d = DVector::from_column_slice(&at.theta) - &self.prior.mean;
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
        let n = at.theta.len();
        let mut curvature = self.information.clone();
        let mut slope = &self.information * (DVector::from_column_slice(&at.theta) - &self.prior.mean);
        for session in &at.sessions {
            let marginal = session.marginal(&self.scatter)?;
            curvature += marginal.curvature;
            slope += marginal.slope;
        }
        let unit = |i: usize| self.data.spreads[i].usual;
        let matrix = Mat::from_fn(n, n, |i, j| curvature[(i, j)] * unit(i) * unit(j));
        Some(Normal::new(matrix, Mat::from_fn(n, 1, |i, _| -slope[i] * unit(i))))
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
fn damped(iterations: usize) -> Settings {
    let rules = SETTINGS.fitting;
    Settings {
        iterations,
        least_relative_fall: rules.fall,
        least_damping: rules.damping[0],
        lower: rules.damping[1],
        ..Settings::gauss_newton()
    }
}

/// Fits the constants from `start`, scales of errors and scatter of drives included; `None` where a prior is no covariance.
pub(crate) fn fit<D: Observed>(data: &Data<D>, prior: &Prior, start: Vec<f64>) -> Option<Fit> {
    let rules = SETTINGS.fitting;
    let information = prior.covariance.clone().cholesky()?.inverse();
    let settings = damped(rules.iterations);
    let noise = data.noise(&data.errors(&vec![start.clone(); data.drives.len()]));
    // Before the first fit errors are no noise, and follow one another.
    let own = vec![DVector::zeros(start.len()); data.drives.len()];
    let mut out = Fit { theta: start, own, sessions: Vec::new(), noise: noise.of_single_rows(), factor: 1.0 };
    for _ in 0..rules.rounds {
        let scatter = data.scatter(out.factor);
        let problem =
            Driven { data, prior, information: information.clone(), scatter: scatter.clone(), noise: out.noise };
        let at = minimise(&problem, problem.at(out.theta, out.own), &settings).at;
        out.own = at.sessions.iter().map(|s| s.deviation(&scatter)).collect::<Option<_>>()?;
        (out.theta, out.sessions) = (at.theta, at.sessions);
        // What a drive has of its own is no noise of its rows.
        let thetas: Vec<Vec<f64>> = out.own.iter().map(|own| data.own_constants(&out.theta, own)).collect();
        out.noise = data.noise(&data.errors(&thetas));
        out.factor = scatter_factor(data, prior, &out);
        out.sessions = sessions(data, &out.theta, &out.own, out.noise);
        let scales = DVector::from_iterator(data.spreads.len(), data.spreads.iter().map(|c| c.usual));
        let less = 1.0 / overdispersion(&out.sessions, &scales);
        out.noise = out.noise.times(less);
        out.sessions = out.sessions.into_iter().map(|s| s.scaled(less)).collect();
    }
    Some(out)
}

/// One fit with the scales of errors and the scatter of drives of another.
pub(crate) fn fit_like<D: Observed>(data: &Data<D>, prior: &Prior, start: Vec<f64>, like: &Fit) -> Option<Fit> {
    let rules = SETTINGS.fitting;
    let information = prior.covariance.clone().cholesky()?.inverse();
    let settings = damped(rules.again);
    let problem = Driven { data, prior, information, scatter: data.scatter(like.factor), noise: like.noise };
    let at = minimise(&problem, problem.at(start, like.own.clone()), &settings).at;
    let own = at.sessions.iter().map(|s| s.deviation(&problem.scatter)).collect::<Option<Vec<_>>>()?;
    let sessions = sessions(data, &at.theta, &own, like.noise);
    Some(Fit { theta: at.theta, own, sessions, noise: like.noise, factor: like.factor })
}

/// Of two values of the constants those that are more probable; `None` where a prior is no covariance.
pub(crate) fn likelier<D: Observed>(
    data: &Data<D>,
    prior: &Prior,
    like: &Fit,
    both: [Vec<f64>; 2],
) -> Option<Vec<f64>> {
    let information = prior.covariance.clone().cholesky()?.inverse();
    let problem = Driven { data, prior, information, scatter: data.scatter(1.0), noise: like.noise };
    let [a, b] = both.map(|theta| problem.at(theta, like.own.clone()));
    Some(if problem.cost(&b) < problem.cost(&a) { b.theta } else { a.theta })
}

/// A fit without one of its drives: equations and scales of the others, about where it ended.
pub(crate) fn without<D: Observed>(data: &Data<D>, prior: &Prior, fit: &Fit, left: usize) -> Fit {
    let mut out = fit.clone();
    out.sessions.remove(left);
    out.own.remove(left);
    out.factor = scatter_factor(data, prior, &out);
    out
}

/// The factor on the scatter of drives under which they are most probable together.
fn scatter_factor<D: Observed>(data: &Data<D>, prior: &Prior, fit: &Fit) -> f64 {
    let rules = SETTINGS.fitting;
    let score = |factor: f64| {
        let evidence = Evidence::new(&fit.theta, &fit.sessions, &data.scatter(factor), &prior.mean)
            .and_then(|e| Some(e.of(&prior.covariance)? - e.base));
        evidence.unwrap_or(f64::NEG_INFINITY) - 0.5 * (factor.ln() / rules.width).powi(2)
    };
    let best = rules.factors.into_iter().map(|f| (score(f), f)).max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(1.0, |(_, factor)| factor)
}
