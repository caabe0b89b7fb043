//! Damped Gauss–Newton (Levenberg–Marquardt) with bounds, priors, robust losses and eliminated
//! blocks.
//!
//! Two ways in. [`Residuals`] fits a function that gives residuals: columns by finite differences, a
//! [`Loss`], priors and bounds of each [`Constant`]. [`Problem`] is for who computes cost and normal
//! equations in a way of its own (many runs at once, constants of each run eliminated by
//! [`Normal::reduced`]), and is solved by [`minimise`]. Both take the same steps and stop by the same
//! rule.
//!
//! **Step.** `(H + λ diag H) δ = −g` in units of each parameter's scale, by Cholesky. A parameter at a
//! bound that the step would cross is held and the rest solved again. Moves are cut at the longest
//! sensible one and at the bounds. A step that does not lower the cost is repeated with more damping.
//!
//! **Stopping.** A fit has [arrived](Stopped::Arrived) when an accepted step lowers the cost, or was
//! promised by the linearised problem to lower it, by no more than
//! `max(least_fall, least_relative_fall · cost)`, or when a step that was tried moves no parameter by
//! `least_move` of its scale. It also ends when no damping lowers the cost, when its equations are not
//! defined, and when the iterations run out.

mod loss;
mod normal;
mod residuals;
mod settings;

pub use loss::{Loss, saturated, saturation};
pub use normal::{Normal, Parameter};
pub use residuals::{Constant, FitError, Fitted, Residuals};
pub use settings::Settings;

use faer::Mat;

/// A cost with normal equations, `cost ≈ ½ Σ residual²` near its minimum.
pub trait Problem {
    /// Where a fit stands, with all that was computed there.
    type Point;

    /// Cost at a point, nats; priors included.
    fn cost(&self, at: &Self::Point) -> f64;

    /// What is free, where it stands and within what it may move.
    fn parameters(&self, at: &Self::Point) -> Vec<Parameter>;

    /// Normal equations at a point, priors included, parameters in units of their scales; `None` where
    /// they are not defined. Columns may be kept in the point and renewed before a certain iteration,
    /// counted from 0; the cost is asked for again then, which may depend on them.
    fn linearise(&self, at: &mut Self::Point, iteration: usize) -> Option<Normal>;

    /// Renews what is kept in the point where no step lowered the cost; whether there was anything to renew.
    fn renew(&self, _at: &mut Self::Point) -> bool {
        false
    }

    /// The point that a step leads to; `None` if there is none.
    fn moved(&self, from: &Self::Point, step: &Step<'_>) -> Option<Self::Point>;
}

/// A step that is to be tried.
#[derive(Debug)]
pub struct Step<'a> {
    /// Values of the parameters where it leads, within their bounds.
    pub values: Vec<f64>,
    /// The step itself in scales, before it was cut; for [`Normal::back_substituted`].
    pub delta: &'a Mat<f64>,
    /// Damping λ with which it was solved.
    pub damping: f64,
    /// The equations it solves.
    pub normal: &'a Normal,
}

/// Why a fit ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopped {
    /// The cost came to rest.
    Arrived,
    /// No damping lowers the cost.
    NoDescent,
    /// The normal equations are not defined where the fit stands.
    Undefined,
    /// The iterations ran out.
    Iterations,
}

/// Where a fit ended.
#[derive(Debug, Clone)]
pub struct Outcome<T> {
    /// The best point.
    pub at: T,
    /// Its cost.
    pub cost: f64,
    /// Linearisations that it took.
    pub linearisations: usize,
    /// Points that were tried.
    pub trials: usize,
    /// Why it ended there.
    pub stopped: Stopped,
}

/// Minimises a problem from `start`. The cost never rises.
pub fn minimise<P: Problem>(problem: &P, start: P::Point, settings: &Settings) -> Outcome<P::Point> {
    let cost = problem.cost(&start);
    let mut out = Outcome { at: start, cost, linearisations: 0, trials: 0, stopped: Stopped::Iterations };
    let mut damping = settings.first_damping;

    for iteration in 0..settings.iterations {
        let parameters = problem.parameters(&out.at);
        let Some(mut normal) = problem.linearise(&mut out.at, iteration) else {
            out.stopped = Stopped::Undefined;
            break;
        };
        out.cost = problem.cost(&out.at);
        normal.stiffen(&parameters);
        out.linearisations += 1;

        let stopped = descend(problem, &mut out, &parameters, &normal, &mut damping, settings);
        if let Some(stopped) = stopped {
            if stopped == Stopped::NoDescent && problem.renew(&mut out.at) {
                damping = settings.first_damping;
                continue;
            }
            out.stopped = stopped;
            break;
        }
    }
    out
}

/// Tries steps with more and more damping until one lowers the cost; says whether the fit ends there.
fn descend<P: Problem>(
    problem: &P,
    out: &mut Outcome<P::Point>,
    parameters: &[Parameter],
    normal: &Normal,
    damping: &mut f64,
    settings: &Settings,
) -> Option<Stopped> {
    while *damping <= settings.most_damping {
        let Some(delta) = normal.step(parameters, *damping) else {
            *damping = settings.raised(*damping);
            continue;
        };
        let values = Normal::values(parameters, &delta);
        let at_rest = parameters.iter().zip(&values).all(|(p, v)| (v - p.value).abs() < settings.least_move * p.scale);
        let next = problem.moved(&out.at, &Step { values, delta: &delta, damping: *damping, normal });
        out.trials += 1;

        let next = next.map(|next| (problem.cost(&next), next)).filter(|(cost, _)| *cost < out.cost);
        let Some((cost, next)) = next else {
            // At the minimum rounding decides which way is down.
            if at_rest {
                return Some(Stopped::Arrived);
            }
            *damping = settings.raised(*damping);
            continue;
        };

        let enough = settings.least_fall.max(settings.least_relative_fall * out.cost);
        let arrived = out.cost - cost <= enough || normal.promised(&delta) < enough || at_rest;
        (out.at, out.cost) = (next, cost);
        *damping = settings.lowered(*damping);
        return arrived.then_some(Stopped::Arrived);
    }
    Some(Stopped::NoDescent)
}
