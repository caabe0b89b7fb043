//! Fits of the constants to many drives, each with a deviation of its own.
//!
//! Errors in sigmas count by a loss without a corner (pseudo-Huber); the deviation `δ ~ N(0, T)` of every drive is eliminated, so
//! that drives weigh by what they say of the robot and intervals are as wide as drives scatter.

use std::sync::Arc;

use nalgebra::DVector;

use crate::data::{Data, Noise, Prior};
use crate::descent::{Driven, damped, sessions};
use crate::observed::Observed;
use crate::session::{Session, overdispersion};
use crate::settings::SETTINGS;
use crate::weigh::Evidence;
use inference::least_squares::{Problem, minimise};

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

/// Fits the constants from `start`, scales of errors and scatter of drives included; `None` where a prior is no covariance.
pub(crate) fn fit<D: Observed>(data: &Data<D>, prior: &Prior, start: Vec<f64>) -> Option<Fit> {
    let rules = SETTINGS.fitting;
    let information = prior.covariance.clone().cholesky()?.inverse();
    let settings = damped(rules.iterations);
    let noise = data.noise(&data.errors(&vec![start.clone(); data.drives.len()]));
    // Before the first fit errors are no noise, and follow one another.
    let own = vec![DVector::zeros(start.len()); data.drives.len()];
    let mut out = Fit { theta: start, own, sessions: Vec::new(), noise: noise.of_single_rows(), factor: 1.0 };
    let scales = DVector::from_iterator(data.spreads.len(), data.spreads.iter().map(|c| c.usual));
    let mut columns = None;
    for _ in 0..rules.rounds {
        let scatter = data.scatter(out.factor);
        let problem =
            Driven { data, prior, information: information.clone(), scatter: scatter.clone(), noise: out.noise };
        let columns_here = columns.take().unwrap_or_else(|| problem.columns(&out.theta, &out.own));
        let at = minimise(&problem, problem.renewed(out.theta, out.own, columns_here), &settings).at;
        out.own = at.sessions.iter().map(|s| s.deviation(&scatter)).collect::<Option<_>>()?;
        (out.theta, out.sessions) = (at.theta, at.sessions);
        // What a drive has of its own is no noise of its rows.
        let thetas: Vec<Vec<f64>> = out.own.iter().map(|own| data.own_constants(&out.theta, own)).collect();
        out.noise = data.noise(&data.errors(&thetas));
        out.factor = scatter_factor(data, prior, &out);
        let problem = Driven { noise: out.noise, ..problem };
        let columns_here = problem.columns(&out.theta, &out.own);
        out.sessions = problem.renewed(out.theta.clone(), out.own.clone(), Arc::clone(&columns_here)).sessions;
        columns = Some(columns_here);
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
